//! What newcomers stumble over: each is told what to type, or what to look at.

#[path = "support/program.rs"]
mod program;

use program::{LAW, fails, folder, json, run, write};

/// A scene of one step with constant pressure and speed, for the law that its section names.
fn scene(title: &str, law: &str) -> String {
    format!(
        "title = \"{title}\"\n[law]\n{law}\n[contact]\nmodel = \"prescribed\"\nhistory = \"history.csv\"\n\
         [[step]]\nduration = 1.0\n"
    )
}

const ARCHARD: &str = "use = \"embedded:archard\"\nconstants = { K = 1e-4, H = 2e9 }";
const HISTORY: &str = "time,point,pressure,velocity\n0,1,5e7,0.2\n1,1,5e7,0.2\n";

#[test]
fn a_folder_that_is_no_result_is_refused_and_another_scene_is_told() {
    let here = folder();
    write(here.path(), "history.csv", HISTORY);
    write(here.path(), "a.toml", &scene("first", ARCHARD));
    write(here.path(), "b.toml", &scene("second", ARCHARD));
    let first = run(here.path(), &["run", "a.toml", "--out", "out"]);
    assert_eq!((first.code, first.stderr.as_str()), (0, ""));
    let again = run(here.path(), &["run", "a.toml", "--out", "out"]);
    assert_eq!((again.code, again.stderr.as_str()), (0, ""), "the same scene again is nothing to tell");
    let other = run(here.path(), &["run", "b.toml", "--out", "out"]);
    assert_eq!(other.code, 0);
    assert!(other.stderr.contains("out held the results of `first`, which these replace"), "{}", other.stderr);
    std::fs::create_dir(here.path().join("theirs")).expect("the folder can be written");
    for text in ["{\"tests\": 12}", "no JSON", "{\"scene\": {}, \"law\": 1}"] {
        write(&here.path().join("theirs"), "report.json", text);
        let message = fails(here.path(), &["run", "a.toml", "--out", "theirs"], 2, "input");
        assert!(message.contains("theirs/report.json is not the report of a run"), "{message}");
        let left = std::fs::read_to_string(here.path().join("theirs/report.json")).expect("it is still there");
        assert_eq!(left, text);
    }
}

#[test]
fn a_law_that_a_scene_names_wrongly_is_told_with_its_line() {
    let here = folder();
    write(here.path(), "history.csv", HISTORY);
    write(here.path(), "text.so", "no library");
    for (name, words) in [
        ("./none.so", "no file `none.so`"),
        ("./text.so", "not a shared library"),
        ("./none.c", "no file `none.c`, expected the source of a wear law"),
    ] {
        write(here.path(), "a.toml", &scene("a", &format!("use = \"{name}\"")));
        let message = fails(here.path(), &["run", "a.toml"], 2, "input");
        assert!(message.contains(words), "{message}");
        let shown = run(here.path(), &["run", "a.toml"]).stderr;
        assert!(shown.contains("a.toml:3:7") && shown.contains("^^^"), "{shown}");
        let document = json(&run(here.path(), &["run", "a.toml", "--json"]).stdout);
        assert_eq!((document["error"]["line"].as_u64(), document["error"]["key"].as_str()), (Some(3), Some("law.use")));
    }
    write(here.path(), "a.toml", &scene("a", ARCHARD));
    for law in ["./none.so", "./none.c"] {
        let shown = run(here.path(), &["run", "a.toml", "--law", law]).stderr;
        assert!(!shown.contains("a.toml"), "what was typed is not in the scene: {shown}");
    }
}

#[test]
fn constants_of_another_law_are_told_together() {
    let here = folder();
    write(here.path(), "history.csv", HISTORY);
    write(here.path(), "half.c", LAW);
    write(here.path(), "a.toml", &scene("a", ARCHARD));
    let message = fails(here.path(), &["run", "a.toml", "--law", "./half.c"], 2, "input");
    assert!(message.contains("law `half` has no constants `H`, `K`; it has `k`"), "{message}");
    write(here.path(), "a.toml", &scene("a", "use = \"./half.c\"\nconstants = { K = 1e-14 }"));
    let message = fails(here.path(), &["run", "a.toml"], 2, "input");
    assert!(message.contains("has no constant `K` (did you mean `k`?)"), "{message}");
}

#[test]
fn a_law_in_the_place_of_a_scene_is_told_what_to_type() {
    let here = folder();
    write(here.path(), "law.cpp", "");
    for (command, file, what) in
        [("run", "law.cpp", "source code"), ("plan", "law.f90", "source code"), ("run", "liblaw.so", "a library")]
    {
        let message = fails(here.path(), &[command, file], 2, "input");
        assert!(message.contains(&format!("`{file}` is {what} of a law, expected a scene")), "{message}");
        assert!(
            message.contains("wearlaw new NAME --lang c") && message.contains(&format!("--law {file}")),
            "{message}"
        );
    }
}

#[test]
fn a_folder_of_laws_names_some_of_them() {
    let here = folder();
    let laws = here.path().join("laws");
    std::fs::create_dir_all(laws.join("mine")).expect("the folder can be written");
    write(&laws, "half.c", LAW);
    write(&laws, "notes.txt", "");
    write(&laws.join("mine"), "Cargo.toml", "");
    for command in ["check", "bench", "build"] {
        let message = fails(here.path(), &[command, "./laws"], 2, "input");
        assert!(
            message.contains("such as `laws/half.c`, `laws/mine`") || message.contains("`./laws/half.c`"),
            "{message}"
        );
        assert!(!message.contains("notes.txt"), "{message}");
    }
    fails(here.path(), &["check"], 2, "input");
}

#[test]
fn results_that_are_hardly_meant_are_warned_of() {
    let here = folder();
    write(here.path(), "history.csv", HISTORY);
    write(here.path(), "a.toml", &scene("a", ARCHARD));
    let fine = json(&run(here.path(), &["run", "a.toml", "--json"]).stdout);
    assert_eq!(fine["warnings"].as_array().map(Vec::len), Some(0));
    let warned = |words: &[&str], what: &str| {
        let ended = run(here.path(), &[&["run"], words].concat());
        assert_eq!(ended.code, 0, "{}", ended.stderr);
        assert!(ended.stderr.contains(&format!("warning: {what}")), "{words:?}: {}", ended.stderr);
        let document = json(&run(here.path(), &[&["run"], words, &["--json"]].concat()).stdout);
        let warnings = document["warnings"].as_array().expect("a list");
        assert!(warnings.iter().any(|one| one.as_str().is_some_and(|one| one.starts_with(what))), "{warnings:?}");
    };
    warned(&["a.toml", "--set", "law.constants.K=0"], "nothing was worn in the whole run");
    write(here.path(), "history.csv", "time,point,pressure,velocity\n0,1,5e7,0.2\n1,1,5e7,0.2\n3,1,5e7,0.2\n");
    warned(&["a.toml"], "the history goes on to time 3 s, the load steps end at 1 s");
    let ball = "title = \"ball\"\n[law]\nuse = \"embedded:archard\"\nconstants = { K = 1e-4, H = 2e9 }\n\
                [contact]\nmodel = \"foundation\"\ndimension = 2\nstiffness = 1e13\n[grid]\nsize = [4e-4]\ncells = [32]\n\
                [surface]\nshape = \"cylinder\"\nradius = 1e-3\n\
                [[step]]\nduration = 1.0\nload = 1e4\nvelocity = 1e4\n[integrator]\nsubsteps = 4\n";
    write(here.path(), "ball.toml", ball);
    warned(&["ball.toml"], "the largest wear depth, ");
}
