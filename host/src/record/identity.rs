//! What has to be the same for a run to go on from a checkpoint.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Keys that may differ, with everything under them: they change nothing of what is computed, or only when it ends. What
/// a file holds is compared by its contents and not by its name.
const FREE: [&str; 12] = [
    "title",
    "stop",
    "reference",
    "output.checkpoint",
    "output.error_estimate",
    "output.times",
    "law.use",
    "law.apdl",
    "law.sha256",
    "law.share",
    "contact.history",
    "surface.file",
];

/// The law of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LawIdentity {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// SHA-256 of its library; `None` for a law of the program.
    pub sha256: Option<String>,
}

/// What a run is a run of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    /// Version of the program.
    pub program: String,
    /// The law.
    pub law: LawIdentity,
    /// The scene as it was resolved.
    pub scene: Value,
    /// SHA-256 of what stands behind names of files, by what it is.
    pub contents: BTreeMap<String, String>,
    /// The processor's instructions that transforms are made with; empty where there are none. With others the last digits
    /// may differ, which does not make it another run.
    #[serde(default)]
    pub instructions: String,
}

/// Why a run cannot go on from a checkpoint of another run.
#[derive(Debug, thiserror::Error)]
pub enum Difference {
    /// A version whose numbers may differ.
    #[error(
        "the checkpoint was written by version {found} of the program, expected one of the same major version as {expected}"
    )]
    Program {
        /// Version that wrote it.
        found: String,
        /// This version.
        expected: String,
    },
    /// Another law.
    #[error("the checkpoint is of a run with law {found}, expected {expected}")]
    Law {
        /// The law of the checkpoint.
        found: String,
        /// The law in use.
        expected: String,
    },
    /// A key of the scene.
    #[error(
        "the checkpoint is of a run with `{key}` = {found}, the scene has {expected}; expected the same scene, but that its \
         last step may be longer and more steps or cycles may follow"
    )]
    Scene {
        /// The key.
        key: String,
        /// What it was.
        found: String,
        /// What it is.
        expected: String,
    },
    /// A step that becomes longer and ramps.
    #[error(
        "`{key}` was {found} and is {expected}, but the step ramps, so that what was done already would have been another; \
         expected a further step instead"
    )]
    Ramp {
        /// The key of the duration.
        key: String,
        /// What it was.
        found: String,
        /// What it is.
        expected: String,
    },
    /// Another file.
    #[error("the checkpoint is of a run with another content of {what}, expected the same")]
    Content {
        /// What the content is.
        what: String,
    },
}

impl Identity {
    /// Checks that a run of `self` may go on from a checkpoint of `earlier` that is at represented time `time`.
    ///
    /// The same scene may be longer at its end: the last step by its `duration` (unless it ramps), the last cycle by its
    /// `count`, and more steps and cycles may follow. The keys of titles, stops, references, checkpoints and shares are
    /// free, and so are times of output that are still to come.
    ///
    /// # Errors
    /// The first difference.
    pub fn follows(&self, earlier: &Identity, time: f64) -> Result<(), Difference> {
        let major = |version: &str| version.split('.').next().unwrap_or_default().to_owned();
        if major(&self.program) != major(&earlier.program) {
            return Err(Difference::Program { found: earlier.program.clone(), expected: self.program.clone() });
        }
        if self.law != earlier.law {
            return Err(Difference::Law { found: earlier.law.to_string(), expected: self.law.to_string() });
        }
        same_keys("", &earlier.scene, &self.scene)?;
        later_steps(&earlier.scene, &self.scene)?;
        output_times(&earlier.scene, &self.scene, time)?;
        match earlier.contents.iter().find(|(what, hash)| self.contents.get(*what) != Some(hash)) {
            Some((what, _)) => Err(Difference::Content { what: what.clone() }),
            None => Ok(()),
        }
    }
}

impl std::fmt::Display for LawIdentity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "`{}` {}", self.name, self.version)?;
        self.sha256.as_ref().map_or(Ok(()), |hash| write!(f, " (sha256 {hash})"))
    }
}

fn differs(key: &str, found: &Value, expected: &Value) -> Difference {
    let text = |value: &Value| if value.is_null() { "nothing".to_owned() } else { value.to_string() };
    Difference::Scene { key: key.to_owned(), found: text(found), expected: text(expected) }
}

/// Compares all keys but the free ones, `step` and `cycle`.
fn same_keys(key: &str, found: &Value, expected: &Value) -> Result<(), Difference> {
    let below = |name: &str| if key.is_empty() { name.to_owned() } else { format!("{key}.{name}") };
    match (found, expected) {
        (Value::Object(a), Value::Object(b)) => {
            let mut names: Vec<&String> = a.keys().chain(b.keys()).collect();
            names.sort();
            names.dedup();
            for name in names {
                let key = below(name);
                if FREE.contains(&key.as_str()) || key == "step" || key == "cycle" {
                    continue;
                }
                let of = |map: &serde_json::Map<String, Value>| map.get(name).cloned().unwrap_or(Value::Null);
                same_keys(&key, &of(a), &of(b))?;
            }
            Ok(())
        }
        _ if found == expected => Ok(()),
        _ => Err(differs(key, found, expected)),
    }
}

fn list<'v>(scene: &'v Value, key: &str) -> &'v [Value] {
    scene.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// The loading so far is the beginning of the new one.
fn later_steps(found: &Value, expected: &Value) -> Result<(), Difference> {
    let (steps, cycles) = (list(found, "step"), list(found, "cycle"));
    longer("step", steps, list(expected, "step"), cycles.is_empty(), &["duration"])?;
    longer("cycle", cycles, list(expected, "cycle"), true, &["count"])
}

/// Compares a list with one that may go on after it, the last of its elements having a larger number at `key`.
fn longer(name: &str, found: &[Value], expected: &[Value], open: bool, keys: &[&str]) -> Result<(), Difference> {
    if expected.len() < found.len() || (!open && expected.len() > found.len()) {
        return Err(differs(name, &found.len().into(), &expected.len().into()));
    }
    for (index, (a, b)) in found.iter().zip(expected).enumerate() {
        let key = format!("{name}.{index}");
        if a == b {
            continue;
        }
        if !open || index + 1 < found.len() {
            return Err(first_difference(&key, a, b));
        }
        let (mut rest_a, mut rest_b) = (a.clone(), b.clone());
        for name in keys {
            let (old, new) = (a.get(*name), b.get(*name));
            let larger = old.and_then(Value::as_f64).zip(new.and_then(Value::as_f64)).is_some_and(|(a, b)| b > a);
            if larger {
                let ramps = a.get("ramp").and_then(Value::as_array).is_some_and(|ramps| !ramps.is_empty());
                if ramps {
                    let text = |value: Option<&Value>| value.map(Value::to_string).unwrap_or_default();
                    let key = format!("{key}.{name}");
                    return Err(Difference::Ramp { key, found: text(old), expected: text(new) });
                }
                [&mut rest_a, &mut rest_b].into_iter().filter_map(Value::as_object_mut).for_each(|map| {
                    map.remove(*name);
                });
            }
        }
        if rest_a != rest_b {
            return Err(first_difference(&key, &rest_a, &rest_b));
        }
    }
    Ok(())
}

fn first_difference(key: &str, a: &Value, b: &Value) -> Difference {
    same_keys(key, a, b).err().unwrap_or_else(|| differs(key, a, b))
}

/// Times of output that have passed are the same; those to come are free.
fn output_times(found: &Value, expected: &Value, time: f64) -> Result<(), Difference> {
    let of = |scene: &Value| scene.get("output").and_then(|output| output.get("times")).cloned();
    let (a, b) = (of(found), of(expected));
    if a.is_none() && b.is_none() {
        return Ok(());
    }
    let past = |times: &Option<Value>| -> Vec<Value> {
        let all = times.as_ref().and_then(Value::as_array).cloned().unwrap_or_default();
        all.into_iter().filter(|at| at.as_f64().is_some_and(|at| at <= time)).collect()
    };
    let (a, b) = (past(&a), past(&b));
    if a == b { Ok(()) } else { Err(differs("output.times", &a.into(), &b.into())) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn identity(scene: Value) -> Identity {
        Identity {
            program: "1.2.3".to_owned(),
            law: LawIdentity { name: "archard".to_owned(), version: "1.0".to_owned(), sha256: None },
            scene,
            contents: [("the history".to_owned(), "aa".to_owned())].into(),
            instructions: "avx2".to_owned(),
        }
    }

    fn scene() -> Value {
        json!({
            "title": "a", "law": { "use": "archard", "constants": { "K": 1e-4 } },
            "output": { "fields": ["wear"], "times": [1.0, 5.0] },
            "step": [{ "duration": 1.0, "load": 2.0 }, { "duration": 3.0, "load": 4.0, "ramp": [] }],
        })
    }

    #[track_caller]
    fn refused(change: impl FnOnce(&mut Value), words: &str) {
        let earlier = identity(scene());
        let mut later = identity(scene());
        change(&mut later.scene);
        let text = later.follows(&earlier, 2.0).unwrap_err().to_string();
        assert!(text.contains(words), "{text}");
    }

    #[track_caller]
    fn allowed(change: impl FnOnce(&mut Value)) {
        let earlier = identity(scene());
        let mut later = identity(scene());
        change(&mut later.scene);
        later.follows(&earlier, 2.0).unwrap();
    }

    #[test]
    fn a_scene_may_go_on_but_not_change() {
        allowed(|_| {});
        allowed(|scene| scene["title"] = json!("b"));
        allowed(|scene| scene["step"][1]["duration"] = json!(4.0));
        allowed(|scene| scene["step"].as_array_mut().unwrap().push(json!({ "duration": 1.0 })));
        allowed(|scene| scene["cycle"] = json!([{ "count": 3, "step": [] }]));
        allowed(|scene| scene["output"]["times"] = json!([1.0, 7.0, 9.0]));
        refused(
            |scene| scene["law"]["constants"]["K"] = json!(2e-4),
            "`law.constants.K` = 0.0001, the scene has 0.0002",
        );
        refused(|scene| scene["step"][0]["duration"] = json!(2.0), "`step.0.duration` = 1.0, the scene has 2.0");
        refused(|scene| scene["step"][1]["duration"] = json!(2.0), "`step.1.duration`");
        refused(|scene| scene["step"][1]["load"] = json!(5.0), "`step.1.load`");
        refused(|scene| scene["step"] = json!([{ "duration": 1.0, "load": 2.0 }]), "`step` = 2, the scene has 1");
        refused(|scene| scene["output"]["times"] = json!([0.5, 1.0]), "`output.times`");
        refused(|scene| scene["output"]["fields"] = json!([]), "`output.fields`");
    }

    #[test]
    fn a_ramp_is_not_stretched_and_cycles_close_the_steps_before_them() {
        let mut earlier = identity(scene());
        earlier.scene["step"][1]["ramp"] = json!(["load"]);
        let mut later = earlier.clone();
        later.scene["step"][1]["duration"] = json!(4.0);
        let text = later.follows(&earlier, 2.0).unwrap_err().to_string();
        assert!(text.contains("`step.1.duration` was 3.0 and is 4.0, but the step ramps"), "{text}");
        earlier.scene["cycle"] = json!([{ "count": 3, "step": [{ "duration": 1.0 }] }]);
        later = earlier.clone();
        later.scene["cycle"][0]["count"] = json!(5);
        later.follows(&earlier, 2.0).unwrap();
        later.scene["cycle"][0]["step"][0]["duration"] = json!(2.0);
        assert!(later.follows(&earlier, 2.0).unwrap_err().to_string().contains("`cycle.0.step`"));
        later = earlier.clone();
        later.scene["step"].as_array_mut().unwrap().push(json!({ "duration": 1.0 }));
        assert!(later.follows(&earlier, 2.0).unwrap_err().to_string().contains("`step` = 2"));
    }

    #[test]
    fn another_law_program_or_file_is_told() {
        let earlier = identity(scene());
        let mut later = identity(scene());
        later.program = "1.9.0".to_owned();
        later.follows(&earlier, 0.0).unwrap();
        later.program = "2.0.0".to_owned();
        assert!(later.follows(&earlier, 0.0).unwrap_err().to_string().contains("major version as 2.0.0"));
        later = identity(scene());
        later.law.sha256 = Some("bb".to_owned());
        assert!(later.follows(&earlier, 0.0).unwrap_err().to_string().contains("expected `archard` 1.0 (sha256 bb)"));
        later = identity(scene());
        later.contents.insert("the history".to_owned(), "cc".to_owned());
        assert!(later.follows(&earlier, 0.0).unwrap_err().to_string().contains("content of the history"));
    }
}
