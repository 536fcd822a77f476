//! Laws of the tests: with a memory, with wishes, and of friction work.

use wearlaw::law::memory::{MemoryInputs, MemoryLaw, MemoryOutputs};
use wearlaw::law::{Claim, Claims, Degree, Field, Fields, Flags, LawDescriptor, OutputItem, OutputItems, Quantity};
use wearlaw_plugin_api::abi::{WL_CUT_STEP, WL_OK};

fn quantity(name: &str, default: Option<f64>) -> Quantity {
    Quantity {
        name: name.to_owned(),
        summary: "a number of the tests".to_owned(),
        exponents: [0.0; 4],
        minimum: f64::NEG_INFINITY,
        maximum: f64::INFINITY,
        default,
        closes_units: false,
        above_minimum: false,
        below_maximum: false,
    }
}

fn law(name: &str, reads: &[Field], claims: &[Claim], constants: &[&str], state: &[&str]) -> LawDescriptor {
    LawDescriptor {
        name: name.to_owned(),
        version: "1.0".to_owned(),
        summary: "a law of the tests".to_owned(),
        source: String::new(),
        abi_minor: 0,
        reads: reads.iter().copied().collect(),
        uses: Fields::EMPTY,
        writes: match state {
            [] => OutputItems::EMPTY,
            _ => [OutputItem::State].into_iter().collect(),
        },
        claims: claims.iter().copied().collect::<Claims>(),
        flags: Flags::EMPTY,
        constants: constants.iter().map(|name| quantity(name, None)).collect(),
        state: state.iter().map(|name| quantity(name, Some(0.0))).collect(),
        inputs: Vec::new(),
        pressure_degree: Degree::Unclaimed,
    }
}

fn take(inputs: &MemoryInputs<'_>, field: Field, point: usize) -> f64 {
    inputs.scalar(field, point).expect("a field that is declared")
}

/// Running in, K(x) = K_inf + (K_0 - K_inf) exp(-x / s_0), exact over a slip at constant pressure; state: distance x.
pub struct RunningIn;

impl MemoryLaw for RunningIn {
    fn descriptor() -> LawDescriptor {
        law("running-in", &[Field::Pressure, Field::Slip], &[Claim::NonNegative], &["k0", "kinf", "s0"], &["distance"])
    }
    fn create(_: Option<&str>) -> Result<Self, String> {
        Ok(Self)
    }
    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        let state = outputs.state.as_mut().expect("the state is written");
        for i in 0..inputs.points() {
            let [k0, kinf, s0] = [0, 1, 2].map(|c| inputs.constant(c, i).expect("three constants"));
            let (slip, x) = (take(inputs, Field::Slip, i), inputs.state(0, i).expect("one state variable"));
            let fresh = (k0 - kinf) * s0 * ((-x / s0).exp() - (-(x + slip) / s0).exp());
            outputs.increment[i] = take(inputs, Field::Pressure, i) * (kinf * slip + fresh);
            state[i] = x + slip;
        }
        WL_OK
    }
}

/// The same law as most people would write it: K where the substep begins, times the slip.
pub struct RunningInFirstOrder;

impl MemoryLaw for RunningInFirstOrder {
    fn descriptor() -> LawDescriptor {
        LawDescriptor { name: "running-in-first-order".to_owned(), ..RunningIn::descriptor() }
    }
    fn create(_: Option<&str>) -> Result<Self, String> {
        Ok(Self)
    }
    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        let state = outputs.state.as_mut().expect("the state is written");
        for i in 0..inputs.points() {
            let [k0, kinf, s0] = [0, 1, 2].map(|c| inputs.constant(c, i).expect("three constants"));
            let (slip, x) = (take(inputs, Field::Slip, i), inputs.state(0, i).expect("one state variable"));
            outputs.increment[i] = take(inputs, Field::Pressure, i) * (kinf + (k0 - kinf) * (-x / s0).exp()) * slip;
            state[i] = x + slip;
        }
        WL_OK
    }
}

/// K p v dt / (1 + w / d): the rate falls with the wear so far, w + w^2 / 2d = K p v t.
pub struct Slowing;

impl MemoryLaw for Slowing {
    fn descriptor() -> LawDescriptor {
        let reads = [Field::Pressure, Field::Slip, Field::AccumulatedWear];
        law("slowing", &reads, &[Claim::LinearInDt, Claim::NonNegative], &["k", "d"], &[])
    }
    fn create(_: Option<&str>) -> Result<Self, String> {
        Ok(Self)
    }
    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        for i in 0..inputs.points() {
            let [k, d] = [0, 1].map(|c| inputs.constant(c, i).expect("two constants"));
            let so_far = take(inputs, Field::AccumulatedWear, i);
            outputs.increment[i] =
                k * take(inputs, Field::Pressure, i) * take(inputs, Field::Slip, i) / (1.0 + so_far / d);
        }
        WL_OK
    }
}

/// k times the sliding distance so far times the slip: w = k x^2 / 2.
pub struct ByDistance;

impl MemoryLaw for ByDistance {
    fn descriptor() -> LawDescriptor {
        law("by-distance", &[Field::Slip, Field::AccumulatedSlip], &[Claim::NonNegative], &["k"], &[])
    }
    fn create(_: Option<&str>) -> Result<Self, String> {
        Ok(Self)
    }
    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        for i in 0..inputs.points() {
            let (slip, so_far) = (take(inputs, Field::Slip, i), take(inputs, Field::AccumulatedSlip, i));
            outputs.increment[i] = inputs.constant(0, i).expect("one constant") * (so_far + 0.5 * slip) * slip;
        }
        WL_OK
    }
}

/// alpha times the friction work, a rate.
pub struct Work;

impl MemoryLaw for Work {
    fn descriptor() -> LawDescriptor {
        law("work", &[Field::FrictionWork], &[Claim::LinearInDt, Claim::NonNegative], &["alpha"], &[])
    }
    fn create(_: Option<&str>) -> Result<Self, String> {
        Ok(Self)
    }
    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        for i in 0..inputs.points() {
            let alpha = inputs.constant(0, i).expect("one constant");
            outputs.increment[i] = alpha * take(inputs, Field::FrictionWork, i);
        }
        WL_OK
    }
}

impl Work {
    /// A law of one constant that reads these fields, to be made into another.
    #[allow(dead_code)] // not every test target makes other laws
    pub fn descriptor_with(reads: &[Field]) -> LawDescriptor {
        law("other", reads, &[], &["k"], &[])
    }
}

/// k p s that wants no substep longer than `longest`.
pub struct Impatient;

impl Impatient {
    fn answer(inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        let (dt, longest) = (inputs.view().dt, inputs.constant(1, 0).expect("two constants"));
        if dt > longest * (1.0 + 1e-9) {
            outputs.dt_factor = (0.99 * longest / dt).min(0.5);
            return WL_CUT_STEP;
        }
        for i in 0..inputs.points() {
            let k = inputs.constant(0, i).expect("two constants");
            outputs.increment[i] = k * take(inputs, Field::Pressure, i) * take(inputs, Field::Slip, i);
        }
        WL_OK
    }
}

impl MemoryLaw for Impatient {
    fn descriptor() -> LawDescriptor {
        law("impatient", &[Field::Pressure, Field::Slip], &[Claim::NonNegative], &["k", "longest"], &[])
    }
    fn create(_: Option<&str>) -> Result<Self, String> {
        Ok(Self)
    }
    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        Self::answer(inputs, outputs)
    }
}

/// The same as a rate.
pub struct ImpatientRate;

impl MemoryLaw for ImpatientRate {
    fn descriptor() -> LawDescriptor {
        let claims = [Claim::NonNegative, Claim::LinearInDt];
        law("impatient-rate", &[Field::Pressure, Field::Slip], &claims, &["k", "longest"], &[])
    }
    fn create(_: Option<&str>) -> Result<Self, String> {
        Ok(Self)
    }
    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        Impatient::answer(inputs, outputs)
    }
}
