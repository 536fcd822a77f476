//! Load steps, ramps, cycles, early stops and references.

use crate::solved::{Case, archard, near};
use wearlaw::record::End;

const TIGHT: &str = "[integrator]\ntolerance = 1e-12\n";
const LINEAR: &str = "constants = [1e-4, 1e9, 1, 1]";

fn depth(law: &str, rest: &str) -> f64 {
    Case::steps(law, &format!("{rest}{TIGHT}")).wear()[0]
}

#[test]
fn ramps_start_from_nothing_and_then_from_the_step_before() {
    let law = "constants = [1e-4, 1e9, 2, 0.5]";
    let first = "[[step]]\nduration = 3\npressure = 4e6\nvelocity = 0.25\nramp = [\"pressure\"]\n";
    near(depth(law, first), 1e-13 * 0.5 * 16e12 * 3.0 / 3.0, 1e-12);
    let second = "[[step]]\nduration = 2\npressure = 1e6\nvelocity = 0.25\nramp = [\"pressure\"]\n";
    let down = 1e-13 * 0.5 * (64e18 - 1e18) / 3.0 * (2.0 / 3e6);
    near(depth(law, &format!("{first}{second}")), 1e-13 * 0.5 * 16e12 + down, 1e-12);
    // Velocity from 0.25 through zero to -0.75: the speed is what counts.
    let third = "[[step]]\nduration = 4\npressure = 1e6\nvelocity = -0.75\nramp = [\"velocity\"]\n";
    let through = 0.1 * (0.25_f64.powf(1.5) + 0.75_f64.powf(1.5)) / 1.5 / 0.25;
    near(depth(law, &format!("{first}{second}{third}")), 1e-13 * 0.5 * 16e12 + down + through, 1e-12);
}

#[test]
fn cycles_wear_their_count_times_one_pass() {
    let steps = "[[cycle.step]]\nduration = 0.3\npressure = 2e6\nvelocity = 0.1\nramp = [\"pressure\"]\n\
                 [[cycle.step]]\nduration = 0.1\npressure = 0\nvelocity = -0.2\nramp = [\"pressure\"]\n";
    for law in [LINEAR, "constants = [1e-4, 1e9, 1.6, 0.7]"] {
        let one = depth(law, &format!("[[cycle]]\ncount = 1\n{steps}"));
        assert!(one > 0.0);
        for count in [2, 7, 40] {
            near(depth(law, &format!("[[cycle]]\ncount = {count}\n{steps}")), f64::from(count) * one, 1e-12);
        }
    }
}

#[test]
fn a_history_is_a_cycle_too() {
    let csv = "time,point,pressure,velocity\n2,0,1e6,0.1\n3,0,4e6,-0.1\n3.5,0,1e6,0.3\n";
    let pass = |rest: &str| Case::history(LINEAR, csv, &format!("{rest}{TIGHT}")).solve(&archard()).record;
    let (one, many) = (pass(""), pass("[[cycle]]\ncount = 25\n"));
    near(many.wear[0], 25.0 * one.wear[0], 1e-12);
    let last = many.history.last().expect("rows");
    near(last.time, 2.0 + 25.0 * 1.5, 1e-14);
    near(last.sliding_distance, 25.0 * one.history.last().expect("rows").sliding_distance, 1e-12);
}

/// Constants that change over time see the represented time of a later cycle, not the history's.
#[test]
fn tables_go_on_while_a_history_repeats() {
    let law = "[[law.table]]\ntime = 0\nconstants = [1e-4, 1e9, 1, 1]\n\
               [[law.table]]\ntime = 10\nconstants = [3e-4, 1e9, 1, 1]";
    let csv = "time,point,pressure,velocity\n0,0,1e6,0.1\n1,0,1e6,0.1\n";
    let case = Case::history(law, csv, &format!("[[cycle]]\ncount = 12\n{TIGHT}"));
    near(case.wear()[0], 1e-4 * (10.0 * 2e-4 + 2.0 * 3e-4), 1e-12);
}

#[test]
fn a_load_step_may_end_before_the_history() {
    let csv = "time,point,pressure,velocity\n0,0,0,0.1\n4,0,4e6,0.1\n";
    let case = Case::history(LINEAR, csv, &format!("[[step]]\nduration = 1\n[[step]]\nduration = 1.5\n{TIGHT}"));
    near(case.wear()[0], 1e-14 * 1e6 * 2.5 * 2.5 / 2.0, 1e-13);
}

#[test]
fn a_history_of_one_time_lasts_as_long_as_the_load_steps() {
    let csv = "time,point,pressure,velocity\n0,0,1e6,0.1\n0,1,2e6,-0.1\n";
    let case = Case::history(LINEAR, csv, &format!("[[step]]\nduration = 3\n{TIGHT}"));
    let wear = case.wear();
    near(wear[0], 3e-8, 1e-14);
    near(wear[1], 6e-8, 1e-14);
}

#[test]
fn stroke_and_frequency_are_a_constant_speed() {
    let case = depth(LINEAR, "[[step]]\nduration = 2\npressure = 1e6\nstroke = 5e-5\nfrequency = 100\n");
    near(case, 1e-7 * 2.0 * 5e-5 * 100.0 * 2.0, 1e-14);
}

#[test]
fn a_run_stops_early_at_a_depth_or_a_volume_and_says_so() {
    let csv = "time,point,pressure,velocity,area\n0,0,1e6,0.1,2\n0,1,5e5,0.1,3\n10,0,1e6,0.1,2\n10,1,5e5,0.1,3\n";
    // Depths 1e-8 t and 5e-9 t, volume 3.5e-8 t.
    for (stop, time, word) in [("wear_depth = 4e-8", 4.0, "wear_depth"), ("wear_volume = 1.75e-7", 5.0, "wear_volume")]
    {
        let rest = format!("[integrator]\nsubsteps = 80\n[stop]\n{stop}\n");
        let solved = Case::history(LINEAR, csv, &rest).end(&archard());
        let End::Stopped(reason) = &solved.record.end else { panic!("{:?}", solved.record.end) };
        let last = solved.record.history.last().expect("rows");
        assert!(reason.contains(word) && last.time >= time - 1e-9 && last.time <= time + 0.126, "{reason} {last:?}");
        near(last.wear_volume.expect("areas are given"), 3.5e-8 * last.time, 1e-13);
    }
    let never = Case::history(LINEAR, csv, &format!("{TIGHT}[stop]\nwear_depth = 1\n")).solve(&archard());
    assert_eq!(never.record.history.last().expect("rows").time, 10.0);
}

#[test]
fn a_file_or_the_scene_itself_can_be_the_reference() {
    let csv = "time,point,pressure,velocity\n0,4,1e6,0.1\n0,9,2e6,0.1\n1,4,1e6,0.3\n1,9,2e6,0.3\n";
    let law = "constants = [1e-4, 1e9, 1, 0.5]";
    let coarse = "[integrator]\nmethod = \"tr-bdf2\"\nsubsteps = 2\n";
    let exact = 1e-7 * (0.3_f64.powf(1.5) - 0.1_f64.powf(1.5)) / 1.5 / 0.2;
    let by_self = Case::history(law, csv, &format!("{coarse}[reference]\nkind = \"self\"\n")).solve(&archard());
    let truth = by_self.record.wear[0] / exact - 1.0;
    near(by_self.error.expect("a reference was named").value, truth.abs(), 0.01);
    let by_file = Case::history(law, csv, &format!("{coarse}[reference]\nfile = \"r.csv\"\n"));
    by_file.file("r.csv", &format!("# depths\npoint,wear\n9,{:e}\n4,{:e}\n", 2.0 * exact, exact));
    near(by_file.solve(&archard()).error.expect("a reference was named").value, truth.abs(), 1e-9);
}

#[test]
fn the_first_round_of_a_cycle_ramps_from_what_came_before_it() {
    // One second each at 5, from 5 to 1, at 1 and at 1 MPa.
    let steps = "[[step]]\nduration = 1\npressure = 5e6\nvelocity = 1\n[[cycle]]\ncount = 3\n\
                 [[cycle.step]]\nduration = 1\npressure = 1e6\nvelocity = 1\nramp = [\"pressure\"]\n";
    near(depth(LINEAR, steps), 1e-13 * (5e6 + 3e6 + 1e6 + 1e6), 1e-12);
}
