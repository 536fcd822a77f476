//! Laws that remember, that want shorter substeps, or that wear by friction work.

use crate::laws::{ByDistance, Impatient, ImpatientRate, RunningIn, RunningInFirstOrder, Slowing, Work};
use crate::solved::{Case, memory, near};
use wearlaw::record::End;

/// Pressure up, velocity there and back: p = 1e6 (1 + t), v = 0.1 (1 - t), over two time units.
const SWING: &str = "time,point,pressure,velocity\n0,0,1e6,0.1\n0,1,2e6,0.1\n2,0,3e6,-0.1\n2,1,2e6,-0.1\n";
const RUNNING_IN: &str = "constants = [1e-12, 1e-13, 0.04]";

/// The integral of p K(x) |v| over time for the first point, by a fine rule of its own.
fn running_in_swing() -> f64 {
    let steps = 400_000;
    let h = 2.0 / f64::from(steps);
    let middle = |k: u32| {
        let t = h * (f64::from(k) + 0.5);
        // Distance: 0.1 (t - t^2 / 2) until t = 1, then on by the same back.
        let there = |t: f64| 0.1 * (t - 0.5 * t * t);
        let x = if t < 1.0 { there(t) } else { 0.1 - there(t) };
        1e6 * (1.0 + t) * (1e-13 + 9e-13 * (-x / 0.04).exp()) * 0.1 * (1.0 - t).abs()
    };
    (0..steps).map(middle).sum::<f64>() * h
}

#[test]
fn running_in_meets_its_exact_integral_at_constant_pressure() {
    // The second point keeps 2e6 and slides 0.05 + 0.05.
    let exact = 2e6 * (1e-13 * 0.1 + 9e-13 * 0.04 * (1.0 - (-0.1_f64 / 0.04).exp()));
    for accuracy in ["tolerance = 1e-3", "substeps = 1", "substeps = 5"] {
        let rest = format!("[integrator]\n{accuracy}\n");
        let record = Case::history(RUNNING_IN, SWING, &rest).solve(&memory::<RunningIn>(None)).record;
        near(record.wear[1], exact, 1e-13);
        near(record.state[1], 0.1, 1e-14);
    }
}

#[test]
fn error_control_meets_its_tolerance_with_a_memory() {
    let exact = [running_in_swing(), 2e6 * (1e-13 * 0.1 + 9e-13 * 0.04 * (1.0 - (-0.1_f64 / 0.04).exp()))];
    for exponent in 2..=7 {
        let tolerance = 10.0_f64.powi(-exponent);
        let rest = format!("[integrator]\ntolerance = {tolerance:e}\n");
        let case = Case::history(RUNNING_IN, SWING, &rest);
        let smooth = case.solve(&memory::<RunningIn>(None));
        let rough = (exponent <= 5).then(|| case.solve(&memory::<RunningInFirstOrder>(None)));
        for solved in [Some(smooth), rough].into_iter().flatten() {
            let wear = &solved.record.wear;
            let error = (wear[0] - exact[0]).hypot(wear[1] - exact[1]) / exact[0].hypot(exact[1]);
            let estimate = solved.record.estimated.wear_l2_relative.expect("an estimate");
            assert!(error <= tolerance && estimate <= tolerance, "{tolerance:e}: {error:e}, estimated {estimate:e}");
        }
    }
}

/// The middle of each substep gives second order, its start and its end first.
#[test]
fn whole_substeps_converge_with_their_order() {
    for (method, order) in [("auto", 2.0), ("explicit-euler", 1.0), ("implicit-euler", 1.0)] {
        let errors = [16, 32, 64].map(|substeps| {
            let rest = format!(
                "[[step]]\nduration = 1\npressure = 3e6\nvelocity = 0.1\nramp = [\"pressure\"]\n\
                 [integrator]\nmethod = \"{method}\"\nsubsteps = {substeps}\n"
            );
            let wear = Case::steps(RUNNING_IN, &rest).solve(&memory::<RunningIn>(None)).record.wear[0];
            // The integral of 3e6 t K(0.1 t) 0.1 dt over 0..1.
            let a = 0.1_f64 / 0.04;
            let exact = 3e5 * (1e-13 / 2.0 + 9e-13 * (1.0 - (1.0 + a) * (-a).exp()) / (a * a));
            (wear / exact - 1.0).abs()
        });
        for pair in errors.windows(2) {
            let found = (pair[0] / pair[1]).log2();
            assert!((found - order).abs() < 0.15, "{method}: {found} from {errors:?}");
        }
    }
}

#[test]
fn a_memory_goes_on_from_cycle_to_cycle() {
    let rest = "[[cycle]]\ncount = 6\n[integrator]\ntolerance = 1e-8\n";
    let record = Case::history(RUNNING_IN, SWING, rest).solve(&memory::<RunningIn>(None)).record;
    near(record.state[1], 0.6, 1e-13);
    near(record.wear[1], 2e6 * (1e-13 * 0.6 + 9e-13 * 0.04 * (1.0 - (-0.6_f64 / 0.04).exp())), 1e-12);
}

#[test]
fn accumulated_wear_and_slip_reach_the_law() {
    let rest = "[[step]]\nduration = 2\npressure = 1e6\nvelocity = 0.1\n[integrator]\ntolerance = 1e-6\n";
    let wear = Case::steps("constants = [1e-12, 1e-7]", rest).solve(&memory::<Slowing>(None)).record.wear[0];
    // w + w^2 / 2d = 2e-7 with d = 1e-7.
    near(wear, 1e-7 * (5.0_f64.sqrt() - 1.0), 1e-6);
    let record = Case::history("constants = [1e-3]", SWING, "[integrator]\ntolerance = 1e-4\n")
        .solve(&memory::<ByDistance>(None))
        .record;
    near(record.wear[0], 1e-3 * 0.1 * 0.1 / 2.0, 1e-12);
}

#[test]
fn friction_work_is_the_path_integral_of_the_shear() {
    // |v| p mu over time for the swing: 0.1 * 1e6 * integral of (1 + t)|1 - t| = 0.1 * 1e6 * 2.
    let by_coefficient =
        Case::history("constants = [1e-13]", SWING, "friction = 0.3\n[integrator]\ntolerance = 1e-12\n");
    let wear = by_coefficient.solve(&memory::<Work>(None)).record.wear;
    near(wear[0], 1e-13 * 0.3 * 0.1 * 1e6 * 2.0, 1e-12);
    near(wear[1], 1e-13 * 0.3 * 2e6 * 0.1, 1e-12);
    // Shear from -2e5 through zero to 6e5 over unit time at speed 0.2: the mean of its size is 2.5e5.
    let csv = "time,point,pressure,slip,shear\n0,0,1e6,0,-2e5\n1,0,1e6,-0.2,6e5\n";
    for accuracy in ["tolerance = 1e-12", "tolerance = 1e-5"] {
        let case = Case::history("constants = [1e-13]", csv, &format!("[integrator]\n{accuracy}\n"));
        near(case.solve(&memory::<Work>(None)).record.wear[0], 1e-13 * 2.5e5 * 0.2, 1e-5);
    }
    // A coefficient for each point that rises in time: |v| p mu of 0.1 * 1e6 * the mean of mu.
    let csv = "time,point,pressure,velocity,friction\n0,0,1e6,0.1,0.2\n0,1,1e6,0.1,0\n2,0,1e6,0.1,0.4\n2,1,1e6,0.1,0\n";
    let case = Case::history("constants = [1e-13]", csv, "[integrator]\ntolerance = 1e-12\n");
    let wear = case.solve(&memory::<Work>(None)).record.wear;
    near(wear[0], 1e-13 * 1e5 * 0.3 * 2.0, 1e-12);
    assert_eq!(wear[1], 0.0);
    // A ramp of the coefficient.
    let ramp = "[[step]]\nduration = 1\npressure = 1e6\nvelocity = 0.1\nfriction = 0.4\nramp = [\"friction\"]\n";
    let wear = Case::steps("constants = [1e-13]", ramp).solve(&memory::<Work>(None)).record.wear[0];
    near(wear, 1e-13 * 0.2 * 1e5, 1e-12);
}

#[test]
fn a_law_that_wants_shorter_substeps_gets_them() {
    let rest =
        |accuracy: &str| format!("[[step]]\nduration = 2\npressure = 1e6\nvelocity = 0.1\n[integrator]\n{accuracy}\n");
    let laws = [memory::<Impatient>(None), memory::<ImpatientRate>(None)];
    for law in &laws {
        for accuracy in ["tolerance = 1e-6", "substeps = 1", "tolerance = 1e-6\nsmallest_step = 1e-4"] {
            let record = Case::steps("constants = [1e-12, 0.003]", &rest(accuracy)).solve(law).record;
            near(record.wear[0], 2e-7, 1e-12);
            let longest = record.largest_step;
            assert!(longest <= 0.00301 && longest > 0.0005 && record.cost.rejected_steps > 0, "{longest}");
        }
        let refused = Case::steps("constants = [1e-12, 0.003]", &rest("tolerance = 1e-6\nsmallest_step = 0.01"));
        let record = refused.end(law).record;
        let End::Failed(error) = &record.end else { panic!("{:?}", record.end) };
        let text = error.to_string();
        assert!(text.contains("smallest step") && text.contains("1e-2"), "{text}");
    }
}

/// Substeps between two events have a largest number, whatever asks for more.
#[test]
fn no_more_substeps_are_taken_than_are_allowed() {
    let rest = |most: u64, accuracy: &str| {
        format!(
            "[[step]]\nduration = 1\npressure = 1e6\nvelocity = 0.1\n\
             [integrator]\n{accuracy}\nmost_substeps = {most}\n"
        )
    };
    let laws = [memory::<Impatient>(None), memory::<ImpatientRate>(None)];
    for law in &laws {
        // To a tolerance a steady load step is gone through in 64 pieces, which are events like others.
        for (accuracy, few) in [("substeps = 1", 20), ("substeps = 2", 20), ("tolerance = 1e-6", 4)] {
            let case = |most| Case::steps("constants = [1e-12, 0.003]", &rest(most, accuracy));
            near(case(2000).solve(law).record.wear[0], 1e-7, 1e-12);
            let End::Failed(error) = case(few).end(law).record.end else { panic!("{accuracy}") };
            let text = error.to_string();
            assert!(text.contains(&format!("expected at most {few} (`integrator.most_substeps`)")), "{text}");
        }
    }
}

/// A failed run keeps what it had done.
#[test]
fn a_wish_that_cannot_be_met_keeps_what_was_done() {
    let rest = "[[step]]\nduration = 1\npressure = 1e6\nvelocity = 0.1\n\
                [[step]]\nduration = 1\npressure = 2e6\nvelocity = 0.1\n[integrator]\nsubsteps = 1\nsmallest_step = 0.5\n";
    let law = "[[law.table]]\ntime = 1\nconstants = [1e-12, 3]\n[[law.table]]\ntime = 1.001\nconstants = [1e-12, 0.1]";
    let record = Case::steps(law, rest).end(&memory::<Impatient>(None)).record;
    assert!(matches!(record.end, End::Failed(_)), "{:?}", record.end);
    let last = record.history.last().expect("rows");
    assert!(last.time >= 1.0 && last.time < 2.0, "{last:?}");
    assert!(record.wear[0] >= 0.999e-7, "{:e}", record.wear[0]);
}
