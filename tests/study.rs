//! `wearlaw study`: orders, unstable runs, the budget, the yardstick's own error, and that its files say one thing.

#[path = "support/program.rs"]
mod program;

use std::path::{Path, PathBuf};

use program::{fails, folder, json, run, write};
use serde_json::Value;

/// A scene of the repository.
fn scene(name: &str) -> String {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    path.display().to_string()
}

/// A line contact on a half-space, 31 cells in contact, worn to a third of its pressure.
const LINE: &str = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n[contact]\nmodel = \"halfspace\"\n\
    dimension = 2\nmodulus = 1.15e11\n[grid]\nsize = [3.0e-4]\ncells = [128]\n[surface]\nshape = \"cylinder\"\n\
    radius = 6.0e-3\n[[step]]\nduration = 0.3\nload = 18500\nvelocity = 1.0\n";

/// The document of a study that runs to its end.
fn study(folder: &Path, words: &[&str]) -> Value {
    let ended = run(folder, &[&["study", "--json"], words].concat());
    assert_eq!(ended.code, 0, "{words:?}: {}", ended.stderr);
    json(&ended.stdout)
}

fn list<'d>(document: &'d Value, key: &str) -> &'d Vec<Value> {
    document[key].as_array().unwrap_or_else(|| panic!("no list {key} in {document}"))
}

/// The cases of a line.
fn line<'d>(document: &'d Value, name: &str) -> Vec<&'d Value> {
    list(document, "cases").iter().filter(|case| case["line"] == name).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Fails unless the observed orders are those of theory.
fn orders(document: &Value, from: &str) {
    for (name, order, off) in
        [("explicit-euler", 1.0, 0.05), ("implicit-euler", 1.0, 0.05), ("tr-bdf2", 2.0, 0.1), ("sdirk2", 2.0, 0.1)]
    {
        let found = list(document, "orders").iter().find(|order| order["line"] == name);
        let found = number(&found.unwrap_or_else(|| panic!("{from}: no order of {name}"))["order"]);
        assert!((found - order).abs() <= off, "{from}: {name} has order {found}, expected {order}");
    }
}

#[test]
fn orders_are_those_of_theory_on_a_contact_that_stays() {
    let here = folder();
    let words = [&scene("mode_decay.toml"), "--only", "substeps", "--substeps", "8,16,32,64", "--runs", "1"];
    let document = study(here.path(), &words);
    assert_eq!(document["yardstick"]["kind"], "exact");
    orders(&document, "against the exact answer");
    let document = study(here.path(), &[&words[..], &["--reference", "self"]].concat());
    assert_eq!(document["yardstick"]["kind"], "self");
    orders(&document, "against itself");
}

#[test]
fn orders_are_those_of_theory_under_a_prescribed_pressure() {
    let here = folder();
    let words = [&scene("pin_on_disc.toml"), "--only", "substeps", "--substeps", "64,128,256,512", "--runs", "1"];
    let document = study(here.path(), &words);
    orders(&document, "prescribed");
    let quadrature = line(&document, "quadrature");
    assert!(number(&quadrature[0]["errors"]["wear_l2_relative"]) < 1e-9, "{}", quadrature[0]);
    assert_eq!((&document["explicit_limit"], &document["grid"]), (&Value::Null, &Value::Null));
}

#[test]
fn unstable_runs_stay_and_are_marked_and_nothing_counts_on_them() {
    let here = folder();
    write(here.path(), "scene.toml", LINE);
    let words =
        ["scene.toml", "--only", "substeps", "--methods", "explicit-euler,tr-bdf2", "--budget", "30s", "--runs", "1"];
    let document = study(here.path(), &words);
    let fewest = number(&document["explicit_limit"]["substeps"]);
    let cases = line(&document, "explicit-euler");
    let (mut unstable, mut stable) = (0, 0);
    for case in &cases {
        match case["status"].as_str().expect("a status") {
            "unstable" => {
                unstable += 1;
                assert!(number(&case["value"]) < fewest, "{case}");
                assert!(number(&case["errors"]["volume_relative"]) < 1e-9, "the volume is right all the same: {case}");
            }
            "done" => {
                stable += 1;
                assert!(number(&case["value"]) >= fewest, "{case}");
            }
            _ => {}
        }
    }
    assert!(unstable >= 3 && stable >= 1, "{unstable} unstable, {stable} stable");
    let wear = |case: &Value| number(&case["errors"]["wear_l2_relative"]);
    let at_limit = line(&document, "explicit-euler at its limit");
    assert_eq!(at_limit[0]["status"], "done");
    assert!(wear(cases[0]) > 30.0 * wear(at_limit[0]), "the wall: {} against {}", cases[0], at_limit[0]);
    let all = list(&document, "cases");
    let named = list(&document, "front")
        .iter()
        .chain(list(&document, "cheapest").iter().flat_map(|c| [&c["case"], &c["explicit"]]));
    for index in named.filter_map(Value::as_u64) {
        assert_eq!(all[index as usize]["status"], "done");
    }
    let third = &list(&document, "cheapest")[1];
    assert!(number(&third["factor"]) > 1.0 && number(&third["error"]) == 1e-3, "{third}");
    let svg = std::fs::read_to_string(here.path().join("scene.study/study.svg")).expect("a picture");
    for word in ["tr-bdf2", "explicit-euler at its limit", "unstable: beyond the explicit limit", "Pareto front"] {
        assert!(svg.contains(word), "{word}");
    }
    let plain = run(here.path(), &[&["study"], &words[..]].concat());
    assert!(plain.stdout.contains(" X ") && plain.stdout.contains("verdict"), "{}", plain.stdout);
    for row in plain.stdout.lines() {
        assert!(row.chars().count() <= 100, "{row}");
    }
}

#[test]
fn a_budget_is_kept_and_what_it_leaves_out_is_listed() {
    let here = folder();
    write(here.path(), "scene.toml", LINE);
    let document = study(here.path(), &["scene.toml", "--budget", "2s", "--methods", "implicit-euler,explicit-euler"]);
    let spent = number(&document["spent_s"]);
    // A run that is cut off ends with its step, which other work on the machine may draw out.
    assert!(spent < 4.0, "spent {spent}");
    let left: Vec<&Value> = list(&document, "cases").iter().filter(|case| case["status"] == "left-out").collect();
    assert!(!left.is_empty(), "explicit lines go on for ever");
    for case in left {
        assert!(!case["reason"].as_str().expect("a reason").is_empty() && case["timing"].is_null(), "{case}");
    }
    let table = std::fs::read_to_string(here.path().join("scene.study/study.csv")).expect("a table");
    assert!(table.contains(",left-out,"), "{table}");
    let message = fails(here.path(), &["study", "scene.toml", "--budget", "1us"], 2, "input");
    assert!(message.contains("--budget"), "{message}");
    let message = fails(here.path(), &["study", "scene.toml", "--budget", "0.01ms"], 2, "input");
    assert!(message.contains("larger `--budget`"), "{message}");
}

/// What is stated of a self-converged answer, against what it is off by.
#[test]
fn a_yardstick_states_at_least_a_third_of_its_error() {
    let here = folder();
    let scenes = [
        "pin_on_disc.toml",
        "mode_decay.toml",
        "winkler_discrete.toml",
        "winkler_extinction.toml",
        "winkler_parabola.toml",
        "line_scar.toml",
        "ball_on_flat.toml",
        "stick_limit.toml",
    ];
    for name in scenes {
        let file = scene(name);
        let words = [&file, "--reference", "self", "--only", "tolerances", "--tolerances", "1e-1", "--budget"];
        // A limit that one step reaches has no second run to be compared with: then nothing is stated of steps.
        let says = |document: &Value| {
            name == "stick_limit.toml"
                || document["yardstick"]["stated"].as_object().is_some_and(|stated| !stated.is_empty())
        };
        // With other work on the machine there may be no time for a second run, or none for the first one.
        let within = |budget: &str| {
            let ended = run(here.path(), &[&["study"], &words[..], &[budget, "--json"]].concat());
            (ended.code == 0).then(|| json(&ended.stdout)).filter(|document| says(document))
        };
        let document =
            ["8s", "60s"].into_iter().find_map(within).unwrap_or_else(|| panic!("{name}: nothing is stated"));
        let measured = document["yardstick"]["measured"].as_object().expect("a measure");
        assert!(measured.contains_key("wear_l2_relative"), "{name}: {}", document["yardstick"]);
        // The answers of the continuum are off by the grid, too.
        let continuum =
            ["winkler_parabola", "line_scar", "ball_on_flat", "stick_limit"].iter().any(|n| name.starts_with(n));
        for (norm, off) in measured {
            let own = document["yardstick"]["stated"][norm].as_f64();
            assert!(own.is_some() || name == "stick_limit.toml", "{name}, {norm}: nothing is stated");
            let own = own.unwrap_or(0.0);
            let grid = document["grid"]["estimated"][norm].as_f64().filter(|_| continuum).unwrap_or(0.0);
            assert!(3.0 * (own + grid) >= number(off), "{name}, {norm}: stated {own:e} and {grid:e}, off by {off}");
        }
    }
}

#[test]
fn table_csv_and_json_say_the_same() {
    let here = folder();
    write(here.path(), "scene.toml", LINE);
    let words = ["study", "scene.toml", "--budget", "20s", "--out", "out", "--substeps", "4,8", "--tolerances", "1e-2"];
    let plain = run(here.path(), &[&words[..], &["--html"]].concat());
    assert_eq!((plain.code, plain.stderr.as_str()), (0, ""));
    let page = std::fs::read_to_string(here.path().join("out/study.html")).expect("a page");
    let text = std::fs::read_to_string(here.path().join("out/study.json")).expect("a document");
    let document = json(&text);
    let mut table = csv::Reader::from_path(here.path().join("out/study.csv")).expect("a table");
    let header = table.headers().expect("a header").clone();
    let rows: Vec<csv::StringRecord> = table.records().map(|row| row.expect("a row")).collect();
    let cases = list(&document, "cases");
    assert_eq!(rows.len(), cases.len());
    for line in ["tr-bdf2", "sdirk2 to a tolerance", "AUTS", "auto to a tolerance, isolated law", "grid"] {
        assert!(cases.iter().any(|case| case["line"] == line && case["status"] == "done"), "{line}: {}", plain.stdout);
    }
    let cell = |row: &csv::StringRecord, name: &str| {
        row[header.iter().position(|found| found == name).unwrap_or_else(|| panic!("no column {name}"))].to_owned()
    };
    for (row, case) in rows.iter().zip(cases) {
        assert_eq!((cell(row, "line"), cell(row, "status")), (text_of(&case["line"]), text_of(&case["status"])));
        assert_eq!(cell(row, "value").parse::<f64>().ok(), case["value"].as_f64());
        assert_eq!(cell(row, "wall_s").parse::<f64>().ok(), case["timing"]["wall_s"].as_f64());
        assert_eq!(cell(row, "contact_solves").parse::<u64>().ok(), case["work"]["contact_solves"].as_u64());
        for norm in document["norms"].as_object().expect("norms").keys() {
            assert_eq!(cell(row, norm).parse::<f64>().ok(), case["errors"][norm].as_f64(), "{norm} of {case}");
        }
        if case["status"] == "done" && case["kind"] == "substeps" {
            let error = format!("{:.1e}", number(&case["errors"]["wear_l2_relative"]));
            assert!(plain.stdout.contains(&error), "{error} is in the table");
            assert!(page.contains(&format!("{error}</td>")), "{error} is on the page");
        }
        for word in list(case, "overrides") {
            assert!(cell(row, "overrides").contains(word.as_str().expect("an override")));
        }
    }
    for line in list(&document, "verdict") {
        let first: Vec<&str> = line.as_str().expect("words").split(' ').take(6).collect();
        assert!(plain.stdout.contains(&first.join(" ")), "{line}");
        assert!(page.contains(&first.join(" ")), "{line}");
    }
    assert!(page.contains("<svg") && page.contains("SHA-256 of the law") && !page.contains("keys that were set"));
    for part in ["<script", "http:", "https:", "src=", "<link", "url("] {
        assert!(
            !page.replace("http://www.w3.org/2000/svg", "").contains(part),
            "{part}: it needs nothing from elsewhere"
        );
    }
    // A page of an earlier study does not stay beside another one.
    let quiet = run(here.path(), &[&words[..], &["-q"]].concat());
    assert_eq!((quiet.code, quiet.stdout.as_str(), quiet.stderr.as_str()), (0, "", ""));
    assert!(!here.path().join("out/study.html").exists());
}

fn text_of(value: &Value) -> String {
    value.as_str().expect("a text").to_owned()
}

/// A case is the scene under its overrides: a run with them takes the same steps.
#[test]
fn a_case_is_what_run_gives_under_its_overrides() {
    let here = folder();
    write(here.path(), "scene.toml", LINE);
    let words =
        ["scene.toml", "--only", "substeps", "--methods", "sdirk2", "--substeps", "8", "--set", "step.0.load=9000"];
    let document = study(here.path(), &words);
    let case = &list(&document, "cases")[0];
    let mut words = vec!["run", "scene.toml", "--json", "--set", "step.0.load=9000"];
    for text in list(case, "overrides") {
        words.extend(["--set", text.as_str().expect("an override")]);
    }
    let report = json(&run(here.path(), &words).stdout);
    for count in ["steps", "contact_solves", "contact_iterations", "fft_pairs", "law_calls"] {
        assert_eq!(report["cost"][count], case["work"][count], "{count}");
    }
}

#[test]
fn cycles_are_scaled_and_laws_may_all_run_apart() {
    let here = folder();
    let cycles = LINE.replace("[[step]]\nduration = 0.3", "[[cycle]]\ncount = 40\n[[cycle.step]]\nduration = 0.005");
    write(here.path(), "scene.toml", &format!("{cycles}[integrator]\nsubsteps = 1\n"));
    let words =
        ["scene.toml", "--only", "scaling", "--safety", "0.5,0.1", "--isolate", "--budget", "30s", "--runs", "1"];
    let document = study(here.path(), &words);
    let cases = line(&document, "CBCS");
    assert_eq!(cases.len(), 2);
    let error = |index: usize| number(&cases[index]["errors"]["wear_l2_relative"]);
    let steps = |index: usize| number(&cases[index]["work"]["steps"]);
    assert!(error(1) < error(0) && steps(0) < steps(1) && steps(1) < 40.0, "{cases:?}");
}

#[test]
fn methods_that_a_law_refuses_are_told_once() {
    let here = folder();
    let running_in = scene("fretting_running_in.toml");
    let ended = run(here.path(), &["study", &running_in, "--budget", "10s", "--methods", "tr-bdf2,sdirk2,auto"]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let (_, after) = ended.stdout.split_once("\nrefused\n").unwrap_or_else(|| panic!("{}", ended.stdout));
    let refused = after.split("\n\n").next().expect("a block").split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(refused.starts_with("- tr-bdf2, tr-bdf2 to a tolerance: found method \"tr-bdf2\", but law"), "{refused}");
    assert!(refused.contains("- sdirk2, sdirk2 to a tolerance: found method \"sdirk2\""), "{refused}");
    assert_eq!(ended.stdout.matches("found method \"").count(), 2, "{}", ended.stdout);
}

#[test]
fn an_error_of_0_is_in_the_picture() {
    let here = folder();
    let pin = "[law]\nuse = \"archard\"\nconstants = { K = 0.5, H = 1.0 }\n[contact]\nmodel = \"prescribed\"\n\
        [[step]]\nduration = 1.0\npressure = 1.0\nvelocity = 1.0\n[reference]\nkind = \"archard-prescribed\"\n";
    write(here.path(), "scene.toml", pin);
    let words =
        ["scene.toml", "--only", "substeps", "--methods", "explicit-euler", "--substeps", "1,2", "--budget", "5s"];
    let document = study(here.path(), &words);
    let lines = line(&document, "explicit-euler");
    assert!(!lines.is_empty() && lines.iter().all(|case| case["errors"]["wear_l2_relative"] == 0.0), "{document}");
    let picture = std::fs::read_to_string(here.path().join("scene.study/study.svg")).expect("a picture");
    assert!(picture.contains("\nexplicit-euler\n") && picture.contains("errors of 0 are drawn at 1e-16"), "{picture}");
}

#[test]
fn what_a_scene_does_not_have_is_refused() {
    let here = folder();
    write(here.path(), "scene.toml", LINE);
    let pin = scene("pin_on_disc.toml");
    let message = fails(here.path(), &["study", "scene.toml", "--methods", "runge-kutta"], 2, "input");
    assert!(message.contains("runge-kutta") && message.contains("tr-bdf2"), "{message}");
    for budget in ["0s", "-1s", "5 lightyears", "", "nans"] {
        let message = fails(here.path(), &["study", "scene.toml", &format!("--budget={budget}")], 2, "input");
        assert!(message.contains("budget"), "{message}");
    }
    for words in [["--grids", "16"], ["--only", "grids"]] {
        let message = fails(here.path(), &[&["study", &pin], &words[..]].concat(), 2, "input");
        assert!(message.contains("grid") && message.contains("prescribed"), "{message}");
    }
    let message = fails(here.path(), &["study", &pin, "--safety", "0.1"], 2, "input");
    assert!(message.contains("scaling") && message.contains("no cycles"), "{message}");
    for words in [["--tolerances", "2"], ["--substeps", "0"], ["--grids", "1"], ["--safety", "1.5"], ["--only", "all"]]
    {
        fails(here.path(), &[&["study", "scene.toml"], &words[..]].concat(), 2, "input");
    }
    fails(here.path(), &["study", "none.toml"], 2, "input");
    fails(here.path(), &["study", "scene.toml", "--set", "grid.sells=[4]"], 2, "input");
    write(here.path(), "taken", "a file");
    let message = fails(here.path(), &["study", "scene.toml", "--out", "taken"], 2, "input");
    assert!(message.contains("taken"), "{message}");
    assert!(!here.path().join("scene.study").exists(), "nothing is written before anything is known");
}
