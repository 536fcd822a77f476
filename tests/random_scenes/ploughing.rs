//! Wear at a slant to the normal, against the slip, as `plugins/example-rust` has it.

use wearlaw::law::memory::{MemoryInputs, MemoryLaw, MemoryOutputs};
use wearlaw::law::{Claim, Claims, Degree, Field, LawDescriptor, OutputItem};
use wearlaw_plugin_api::abi::WL_OK;

use crate::laws::RunningIn;

/// increment = K p slip along -(n + tilt s) / sqrt(1 + tilt^2), s the unit vector of the slip.
pub struct Ploughing;

impl MemoryLaw for Ploughing {
    fn descriptor() -> LawDescriptor {
        let other = RunningIn::descriptor();
        let mut constants = other.constants;
        constants.truncate(2);
        LawDescriptor {
            name: "ploughing".to_owned(),
            reads: [Field::Pressure, Field::Slip, Field::Normal, Field::SlipVector].into_iter().collect(),
            writes: [OutputItem::Direction].into_iter().collect(),
            claims: [Claim::NonNegative, Claim::LinearInDt].into_iter().collect::<Claims>(),
            pressure_degree: Degree::Value(1.0),
            constants,
            state: Vec::new(),
            ..other
        }
    }
    fn create(_: Option<&str>) -> Result<Self, String> {
        Ok(Self)
    }
    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        for i in 0..inputs.points() {
            let [k, tilt] = [0, 1].map(|c| inputs.constant(c, i).expect("two constants"));
            let read = |field| inputs.vector(field, i).expect("a field that is declared");
            let ([p, ..], [slip, ..], n, s) =
                (read(Field::Pressure), read(Field::Slip), read(Field::Normal), read(Field::SlipVector));
            outputs.increment[i] = k * p * slip;
            let Some(direction) = outputs.direction.as_mut() else { continue };
            let tilt = if slip > 0.0 { tilt } else { 0.0 };
            let length = (1.0 + tilt * tilt).sqrt();
            for axis in 0..3 {
                let along = if tilt > 0.0 { s[axis] / slip } else { 0.0 };
                direction[3 * i + axis] = -(n[axis] + tilt * along) / length;
            }
        }
        WL_OK
    }
}
