//! The limit of wear around a stick zone, in one backward-Euler step of huge size.

use crate::solved::Solved;
use crate::{norm, run};

fn limit(cells: usize) -> Solved {
    limit_in(cells, 1.0, 1e7, 1)
}

/// Reached by a law of some pressure exponent in so many equal steps of a slip that lasts so long.
fn limit_in(cells: usize, exponent: f64, duration: f64, substeps: u32) -> Solved {
    let coefficient = 1e-14 * 1e9_f64.powf(1.0 - exponent);
    run(&format!(
        "[law]\nuse = \"archard\"\nconstants = [{coefficient:e}, 1.0, {exponent:.1}, 1.0]\n\
         [contact]\nmodel = \"halfspace\"\nmodulus = 115e9\n\
         [grid]\nsize = [2.8e-4, 2.8e-4]\ncells = [{cells}, {cells}]\n\
         [surface]\nshape = \"sphere\"\nradius = 10e-3\ncenter = [1.4e-4, 1.4e-4]\n\
         [[step]]\nduration = {duration:e}\napproach = 1e-6\nvelocity = 1.0\nstick = 5e-5\n\
         [integrator]\nmethod = \"implicit-euler\"\nsubsteps = {substeps}\n[reference]\nkind = \"stick-limit\"\n"
    ))
}

#[test]
fn one_step_reaches_the_limit() {
    // Cells of a0/20, a0 = 0.1 mm; the apex on a corner, where as many cells stick as the zone has area.
    let solved = limit(56);
    let last = *solved.record.history.last().expect("rows");
    let load = last.load.expect("a load");
    assert!((load / 10.54166666667 - 1.0).abs() < 0.02, "{load}");
    assert!(norm(&solved, "load_relative") < 0.02 && norm(&solved, "value") < 0.04, "{:?}", solved.error);
    assert!(norm(&solved, "contact_radius_cells") < 1.0, "{:?}", solved.error);
    assert!((last.max_wear_depth / 2.965494774432e-7 - 1.0).abs() < 0.04, "{:e}", last.max_wear_depth);
    // What slips carries next to nothing.
    let slipping = |cell: usize| ((cell % 56) as f64 - 27.5).hypot((cell / 56) as f64 - 27.5) * 5e-6 >= 5e-5;
    let carried = (0..56 * 56).filter(|cell| slipping(*cell)).map(|cell| solved.record.pressure[cell]).sum::<f64>();
    assert!(carried < 1e-4 * solved.record.pressure.iter().sum::<f64>(), "{carried:e}");
}

/// There the slipping cells carry so little that the complementarity error alone would take the pressures of the step
/// before, and with them all of its wear once more.
#[test]
fn further_steps_of_any_length_wear_nothing_more() {
    let once = limit(28);
    for (m, duration, substeps) in [
        (1.0, 1e7, 5),
        (1.0, 1e10, 2),
        (1.0, 1e14, 5),
        (1.0, 1e25, 2),
        (1.0, 1e25, 5),
        (0.5, 1e10, 5),
        (1.5, 1e14, 5),
        (2.0, 1e18, 5),
    ] {
        let again = limit_in(28, m, duration, substeps);
        let all = once.record.wear.iter().zip(&again.record.wear);
        let most = all.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(most < 1e-5 * 2.965e-7, "m = {m}, {substeps} steps, {duration:e} s: {most:e}");
    }
}

#[test]
fn the_error_of_the_limit_falls_with_the_cells() {
    let [coarse, fine] = [28, 56].map(|cells| norm(&limit(cells), "value"));
    assert!(coarse > 1.3 * fine, "{coarse:e}, {fine:e}");
}
