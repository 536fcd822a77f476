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

/// What every look at an answer rests on: the law comes back, and touches the arrays that it should.
const ANSWERED: [Check; 12] = [
    Check::FaultsException,
    Check::FaultsExit,
    Check::FaultsAbort,
    Check::FaultsHang,
    Check::FaultsStack,
    Check::FaultsSignal,
    Check::MemoryOutputs,
    Check::MemoryAfter,
    Check::MemoryBefore,
    Check::MemoryInputs,
    Check::MemoryUnwritten,
    Check::LoadOpens,
];

/// The six that are judged by one run of the law.
pub(super) const FAULTS: [Check; 6] = [
    Check::FaultsException,
    Check::FaultsExit,
    Check::FaultsAbort,
    Check::FaultsHang,
    Check::FaultsStack,
    Check::FaultsSignal,
];

/// The checks that must not have failed for this one to say anything; they are done before it.
pub(super) fn needs(check: Check) -> Vec<Check> {
    let mut needed: Vec<Check> = Vec::new();
    let group = check.facts().group;
    match check {
        Check::LoadSymbols => {}
        Check::LoadOpens => needed.push(Check::LoadSymbols),
        _ => needed.push(Check::LoadOpens),
    }
    let called = !matches!(group, Group::Load | Group::Descriptor) && check != Check::FloatLoad;
    let structs = [Check::DescriptorSmaller, Check::DescriptorLarger, Check::DescriptorText, Check::DescriptorEnd];
    if called || structs.contains(&check) {
        needed.extend(CALLED);
    }
    let evaluated = called && group != Group::Faults && !matches!(check, Check::FloatCreate);
    if evaluated || structs[..2].contains(&check) {
        needed.extend(FAULTS);
    }
    match check {
        // Each of these asks for a little more than the one before.
        Check::MemoryAfter | Check::MemoryBefore | Check::MemoryInputs | Check::MemoryUnwritten => {
            needed.push(Check::MemoryOutputs);
        }
        Check::MemoryOutputs => {}
        _ if evaluated && group != Group::Float => needed.extend(ANSWERED),
        _ => {}
    }
    let compares = matches!(
        group,
        Group::Values | Group::Threads | Group::Batch | Group::State | Group::Derivative | Group::Physics | Group::Cost
    );
    if compares
        || matches!(check, Check::DeterminismThread | Check::DeterminismProcess | Check::DeterminismRecreate)
        || matches!(
            check,
            Check::MemoryUndeclared | Check::MemoryUses | Check::DescriptorLarger | Check::DescriptorSmaller
        )
    {
        needed.push(Check::DeterminismRepeat);
    }
    needed.extend_from_slice(after(check));
    needed.sort_unstable();
    needed.dedup();
    needed
}

/// Needs of single checks: the simpler one says it already.
fn after(check: Check) -> &'static [Check] {
    match check {
        Check::FloatThread => &[Check::FloatLoad, Check::FloatEvaluate, Check::FloatCreate, Check::FloatDestroy],
        Check::BatchShuffled | Check::BatchRanges | Check::BatchOdd | Check::BatchStatus => &[Check::BatchSingles],
        Check::BatchUniformFields | Check::BatchPerPointConstants => &[Check::BatchSingles, Check::BatchOdd],
        Check::BatchStridedFields => &[Check::BatchSingles, Check::BatchOdd, Check::BatchUniformFields],
        Check::BatchStridedConstants => &[Check::BatchSingles, Check::BatchOdd, Check::BatchPerPointConstants],
        Check::BatchLarge => &[Check::BatchSingles, Check::BatchOdd],
        Check::ThreadsConcurrent => &[Check::ThreadsInterleaved],
        Check::PhysicsUnits | Check::ValuesBounds | Check::PhysicsPressureDegree => &[Check::ThreadsInterleaved],
        Check::StateAgain | Check::StateRestart => &[Check::StateStart, Check::StateEnd],
        Check::DerivativePressure | Check::DerivativeKinks => &[Check::DerivativeAsked],
        Check::PhysicsDirectionInward => &[Check::PhysicsDirectionLength],
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
        assert!(!needs(Check::LoadSilent).contains(&Check::FaultsHang));
    }
}
