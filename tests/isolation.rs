//! Laws in a worker process: the same bits, and a crash, a hang or an exit ends the worker and nothing else.
#![cfg(target_os = "linux")]

#[path = "support/c_laws.rs"]
mod c_laws;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use c_laws::{CLaw, evaluate};
use wearlaw::law::{
    EvaluateError, Evaluation, Evaluator, IsolateError, IsolateOptions, IsolatedLaw, LoadOptions, Plugin, Source,
};

fn options(law: &CLaw) -> IsolateOptions {
    IsolateOptions {
        program: Some(PathBuf::from(env!("CARGO_BIN_EXE_wearlaw"))),
        deadline: Duration::from_secs(20),
        ..IsolateOptions::new(Source::File(law.path()))
    }
}

fn open(law: &CLaw) -> IsolatedLaw {
    IsolatedLaw::open(&options(law)).expect("the law is well formed")
}

/// Says what a lost worker's call comes to, then that the law still works where it did before.
fn loss(at_point: &str, points: usize) -> String {
    let law = CLaw::new(at_point);
    let isolated = open(&law);
    assert_eq!(evaluate(&isolated, 3).0, Ok(Evaluation::Good));
    let error = evaluate(&isolated, points).0.expect_err(at_point);
    assert!(matches!(error, EvaluateError::WorkerLost { .. }), "{error}");
    let (result, increment) = evaluate(&isolated, 3);
    assert_eq!((result, increment), (Ok(Evaluation::Good), vec![1.0, 2.0, 3.0]));
    error.to_string()
}

#[test]
fn the_bits_are_those_of_the_law_in_process() {
    let at_point =
        "output->increment[i] *= 1 / (1 + sqrt(p)); if (p == 7 && output->direction) output->direction[3 * i] = 1e-10;";
    let law = CLaw::new(at_point);
    let plugin = Plugin::open(law.path(), &LoadOptions::default()).expect("the law is well formed");
    let here = plugin.laws()[0].create(None).expect("it has no objections");
    let there = open(&law);
    assert_eq!(there.descriptor(), here.descriptor());
    for points in [0, 1, 4097, 200_001] {
        let (mine, theirs) = (evaluate(&here, points), evaluate(&there, points));
        assert_eq!(mine.0, theirs.0);
        assert!(mine.1.iter().zip(&theirs.1).all(|(mine, theirs)| mine.to_bits() == theirs.to_bits()));
    }
}

#[test]
fn several_threads_have_a_worker_each() {
    let law = CLaw::new("");
    let isolated = open(&law);
    std::thread::scope(|scope| {
        for points in [10, 5_000, 100_000, 1] {
            let isolated = &isolated;
            scope.spawn(move || {
                for _ in 0..20 {
                    let (result, increment) = evaluate(isolated, points);
                    assert_eq!(result, Ok(Evaluation::Good));
                    assert_eq!(increment[points - 1], points as f64);
                }
            });
        }
    });
}

#[test]
fn statuses_and_bad_numbers_name_the_point_as_in_process() {
    let law = CLaw::new("if (p == 70001) return WL_OUT_OF_DOMAIN; if (p == 80001) output->increment[i] = NAN;");
    let plugin = Plugin::open(law.path(), &LoadOptions::default()).expect("the law is well formed");
    let here = plugin.laws()[0].create(None).expect("it has no objections");
    let there = open(&law);
    let error = evaluate(&there, 100_000).0.expect_err("out of its domain");
    assert!(error.to_string().contains("cannot answer at point 70000 (pressure = 7.0001e4"), "{error}");
    assert_eq!(Err(error), evaluate(&here, 100_000).0);
    let cut = CLaw::new("if (p == 5) { output->dt_factor = 0.1; return WL_CUT_STEP; }");
    let (result, _) = evaluate(&open(&cut), 100_000);
    assert!(matches!(result, Ok(Evaluation::CutStep { factor: 0.1, at: Some(at), .. }) if at.point == 4));
}

#[test]
fn a_crash_names_the_call_the_points_and_the_inputs() {
    let said = loss("if (p == 70001) *(volatile int *)8 = 1;", 100_000);
    assert_eq!(
        said,
        "law `small` crashed (signal 11, SIGSEGV, it touched memory that is not its own) in call 2, points 65536 to \
         73727, at point 70000 (pressure = 7.0001e4, slip = 5e-1, K = 2e0)"
    );
}

#[test]
fn an_abort_and_an_exit_are_told_apart() {
    let said = loss("if (p == 5) abort();", 10);
    assert!(
        said.contains("crashed (signal 6, SIGABRT, it aborted) in call 2, points 0 to 9, at point 4 (pressure = 5e0"),
        "{said}"
    );
    let said = loss("if (p == 5) exit(0);", 10);
    assert!(said.contains("ended its worker process with exit code 0 in call 2"), "{said}");
    assert!(said.contains("at point 4 ("), "{said}");
}

#[test]
fn closing_every_descriptor_ends_the_worker_only() {
    let said = loss("if (p == 5) { int fd; for (fd = 3; fd < 64; fd++) close(fd); }", 10);
    assert!(said.contains("ended its worker process with exit code 5 in call 2"), "{said}");
}

#[test]
fn an_endless_loop_is_ended_at_the_deadline() {
    let law = CLaw::new("if (p == 5) for (;;) { volatile int spin = 0; (void)spin; }");
    let isolated = IsolatedLaw::open(&IsolateOptions { deadline: Duration::from_millis(300), ..options(&law) })
        .expect("the law is well formed");
    let start = Instant::now();
    let said = evaluate(&isolated, 10).0.expect_err("it hangs").to_string();
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    assert!(
        said.contains("did not answer within 0.3 s and was ended in call 1, points 0 to 9, at point 4 (pressure = 5e0"),
        "{said}"
    );
    assert_eq!(evaluate(&isolated, 3).0, Ok(Evaluation::Good));
}

#[test]
fn processes_that_a_law_started_end_with_its_worker() {
    for end in ["for (;;) pause();", "abort();"] {
        let at_point = format!(
            "if (p == 5) {{ pid_t child = fork(); if (child == 0) for (;;) pause(); \
             char text[32]; sprintf(text, \"%d\\n\", (int)child); note(text); {end} }}"
        );
        let law = CLaw::new(&at_point);
        let notes = law.file("notes");
        let here = "processes_that_a_law_started_end_with_its_worker";
        // The notes' place is an environment variable, which a test may set for a process of its own only.
        if std::env::var_os("WEARLAW_TEST_NOTES").is_none() {
            let output = std::process::Command::new(std::env::current_exe().expect("this test's program"))
                .args([here, "--exact"])
                .env("WEARLAW_TEST_NOTES", &notes)
                .output()
                .expect("this program can be started");
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
            return;
        }
        let notes = PathBuf::from(std::env::var_os("WEARLAW_TEST_NOTES").expect("set above"));
        std::fs::write(&notes, "").expect("a temporary file can be written");
        let deadline = Duration::from_millis(300);
        let isolated =
            IsolatedLaw::open(&IsolateOptions { deadline, ..options(&law) }).expect("the law is well formed");
        evaluate(&isolated, 10).0.expect_err("it hangs or crashes");
        drop(isolated);
        let written = std::fs::read_to_string(&notes).expect("the law wrote it");
        let children: Vec<u32> = written.lines().filter_map(|line| line.parse().ok()).collect();
        assert!(!children.is_empty(), "{written}");
        for child in children {
            let stat = std::fs::read_to_string(format!("/proc/{child}/stat")).unwrap_or_default();
            assert!(stat.is_empty(), "process {child} is still there: {stat}");
        }
    }
}

#[test]
fn a_refusal_or_a_crash_while_opening_is_one_sentence() {
    let law = CLaw::new("");
    let with = |words: &str| IsolateOptions { options: Some(words.to_owned()), ..options(&law) };
    let error = IsolatedLaw::open(&with("refuse")).expect_err("it refuses");
    assert!(matches!(error, IsolateError::Refused { code_has_run: true, .. }));
    let path = law.path().display().to_string();
    let words = format!("law `small` of `{path}` refused to start (status 5): the table wear.dat is not there");
    assert_eq!(error.to_string(), words);
    let error = IsolatedLaw::open(&with("crash")).expect_err("it aborts");
    assert_eq!(error.to_string(), format!("`{path}` crashed (signal 6, SIGABRT, it aborted) while it was opened"));
    assert!(error.code_has_run());
    let pin = IsolateOptions { sha256: Some("f".repeat(64)), ..options(&law) };
    let error = IsolatedLaw::open(&pin).expect_err("it has another SHA-256");
    assert!(matches!(error, IsolateError::Load(_)) && !error.code_has_run(), "{error}");
    let gone = IsolateOptions { program: Some(PathBuf::from("/no/such/program")), ..options(&law) };
    assert!(matches!(IsolatedLaw::open(&gone), Err(IsolateError::Start { .. })));
    let front = "__attribute__((constructor)) static void crash(void) { *(volatile int *)8 = 1; }\n";
    let error = IsolatedLaw::open(&options(&CLaw::with(front, ""))).expect_err("its constructor crashes");
    assert!(error.to_string().contains("crashed (signal 11"), "{error}");
}

#[test]
fn a_worker_lives_on_when_the_thread_that_opened_it_ends() {
    let law = CLaw::new("");
    let options = options(&law);
    let isolated = std::thread::spawn(move || IsolatedLaw::open(&options).expect("the law is well formed"))
        .join()
        .expect("the thread ends well");
    assert_eq!(evaluate(&isolated, 3).0, Ok(Evaluation::Good));
}
