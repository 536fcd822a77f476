//! `report.json`: everything about a run in one document.

use std::io::Write;
use std::path::Path;

use serde::Serialize;
use serde_json::{Value, json};

use super::{OutputError, write_file};
use crate::record::{Cost, HistoryRow, MemoryLine};

/// The law of a run.
#[derive(Clone, Debug, Serialize)]
pub struct LawReport {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// The file or name that it came from.
    pub path: String,
    /// SHA-256 of its library; `None` for a law of the program.
    pub sha256: Option<String>,
    /// Whether it ran in a process of its own.
    pub isolated: bool,
    /// Its constants, defaults included; `None` where they change with time or temperature.
    pub constants: Option<std::collections::BTreeMap<String, f64>>,
    /// Wall time of compiling it; s. `None` where nothing was compiled.
    pub build_time_s: Option<f64>,
}

/// Stability of a run.
#[derive(Clone, Debug, Serialize)]
pub struct StabilityReport {
    /// Largest eigenvalue of the linearised problem; 1/s. `None`: not measured.
    pub stiffness_per_s: Option<f64>,
    /// Largest stable explicit step; `None`: there is none.
    pub explicit_limit_s: Option<f64>,
    /// Largest accepted step.
    pub largest_step_s: f64,
    /// In words.
    pub verdict: String,
}

/// Everything that a report is made of.
#[derive(Clone, Debug)]
pub struct Report {
    /// The scene as it was resolved.
    pub scene: Value,
    /// The law.
    pub law: LawReport,
    /// The processor's instructions that transforms are made with, on which their last bits depend.
    pub instructions: String,
    /// What was computed, a line each.
    pub computed: Vec<String>,
    /// What was left out, and why.
    pub skipped: Value,
    /// Planned memory.
    pub memory: Vec<MemoryLine>,
    /// Quantities at the end.
    pub last: HistoryRow,
    /// Shares of the wear of the two bodies.
    pub share: Option<[f64; 2]>,
    /// The error with its norm; null where it is not known.
    pub error: Value,
    /// What it cost.
    pub cost: Cost,
    /// Stability.
    pub stability: StabilityReport,
    /// Things to know.
    pub warnings: Vec<String>,
    /// How the run ended: "done", or why it ended early.
    pub ended: String,
}

impl Report {
    /// The document.
    pub fn document(&self) -> Value {
        let planned: u64 = self.memory.iter().map(|line| line.bytes).sum();
        let mut result = json!({
            "time": self.last.time,
            "sliding_distance": self.last.sliding_distance,
            "load": self.last.load,
            "approach": self.last.approach,
            "max_pressure": self.last.max_pressure,
            "contact_area": self.last.contact_area,
            "max_wear_depth": self.last.max_wear_depth,
            "wear_volume": self.last.wear_volume,
        });
        if let Some(share) = self.share {
            let body = |part: f64| {
                json!({
                    "share": part,
                    "max_wear_depth": part * self.last.max_wear_depth,
                    "wear_volume": self.last.wear_volume.map(|volume| part * volume),
                })
            };
            result["wearing_body"] = body(share[0]);
            result["counterbody"] = body(share[1]);
        }
        json!({
            "wearlaw": env!("CARGO_PKG_VERSION"),
            "ended": self.ended,
            "scene": self.scene,
            "law": self.law,
            "instructions": self.instructions,
            "plan": {
                "computed": self.computed,
                "skipped": self.skipped,
                "memory": self.memory,
                "memory_bytes": planned,
            },
            "result": result,
            "error": self.error,
            "cost": self.cost,
            "stability": self.stability,
            "warnings": self.warnings,
        })
    }

    /// Writes the document.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let document = self.document();
        write_file(path, |to| {
            to.write_all(&serde_json::to_vec_pretty(&document)?)?;
            to.write_all(b"\n")
        })
    }
}
