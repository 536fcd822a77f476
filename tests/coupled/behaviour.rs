//! What a run on a contact does, and what it leaves alone.

use crate::solved::{Case, archard, near};
use wearlaw::record::{End, Record};
use wearlaw::solve::SolveError;

/// A ball on a half-space of 24 by 24 cells.
fn ball(law: &str, contact: &str, step: &str, rest: &str) -> Case {
    Case::text(&format!(
        "[law]\nuse = \"archard\"\nconstants = [1e-13, 1.0, 1.0, 1.0]\n{law}\n\
         [contact]\nmodel = \"halfspace\"\nmodulus = 1.1e11\n{contact}\n\
         [grid]\nsize = [6e-4, 6e-4]\ncells = [24, 24]\n[surface]\nshape = \"sphere\"\nradius = 1e-2\n\
         [[step]]\nduration = 0.02\n{step}\n{rest}"
    ))
}

const LOADED: &str = "load = 20.0\nvelocity = 1.0";

fn run(case: &Case) -> Record<SolveError> {
    case.solve(&archard()).record
}

#[test]
fn the_worn_volume_is_that_of_the_load_at_any_step() {
    // c P t, however long the steps are and whichever way they are taken.
    for rest in [
        "[integrator]\nsubsteps = 1\n",
        "[integrator]\nsubsteps = 7\nmethod = \"sdirk2\"\n",
        "[integrator]\ntolerance = 1e-2\n",
    ] {
        for contact in ["", "boundary = \"periodic\""] {
            let record = run(&ball("", contact, LOADED, rest));
            let last = record.history.last().expect("rows");
            near(last.wear_volume.expect("a volume"), 1e-13 * 20.0 * 0.02, 1e-12);
            near(last.load.expect("a load"), 20.0, 1e-14);
            assert!(record.pressure.iter().all(|pressure| *pressure >= 0.0));
        }
    }
}

#[test]
fn tolerance_is_kept_against_many_more_steps() {
    for tolerance in ["1e-2", "1e-3"] {
        let rest = format!("[integrator]\ntolerance = {tolerance}\n[reference]\nkind = \"self\"\n");
        let solved = ball("", "", LOADED, &rest).solve(&archard());
        let (error, estimate) =
            (solved.error.expect("a reference"), solved.record.estimated.wear_l2_relative.expect("an estimate"));
        let asked: f64 = tolerance.parse().expect("a number");
        assert!(error.value <= asked && estimate <= asked, "{tolerance}: {} {estimate}", error.value);
        assert!(error.by_field["pressure_l2_relative"] < 0.1, "{:?}", error.by_field);
    }
}

#[test]
fn post_solves_a_steady_contact_once_and_wears_without_moving() {
    let record = run(&ball("mode = \"post\"", "", LOADED, "[integrator]\nsubsteps = 5\n"));
    assert_eq!(record.cost.contact_solves, 1);
    let first = record.history.rows[0];
    let last = record.history.last().expect("rows");
    assert_eq!((first.max_pressure, first.approach), (last.max_pressure, last.approach));
    near(last.max_wear_depth, 1e-13 * first.max_pressure * 0.02, 1e-12);
}

#[test]
fn keys_of_no_effect_cost_nothing() {
    let plain = ball("", "", LOADED, "[integrator]\nsubsteps = 3\n");
    let base = run(&plain);
    let extra = [
        ball("", "friction = 0.3", LOADED, "[integrator]\nsubsteps = 3\n"),
        ball("", "", &format!("{LOADED}\ntemperature = 20.0"), "[integrator]\nsubsteps = 3\n"),
        ball("", "", &format!("{LOADED}\nstick = 0.0"), "[integrator]\nsubsteps = 3\n"),
        ball("share = [0.5, 0.5]", "", LOADED, "[integrator]\nsubsteps = 3\n[scaling]\nkind = \"none\"\n"),
    ];
    let counters = |record: &Record<SolveError>| {
        let cost = record.cost;
        let memory: u64 = record.memory.iter().map(|line| line.bytes).sum();
        (
            cost.steps,
            cost.law_calls,
            cost.points_evaluated,
            cost.contact_solves,
            cost.contact_iterations,
            cost.fft_pairs,
            memory,
        )
    };
    for case in extra {
        let record = run(&case);
        assert_eq!(counters(&record), counters(&base));
        assert_eq!(record.wear, base.wear);
    }
}

#[test]
fn nothing_slips_within_the_stick_radius() {
    let record = run(&ball("", "", &format!("{LOADED}\nstick = 4e-5"), "[integrator]\nsubsteps = 2\n"));
    let geometry = &record.geometry;
    let mut worn = 0;
    for (cell, wear) in record.wear.iter().enumerate() {
        let [x, y, _] = geometry.coordinates(cell).expect("cells have centres");
        // The apex lies on the centre of cell 12.
        let radius = (x - 12.5 * 2.5e-5).hypot(y - 12.5 * 2.5e-5);
        assert!(radius >= 4e-5 || *wear == 0.0, "{radius:e}: {wear:e}");
        worn += usize::from(*wear > 0.0);
    }
    assert!(worn > 10, "{worn}");
}

/// ||a - b|| / ||b||.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>().sqrt();
    norm(&mut a.iter().zip(b).map(|(a, b)| a - b)) / norm(&mut b.iter().copied())
}

#[test]
fn averaging_wears_the_contact_alike_and_what_touches_beside_it_no_more() {
    for contact in ["", "boundary = \"periodic\""] {
        let steps =
            |count: u32| run(&ball("average = true", contact, LOADED, &format!("[integrator]\nsubsteps = {count}\n")));
        let record = steps(1);
        let deepest = record.wear.iter().fold(0.0, |most: f64, wear| most.max(*wear));
        let (mut inside, mut beside) = (0, 0);
        for (wear, pressure) in record.wear.iter().zip(&record.pressure) {
            assert!(if *pressure > 0.0 { *wear == deepest } else { *wear < deepest }, "{wear:e} of {deepest:e}");
            inside += usize::from(*pressure > 0.0);
            beside += usize::from(*pressure == 0.0 && *wear > 0.0);
        }
        assert!(inside > 10 && beside > 10, "{inside} {beside}");
        near(record.history.last().expect("rows").wear_volume.expect("a volume"), 1e-13 * 20.0 * 0.02, 1e-12);
        // Under a steady load nothing is left to the length of the steps.
        assert!(apart(&steps(60).wear, &record.wear) < 1e-6, "{:e}", apart(&steps(60).wear, &record.wear));
    }
}

#[test]
fn averaging_under_a_held_approach_is_of_first_order_and_keeps_its_tolerance() {
    let held = |rest: &str| run(&ball("average = true", "", "approach = 1e-6\nvelocity = 1.0", rest));
    let fine = held("[integrator]\nsubsteps = 640\n");
    let error = |substeps: u32| apart(&held(&format!("[integrator]\nsubsteps = {substeps}\n")).wear, &fine.wear);
    let (coarse, finer) = (error(5), error(40));
    assert!(finer < 0.25 * coarse && coarse < 0.2, "{coarse:e} {finer:e}");
    let kept = held("[integrator]\ntolerance = 1e-3\n");
    assert!(apart(&kept.wear, &fine.wear) < 2e-3 && kept.cost.steps < 2000, "{} steps", kept.cost.steps);
}

#[test]
fn nodal_tractions_leave_a_contact_at_the_end_of_every_step() {
    let law = "basis = \"nodal-stress\"";
    let steps = |count: u32| run(&ball(law, "", LOADED, &format!("[integrator]\nsubsteps = {count}\n")));
    let fine = steps(320);
    let [coarse, finer] = [20, 80].map(|count| apart(&steps(count).wear, &fine.wear));
    assert!(finer < 0.5 * coarse && coarse < 5e-2, "{coarse:e} {finer:e}");
    // One solve a stage: none to put right what the neighbours of the contact have worn.
    assert!(fine.cost.contact_solves < 2 * 320 + 30, "{}", fine.cost.contact_solves);
}

#[test]
fn a_chequerboard_fades_under_nodal_tractions() {
    let record = run(&ball(
        "basis = \"nodal-stress\"",
        "",
        LOADED,
        "[integrator]\nmethod = \"implicit-euler\"\nsubsteps = 20\n",
    ));
    let at = |i: usize, j: usize| record.pressure[j * 24 + i];
    let ripple = (at(11, 12) + at(13, 12) - 2.0 * at(12, 12)).abs() / at(12, 12);
    assert!(ripple < 0.2 && at(12, 12) > 0.0, "{ripple}");
    assert!(record.history.last().expect("rows").wear_volume.expect("a volume") < 1e-13 * 20.0 * 0.02);
}

#[test]
fn a_run_stops_at_the_depth_that_is_asked_for() {
    let rest = "[integrator]\ntolerance = 1e-3\n[stop]\nwear_depth = 1e-7\n";
    let record = ball("", "", LOADED, rest).end(&archard()).record;
    let End::Stopped(reason) = &record.end else { panic!("{:?}", record.end) };
    let last = record.history.last().expect("rows");
    assert!(reason.contains("wear_depth") && last.max_wear_depth >= 1e-7 && last.time < 0.02, "{reason} {last:?}");
    let deepest = record.wear.iter().fold(0.0, |most: f64, wear| most.max(*wear));
    assert_eq!(deepest, last.max_wear_depth);
}

#[test]
fn a_contact_over_all_of_the_rim_ends_the_run() {
    let over = ball("", "", "load = 2e5\nvelocity = 1.0", "[integrator]\nsubsteps = 1\n").end(&archard()).record;
    let End::Failed(error) = over.end else { panic!("{:?}", over.end) };
    assert!(error.to_string().contains("covers all of the grid's rim"), "{error}");
}

#[test]
fn lifting_off_and_touching_again_leaves_wear_as_it_was() {
    let rest = "[[step]]\nduration = 0.01\nload = 0.0\nvelocity = 1.0\n[integrator]\nsubsteps = 2\n";
    let once = run(&ball("", "", LOADED, "[integrator]\nsubsteps = 2\n"));
    let lifted = run(&ball("", "", LOADED, rest));
    assert_eq!(once.wear, lifted.wear);
    assert!(lifted.pressure.iter().all(|pressure| *pressure == 0.0));
}

/// A contact that takes over the grid within a step takes in more cells than the law was asked at: it is not the law's fault.
#[test]
fn a_contact_that_grows_far_beyond_the_cells_that_were_asked_accuses_no_law() {
    let case = Case::text(
        "[law]\nuse = \"archard\"\nconstants = [1e-14, 1.0, 1.0, 1.0]\n[contact]\nmodel = \"halfspace\"\nmodulus = 1e11\n\
         [grid]\nsize = [3.861649e-4, 3.861649e-4]\ncells = [24, 24]\n[surface]\nshape = \"cone\"\nangle = 1.0\n\
         [[step]]\nduration = 1.26577e4\nload = 0.1062627\nvelocity = 1.0\n\
         [[step]]\nduration = 4.487243e9\nload = 0.1642956\nvelocity = 1.0\nstick = 2.340186e-5\n\
         [integrator]\ntolerance = 2.4592e-4\n",
    );
    let ended = case.end(&archard()).record.end;
    let End::Failed(error) = ended else { panic!("{ended:?}") };
    assert!(error.to_string().contains("the contact covers all of the grid's rim"), "{error}");
}
