//! A wear coefficient that grows with the temperature.

use wearlaw::law::memory::{MemoryInputs, MemoryLaw, MemoryOutputs};
use wearlaw::law::{Claim, Degree, Field, LawDescriptor};
use wearlaw_plugin_api::abi::WL_OK;

use crate::laws::RunningIn;

/// increment = K (1 + a T) p slip.
pub struct Warm;

impl MemoryLaw for Warm {
    fn descriptor() -> LawDescriptor {
        let other = RunningIn::descriptor();
        let mut constants = other.constants;
        constants.truncate(2);
        LawDescriptor {
            name: "warm".to_owned(),
            reads: [Field::Pressure, Field::Slip, Field::Temperature].into_iter().collect(),
            claims: [Claim::NonNegative, Claim::LinearInDt].into_iter().collect(),
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
            let [k, a] = [0, 1].map(|c| inputs.constant(c, i).expect("two constants"));
            let [p, slip, warmth] = [Field::Pressure, Field::Slip, Field::Temperature]
                .map(|field| inputs.vector(field, i).expect("a field that is declared")[0]);
            outputs.increment[i] = k * (1.0 + a * warmth) * p * slip;
        }
        WL_OK
    }
}
