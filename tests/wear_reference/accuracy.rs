//! The numbers of a table in time, and what tolerances and fixed substeps promise.

use crate::solved::{Case, archard, near};

/// K 1e-4 -> 3e-4, H 2e3 -> 1e3 and, where `full`, m 1 -> 1.5, n 1 -> 0.8 over unit time; p = 50, v = 0.2.
fn table(full: bool, duration: f64, rest: &str) -> Case {
    let (m, n) = if full { (1.5, 0.8) } else { (1.0, 1.0) };
    let law = format!(
        "[[law.table]]\ntime = 0\nconstants = [1e-4, 2e3, 1, 1]\n\
         [[law.table]]\ntime = 1\nconstants = [3e-4, 1e3, {m}, {n}]"
    );
    Case::steps(&law, &format!("[[step]]\nduration = {duration}\npressure = 50\nvelocity = 0.2\n{rest}"))
}

const KNOWN: [(bool, f64, f64); 5] = [
    (true, 0.25, 2.3159228768965933e-7),
    (true, 0.5, 8.897_532_828_740_61e-7),
    (true, 1.0, 7.322_799_325_112_124e-6),
    (false, 0.5, 4.3841036225890464e-7),
    (false, 1.0, 1.4657359027997265e-6),
];

#[test]
fn tables_in_time_give_the_depths_that_are_known() {
    for (full, duration, depth) in KNOWN {
        for accuracy in ["tolerance = 1e-13", "substeps = 4"] {
            let case = table(full, duration, &format!("[integrator]\n{accuracy}\n"));
            near(case.wear()[0], depth, 2e-13);
        }
    }
}

#[test]
fn the_reference_of_a_scene_says_the_same() {
    for (full, duration, depth) in KNOWN {
        let rest =
            "[integrator]\nmethod = \"explicit-euler\"\nsubsteps = 8\n[reference]\nkind = \"archard-prescribed\"\n";
        let solved = table(full, duration, rest).solve(&archard());
        let error = solved.error.expect("a reference was named").value;
        near(error, (solved.record.wear[0] / depth - 1.0).abs(), 1e-9);
        assert!(error > 0.01);
    }
}

/// w = p v T {K1 T/H1 + (K0 H1 - K1 H0)/H1^2 ln(1 + H1 T/H0)} / T with K = K0 + K1 t, H = H0 + H1 t, beyond the table too.
#[test]
fn the_closed_form_holds_at_any_time_and_constants_are_held_beyond_the_table() {
    let within = |t: f64| {
        let (k0, k1, h0, h1) = (1e-4, 2e-4, 2e3, -1e3);
        50.0 * 0.2 * (k1 * t / h1 + (k0 * h1 - k1 * h0) / (h1 * h1) * (h1 * t / h0).ln_1p())
    };
    let rest = "[integrator]\ntolerance = 1e-12\n";
    for t in [1e-3, 0.1, 0.77] {
        near(table(false, t, rest).wear()[0], within(t), 1e-11);
    }
    near(table(false, 3.0, rest).wear()[0], within(1.0) + 50.0 * 0.2 * 2.0 * 3e-7, 1e-12);
}

/// Sixty points whose velocity and pressure change sign at different times: more kinks than become events.
fn kinks(rest: &str) -> Case {
    let mut csv = "time,point,pressure,velocity\n".to_owned();
    for (k, time) in [0.0, 1.0, 3.0].into_iter().enumerate() {
        for i in 0..60 {
            let (a, b) = (((i * 17 + k * 29) % 61) as f64, ((i * 23 + k * 41) % 59) as f64);
            csv.push_str(&format!("{time},{i},{},{}\n", 1e4 * (a - 20.0), 0.01 * (b - 29.5)));
        }
    }
    Case::history("constants = [1e-4, 1e9, 0.5, 0.3]", &csv, rest)
}

#[test]
fn the_error_stays_within_the_tolerance_asked_for() {
    for exponent in 1..=12 {
        let tolerance = 10.0_f64.powi(-exponent);
        let rest = format!("[integrator]\ntolerance = {tolerance:e}\n[reference]\nkind = \"archard-prescribed\"\n");
        let mut cases = vec![table(true, 1.0, &rest)];
        cases.extend((exponent <= 8).then(|| kinks(&rest)));
        for case in cases {
            let solved = case.solve(&archard());
            let error = solved.error.expect("a reference was named").value;
            let estimate = solved.record.estimated.wear_l2_relative.expect("an estimate");
            assert!(error <= tolerance && estimate <= tolerance, "{tolerance:e}: {error:e}, estimated {estimate:e}");
        }
    }
}

#[test]
fn named_methods_meet_a_tolerance_too() {
    for (method, smallest) in [("explicit-euler", 3), ("implicit-euler", 3), ("tr-bdf2", 6), ("sdirk2", 6)] {
        for exponent in 1..=smallest {
            let tolerance = 10.0_f64.powi(-exponent);
            let rest = format!(
                "[integrator]\nmethod = \"{method}\"\ntolerance = {tolerance:e}\n[reference]\nkind = \"archard-prescribed\"\n"
            );
            let error = table(true, 1.0, &rest).solve(&archard()).error.expect("a reference was named").value;
            assert!(error <= tolerance, "{method}, {tolerance:e}: {error:e}");
        }
    }
}

#[test]
fn fixed_substeps_converge_with_the_order_of_their_method() {
    let orders = [("explicit-euler", 1.0), ("implicit-euler", 1.0), ("tr-bdf2", 2.0), ("sdirk2", 2.0)];
    for (method, order) in orders {
        let errors = [16, 32, 64, 128].map(|substeps| {
            let rest = format!("[integrator]\nmethod = \"{method}\"\nsubsteps = {substeps}\n");
            let solved = table(true, 1.0, &rest).solve(&archard());
            assert_eq!(solved.record.cost.steps, substeps);
            (solved.record.wear[0] / KNOWN[2].2 - 1.0).abs()
        });
        for pair in errors.windows(2) {
            let found = (pair[0] / pair[1]).log2();
            assert!((found - order).abs() < 0.1, "{method}: order {found} from {errors:?}");
        }
    }
}

#[test]
fn fixed_substeps_without_a_method_keep_a_high_order() {
    let errors = [1, 2].map(|substeps| {
        let case = table(true, 1.0, &format!("[integrator]\nsubsteps = {substeps}\n"));
        (case.wear()[0] / KNOWN[2].2 - 1.0).abs()
    });
    assert!(errors[0] < 1e-7 && errors[1] < 1e-10, "{errors:?}");
}
