//! Laws and programs that change the floating-point environment, in the call at hand or between calls.
#![allow(unsafe_code)] // reason: sets the control register of this processor.

use std::arch::asm;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use wearlaw_plugin_api::abi;

use super::super::super::batch::{Batch, Outputs};
use super::super::super::descriptor::LawDescriptor;
use super::super::super::evaluation::{Evaluation, Evaluator};
use super::super::super::fields::Field;
use super::super::super::float_env::FloatEnv;
use super::super::super::loader::Plugin;
use super::super::super::memory::{InMemory, MemoryInputs, MemoryLaw, MemoryOutputs};
use super::super::super::test_laws::plain;
use super::super::super::values::Values;
use super::super::{LawInstance, PIECE};

/// Flush-to-zero, and the mask of the exception for inexact results, in MXCSR.
const FLUSH: u32 = 0x8000;
const INEXACT: u32 = 0x1000;

/// Sets and clears bits of MXCSR.
fn set(bits: u32, clear: u32) {
    let mut mxcsr = 0_u32;
    // SAFETY: the register is stored to a local and loaded with valid control bits; the tests here do nothing while an
    // exception is not masked but look at the register.
    unsafe {
        asm!("stmxcsr [{}]", in(reg) &raw mut mxcsr, options(nostack));
        mxcsr = mxcsr & !clear | bits;
        asm!("ldmxcsr [{}]", in(reg) &raw const mxcsr, options(nostack, readonly));
    }
}

fn flushes() -> bool {
    std::hint::black_box(f64::MIN_POSITIVE) * std::hint::black_box(0.5) == 0.0
}

/// Half the pressure, so that the smallest normal pressure shows whether results are flushed to zero; changes MXCSR at
/// its end, in all calls or in those that the option counts.
struct Changes {
    bits: u32,
    clear: u32,
    from: usize,
    to: usize,
    calls: AtomicUsize,
}

impl MemoryLaw for Changes {
    fn descriptor() -> LawDescriptor {
        LawDescriptor { reads: [Field::Pressure].into_iter().collect(), ..plain("changes") }
    }

    fn create(options: Option<&str>) -> Result<Self, String> {
        let (from, to, bits, clear) = match options {
            Some("always") => (0, usize::MAX, FLUSH, 0),
            Some("once") => (0, 1, FLUSH, 0),
            Some("traps") => (0, usize::MAX, 0, INEXACT),
            Some("late") => (3, usize::MAX, FLUSH, 0),
            _ => (0, 0, 0, 0),
        };
        Ok(Self { bits, clear, from, to, calls: AtomicUsize::new(0) })
    }

    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        for point in 0..inputs.points() {
            outputs.increment[point] = 0.5 * inputs.scalar(Field::Pressure, point).unwrap_or(f64::NAN);
        }
        if (self.from..self.to).contains(&self.calls.fetch_add(1, Ordering::Relaxed)) {
            set(self.bits, self.clear);
        }
        abi::WL_OK
    }
}

fn law(options: &str) -> LawInstance {
    let plugin = Plugin::from_entry(Arc::new(InMemory::<Changes>::new())).expect("the law is well formed");
    plugin.laws()[0].create(Some(options)).expect("it has no objections")
}

/// Evaluates at the smallest normal pressure; whether no increment was flushed to zero.
fn keeps(law: &LawInstance, points: usize) -> bool {
    let pressure = vec![f64::MIN_POSITIVE; points];
    let batch = Batch::builder(law.descriptor(), points).field(Field::Pressure, Values::PerPoint(&pressure)).build();
    let mut increment = vec![f64::NAN; points];
    let answer = law.evaluate(&batch.expect("the column fits"), &mut Outputs::new(&mut increment));
    assert_eq!(answer, Ok(Evaluation::Good));
    increment.iter().all(|increment| *increment == 0.5 * f64::MIN_POSITIVE)
}

#[test]
fn what_a_law_changes_is_put_back_after_every_piece_and_told_once() {
    for (options, words) in [
        ("always", "flush-to-zero from off to on"),
        ("once", "flush-to-zero from off to on"),
        ("traps", "inexact exception from quiet to trapping"),
    ] {
        for points in [1, PIECE, 3 * PIECE] {
            let (before, law) = (FloatEnv::capture(), law(options));
            for call in 0..3 {
                assert!(keeps(&law, points), "{options}, call {call}: a piece was evaluated as the one before left it");
                assert_eq!(before.changed_since(), None, "{options}, call {call}");
            }
            let warnings = law.take_warnings();
            assert_eq!(warnings.len(), 1, "{options}: {warnings:?}");
            assert!(warnings[0].contains(words), "{warnings:?}");
        }
    }
}

#[test]
fn a_law_that_begins_to_change_it_later_is_found_as_well() {
    for points in [1, 3 * PIECE] {
        let (before, law) = (FloatEnv::capture(), law("late"));
        for call in 0..6 {
            assert!(keeps(&law, points), "call {call}");
            assert_eq!(before.changed_since(), None, "call {call}");
        }
        assert_eq!(law.take_warnings().len(), 1);
    }
}

#[test]
fn what_the_program_itself_sets_between_calls_stays_and_holds_for_the_law() {
    for points in [1, 3 * PIECE] {
        let law = law("never");
        assert!(keeps(&law, points) && keeps(&law, points));
        set(FLUSH, 0);
        let flushed = !keeps(&law, points) && !keeps(&law, points) && flushes();
        set(0, FLUSH);
        assert!(flushed, "{points} points: the program's own setting was undone");
        assert!(keeps(&law, points) && !flushes());
        assert_eq!(law.take_warnings(), [""; 0]);
    }
}

#[test]
fn another_law_or_thread_begins_anew() {
    let (first, second) = (law("never"), law("never"));
    assert!(keeps(&first, 1));
    set(FLUSH, 0);
    let flushed = !keeps(&second, 1);
    set(0, FLUSH);
    assert!(flushed && keeps(&first, 1));
    let elsewhere = std::thread::scope(|scope| {
        let other = scope.spawn(|| {
            set(FLUSH, 0);
            !keeps(&first, 1) && flushes()
        });
        other.join().expect("it does not panic")
    });
    assert!(elsewhere && keeps(&first, 1));
    assert_eq!(first.take_warnings(), [""; 0]);
}
