//! The checks: one variant each, which carries its name, group, description and the rule behind it.
//!
//! What a check does is in the file of its group; that every variant has a body is held by the compiler.

/// What a check belongs to; the first half of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Group {
    /// What loading and unloading does to the program.
    Load,
    /// Rounding, flushing to zero, exception masks.
    Float,
    /// What goes wrong so badly that no answer comes back.
    Faults,
    /// What the law says of itself.
    Descriptor,
    /// The numbers at known, ordinary and extreme inputs.
    Values,
    /// Same call, same answer.
    Determinism,
    /// Several instances and several threads.
    Threads,
    /// Any split and layout of the points.
    Batch,
    /// Arrays, pointers and leaks.
    Memory,
    /// State variables.
    State,
    /// The derivative with respect to the pressure.
    Derivative,
    /// The author's claims and the units.
    Physics,
    /// Time per point.
    Cost,
}

impl Group {
    /// All groups, in the order in which they are reported.
    pub const ALL: [Group; 13] = [
        Self::Load,
        Self::Float,
        Self::Faults,
        Self::Descriptor,
        Self::Values,
        Self::Determinism,
        Self::Threads,
        Self::Batch,
        Self::Memory,
        Self::State,
        Self::Derivative,
        Self::Physics,
        Self::Cost,
    ];

    /// The group's name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Load => "load",
            Self::Float => "float",
            Self::Faults => "faults",
            Self::Descriptor => "descriptor",
            Self::Values => "values",
            Self::Determinism => "determinism",
            Self::Threads => "threads",
            Self::Batch => "batch",
            Self::Memory => "memory",
            Self::State => "state",
            Self::Derivative => "derivative",
            Self::Physics => "physics",
            Self::Cost => "cost",
        }
    }
}

/// What is known of a check without running it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// The check's name, `group/name`, on the command line, in JSON and JUnit.
    pub name: &'static str,
    /// Its group.
    pub group: Group,
    /// Whether `--quick` runs it.
    pub quick: bool,
    /// One line on what is tested.
    pub description: &'static str,
    /// What the contract says.
    pub rule: &'static str,
    /// The section of `include/README.md` where it says so.
    pub section: &'static str,
}

macro_rules! checks {
    ($($group:ident { $($variant:ident $name:literal $run:ident $description:literal
        [$section:literal] $rule:literal;)+ })+) => {
        /// One conformance item.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Check {
            $($(#[doc = $description] $variant,)+)+
        }

        impl Check {
            /// Every check, in the order in which they are reported.
            pub const ALL: &[Check] = &[$($(Check::$variant,)+)+];

            /// What is known of the check without running it.
            pub fn facts(self) -> Facts {
                match self {
                    $($(Check::$variant => Facts {
                        name: $name,
                        group: Group::$group,
                        quick: checks!(@ $run),
                        description: $description,
                        rule: $rule,
                        section: $section,
                    },)+)+
                }
            }
        }
    };
    (@ quick) => { true };
    (@ full) => { false };
}

// variant, name, whether `--quick` runs it, description, [section of include/README.md], rule
checks! {
Load {
    LoadSymbols "load/symbols" quick "every symbol that the library needs is found"
        ["The contract"] "a library loads with all symbols resolved at once";
    LoadOpens "load/opens" quick "the library loads and its entry and descriptions come back"
        ["The contract"] "loading a library and asking what it holds does nothing else";
    LoadTwice "load/twice" full "the library loads, unloads and loads again, and says the same of itself"
        ["The contract"] "a library can be loaded and unloaded any number of times";
    LoadSilent "load/silent" quick "nothing is printed from load to unload"
        ["The contract"] "no output to the terminal";
    LoadWorkingDirectory "load/working-directory" quick "the working directory is left alone from load to unload"
        ["The contract"] "no change of the working directory";
    LoadLocale "load/locale" quick "the locale is left alone from load to unload"
        ["The contract"] "no change of the locale";
    LoadSignals "load/signals" quick "signal handlers and the signal mask are left alone from load to unload"
        ["The contract"] "no signal handler";
    LoadThreads "load/threads" quick "loading starts no thread or process and unloading leaves none"
        ["The contract"] "loading starts no thread; threads of an instance end with it";
    LoadEnvironment "load/environment" quick "environment variables are left alone from load to unload"
        ["The contract"] "no change of environment variables";
}
Float {
    FloatLoad "float/load" quick "rounding, FTZ/DAZ and exception masks are the same after loading"
        ["The contract"] "the floating-point environment is left as it was found: never link with -ffast-math";
    FloatThread "float/thread" quick "a thread started after loading has the default floating-point environment"
        ["The contract"] "the floating-point environment is left as it was found: never link with -ffast-math";
    FloatCreate "float/create" quick "rounding, FTZ/DAZ and exception masks are the same after creating an instance"
        ["The contract"] "the floating-point environment is left as it was found";
    FloatEvaluate "float/evaluate" quick "rounding, FTZ/DAZ and exception masks are the same after every evaluation"
        ["The contract"] "the floating-point environment is left as it was found";
    FloatDestroy "float/destroy" quick "rounding, FTZ/DAZ and exception masks are the same after destroying an instance"
        ["The contract"] "the floating-point environment is left as it was found";
    FloatNan "float/nan" quick "a NaN in any input gives a status or a finite value, as -ffinite-math-only would not"
        ["The contract"] "never a silent NaN: an input that has no answer gives a status";
}
Faults {
    FaultsException "faults/exception" quick "no exception or panic gets out, whatever the input"
        ["The contract"] "no exception or abort gets out";
    FaultsExit "faults/exit" quick "the law does not end the program by exit, whatever the input"
        ["The contract"] "no exit";
    FaultsAbort "faults/abort" quick "the law does not end the program by abort, whatever the input"
        ["The contract"] "no exception or abort gets out";
    FaultsHang "faults/hang" quick "every call comes back, whatever the input"
        ["The contract"] "every call comes back in a time that depends on the number of points only";
    FaultsStack "faults/stack" quick "no call overflows the stack, whatever the input"
        ["The contract"] "a call gets by with the stack of a thread, 2 MiB";
    FaultsSignal "faults/signal" quick "no call ends in a signal such as SIGSEGV or SIGFPE, whatever the input"
        ["The contract"] "an input that has no answer gives a status";
    FaultsCreate "faults/create" quick "options that make no sense are refused with a text, or are of no effect"
        ["The contract"] "an instance that cannot be made is refused with a status and a text";
}
Descriptor {
    DescriptorNames "descriptor/names" quick "names, versions and summaries are well formed, closed by NUL and different"
        ["The descriptor"] "names are a letter, then letters, digits and underscores; every text ends inside its array";
    DescriptorUnits "descriptor/units" quick "SI exponents are finite, and at most one constant closes the units"
        ["The descriptor"] "SI exponents are finite numbers, and at most one constant closes the units";
    DescriptorBounds "descriptor/bounds" quick "bounds leave room for a value"
        ["The descriptor"] "the minimum is below the maximum, or equal to it and allowed";
    DescriptorDefaults "descriptor/defaults" quick "defaults and initial values lie in the bounds"
        ["The descriptor"] "a default lies in the bounds, or is NaN for a value that must be given";
    DescriptorFields "descriptor/fields" quick "fields read and used exist, are named, and outputs written exist"
        ["The descriptor"] "reads, uses and writes are bits of the table, or fields that `describe` names";
    DescriptorClaims "descriptor/claims" quick "claims and flags exist, and the pressure degree is a number or a constant"
        ["Claims"] "claims, flags and the pressure degree are what this section lists";
    DescriptorEnd "descriptor/end" quick "entry and describe answer WL_NO_MORE past the end, and the same when asked again"
        ["The descriptor"] "entry and describe answer WL_NO_MORE for every index that they do not have";
    DescriptorSmaller "descriptor/smaller-structs" quick "structs of the 1.0 size, of an older host, are not overrun"
        ["Versions"] "touch min(struct_size, sizeof) of a struct that the other side allocated";
    DescriptorLarger "descriptor/larger-structs" quick "longer structs, of a newer host, are taken and left alone behind their known part"
        ["Versions"] "touch min(struct_size, sizeof) of a struct that the other side allocated";
    DescriptorExtension "descriptor/extension" quick "an extension that nobody knows gives NULL"
        ["The descriptor"] "an unknown extension gives NULL";
    DescriptorText "descriptor/text" quick "a refusal's text ends inside the buffer, also in a short one"
        ["Statuses"] "a text takes at most text_size bytes with its closing NUL";
}
Values {
    ValuesExpected "values/expected" quick "the rows of expected.csv, or of the law's own test, come out"
        ["Known values"] "what the author computed independently comes out";
    ValuesFinite "values/finite" quick "every input within the bounds gives a finite value or a status"
        ["The contract"] "never a silent NaN: an input that has no answer gives a status";
    ValuesZeroPressure "values/zero-pressure" quick "zero pressure gives a finite value or a status"
        ["The contract"] "never a silent NaN: an input that has no answer gives a status";
    ValuesZeroSlip "values/zero-slip" quick "zero slip gives a finite value or a status"
        ["The contract"] "never a silent NaN: an input that has no answer gives a status";
    ValuesZeroDt "values/zero-dt" quick "a substep of no length wears nothing and leaves the state as it was"
        ["The contract"] "a substep of no length, dt = 0 and no slip, wears nothing and leaves the state as it was";
    ValuesNegativePressure "values/negative-pressure" quick "negative pressure wears nothing"
        ["The contract"] "no wear at negative pressure";
    ValuesExtremes "values/extremes" quick "-0, subnormals, 1e-300, 1e300 and infinities give a finite value or a status"
        ["The contract"] "never a silent NaN or infinity: an input that has no answer gives a status";
    ValuesBounds "values/bounds" quick "constants at their bounds give a finite value or a status (the host refuses what lies beyond)"
        ["The descriptor"] "the law answers everywhere within the bounds that it declares";
}
Determinism {
    DeterminismRepeat "determinism/repeat" quick "the same call twice gives the same answer"
        ["The contract"] "pure: no memory between calls but the state variables";
    DeterminismThread "determinism/thread" quick "another thread gives the same answer"
        ["The contract"] "pure: everything comes from the inputs";
    DeterminismProcess "determinism/process" full "another process gives the same answer"
        ["The contract"] "pure: everything comes from the inputs";
    DeterminismRecreate "determinism/recreate" quick "after destroy and create the answer is the same"
        ["The contract"] "pure: no memory between calls but the state variables";
}
Threads {
    ThreadsInterleaved "threads/interleaved" quick "two instances with different constants, called in turn, answer as each alone"
        ["The contract"] "pure: no memory between calls but the state variables";
    ThreadsConcurrent "threads/concurrent" full "one instance called from several threads at once answers as from one (unless WL_FLAG_SERIAL)"
        ["The contract"] "one instance may be evaluated from several threads at once, unless it has the flag WL_FLAG_SERIAL";
}
Batch {
    BatchSingles "batch/singles" quick "a batch of n points gives what n batches of one point give"
        ["The contract"] "the host splits a substep into batches as it likes; a law never looks at other points";
    BatchShuffled "batch/shuffled" quick "points in another order give the same answers"
        ["The contract"] "the host splits a substep into batches as it likes; a law never looks at other points";
    BatchRanges "batch/ranges" quick "any part of the points gives the same answers"
        ["The contract"] "the host splits a substep into batches as it likes; a law never looks at other points";
    BatchEmpty "batch/empty" quick "no points: nothing is read or written, and the answer is WL_OK"
        ["The contract"] "a batch may hold any number of points, none too";
    BatchOdd "batch/odd" quick "batches of 2 to 67 points, and around 128 to 4096, answer as single points do"
        ["The contract"] "a batch may hold any number of points, none too";
    BatchLarge "batch/large" full "a batch of 1e6 points answers as its parts do"
        ["The contract"] "a batch may hold any number of points, none too";
    BatchUniformFields "batch/uniform-fields" quick "a field given once (step 0) answers as given for every point"
        ["The fields"] "a column with step 0 holds one value for all points";
    BatchStridedFields "batch/strided-fields" quick "a field with gaps between its points (step 3 and more) answers as without"
        ["The fields"] "the step of a column is the number of values from one point to the next";
    BatchPerPointConstants "batch/per-point-constants" quick "constants given for every point, all or some, answer as given once"
        ["The fields"] "a constant is a column as any field";
    BatchStridedConstants "batch/strided-constants" quick "constants with gaps between their points answer as without"
        ["The fields"] "a constant is a column as any field";
    BatchMixed "batch/mixed" quick "columns that lie in different ways at once answer as plain ones"
        ["The fields"] "every column has a step of its own: 0, its width or more";
    BatchStatus "batch/status-array" quick "asking for statuses leaves the values as they are, and the worst is returned"
        ["Statuses"] "the call returns the worst status of its points, and writes one for each where asked";
}
Memory {
    MemoryAfter "memory/after" quick "nothing right behind an array is touched"
        ["The contract"] "writes every output that is asked for and nothing else; reads only what it declared";
    MemoryBefore "memory/before" quick "nothing right before an array is touched"
        ["The contract"] "writes every output that is asked for and nothing else; reads only what it declared";
    MemoryInputs "memory/inputs" quick "fields, constants, inputs and the view are not written"
        ["The contract"] "writes every output that is asked for and nothing else";
    MemoryUnwritten "memory/unwritten" quick "every item of every output that is asked for is written"
        ["The contract"] "writes every output that is asked for";
    MemoryUndeclared "memory/undeclared" quick "fields that are not declared, and so not given, are not read"
        ["The contract"] "reads only what it declares";
    MemoryUses "memory/uses" quick "fields that are only used may be absent"
        ["The fields"] "a field that the law uses may be NULL; one that it reads is always there";
    MemoryOutputs "memory/outputs" quick "outputs that are not asked for, and so NULL, are not written"
        ["The contract"] "writes every output that is asked for and nothing else";
    MemoryCalls "memory/calls" full "1e5 calls, good and refused, leave no more memory in use"
        ["The contract"] "no memory between calls but the state variables";
    MemoryInstances "memory/instances" full "1e3 instances made and destroyed leave no more memory or open files"
        ["The contract"] "destroy frees what create has taken";
}
State {
    StateStart "state/start" quick "the state at the start is not written"
        ["The contract"] "the state at the start is constant, the state at the end another array";
    StateEnd "state/end" quick "every state variable at the end is written"
        ["The contract"] "writes every output that is asked for";
    StateAgain "state/again" quick "a substep tried again from the same start gives the same end"
        ["The contract"] "the host may evaluate a point again";
    StateRestart "state/restart" full "a run that is stopped and carried on in a new instance equals the straight run"
        ["The contract"] "no memory between calls but the state variables";
}
Derivative {
    DerivativePressure "derivative/pressure" quick "the derivative with respect to the pressure agrees with differences"
        ["The fields"] "d_pressure is the derivative of the increment with respect to the pressure";
    DerivativeKinks "derivative/kinks" quick "the derivative jumps only if the law says so by WL_FLAG_KINKS"
        ["Claims"] "WL_FLAG_KINKS: the derivative jumps where the law changes branch";
    DerivativeAsked "derivative/asked" quick "asking for the derivative leaves the increment as it is"
        ["The contract"] "writes every output that is asked for and nothing else";
}
Physics {
    PhysicsNonNegative "physics/non-negative" quick "claimed: the increment is never negative"
        ["Claims"] "WL_CLAIM_NON_NEGATIVE: the increment is never negative";
    PhysicsZeroWithoutPressure "physics/zero-without-pressure" quick "claimed: no pressure, no wear"
        ["Claims"] "WL_CLAIM_ZERO_WITHOUT_PRESSURE: no pressure, no wear";
    PhysicsZeroWithoutSlip "physics/zero-without-slip" quick "claimed: no slip, no wear"
        ["Claims"] "WL_CLAIM_ZERO_WITHOUT_SLIP: no slip, no wear";
    PhysicsLinearInDt "physics/linear-in-dt" quick "claimed: one substep wears as much as k equal parts of it"
        ["Claims"] "WL_CLAIM_LINEAR_IN_DT: at fixed rates a substep wears as much as its equal parts, one after the other";
    PhysicsPressureDegree "physics/pressure-degree" quick "claimed: pressure times f gives increment times f^d"
        ["Claims"] "pressure degree d: pressure times f, and friction with it, gives increment times f^d";
    PhysicsFrame "physics/frame" quick "claimed: turning the frame turns the direction and leaves the increment"
        ["Claims"] "WL_CLAIM_FRAME_INDIFFERENT: turning the frame turns the direction and leaves the increment";
    PhysicsDirectionLength "physics/direction-length" quick "wear directions have unit length"
        ["The fields"] "the wear direction is a unit vector";
    PhysicsDirectionInward "physics/direction-inward" quick "wear directions point into the worn body"
        ["The fields"] "the wear direction points into the worn body";
    PhysicsUnits "physics/units" quick "other base units rescale the answer as the declared units say"
        ["The descriptor"] "the law answers the same in every consistent set of units";
    PhysicsTemperatureScale "physics/temperature-scale" quick "a temperature scale with another zero leaves the answer"
        ["Temperature"] "a law that needs the absolute temperature takes temperature - absolute_zero";
}
Cost {
    CostPerPoint "cost/per-point" full "time per point at n = 1, 64, 1024 and 1e6 (told, never a failure)"
        ["The contract"] "the time of a call depends on the number of points only";
    CostSubnormals "cost/subnormals" full "subnormal inputs are not much slower (a warning at most)"
        ["The contract"] "the time of a call depends on the number of points only";
}
}

impl Check {
    /// The check's name, `group/name`, everywhere.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// The check of that name.
    pub fn named(name: &str) -> Option<Check> {
        Check::ALL.iter().copied().find(|check| check.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_different_begin_with_their_group_and_lead_back() {
        let mut seen = std::collections::BTreeSet::new();
        for check in Check::ALL {
            let facts = check.facts();
            let (group, own) = facts.name.split_once('/').expect("group/name");
            assert_eq!(group, facts.group.name());
            assert!(own.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{own}");
            assert!(seen.insert(facts.name), "{}", facts.name);
            assert_eq!(Check::named(facts.name), Some(*check));
        }
        assert_eq!(Check::named("load"), None);
    }

    #[test]
    fn the_checks_stand_in_the_order_of_the_groups_and_every_group_has_some() {
        let order: Vec<Group> = Check::ALL.iter().map(|check| check.facts().group).collect();
        assert!(order.is_sorted());
        for group in Group::ALL {
            assert!(order.contains(&group), "{}", group.name());
        }
    }

    #[test]
    fn texts_are_one_short_line_without_a_full_stop() {
        for check in Check::ALL {
            let facts = check.facts();
            for text in [facts.description, facts.rule] {
                assert!(text.len() <= 110 && !text.ends_with('.') && !text.contains('\n'), "{}: {text}", facts.name);
            }
        }
    }
}
