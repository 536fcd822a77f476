//! Wear on contact that answers back against numbers that are known, through the library.

#[path = "right_answers/invariance.rs"]
mod invariance;
#[path = "right_answers/references.rs"]
mod references;
#[path = "right_answers/scars.rs"]
mod scars;
#[path = "support/solved.rs"]
mod solved;
#[path = "right_answers/springs.rs"]
mod springs;
#[path = "right_answers/stick.rs"]
mod stick;
#[path = "right_answers/waves.rs"]
mod waves;

use solved::{Case, Solved, archard};

/// Runs a scene with `archard` to its end.
#[track_caller]
fn run(scene: &str) -> Solved {
    Case::text(scene).solve(&archard())
}

/// A norm of the error, or its value.
#[track_caller]
fn norm(solved: &Solved, name: &str) -> f64 {
    let error = solved.error.as_ref().expect("the scene names a reference");
    if name == "value" { error.value } else { error.by_field[name] }
}
