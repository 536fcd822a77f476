//! Columns that lie in memory in the same way in every run: at lines of the cache, and not a multiple of 4096 bytes
//! apart, where a processor takes a load for one that must wait for a store.

/// Numbers of a line of the cache.
const LINE: usize = 8;
/// Bytes of a page, and of the stagger between two columns, in numbers.
const PAGE: usize = 512;
const STAGGER: usize = 168;

/// Room for columns of numbers, all zero at first.
pub struct Placed {
    room: Vec<f64>,
    first: usize,
    lengths: Vec<usize>,
}

impl Placed {
    /// Room for columns of these lengths.
    pub fn new(lengths: &[usize]) -> Placed {
        let room = vec![0.0; lengths.iter().map(|length| apart(*length)).sum::<usize>() + LINE];
        let first = room.as_ptr().align_offset(LINE * size_of::<f64>());
        Placed { room, first, lengths: lengths.to_vec() }
    }

    /// The columns.
    pub fn columns(&mut self) -> Vec<&mut [f64]> {
        let mut rest = &mut self.room[self.first..];
        let mut columns = Vec::with_capacity(self.lengths.len());
        for &length in &self.lengths {
            let (mine, others) = rest.split_at_mut(apart(length));
            columns.push(&mut mine[..length]);
            rest = others;
        }
        columns
    }
}

/// From the beginning of a column of that length to that of the next, in numbers.
fn apart(length: usize) -> usize {
    length.next_multiple_of(PAGE) + STAGGER
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_begin_at_lines_and_not_pages_apart() {
        let mut placed = Placed::new(&[1000, 512, 3]);
        let columns = placed.columns();
        assert_eq!(columns.iter().map(|column| column.len()).collect::<Vec<_>>(), [1000, 512, 3]);
        let places: Vec<usize> = columns.iter().map(|column| column.as_ptr() as usize).collect();
        assert!(places.iter().all(|place| place % 64 == 0), "{places:?}");
        assert!(places.windows(2).all(|pair| (pair[1] - pair[0]) % 4096 == 1344), "{places:?}");
    }
}
