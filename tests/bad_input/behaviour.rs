//! Laws that misbehave in a run, from half of it on: exit code 3 with the point and its inputs, results so far kept.

use super::c_laws::CLaw;
use super::program::{Ended, Room};

/// What a law does at point 8 from time 0.5 on, chosen by its constant.
const MISDEEDS: &str = r#"
  if (view->time < 0.5 || p < 3) return WL_OK;
  switch ((int)at(view->constants[0], i)) {
    case 1: return WL_OUT_OF_DOMAIN;
    case 2: return WL_FAILED;
    case 3: return 42;
    case 5: output->missing = WL_FIELD_GAP; return WL_MISSING_INPUT;
    case 6: output->increment[i] = NAN; break;
    case 7: output->increment[i] = INFINITY; break;
    case 8: output->increment[i] = -1e-9; break;
    case 9: if (output->direction) output->direction[3 * i + 2] = 2; break;
    case 10: if (output->direction) { output->direction[3 * i] = 1; output->direction[3 * i + 2] = 0; } break;
    case 11: if (output->direction) output->direction[3 * i + 2] = 1; break;
    case 12: output->dt_factor = 1; return WL_CUT_STEP;
    case 13: output->dt_factor = 0.5; return WL_CUT_STEP;
    case 14: if (output->direction) output->direction[3 * i] = NAN; break;
    case 20: *(volatile int *)8 = 1; break;
    case 21: abort();
    case 22: exit(0);
    case 23: for (;;) { volatile int spin = 0; (void)spin; }
  }
"#;

/// A law of the misdeeds, which claims that it never gives a negative increment.
pub fn misbehaving() -> CLaw {
    CLaw::with("#define CLAIMS WL_CLAIM_NON_NEGATIVE\n", MISDEEDS)
}

/// Runs the law with one misdeed until it fails, and holds what is left behind to what was promised.
pub fn caught(law: &CLaw, misdeed: u32, more: &[&str], telling: &[&str]) -> Ended {
    let room = Room::new();
    let (path, constant) = (law.path(), format!("law.constants=[{misdeed}]"));
    let mut words = vec!["run", "scene.toml", "--out", "kept", "--law", path.to_str().expect("a plain name")];
    words.extend(["--set", &constant, "--set", "output.fields=[\"wear\"]"]);
    words.extend(more);
    let ended = room.run(&words);
    assert_eq!(ended.code, 3, "misdeed {misdeed}: {} {}", ended.stdout, ended.stderr);
    let error = ended.stderr.lines().find(|line| line.starts_with("error: ")).unwrap_or_default();
    for word in telling {
        assert!(error.contains(word), "misdeed {misdeed} does not say `{word}`: {}", ended.stderr);
    }
    assert!(ended.stderr.contains("results up to time"), "{}", ended.stderr);
    assert!(!ended.stderr.contains("panicked"), "{}", ended.stderr);

    let text = std::fs::read_to_string(room.file("kept/report.json")).expect("a report of the part that was done");
    let report: serde_json::Value = serde_json::from_str(&text).expect("a whole document");
    assert!(error.ends_with(report["ended"].as_str().expect("how it ended")), "{error}\n{}", report["ended"]);
    let history = std::fs::read_to_string(room.file("kept/history.csv")).expect("a history");
    let times = history.lines().filter(|line| !line.starts_with('#')).skip(1);
    let times: Vec<f64> = times.map(|row| row.split(',').next().unwrap_or_default().parse().expect("a time")).collect();
    assert!(times.len() > 2 && times.is_sorted(), "{history}");
    assert!(times.iter().all(|time| *time < 0.6) && times.last() > Some(&0.4), "it failed half way: {history}");
    let entries = room.entries();
    assert!(entries.iter().any(|path| path.starts_with("kept/fields") && path.extension().is_some()), "{entries:?}");
    assert!(!entries.iter().any(|path| path.to_string_lossy().contains(".partial-")), "{entries:?}");

    // As one document: the same error, and nothing beside it.
    let document = room.json(&[&words[..], &["--json"]].concat(), 3);
    assert_eq!(document["error"]["kind"], "law");
    ended
}

#[test]
fn a_failing_law_is_named_with_point_and_inputs() {
    let law = misbehaving();
    for (misdeed, telling) in [
        (1, &["cannot answer", "too much"] as &[&str]),
        (2, &["failed", "too much"]),
        (3, &["status 42", "does not exist"]),
        (5, &["misses `gap`"]),
        (6, &["increment = NaN", "expected a finite number"]),
        (7, &["increment = inf", "expected a finite number"]),
        (8, &["increment = -1e-9", "claims that it is never negative"]),
        (9, &["direction of length 2", "expected 1"]),
        (12, &["by the factor 1", "expected one between 0 and 1"]),
        (14, &["direction", "NaN", "finite"]),
    ] {
        let all = [telling, &["law `small`", "load step 1", "at point 8 (pressure = ", "slip = ", "K = "]].concat();
        caught(&law, misdeed, &[], &all);
    }
}

#[test]
fn a_direction_along_or_out_of_the_surface_is_refused() {
    let law = misbehaving();
    caught(&law, 10, &[], &["wear direction", "point 8", "-d.n = 0", "more than 0"]);
    caught(&law, 11, &[], &["wear direction", "point 8", "-d.n = -1", "more than 0"]);
}

#[test]
fn a_law_that_never_stops_cutting_the_step_is_stopped() {
    let law = misbehaving();
    let place =
        ["law `small`", "asked for a substep shorter than", "point 8 (pressure = ", "slip = ", "K = ", "too much"];
    caught(&law, 13, &[], &[&place[..], &["numbers can tell apart"]].concat());
    let set = ["--set", "integrator.smallest_step=1e-3"];
    caught(&law, 13, &set, &[&place[..], &["1e-3 (`integrator.smallest_step`)"]].concat());
}

#[test]
fn failed_runs_on_two_threads_and_under_isolation_say_the_same() {
    let law = misbehaving();
    let error = |more: &[&str]| {
        let ended = caught(&law, 6, more, &["at point 8 (pressure = "]);
        ended.stderr.lines().find(|line| line.starts_with("error: ")).expect("an error").to_owned()
    };
    let plain = error(&[]);
    assert_eq!(plain, error(&["--threads", "2"]));
    assert_eq!(plain, error(&["--isolate"]));
}

#[test]
fn a_false_claim_to_be_linear_in_dt_is_refused_before_it_is_relied_on() {
    let law = CLaw::with(
        "#define CLAIMS WL_CLAIM_LINEAR_IN_DT\n",
        "output->increment[i] = 1e-9 + at(view->slip, i) * at(view->slip, i);",
    );
    let room = Room::new();
    let path = law.path();
    let ended =
        room.run(&["run", "scene.toml", "--law", path.to_str().expect("a plain name"), "--set", "law.constants=[1]"]);
    assert_eq!(ended.code, 3, "{} {}", ended.stdout, ended.stderr);
    for word in ["claims to be linear in dt", "at point ", "half as long"] {
        assert!(ended.stderr.contains(word), "{}", ended.stderr);
    }
}
