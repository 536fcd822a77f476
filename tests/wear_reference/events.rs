//! Pressure and velocity through zero, jumps, and temperatures that pass the points of a table.

use crate::solved::{Case, archard, near};

const TIGHT: &str = "[integrator]\ntolerance = 1e-12\n";

#[test]
fn velocity_through_zero_counts_by_its_size() {
    for (n, sign) in [(1.0, 1.0), (0.3, -1.0), (2.5, 1.0)] {
        let csv = format!(
            "time,point,pressure,velocity\n0,0,1e6,{}\n0,1,1e6,{}\n4,0,1e6,{}\n4,1,1e6,{}\n",
            0.1, 0.3, -0.3, 0.1
        );
        let law = format!("constants = [1e-4, {}, 1, {n}]", sign * 1e9 * sign);
        let case = Case::history(&law, &csv, &format!("{TIGHT}[reference]\nkind = \"archard-prescribed\"\n"));
        let solved = case.solve(&archard());
        // From 0.1 to -0.3 in 4 at slope -0.1, through zero at t = 1.
        let integral = |v: f64| v.powf(n + 1.0) / (n + 1.0);
        near(solved.record.wear[0], 1e-7 * (integral(0.1) + integral(0.3)) / 0.1, 1e-12);
        near(solved.record.wear[1], 1e-7 * (integral(0.3) - integral(0.1)) / 0.05, 1e-12);
        assert!(solved.error.expect("a reference was named").value < 1e-12);
        // Both points have slid: 0.05 + 0.45 and 0.8.
        near(solved.record.history.last().expect("rows").sliding_distance, 0.8, 1e-14);
    }
}

#[test]
fn wear_is_unchanged_to_the_bit_while_a_point_is_open() {
    for (m, accuracy) in [(1.0, TIGHT), (1.7, TIGHT), (0.4, TIGHT), (1.7, "[integrator]\nsubsteps = 7\n")] {
        let csv = "time,point,pressure,velocity\n0,0,3e6,0.2\n1,0,-1e6,0.2\n2,0,-5e5,0.4\n3,0,1e6,0.2\n";
        let law = format!("constants = [1e-4, 1e9, {m}, 1]");
        let solved = Case::history(&law, csv, accuracy).solve(&archard());
        let rows = &solved.record.history.rows;
        // Open from 0.75, on the way down, to 2 + 1/3, on the way up.
        let open: Vec<f64> =
            rows.iter().filter(|row| row.time > 0.7499 && row.time < 2.3334).map(|row| row.max_wear_depth).collect();
        assert!(open.len() > 3 && open[0] > 0.0, "{m}: {open:?}");
        assert!(open.iter().all(|depth| depth.to_bits() == open[0].to_bits()), "{m}: {open:?}");
        let down = 1e-13 * 0.2 * (3e6_f64).powf(m + 1.0) / (m + 1.0) / 4e6;
        if accuracy == TIGHT {
            near(open[0], down, 1e-12);
        }
        assert!(rows.last().expect("rows").max_wear_depth > open[0]);
        assert!(rows.iter().any(|row| (row.time - 0.75).abs() < 1e-12), "lift-off is an event");
    }
}

#[test]
fn a_repeated_time_is_a_jump() {
    let csv = "time,point,pressure,velocity\n0,0,1e6,0.2\n1,0,1e6,0.2\n1,0,5e6,0.4\n3,0,5e6,0.4\n";
    let solved = Case::history("constants = [1e-4, 1e9, 2, 1]", csv, TIGHT).solve(&archard());
    near(solved.record.wear[0], 1e-13 * (1e12 * 0.2 + 2.0 * 25e12 * 0.4), 1e-14);
    near(solved.record.history.last().expect("rows").sliding_distance, 1.0, 1e-15);
    assert!(solved.record.history.rows.windows(2).all(|pair| pair[0].time < pair[1].time));
}

/// A slip that jumps runs no path in no time.
#[test]
fn slip_counts_by_its_path_and_not_by_its_jumps() {
    let csv = "time,point,pressure,slip\n0,0,1e6,0\n1,0,1e6,3e-3\n1,0,1e6,9e-3\n2,0,1e6,8e-3\n4,0,1e6,8e-3\n";
    let solved = Case::history("constants = [1e-4, 1e9, 1, 1]", csv, TIGHT).solve(&archard());
    near(solved.record.wear[0], 1e-7 * 4e-3, 1e-14);
    near(solved.record.history.last().expect("rows").sliding_distance, 4e-3, 1e-14);
}

#[test]
fn slip_vectors_count_by_their_length() {
    let csv = "time,point,pressure,slip_x,slip_y\n0,0,1e6,0,0\n1,0,1e6,3e-3,4e-3\n2,0,1e6,0,0\n";
    let solved = Case::history("constants = [1e-4, 1e9, 1, 1]", csv, TIGHT).solve(&archard());
    near(solved.record.wear[0], 1e-7 * 1e-2, 1e-14);
}

/// K is 1e-4 up to 100, 5e-4 from 300 on; a point that goes from 0 to 400 bends at both.
#[test]
fn temperatures_that_pass_points_of_the_table_are_events() {
    let csv = "time,point,pressure,velocity,temperature\n0,0,1e6,0.2,0\n4,0,1e6,0.2,400\n";
    let law = "[[law.table]]\ntemperature = 100\nconstants = [1e-4, 1e9, 1, 1]\n\
               [[law.table]]\ntemperature = 300\nconstants = [5e-4, 1e9, 1, 1]";
    let solved = Case::history(law, csv, TIGHT).solve(&archard());
    near(solved.record.wear[0], 1e-3 * 0.2 * (1e-4 + 2.0 * 3e-4 + 5e-4), 1e-14);
    assert_eq!(solved.record.cost.rejected_steps, 0, "both bends are ends of pieces");
}

/// Time and temperature together: bilinear in the grid, (1 + t)(1 + T) at unit spacing.
#[test]
fn tables_over_time_and_temperature_are_bilinear() {
    let csv = "time,point,pressure,velocity,temperature\n0,0,1,1,0\n0,1,1,1,1\n0,2,1,1,0.25\n\
               1,0,1,1,1\n1,1,1,1,0\n1,2,1,1,0.25\n";
    let rows = [(0, 0, 1), (0, 1, 2), (1, 0, 2), (1, 1, 4)];
    let law: String = rows
        .map(|(t, k, c)| format!("[[law.table]]\ntime = {t}\ntemperature = {k}\nconstants = [{c}, 1, 1, 1]\n"))
        .concat();
    let wear = Case::history(&law, csv, TIGHT).wear();
    // Integrals over 0..1 of (1 + t)^2, (1 + t)(2 - t) and 1.25 (1 + t).
    for (wear, exact) in wear.iter().zip([7.0 / 3.0, 13.0 / 6.0, 1.875]) {
        near(*wear, exact, 1e-13);
    }
}
