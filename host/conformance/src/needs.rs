//! Which checks say nothing once another has failed: a law that aborts on load fails one check and blocks the rest.

use super::check::{Check, Group};

/// What every call of a law rests on.
const CALLED: [Check; 7] = [
    Check::LoadOpens,
    Check::DescriptorNames,
    Check::DescriptorUnits,
    Check::DescriptorBounds,
    Check::DescriptorDefaults,
    Check::DescriptorFields,
    Check::DescriptorClaims,
];

/// The six that are judged by one run of the law: it comes back, whatever the input.
pub(super) const FAULTS: [Check; 6] = [
    Check::FaultsException,
    Check::FaultsExit,
    Check::FaultsAbort,
    Check::FaultsHang,
    Check::FaultsStack,
    Check::FaultsSignal,
];

/// What every look at an answer rests on: the law touches the arrays that it should, and no others.
const ARRAYS: [Check; 5] =
    [Check::MemoryOutputs, Check::MemoryAfter, Check::MemoryBefore, Check::MemoryInputs, Check::MemoryUnwritten];

/// The checks that must not have failed for this one to say anything; they are done before it.
pub(super) fn needs(check: Check) -> Vec<Check> {
    let mut needed: Vec<Check> = Vec::new();
    match check {
        Check::LoadSymbols => {}
        Check::LoadOpens => needed.push(Check::LoadSymbols),
        _ => needed.push(Check::LoadOpens),
    }
    if calls(check) {
        needed.extend(CALLED);
    }
    if evaluates(check) {
        needed.extend(FAULTS);
    }
    if looks_at_answers(check) {
        needed.extend(ARRAYS);
    }
    if compares(check) {
        needed.push(Check::DeterminismRepeat);
    }
    needed.extend_from_slice(after(check));
    needed.sort_unstable();
    needed.dedup();
    needed
}

/// True for a check that needs a law with a sound description.
fn calls(check: Check) -> bool {
    match check.facts().group {
        // What is malformed is loaded and unloaded all the same.
        Group::Load => false,
        Group::Descriptor => matches!(
            check,
            Check::DescriptorSmaller | Check::DescriptorLarger | Check::DescriptorText | Check::DescriptorEnd
        ),
        _ => check != Check::FloatLoad,
    }
}

/// True for a check that needs a law that comes back.
fn evaluates(check: Check) -> bool {
    match check.facts().group {
        Group::Load => !matches!(check, Check::LoadSymbols | Check::LoadOpens),
        Group::Faults => check == Check::FaultsCreate,
        Group::Descriptor => calls(check) && check != Check::DescriptorEnd,
        _ => check != Check::FloatLoad,
    }
}

/// True for a check that looks at what the law answers.
fn looks_at_answers(check: Check) -> bool {
    match check.facts().group {
        Group::Load | Group::Faults => false,
        Group::Float => check == Check::FloatNan,
        Group::Descriptor => evaluates(check),
        Group::Memory => !ARRAYS.contains(&check),
        _ => true,
    }
}

/// True for a check that compares answers, or looks for inputs that are answered well.
fn compares(check: Check) -> bool {
    looks_at_answers(check) && !matches!(check, Check::DeterminismRepeat | Check::FloatNan | Check::DescriptorText)
}

/// Needs of single checks: the simpler one says it already.
fn after(check: Check) -> &'static [Check] {
    use Check::*;
    match check {
        LoadTwice => &[LoadThreads],
        LoadSilent => &[LoadThreads, LoadTwice, FaultsCreate],
        LoadWorkingDirectory | LoadLocale | LoadSignals | LoadEnvironment => &[LoadThreads, LoadTwice],
        FloatCreate | DescriptorText | DeterminismRecreate => &[FaultsCreate],
        FloatThread => &[FloatLoad, FloatEvaluate, FloatCreate, FloatDestroy],
        MemoryAfter | MemoryUnwritten => &[MemoryOutputs],
        MemoryBefore => &[MemoryOutputs, MemoryAfter],
        MemoryInputs => &[MemoryOutputs, MemoryAfter, MemoryBefore],
        MemoryUses => &[MemoryUndeclared],
        MemoryInstances => &[MemoryCalls, LoadThreads, FaultsCreate],
        ValuesExpected => &[DescriptorExtension, MemoryUndeclared],
        ValuesExtremes => &[ValuesFinite, ValuesZeroPressure, ValuesZeroSlip, ValuesZeroDt, ValuesNegativePressure],
        ValuesBounds => &[ValuesExtremes, ThreadsInterleaved],
        DeterminismProcess => &[DeterminismRecreate],
        ThreadsInterleaved => &[DeterminismProcess, DeterminismRecreate],
        ThreadsConcurrent => &[ThreadsInterleaved, DeterminismThread, StateStart],
        BatchShuffled | BatchOdd | BatchStatus => &[BatchSingles],
        BatchRanges => &[BatchSingles, BatchOdd],
        BatchLarge => &[BatchSingles, BatchOdd, BatchStatus, DeterminismThread],
        BatchUniformFields | BatchPerPointConstants => &[BatchSingles, BatchOdd],
        BatchStridedFields => &[BatchSingles, BatchOdd, BatchUniformFields],
        BatchStridedConstants => &[BatchSingles, BatchOdd, BatchPerPointConstants],
        BatchMixed => &[BatchUniformFields, BatchStridedFields, BatchStridedConstants, BatchStatus, BatchRanges],
        StateAgain => &[StateStart, StateEnd, DeterminismRecreate],
        StateRestart => &[StateStart, StateEnd, StateAgain, DeterminismRecreate],
        DerivativePressure | DerivativeKinks => &[DerivativeAsked, ValuesFinite],
        PhysicsNonNegative | PhysicsLinearInDt | PhysicsFrame => &[ValuesFinite],
        PhysicsZeroWithoutPressure => &[ValuesZeroPressure],
        PhysicsZeroWithoutSlip => &[ValuesZeroSlip],
        PhysicsUnits => &[ThreadsInterleaved, ValuesFinite, DerivativePressure],
        PhysicsTemperatureScale => &[ThreadsInterleaved, ValuesFinite, PhysicsUnits],
        PhysicsPressureDegree => &[ThreadsInterleaved, ValuesFinite, BatchSingles],
        PhysicsDirectionInward => &[PhysicsDirectionLength],
        CostPerPoint | CostSubnormals => &[MemoryUndeclared, BatchLarge],
        _ => &[],
    }
}

/// True for a check that measures time, and so runs while no other does.
pub(super) fn runs_alone(check: Check) -> bool {
    check.facts().group == Group::Cost
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_check_needs_itself_even_by_way_of_others() {
        for check in Check::ALL {
            let mut reached = needs(*check);
            let mut at = 0;
            while at < reached.len() {
                for next in needs(reached[at]) {
                    if !reached.contains(&next) {
                        reached.push(next);
                    }
                }
                at += 1;
            }
            assert!(!reached.contains(check), "{}", check.name());
        }
    }

    #[test]
    fn everything_but_the_symbols_needs_the_library_to_open() {
        for check in Check::ALL.iter().filter(|check| !matches!(check, Check::LoadSymbols | Check::LoadOpens)) {
            assert!(needs(*check).contains(&Check::LoadOpens), "{}", check.name());
        }
        assert!(needs(Check::BatchSingles).contains(&Check::MemoryAfter));
        assert!(needs(Check::ValuesFinite).contains(&Check::DeterminismRepeat));
        assert!(needs(Check::LoadSilent).contains(&Check::FaultsHang));
        assert!(!needs(Check::FaultsHang).contains(&Check::LoadSilent));
    }
}
