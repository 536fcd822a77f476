//! Arrays that are used again, so that a solve neither asks the system for memory nor waits for it to be cleared.

/// Arrays that nobody uses at the moment.
#[derive(Debug, Default)]
pub struct Room {
    spare: Vec<Vec<f64>>,
}

impl Room {
    /// An array of `count` numbers, whatever they are.
    pub fn take(&mut self, count: usize) -> Vec<f64> {
        // The smallest that is large enough.
        let fits = self.spare.iter().enumerate().filter(|(_, array)| array.capacity() >= count);
        let best = fits.min_by_key(|(_, array)| array.capacity()).map(|(place, _)| place);
        let mut array = best.map_or_else(Vec::new, |place| self.spare.swap_remove(place));
        array.resize(count, 0.0);
        array
    }

    /// Takes an array back.
    pub fn give(&mut self, array: Vec<f64>) {
        if array.capacity() > 0 {
            self.spare.push(array);
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        self.spare.iter().map(|array| 8 * array.capacity()).sum()
    }
}
