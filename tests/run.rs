//! `wearlaw run` and `wearlaw plan` from outside: what they print and write, and every way they end.

#[path = "support/program.rs"]
mod program;

use program::{LAW, REFUSING, fails, folder, json, run, write};

const SCENE: &str = "title = \"Three seconds\"\n[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n\
    [contact]\nmodel = \"prescribed\"\nhistory = \"history.csv\"\n";
const HISTORY: &str = "time,point,pressure,velocity\n0,0,1e8,0.1\n3,0,2e8,0.1\n";

#[test]
fn run_lists_the_exact_answers_and_points_at_mistakes_of_a_scene() {
    let here = folder();
    let list = run(here.path(), &["run", "--references"]);
    assert!(list.code == 0 && list.stdout.contains("archard-prescribed"), "{}", list.stderr);
    let document = json(&run(here.path(), &["run", "--references", "--json"]).stdout);
    assert_eq!(document["references"][0]["kind"], "archard-prescribed");
    write(
        here.path(),
        "scene.toml",
        "[law]\nuse = \"archad\"\n[contact]\nmodel = \"prescribed\"\nhistory = \"a.csv\"\n",
    );
    for command in ["run", "plan"] {
        let message = fails(here.path(), &[command, "scene.toml"], 2, "input");
        assert!(message.contains("did you mean `archard`"), "{message}");
        let message = fails(here.path(), &[command, "scene.toml", "--set", "contact.modle=1"], 2, "input");
        assert!(message.contains("`contact.modle`") || message.contains("`modle`"), "{message}");
        fails(here.path(), &[command, "scene.toml", "--law", "./none.so"], 2, "input");
        fails(here.path(), &[command, "none.toml"], 2, "input");
        fails(here.path(), &[command], 2, "input");
    }
    let shown = run(here.path(), &["run", "scene.toml"]).stderr;
    assert!(shown.contains("scene.toml:2:7") && shown.contains("^^^^^^^^"), "{shown}");
    fails(here.path(), &["run", "scene.toml", "--threads", "0"], 2, "input");
    fails(here.path(), &["run", "--references", "scene.toml"], 2, "input");
    assert_eq!(std::fs::read_dir(here.path()).unwrap().count(), 1, "no run, no results");
}

#[test]
fn plan_lists_what_is_computed_and_what_is_left_out() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    write(here.path(), "history.csv", HISTORY);
    let plain = run(here.path(), &["plan", "scene.toml"]);
    assert_eq!((plain.code, plain.stderr.as_str()), (0, ""));
    for words in ["computed", "law `archard`", "left out", "temperatures", "memory", "together", "cost"] {
        assert!(plain.stdout.contains(words), "{words} in {}", plain.stdout);
    }
    let document = json(&run(here.path(), &["plan", "scene.toml", "--json"]).stdout);
    assert_eq!(document["points"], 1);
    let skipped = document["skipped"].as_array().unwrap();
    assert!(skipped.iter().any(|one| one["what"] == "temperatures" && one["why"].is_string()));
    let lines = document["memory"].as_array().unwrap();
    let sum: u64 = lines.iter().map(|line| line["bytes"].as_u64().unwrap()).sum();
    assert!(sum > 0 && document["memory_bytes"] == sum);
    assert_eq!(std::fs::read_dir(here.path()).unwrap().count(), 2, "a plan writes nothing");
}

#[test]
fn plan_says_which_key_is_wrong_before_anything_runs() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    let message = fails(here.path(), &["plan", "scene.toml"], 2, "input");
    assert!(message.contains("history.csv"), "{message}");
    write(here.path(), "history.csv", HISTORY);
    let set = ["plan", "scene.toml", "--set", "law.constants.H=0"];
    let message = fails(here.path(), &set, 2, "input");
    assert!(message.contains("`H`") && message.contains("(0, inf)"), "{message}");
    let document = json(&run(here.path(), &["plan", "scene.toml", "--set", "law.sha256=\"00\"", "--json"]).stdout);
    assert_eq!(document["error"]["key"], "law.sha256");
    write(here.path(), "deck.inp", "TB,WEAR,7,,,ARCD\nTBDATA,1,1e-4,1e1x\n");
    let words = ["plan", "scene.toml", "--set", "law.apdl=\"deck.inp\""];
    let message = fails(here.path(), &words, 2, "input");
    assert!(message.contains("1e1x"), "{message}");
    let document = json(&run(here.path(), &[&words[..], &["--json"]].concat()).stdout);
    assert_eq!((&document["error"]["line"], &document["error"]["key"]), (&2.into(), &"law.apdl".into()));
    assert!(run(here.path(), &words).stderr.contains("deck.inp:2:15"));
}

#[test]
fn a_law_is_taken_from_a_source_a_library_or_another_process() {
    let here = folder();
    write(here.path(), "scene.toml", &SCENE.replace("K = 1e-4, H = 1e10", "k = 1e-14"));
    write(here.path(), "history.csv", HISTORY);
    write(here.path(), "half.c", LAW);
    let built = run(here.path(), &["plan", "scene.toml", "--law", "half.c"]);
    assert!(built.code == 0 && built.stdout.contains("law `half`"), "{}", built.stderr);
    let names = || std::fs::read_dir(here.path()).unwrap().count();
    assert_eq!(names(), 3, "a law that is built on the way leaves nothing behind");
    assert_eq!(run(here.path(), &["build", "half.c", "-q"]).code, 0);
    for isolate in [&[][..], &["--isolate"]] {
        let words = [&["plan", "scene.toml", "--law", "libhalf.so"], isolate].concat();
        let plain = run(here.path(), &words);
        assert!(plain.code == 0 && plain.stdout.contains("law `half`"), "{isolate:?}: {}", plain.stderr);
        let pin = format!("law.sha256=\"{}\"", "0".repeat(64));
        let message = fails(here.path(), &[&words[..], &["--set", &pin]].concat(), 2, "input");
        assert!(message.contains("SHA-256"), "{message}");
    }
    write(here.path(), "refusing.c", REFUSING);
    assert_eq!(run(here.path(), &["build", "refusing.c"]).code, 3);
    for isolate in [&[][..], &["--isolate"]] {
        fails(here.path(), &[&["plan", "scene.toml", "--law", "librefusing.so"], isolate].concat(), 3, "law");
    }
}

/// A law that does as `body` says at every point, with its pressure as `p`.
fn law(body: &str) -> String {
    let loop_body = format!("double p = in->pressure; {body} return WL_OK; ");
    let start = LAW.split("WL_POINT").next().expect("its declarations");
    let start = start.replace("#include", "#define LAW_CLAIMS WL_CLAIM_LINEAR_IN_DT\n#include");
    format!("#include <signal.h>\n{start}WL_POINT {{ {loop_body} }}\n")
}

/// A folder with a scene for `half`'s constants, and a law of that body built in it.
fn with_law(body: &str) -> tempfile::TempDir {
    let here = folder();
    write(
        here.path(),
        "scene.toml",
        &SCENE.replace("K = 1e-4, H = 1e10", "k = 1e-14").replace("archard", "./liblaw.so"),
    );
    write(here.path(), "history.csv", HISTORY);
    write(here.path(), "law.c", &law(body));
    let built = run(here.path(), &["build", "law.c", "-o", "liblaw.so", "-q"]);
    assert_eq!(built.code, 0, "{}", built.stderr);
    here
}

const GOOD: &str = "out->increment = c->k * p * in->slip;";

#[test]
fn run_writes_results_and_sums_them_up() {
    let here = folder();
    write(here.path(), "scene.toml", &format!("{SCENE}[reference]\nkind = \"archard-prescribed\"\n"));
    write(here.path(), "history.csv", HISTORY);
    let plain = run(here.path(), &["run", "scene.toml"]);
    assert_eq!((plain.code, plain.stderr.as_str()), (0, ""));
    // K / H times the integral of p v: 1e-14 * 0.1 * 3 * 1.5e8
    for words in ["Three seconds", "archard", "4.5000000000e-7 m", "archard-prescribed", "scene.out"] {
        assert!(plain.stdout.contains(words), "{words} in {}", plain.stdout);
    }
    let timed = plain.stdout.lines().find(|line| line.contains("error, run time")).expect("one line for both");
    assert!(timed.contains("archard-prescribed") && (timed.contains(" us") || timed.contains(" ms")), "{timed}");
    for file in ["report.json", "history.csv", "plot.svg"] {
        assert!(here.path().join("scene.out").join(file).is_file(), "{file}");
    }
    let quiet = run(here.path(), &["run", "scene.toml", "-q", "--out", "other", "--threads", "1"]);
    assert_eq!((quiet.code, quiet.stdout.as_str(), quiet.stderr.as_str()), (0, "", ""));
    let ended = run(here.path(), &["run", "scene.toml", "--json", "--law", "embedded:archard"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (0, ""));
    let document = json(&ended.stdout);
    let depth = document["result"]["max_wear_depth"].as_f64().expect("a depth");
    assert!((depth - 4.5e-7).abs() < 1e-18, "{depth}");
    assert_eq!(document["law"]["path"], "embedded:archard");
    assert_eq!(document, json(&std::fs::read_to_string(here.path().join("scene.out/report.json")).unwrap()));
    std::fs::create_dir(here.path().join("mine")).unwrap();
    write(here.path(), "mine/notes", "mine");
    let message = fails(here.path(), &["run", "scene.toml", "--out", "mine"], 2, "input");
    assert!(message.contains("notes"), "{message}");
}

#[test]
fn a_bar_that_is_missed_ends_with_1_and_whole_results() {
    let here = folder();
    write(here.path(), "scene.toml", &format!("{SCENE}[reference]\nkind = \"archard-prescribed\"\nbar = 1e-6\n"));
    write(here.path(), "history.csv", HISTORY);
    assert_eq!(run(here.path(), &["run", "scene.toml"]).code, 0);
    write(here.path(), "far.csv", "point,wear\n0,5e-7\n");
    let words = ["run", "scene.toml", "--set", "reference.file=\"far.csv\""];
    let missed = run(here.path(), &words);
    assert!(missed.code == 1 && missed.stderr.contains("bar"), "{}: {}", missed.code, missed.stderr);
    let document = json(&run(here.path(), &[&words[..], &["--json"]].concat()).stdout);
    assert!((document["error"]["value"].as_f64().unwrap() - 0.1).abs() < 1e-9, "{}", document["error"]);
}

#[test]
fn a_law_that_fails_at_a_point_ends_with_3_and_keeps_what_was_done() {
    for (body, words) in [
        ("if (p > 1.5e8) return WL_REFUSE(out, WL_FAILED, \"too hot at %g\", p); out->increment = 0;", "too hot at"),
        ("out->increment = p > 1.5e8 ? 0.0 / (p - p) : 0.0;", "increment = NaN"),
    ] {
        let here = with_law(body);
        for isolate in [&[][..], &["--isolate"]] {
            let words_typed = [&["run", "scene.toml"], isolate].concat();
            let message = fails(here.path(), &words_typed, 3, "law");
            assert!(message.contains(words) && message.contains("pressure ="), "{message}");
            assert!(here.path().join("scene.out/report.json").is_file());
        }
    }
    let here = with_law("if (p > 1.5e8) raise(SIGSEGV); out->increment = 0;");
    let message = fails(here.path(), &["run", "scene.toml", "--isolate"], 3, "law");
    assert!(message.contains("crashed") && message.contains("signal 11"), "{message}");
}

#[test]
fn a_tolerance_out_of_reach_ends_with_4() {
    // Another value for every pressure, however close: no quadrature settles.
    let noise = "out->increment = in->slip * 1e-9 * (1 + (double)((int64_t)(p * 7919.0) % 97));";
    let here = with_law(noise);
    let words = ["run", "scene.toml", "--set", "integrator.tolerance=1e-12"];
    let message = fails(here.path(), &words, 4, "numbers");
    assert!(message.contains("tolerance"), "{message}");
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_ends_with_130_and_keeps_what_was_done() {
    let here = with_law(&format!("static int asked; if (!asked) {{ asked = 1; raise(SIGINT); }} {GOOD}"));
    let ended = run(here.path(), &["run", "scene.toml"]);
    assert_eq!(ended.code, 130, "{}", ended.stderr);
    let report = json(&std::fs::read_to_string(here.path().join("scene.out/report.json")).unwrap());
    let time = report["result"]["time"].as_f64().expect("a time");
    assert!(report["ended"] == "interrupted" && time > 0.0 && time < 3.0, "{time}");
    // Twice: nobody waits for a law that does not come back.
    let here = with_law(&format!("raise(SIGINT); raise(SIGINT); {GOOD}"));
    let ended = run(here.path(), &["run", "scene.toml"]);
    assert_eq!(ended.code, 130, "{}", ended.stderr);
    assert!(!here.path().join("scene.out").exists());
}

#[test]
fn the_page_of_a_run_holds_everything_and_needs_nothing() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    write(here.path(), "history.csv", HISTORY);
    let plain = run(here.path(), &["run", "scene.toml", "--out", "plain"]);
    assert!(plain.code == 0 && !here.path().join("plain/report.html").exists(), "{}", plain.stderr);
    let ended = run(here.path(), &["run", "scene.toml", "--html", "--set", "title=A<B & \"C\""]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let page = std::fs::read_to_string(here.path().join("scene.out/report.html")).unwrap();
    for part in [
        "<h1>A&lt;B &amp; &quot;C&quot;</h1>",
        "Largest wear depth",
        "4.5×10⁻⁷ m",
        "Run time",
        "Estimated error",
        "relative L2 error of the wear depth: steps in time, not the law",
        "<svg",
        "temperatures",
        "SHA-256 of the history",
        "H = 10000000000, K = 0.0001",
        "a prescribed pressure has no stability limit",
    ] {
        assert!(page.contains(part), "{part} in {page}");
    }
    for part in ["<script", "src=", "href=", "url(", "@import", "none; estimated"] {
        assert!(!page.contains(part), "{part}");
    }
    for element in
        ["h1", "h2", "dl", "dt", "dd", "div", "table", "tr", "td", "ul", "li", "figure", "svg", "details", "main"]
    {
        let (begins, ends) = (format!("<{element}"), format!("</{element}>"));
        let begun = page.match_indices(&begins).filter(|(at, _)| page[at + begins.len()..].starts_with([' ', '>']));
        assert_eq!(begun.count(), page.matches(&ends).count(), "{element}");
    }
}

#[test]
fn the_error_of_steps_and_grid_is_estimated_where_it_is_asked_for() {
    let here = folder();
    let scene = |more: &str| {
        format!(
            "[law]\nuse = \"archard\"\nconstants = [1e-4, 1e10]\n[contact]\nmodel = \"foundation\"\ndimension = 2\n\
             stiffness = 1e13\n[grid]\nsize = [6e-4]\ncells = [40]\n[surface]\nshape = \"cylinder\"\nradius = 1e-2\n\
             [[step]]\nduration = 100\nload = 1000\nvelocity = 1\n[integrator]\nsubsteps = 20\n{more}"
        )
    };
    write(here.path(), "plain.toml", &scene(""));
    write(here.path(), "asked.toml", &scene("[output]\nerror_estimate = true\n"));
    let plain = json(&run(here.path(), &["run", "plain.toml", "--json"]).stdout);
    let asked = run(here.path(), &["run", "asked.toml", "--json"]);
    let asked = json(&asked.stdout);
    assert!(plain["error"].is_null(), "fixed substeps say nothing of themselves: {}", plain["error"]);
    let estimate = &asked["error"]["estimate"];
    for part in ["steps", "grid", "total"] {
        for norm in ["wear_l2_relative", "pressure_l2_relative"] {
            let value = estimate[part][norm].as_f64().unwrap_or_else(|| panic!("{part}.{norm} in {estimate}"));
            assert!(value > 0.0 && value < 0.1, "{part}.{norm}: {value}");
        }
    }
    let sum = |norm: &str| estimate["steps"][norm].as_f64().unwrap() + estimate["grid"][norm].as_f64().unwrap();
    assert_eq!(estimate["total"]["wear_l2_relative"], sum("wear_l2_relative"));
    assert_eq!(asked["error"]["value"], estimate["total"]["wear_l2_relative"]);
    let summary = run(here.path(), &["run", "asked.toml", "--set", "integrator.substeps=1"]).stdout;
    assert!(
        summary.contains("estimated error") && summary.contains("one substep per load step cannot be halved"),
        "{summary}"
    );
    let stopped = run(here.path(), &["run", "asked.toml", "--set", "stop.wear_depth=1e-7", "--json"]);
    let without = json(&stopped.stdout)["error"].to_string();
    assert!(stopped.code == 0 && (without == "null" || without.contains("ended early")), "{without}");
}
