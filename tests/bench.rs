//! `wearlaw bench`: a column for each law, figures that are numbers, and laws that cannot be measured.

#[path = "support/c_laws.rs"]
mod c_laws;
#[path = "support/program.rs"]
mod program;

use std::path::Path;

use c_laws::CLaw;
use program::{LAW, fails, folder, json, run, write};
use serde_json::Value;

/// A short bench: three sizes, one and two threads, a fraction of a second.
const SHORT: [&str; 6] = ["--points", "1,1000,3000", "--threads=1,2", "--budget=0.3", "--seed=3", "--deadline=20"];

/// The source of a law in C that reads pressure and slip, with what happens at a point.
fn law(name: &str, more: &str, point: &str) -> String {
    format!(
        "#define LAW_NAME \"{name}\"\n#define LAW_VERSION \"1.0\"\n#define LAW_SUMMARY \"a law\"\n\
         #define LAW_READS(F) F(pressure) F(slip)\n{more}\n#include \"wearlaw_point.h\"\n#include <unistd.h>\n\
         WL_POINT {{\n    out->increment = 1e-15 * in->pressure * in->slip;\n    {point}\n    return WL_OK;\n}}\n"
    )
}

fn bench(here: &Path, laws: &[&str], more: &[&str]) -> program::Ended {
    run(here, &[&["bench"], laws, &SHORT, more].concat())
}

fn measured(here: &Path, laws: &[&str], more: &[&str]) -> Value {
    let ended = bench(here, laws, &[more, &["--json"]].concat());
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    json(&ended.stdout)
}

/// Rows of the table that the program's own law carries.
fn known_rows() -> usize {
    let text = include_str!("../plugins/archard/expected.csv");
    text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')).count() - 1
}

/// The cells of a row of the table, told by its label.
fn row<'t>(table: &'t str, label: &str) -> Vec<&'t str> {
    let mut lines = table.lines().filter(|line| line.trim_start().starts_with(label));
    let line = lines.next().unwrap_or_else(|| panic!("no row {label} in\n{table}"));
    line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).skip(1).collect()
}

#[test]
fn every_law_has_a_column_and_every_way_of_calling_it_a_row() {
    let here = folder();
    write(here.path(), "half.c", LAW);
    let ended = bench(here.path(), &["embedded:archard", "half.c"], &[]);
    assert_eq!((ended.code, ended.stderr.as_str()), (0, ""));
    let table = ended.stdout;
    let head: Vec<&str> = table.lines().next().unwrap_or_default().split_whitespace().collect();
    assert_eq!((head[0], head[2], head[3]), ("archard", "half", "2.1"), "{table}");
    assert_eq!(row(&table, "from"), ["embedded:archard", "half.c"]);
    assert_eq!(row(&table, "bytes per point"), ["24", "24"]);
    let times: Vec<&str> = table.lines().skip_while(|line| !line.starts_with("ns per point")).collect();
    let labels = |lines: &[&str]| -> Vec<String> {
        let labels = lines.iter().skip(1).take_while(|line| line.starts_with("  "));
        labels.map(|line| line.trim().split("  ").next().unwrap_or_default().to_owned()).collect()
    };
    let several = ["1 point, 1 thread", "1000 points, 1 thread", "3000 points, 1 thread", "3000 points, 2 threads"];
    let isolated = several.map(|label| format!("{label}, isolated"));
    assert_eq!(labels(&times), [several.map(str::to_owned), isolated].concat(), "{table}");
    for line in times.iter().skip(1).take(8) {
        let cells: Vec<&str> = line.trim().split("  ").map(str::trim).filter(|cell| !cell.is_empty()).skip(1).collect();
        assert_eq!(cells.len(), 2, "{line}");
        for cell in cells {
            let (least, median) = cell.split_once(" (").expect("two times");
            let [least, median] = [least, median.trim_end_matches(')')].map(|t| t.parse::<f64>().expect("a number"));
            assert!(least > 0.0 && median >= least, "{line}");
        }
    }
    let bandwidth: Vec<&str> = table.lines().skip_while(|line| !line.starts_with("part of the bandwidth")).collect();
    assert_eq!(labels(&bandwidth).len(), 4, "the largest batch alone\n{table}");
    assert_eq!(row(&table, "largest error"), [format!("{} rows", known_rows()).as_str(), "not known"]);
    let quiet = bench(here.path(), &["half.c"], &["-q"]);
    assert_eq!((quiet.code, quiet.stderr.as_str()), (0, ""));
}

#[test]
fn the_document_has_the_figures_of_the_table() {
    let here = folder();
    let document = measured(here.path(), &["embedded:archard"], &[]);
    let law = &document["laws"][0];
    assert_eq!((law["name"].as_str(), law["from"].as_str()), (Some("archard"), Some("embedded:archard")));
    assert_eq!((law["bytes_per_point"].as_u64(), &law["failure"]), (Some(24), &Value::Null));
    let accuracy = &law["accuracy"];
    assert_eq!(
        (accuracy["table"].as_str(), accuracy["rows"].as_u64()),
        (Some("wearlaw.selftest/1"), Some(known_rows() as u64))
    );
    let increment = &accuracy["answers"][0];
    assert_eq!(increment["answer"], "increment");
    assert!(increment["ulp"].as_u64().is_some_and(|ulp| ulp <= 1), "{increment}");
    let speeds = law["speeds"].as_array().expect("speeds");
    assert_eq!(speeds.len(), 8);
    for speed in speeds {
        let number = |key: &str| speed[key].as_f64().unwrap_or_else(|| panic!("{key}: {speed}"));
        assert!(number("least_ns") > 0.0 && number("median_ns") >= number("least_ns"), "{speed}");
        assert!(number("rounds") >= 3.0, "{speed}");
        let memory = &speed["memory"];
        assert_eq!(memory.is_null(), speed["points"] != 3000, "{speed}");
        if !memory.is_null() {
            assert_eq!(memory["bytes"].as_u64(), Some(72_000));
            assert!(memory["part"].as_f64().is_some_and(|part| part > 0.0), "{speed}");
            // No machine moves a terabyte a second through one core or two.
            assert!(memory["triad_gb_per_s"].as_f64().is_some_and(|speed| speed > 0.01 && speed < 2e3), "{speed}");
        }
    }
    let of = |isolated: bool, points: u64| {
        let mut all = speeds.iter().filter(|speed| speed["isolated"] == isolated && speed["threads"] == 1);
        all.find(|speed| speed["points"] == points).and_then(|speed| speed["least_ns"].as_f64()).expect("a time")
    };
    // A call of another process costs microseconds, a call here nanoseconds; per point a large batch is cheaper.
    assert!(of(true, 1) > 3.0 * of(false, 1) && of(false, 1) > of(false, 3000));
    assert!(document["seconds"].as_f64().is_some_and(|seconds| seconds > 0.0));
}

#[test]
fn the_error_against_known_values_is_told_with_its_row() {
    let here = folder();
    write(here.path(), "half.c", LAW);
    let heads = "k,pressure,slip,dt,increment\n";
    write(
        here.path(),
        "expected.csv",
        &format!("{heads}1e-14,1e8,0.001,1,5e-10\n1e-14,3e8,0.001,1,1.5000000000000006e-9\n"),
    );
    let law = measured(here.path(), &["half.c"], &[])["laws"][0].clone();
    let worst = &law["accuracy"]["answers"][0];
    assert_eq!(law["accuracy"]["rows"], 2);
    assert_eq!((worst["answer"].as_str(), worst["row"].as_u64()), (Some("increment"), Some(2)), "{worst}");
    // 1.5e-9 lies between 2^-30 and 2^-29, where doubles are 2^-82 apart.
    let apart = (worst["expected"].as_f64().unwrap() - worst["found"].as_f64().unwrap()) / 2.0_f64.powi(-82);
    assert_eq!(worst["ulp"].as_f64(), Some(apart), "{worst}");
    assert!((2.0..5.0).contains(&apart), "{worst}");
    let table = bench(here.path(), &["half.c"], &[]).stdout;
    assert_eq!(row(&table, "largest error"), ["2 rows"]);
    assert_eq!(row(&table, "increment"), [format!("{apart} (2)")]);
    // Few digits are no error; a table of another law is no reason to stop, unless it was asked for.
    write(here.path(), "expected.csv", &format!("{heads}1e-14,3e8,0.001,1,1.5e-9\n"));
    assert_eq!(row(&bench(here.path(), &["half.c"], &[]).stdout, "increment"), ["agrees to its 2 digits"]);
    write(here.path(), "expected.csv", "K,increment\n1,1\n");
    let ended = bench(here.path(), &["half.c"], &[]);
    assert_eq!(row(&ended.stdout, "largest error"), ["not known"]);
    assert!(ended.code == 0 && ended.stderr.contains("half: accuracy not known: ") && ended.stderr.contains("`K`"));
    let words = [&["bench", "half.c", "--expected", "expected.csv"][..], &SHORT].concat();
    assert!(fails(here.path(), &words, 2, "input").contains("`K`"));
}

#[test]
fn a_law_with_a_state_is_measured_with_it() {
    let here = folder();
    let state = "#define LAW_STATE(C) C(sum, WL_METRE, WL_FROM(0), 0, \"slid so far\")\n\
                 #define LAW_FLAGS WL_FLAG_SERIAL";
    write(here.path(), "sum.c", &law("sum", state, "out->state.sum = s->sum + in->slip;"));
    write(here.path(), "expected.csv", "pressure,slip,sum_start,increment,sum_end\n1e8,1e-3,2,1e-10,2.001\n");
    let law = measured(here.path(), &["sum.c"], &[])["laws"][0].clone();
    assert_eq!(law["bytes_per_point"].as_u64(), Some(8 * 5), "pressure, slip, increment, state in and out");
    assert!(
        law["notes"]
            .as_array()
            .is_some_and(|notes| notes.iter().any(|n| n.as_str().is_some_and(|n| n.contains("serial"))))
    );
    assert_eq!(law["speeds"].as_array().map(Vec::len), Some(8));
    let answers = law["accuracy"]["answers"].as_array().expect("answers");
    assert_eq!(answers.iter().map(|one| one["answer"].as_str().unwrap()).collect::<Vec<_>>(), ["increment", "sum_end"]);
}

#[test]
fn a_slow_law_is_measured_as_far_as_the_time_goes() {
    let here = folder();
    write(here.path(), "slow.c", &law("slow", "", "usleep(500);"));
    let law = measured(here.path(), &["slow.c"], &[])["laws"][0].clone();
    let points: Vec<u64> = law["speeds"].as_array().unwrap().iter().map(|s| s["points"].as_u64().unwrap()).collect();
    assert_eq!(points, [1, 1]);
    let notes: Vec<&str> = law["notes"].as_array().unwrap().iter().map(|note| note.as_str().unwrap()).collect();
    assert!(notes.iter().any(|note| note.starts_with("1000 points left out: a call would take about ")), "{notes:?}");
}

#[test]
fn a_law_that_fails_ends_with_3_and_leaves_the_others_their_figures() {
    let here = folder();
    let failing = [
        ("refuses", "return WL_OUT_OF_DOMAIN;", "refused every ordinary point that was tried, the last because"),
        ("infinite", "out->increment = 1 / (0 * in->slip);", "expected a finite number"),
        ("crashes", "raise(11);", "crashed"),
        ("leaves", "_exit(0);", "ended"),
    ];
    for (name, point, words) in failing {
        let file = format!("{name}.c");
        write(here.path(), &file, &law(name, "#include <signal.h>", point));
        let message = fails(here.path(), &[&["bench", &file][..], &SHORT].concat(), 3, "law");
        assert!(message.contains(words) && message.contains(name), "{name}: {message}");
    }
    let ended = bench(here.path(), &["crashes.c", "archard"], &[]);
    assert_eq!(ended.code, 3, "{}", ended.stderr);
    assert!(ended.stderr.contains("error: law `crashes` crashed"), "{}", ended.stderr);
    let cells = row(&ended.stdout, "1000 points, 1 thread");
    assert!(cells[0] == "failed" && cells[1].contains('('), "{}", ended.stdout);
    let ended = bench(here.path(), &["crashes.c", "archard"], &["--json"]);
    assert_eq!(ended.code, 3);
    let document = json(&ended.stdout);
    assert!(document["laws"][0]["failure"].as_str().is_some_and(|words| words.contains("crashed")));
    assert!(document["laws"][1]["speeds"].as_array().is_some_and(|speeds| speeds.len() == 8));
}

#[test]
fn a_law_that_fails_in_large_batches_alone_is_told() {
    let here = folder();
    let law = CLaw::new("if (view->points > 500) _exit(3);");
    let path = law.path().display().to_string();
    let message = fails(here.path(), &[&["bench", &path][..], &SHORT].concat(), 3, "law");
    assert!(message.contains("law `small`") && message.contains("exit code 3"), "{message}");
}

#[test]
fn a_law_that_hangs_is_ended() {
    let here = folder();
    write(here.path(), "hangs.c", &law("hangs", "", "for (;;) pause();"));
    let words = ["bench", "hangs.c", "--budget=0.3", "--deadline=0.3"];
    assert!(fails(here.path(), &words, 3, "law").contains("did not answer within 0.3 s"));
}

#[test]
fn what_is_no_law_ends_with_2() {
    let here = folder();
    write(here.path(), "text.so", "no library");
    std::fs::create_dir(here.path().join("empty")).expect("the folder can be written");
    fails(here.path(), &["bench"], 2, "input");
    assert!(fails(here.path(), &["bench", "./text.so"], 2, "input").contains("not a shared library"));
    fails(here.path(), &["bench", "archard", "./none.so"], 2, "input");
    fails(here.path(), &["bench", "./empty"], 2, "input");
    assert!(fails(here.path(), &["bench", "archad"], 2, "input").contains("did you mean `archard`?"));
    assert!(fails(here.path(), &["bench", "archard#other", "--budget=0.1"], 2, "input").contains("`other`"));
    for wrong in ["--points=0", "--threads=0", "--budget=0", "--budget=x"] {
        fails(here.path(), &["bench", "archard", wrong], 2, "input");
    }
    let message = fails(here.path(), &["bench", "archard", "archard", "--expected", "a.csv"], 2, "input");
    assert!(message.contains("--expected"), "{message}");
    fails(here.path(), &["bench", "archard", "--expected", "none.csv", "--budget=0.1"], 2, "input");
}
