//! Normals, tangents, speeds and lengths of paths at single points.

use std::ops::Range;

use crate::law::Values;
use crate::solve::source::{Rate, value};

/// The default outward normal of the wearing body, +z.
pub(super) const UP: [f64; 3] = [0.0, 0.0, 1.0];
/// The default first tangent, +x.
pub(super) const ALONG: [f64; 3] = [1.0, 0.0, 0.0];

/// Whether a point is open, sticks or slides, as the ABI numbers it.
pub(super) fn contact_state(pressure: f64, speed: f64) -> i64 {
    use wearlaw_plugin_api::abi::{WL_OPEN, WL_SLIDING, WL_STICK};
    match (pressure > 0.0, speed > 0.0) {
        (false, _) => WL_OPEN,
        (true, false) => WL_STICK,
        (true, true) => WL_SLIDING,
    }
}

/// The unit normal at a point; +z where the scene gives none.
pub(super) fn normal_at(components: &[Values<'_>; 3], i: usize) -> [f64; 3] {
    if components[0] == Values::Absent {
        return UP;
    }
    let n = [0, 1, 2].map(|k| value(&components[k], i));
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    n.map(|x| x / length)
}

/// The first tangent at a normal n: +x made perpendicular to n, or +y where n points along x.
pub(super) fn tangent(n: [f64; 3]) -> [f64; 3] {
    let axis = if n[0].abs() < 0.9 { ALONG } else { [0.0, 1.0, 0.0] };
    let dot: f64 = (0..3).map(|k| axis[k] * n[k]).sum();
    let t = [0, 1, 2].map(|k| axis[k] - dot * n[k]);
    let length = t.iter().map(|x| x * x).sum::<f64>().sqrt();
    t.map(|x| x / length)
}

/// Length of the path with a velocity that goes linearly from `v` to `w` in `dt`, through zero or not.
pub(super) fn path(v: f64, w: f64, dt: f64) -> f64 {
    if v * w < 0.0 { dt * (v * v + w * w) / (2.0 * (w - v).abs()) } else { 0.5 * (v.abs() + w.abs()) * dt }
}

/// The size of a velocity from its components.
pub(super) fn speed_of<'b>(velocity: &[Values<'_>; 3], points: usize, room: &'b mut Vec<f64>) -> Values<'b> {
    let at = |i: usize| {
        let [u, v, w] = [0, 1, 2].map(|k| value(&velocity[k], i));
        u.hypot(v).hypot(w)
    };
    if velocity.iter().all(|values| matches!(values, Values::Uniform(_))) {
        return Values::Uniform(at(0));
    }
    room.clear();
    room.extend((0..points).map(at));
    Values::PerPoint(room)
}

/// The size of a velocity from the rates of the slip components, at the points of a range.
pub(super) fn speeds<'b>(
    slip: &[Rate<'_>; 3],
    range: Range<usize>,
    [a, b, c]: [&mut Vec<f64>; 3],
    room: &'b mut Vec<f64>,
) -> Values<'b> {
    let velocity = [slip[0].at(range.clone(), a), slip[1].at(range.clone(), b), slip[2].at(range.clone(), c)];
    speed_of(&velocity, range.len(), room)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_through_zero_count_both_ways() {
        assert_eq!(path(1.0, 3.0, 2.0), 4.0);
        assert_eq!(path(-1.0, 1.0, 2.0), 1.0);
        assert_eq!(path(-1.0, 3.0, 4.0), 0.5 + 4.5);
    }

    #[test]
    fn tangents_are_unit_and_in_the_surface() {
        for n in [UP, [0.6, 0.0, 0.8], [1.0, 0.0, 0.0]] {
            let t = tangent(n);
            let (length, dot): (f64, f64) = (t.iter().map(|x| x * x).sum(), (0..3).map(|k| t[k] * n[k]).sum());
            assert!((length - 1.0).abs() < 1e-15 && dot.abs() < 1e-15, "{n:?} {t:?}");
        }
    }
}
