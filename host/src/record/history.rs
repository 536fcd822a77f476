//! The quantities of a run over time, a row per accepted step.

/// The state of a run at the end of one accepted step, in the scene's units.
///
/// A quantity that the scene cannot give (a load without areas, an approach without a contact
/// solve) is `None`, never a made-up number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryRow {
    /// Represented time at the end of the step.
    pub time: f64,
    /// Length of the step in represented time; 0 for the start of the run.
    pub dt: f64,
    /// Sliding distance since the start, the largest over the points.
    pub sliding_distance: f64,
    /// Load: the integral of contact pressure over the surface.
    pub load: Option<f64>,
    /// Rigid-body approach of the two bodies.
    pub approach: Option<f64>,
    /// Largest contact pressure over the points.
    pub max_pressure: f64,
    /// Area under contact pressure.
    pub contact_area: Option<f64>,
    /// Largest wear depth over the points.
    pub max_wear_depth: f64,
    /// Worn volume.
    pub wear_volume: Option<f64>,
    /// Scale factor of the step, 1 when wear is not scaled.
    pub scale: f64,
    /// Simulated time, which scaling makes shorter than the represented time.
    pub simulated_time: f64,
    /// Represented cycles; 0 outside cycles.
    pub cycle: f64,
}

impl HistoryRow {
    /// A row of an unscaled run at `time` where nothing has happened yet.
    #[must_use]
    pub fn at(time: f64) -> Self {
        Self {
            time,
            dt: 0.0,
            sliding_distance: 0.0,
            load: None,
            approach: None,
            max_pressure: 0.0,
            contact_area: None,
            max_wear_depth: 0.0,
            wear_volume: None,
            scale: 1.0,
            simulated_time: time,
            cycle: 0.0,
        }
    }
}

/// All rows of a run in the order of their times.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History {
    /// The rows, the first one being the start of the run where the solver records it.
    pub rows: Vec<HistoryRow>,
}

impl History {
    /// The last row, which holds the result of the run.
    #[must_use]
    pub fn last(&self) -> Option<&HistoryRow> {
        self.rows.last()
    }

    /// Mean sliding velocity over each step that has a length: (start, end, velocity) in time.
    pub fn sliding_velocity(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let before = std::iter::once(0.0).chain(self.rows.iter().map(|row| row.sliding_distance));
        before.zip(&self.rows).filter(|(_, row)| row.dt > 0.0).map(|(distance, row)| {
            let velocity = (row.sliding_distance - distance) / row.dt;
            (row.time - row.dt, row.time, velocity)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocity_is_the_distance_gained_over_the_step() {
        let mut rows = vec![HistoryRow::at(0.0); 3];
        (rows[1].time, rows[1].dt, rows[1].sliding_distance) = (2.0, 2.0, 1.0);
        (rows[2].time, rows[2].dt, rows[2].sliding_distance) = (2.5, 0.5, 2.0);
        let history = History { rows };
        let velocities: Vec<_> = history.sliding_velocity().collect();
        assert_eq!(velocities, [(0.0, 2.0, 0.5), (2.0, 2.5, 2.0)]);
    }
}
