//! The program from outside: every command's good case, every exit code, and what goes to which stream.

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

/// The program in a folder, with an environment that no user's settings reach.
fn wearlaw(folder: &Path, words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wearlaw"));
    command.current_dir(folder).args(words).stdin(std::process::Stdio::null());
    for name in ["CC", "CXX", "FC", "CFLAGS", "CXXFLAGS", "FFLAGS", "NO_COLOR", "RUST_BACKTRACE"] {
        command.env_remove(name);
    }
    command
}

struct Ended {
    code: i32,
    stdout: String,
    stderr: String,
}

impl From<Output> for Ended {
    fn from(output: Output) -> Self {
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is UTF-8");
        let code = output.status.code().expect("no signal ended the program");
        Self { code, stdout: text(output.stdout), stderr: text(output.stderr) }
    }
}

fn run(folder: &Path, words: &[&str]) -> Ended {
    wearlaw(folder, words).output().expect("the program starts").into()
}

/// Runs a command that has to fail: nothing on standard output, and the same error as one JSON document with `--json`.
fn fails(folder: &Path, words: &[&str], code: i32, kind: &str) -> String {
    let ended = run(folder, words);
    assert_eq!(ended.code, code, "{words:?}: {}", ended.stderr);
    assert_eq!(ended.stdout, "", "{words:?}");
    assert!(ended.stderr.contains("error: "), "{words:?}: {}", ended.stderr);
    assert!(!ended.stderr.contains('\u{1b}'), "colors only on a terminal: {words:?}");
    assert!(!ended.stderr.contains("panicked"), "{words:?}: {}", ended.stderr);
    let with_json = run(folder, &[words, &["--json"]].concat());
    assert_eq!(with_json.code, code, "{words:?}");
    let document = json(&with_json.stdout);
    assert_eq!(document["exit_code"], code, "{words:?}");
    assert_eq!(document["error"]["kind"], kind, "{words:?}");
    let message = document["error"]["message"].as_str().expect("a message").to_owned();
    assert!(!message.is_empty() && !with_json.stderr.contains("error: "), "{words:?}: {}", with_json.stderr);
    message
}

/// The one document of a text that holds nothing else.
fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in {text:?}"))
}

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("the folder can be written");
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

const DECK: &str = "ET,1,185\nTB,WEAR,7,,,ARCD\nTBDATA,1,1e-4,1e10,1,1\n";

const LAW: &str = r#"
#define LAW_NAME "half"
#define LAW_VERSION "2.1"
#define LAW_SUMMARY "half a law"
#define LAW_READS(F) F(pressure) F(slip)
#define LAW_CONSTANTS(C) C(k, WL_PER_PASCAL, WL_FROM(0), WL_REQUIRED, "specific wear rate")
#include "wearlaw_point.h"
WL_POINT {
    out->increment = 0.5 * c->k * in->pressure * in->slip;
    return WL_OK;
}
"#;

/// A law whose entry gives up.
const REFUSING: &str = "#include \"wearlaw.h\"\n\
    WL_EXPORT int32_t wearlaw_entry_1(int32_t index, const wl_host *host, wl_law *law) {\n\
    (void)index; (void)host; (void)law; return WL_FAILED; }\n";

#[test]
fn help_and_version_go_to_standard_output() {
    let here = folder();
    let help = run(here.path(), &["--help"]);
    assert_eq!((help.code, help.stderr.as_str()), (0, ""));
    for word in ["run", "plan", "build", "new", "inspect", "apdl", "Exit codes", "130"] {
        assert!(help.stdout.contains(word), "{word}");
    }
    for word in ["study", "stability", "bench", "check", "__worker"] {
        assert!(!help.stdout.contains(&format!("\n  {word} ")), "{word} is no command yet");
    }
    let version = run(here.path(), &["--version"]);
    assert_eq!((version.code, version.stdout), (0, format!("wearlaw {}\n", env!("CARGO_PKG_VERSION"))));
    let bare = run(here.path(), &[]);
    assert_eq!((bare.code, bare.stdout.as_str()), (2, ""));
    assert!(bare.stderr.contains("Usage: wearlaw"));
}

#[test]
fn apdl_prints_the_law_section_and_keeps_its_notes_apart() {
    let here = folder();
    write(here.path(), "deck.inp", DECK);
    let plain = run(here.path(), &["apdl", "deck.inp"]);
    assert_eq!(plain.code, 0, "{}", plain.stderr);
    let section: toml::Table = toml::from_str(&plain.stdout).expect("TOML and nothing else");
    assert_eq!(section["law"]["constants"]["H"].as_float(), Some(1e10));
    assert!(plain.stderr.contains("note: passed over ET"), "{}", plain.stderr);
    let quiet = run(here.path(), &["apdl", "deck.inp", "-q", "--material", "7"]);
    assert_eq!((quiet.stdout, quiet.stderr.as_str()), (plain.stdout.clone(), ""));
    let document = json(&run(here.path(), &["--json", "apdl", "deck.inp"]).stdout);
    assert_eq!((&document["toml"], &document["material"]), (&Value::from(plain.stdout), &Value::from(7)));
    assert_eq!(document["sections"]["law"]["use"], "archard");
    assert_eq!(document["notes"].as_array().map(Vec::len), Some(1));
}

#[test]
fn a_wrong_deck_is_underlined() {
    let here = folder();
    write(here.path(), "deck.inp", &DECK.replace("1e10", "1e1x"));
    let plain = run(here.path(), &["apdl", "deck.inp"]);
    assert!(plain.stderr.contains("deck.inp:3:15") && plain.stderr.contains("^^^^"), "{}", plain.stderr);
    fails(here.path(), &["apdl", "deck.inp"], 2, "input");
    let document = json(&run(here.path(), &["apdl", "deck.inp", "--json"]).stdout);
    assert_eq!((&document["error"]["line"], &document["error"]["column"]), (&Value::from(3), &Value::from(15)));
    write(here.path(), "good.inp", DECK);
    let message = fails(here.path(), &["apdl", "good.inp", "--material", "3"], 2, "input");
    assert!(message.contains("material 3") && message.contains('7'), "{message}");
    fails(here.path(), &["apdl", "none.inp"], 2, "input");
}

#[test]
fn build_compiles_and_says_what_the_law_is() {
    let here = folder();
    write(here.path(), "half.c", LAW);
    let plain = run(here.path(), &["build", "half.c"]);
    assert_eq!(plain.code, 0, "{}", plain.stderr);
    for words in ["libhalf.so", "half 2.1", "half a law", "pressure, slip", "1/Pa"] {
        assert!(plain.stdout.contains(words), "{words} in {}", plain.stdout);
    }
    assert!(here.path().join("libhalf.so").is_file());
    let quiet = run(here.path(), &["build", "half.c", "-q", "-o", "other.so"]);
    assert_eq!((quiet.stdout.as_str(), quiet.stderr.as_str()), ("other.so\n", ""));
    let document = json(&run(here.path(), &["build", "half.c", "--json"]).stdout);
    assert_eq!((&document["library"], &document["laws"][0]["name"]), (&"libhalf.so".into(), &"half".into()));
    assert!(document["seconds"].as_f64() > Some(0.0) && document["commands"][0].as_str().is_some());

    write(here.path(), "bad.c", "#include \"wearlaw.h\"\nint broken(void) { return missing_thing; }\n");
    let broken = run(here.path(), &["build", "bad.c"]);
    assert!(broken.stderr.contains("missing_thing") && broken.stderr.contains("bad.c:2"), "{}", broken.stderr);
    fails(here.path(), &["build", "bad.c"], 2, "input");
    assert!(!here.path().join("libbad.so").exists());
    fails(here.path(), &["build", "bad.c", "-o", "no/such/folder/lib.so"], 2, "input");
    fails(here.path(), &["build", "none.c"], 2, "input");
    fails(here.path(), &["build"], 2, "input");
}

#[test]
fn a_law_that_fails_when_it_is_loaded_ends_with_3() {
    let here = folder();
    write(here.path(), "refusing.c", REFUSING);
    let message = fails(here.path(), &["build", "refusing.c"], 3, "law");
    assert!(message.contains("librefusing.so") && message.contains("answered 5"), "{message}");
    fails(here.path(), &["inspect", "librefusing.so"], 3, "law");
    let facts = run(here.path(), &["inspect", "--static", "librefusing.so"]);
    assert_eq!(facts.code, 0, "its file is fine: {}", facts.stderr);
}

#[test]
fn inspect_gives_the_facts_of_the_file_and_then_the_law() {
    let here = folder();
    write(here.path(), "half.c", LAW);
    assert_eq!(run(here.path(), &["build", "half.c"]).code, 0);
    let whole = run(here.path(), &["inspect", "libhalf.so"]);
    let facts = run(here.path(), &["inspect", "libhalf.so", "--static"]);
    assert!(whole.stdout.starts_with(&facts.stdout) && whole.stdout.len() > facts.stdout.len());
    assert!(facts.stdout.contains("SHA-256") && !facts.stdout.contains("half 2.1"));
    let document = json(&run(here.path(), &["inspect", "libhalf.so", "--json"]).stdout);
    assert_eq!(document["file"]["sha256"].as_str().map(str::len), Some(64));
    assert!(facts.stdout.contains(document["file"]["sha256"].as_str().unwrap()));
    assert_eq!(document["laws"][0]["constants"][0]["name"], "k");
    assert_eq!(run(here.path(), &["inspect", "libhalf.so", "--law", "half"]).stdout, whole.stdout);
    let message = fails(here.path(), &["inspect", "libhalf.so", "--law", "quarter"], 2, "input");
    assert!(message.contains("`quarter`") && message.contains("half"), "{message}");

    let own = run(here.path(), &["inspect", "embedded:archard"]);
    assert!(own.code == 0 && own.stdout.contains("part of this program"), "{}", own.stderr);
    assert!(own.stdout.contains("hardness") && own.stdout.contains("constant m"), "{}", own.stdout);
    assert_eq!(run(here.path(), &["inspect", "archard"]).code, 0);
    fails(here.path(), &["inspect", "embedded:archard", "--static"], 2, "input");
    write(here.path(), "text", "no library");
    for name in ["none.so", "half.c", "text", "archad", "."] {
        fails(here.path(), &["inspect", name], 2, "input");
    }
}

#[test]
fn new_says_what_to_type_and_refuses_what_it_cannot_do() {
    let here = folder();
    let plain = run(here.path(), &["new", "mine", "--lang", "c"]);
    assert_eq!((plain.code, plain.stderr.as_str()), (0, ""));
    assert_eq!(plain.stdout.lines().filter(|line| line.starts_with("  ")).count(), 3, "{}", plain.stdout);
    let message = fails(here.path(), &["new", "mine", "--lang", "c"], 2, "input");
    assert!(message.contains("not empty"), "{message}");
    let message = fails(here.path(), &["new", "other"], 2, "input");
    assert!(
        ["c", "cpp", "fortran", "rust"].iter().all(|lang| message.contains(&format!("--lang {lang}"))),
        "{message}"
    );
    fails(here.path(), &["new", "other", "--lang", "pascal"], 2, "input");
    fails(here.path(), &["new", "1st", "--lang", "c"], 2, "input");
    let document = json(&run(here.path(), &["new", "third", "--lang", "rust", "--json"]).stdout);
    assert_eq!(document["commands"].as_array().map(Vec::len), Some(3));
    assert_eq!(document["files"][0], "src/lib.rs");
    fails(here.path(), &["new", "/proc/mine", "--lang", "c"], 5, "files");
}

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

const SCENE: &str = "title = \"Three seconds\"\n[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n\
    [contact]\nmodel = \"prescribed\"\nhistory = \"history.csv\"\n";
const HISTORY: &str = "time,point,pressure,velocity\n0,0,1e8,0.1\n3,0,2e8,0.1\n";

#[test]
fn plan_lists_what_is_computed_and_what_is_left_out() {
    let here = folder();
    write(here.path(), "scene.toml", SCENE);
    write(here.path(), "history.csv", HISTORY);
    let plain = run(here.path(), &["plan", "scene.toml"]);
    assert_eq!((plain.code, plain.stderr.as_str()), (0, ""));
    for words in ["Three seconds", "Computed", "law `archard`", "Left out", "temperatures", "Memory", "together"] {
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
    assert!(
        built.code == 0 && built.stdout.contains("law `half`") && built.stdout.contains("half.c"),
        "{}",
        built.stderr
    );
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

#[cfg(target_os = "linux")]
#[test]
fn an_output_that_cannot_be_written_ends_with_5_and_a_closed_pipe_with_0() {
    let here = folder();
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("/dev/full");
    let mut command = wearlaw(here.path(), &["inspect", "archard"]);
    let ended = command.stdout(full).output().expect("the program starts");
    assert_eq!(ended.status.code(), Some(5));
    assert!(String::from_utf8_lossy(&ended.stderr).contains("standard output"));
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let status = wearlaw(here.path(), &["inspect", "archard"]).stdout(writer).status().expect("the program starts");
    assert_eq!(status.code(), Some(0));
}

#[cfg(unix)]
#[test]
fn an_interrupted_build_ends_with_130_and_leaves_nothing() {
    use std::os::unix::fs::PermissionsExt;
    let here = folder();
    write(here.path(), "half.c", LAW);
    // It looks like a compiler until it has something to compile; then the program is interrupted.
    let script = "#!/bin/sh\ncase \"$*\" in *half.c*) kill -INT \"$PPID\"; exit 1;; *) exec cc \"$@\";; esac\n";
    write(here.path(), "compiler", script);
    let compiler = here.path().join("compiler");
    std::fs::set_permissions(&compiler, std::fs::Permissions::from_mode(0o755)).expect("permissions");
    let before = std::fs::read_dir(here.path()).unwrap().count();
    let mut command = wearlaw(here.path(), &["build", "half.c", "--json"]);
    let ended = Ended::from(command.env("CC", &compiler).output().expect("the program starts"));
    assert_eq!(ended.code, 130, "{}", ended.stderr);
    let document = json(&ended.stdout);
    assert_eq!((&document["exit_code"], &document["error"]["kind"]), (&130.into(), &"interrupted".into()));
    assert_eq!(std::fs::read_dir(here.path()).unwrap().count(), before);
}
