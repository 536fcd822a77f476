//! The processor's instructions: which of them a run used is told, they can be asked for, and the answer does not depend on
//! them but for its last digits.

#[path = "support/program.rs"]
mod program;

use std::fs;
use std::path::Path;

use program::{Ended, ended, folder, json, wearlaw, write};
use wearlaw::contact::{INSTRUCTIONS_VARIABLE, Instructions};
use wearlaw::output::read_checkpoint;

const SCENE: &str = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n\
    [contact]\nmodel = \"halfspace\"\nmodulus = 1.1e11\nboundary = \"periodic\"\n\
    [grid]\nsize = [1e-3, 1e-3]\ncells = [40, 36]\n\
    [surface]\nshape = \"rough\"\nhurst = 0.8\nrms_slope = 0.02\nroll_off = 2.0\ncut_off = 8.0\nseed = 3\n\
    [[step]]\nduration = 0.1\nload = 20.0\nvelocity = 1.0\n[integrator]\nsubsteps = 4\n\
    [output]\nfields = [\"wear\", \"pressure\"]\nformats = [\"csv\"]\n";

/// A command under a value of the variable; empty: none.
fn under(here: &Path, value: &str, words: &[&str]) -> Ended {
    let mut command = wearlaw(here, words);
    command.env(INSTRUCTIONS_VARIABLE, value);
    ended(command.output().expect("the program starts"), words)
}

fn run(here: &Path, value: &str, out: &str) -> Vec<f64> {
    let ran = under(here, value, &["run", "scene.toml", "--out", out, "-q"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let report = json(&fs::read_to_string(here.join(out).join("report.json")).expect("a report"));
    let best = Instructions::here().last().expect("one set").name();
    assert_eq!(report["instructions"], if value.is_empty() { best } else { value });
    let stored = read_checkpoint(&here.join(out).join("checkpoint")).expect("a checkpoint");
    assert_eq!(stored.identity.instructions, report["instructions"]);
    stored.checkpoint.arrays["wear"].to_vec()
}

#[test]
fn every_set_gives_its_own_bits_again_and_the_same_answer() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    let usual = run(here.path(), "", "usual");
    let norm = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>().sqrt();
    let mut others = 0;
    for set in Instructions::here() {
        let [once, again] = ["once", "again"].map(|out| run(here.path(), set.name(), out));
        assert!(once == again, "{set:?}");
        let difference: Vec<f64> = once.iter().zip(&usual).map(|(a, b)| a - b).collect();
        assert!(norm(&difference) <= 1e-6 * norm(&usual), "{set:?}: {:e}", norm(&difference) / norm(&usual));
        others += usize::from(once != usual);
    }
    if Instructions::here().len() > 1 {
        assert!(others > 0, "the transforms are not made with what was asked for: all sets give the same bits");
    } else {
        println!("NOT RUN: other instructions: this processor has one set");
    }
}

#[test]
fn a_set_that_is_none_is_refused_and_a_run_that_goes_on_under_another_says_so() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    for command in ["run", "plan", "stability"] {
        let refused = under(here.path(), "mmx", &[command, "scene.toml"]);
        assert_eq!(refused.code, 2, "{}", refused.stderr);
        assert!(refused.stderr.contains("WEARLAW_INSTRUCTIONS: found \"mmx\""), "{}", refused.stderr);
    }
    let best = Instructions::here().last().expect("one set").name();
    let words = ["run", "scene.toml", "--out", "out", "-q"];
    let more = [&words[..], &["--resume"]].concat();
    assert_eq!(under(here.path(), "baseline", &words).code, 0);
    let same = under(here.path(), "baseline", &more);
    assert!(same.code == 0 && !same.stderr.contains("instructions"), "{}", same.stderr);
    if best == "baseline" {
        println!("NOT RUN: going on under other instructions: this processor has one set");
        return;
    }
    let other = under(here.path(), best, &["run", "scene.toml", "--out", "out", "--resume"]);
    assert_eq!(other.code, 0, "{}", other.stderr);
    let said = format!("written with baseline instructions, the run goes on with {best}");
    assert!(other.stderr.contains(&said), "{}", other.stderr);
}
