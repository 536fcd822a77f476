//! Which instructions of the processor transforms are made with: their bits depend on it, and on nothing else.

use std::sync::OnceLock;

/// Name of the environment variable that picks a set.
pub const INSTRUCTIONS_VARIABLE: &str = "WEARLAW_INSTRUCTIONS";

/// A set of instructions, each with those before it on the same kind of processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instructions {
    /// What every processor of the kind has, one number at a time.
    Baseline,
    /// AVX2 with fused multiply-add: four numbers at a time, x86-64.
    Avx2,
    /// Two numbers at a time, aarch64.
    Neon,
}

/// A set that the variable names and this processor does not have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{INSTRUCTIONS_VARIABLE}: found \"{found}\", expected one that this processor has: {}", of_processor())]
pub struct InstructionsError {
    /// The variable's value.
    pub found: String,
}

impl Instructions {
    const ALL: [Instructions; 3] = [Instructions::Baseline, Instructions::Avx2, Instructions::Neon];

    /// Its name in the variable, in reports and in checkpoints.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Instructions::Baseline => "baseline",
            Instructions::Avx2 => "avx2",
            Instructions::Neon => "neon",
        }
    }

    /// Whether this processor has it.
    #[must_use]
    pub fn is_here(self) -> bool {
        match self {
            Instructions::Baseline => true,
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            #[cfg(target_arch = "aarch64")]
            Instructions::Neon => std::arch::is_aarch64_feature_detected!("neon"),
            #[allow(unreachable_patterns)] // reason: sets of other kinds of processors
            _ => false,
        }
    }

    /// The sets of this processor, the best last.
    #[must_use]
    pub fn here() -> Vec<Instructions> {
        Instructions::ALL.into_iter().filter(|set| set.is_here()).collect()
    }

    /// The set that this process uses: what the variable names, or the best.
    ///
    /// # Errors
    /// A name that is none, or that of a set which the processor does not have.
    pub fn asked() -> Result<Instructions, InstructionsError> {
        static ASKED: OnceLock<Result<Instructions, InstructionsError>> = OnceLock::new();
        ASKED.get_or_init(|| Instructions::of(std::env::var_os(INSTRUCTIONS_VARIABLE).as_deref())).clone()
    }

    /// The same for whoever cannot complain: the best set where the variable is wrong.
    #[must_use]
    pub fn in_use() -> Instructions {
        Instructions::asked().unwrap_or_else(|_| Instructions::best())
    }

    fn best() -> Instructions {
        Instructions::here().last().copied().unwrap_or(Instructions::Baseline)
    }

    /// The set for a value of the variable; empty is none.
    fn of(value: Option<&std::ffi::OsStr>) -> Result<Instructions, InstructionsError> {
        match value.filter(|value| !value.is_empty()) {
            None => Ok(Instructions::best()),
            Some(value) => {
                let wanted = Instructions::here().into_iter().find(|set| value == set.name());
                wanted.ok_or_else(|| InstructionsError { found: value.to_string_lossy().into_owned() })
            }
        }
    }
}

/// Names of the sets of this processor.
fn of_processor() -> String {
    Instructions::here().iter().map(|set| format!("\"{}\"", set.name())).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_is_taken_by_its_name_if_the_processor_has_it() {
        assert_eq!(Instructions::of(None), Ok(Instructions::best()));
        assert_eq!(Instructions::of(Some("".as_ref())), Ok(Instructions::best()));
        for set in Instructions::ALL {
            let found = Instructions::of(Some(set.name().as_ref()));
            assert_eq!(found.ok(), set.is_here().then_some(set));
        }
        let error = Instructions::of(Some("avx512".as_ref())).unwrap_err().to_string();
        assert!(error.contains("found \"avx512\"") && error.contains("\"baseline\""), "{error}");
    }
}
