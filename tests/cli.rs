//! The program from outside: the commands around a scene, the exit codes, and what goes to which stream.

#[path = "support/program.rs"]
mod program;

use program::{LAW, REFUSING, ended, fails, folder, json, run, wearlaw, write};
use serde_json::Value;

const DECK: &str = "ET,1,185\nTB,WEAR,7,,,ARCD\nTBDATA,1,1e-4,1e10,1,1\n";

#[test]
fn help_and_version_go_to_standard_output() {
    let here = folder();
    let help = run(here.path(), &["--help"]);
    assert_eq!((help.code, help.stderr.as_str()), (0, ""));
    for word in [
        "run",
        "plan",
        "build",
        "new",
        "inspect",
        "apdl",
        "stability",
        "study",
        "sweep",
        "check",
        "bench",
        "completions",
        "man",
        "Exit codes",
        "130",
    ] {
        assert!(help.stdout.contains(word), "{word}");
    }
    for word in ["__worker", "__check_worker"] {
        assert!(!help.stdout.contains(&format!("\n  {word} ")), "{word} is no command yet");
    }
    let version = run(here.path(), &["--version"]);
    assert_eq!((version.code, version.stdout), (0, format!("wearlaw {}\n", env!("CARGO_PKG_VERSION"))));
    let bare = run(here.path(), &[]);
    assert_eq!((bare.code, bare.stdout.as_str()), (2, ""));
    assert!(bare.stderr.contains("Usage: wearlaw"));
}

#[test]
fn completions_are_what_the_shell_reads_and_pages_what_man_does() {
    let here = folder();
    let script = run(here.path(), &["completions", "bash"]);
    assert_eq!((script.code, script.stderr.as_str()), (0, ""));
    write(here.path(), "wearlaw.bash", &script.stdout);
    let asks = "set -e; . ./wearlaw.bash; COMP_WORDS=(wearlaw st); COMP_CWORD=1; _wearlaw wearlaw st wearlaw; \
                echo ${COMPREPLY[@]}; COMP_WORDS=(wearlaw run --iso); COMP_CWORD=2; _wearlaw wearlaw --iso run; \
                echo ${COMPREPLY[@]}; complete -p wearlaw";
    let bash = std::process::Command::new("bash").current_dir(here.path()).args(["-c", asks]).output();
    let bash = ended(bash.expect("bash starts"), &["bash"]);
    assert_eq!(bash.code, 0, "{}", bash.stderr);
    let lines: Vec<&str> = bash.stdout.lines().collect();
    assert_eq!(lines[..2], ["stability study", "--isolate"]);
    assert!(lines[2].ends_with(" wearlaw"), "{}", lines[2]);
    for shell in ["zsh", "fish"] {
        assert!(run(here.path(), &["completions", shell]).stdout.contains("stability"), "{shell}");
    }
    fails(here.path(), &["completions", "csh"], 2, "input");

    let page = |words: &[&str]| run(here.path(), words).stdout;
    let (whole, of_run) = (page(&["man"]), page(&["man", "run"]));
    assert!(whole.contains(".TH wearlaw 1") && whole.contains("wearlaw\\-stability(1)"), "{whole}");
    assert!(of_run.contains(".TH wearlaw-run 1") && of_run.contains("\\-\\-isolate"), "{of_run}");
    assert_eq!(json(&page(&["man", "run", "--json"]))["page"], of_run.as_str());
    let message = fails(here.path(), &["man", "walk"], 2, "input");
    assert!(message.contains("`walk`") && message.contains("stability, study"), "{message}");
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
    let ended = ended(command.env("CC", &compiler).output().expect("the program starts"), &["build"]);
    assert_eq!(ended.code, 130, "{}", ended.stderr);
    let document = json(&ended.stdout);
    assert_eq!((&document["exit_code"], &document["error"]["kind"]), (&130.into(), &"interrupted".into()));
    assert_eq!(std::fs::read_dir(here.path()).unwrap().count(), before);
}

#[test]
fn what_hangs_or_ends_the_process_when_it_is_loaded_ends_neither_build_nor_inspect() {
    let here = folder();
    let at_load = |name: &str, fault: &str| {
        let loaded = format!("__attribute__((constructor)) static void open_up(void) {{ {fault} }}\n");
        write(here.path(), &format!("{name}.c"), &format!("#include <unistd.h>\n{loaded}{LAW}"));
    };
    at_load("ends", "_exit(0);");
    for words in [["build", "ends.c"], ["inspect", "libends.so"]] {
        let message = fails(here.path(), &words, 3, "law");
        assert!(message.contains("ended its worker process with exit code 0 while it was opened"), "{message}");
    }
    // It has some seconds, so once is enough.
    at_load("hangs", "for (;;) {}");
    let ended = run(here.path(), &["build", "hangs.c"]);
    assert_eq!(ended.code, 3, "{}", ended.stderr);
    assert!(ended.stderr.contains("libhangs.so` did not answer within 10 s"), "{}", ended.stderr);
}

#[test]
fn what_a_law_prints_never_reaches_the_document_of_json() {
    let here = folder();
    let talks = "#include <stdio.h>\n#include <unistd.h>\n#include <stdlib.h>\n\
        static void talk(const char *where) { printf(\"said %s\\n\", where); (void)!write(1, \"at once\\n\", 8); }\n\
        __attribute__((constructor)) static void open_up(void) { talk(\"when it was opened\"); }\n";
    let law = LAW.replace("WL_POINT {", "WL_POINT {\n    talk(\"when it was asked\");");
    write(here.path(), "talks.c", &format!("{talks}{law}"));
    let built = run(here.path(), &["build", "talks.c", "-o", "talks.so", "--json"]);
    assert_eq!(built.code, 0, "{}", built.stderr);
    assert!(json(&built.stdout).is_object() && built.stderr.contains("at once"), "{}", built.stderr);
    write(here.path(), "history.csv", "time,point,pressure,velocity\n0,0,1e8,0.1\n1,0,1e8,0.1\n");
    write(
        here.path(),
        "scene.toml",
        "[law]\nuse = \"./talks.so\"\nconstants = { k = 1e-15 }\n[contact]\nmodel = \"prescribed\"\nhistory = \"history.csv\"\n",
    );
    for words in [
        &["run", "scene.toml", "--json"][..],
        &["run", "scene.toml", "--json", "--isolate"],
        &["plan", "scene.toml", "--json"],
        &["inspect", "talks.so", "--json"],
    ] {
        let ended = run(here.path(), words);
        assert_eq!(ended.code, 0, "{words:?}: {}", ended.stderr);
        assert!(json(&ended.stdout).is_object(), "{words:?}");
        assert!(ended.stderr.contains("said when it was opened") && ended.stderr.contains("at once"), "{words:?}");
        if words[0] == "run" {
            assert!(ended.stderr.contains("said when it was asked"), "{words:?}: {}", ended.stderr);
        }
    }
    // Errors are documents too.
    let ended = run(here.path(), &["run", "scene.toml", "--json", "--set", "law.constants=[-1]"]);
    assert_eq!((ended.code, &json(&ended.stdout)["exit_code"]), (2, &2.into()));
    assert!(ended.stderr.contains("at once"));
}
