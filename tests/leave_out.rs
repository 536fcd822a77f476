//! What a plan leaves out costs nothing: listed, and measured in the memory of the program.

#[path = "support/npz.rs"]
mod npz;
#[path = "support/scene_runs.rs"]
mod scene_runs;

use std::path::Path;

use npz::Npz;
use scene_runs::{run, scenes, wearlaw};
use serde_json::Value;

const MEGABYTE: f64 = 1e6;

#[test]
fn the_plan_of_the_simplest_scene_lists_what_is_left_out() {
    let scene = scenes().join("pin_on_disc.toml");
    let ended = wearlaw(&["plan".as_ref(), scene.as_os_str(), "--json".as_ref()]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let plan: Value = serde_json::from_str(&ended.stdout).expect("one JSON document");
    let skipped: Vec<(&str, &str)> = plan["skipped"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|line| (line["what"].as_str().expect("what"), line["why"].as_str().expect("why")))
        .collect();
    for what in [
        "temperatures",
        "nodal stresses",
        "normals",
        "friction",
        "load, contact area and wear volume",
        "slip vectors",
        "wear directions",
        "state variables",
        "derivatives",
        "contact solves",
        "the stability estimate",
        "points out of contact",
        "field files",
    ] {
        assert!(skipped.iter().any(|(found, why)| *found == what && !why.is_empty()), "{what}: {skipped:?}");
    }
    let text = wearlaw(&["plan".as_ref(), scene.as_os_str()]);
    assert!(text.stdout.contains("left out") && text.stdout.contains("temperatures"), "{}", text.stdout);
    // Five points: wear depths beside what the history holds.
    assert!(plan["memory_bytes"].as_f64().is_some_and(|bytes| bytes < 400.0), "{}", plan["memory"]);
}

#[test]
fn equal_rows_of_a_table_are_left_out() {
    let scene = scenes().join("pin_on_disc.toml");
    let row = "constants = { K = 1e-4, H = 2e3, m = 1, n = 1 }";
    let equal = format!("law.table=[{{ time = 0, {row} }}, {{ time = 1, {row} }}]");
    let plan = |more: &[&str]| {
        let mut words = vec!["plan".as_ref(), scene.as_os_str(), "--json".as_ref()];
        words.extend(more.iter().map(|word| std::ffi::OsStr::new(*word)));
        let ended = wearlaw(&words);
        assert_eq!(ended.code, 0, "{}", ended.stderr);
        serde_json::from_str::<Value>(&ended.stdout).expect("one JSON document")
    };
    let (changing, same) = (plan(&[]), plan(&["--set", &equal]));
    assert!(!changing["skipped"].to_string().contains("the table of constants"));
    assert!(same["skipped"].to_string().contains("the table of constants"));
    assert!(same["evaluations_at_least"].as_u64() < changing["evaluations_at_least"].as_u64());
}

/// A ball in the middle of a grid is solved on a quarter of it, and one a cell beside it on a half; the wear is the same.
#[test]
fn a_symmetric_contact_is_solved_on_a_part_of_its_cells() {
    let scene = scenes().join("ball_on_flat.toml");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cell = 3.303_840_301_032e-4 / 48.0;
    let ran = |name: &str, at: [f64; 2]| {
        let center = format!("surface.center=[{:e}, {:e}]", (at[0] + 0.5) * cell, (at[1] + 0.5) * cell);
        let ran = run(&scene, &folder.path().join(name), &["--set", &center]);
        let skipped = ran.report["plan"]["skipped"].as_array().expect("a list").clone();
        let of_contact = |line: &Value| line["what"].as_str().is_some_and(|what| what.ends_with(" of the contact"));
        let said: Vec<String> =
            skipped.into_iter().filter(of_contact).map(|line| format!("{}: {}", line["what"], line["why"])).collect();
        (said.concat(), ["/result/max_wear_depth", "/result/wear_volume"].map(|path| ran.number(path)), ran)
    };
    let (quarter, wear, ran_quarter) = ran("quarter", [24.0, 24.0]);
    assert!(quarter.contains("three quarters of the contact") && quarter.contains("in x and y"), "{quarter}");
    let (half, wear_half, ran_half) = ran("half", [23.0, 24.0]);
    assert!(half.contains("half of the contact") && half.contains("in y"), "{half}");
    let (whole, wear_whole, ran_whole) = ran("whole", [23.0, 22.0]);
    assert_eq!(whole, "");
    for others in [wear_half, wear_whole] {
        for (one, other) in wear.iter().zip(others) {
            assert!((one / other - 1.0).abs() < 1e-6, "{wear:?} and {others:?}");
        }
    }
    for other in [ran_half, ran_whole] {
        assert_eq!(ran_quarter.number("/cost/steps"), other.number("/cost/steps"));
        assert_eq!(ran_quarter.number("/cost/points_evaluated"), other.number("/cost/points_evaluated"));
    }
}

/// A scene over a stored NPZ with one time: pressure and velocity at each point, and further columns.
fn scene(folder: &Path, name: &str, points: usize, columns: &[&str], law: &str, rest: &str) -> std::path::PathBuf {
    let history = format!("{name}.npz");
    let mut npz = Npz::create(&folder.join(&history)).array("time", &[1], std::iter::once(0.0)).array(
        "pressure",
        &[points],
        (0..points).map(|i| 1e6 + (i % 1000) as f64),
    );
    for column in columns {
        npz = npz.array(column, &[points], (0..points).map(|i| 0.1 + (i % 977) as f64 * 1e-4));
    }
    npz.finish();
    let path = folder.join(format!("{name}.toml"));
    let text = format!(
        "[law]\nuse = \"embedded:archard\"\n{law}\n[contact]\nmodel = \"prescribed\"\nhistory = \"{history}\"\n\
         [[step]]\nduration = 2\n{rest}"
    );
    std::fs::write(&path, text).expect("a writable folder");
    path
}

fn peak(scene: &Path, threads: &str) -> (f64, f64) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let ran = run(scene, &folder.path().join("out"), &["--threads", threads]);
    assert!(ran.number("/result/max_wear_depth") > 0.0);
    (ran.number("/cost/peak_memory_bytes"), ran.number("/plan/memory_bytes"))
}

const PLAIN: &str = "constants = [1e-4, 1e9, 1, 1]";
const WARM: &str = "[[law.table]]\ntemperature = 0\nconstants = [1e-4, 1e9, 1, 1]\n\
                    [[law.table]]\ntemperature = 1\nconstants = [2e-4, 1e9, 1, 1]";

/// 1e6 points: a column of 8 MB is paid for by the scene that reads it, and by no other.
#[test]
fn a_column_that_nobody_reads_costs_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let points = 1_000_000;
    let with = |name: &str, columns: &[&str], law: &str| {
        let (peak, planned) = peak(&scene(folder.path(), name, points, columns, law, ""), "1");
        println!("{name}: peak {:.2} MB, planned {:.2} MB", peak / MEGABYTE, planned / MEGABYTE);
        (peak, planned)
    };
    let (bare, planned) = with("bare", &["velocity"], PLAIN);
    let (unread, planned_unread) = with("unread", &["velocity", "temperature"], PLAIN);
    let (read, planned_read) = with("read", &["velocity", "temperature"], WARM);
    assert_eq!(planned, planned_unread);
    assert_eq!(planned_read - planned, 8.0 * points as f64);
    assert!((unread - bare).abs() < MEGABYTE, "{unread} against {bare}");
    assert!(read - bare >= 7.0 * MEGABYTE, "{read} against {bare}");
    // Stresses, normals, shear and friction that nobody reads are as good as not there.
    let rest = ["velocity", "nx", "ny", "nz", "sxx", "syy", "szz", "sxy", "syz", "sxz", "shear", "friction"];
    let (many, planned_many) = with("many", &rest, PLAIN);
    assert_eq!(planned, planned_many);
    assert!((many - bare).abs() < MEGABYTE, "{many} against {bare}");
}

/// What a scene does ask for is in its plan: sliding distances, fields.
#[test]
fn a_uniform_velocity_needs_no_sliding_distances() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let points = 1_000_000;
    let rest = "velocity = 0.1\n";
    let (uniform, planned) = peak(&scene(folder.path(), "uniform", points, &[], PLAIN, rest), "1");
    let (each, planned_each) = peak(&scene(folder.path(), "each", points, &["velocity"], PLAIN, ""), "1");
    println!("uniform: peak {:.2} MB, each: {:.2} MB", uniform / MEGABYTE, each / MEGABYTE);
    // The column and the distances.
    assert_eq!(planned_each - planned, 16.0 * points as f64);
    assert!(each - uniform >= 14.0 * MEGABYTE, "{each} against {uniform}");
}

#[test]
fn ten_million_points_stay_within_half_as_much_again_as_planned() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, columns, rest) in [("uniform", &[][..], "velocity = 0.1\n"), ("each", &["velocity"][..], "")] {
        let scene = scene(folder.path(), name, 10_000_000, columns, PLAIN, rest);
        let (peak, planned) = peak(&scene, "2");
        println!("{name}: peak {:.1} MB, planned {:.1} MB: {:.3}", peak / MEGABYTE, planned / MEGABYTE, peak / planned);
        assert!(planned >= 16.0 * 1e7 && peak < 1.5 * planned, "{name}: {peak} of {planned}");
        std::fs::remove_file(scene.with_extension("npz")).expect("the history was written");
    }
}
