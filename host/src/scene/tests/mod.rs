//! Tests of the scene as a whole.

mod mistakes;

use super::{Override, Scene, SceneError};

/// The smallest prescribed scene.
const PRESCRIBED: &str = "\
[law]
use = \"archard\"
constants = { K = 1e-4, H = 2e3 }

[contact]
model = \"prescribed\"

[[step]]
duration = 1.0
pressure = 50.0
velocity = 0.2
";

fn parse(text: &str) -> Result<Scene, SceneError> {
    Scene::parse(text, "dir/scene.toml", &[])
}

fn set(text: &str, overrides: &[&str]) -> Result<Scene, SceneError> {
    let overrides: Vec<Override> = overrides.iter().map(|&text| text.into()).collect();
    Scene::parse(text, "dir/scene.toml", &overrides)
}
