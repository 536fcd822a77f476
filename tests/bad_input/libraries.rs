//! Files that are no wear law, or not the one that was meant: refused with exit code 2, and none of their code has run.

use std::io::Write;
use std::path::Path;
use std::process::Command;

use super::c_laws::CLaw;
use super::program::Room;

/// Holds a library to the refusal: by `run`, by `run --isolate` and by `inspect`, and no constructor of it ran.
fn refused(room: &Room, library: &Path, telling: &[&str]) {
    let law = library.to_str().expect("a plain name");
    room.refused(&["run", "scene.toml", "--law", law], telling);
    room.refused(&["run", "scene.toml", "--law", law, "--isolate"], telling);
    room.refused(&["plan", "scene.toml", "--law", law], telling);
    room.refused(&["inspect", law], telling);
    assert!(!room.file("notes").exists(), "code of {law} has run: {telling:?}");
}

/// The bytes of a law that would run, changed and put under another name.
fn changed(room: &Room, name: &str, change: impl FnOnce(&mut Vec<u8>)) -> std::path::PathBuf {
    let mut bytes = std::fs::read(CLaw::new("").path()).expect("the law was compiled");
    change(&mut bytes);
    let path = room.file(name);
    std::fs::write(&path, bytes).expect("the folder can be written");
    path
}

#[test]
fn the_law_that_is_spoiled_below_runs_and_notes_it() {
    let (room, law) = (Room::new(), CLaw::new(""));
    let ended = room.run(&[
        "run",
        "scene.toml",
        "--law",
        law.path().to_str().expect("a plain name"),
        "--set",
        "law.constants=[2]",
    ]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let notes = std::fs::read_to_string(room.file("notes")).expect("its constructor wrote it");
    assert!(notes.starts_with("open\n"), "{notes}");
}

#[test]
fn what_is_no_library_is_refused() {
    let room = Room::new();
    room.write("text.so", "no library at all, but words\n");
    refused(&room, &room.file("text.so"), &["text.so", "is not a shared library but"]);
    room.write("empty.so", "");
    refused(&room, &room.file("empty.so"), &["empty.so", "is empty", "expected a wear-law library"]);
    std::fs::create_dir(room.file("folder.so")).expect("a folder");
    refused(&room, &room.file("folder.so"), &["folder.so", "is a folder", "expected a wear-law library"]);
    refused(&room, Path::new("./none.so"), &["none.so", "no file", "expected a wear-law library"]);
    let program = std::fs::read(env!("CARGO_BIN_EXE_wearlaw")).expect("the program");
    std::fs::write(room.file("program.so"), &program).expect("the folder can be written");
    refused(&room, &room.file("program.so"), &["program.so"]);
}

#[test]
fn spoiled_libraries_are_refused_before_their_code_runs() {
    let room = Room::new();
    for keep in [40, 900, 9000] {
        let cut = changed(&room, "cut.so", |bytes| bytes.truncate(keep));
        refused(&room, &cut, &["cut.so", &format!("holds {keep} bytes"), "cut short"]);
    }
    let other = changed(&room, "arm.so", |bytes| bytes[18..20].copy_from_slice(&183_u16.to_le_bytes()));
    refused(&room, &other, &["arm.so", "aarch64", "this program runs on"]);
    let small = changed(&room, "small.so", |bytes| bytes[4] = 1);
    refused(&room, &small, &["small.so"]);
}

#[test]
fn libraries_without_the_entry_are_refused() {
    let room = Room::new();
    let none = CLaw::with("#define wearlaw_entry_1 another_function\n", "");
    refused(&room, &none.path(), &["exports no function `wearlaw_entry_1`", "no wear law"]);
    let next = CLaw::with("#define wearlaw_entry_1 wearlaw_entry_2\n", "");
    refused(&room, &next.path(), &["exports `wearlaw_entry_2`", "major version 1", "`wearlaw_entry_1`"]);
}

#[test]
fn what_a_library_needs_has_to_be_there() {
    let room = Room::new();
    let symbol = CLaw::with("int of_another_library(void);\n", "return of_another_library();");
    refused(&room, &symbol.path(), &["needs the symbol `of_another_library`", "define"]);

    room.write("gone.c", "int of_a_library_that_goes(void) { return 0; }\n");
    let law = CLaw::with("int of_a_library_that_goes(void);\n", "");
    let source = law.file("law.c");
    compile(&room, &["-o", "libgone.so", "gone.c"]);
    let source = source.to_str().expect("a plain name");
    compile(&room, &["-Wl,--no-as-needed", "-o", "needy.so", source, "-L.", "-lgone", "-lm"]);
    std::fs::remove_file(room.file("libgone.so")).expect("it was there");
    refused(&room, &room.file("needy.so"), &["needy.so", "needs the library `libgone.so`", "not there"]);
}

/// Compiles a library in a room; true if the compiler could.
fn compile(room: &Room, words: &[&str]) -> bool {
    let mut compiler = Command::new(std::env::var("CC").unwrap_or_else(|_| "cc".to_owned()));
    compiler.current_dir(room.file("")).args(["-shared", "-fPIC"]).args(words);
    compiler.output().expect("a C compiler").status.success()
}

#[test]
fn a_sanitised_library_without_its_runtime_is_refused() {
    let (room, law) = (Room::new(), CLaw::new(""));
    let source = law.file("law.c");
    if !compile(&room, &["-fsanitize=address", "-o", "checked.so", source.to_str().expect("a plain name"), "-lm"]) {
        // Straight to the stream: the harness keeps what `println!` writes when a test passes.
        let line =
            "NOT RUN: a_sanitised_library_without_its_runtime_is_refused: the C compiler has no AddressSanitizer";
        writeln!(std::io::stdout(), "{line}").expect("stdout is open");
        return;
    }
    refused(&room, &room.file("checked.so"), &["checked.so", "address sanitizer", "libasan", "LD_PRELOAD"]);
}

#[test]
fn a_library_with_another_sha256_is_refused() {
    let (room, law) = (Room::new(), CLaw::new(""));
    let (path, pin) = (law.path(), "0".repeat(64));
    let (path, set) = (path.to_str().expect("a plain name"), format!("law.sha256=\"{pin}\""));
    for more in [&[] as &[&str], &["--isolate"]] {
        let words = [&["run", "scene.toml", "--law", path, "--set", &set], more].concat();
        room.refused(&words, &["has the SHA-256", "expected 0000", path]);
    }
    assert!(!room.file("notes").exists(), "its code has run");
}

#[test]
fn a_library_of_several_laws_wants_a_name() {
    let (room, law) = (Room::new(), CLaw::with("#define LAWS 3\n", ""));
    let path = law.path();
    let path = path.to_str().expect("a plain name");
    room.refused(&["run", "scene.toml", "--law", path], &["3 laws", "small, law-1, law-2", "#small"]);
    room.refused(&["run", "scene.toml", "--law", &format!("{path}#law-9")], &["`law-9`", "small, law-1, law-2"]);
}

#[test]
fn a_law_that_fails_while_it_is_opened_ends_with_3() {
    let room = Room::new();
    let law = CLaw::new("");
    let path = law.path();
    let words = ["run", "scene.toml", "--law", path.to_str().expect("a plain name"), "--set", "law.options=\"refuse\""];
    let telling = ["`small`", "refused to start", "the table wear.dat is not there"];
    room.fails(&words, (3, "law"), &telling);
    room.fails(&[&words[..], &["--isolate"]].concat(), (3, "law"), &telling);
    let crash = [&words[..5], &["law.options=\"crash\"", "--isolate"]].concat();
    room.fails(&crash, (3, "law"), &["signal 6, SIGABRT", "while it was opened"]);
    for (front, telling) in [
        ("#define LAWS 0\n", &["holds no law"] as &[&str]),
        ("#define LAWS 2000\n", &["still gives laws after 1024"]),
        ("#define READS ((int64_t)1 << 41)\n", &["needs the field `humidity`", "does not know"]),
    ] {
        let law = CLaw::with(front, "");
        let path = law.path();
        room.fails(&["run", "scene.toml", "--law", path.to_str().expect("a plain name")], (3, "law"), telling);
    }
}
