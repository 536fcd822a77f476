//! A law table of less than the 1.0 size: refused by every law that a small host gives one, and by this host.

#![allow(unsafe_code)] // calls entries as a small host would; each block says what holds

use std::path::Path;

use wearlaw_plugin_api::abi::{ENTRY_SYMBOL, EntryFn, Host, LawTable, WL_FAILED, WL_OK};

use super::c_laws::CLaw;
use super::program::Room;

/// What a library's entry answers for a table that states this size, and whether the table stayed as it was.
fn answer(library: &Path, size: usize) -> (i32, bool) {
    // SAFETY: the libraries are laws that these tests built, which do nothing when they are loaded.
    let library = unsafe { libloading::Library::new(library) }.expect("the library loads");
    // SAFETY: a law's entry has this type by the ABI.
    let entry: EntryFn = unsafe { *library.get::<EntryFn>(ENTRY_SYMBOL).expect("an entry") };
    // SAFETY: all bits zero is a value of these plain structs.
    let (mut law, mut host): (LawTable, Host) = unsafe { (std::mem::zeroed(), std::mem::zeroed()) };
    law.struct_size = size as i64;
    host.struct_size = size_of::<Host>() as i64;
    // SAFETY: both structs live through the call and are no smaller than they say.
    let status = unsafe { entry(0, &host, &mut law) };
    (status, law.name[0] == 0 && law.evaluate.is_none())
}

#[test]
fn laws_refuse_a_table_of_less_than_the_first_version() {
    let room = Room::new();
    let mut languages = vec!["c", "cpp"];
    match room.run(&["new", "mine-fortran", "--lang", "fortran", "-q"]).code == 0 && has_fortran(&room) {
        true => languages.push("fortran"),
        false => {
            // Straight to the stream: the harness keeps what `println!` writes when a test passes.
            use std::io::Write;
            let line = "NOT RUN: laws_refuse_a_table_of_less_than_the_first_version: no Fortran compiler";
            writeln!(std::io::stdout(), "{line}").expect("stdout is open");
        }
    }
    let mut libraries: Vec<std::path::PathBuf> = Vec::new();
    for language in languages {
        let (name, library) = (format!("mine-{language}"), format!("{language}.so"));
        room.run(&["new", &name, "--lang", language, "-q"]);
        let source = std::fs::read_dir(room.file(&name)).expect("a new folder").find_map(|entry| {
            let path = entry.expect("an entry").path();
            let name = path.file_name()?.to_str()?.to_owned();
            [".c", ".cpp", ".f90"].iter().any(|ending| name.ends_with(ending)).then(|| path.display().to_string())
        });
        let built = room.run(&["build", "-q", "-o", &library, &source.expect("its source")]);
        assert_eq!(built.code, 0, "{}", built.stderr);
        libraries.push(room.file(&library));
    }
    // The reference law, written in Rust, stands beside the program.
    let deps = Path::new(env!("CARGO_BIN_EXE_wearlaw")).parent().expect("a folder").join("deps");
    libraries.extend([deps.join("libwearlaw_archard.so")].into_iter().filter(|path| path.is_file()));
    for library in libraries {
        assert_eq!(answer(&library, size_of::<LawTable>()), (WL_OK, false), "{}", library.display());
        for size in [size_of::<LawTable>() - 8, 16, 8, 0] {
            assert_eq!(answer(&library, size), (WL_FAILED, true), "{} at {size}", library.display());
        }
    }
}

fn has_fortran(room: &Room) -> bool {
    let compiler = std::env::var("FC").unwrap_or_else(|_| "gfortran".to_owned());
    let mut version = std::process::Command::new(compiler);
    version.current_dir(room.file("")).arg("--version").output().is_ok_and(|output| output.status.success())
}

#[test]
fn the_host_refuses_a_law_that_makes_its_table_smaller() {
    let room = Room::new();
    let law = CLaw::new("");
    let source = std::fs::read_to_string(law.file("law.c")).expect("its source");
    let (above, entry) = source.split_at(source.find("int32_t wearlaw_entry_1(").expect("an entry"));
    let size = "memcpy(law, &mine, (size_t)size);";
    assert!(entry.contains(size));
    // It thinks that the size of the table is its own to state.
    room.write("small.c", &format!("{above}{}", entry.replace(size, &format!("mine.struct_size = 64;\n  {size}"))));
    std::fs::copy(law.file("wearlaw.h"), room.file("wearlaw.h")).expect("the header");
    assert_ne!(room.run(&["build", "small.c", "-q", "-o", "small.so"]).code, 0, "what is built is loaded once");
    let telling = ["`small`", "malformed", "struct_size", "64", &size_of::<LawTable>().to_string()];
    room.fails(&["run", "scene.toml", "--law", "./small.so"], (3, "law"), &telling);
}
