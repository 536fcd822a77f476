//! Laws from library files: what loads, what is refused and when, and how long a library stays open.

#[path = "support/c_laws.rs"]
mod c_laws;

use c_laws::{CLaw, evaluate};
use wearlaw::law::{EvaluateError, Evaluation, Evaluator, LawInstance, LoadError, LoadOptions, Plugin};

fn open(law: &CLaw) -> Result<Plugin, LoadError> {
    Plugin::open(law.path(), &LoadOptions::default())
}

fn instance(law: &CLaw) -> LawInstance {
    let plugin = open(law).expect("the law is well formed");
    plugin.law(None).expect("it is the only one").create(None).expect("it has no objections")
}

fn failure(at_point: &str) -> EvaluateError {
    evaluate(&instance(&CLaw::new(at_point)), 9).0.expect_err(at_point)
}

#[test]
fn a_law_in_c_is_described_and_evaluated() {
    let law = CLaw::new("");
    let plugin = open(&law).expect("the law is well formed");
    let facts = plugin.facts().expect("it is a file");
    assert_eq!(facts.sha256.len(), 64);
    let described = plugin.laws()[0].descriptor();
    assert_eq!((described.name.as_str(), described.constants[0].default), ("small", Some(1e-4)));
    assert_eq!(described.reads.names(), ["pressure", "slip"]);
    assert!(plugin.warnings().is_empty());
    for points in [0, 1, 10_000] {
        let (result, increment) = evaluate(&instance(&law), points);
        assert_eq!(result, Ok(Evaluation::Good));
        assert!(increment.iter().enumerate().all(|(point, increment)| *increment == 1.0 + point as f64));
    }
}

/// The header with the last field of every growing struct gone.
fn shorter(header: String) -> String {
    let mut header = header;
    for last in [
        "  struct wl_index_column element_id;\n",
        "  double *d_pressure;\n",
        "  const void *(*extension)(const char *id);\n",
        "  char version[WL_VERSION_SIZE];\n} wl_host;",
    ] {
        assert_eq!(header.matches(last).count(), 1, "{last}");
        header = header.replace(last, if last.ends_with("wl_host;") { "} wl_host;" } else { "" });
    }
    header
}

/// The header with fields of a later version behind every growing struct.
fn longer(header: String) -> String {
    let mut header = header;
    for end in ["} wl_view;", "} wl_output;", "} wl_law;", "} wl_quantity;", "} wl_host;"] {
        assert_eq!(header.matches(end).count(), 1, "{end}");
        header = header.replace(end, &format!("  double of_a_later_version[32];\n{end}"));
    }
    header
}

#[test]
fn laws_built_with_shorter_and_longer_structs_load_and_run() {
    let check = "if (view->struct_size == (int64_t)sizeof *view || output->struct_size == (int64_t)sizeof *output) return WL_FAILED;";
    for edit in [shorter as fn(String) -> String, longer] {
        let law = CLaw::edited("", check, edit);
        let (result, increment) = evaluate(&instance(&law), 5);
        assert_eq!(result, Ok(Evaluation::Good), "the law saw its own struct size");
        assert_eq!(increment, [1.0, 2.0, 3.0, 4.0, 5.0]);
    }
}

#[test]
fn a_field_that_this_host_does_not_know_is_refused_by_its_name() {
    let law = CLaw::with("#define READS (WL_FIELD_PRESSURE | WL_FIELD_SLIP | (int64_t)1 << 41)\n", "");
    let error = open(&law).expect_err("it needs the humidity");
    let words = "law 0 (`small`) of `PATH` is malformed: it needs the field `humidity` (bit 41), which this host does not know (ABI 1.0; the law was built for ABI 1.0)";
    assert_eq!(error.to_string(), words.replace("PATH", &law.path().display().to_string()));
    assert!(error.code_has_run());
}

#[test]
fn each_status_and_each_bad_number_names_its_point() {
    let inputs = "point 4 (pressure = 5e0, slip = 5e-1, K = 2e0)";
    for (at_point, words) in [
        ("if (p == 5) return WL_OUT_OF_DOMAIN;", "cannot answer at INPUTS: too much"),
        ("if (p == 5) return WL_FAILED;", "failed at INPUTS: too much"),
        ("if (p == 5) return 42;", "answered status 42, which does not exist, at INPUTS: too much"),
        (
            "if (p == 5) { output->missing = WL_FIELD_GAP; return WL_MISSING_INPUT; }",
            "misses `gap` at INPUTS: too much",
        ),
        (
            "if (p == 5) { output->dt_factor = 1; return WL_CUT_STEP; }",
            "by the factor 1, expected one between 0 and 1, at INPUTS",
        ),
        ("if (p == 5) output->increment[i] = NAN;", "gave increment = NaN at INPUTS, expected a finite number"),
        ("if (p == 5) output->increment[i] = -INFINITY;", "gave increment = -inf at INPUTS, expected a finite number"),
        (
            "if (p == 5 && output->direction) output->direction[3 * i + 2] = 2;",
            "gave a direction of length 2 at INPUTS, expected 1",
        ),
    ] {
        let said = failure(at_point).to_string();
        assert!(said.contains(&words.replace("INPUTS", inputs)), "{said}\n{words}");
    }
    let negative = "if (p == 5) output->increment[i] = -1e-9;";
    assert_eq!(evaluate(&instance(&CLaw::new(negative)), 9).0, Ok(Evaluation::Good), "it claims nothing");
    let law = CLaw::with("#define CLAIMS WL_CLAIM_NON_NEGATIVE\n", negative);
    let error = evaluate(&instance(&law), 9).0.expect_err("it claims that it is never negative");
    assert!(matches!(error, EvaluateError::Negative { at, .. } if at.point == 4));
}

#[test]
fn a_point_is_found_in_a_law_that_writes_no_status() {
    let law = CLaw::with("#define WRITES WL_OUT_DIRECTION\n", "if (p > 5000) return WL_FAILED;");
    let error = evaluate(&instance(&law), 9000).0.expect_err("it fails at 5001");
    assert!(matches!(&error, EvaluateError::Failed { at: Some(at), .. } if at.point == 5000), "{error}");
}

#[test]
fn a_cut_and_a_warning_are_no_errors() {
    let cut = CLaw::new("if (p == 5) { output->dt_factor = 0.5; return WL_CUT_STEP; }");
    let (result, _) = evaluate(&instance(&cut), 9);
    assert!(matches!(result, Ok(Evaluation::CutStep { factor: 0.5, at: Some(at), .. }) if at.point == 4));
    let (result, increment) = evaluate(&instance(&CLaw::new("if (p == 5) return WL_UNRELIABLE;")), 9);
    assert!(matches!(result, Ok(Evaluation::Unreliable { at: Some(at), .. }) if at.point == 4));
    assert_eq!(increment[4], 5.0);
}

#[cfg(target_arch = "x86_64")]
#[test]
fn a_changed_floating_point_environment_is_put_back_with_a_warning() {
    let flush = "unsigned int csr; __asm__ volatile(\"stmxcsr %0\" : \"=m\"(csr)); csr |= 0x8000; __asm__ volatile(\"ldmxcsr %0\" : : \"m\"(csr));";
    let tiny = || std::hint::black_box(f64::MIN_POSITIVE) * std::hint::black_box(0.5);
    assert!(tiny() > 0.0);
    let law = CLaw::new(flush);
    let calls = instance(&law);
    assert_eq!(evaluate(&calls, 9).0, Ok(Evaluation::Good));
    assert!(tiny() > 0.0, "flush-to-zero is still on");
    assert_eq!(evaluate(&calls, 9).0, Ok(Evaluation::Good));
    let warnings = calls.take_warnings();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].contains(&law.path().display().to_string()), "{warnings:?}");
    assert!(warnings[0].contains("flush-to-zero from off to on"), "{warnings:?}");
    let front = format!("__attribute__((constructor)) static void flush(void) {{ {flush} }}\n");
    let plugin = open(&CLaw::with(&front, "")).expect("the law is well formed");
    assert!(tiny() > 0.0, "flush-to-zero is still on");
    assert!(
        plugin.warnings()[0].contains("when it was opened (flush-to-zero from off to on)"),
        "{:?}",
        plugin.warnings()
    );
}

#[test]
fn several_laws_of_a_library_are_told_apart_by_name() {
    let law = CLaw::with("#define LAWS 3\n", "");
    let plugin = open(&law).expect("all three are well formed");
    assert_eq!(plugin.laws().len(), 3);
    assert_eq!(plugin.law(Some("law-2")).expect("the third").descriptor().name, "law-2");
    let path = law.path().display().to_string();
    let said = plugin.law(None).expect_err("which one?").to_string();
    assert_eq!(said, format!("`{path}` holds 3 laws, name one of small, law-1, law-2"));
    let said = plugin.law(Some("law-9")).expect_err("no such law").to_string();
    assert_eq!(said, format!("`{path}` holds no law `law-9`, it has small, law-1, law-2"));
    let said = open(&CLaw::with("#define LAWS 0\n", "")).expect_err("none at all").to_string();
    assert!(said.contains("holds no law"), "{said}");
    let said = open(&CLaw::with("#define LAWS 2000\n", "")).expect_err("no end").to_string();
    assert!(said.contains("still gives laws after 1024"), "{said}");
}

#[test]
fn a_refusal_to_start_is_told_in_the_laws_own_words() {
    let law = CLaw::new("");
    let plugin = open(&law).expect("the law is well formed");
    let error = plugin.laws()[0].create(Some("refuse")).expect_err("it refuses");
    let path = law.path().display().to_string();
    let words = format!("law `small` of `{path}` refused to start (status 5): the table wear.dat is not there");
    assert_eq!(error.to_string(), words);
    assert!(error.code_has_run());
}

/// Runs a test of this file again in a process of its own, with an environment variable for the law to write notes to.
fn in_own_process(test: &str, notes: &std::path::Path, law: &std::path::Path) -> String {
    let output = std::process::Command::new(std::env::current_exe().expect("this test's program"))
        .args([test, "--exact", "--nocapture"])
        .env("WEARLAW_TEST_NOTES", notes)
        .env("WEARLAW_TEST_LAW", law)
        .output()
        .expect("this program can be started");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    std::fs::read_to_string(notes).unwrap_or_default()
}

#[test]
fn a_library_is_closed_after_its_last_instance_is_destroyed() {
    let Some(path) = std::env::var_os("WEARLAW_TEST_LAW") else {
        let law = CLaw::new("if (i == 0) note(\"evaluate\\n\");");
        let notes =
            in_own_process("a_library_is_closed_after_its_last_instance_is_destroyed", &law.file("notes"), &law.path());
        assert_eq!(notes, "open\ncreate\nevaluate\ndestroy\nclose\nend of the test\n");
        return;
    };
    let plugin = Plugin::open(path, &LoadOptions::default()).expect("the law is well formed");
    let law = plugin.law(None).expect("it is the only one").clone();
    let instance = law.create(None).expect("it has no objections");
    drop(plugin);
    drop(law);
    assert_eq!(evaluate(&instance, 3).0, Ok(Evaluation::Good));
    drop(instance);
    let notes = std::env::var_os("WEARLAW_TEST_NOTES").expect("set by the caller");
    let before = std::fs::read_to_string(&notes).expect("the law wrote it");
    std::fs::write(&notes, before + "end of the test\n").expect("a temporary file can be written");
}

#[test]
fn no_code_of_a_refused_file_has_run() {
    const TEST: &str = "no_code_of_a_refused_file_has_run";
    let Some(path) = std::env::var_os("WEARLAW_TEST_LAW") else {
        let good = CLaw::new("");
        assert_eq!(in_own_process(TEST, &good.file("notes"), &good.path()), "");
        let missing = CLaw::with("int of_another_library(void);\n", "return of_another_library();");
        assert_eq!(in_own_process(TEST, &missing.file("notes"), &missing.path()), "");
        return;
    };
    let pin = LoadOptions { sha256: Some("0".repeat(64)) };
    let error = Plugin::open(&path, &pin).expect_err("it has another SHA-256");
    assert!(matches!(error, LoadError::Pin(_)) && !error.code_has_run(), "{error}");
    if let Err(error) = wearlaw::law::file_facts::FileFacts::read(&path) {
        panic!("{error}");
    }
    // Only the law with the missing symbol is opened without a pin: the other one would run, and rightly.
    let bytes = std::fs::read(&path).expect("the law was compiled");
    if bytes.windows(18).any(|window| window == b"of_another_library") {
        let error = Plugin::open(&path, &LoadOptions::default()).expect_err("a symbol is missing");
        assert!(matches!(error, LoadError::Linker(_)) && !error.code_has_run(), "{error}");
        assert!(error.to_string().contains("needs the symbol `of_another_library`"), "{error}");
    }
}

#[test]
fn a_right_pin_loads_and_a_bare_file_name_is_a_file() {
    let law = CLaw::new("");
    let sha256 = open(&law).expect("the law is well formed").facts().map(|facts| facts.sha256.clone());
    assert!(Plugin::open(law.path(), &LoadOptions { sha256 }).is_ok());
    let error = Plugin::open("libm.so.6", &LoadOptions::default()).expect_err("no such file here");
    assert!(matches!(error, LoadError::File(_)), "{error}");
}
