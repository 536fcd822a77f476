//! Laws that try to take the tester down, or to leave something behind; each is whole but for one piece of C.

use std::path::{Path, PathBuf};
use std::process::Command;

/// A law with a piece of C that runs in every evaluation, or while it is loaded.
pub struct Bad {
    pub name: &'static str,
    /// Runs in every evaluation.
    evaluated: &'static str,
    /// Runs while the library is loaded.
    at_load: &'static str,
    /// Time for the check, ms: short for what never ends.
    pub timeout: u64,
    /// How its check may end: `blocked` stands for one that failed while the library was loaded.
    pub outcomes: &'static [&'static str],
}

const LONG: u64 = 20_000;
const SHORT: u64 = 400;
const CRASHED: &[&str] = &["crashed"];
const LATE: &[&str] = &["timed-out"];

const fn evaluated(
    name: &'static str,
    evaluated: &'static str,
    timeout: u64,
    outcomes: &'static [&'static str],
) -> Bad {
    Bad { name, evaluated, at_load: "", timeout, outcomes }
}

/// A law that breaks out while its library is loaded, in a constructor with this body.
const fn at_load(name: &'static str, at_load: &'static str, timeout: u64, outcomes: &'static [&'static str]) -> Bad {
    Bad { name, evaluated: "", at_load, timeout, outcomes }
}

/// The laws, each with one way to break out.
pub const BAD: &[Bad] = &[
    evaluated("hangs", "for (;;) pause();", SHORT, LATE),
    evaluated("spins_with_signals_blocked", "block(); for (;;) { }", SHORT, LATE),
    evaluated("crashes", "*(volatile int *)0 = 1;", LONG, CRASHED),
    evaluated("aborts", "abort();", LONG, CRASHED),
    evaluated("exits", "exit(0);", LONG, CRASHED),
    evaluated("overflows_the_stack", "out->increment = deep(1);", LONG, CRASHED),
    evaluated("kills_its_group", "kill(0, SIGKILL);", LONG, CRASHED),
    evaluated("forks", "static int done; if (done++ == 0 && fork() == 0) for (;;) pause();", LONG, &["pass"]),
    evaluated("forks_and_hangs", "if (fork() == 0) { block(); for (;;) { } } for (;;) pause();", SHORT, LATE),
    evaluated("child_in_a_session", "hide(); abort();", LONG, CRASHED),
    evaluated("child_in_a_session_then_hangs", "hide(); block(); for (;;) { }", SHORT, LATE),
    evaluated("child_with_another_environment", "hide_and_run(); *(volatile int *)0 = 1;", LONG, CRASHED),
    evaluated("child_then_exit", "hide_and_run(); hide(); _exit(0);", LONG, CRASHED),
    evaluated("kills_its_parent", "hide(); kill(getppid(), SIGKILL); for (;;) pause();", LONG, CRASHED),
    evaluated("thread_and_exit", "pthread_t t; pthread_create(&t, 0, spin, 0); exit(3);", LONG, CRASHED),
    evaluated(
        "prints_without_end",
        "for (;;) puts(\"and on and on and on and on and on and on and on\");",
        SHORT,
        LATE,
    ),
    at_load("aborts_at_load", "hide(); abort();", LONG, CRASHED),
    at_load("hangs_at_load", "hide(); block(); for (;;) { }", SHORT, LATE),
];

const SOURCE: &str = r#"
#define _GNU_SOURCE
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>
#define LAW_NAME "bad"
#define LAW_VERSION "1.0"
#define LAW_SUMMARY "breaks out"
#define LAW_READS(F) F(pressure) F(slip)
#define LAW_CONSTANTS(C) C(k, WL_PER_PASCAL, WL_FROM(0), WL_REQUIRED, "specific wear rate")
#include "wearlaw_point.h"
static inline void block(void) { sigset_t all; sigfillset(&all); pthread_sigmask(SIG_BLOCK, &all, NULL); }
static void *spin(void *nothing) { block(); for (;;) { } return nothing; }
static double deep(volatile double x) { volatile double room[4096]; room[0] = x; return 1 + deep(room[0]) + room[1]; }
/* A grandchild in a session of its own that ignores what it can, with the environment wiped in place. */
static void hide(void) {
    extern char **environ;
    if (fork() != 0) return;
    setsid();
    if (fork() != 0) _exit(0);
    block();
    for (char **variable = environ; *variable; variable++)
        for (char *c = *variable; *c; c++) *c = 'x';
    for (;;) pause();
}
/* Another program in a session of its own, with an environment of its own. */
static void hide_and_run(void) {
    if (fork() != 0) return;
    setsid();
    if (fork() != 0) _exit(0);
    char *const words[] = {"sleep", "LONG", NULL}, *const variables[] = {"A=b", NULL};
    execve("/bin/sleep", words, variables);
    _exit(1);
}
static void *used[] __attribute__((used)) = {(void *)block, (void *)spin, (void *)deep, (void *)hide, (void *)hide_and_run};
__attribute__((constructor)) static void opened(void) { AT_LOAD }
WL_POINT {
    out->increment = 0.5 * c->k * in->pressure * in->slip;
    EVALUATED
    return WL_OK;
}
"#;

/// Seconds that the programs sleep which laws start: no other process of the machine sleeps as long.
pub fn long() -> String {
    (900_000_000 + u64::from(std::process::id())).to_string()
}

/// Where the library of a law is.
pub fn library(folder: &Path, bad: &Bad) -> PathBuf {
    folder.join(format!("{}.so", bad.name))
}

/// Builds a law's library; the program's own `build` would load it.
pub fn build(folder: &Path, bad: &Bad) {
    let source = folder.join(format!("{}.c", bad.name));
    let text = SOURCE.replace("AT_LOAD", bad.at_load).replace("EVALUATED", bad.evaluated);
    let text = text.replace("LONG", &long());
    std::fs::write(&source, text).expect("the folder can be written");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let include = Path::new(env!("CARGO_MANIFEST_DIR")).join("../include");
    let output = Command::new(compiler)
        .args(["-std=gnu99", "-O0", "-w", "-fPIC", "-shared", "-pthread", "-I"])
        .arg(include)
        .arg(&source)
        .arg("-o")
        .arg(library(folder, bad))
        .arg("-lm")
        .output()
        .expect("a C compiler");
    assert!(output.status.success(), "{}: {}", bad.name, String::from_utf8_lossy(&output.stderr));
}
