//! Tests of the scene as a whole.

mod mistakes;
mod mistakes_solved;
mod overrides;
mod random;
mod whole;

use super::{Override, Scene, SceneError};

/// The smallest prescribed scene.
const PRESCRIBED: &str = r#"[law]
use = "archard"
constants = { K = 1e-4, H = 2e3 }

[contact]
model = "prescribed"

[[step]]
duration = 1.0
pressure = 50.0
velocity = 0.2
"#;

/// A half-space scene in 3-D.
const HALF_SPACE: &str = r#"[law]
use = "archard"
[contact]
model = "halfspace"
modulus = 1e11
[grid]
size = [1e-3, 1e-3]
cells = [64, 64]
[surface]
shape = "sphere"
radius = 5e-3
[[step]]
duration = 1.0
load = 10.0
"#;

fn parse(text: &str) -> Result<Scene, SceneError> {
    Scene::parse(text, "dir/scene.toml", &[])
}

fn set(text: &str, overrides: &[&str]) -> Result<Scene, SceneError> {
    let overrides: Vec<Override> = overrides.iter().map(|&text| text.into()).collect();
    Scene::parse(text, "dir/scene.toml", &overrides)
}

/// Replaces `from` by `to` once in `base` and holds the error to a message and a place.
#[track_caller]
fn refused(base: &str, from: &str, to: &str, message: &str, line: usize, column: usize) {
    assert!(base.contains(from), "nothing to replace: {from}");
    let text = base.replacen(from, to, 1);
    let error = match parse(&text) {
        Ok(_) => panic!("accepted {to:?}"),
        Err(error) => error,
    };
    let found = error.to_string();
    assert!(found.contains(message), "{found:?} lacks {message:?}");
    let location = error.location.as_ref().expect("a place");
    assert_eq!((location.line(), location.column()), (line, column), "{found}");
    assert!(found.contains(&format!("dir/scene.toml:{line}:{column}")), "{found:?} lacks its place");
    assert!(!found.contains('\n'), "{found:?} is more than one line");
    let rendered = error.render(false);
    assert!(rendered.contains(text.lines().nth(line - 1).unwrap_or("").trim_end()), "{rendered} lacks its line");
    assert!(rendered.contains('^'), "{rendered} underlines nothing");
}

/// A case a line: what is replaced => by what (`\n` is a new line) => the message => line:column.
#[track_caller]
fn refused_each(base: &str, cases: &str) {
    for case in cases.lines().map(str::trim).filter(|case| !case.is_empty()) {
        let parts: Vec<&str> = case.split(" => ").collect();
        let [from, to, message, place] = parts.as_slice() else { panic!("{case}") };
        let (line, column) = place.split_once(':').expect(case);
        let lines = |text: &str| text.replace("\\n", "\n");
        refused(base, &lines(from), &lines(to), message, line.parse().expect(case), column.parse().expect(case));
    }
}
