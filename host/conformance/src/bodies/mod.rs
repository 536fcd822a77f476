//! What each check does with a law, in the worker; a file for each group or large check.
//!
//! A body opens the library itself, so that nothing of the law has run before. It gives a verdict; that the law may end
//! the process meanwhile is the checker's business.

mod batch;
mod bench;
mod cost;
mod derivative;
mod descriptor;
mod determinism;
mod expected;
mod extremes;
mod faults;
mod float;
mod leaks;
mod load;
mod memory;
mod options;
mod physics;
mod spread;
mod state;
mod statuses;
mod structs;
mod temperature;
mod threads;
mod units;
mod values;

pub(super) use bench::Bench;
pub(super) use faults::ORDINARY;

use super::check::Check;
use super::message::Judged;

/// Runs the body of a check.
pub(super) fn run(check: Check, bench: &Bench) -> Judged {
    match check {
        Check::LoadSymbols => load::symbols(bench),
        Check::LoadOpens => load::opens(bench),
        Check::LoadTwice => load::twice(bench),
        Check::LoadSilent => load::silent(bench),
        Check::LoadWorkingDirectory => load::working_directory(bench),
        Check::LoadLocale => load::locale(bench),
        Check::LoadSignals => load::signals(bench),
        Check::LoadThreads => load::threads(bench),
        Check::LoadEnvironment => load::environment(bench),
        Check::FloatLoad => float::load(bench),
        Check::FloatThread => float::thread(bench),
        Check::FloatCreate => float::create(bench),
        Check::FloatEvaluate => float::evaluate(bench),
        Check::FloatDestroy => float::destroy(bench),
        Check::FloatNan => extremes::nan(bench),
        Check::FaultsException
        | Check::FaultsExit
        | Check::FaultsAbort
        | Check::FaultsHang
        | Check::FaultsStack
        | Check::FaultsSignal => faults::provoke(bench),
        Check::FaultsCreate => faults::create(bench),
        Check::DescriptorNames => descriptor::names(bench),
        Check::DescriptorUnits => descriptor::units(bench),
        Check::DescriptorBounds => descriptor::bounds(bench),
        Check::DescriptorDefaults => descriptor::defaults(bench),
        Check::DescriptorFields => descriptor::fields(bench),
        Check::DescriptorClaims => descriptor::claims(bench),
        Check::DescriptorEnd => descriptor::end(bench),
        Check::DescriptorSmaller => structs::smaller(bench),
        Check::DescriptorLarger => structs::larger(bench),
        Check::DescriptorExtension => descriptor::extension(bench),
        Check::DescriptorText => structs::text(bench),
        Check::ValuesExpected => expected::expected(bench),
        Check::ValuesFinite => values::finite(bench),
        Check::ValuesZeroPressure => values::zero_pressure(bench),
        Check::ValuesZeroSlip => values::zero_slip(bench),
        Check::ValuesZeroDt => values::zero_dt(bench),
        Check::ValuesNegativePressure => values::negative_pressure(bench),
        Check::ValuesExtremes => extremes::extremes(bench),
        Check::ValuesBounds => extremes::bounds(bench),
        Check::DeterminismRepeat => determinism::repeat(bench),
        Check::DeterminismThread => determinism::thread(bench),
        Check::DeterminismProcess => determinism::process(bench),
        Check::DeterminismRecreate => determinism::recreate(bench),
        Check::ThreadsInterleaved => threads::interleaved(bench),
        Check::ThreadsConcurrent => threads::concurrent(bench),
        Check::BatchSingles => batch::singles(bench),
        Check::BatchShuffled => batch::shuffled(bench),
        Check::BatchRanges => batch::ranges(bench),
        Check::BatchEmpty => batch::empty(bench),
        Check::BatchOdd => batch::odd(bench),
        Check::BatchLarge => batch::large(bench),
        Check::BatchUniformFields => spread::uniform_fields(bench),
        Check::BatchStridedFields => spread::strided_fields(bench),
        Check::BatchPerPointConstants => spread::per_point_constants(bench),
        Check::BatchStridedConstants => spread::strided_constants(bench),
        Check::BatchMixed => spread::mixed(bench),
        Check::BatchStatus => statuses::status_array(bench),
        Check::MemoryAfter => memory::after(bench),
        Check::MemoryBefore => memory::before(bench),
        Check::MemoryInputs => memory::inputs(bench),
        Check::MemoryUnwritten => memory::unwritten(bench),
        Check::MemoryUndeclared => memory::undeclared(bench),
        Check::MemoryUses => memory::uses(bench),
        Check::MemoryOutputs => memory::outputs(bench),
        Check::MemoryCalls => leaks::calls(bench),
        Check::MemoryInstances => leaks::instances(bench),
        Check::StateStart => state::start(bench),
        Check::StateEnd => state::end(bench),
        Check::StateAgain => state::again(bench),
        Check::StateRestart => state::restart(bench),
        Check::DerivativePressure => derivative::pressure(bench),
        Check::DerivativeKinks => derivative::kinks(bench),
        Check::DerivativeAsked => derivative::asked(bench),
        Check::PhysicsNonNegative => physics::non_negative(bench),
        Check::PhysicsZeroWithoutPressure => physics::zero_without_pressure(bench),
        Check::PhysicsZeroWithoutSlip => physics::zero_without_slip(bench),
        Check::PhysicsLinearInDt => physics::linear_in_dt(bench),
        Check::PhysicsPressureDegree => physics::pressure_degree(bench),
        Check::PhysicsFrame => physics::frame(bench),
        Check::PhysicsDirectionLength => physics::direction_length(bench),
        Check::PhysicsDirectionInward => physics::direction_inward(bench),
        Check::PhysicsUnits => units::units(bench),
        Check::PhysicsTemperatureScale => temperature::scale(bench),
        Check::CostPerPoint => cost::per_point(bench),
        Check::CostSubnormals => cost::subnormals(bench),
    }
}
