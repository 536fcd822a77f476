//! `wearlaw sweep`: every case once, in one table, whatever happens on the way.

#[path = "support/program.rs"]
mod program;

use std::path::Path;

use program::{LAW, fails, folder, json, run, write};

const SCENE: &str = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n[contact]\nmodel = \"foundation\"\n\
    dimension = 2\nstiffness = 1e13\n[grid]\nsize = [6e-4]\ncells = [40]\n[surface]\nshape = \"cylinder\"\nradius = 1e-2\n\
    [[step]]\nduration = 100\nload = 1000\nvelocity = 1\n[integrator]\nmethod = \"implicit-euler\"\nsubsteps = 10\n";

/// The table: its columns, and a row for each case.
fn table(file: &Path) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_path(file).expect("a table");
    let head = reader.headers().expect("a head").iter().map(str::to_owned).collect();
    (head, reader.records().map(|row| row.expect("a row").iter().map(str::to_owned).collect()).collect())
}

/// A table without what depends on the machine.
fn same(file: &Path) -> Vec<Vec<String>> {
    let (head, mut rows) = table(file);
    let time = head.iter().position(|name| name == "run_time_s").expect("a run time");
    rows.iter_mut().for_each(|row| {
        row.remove(time);
    });
    rows
}

#[test]
fn every_case_is_what_a_run_of_it_gives() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    let said =
        run(here.path(), &["sweep", "scene.toml", "--vary", "step.0.load=500,1000", "--vary", "grid.cells=[40],[20]"]);
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert!(said.stdout.contains("4 in all: 4 run now, 0 kept from before, 0 not there yet"), "{}", said.stdout);
    let (head, rows) = table(&here.path().join("scene.sweep/cases.csv"));
    assert_eq!(head[..4], ["case", "step.0.load", "grid.cells", "time"]);
    assert_eq!(rows.len(), 4);
    let column = |name: &str| head.iter().position(|known| known == name).unwrap_or_else(|| panic!("no column {name}"));
    for row in &rows {
        let sets = [format!("step.0.load={}", row[1]), format!("grid.cells={}", row[2])];
        let alone = run(here.path(), &["run", "scene.toml", "--json", "--set", &sets[0], "--set", &sets[1]]);
        let report = json(&alone.stdout);
        for name in ["max_wear_depth", "wear_volume", "approach", "max_pressure"] {
            let found: f64 = row[column(name)].parse().expect("a number");
            assert_eq!(Some(found), report["result"][name].as_f64(), "{name} of case {}", row[0]);
        }
        assert_eq!((row[column("ended")].as_str(), row[column("exit_code")].as_str()), ("done", "0"));
    }
    assert_ne!(rows[0][column("max_wear_depth")], rows[2][column("max_wear_depth")], "the load matters");
}

#[test]
fn shards_together_are_the_whole_and_what_is_done_is_kept() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    let vary =
        ["sweep", "scene.toml", "--vary", "step.0.load=100..2000:10", "--vary", "law.constants.K=1e-5..1e-3:2:log"];
    let whole = run(here.path(), &[&vary[..], &["--out", "whole"]].concat());
    assert_eq!(whole.code, 0, "{}", whole.stderr);
    for shard in (1..=7).rev() {
        let part =
            run(here.path(), &[&vary[..], &["--out", "parts", "--shard", &format!("{shard}/7"), "--json"]].concat());
        let part = json(&part.stdout);
        assert_eq!(part["run"], if shard <= 6 { 3 } else { 2 }, "{part}");
    }
    let merged = run(here.path(), &[&vary[..], &["--out", "parts", "--json"]].concat());
    let merged = json(&merged.stdout);
    assert_eq!((&merged["run"], &merged["kept"], &merged["missing"]), (&0.into(), &20.into(), &0.into()));
    let files = ["whole", "parts"].map(|name| same(&here.path().join(name).join("cases.csv")));
    assert_eq!(files[0].len(), 20);
    assert_eq!(files[0], files[1]);
    // A case that is gone is run again, one whose scene has changed too.
    std::fs::remove_file(here.path().join("parts/cases/0000007.json")).expect("the file of a case");
    let again = json(&run(here.path(), &[&vary[..], &["--out", "parts", "--json"]].concat()).stdout);
    assert_eq!((&again["run"], &again["kept"]), (&1.into(), &19.into()));
    let other = [&vary[..], &["--out", "parts", "--json", "--set", "integrator.substeps=11"]].concat();
    assert_eq!(json(&run(here.path(), &other).stdout)["run"], 20);
    assert_ne!(same(&here.path().join("parts/cases.csv")), files[0], "eleven substeps give other depths");
}

#[test]
fn a_case_that_fails_is_a_row_with_its_error() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    let words = ["sweep", "scene.toml", "--vary", "step.0.load=1000,-5,2000", "--json"];
    let said = run(here.path(), &words);
    assert_eq!(said.code, 1, "{}", said.stderr);
    let document = json(&said.stdout);
    assert_eq!(document["failed"].as_array().map(Vec::len), Some(1));
    let (head, rows) = table(&here.path().join("scene.sweep/cases.csv"));
    let message = head.iter().position(|name| name == "message").expect("messages");
    assert!(rows[1][message].contains("-5") && rows[1][message].contains("load"), "{}", rows[1][message]);
    assert_eq!(rows[1][message - 1], "2");
    assert!(rows[0][message].is_empty() && rows[2][message].is_empty());
    // What failed is tried again, what did not is kept.
    assert_eq!(json(&run(here.path(), &words).stdout)["kept"], 2);
    let said = run(here.path(), &["sweep", "scene.toml", "--vary", "step.0.laod=1,2"]);
    assert!(said.code == 1 && said.stdout.contains("`step.0.laod`"), "{}", said.stdout);
}

#[test]
fn a_case_beyond_the_bar_of_the_scene_falls_short_and_keeps_its_results() {
    let here = folder();
    write(here.path(), "scene.toml", &format!("{SCENE}[reference]\nkind = \"winkler-parabola\"\nbar = 1e-3\n"));
    let said = run(here.path(), &["sweep", "scene.toml", "--vary", "integrator.substeps=2,400", "--json"]);
    assert_eq!(said.code, 1, "{}", said.stderr);
    let (head, rows) = table(&here.path().join("scene.sweep/cases.csv"));
    let cell = |row: usize, name: &str| &rows[row][head.iter().position(|known| known == name).expect("a column")];
    assert_eq!((cell(0, "ended").as_str(), cell(0, "exit_code").as_str()), ("done", "1"));
    assert!(cell(0, "message").contains("above the bar") && !cell(0, "max_wear_depth").is_empty());
    assert_eq!((cell(1, "exit_code").as_str(), cell(1, "message").as_str()), ("0", ""));
    let error = |row: usize| cell(row, "error").parse::<f64>().expect("a number");
    assert!(error(0) > 1e-3 && error(1) <= 1e-3, "{} {}", error(0), error(1));
}

#[test]
fn a_law_that_crashes_in_a_process_of_its_own_ends_its_case_alone() {
    let here = folder();
    let law = "#include <stdlib.h>\n".to_owned()
        + &LAW.replace("out->increment", "if (in->pressure > 1.8e8) abort();\n    out->increment");
    write(here.path(), "half.c", &law);
    assert_eq!(run(here.path(), &["build", "half.c", "-o", "half.so", "-q"]).code, 0);
    write(
        here.path(),
        "scene.toml",
        &SCENE.replace("\"archard\"", "\"half.so\"").replace("{ K = 1e-4, H = 1e10 }", "[1e-14]"),
    );
    let said = run(here.path(), &["sweep", "scene.toml", "--isolate", "--vary", "step.0.load=10,2e5,20", "--json"]);
    assert_eq!(said.code, 1, "{}", said.stderr);
    let failed = &json(&said.stdout)["failed"];
    assert_eq!(
        (failed.as_array().map(Vec::len), &failed[0]["case"], &failed[0]["exit_code"]),
        (Some(1), &2.into(), &3.into())
    );
    assert!(failed[0]["message"].as_str().is_some_and(|text| text.contains("crashed")), "{failed}");
}

#[test]
fn cases_come_from_a_table_too() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    write(here.path(), "cases.csv", "step.0.load,integrator.substeps\n1000,10\n1000,20\n500,5\n");
    let said = run(here.path(), &["sweep", "scene.toml", "--cases", "cases.csv", "--out", "here"]);
    assert_eq!(said.code, 0, "{}", said.stderr);
    let (_, rows) = table(&here.path().join("here/cases.csv"));
    let loads: Vec<&str> = rows.iter().map(|row| row[1].as_str()).collect();
    assert_eq!(loads, ["1000", "1000", "500"]);
}

#[test]
fn what_cannot_be_a_sweep_is_refused_before_it_begins() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    write(here.path(), "cases.csv", "step.0.load\n1\n");
    let refused = |words: &[&str], part: &str| {
        let message = fails(here.path(), words, 2, "input");
        assert!(message.contains(part), "{message}");
        assert!(!here.path().join("scene.sweep").exists(), "{words:?} leaves nothing");
    };
    refused(&["sweep", "scene.toml"], "--vary");
    refused(&["sweep", "scene.toml", "--vary", "step.0.load"], "no `=`");
    refused(&["sweep", "scene.toml", "--vary", "a=1", "--vary", "a=2"], "varied twice");
    refused(&["sweep", "scene.toml", "--vary", "a=1", "--shard", "8/7"], "I/N");
    refused(&["sweep", "scene.toml", "--vary", "a=1", "--cases", "cases.csv"], "--cases");
    refused(&["sweep", "scene.toml", "--cases", "none.csv"], "none.csv");
    std::fs::create_dir(here.path().join("mine")).expect("a folder");
    write(here.path(), "mine/notes.txt", "not to be lost");
    let message =
        fails(here.path(), &["sweep", "scene.toml", "--vary", "step.0.load=1,2", "--out", "mine"], 2, "input");
    assert!(message.contains("notes.txt"), "{message}");
}
