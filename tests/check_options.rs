//! `wearlaw check` of a law that reads its options: what goes wrong behind good ones, and without any.
#![cfg(target_os = "linux")]

#[path = "support/checked.rs"]
mod checked;
#[path = "support/program.rs"]
mod program;

use std::path::Path;

use checked::{of, outcomes};
use program::{folder, json, run, write};
use serde_json::Value;

/// Words of a law, and what takes their place.
type Exchange = (&'static str, &'static str);

/// The law of `include/README.md` that reads a table which its options name, with some words of it exchanged, and what check
/// says of it with the option.
fn tabulated(folder: &Path, name: &str, exchanged: &[Exchange], more: &[&str]) -> (i32, Value) {
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../include/README.md")).expect("the page");
    let block = page.split("```c\n").find(|block| block.contains("\"tabulated\"")).expect("the law on the page");
    let mut law = block.split("```").next().expect("a block ends").to_owned();
    for (from, to) in exchanged {
        assert!(law.contains(from), "{name}: {from}");
        law = law.replace(from, to);
    }
    write(folder, &format!("{name}.c"), &law);
    write(folder, "table.csv", "0, 0\n1, 1\n2, 3\n5, 4\n");
    let source = format!("{name}.c");
    let words = [&["check", source.as_str(), "--json"], more].concat();
    let ended = run(folder, &words);
    (ended.code, json(&ended.stdout))
}

#[test]
fn what_goes_wrong_behind_good_options_is_found() {
    let here = folder();
    let table = ["--options", "table=table.csv"];
    let falls_short = |document: &Value| {
        let each = ["fail", "crashed", "timed-out"].map(|outcome| outcomes(document, outcome));
        each.concat().into_iter().map(str::to_owned).collect::<Vec<_>>()
    };
    let (code, document) = tabulated(here.path(), "sound", &[], &table);
    assert_eq!((code, falls_short(&document).len(), outcomes(&document, "warn").len()), (0, 0, 0), "{document:#}");
    let shared = [
        ("table *own = calloc(1, sizeof *own);", "static table one, *own = &one; own->rows = 0;"),
        ("        free(own);\n", ""),
        ("#define LAW_DESTROY free\n", ""),
    ];
    let kept = [
        ("enum { MOST = 64 };", "enum { MOST = 64 };\nstatic const char *kept;"),
        ("    *instance = own;", "    *instance = own, kept = options;"),
        ("    double x = ", "    double x = kept[0] == '?' ? 0 : "),
    ];
    let cases: [(&str, &[Exchange], &str); 8] = [
        ("shares_its_table", &shared, "determinism/recreate"),
        ("keeps_the_options", &kept, "determinism/recreate"),
        ("leaks_when_it_refuses", &[("        free(own);\n", "")], "memory/instances"),
        ("leaves_a_file_open", &[("if (file) fclose(file);", "if (file && !wrong) fclose(file);")], "memory/instances"),
        (
            "overruns_a_name",
            &[(
                "    (void)host;",
                "    char copy[64];\n    (void)host;\n    strcpy(copy, name);\n    if (copy[0] == 1) abort();",
            )],
            "faults/create",
        ),
        (
            "writes_to_the_options",
            &[("    (void)host;", "    (void)host;\n    if (options && *name) *(char *)(size_t)name = 'T';")],
            "faults/create",
        ),
        (
            "says_nothing_of_a_row",
            &[
                ("return \"no two numbers in a row of \";", "{ own->rows = -1; return \"\"; }"),
                ("\"%s`%s`\", wrong, name", "\"%s%s\", wrong, *wrong ? name : \"\""),
            ],
            "faults/create",
        ),
        (
            "prints_the_row",
            &[("return \"no two numbers in a row of \";", "{ puts(line); return \"no two numbers in a row of \"; }")],
            "load/silent",
        ),
    ];
    for (name, exchanged, wanted) in cases {
        let (code, document) = tabulated(here.path(), name, exchanged, &table);
        assert_eq!((code, falls_short(&document)), (1, vec![wanted.to_owned()]), "{name}: {document:#}");
    }
}

#[test]
fn a_law_that_starts_with_options_only_is_not_tested_without_them() {
    let here = folder();
    let only = ["--only", "faults/create", "--only", "batch/singles"];
    let (code, document) = tabulated(here.path(), "tabulated", &[], &only);
    assert_eq!((code, of(&document, "faults/create")["outcome"].as_str()), (2, Some("warn")), "{document:#}");
    assert_eq!(
        (&document["passes"], of(&document, "batch/singles")["outcome"].as_str()),
        (&false.into(), Some("skipped"))
    );
    assert!(document["untested"].as_str().is_some_and(|words| words.contains("--options")), "{document:#}");
    let wrong = [&only[..], &["--options", "table=none.csv"]].concat();
    let (code, document) = tabulated(here.path(), "tabulated", &[], &wrong);
    assert_eq!(code, 2, "{document:#}");
    assert!(document["untested"].as_str().is_some_and(|words| words.contains("`none.csv`")), "{document:#}");
    // What brings a finding back has the options, too.
    let words = ["check", "tabulated.c", "--options", "table=none.csv", "--only", "faults/create"];
    let said = run(here.path(), &words).stdout;
    assert!(said.contains("--only faults/create --options 'table=none.csv'"), "{said}");
}
