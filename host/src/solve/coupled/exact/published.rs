//! The published fretting case: whether a scene is that case, and what was published of it.

use super::super::run::Coupled;
use super::asked::{Rate, Reason};
use super::loading;
use crate::reference::Indenter;
use crate::reference::mccoll::{self, CASE};

/// Relative difference in which a scene may differ from the published case: what rounding of its numbers makes.
const NEAR: f64 = 1e-3;

/// Published depths after a number of cycles; in the scene's unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::solve::coupled) struct Published {
    /// Largest depth of the flat by finite elements.
    pub(in crate::solve::coupled) computed: f64,
    /// Largest depth that was measured, where it was.
    pub(in crate::solve::coupled) measured: Option<f64>,
    /// The flat's part of the wear.
    pub(in crate::solve::coupled) share: f64,
}

/// Checks that a scene is the published case.
pub(super) fn check(run: &Coupled<'_>, rate: Rate) -> Result<(), Reason> {
    let plan = run.plan;
    let sizes = plan.sizes;
    let metre = sizes.metre;
    let pascal = sizes.kilogram / (sizes.metre * sizes.second * sizes.second);
    let (indenter, radius) = run.indenter()?;
    if indenter != Indenter::Line {
        return Err("it is a line contact, expected `contact.dimension` = 2".to_owned());
    }
    let same = |what: &str, found: f64, published: f64| match (found / published - 1.0).abs() <= NEAR {
        true => Ok(()),
        false => Err(format!("{what} is {found:e}, that of the published case {published:e}")),
    };
    same("the radius in m", radius * metre, CASE.radius * 1e-3)?;
    same("the load in N/m", run.load()? * pascal * metre, CASE.load * 1e3)?;
    same("the contact modulus in Pa", run.half_space()?.0 * pascal, CASE.modulus() * 1e6)?;
    let cycles: f64 = plan.blocks.iter().filter(|block| block.cycle).map(|block| block.count as f64).sum();
    if depths(cycles).is_none() {
        let known: Vec<String> = mccoll::FLAT_DEPTHS.iter().map(|(cycles, _)| cycles.to_string()).collect();
        return Err(format!("it has {cycles} cycles, expected one of {}", known.join(", ")));
    }
    let worn = rate.dose(plan, loading::end(plan)) * metre / pascal;
    same("the wear per pressure in m/Pa", worn, CASE.wear_per_pressure(cycles) * 1e-9)?;
    let share = plan.share.ok_or("`law.share` does not say which part of the wear is the flat's")?[0];
    same("the flat's share of the wear", share, CASE.flat_share())
}

/// What was published after so many cycles.
pub(super) fn answer(run: &Coupled<'_>, cycles: f64) -> Result<Published, Reason> {
    let metre = run.plan.sizes.metre;
    let share = run.plan.share.map_or(1.0, |share| share[0]);
    let Some((computed, measured)) = depths(cycles) else {
        return Err(format!("the run ended after {cycles} cycles, of which nothing is published"));
    };
    let length = |micrometres: f64| micrometres * 1e-6 / metre;
    Ok(Published { computed: length(computed), measured: measured.map(length), share })
}

/// Computed and measured depth after a number of cycles; micrometres.
fn depths(cycles: f64) -> Option<(f64, Option<f64>)> {
    let whole = cycles.round();
    let computed = mccoll::flat_depth(whole as u64).filter(|_| (cycles - whole).abs() < 1e-6 * whole)?;
    Some((computed, (whole == 18_000.0).then_some(mccoll::MEASURED_DEPTH)))
}
