//! Results that are numbers and hardly what was meant.

use crate::contact::prescribed::History;
use crate::plan::Plan;
use crate::record::{End, Record};
use crate::scene::{Scene, Shape};

/// A line for each thing about a run that went to its end and that its user should look at.
pub(super) fn oddities<E>(scene: &Scene, plan: &Plan, history: Option<&History>, record: &Record<E>) -> Vec<String> {
    let mut lines = Vec::new();
    let Some(last) = record.history.last() else { return lines };
    if !matches!(record.end, End::Done) {
        return lines;
    }
    let length = plan.units.length.label;
    let depth = last.max_wear_depth;
    if depth == 0.0 {
        lines.push(
            "nothing was worn in the whole run: is there pressure and sliding at the same time, does the law's threshold \
             let it wear, are its constants above 0?"
                .to_owned(),
        );
    }
    let radius = scene.surface.as_ref().and_then(|surface| match surface.shape {
        Shape::Sphere { radius } | Shape::Cylinder { radius } => Some(radius),
        _ => None,
    });
    let size = scene.grid.as_ref().and_then(|grid| grid.size.iter().copied().reduce(f64::max));
    let bounds = [(radius, "the radius of the surface"), (size, "the size of the grid")];
    for (bound, what) in bounds.iter().filter_map(|(bound, what)| Some(((*bound)?, what))) {
        if depth > bound {
            lines.push(format!(
                "the largest wear depth, {depth:e} {length}, is above {what}, {bound:e} {length}: no body is that deep; look \
                 at the units of the constants and the sliding distance"
            ));
            break;
        }
    }
    let is_plain = plan.blocks.iter().all(|block| block.count == 1);
    let end = history.and_then(|history| history.times().last().copied());
    if let Some(end) = end.filter(|end| is_plain && *end > last.time * (1.0 + 1e-9)) {
        let time = plan.units.time.label;
        lines.push(format!(
            "the history goes on to time {end} {time}, the load steps end at {} {time}: its later rows were not used",
            last.time
        ));
    }
    lines
}
