//! The stability limit of explicit steps: measured, kept, cut or overstepped; and what every integrator does beyond it.

#[path = "support/program.rs"]
mod program;

use std::path::Path;

use program::{fails, folder, json, run, write};
use serde_json::Value;

/// A line contact on a half-space, 31 cells in contact.
fn line(law: &str, more: &str) -> String {
    format!(
        "[law]\nuse = \"archard\"\nconstants = {law}\n[contact]\nmodel = \"halfspace\"\ndimension = 2\nboundary = \"free\"\n\
         modulus = 1.15e11\n[grid]\nsize = [3.0e-4]\ncells = [128]\n[surface]\nshape = \"cylinder\"\nradius = 6.0e-3\n\
         [[step]]\nduration = 0.04\nload = 18500\nvelocity = 1.0\n[output]\nfields = []\n{more}"
    )
}

/// A cylinder on springs: stiffness c k = 0.1 per second, so the limit is 20 s.
fn springs(more: &str) -> String {
    format!(
        "[law]\nuse = \"archard\"\nconstants = {{ K = 1e-4, H = 1e10 }}\n[contact]\nmodel = \"foundation\"\ndimension = 2\n\
         stiffness = 1e13\n[grid]\nsize = [3e-3]\ncells = [128]\n[surface]\nshape = \"cylinder\"\nradius = 1e-2\n\
         [[step]]\nduration = 100.0\nload = 1000\nvelocity = 1.0\n[output]\nfields = []\n{more}"
    )
}

const LINEAR: &str = "{ K = 1e-4, H = 1e10 }";

/// The document of `stability`, with its exit code.
fn stability(folder: &Path, words: &[&str]) -> (Value, i32) {
    let ended = run(folder, &[&["stability", "scene.toml", "--json"], words].concat());
    assert!(ended.code == 0 || ended.code == 4, "{}", ended.stderr);
    (json(&ended.stdout), ended.code)
}

fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("no number at {path} of {value}"))
}

/// The rows of a method.
fn rows<'d>(document: &'d Value, method: &str) -> Vec<&'d Value> {
    let rows = document["rows"].as_array().expect("rows");
    let found: Vec<&Value> = rows.iter().filter(|row| row["method"] == method).collect();
    assert_eq!(found.len(), 28, "{method}: two controls, two contacts, seven steps");
    found
}

/// Whether steps of this length were tried at all: long ones can leave the grid.
fn seen(row: &Value) -> Option<&Value> {
    row["outcome"].get("seen")
}

/// Fails unless every row that could be tried is positive, smooth and bounded, long steps among them.
#[track_caller]
fn is_fine(document: &Value, method: &str) {
    let mut longest: f64 = 0.0;
    for row in rows(document, method) {
        assert!(row["trouble"].is_null(), "{row}");
        if seen(row).is_some() {
            longest = longest.max(number(row, "/ratio"));
        }
        assert!(row["outcome"].get("failed").is_none() && (seen(row).is_some() || row["held"] == false), "{row}");
    }
    assert_eq!(longest, 1e6);
}

#[test]
fn explicit_steps_roughen_just_beyond_the_measured_limit() {
    let folder = folder();
    let ball = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n[contact]\nmodel = \"halfspace\"\n\
                modulus = 1.15e11\n[grid]\nsize = [2.4e-4, 2.4e-4]\ncells = [40, 40]\n[surface]\nshape = \"sphere\"\n\
                radius = 5e-3\n[[step]]\nduration = 0.35\nload = 10.0\nvelocity = 1.0\n";
    // 1.722 c E* / h of a large contact of rectangles, 1.347 of strips, a little less of one 30 cells wide.
    let cases = [
        (ball.to_owned(), 1.722 * 1e-14 * 1.15e11 / (2.4e-4 / 40.0)),
        (line(LINEAR, ""), 1.347 * 1e-14 * 1.15e11 / (3e-4 / 128.0)),
        (line("{ K = 1e-12, H = 1e10, m = 2.0 }", ""), f64::NAN),
    ];
    for (scene, expected) in cases {
        write(folder.path(), "scene.toml", &scene);
        let (document, code) = stability(folder.path(), &[]);
        assert_eq!(code, 0, "{}", document["verdict"]);
        let stiffness = number(&document, "/stiffness_per_s");
        assert!(expected.is_nan() || (stiffness / expected - 1.0).abs() < 0.01, "{stiffness} against {expected}");
        assert_eq!(number(&document, "/explicit_limit_s"), 2.0 / stiffness);
        for row in rows(&document, "explicit-euler") {
            let ratio = number(row, "/ratio");
            if ratio < 2.0 {
                assert!(row["trouble"].is_null(), "{row}");
            } else if seen(row).is_some() {
                assert!(!row["trouble"].is_null(), "{row}");
            }
        }
        is_fine(&document, "tr-bdf2 with its rule");
        is_fine(&document, "implicit-euler");
    }
}

#[test]
fn the_default_holds_where_second_order_alone_over_wears() {
    let folder = folder();
    write(folder.path(), "scene.toml", &springs(""));
    let (document, code) = stability(folder.path(), &[]);
    assert_eq!(code, 0);
    assert!((number(&document, "/stiffness_per_s") - 0.1).abs() < 1e-9);
    is_fine(&document, "tr-bdf2 with its rule");
    // One spring under a given approach, wear over gap in the first step: (sqrt 2 / 4) z of TR-BDF2; SDIRK2 goes to 2.414.
    let worn = |method: &str, ratio: f64| {
        let row = rows(&document, method)
            .into_iter()
            .find(|row| number(row, "/ratio") == ratio && row["control"] == "approach" && row["held"] == false);
        let row = row.expect("the row is there");
        (number(row, "/outcome/seen/wear_over_reach"), row["trouble"].as_str().unwrap_or_default().to_owned())
    };
    for (method, ratio, expected) in [
        ("tr-bdf2 alone", 10.0, 3.5355),
        ("tr-bdf2 alone", 1e6, 3.5355e5),
        ("sdirk2 alone", 10.0, 1.8005),
        ("sdirk2 alone", 1e6, 2.4142),
    ] {
        let (found, trouble) = worn(method, ratio);
        assert!((found / expected - 1.0).abs() < 2e-3, "{method} {ratio}: {found}");
        assert!(trouble.contains("over-worn"), "{trouble}");
    }
    let stepped = rows(&document, "tr-bdf2 with its rule").into_iter().filter_map(seen);
    assert!(stepped.map(|seen| number(seen, "/replaced")).sum::<f64>() > 10.0);
    let verdict = document["verdict"].to_string();
    assert!(verdict.contains("tr-bdf2 without its rule") && verdict.contains("backward Euler"), "{verdict}");
}

#[test]
fn the_default_holds_for_a_law_that_wears_to_the_end_in_finite_time() {
    let folder = folder();
    write(folder.path(), "scene.toml", &line("{ K = 1.0, H = 1e10, m = 0.5 }", ""));
    let (document, code) = stability(folder.path(), &[]);
    assert_eq!(code, 0, "{}", document["verdict"]);
    is_fine(&document, "tr-bdf2 with its rule");
}

#[test]
fn the_default_holds_for_a_law_in_fortran_without_a_derivative() {
    if std::process::Command::new("gfortran").arg("--version").output().is_err() {
        println!("NOT RUN: the_default_holds_for_a_law_in_fortran_without_a_derivative: no gfortran");
        return;
    }
    let law = Path::new(env!("CARGO_MANIFEST_DIR")).join("../plugins/example-fortran/dissipated_work.f90");
    let folder = folder();
    let scene = springs("").replace("\"archard\"", &format!("{law:?}"));
    let scene =
        scene.replace("{ K = 1e-4, H = 1e10 }", "{ alpha = 3e-14 }").replace("dimension", "friction = 0.3\ndimension");
    write(folder.path(), "scene.toml", &scene);
    let (document, code) = stability(folder.path(), &[]);
    assert_eq!(code, 0, "{}", document["verdict"]);
    // Friction work is 0.3 times pressure and slip: the slope holds what the host derives from the pressure.
    assert!((number(&document, "/stiffness_per_s") / 0.09 - 1.0).abs() < 1e-5);
    is_fine(&document, "tr-bdf2 with its rule");
}

#[test]
fn the_state_is_that_of_the_time_asked_for() {
    let folder = folder();
    write(folder.path(), "scene.toml", &line(LINEAR, ""));
    let (start, _) = stability(folder.path(), &[]);
    let (later, _) = stability(folder.path(), &["--at", "0.04"]);
    assert_eq!(number(&later, "/state/time"), 0.04);
    assert!(number(&later, "/state/largest_pressure") < 0.9 * number(&start, "/state/largest_pressure"));
    assert!(number(&later, "/state/cells_in_contact") > number(&start, "/state/cells_in_contact"));
    is_fine(&later, "tr-bdf2 with its rule");
    let message = fails(folder.path(), &["stability", "scene.toml", "--at", "0.05"], 2, "input");
    assert!(message.contains("0.05") && message.contains("0.04"), "{message}");
    write(folder.path(), "scene.toml", &line(LINEAR, "").replace("load = 18500", "load = 18500\nramp = [\"load\"]"));
    let message = fails(folder.path(), &["stability", "scene.toml"], 2, "input");
    assert!(message.contains("nothing is in contact") && message.contains("--at"), "{message}");
}

#[test]
fn the_exit_code_is_that_of_the_scenes_own_method() {
    let folder = folder();
    let explicit = |substeps: u32, beyond: &str| {
        let integrator = format!("[integrator]\nmethod = \"explicit-euler\"\nsubsteps = {substeps}\n{beyond}\n");
        write(folder.path(), "scene.toml", &springs(&integrator));
        stability(folder.path(), &[])
    };
    assert_eq!(explicit(6, "").1, 0);
    let (document, code) = explicit(4, "");
    assert_eq!((code, &document["method"]["fine"]), (4, &Value::Bool(false)));
    assert_eq!(explicit(4, "beyond_limit = \"substep\"").1, 0);
    assert_eq!(explicit(4, "beyond_limit = \"run\"").1, 4);
}

#[test]
fn prescribed_pressure_has_no_limit_and_extreme_input_is_answered() {
    let folder = folder();
    let scene = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n[contact]\nmodel = \"prescribed\"\n\
                 [[step]]\nduration = 1.0\npressure = 5e6\nvelocity = 0.2\n";
    write(folder.path(), "scene.toml", scene);
    let (document, code) = stability(folder.path(), &[]);
    assert_eq!(code, 0);
    assert!(document["stiffness_per_s"].is_null() && document["verdict"].to_string().contains("no stability limit"));
    let extremes = document["extremes"].as_array().expect("a table");
    assert!(extremes.len() >= 30);
    for row in extremes {
        assert_eq!(row["right"], true, "{row}");
    }
    let text = run(folder.path(), &["stability", "scene.toml"]).stdout;
    assert!(text.contains("pressure NaN") && text.contains("refused"), "{text}");
    assert!(!text.contains("WRONG"), "{text}");
}

#[test]
fn the_ordinary_point_of_a_history_is_its_most_loaded_one() {
    let folder = folder();
    let scene = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n[contact]\nmodel = \"prescribed\"\n\
                 history = \"h.csv\"\n[integrator]\nsubsteps = 1\n";
    write(folder.path(), "scene.toml", scene);
    for motion in [
        "velocity\n0,1,1e6,0.5\n0,2,3e6,0.25\n2,1,1e6,0.5\n2,2,3e6,0.25\n",
        "slip\n0,1,1e6,0\n0,2,3e6,0\n2,1,1e6,1\n2,2,3e6,0.5\n",
    ] {
        write(folder.path(), "h.csv", &format!("time,point,pressure,{motion}"));
        let (document, _) = stability(folder.path(), &[]);
        let answer = number(&document["extremes"][0], "/answer/value");
        // K / H p v over the second that stands for a substep of no given length.
        assert!((answer / (1e-14 * 3e6 * 0.25) - 1.0).abs() < 1e-12, "{answer:e} of {motion}");
    }
}

#[test]
fn explicit_steps_beyond_the_limit_are_refused_cut_or_marked() {
    let folder = folder();
    let words = ["run", "scene.toml", "--out", "out"];
    let with = |beyond: &str| {
        let integrator = format!("[integrator]\nmethod = \"explicit-euler\"\nsubsteps = 2\n{beyond}\n");
        write(folder.path(), "scene.toml", &springs(&integrator));
    };
    let report = || json(&std::fs::read_to_string(folder.path().join("out/report.json")).expect("a report"));
    with("");
    let message = fails(folder.path(), &words, 4, "numbers");
    for part in ["explicit", "limit", "5e1", "limit 2e1", "substep", "run"] {
        assert!(message.contains(part), "{part} in {message}");
    }

    with("beyond_limit = \"substep\"");
    let ended = run(folder.path(), &words);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let cut = report();
    assert!((number(&cut, "/stability/explicit_limit_s") - 20.0).abs() < 1e-6);
    assert!((number(&cut, "/stability/stiffness_per_s") - 0.1).abs() < 1e-9);
    assert!(number(&cut, "/stability/largest_step_s") <= 18.0 + 1e-9);
    assert_eq!(number(&cut, "/cost/steps"), 6.0);
    assert!(
        cut["stability"]["verdict"]
            .as_str()
            .is_some_and(|verdict| verdict.starts_with("stable: explicit steps were cut"))
    );

    with("beyond_limit = \"run\"");
    let ended = run(folder.path(), &words);
    assert_eq!(ended.code, 4, "{}", ended.stderr);
    assert!(ended.stderr.contains("unstable"), "{}", ended.stderr);
    let ran = report();
    assert_eq!(number(&ran, "/cost/steps"), 2.0);
    assert!(ran["stability"]["verdict"].as_str().is_some_and(|verdict| verdict.starts_with("unstable: 2 of 2")));
    assert!(folder.path().join("out/history.csv").exists());
    // The volume is as plausible as that of the stable run: c P t.
    assert!((number(&ran, "/result/wear_volume") / 1e-9 - 1.0).abs() < 1e-9);
}

#[test]
fn explicit_steps_to_a_tolerance_begin_within_the_limit_and_implicit_ones_measure_nothing() {
    let folder = folder();
    let report = |integrator: &str| {
        write(folder.path(), "scene.toml", &springs(integrator));
        let ended = run(folder.path(), &["run", "scene.toml", "--out", "out"]);
        assert_eq!(ended.code, 0, "{}", ended.stderr);
        json(&std::fs::read_to_string(folder.path().join("out/report.json")).expect("a report"))
    };
    let explicit = report("[integrator]\nmethod = \"explicit-euler\"\ntolerance = 0.5\n");
    assert!(number(&explicit, "/stability/largest_step_s") <= 18.0 + 1e-9, "{}", explicit["stability"]);
    assert!(
        explicit["stability"]["verdict"]
            .as_str()
            .is_some_and(|verdict| verdict.starts_with("stable: every explicit step"))
    );
    let implicit = report("[integrator]\nsubsteps = 2\n");
    assert!(implicit["stability"]["stiffness_per_s"].is_null());
    assert!(implicit["stability"]["verdict"].as_str().is_some_and(|verdict| verdict.contains("implicit")));
}
