//! What the neighbours of the contact wear under nodal tractions.
//!
//! The averaging gives a traction to cells next to the contact, but cells without pressure do not wear. A stage is solved as if
//! all neighbours wore; those that are open then wear only as far as their gap would be below zero without, which leaves
//! pressures and gaps of the stage as they are. One that would open again by its own wear touches without pressure and wears
//! just as fast as its gap is closed (Filippov, Differential Equations with Discontinuous Righthand Sides, 1988).

use super::segment::Driven;
use super::system::{System, Tractions};
use crate::integrator::Reply;
use crate::solve::PointError;

impl System<'_> {
    /// The rate at the end of a stage `base + weight * rate` under nodal tractions, the contact being solved: the law's own
    /// in contact, less in open cells next to it. State variables change in contact alone.
    pub(super) fn rate_with_neighbours(
        &mut self,
        driven: Driven,
        weight: f64,
        base: &[f64],
        rate: &mut [f64],
    ) -> Result<Reply, PointError> {
        let open = self.evaluator.descriptor().wants_open_points();
        let mut alone = Vec::new();
        if open {
            // What the law gives to open cells without traction.
            if let cut @ Reply::Cut(_) = self.rate(driven, rate)? {
                return Ok(cut);
            }
            alone.extend_from_slice(rate);
        }
        let pressure = std::mem::take(&mut self.pressure);
        self.list_reached(&pressure, open);
        let reply = self.evaluate(driven, &pressure, Tractions::WithNeighbours, false);
        self.pressure = pressure;
        if let cut @ Reply::Cut(_) = reply? {
            return Ok(cut);
        }
        self.spread(rate);
        let mut displaced = std::mem::take(&mut self.room.displaced);
        displaced.resize(self.pressure.len(), 0.0);
        self.model.displacement(&self.pressure, &mut displaced);
        let states = self.plan.initial_state.len();
        for cell in self.room.cells.iter().map(|cell| *cell as usize) {
            if self.pressure[cell] > 0.0 {
                continue;
            }
            let own = alone.get(cell).copied().unwrap_or(0.0);
            let more = weight * (rate[cell] - own);
            if more > 0.0 {
                let worn = base[cell] + weight * own;
                let gap = self.initial_gap[cell] + worn + displaced[cell] - self.solution.approach;
                rate[cell] = own + (-gap / more).clamp(0.0, 1.0) * (rate[cell] - own);
            }
            if !open {
                let memory = cell * states..(cell + 1) * states;
                self.end_state[memory.clone()].copy_from_slice(&self.state[memory]);
            }
        }
        self.room.displaced = displaced;
        Ok(Reply::Good)
    }
}
