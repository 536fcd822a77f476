//! Descriptions and laws that the tests of this folder share.

use wearlaw_plugin_api::abi;

use super::descriptor::{Degree, LawDescriptor, Quantity};
use super::fields::{Claim, Claims, Field, Fields, Flags, OutputItem, OutputItems};
use super::memory::{MemoryInputs, MemoryLaw, MemoryOutputs};

/// A law of this name that declares nothing.
pub(super) fn plain(name: &str) -> LawDescriptor {
    LawDescriptor {
        name: name.to_owned(),
        version: "1.0".to_owned(),
        summary: "a law of the tests".to_owned(),
        source: String::new(),
        abi_minor: 0,
        reads: Fields::EMPTY,
        uses: Fields::EMPTY,
        writes: OutputItems::EMPTY,
        claims: Claims::EMPTY,
        flags: Flags::EMPTY,
        constants: Vec::new(),
        state: Vec::new(),
        inputs: Vec::new(),
        pressure_degree: Degree::Unclaimed,
    }
}

/// A quantity of this name that must be given and may be anything.
pub(super) fn constant(name: &str) -> Quantity {
    Quantity {
        name: name.to_owned(),
        summary: "a number of the tests".to_owned(),
        exponents: [0.0; 4],
        minimum: f64::NEG_INFINITY,
        maximum: f64::INFINITY,
        default: None,
        closes_units: false,
        above_minimum: false,
        below_maximum: false,
    }
}

/// Increment K p s; its state variable gathers the slip; direction opposite to the normal.
///
/// Told by `options`, it answers at points whose pressure is above 100 with a status or a number that it must not.
pub(super) struct Linear {
    trouble: String,
}

impl MemoryLaw for Linear {
    fn descriptor() -> LawDescriptor {
        LawDescriptor {
            reads: [Field::Pressure, Field::Slip].into_iter().collect(),
            uses: [Field::Normal, Field::PointId].into_iter().collect(),
            writes: OutputItem::ALL.iter().copied().collect(),
            claims: [Claim::NonNegative].into_iter().collect(),
            constants: vec![constant("K")],
            state: vec![constant("distance")],
            pressure_degree: Degree::Value(1.0),
            ..plain("linear")
        }
    }

    fn create(options: Option<&str>) -> Result<Self, String> {
        match options {
            Some("refuse") => Err("no such table".to_owned()),
            other => Ok(Self { trouble: other.unwrap_or_default().to_owned() }),
        }
    }

    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        let mut worst = abi::WL_OK;
        for point in 0..inputs.points() {
            let at = |field| inputs.scalar(field, point).unwrap_or(f64::NAN);
            let (pressure, slip) = (at(Field::Pressure), at(Field::Slip));
            let factor = inputs.constant(0, point).unwrap_or(f64::NAN);
            outputs.increment[point] = factor * pressure * slip;
            if let Some(state) = &mut outputs.state {
                state[point] = inputs.state(0, point).unwrap_or(f64::NAN) + slip;
            }
            if let Some(direction) = &mut outputs.direction {
                let normal = inputs.vector(Field::Normal, point).unwrap_or([0.0, 0.0, 1.0]);
                for (place, component) in direction[3 * point..].iter_mut().zip(normal) {
                    *place = -component;
                }
            }
            if let Some(d_pressure) = &mut outputs.d_pressure {
                d_pressure[point] = factor * slip;
            }
            let status = if pressure > 100.0 { self.trouble_at(point, outputs) } else { abi::WL_OK };
            if let Some(statuses) = &mut outputs.status {
                statuses[point] = status;
            }
            if status != abi::WL_OK && worst == abi::WL_OK {
                worst = status;
                outputs.text = format!("pressure {pressure}");
            }
        }
        worst
    }
}

impl Linear {
    fn trouble_at(&self, point: usize, outputs: &mut MemoryOutputs<'_>) -> i32 {
        match self.trouble.as_str() {
            "unreliable" => return abi::WL_UNRELIABLE,
            "cut" => outputs.dt_factor = 0.25,
            "missing" => outputs.missing = abi::WL_FIELD_TEMPERATURE | 1 << 40,
            "nan" => outputs.increment[point] = f64::NAN,
            "infinite" => outputs.increment[point] = f64::INFINITY,
            "negative" => outputs.increment[point] = -1.5,
            "long" => outputs.direction.iter_mut().for_each(|all| all[3 * point] = 2.0),
            "state" => outputs.state.iter_mut().for_each(|all| all[point] = f64::NAN),
            "derivative" => outputs.d_pressure.iter_mut().for_each(|all| all[point] = f64::NAN),
            "panic" => panic!("a law of the tests"),
            _ => {}
        }
        match self.trouble.as_str() {
            "cut" | "bad cut" => abi::WL_CUT_STEP,
            "domain" => abi::WL_OUT_OF_DOMAIN,
            "missing" => abi::WL_MISSING_INPUT,
            "failed" => abi::WL_FAILED,
            "unknown" => 77,
            _ => abi::WL_OK,
        }
    }
}
