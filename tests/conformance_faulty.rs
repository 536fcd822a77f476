//! `wearlaw check` against laws that are bad in exactly one way, and against good laws that look suspicious.
//!
//! Every faulty law of `plugins/faulty` is first shown to be bad by a host in plain C, then has to fail its own check and
//! no other. Without `WEARLAW_FAULTY=all` the whole tester meets a seeded part of the laws only (`WEARLAW_FAULTY_SEED`).
#![cfg(target_os = "linux")]

#[path = "conformance_faulty/diagonal.rs"]
mod diagonal;
#[path = "conformance_faulty/every_run.rs"]
mod every_run;
#[path = "conformance_faulty/fixtures.rs"]
mod fixtures;
#[path = "conformance_faulty/hardening.rs"]
mod hardening;
#[path = "support/bad_runs.rs"]
mod program;
#[path = "conformance_faulty/proof.rs"]
mod proof;
#[path = "support/random.rs"]
mod random;
