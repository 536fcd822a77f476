//! Runs that are killed, interrupted or extended, and go on from their checkpoint: the results are those of a run that was
//! never stopped, to the bit.

#[path = "support/npz.rs"]
mod npz;
#[path = "support/program.rs"]
mod program;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use program::{fails, folder, json, run, wearlaw, write};

/// A sphere on springs that breathes and wears: many small substeps.
const SPRINGS: &str = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n\
    [contact]\nmodel = \"foundation\"\nstiffness = 1e13\n[grid]\nsize = [6e-4, 6e-4]\ncells = [20, 20]\n\
    [surface]\nshape = \"sphere\"\nradius = 5e-3\n\
    [[cycle]]\ncount = 1000\n[[cycle.step]]\nduration = 0.02\nload = 2.0\nvelocity = 1.0\n\
    [[cycle.step]]\nduration = 0.02\nload = 4.0\nvelocity = 0.5\nramp = [\"load\"]\n\
    [integrator]\nsubsteps = 4\n\
    [output]\nfields = [\"wear\", \"pressure\"]\nevery = 1500\nformats = [\"csv\", \"vtk\"]\ncheckpoint = 0.01\n";

/// A law with a memory: its wear coefficient falls with the work that went into a point.
const TIRING: &str = r#"
#define LAW_NAME "tiring"
#define LAW_VERSION "1.0"
#define LAW_SUMMARY "wears less the more it has worn"
#define LAW_READS(F) F(pressure) F(slip)
#define LAW_CONSTANTS(C) C(k, WL_PER_PASCAL, WL_FROM(0), WL_REQUIRED, "specific wear rate")
#define LAW_STATE(S) S(depth, WL_METRE, WL_FROM(0), 0, "wear so far")
#include "wearlaw_point.h"
WL_POINT {
    out->increment = c->k * in->pressure * in->slip / (1.0 + s->depth / 1e-7);
    out->state.depth = s->depth + out->increment;
    return WL_OK;
}
"#;

/// Files of a folder with their contents, the parts gone that may differ between two runs.
fn results(out: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for (place, prefix) in [(out.to_owned(), ""), (out.join("fields"), "fields/")] {
        for entry in fs::read_dir(&place).into_iter().flatten() {
            let entry = entry.expect("an entry");
            let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
            if entry.path().is_file() {
                all.insert(name, fs::read(entry.path()).expect("a file"));
            } else {
                all.insert(name, Vec::new());
            }
        }
    }
    assert!(all.remove("checkpoint").is_some(), "a checkpoint in {}", out.display());
    let report = all.remove("report.json").expect("a report");
    let mut report = json(&String::from_utf8(report).expect("text"));
    report.as_object_mut().expect("an object").remove("cost").expect("a cost");
    report["law"]["build_time_s"] = 0.into();
    all.insert("report.json".to_owned(), report.to_string().into_bytes());
    all
}

#[track_caller]
fn assert_same(found: &Path, expected: &Path) {
    let (found, expected) = (results(found), results(expected));
    let names = |all: &BTreeMap<String, Vec<u8>>| all.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&found), names(&expected));
    for (name, bytes) in &expected {
        assert!(found[name] == *bytes, "{name} differs");
    }
}

#[track_caller]
fn done(here: &Path, words: &[&str]) {
    let ended = run(here, words);
    assert_eq!(ended.code, 0, "{words:?}: {}", ended.stderr);
}

/// Numbers from 0 to 1 that a seed gives.
struct Seeded(u64);

impl Seeded {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Waits for the child to end or for `until` to be true, at most so long.
fn wait(child: &mut Child, most: Duration, until: impl Fn() -> bool) -> bool {
    let begin = Instant::now();
    while begin.elapsed() < most {
        if child.try_wait().expect("a child").is_some() {
            return true;
        }
        if until() {
            return false;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    false
}

/// Kills the run at `kills` moments, each time after a checkpoint of its own or at any moment, and goes on with it.
fn killed_and_resumed(here: &Path, words: &[&[&str]; 2], out: &str, kills: u32, seed: u64) {
    let mut seeded = Seeded(seed);
    let checkpoint = here.join(out).join("checkpoint");
    let stamp = || fs::metadata(&checkpoint).and_then(|found| found.modified()).ok();
    let mut from_checkpoint = 0;
    for kill in 0..kills {
        let words = [words[kill as usize % 2], &["--out", out, "--resume", "-q"]].concat();
        let before = stamp();
        from_checkpoint += u32::from(before.is_some());
        let mut child = wearlaw(here, &words).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it starts");
        // Every other time it has to get somewhere first.
        let ended = kill % 2 == 1 && wait(&mut child, Duration::from_secs(20), || stamp() != before);
        let ended = ended || wait(&mut child, Duration::from_secs_f64(0.03 * seeded.next()), || false);
        if ended {
            let ended = child.wait_with_output().expect("it ended");
            assert!(ended.status.success(), "{}: {}", ended.status, String::from_utf8_lossy(&ended.stderr));
            // It was too fast: from the start again.
            fs::remove_dir_all(here.join(out)).expect("results");
            continue;
        }
        child.kill().expect("a child");
        child.wait().expect("it was killed");
    }
    assert!(from_checkpoint >= kills / 3, "only {from_checkpoint} of {kills} went on from a checkpoint");
    done(here, &[words[0], &["--out", out, "--resume", "-q"]].concat());
    let mut names: Vec<_> = fs::read_dir(here).expect("a folder").map(|entry| entry.unwrap().file_name()).collect();
    names.retain(|name| name.to_string_lossy().contains(".partial-"));
    assert!(names.is_empty(), "nothing is left behind: {names:?}");
}

#[test]
fn a_run_that_is_killed_at_twenty_moments_ends_with_the_same_bits() {
    let here = folder();
    write(here.path(), "springs.toml", SPRINGS);
    done(here.path(), &["run", "springs.toml", "--out", "whole", "-q"]);
    let words: [&[&str]; 2] = [&["run", "springs.toml"], &["run", "springs.toml", "--threads", "1"]];
    killed_and_resumed(here.path(), &words, "killed", 20, 1);
    assert_same(&here.path().join("killed"), &here.path().join("whole"));
    assert_eq!(fs::read_dir(here.path().join("whole/fields")).unwrap().count(), 2 * 6 + 1, "six times, two formats");
}

#[test]
fn a_law_with_a_memory_in_a_process_of_its_own_goes_on_with_the_same_bits() {
    let here = folder();
    write(here.path(), "tiring.c", TIRING);
    let built = run(here.path(), &["build", "tiring.c", "-o", "tiring.so", "-q"]);
    assert_eq!(built.code, 0, "{}", built.stderr);
    let scene = SPRINGS
        .replace(
            "use = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }",
            "use = \"./tiring.so\"\nconstants = { k = 1e-14 }",
        )
        .replace("count = 1000", "count = 60")
        .replace("every = 1500", "every = 100")
        .replace("[\"wear\", \"pressure\"]", "[\"wear\", \"depth\", \"sliding_distance\"]");
    write(here.path(), "tiring.toml", &scene);
    done(here.path(), &["run", "tiring.toml", "--out", "whole", "-q"]);
    let words: [&[&str]; 2] = [&["run", "tiring.toml", "--isolate"], &["run", "tiring.toml"]];
    killed_and_resumed(here.path(), &words, "killed", 8, 2);
    let report = |out: &str| json(&fs::read_to_string(here.path().join(out).join("report.json")).unwrap());
    assert_eq!(report("killed")["law"]["isolated"], true);
    // The last part of the one ran in a process of its own, the other did not; all else is the same.
    let path = here.path().join("killed/report.json");
    let mut killed = report("killed");
    killed["law"]["isolated"] = false.into();
    fs::write(path, killed.to_string()).unwrap();
    assert_same(&here.path().join("killed"), &here.path().join("whole"));
}

#[test]
fn prescribed_points_on_two_threads_go_on_with_the_same_bits() {
    let here = folder();
    let mut csv = String::from("time,point,pressure,velocity\n");
    for (time, push) in [(0.0, 1e8), (1.0, 3e8), (2.0, 2e8)] {
        (0..20_000).for_each(|point| csv += &format!("{time},{point},{},0.1\n", push * (1.0 + f64::from(point % 97))));
    }
    write(here.path(), "history.csv", &csv);
    let scene = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10, m = 1.3 }\n\
        [contact]\nmodel = \"prescribed\"\nhistory = \"history.csv\"\n[[cycle]]\ncount = 8\n\
        [output]\nfields = [\"wear\"]\nformats = [\"npz\"]\ntimes = [2.5, 9.0]\ncheckpoint = 0.01\n";
    write(here.path(), "points.toml", scene);
    done(here.path(), &["run", "points.toml", "--threads", "1", "--out", "whole", "-q"]);
    let words: [&[&str]; 2] = [&["run", "points.toml", "--threads", "2"], &["run", "points.toml", "--threads", "1"]];
    killed_and_resumed(here.path(), &words, "killed", 4, 3);
    assert_same(&here.path().join("killed"), &here.path().join("whole"));
}

#[test]
fn an_interrupted_run_to_a_tolerance_leaves_a_checkpoint_and_goes_on_with_the_same_bits() {
    let here = folder();
    let scene = SPRINGS
        .replace("count = 1000", "count = 40")
        .replace("substeps = 4", "tolerance = 1e-4")
        .replace("every = 1500", "every = 50")
        .replace("checkpoint = 0.01\n", "");
    write(here.path(), "scene.toml", &scene);
    done(here.path(), &["run", "scene.toml", "--out", "whole", "-q"]);
    let mut code = 0;
    for wait_ms in [150, 60, 20, 0] {
        let _ = fs::remove_dir_all(here.path().join("stopped"));
        let mut child =
            wearlaw(here.path(), &["run", "scene.toml", "--out", "stopped", "-q"]).spawn().expect("it starts");
        // The folder aside is made when the signal is listened to.
        let aside = || {
            fs::read_dir(here.path())
                .unwrap()
                .any(|entry| entry.unwrap().file_name().to_string_lossy().starts_with(".stopped.partial-"))
        };
        wait(&mut child, Duration::from_secs(20), aside);
        std::thread::sleep(Duration::from_millis(wait_ms));
        let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        code = child.wait().expect("it ended").code().unwrap_or(-1);
        if kill.is_ok() && code == 130 {
            break;
        }
    }
    assert_eq!(code, 130, "interrupted while it ran");
    let report = json(&fs::read_to_string(here.path().join("stopped/report.json")).unwrap());
    assert_eq!(report["ended"], "interrupted");
    done(here.path(), &["run", "scene.toml", "--out", "stopped", "--resume", "-q"]);
    assert_same(&here.path().join("stopped"), &here.path().join("whole"));
}

#[test]
fn a_finished_run_goes_on_when_its_scene_becomes_longer() {
    let here = folder();
    let prescribed = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n[contact]\nmodel = \"prescribed\"\n\
        [[cycle]]\ncount = 3\n[[cycle.step]]\nduration = 2.0\npressure = 1e8\nvelocity = 0.1\n\
        [[cycle.step]]\nduration = 1.0\npressure = 3e8\nvelocity = 0.2\nramp = [\"pressure\"]\n";
    let springs = SPRINGS.replace("count = 1000", "count = 3").replace("every = 1500", "every = 5");
    for (name, scene) in [("prescribed.toml", prescribed), ("springs.toml", &springs)] {
        write(here.path(), name, scene);
        let out = format!("{name}.short");
        done(here.path(), &["run", name, "--out", &out, "-q"]);
        write(here.path(), name, &scene.replace("count = 3", "count = 7"));
        done(here.path(), &["run", name, "--out", &out, "--resume", "-q"]);
        done(here.path(), &["run", name, "--out", "long", "-q"]);
        assert_same(&here.path().join(&out), &here.path().join("long"));
        // Nothing is left to do: the results stay as they are.
        done(here.path(), &["run", name, "--out", &out, "--resume", "-q"]);
        assert_same(&here.path().join(&out), &here.path().join("long"));
    }
}

#[test]
fn a_last_step_can_become_longer_and_be_followed() {
    let here = folder();
    let wear = |out: &str| {
        let report = json(&fs::read_to_string(here.path().join(out).join("report.json")).unwrap());
        (report["result"]["time"].as_f64().unwrap(), report["result"]["max_wear_depth"].as_f64().unwrap())
    };
    let front = SPRINGS.split("[[cycle]]").next().unwrap();
    let law = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n[contact]\nmodel = \"prescribed\"\n";
    let solved = "[[step]]\nduration = 1.0\nload = 3.0\nvelocity = 0.3\n";
    let given = "[[step]]\nduration = 1.0\npressure = 1e8\nvelocity = 0.3\n";
    for (front, steps) in [(front, solved), (law, given)] {
        write(here.path(), "scene.toml", &format!("{front}{steps}"));
        done(here.path(), &["run", "scene.toml", "--out", "out", "-q"]);
        let longer = format!("{front}{}{steps}", steps.replace("duration = 1.0", "duration = 2.5"));
        write(here.path(), "scene.toml", &longer);
        done(here.path(), &["run", "scene.toml", "--out", "out", "--resume", "-q"]);
        done(here.path(), &["run", "scene.toml", "--out", "straight", "-q"]);
        let ((time, found), (until, expected)) = (wear("out"), wear("straight"));
        assert_eq!((time, until), (3.5, 3.5));
        assert!((found / expected - 1.0).abs() < 2e-4, "{found:e} against {expected:e}");
        fs::remove_dir_all(here.path().join("out")).unwrap();
    }
}

#[test]
fn a_checkpoint_of_another_run_is_refused_and_nothing_is_touched() {
    let here = folder();
    let scene = SPRINGS.replace("count = 1000", "count = 2");
    write(here.path(), "scene.toml", &scene);
    let words = ["run", "scene.toml", "--out", "out", "--resume"];
    let first = run(here.path(), &words);
    assert!(first.code == 0 && first.stderr.contains("no checkpoint in out"), "{}", first.stderr);
    let checkpoint = here.path().join("out/checkpoint");
    let before = fs::read(&checkpoint).unwrap();
    let refused = |set: &str, said: &str| {
        let message = fails(here.path(), &[&words[..], &["--set", set]].concat(), 2, "input");
        assert!(message.contains(said), "{message}");
        assert_eq!(fs::read(&checkpoint).unwrap(), before);
    };
    refused("law.constants.K=2e-4", "`law.constants.K` = 0.0001, the scene has 0.0002");
    refused("cycle.0.count=1", "`cycle.0.count` = 2, the scene has 1");
    refused("cycle.0.step.1.duration=1", "`cycle.0.step`");
    refused("integrator.substeps=5", "`integrator.substeps`");
    write(here.path(), "half.c", program::LAW);
    let law = [&words[..], &["--law", "half.c", "--set", "law.constants={ k = 1e-14 }"]].concat();
    assert!(fails(here.path(), &law, 2, "input").contains("with law `archard`"));
    fs::write(&checkpoint, &before[..before.len() / 2]).unwrap();
    assert!(fails(here.path(), &words, 5, "files").contains("is damaged"));
    fs::write(&checkpoint, "no such thing").unwrap();
    assert!(fails(here.path(), &words, 2, "input").contains("is no checkpoint"));
}

#[test]
fn a_failed_run_leaves_a_checkpoint_and_fails_again_where_it_failed() {
    let here = folder();
    // A sphere that is pressed beyond the rim of its grid.
    let scene = SPRINGS
        .replace("model = \"foundation\"\nstiffness = 1e13", "model = \"halfspace\"\nmodulus = 1.15e11")
        .split("[[cycle]]")
        .next()
        .unwrap()
        .to_owned()
        + "[[step]]\nduration = 1.0\nload = 1e5\nvelocity = 0.1\nramp = [\"load\"]\n[integrator]\nsubsteps = 12\n";
    write(here.path(), "scene.toml", &scene);
    let words = ["run", "scene.toml", "--out", "out"];
    let first = fails(here.path(), &words, 4, "numbers");
    let once = results(&here.path().join("out"));
    let again = fails(here.path(), &[&words[..], &["--resume"]].concat(), 4, "numbers");
    assert!(first.contains("rim") && again.contains("rim"), "{first}\n{again}");
    let rows = |all: &BTreeMap<String, Vec<u8>>| all["history.csv"].iter().filter(|byte| **byte == b'\n').count();
    assert!(rows(&once) > 2);
    assert!(rows(&results(&here.path().join("out"))) > rows(&once), "it went on from where it had been");
}

/// Beyond 400 000 numbers a prescribed run keeps no second copy of its arrays to undo a failed step with.
#[test]
fn a_large_prescribed_run_that_fails_leaves_the_last_checkpoint_that_it_wrote() {
    let here = folder();
    let step = |velocity: f64| format!("[[step]]\nduration = 1.0\nvelocity = {velocity:?}\n");
    // With n = -1 the law has no answer at rest.
    let scene = |history: &str, steps: &[f64]| {
        format!(
            "[law]\nuse = \"archard\"\nconstants = {{ K = 1e-4, H = 1e10, m = 1.0, n = -1.0 }}\n\
             [contact]\nmodel = \"prescribed\"\nhistory = \"{history}\"\n{}[output]\nfields = []\ncheckpoint = 1e-9\n",
            steps.iter().map(|velocity| step(*velocity)).collect::<String>()
        )
    };
    for (name, points) in [("large", 410_000), ("small", 1000)] {
        let history = format!("{name}.npz");
        npz::Npz::create(&here.path().join(&history))
            .array("time", &[1], std::iter::once(0.0))
            .array("pressure", &[points], (0..points).map(|i| 1e6 + (i % 977) as f64))
            .finish();
        write(here.path(), "fails.toml", &scene(&history, &[0.5, 1.0, 2.0, 0.0, 1.0]));
        write(here.path(), "done.toml", &scene(&history, &[0.5, 1.0, 2.0]));
        let first = fails(here.path(), &["run", "fails.toml", "--out", "out"], 3, "law");
        done(here.path(), &["run", "done.toml", "--out", "done", "-q"]);
        let [failed, three] = ["out", "done"].map(|out| {
            let stored =
                wearlaw::output::read_checkpoint(&here.path().join(out).join("checkpoint")).expect("it is whole");
            stored.checkpoint
        });
        assert_eq!((failed.time, three.time), (3.0, 3.0), "{name}");
        assert_eq!(failed.history, three.history);
        assert!(failed.arrays["wear"] == three.arrays["wear"] && failed.arrays["wear"].len() == points, "{name}");
        let again = fails(here.path(), &["run", "fails.toml", "--out", "out", "--resume"], 3, "law");
        assert_eq!(first, again);
        for out in ["out", "done"] {
            fs::remove_dir_all(here.path().join(out)).unwrap();
        }
    }
}
