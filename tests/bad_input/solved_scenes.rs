//! Scenes of contact that answers back, with mistakes, and with loads, grids and laws that have no answer.

use super::program::Room;

const BALL: &str = r#"[law]
use = "archard"
constants = [1e-4, 1e9, 1.0, 1.0]
[contact]
model = "halfspace"
dimension = 3
modulus = 115e9
[grid]
size = [4e-4, 4e-4]
cells = [16, 16]
[surface]
shape = "sphere"
radius = 5e-3
[[step]]
duration = 1.0
load = 10.0
velocity = 0.1
[integrator]
tolerance = 1e-3
"#;

/// Changes on the command line, and what the answer has to say, before anything runs.
const REFUSED: &[(&[&str], &[&str])] = &[
    (&["step=[{duration=1,load=1,approach=1e-6,velocity=1}]"], &["`step.0.load` and `step.0.approach`", "one of them"]),
    (&["step=[{duration=1,velocity=1}]"], &["`load` or `approach`", "`step.0`"]),
    (&["step=[{duration=1,load=1}]"], &["velocity"]),
    (&["step.0.load=-1"], &["-1", "`step.0.load`", "not below 0"]),
    (&["step.0.load=nan"], &["NaN", "`step.0.load`", "finite"]),
    (&["step.0.load=inf"], &["inf", "`step.0.load`", "finite"]),
    (&["step.0.stick=-1"], &["-1", "`step.0.stick`"]),
    (&["step.0.velocity=\"none.npy\""], &["none.npy"]),
    (&["grid.cells=[0,16]"], &["found 0", "`grid.cells.0`"]),
    (&["grid.cells=[16]"], &["1 entry", "`grid.cells`", "dimension = 3"]),
    (&["grid.size=[0.0,1.0]"], &["found 0", "`grid.size.0`", "above 0"]),
    (&["grid.cells=[1000000,1000000]"], &["1000000000000 cells", "GB", "this machine"]),
    (&["grid.cells=[2147483648,2147483648]"], &["2147483648", "`grid.cells`", "at most"]),
    (&["contact.modulus=-1"], &["-1", "`contact.modulus`", "above 0"]),
    (&["contact.model=\"foundation\""], &["`contact.modulus`", "`halfspace`"]),
    (&["contact.boundary=\"open\""], &["\"open\"", "`contact.boundary`"]),
    (&["contact.tolerance=0"], &["found 0", "`contact.tolerance`"]),
    (&["surface.radius=0"], &["found 0", "`surface.radius`"]),
    (&["surface={shape=\"file\",file=\"none.csv\"}"], &["none.csv"]),
    (&["surface={shape=\"file\",file=\"small.csv\"}"], &["small.csv", "2", "3", "16"]),
    (&["surface={shape=\"file\",file=\"odd.csv\"}"], &["odd.csv", "line 2"]),
    (&["integrator.method=\"sdirk\""], &["\"sdirk\"", "`sdirk2`"]),
    (&["integrator.beyond_limit=\"go\""], &["\"go\"", "`integrator.beyond_limit`"]),
    (&["scaling={kind=\"auto\"}"], &["AUTS", "integrator.substeps"]),
    (&["stop={depth=1}"], &["`depth`", "`wear_depth`"]),
    (&["stop={wear_depth=-1}"], &["-1", "`stop.wear_depth`"]),
    (&["reference.kind=\"stick-limit\""], &["stick-limit"]),
];

fn room() -> Room {
    let room = Room::new();
    room.write("ball.toml", BALL);
    room.write("small.csv", "1,2,3\n4,5,6\n");
    room.write("odd.csv", "1,2,3\n4,5,x\n");
    room
}

#[test]
fn a_mistake_in_a_solved_scene_names_its_key() {
    let room = room();
    for (changes, telling) in REFUSED {
        let mut words = vec!["run", "ball.toml"];
        changes.iter().for_each(|text| words.extend(["--set", text]));
        room.refused(&words, telling);
    }
}

/// Exit code and kind, changes of the scene, and what has to be said.
type Failure = ((i32, &'static str), &'static [&'static str], &'static [&'static str]);

/// Runs that cannot come to an answer.
const FAILED: &[Failure] = &[
    ((4, "numbers"), &["step.0.load=1e6"], &["load step 1", "rim", "`grid.size`"]),
    ((4, "numbers"), &["step.0.duration=1e300"], &["load step 1, time ", "e298", "rim"]),
    (
        (4, "numbers"),
        &["contact.boundary=\"periodic\"", "step=[{duration=1,approach=1.0,velocity=1}]"],
        &["load step 1", "approach", "1e0"],
    ),
    (
        (4, "numbers"),
        &["integrator={method=\"explicit-euler\",substeps=1}", "step.0.duration=10"],
        &["explicit substep", "stability limit", "`integrator.beyond_limit`"],
    ),
    (
        (3, "law"),
        &["law.constants=[1e-4,1e9,-0.5,1.0]"],
        &["`archard` wears less where the pressure is higher", "point"],
    ),
];

#[test]
fn what_has_no_answer_is_told_with_its_load_step_and_the_results_so_far_are_kept() {
    let room = room();
    for (index, ((code, kind), changes, telling)) in FAILED.iter().enumerate() {
        let out = format!("failed-{index}");
        let mut words = vec!["run", "ball.toml", "--out", &out, "--json"];
        changes.iter().for_each(|text| words.extend(["--set", text]));
        let document = room.json(&words, *code);
        assert_eq!(document["error"]["kind"], *kind, "{changes:?}");
        let message = document["error"]["message"].as_str().expect("a message");
        for word in *telling {
            assert!(message.contains(word), "{changes:?} does not say `{word}`: {message}");
        }
        let history = std::fs::read_to_string(room.file(&out).join("history.csv")).expect("what was reached is kept");
        assert!(history.starts_with("time,"), "{changes:?}: {history}");
        assert!(!history.contains("NaN") && !history.contains("inf"), "{history}");
    }
}

#[test]
fn a_contact_at_the_rim_is_warned_of_with_its_part() {
    let room = room();
    // A line contact that is longer than its domain touches two sides of four.
    let words = ["run", "ball.toml", "--json", "--set", "surface.shape=\"cylinder\"", "--set", "step.0.load=0.1"];
    let document = room.json_of(&words);
    let warnings = document["warnings"].to_string();
    assert!(warnings.contains("rim") && warnings.contains('%'), "{warnings}");
}

#[test]
fn bodies_that_do_not_touch_do_not_wear() {
    let room = room();
    for step in
        ["{duration=1,load=0,velocity=1}", "{duration=1,approach=-1e-6,velocity=1}", "{duration=0,load=1,velocity=1}"]
    {
        let document = room.json_of(&["run", "ball.toml", "--json", "--set", &format!("step=[{step}]")]);
        assert_eq!(document["result"]["wear_volume"], 0.0, "{step}: {document}");
    }
}
