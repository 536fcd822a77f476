//! `wearlaw check` from outside: what it prints in which format, how it ends, what it leaves behind, and what brings a
//! failure back.
#![cfg(target_os = "linux")]

#[path = "support/checked.rs"]
mod checked;
#[path = "support/program.rs"]
mod program;

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use checked::{of, outcomes};
use program::{ended, fails, folder, json, run, wearlaw, write};
use serde_json::Value;
use wearlaw::conformance::Check;

/// A law without a fault, with a place for one in front of its answer.
const LAW: &str = r#"
#define _GNU_SOURCE
#include <unistd.h>
#include <stdlib.h>
#include <stdio.h>
#include <signal.h>
#define LAW_NAME "mine"
#define LAW_VERSION "1.0"
#define LAW_SUMMARY "Archard's law"
#define LAW_READS(F) F(pressure) F(slip)
#define LAW_CONSTANTS(C)                                         \
    C(K, WL_NUMBER, WL_FROM(0), WL_REQUIRED, "wear coefficient") \
    C(H, WL_PASCAL, WL_ABOVE(0), WL_REQUIRED, "hardness")
#define LAW_CLAIMS (WL_CLAIM_DETERMINISTIC | WL_CLAIM_NON_NEGATIVE)
#include "wearlaw_point.h"
WL_POINT {
    double pressure = in->pressure < 0 ? 0 : in->pressure;
    out->increment = c->K / c->H * pressure * fabs(in->slip);
    FAULT
    return isfinite(out->increment) ? WL_OK : WL_OUT_OF_DOMAIN;
}
"#;

/// Builds the law with a fault into `NAME.so` in a folder.
fn library(folder: &Path, name: &str, fault: &str) {
    let source = format!("{name}.c");
    write(folder, &source, &LAW.replace("FAULT", fault));
    let built = run(folder, &["build", &source, "-o", &format!("{name}.so")]);
    assert_eq!(built.code, 0, "{}", built.stderr);
}

#[test]
fn the_list_has_every_check_and_needs_no_law() {
    let here = folder();
    let listed = run(here.path(), &["check", "--list"]);
    assert_eq!((listed.code, listed.stderr.as_str()), (0, ""));
    for check in Check::ALL {
        assert!(listed.stdout.contains(check.name()), "{}", check.name());
    }
    let full = Check::ALL.iter().filter(|check| !check.facts().quick).count();
    assert_eq!(listed.stdout.matches("\n  † ").count(), full);
    assert!(listed.stdout.ends_with(&format!("; --quick leaves out the {full} marked with †\n")), "{}", listed.stdout);
    let document = json(&run(here.path(), &["check", "--list", "--json"]).stdout);
    assert_eq!(document.as_array().map(Vec::len), Some(Check::ALL.len()));
}

#[test]
fn jumps_of_the_increment_and_units_that_nothing_states_are_worth_a_warning() {
    let here = folder();
    let warned = |name: &str, law: &str, check: &str| {
        write(here.path(), &format!("{name}.c"), law);
        let ended = run(here.path(), &["check", &format!("{name}.c"), "--only", check, "--json"]);
        let document = json(&ended.stdout);
        let found = of(&document, check);
        (ended.code, found["outcome"].as_str() == Some("warn"), found["what"].as_str().unwrap_or_default().to_owned())
    };
    let slope = "#define LAW_WRITES WL_OUT_D_PRESSURE\n#define LAW_FLAGS WL_FLAG_KINKS\n#include \"wearlaw_p";
    let kinked = LAW.replace("#include \"wearlaw_p", slope);
    let more = |jump: &str| {
        let fault =
            format!("int more = pressure > 3e7; out->d_pressure = c->K / c->H * fabs(in->slip) * (1 + more); {jump}");
        kinked.replace("FAULT", &fault)
    };
    let (code, warns, what) = warned("jumps", &more("out->increment *= 1 + more;"), "derivative/kinks");
    assert!(code == 0 && warns && what.contains("the increment itself jumps"), "{what}");
    let goes_on = more("out->increment += more * c->K / c->H * (pressure - 3e7) * fabs(in->slip);");
    assert_eq!(warned("goes_on", &goes_on, "derivative/kinks"), (0, false, String::new()));

    let bare = |formula: &str| {
        let law = LAW.replace("C(H, WL_PASCAL,", "C(H, WL_NUMBER,");
        law.replace("FAULT", &format!("out->increment = {formula};"))
    };
    let (code, warns, what) = warned("hidden", &bare("c->K * c->H * pressure / 1e9 * fabs(in->slip)"), "physics/units");
    assert!(code == 0 && warns && what.contains("none of its quantities has a unit"), "{what}");
    let free = bare("c->K * c->H * fabs(in->slip) * (pressure > 0)");
    assert_eq!(warned("free", &free, "physics/units"), (0, false, String::new()));
}

#[test]
fn a_derivative_that_is_left_at_zero_is_told_to_be_missing() {
    let here = folder();
    let law = LAW.replace("#include \"wearlaw_p", "#define LAW_WRITES WL_OUT_D_PRESSURE\n#include \"wearlaw_p");
    for (fault, words) in [("out->d_pressure = 0;", "is missing: it is 0"), ("out->d_pressure = 1;", "is wrong")] {
        write(here.path(), "mine.c", &law.replace("FAULT", fault));
        let ended = run(here.path(), &["check", "mine.c", "--only", "derivative/pressure", "-q"]);
        assert!(ended.code == 1 && ended.stdout.contains(words), "{}", ended.stdout);
    }
}

/// Running-in over work with the state of the start of the substep, or over the substep: `RUN_IN` is the one or the other.
const RUNNING_IN: &str = r#"
#define LAW_NAME "running-in"
#define LAW_VERSION "1.0"
#define LAW_SUMMARY "wear from friction work, more of it at first"
#define LAW_READS(F) F(friction_work)
#define LAW_CONSTANTS(C)                                                      \
    C(alpha, WL_PER_PASCAL, WL_FROM(0), WL_REQUIRED, "wear of work")          \
    C(a0, WL_NUMBER, WL_FROM(0), 1, "how much more a new surface wears")      \
    C(W0, WL_JOULE_PER_SQUARE_METRE, WL_ABOVE(0), WL_REQUIRED, "work of running in")
#define LAW_STATE(C) C(W, WL_JOULE_PER_SQUARE_METRE, WL_FROM(0), 0, "work so far")
#define LAW_CLAIMS WL_CLAIM_LINEAR_IN_DT
#include "wearlaw_point.h"
WL_POINT {
    double fresh = exp(-s->W / c->W0) * RUN_IN;
    out->increment = c->alpha * (in->friction_work + (c->a0 - 1) * fresh);
    out->state.W = s->W + in->friction_work;
    return isfinite(out->increment + out->state.W) ? WL_OK : WL_OUT_OF_DOMAIN;
}
"#;

#[test]
fn a_claim_that_a_default_makes_true_is_tried_with_other_constants_and_over_long_times() {
    let here = folder();
    for (name, run_in) in [("held", "in->friction_work"), ("exact", "c->W0 * -expm1(-in->friction_work / c->W0)")] {
        write(here.path(), &format!("{name}.c"), &RUNNING_IN.replace("RUN_IN", run_in));
        let built = run(here.path(), &["build", &format!("{name}.c"), "-o", &format!("{name}.so")]);
        assert_eq!(built.code, 0, "{}", built.stderr);
    }
    for seed in 1..9 {
        let seed = seed.to_string();
        let check = |law| run(here.path(), &["check", law, "--only", "physics/linear-in-dt", "--seed", &seed]);
        let (held, exact) = (check("./held.so"), check("./exact.so"));
        assert_eq!(held.code, 1, "seed {seed}: {}", held.stdout);
        assert_eq!(exact.code, 0, "seed {seed}: {}", exact.stdout);
    }
}

#[test]
fn a_law_that_forgets_the_zero_of_the_scale_is_shown_its_temperature_in_kelvin() {
    let here = folder();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../plugins/faulty/forgets_absolute_zero.c");
    let built = run(here.path(), &["build", source.to_str().expect("a path"), "-o", "forgets.so"]);
    assert_eq!(built.code, 0, "{}", built.stderr);
    let told = run(here.path(), &["check", "./forgets.so", "--only", "physics/*", "--json"]);
    let document = json(&told.stdout);
    assert_eq!(outcomes(&document, "fail"), ["physics/temperature-scale"]);
    let expected = of(&document, "physics/temperature-scale")["expected"].as_str().expect("a text");
    let kelvin = expected.split("`temperature` ").nth(1).and_then(|text| text.split(' ').next());
    let kelvin: f64 = kelvin.and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{expected}"));
    assert!((280.0..420.0).contains(&kelvin), "{expected}");
}

#[test]
fn what_is_no_law_or_no_check_ends_with_2() {
    let here = folder();
    write(here.path(), "text.so", "no library");
    assert!(fails(here.path(), &["check", "./text.so"], 2, "input").contains("not a shared library"));
    fails(here.path(), &["check", "./none.so"], 2, "input");
    fails(here.path(), &["check", "no-such-law"], 2, "input");
    fails(here.path(), &["check"], 2, "input");
    let message = fails(here.path(), &["check", "archard", "--only", "values/finit"], 2, "input");
    assert!(message.contains("did you mean `values/finite`?"), "{message}");
    // Nothing that is asked for applies, so nothing was tested.
    let message = fails(here.path(), &["check", "archard", "--only", "state"], 2, "input");
    assert!(message.contains("no check was run") && message.contains("no state variables"), "{message}");
    fails(here.path(), &["check", "archard", "--quick", "--only", "cost"], 2, "input");
    fails(here.path(), &["check", "archard#other", "--only", "load"], 2, "input");
    fails(here.path(), &["check", "archard", "--replay", "none.json"], 2, "input");
    write(here.path(), "waive.toml", "\"values/finit\" = \"because\"\n");
    fails(here.path(), &["check", "archard", "--waive", "waive.toml"], 2, "input");
}

#[test]
fn a_failure_tells_its_author_what_to_do_and_can_be_run_again() {
    let here = folder();
    library(here.path(), "mine", "if (in->pressure < 0) out->increment = 1;");
    let words = ["check", "mine.so", "--only", "values", "--seed", "7"];
    let text = run(here.path(), &words);
    assert_eq!(text.code, 1, "{}", text.stderr);
    for words in [
        "FAIL       values/negative-pressure",
        "what      negative pressure wears",
        "input     pressure -",
        "found     increment 1\n",
        "expected  increment 0, or a status\n",
        "rule      no wear at negative pressure (include/README.md, \"The contract\")",
        "again     wearlaw check mine.so#mine --replay mine.check/mine.values-negative-pressure.json",
        "BLOCKED    values/extremes",
        "falls short: ",
        "seed 7)",
    ] {
        assert!(text.stdout.contains(words), "{words}\nin\n{}", text.stdout);
    }
    let replay = "mine.check/mine.values-negative-pressure.json";
    let again = run(here.path(), &["check", "mine.so", "--replay", replay, "--json"]);
    assert_eq!(again.code, 1, "{}", again.stderr);
    let (first, again) = (json(&run(here.path(), &[&words[..], &["--json"]].concat()).stdout), json(&again.stdout));
    assert_eq!(again["checks"].as_array().map(Vec::len), Some(1));
    let name = "values/negative-pressure";
    assert_eq!(of(&again, name)["input"], of(&first, name)["input"], "the same input at the first try");
    assert_eq!(of(&first, name)["rule"]["section"], "The contract");

    let quiet = run(here.path(), &[&words[..], &["-q"]].concat());
    let (code, lines) = (quiet.code, quiet.stdout.lines().collect::<Vec<_>>());
    assert_eq!((code, lines.len()), (1, 2), "a line for the failure and the last line: {}", quiet.stdout);
    assert!(lines[0].contains("FAIL       values/negative-pressure") && lines[0].ends_with("negative pressure wears"));

    // With the fault mended the replay passes, and the next check takes the file away.
    library(here.path(), "mine", "");
    assert_eq!(run(here.path(), &["check", "mine.so", "--replay", replay]).code, 0);
    assert!(here.path().join(replay).exists());
    assert_eq!(run(here.path(), &["check", "mine.so", "--only", "batch", "--quick"]).code, 0);
    assert!(here.path().join(replay).exists(), "it is of a check that was not run");
    assert_eq!(run(here.path(), &words).code, 0);
    assert!(!here.path().join("mine.check").exists());
}

#[test]
fn what_quick_leaves_out_is_told_of_what_was_meant() {
    let here = folder();
    let left_out = |words: &[&str]| {
        let text = run(here.path(), &[&["check", "archard", "--only"], words].concat()).stdout;
        text.lines().find_map(|line| line.strip_prefix("left out by --quick: ").map(str::to_owned))
    };
    assert_eq!(left_out(&["values/zero-dt,derivative"]), None);
    assert_eq!(left_out(&["derivative", "--quick"]), None);
    assert_eq!(left_out(&["batch/empty,batch/large", "--quick"]).as_deref(), Some("batch/large"));
}

#[test]
fn a_crash_names_the_call_the_point_and_its_inputs_and_comes_back() {
    let here = folder();
    library(here.path(), "mine", "if (in->slip > 1e100) { volatile int *volatile p = NULL; *p = 1; }");
    let ended = run(here.path(), &["check", "mine.so", "--only", "faults,values,batch", "--json"]);
    assert_eq!(ended.code, 1);
    let document = json(&ended.stdout);
    assert_eq!(outcomes(&document, "crashed"), ["faults/signal"], "one fault, one finding");
    let found = of(&document, "faults/signal");
    let what = found["what"].as_str().expect("a sentence");
    for words in ["SIGSEGV", "in evaluate (call ", "1 point", "with provoking inputs", "NULL pointer"] {
        assert!(what.contains(words), "{words} in {what}");
    }
    let slip: f64 = found["input"]["slip"].as_str().and_then(|text| text.parse().ok()).expect("the input is told");
    assert!(slip > 1e100, "{slip}");
    // What the same crash ends is blocked by it; what gets by without it is judged.
    assert_eq!(of(&document, "values/extremes")["blocked_by"], "faults/signal");
    assert_eq!(of(&document, "batch/empty")["outcome"], "pass");
    let replay = found["replay"].as_str().expect("a file to bring it back").to_owned();
    let again = json(&run(here.path(), &["check", "mine.so", "--replay", &replay, "--json"]).stdout);
    assert_eq!(of(&again, "faults/signal")["input"], found["input"]);
}

#[test]
fn a_state_that_overflows_and_a_row_that_no_host_gives_are_found() {
    let here = folder();
    let state = "#define LAW_STATE(S) S(distance, WL_METRE, WL_FROM(0), 0, \"sliding distance\")\n#include \"wearlaw_p";
    let count = "out->state.distance = s->distance + fabs(in->slip);\n\
                 if (!isfinite(in->slip) || !isfinite(s->distance)) return WL_OUT_OF_DOMAIN;";
    write(here.path(), "mine.c", &LAW.replace("#include \"wearlaw_p", state).replace("FAULT", count));
    let document = json(&run(here.path(), &["check", "mine.c", "--only", "values", "--json"]).stdout);
    assert_eq!(outcomes(&document, "fail"), ["values/extremes"]);
    let found = of(&document, "values/extremes")["found"].as_str().unwrap_or("").to_owned();
    assert_eq!(found, "status 0, state inf");

    let head = "K,H,pressure,slip,dt,increment\n";
    let told = |row: &str, fault: &str| {
        write(here.path(), "mine.c", &LAW.replace("FAULT", fault));
        write(here.path(), "expected.csv", &format!("{head}{row}\n"));
        let ended = run(here.path(), &["check", "mine.c", "--only", "values/expected", "--json"]);
        let document = json(&ended.stdout);
        (ended.code, of(&document, "values/expected")["what"].as_str().unwrap_or("").to_owned())
    };
    let (code, what) = told("-1,2e9,5e7,1e-3,1,-2.5e-5", "");
    assert!(
        code == 1 && what.ends_with("line 2: K = -1 lies outside of its bounds, so no host gives it to the law"),
        "{what}"
    );
    let (code, what) = told("1e-4,2e9,5e7,1e-3,1,2.5e-9", "return WL_UNRELIABLE;");
    assert!(code == 1 && what.ends_with("line 2 is answered as unreliable"), "{what}");
    assert_eq!(told("1e-4,2e9,5e7,1e-3,1,2.5e-9", ""), (0, String::new()));
}

#[test]
fn each_ending_is_told_by_its_own_check() {
    let here = folder();
    let ending = |name: &str, fault: &str| {
        library(here.path(), name, fault);
        let words = ["check", &format!("{name}.so"), "--only", "faults", "--timeout", "2", "--json"];
        let document = json(&run(here.path(), &words).stdout);
        let lost: Vec<String> = ["fail", "crashed", "timed-out"]
            .iter()
            .flat_map(|outcome| outcomes(&document, outcome))
            .map(str::to_owned)
            .collect();
        assert_eq!(lost.len(), 1, "{name}: {document:#}");
        assert_eq!(of(&document, &lost[0])["printed"].as_str().unwrap_or(""), if name == "says" { "why" } else { "" });
        lost[0].clone()
    };
    assert_eq!(ending("exits", "if (in->pressure > 1e100) exit(0);"), "faults/exit");
    assert_eq!(ending("aborts", "if (in->pressure > 1e100) abort();"), "faults/abort");
    assert_eq!(ending("says", "if (in->pressure > 1e100) { fputs(\"why\", stderr); abort(); }"), "faults/abort");
    assert_eq!(ending("hangs", "if (in->pressure > 1e100) for (;;) pause();"), "faults/hang");
    assert_eq!(ending("raises", "if (in->pressure > 1e100) raise(SIGSEGV);"), "faults/signal");
}

#[test]
fn a_library_that_aborts_on_load_fails_one_check_and_blocks_the_rest() {
    let here = folder();
    let law =
        format!("{}\n__attribute__((constructor)) static void opened(void) {{ abort(); }}\n", LAW.replace("FAULT", ""));
    write(here.path(), "mine.c", &law);
    // `build` would load it.
    let include = Path::new(env!("CARGO_MANIFEST_DIR")).join("../include");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let status = Command::new(compiler)
        .current_dir(here.path())
        .args(["-std=gnu99", "-fPIC", "-shared", "mine.c", "-o", "mine.so", "-lm", "-I"])
        .arg(include)
        .status();
    assert!(status.expect("a C compiler").success());
    let ended = run(here.path(), &["check", "mine.so", "--json"]);
    assert_eq!(ended.code, 1);
    let document = json(&ended.stdout);
    assert_eq!(outcomes(&document, "crashed"), ["load/opens"]);
    assert_eq!(outcomes(&document, "pass"), ["load/symbols"]);
    assert_eq!(outcomes(&document, "blocked").len(), Check::ALL.len() - 2);
    // Also where the check that fails was not asked for.
    let only = json(&run(here.path(), &["check", "mine.so", "--only", "values/finite", "--json"]).stdout);
    assert_eq!((outcomes(&only, "crashed"), outcomes(&only, "blocked")), (vec!["load/opens"], vec!["values/finite"]));
}

#[test]
fn a_waiver_switches_a_check_off_with_its_reason() {
    let here = folder();
    library(here.path(), "mine", "if (in->pressure < 0) out->increment = 1;");
    write(here.path(), "waive.toml", "\"values/negative-pressure\" = \"tension wears here\"\n");
    let words = ["check", "mine.so", "--only", "values/negative-pressure,values/zero-slip", "--waive", "waive.toml"];
    let text = run(here.path(), &words);
    assert_eq!(text.code, 0, "{}", text.stdout);
    assert!(text.stdout.contains("waived: tension wears here"), "{}", text.stdout);
    let nothing = ["check", "mine.so", "--only", "values/negative-pressure", "--waive", "waive.toml"];
    assert!(fails(here.path(), &nothing, 2, "input").contains("waived: tension wears here"));
}

#[test]
fn junit_and_json_tell_the_same() {
    let here = folder();
    library(here.path(), "mine", "if (in->pressure < 0) out->increment = 1;");
    let junit = run(here.path(), &["check", "mine.so", "--only", "values", "--format", "junit"]);
    assert_eq!((junit.code, junit.stderr.as_str()), (1, ""));
    let document = json(&run(here.path(), &["check", "mine.so", "--only", "values", "--format", "json"]).stdout);
    let checks = document["checks"].as_array().map_or(0, Vec::len);
    assert_eq!(junit.stdout.matches("<testcase ").count(), checks);
    assert_eq!(junit.stdout.matches("<failure ").count(), outcomes(&document, "fail").len());
    assert!(junit.stdout.starts_with("<?xml") && junit.stdout.contains("name=\"values/negative-pressure\""));
    assert!(junit.stdout.trim_end().ends_with("</testsuites>"));
}

#[test]
fn sources_are_built_and_every_law_of_a_library_is_checked() {
    let here = folder();
    write(here.path(), "mine.c", &LAW.replace("FAULT", ""));
    write(here.path(), "expected.csv", "K,H,pressure,slip,dt,increment\n1e-4,2e9,5e7,1e-3,1,2.6e-9\n");
    let ended = run(here.path(), &["check", "mine.c", "--only", "values/expected"]);
    assert_eq!(ended.code, 1, "the value is off: {}", ended.stdout);
    for words in ["expected.csv, line 2: increment does not come out", "found     increment 2.5", "2.6e-9, to 2.6e-21"]
    {
        assert!(ended.stdout.contains(words), "{words} in {}", ended.stdout);
    }
    // A row may say that the law refuses it, and is shown with all that it gives.
    let head = "K,H,pressure,slip,dt,time,absolute_zero,status,increment";
    write(here.path(), "expected.csv", &format!("{head}\n1e-4,2e9,inf,1e-3,1,2,-273.15,3,\n"));
    let words = ["check", "mine.c", "--only", "values/expected"];
    assert_eq!(run(here.path(), &words).code, 0);
    write(here.path(), "expected.csv", &format!("{head}\n1e-4,2e9,1,1e-3,1,2,-273.15,3,\n"));
    let ended = run(here.path(), &words);
    for words in ["line 2 is answered", "found     status 0", "status 3\n", "dt 1, absolute_zero -273.15, time 2\n"] {
        assert!(ended.stdout.contains(words), "{words} in {}", ended.stdout);
    }
    assert!(!here.path().join("libmine.so").exists(), "what is built on the way goes again");

    for name in ["one", "two"] {
        let fault = if name == "two" { "if (in->pressure < 0) out->increment = 1;" } else { "" };
        let source = LAW.replace("FAULT", fault).replace("\"mine\"", &format!("\"{name}\""));
        write(here.path(), &format!("{name}.c"), &format!("#define LAW_FILL {name}_fill\n{source}"));
    }
    write(
        here.path(),
        "entry.c",
        "#include \"wearlaw.h\"\nint32_t one_fill(wl_law *law);\nint32_t two_fill(wl_law *law);\n\
         int32_t wearlaw_entry_1(int32_t index, const wl_host *host, wl_law *law) {\n(void)host;\n\
         return index == 0 ? one_fill(law) : index == 1 ? two_fill(law) : WL_NO_MORE; }\n",
    );
    assert_eq!(run(here.path(), &["build", "entry.c", "one.c", "two.c", "-o", "both.so"]).code, 0);
    let words = ["check", "both.so", "--only", "load/opens,values/negative-pressure", "--json"];
    let document = json(&run(here.path(), &words).stdout);
    assert_eq!(document["laws"], serde_json::json!(["one", "two"]));
    let told: Vec<_> =
        document["checks"].as_array().into_iter().flatten().map(|c| (&c["law"], &c["outcome"])).collect();
    let [none, one, two, pass, fail] = [Value::Null, "one".into(), "two".into(), "pass".into(), "fail".into()];
    assert_eq!(told, [(&none, &pass), (&one, &pass), (&two, &fail)]);
    let words = ["check", "both.so#one", "--only", "values/negative-pressure"];
    assert_eq!(run(here.path(), &words).code, 0, "the other law is not asked for");
}

#[test]
fn nothing_is_left_of_laws_that_fork_and_hang() {
    let here = folder();
    let temporary = folder();
    // Seconds of sleep that no other process of the machine sleeps.
    let long = (900_000_000 + u64::from(std::process::id())).to_string();
    // A child in a session of its own, with a child; then the law hangs, crashes, or goes on.
    let fork = "if (in->pressure > 1e100) { if (fork() == 0) { setsid(); putenv(\"A=b\"); if (fork() == 0) \
                execl(\"/bin/sleep\", \"sleep\", \"LONG\", (char *)NULL); for (;;) pause(); } ";
    let fork = fork.replace("LONG", &long);
    library(here.path(), "hangs", &format!("{fork} for (;;) pause(); }}"));
    library(here.path(), "crashes", &format!("{fork} abort(); }}"));
    library(here.path(), "goes_on", &format!("{fork} }}"));
    for name in ["hangs", "crashes", "goes_on"] {
        let words = ["check", &format!("{name}.so"), "--only", "faults", "--timeout", "1", "-q"];
        let mut command = wearlaw(here.path(), &words);
        let came = ended(command.env("TMPDIR", temporary.path()).output().expect("the program starts"), &words);
        assert_eq!(came.code, i32::from(name != "goes_on"), "{name}: {}", came.stdout);
    }
    let sleeping = || {
        let processes = std::fs::read_dir("/proc").expect("there is a /proc").flatten();
        processes
            .filter(|process| {
                let line = std::fs::read(process.path().join("cmdline")).unwrap_or_default();
                line.windows(long.len()).any(|word| word == long.as_bytes())
            })
            .count()
    };
    let patience = Instant::now() + Duration::from_secs(5);
    while sleeping() > 0 && Instant::now() < patience {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert_eq!(sleeping(), 0, "a process is left");
    let files = std::fs::read_dir(temporary.path()).expect("the folder is there").count();
    assert_eq!(files, 0, "a temporary file is left");
}
