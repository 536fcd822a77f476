//! What the points of a run add up to.

/// Sums over points at the end of a piece.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    pub(super) load: f64,
    pub(super) area: f64,
    pub(super) volume: f64,
    pub(super) max_pressure: f64,
    pub(super) max_wear: f64,
    pub(super) max_distance: f64,
}

impl Sums {
    pub(super) fn add(&mut self, other: &Sums) {
        self.load += other.load;
        self.area += other.area;
        self.volume += other.volume;
        self.max_pressure = self.max_pressure.max(other.max_pressure);
        self.max_wear = self.max_wear.max(other.max_wear);
        self.max_distance = self.max_distance.max(other.max_distance);
    }
}
