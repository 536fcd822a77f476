//! Columns that lie in memory in the same way in every run: at lines of the cache, and not a multiple of 4096 bytes
//! apart, where a processor takes a load for one that must wait for a store.

use super::timing::columns;

/// Numbers of a line of the cache.
const LINE: usize = 8;
/// Bytes of a page, and of the stagger between two columns, in numbers.
const PAGE: usize = 512;
const STAGGER: usize = 168;

/// Pressures, velocities and room for answers.
pub struct Placed {
    room: Vec<f64>,
    first: usize,
    points: usize,
}

/// The columns of a [`Placed`].
pub struct Slices<'a> {
    pub pressure: &'a [f64],
    pub velocity: &'a [f64],
    pub answer: &'a mut [f64],
}

impl Placed {
    /// The values of [`columns`].
    pub fn new(points: usize) -> Placed {
        let apart = Placed::apart(points);
        let room = vec![0.0; 3 * apart + LINE];
        let first = room.as_ptr().align_offset(64);
        let mut placed = Placed { room, first, points };
        let (pressure, velocity) = columns(points);
        for (k, column) in [pressure, velocity].iter().enumerate() {
            placed.room[first + k * apart..][..points].copy_from_slice(column);
        }
        placed
    }

    fn apart(points: usize) -> usize {
        points.next_multiple_of(PAGE) + STAGGER
    }

    /// The columns.
    pub fn slices(&mut self) -> Slices<'_> {
        let (points, apart) = (self.points, Placed::apart(self.points));
        let (given, answer) = self.room[self.first..].split_at_mut(2 * apart);
        Slices { pressure: &given[..points], velocity: &given[apart..][..points], answer: &mut answer[..points] }
    }
}
