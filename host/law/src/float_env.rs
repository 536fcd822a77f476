//! The floating-point environment: what a law must leave as it found it.
//!
//! Rounding, flush-to-zero and exception masks are per thread; a law that changes them would change the host's
//! own numbers. The check stores two registers, which takes 1 to 8 ns by the processor (STMXCSR is the slow one on
//! AMD's); who looks when is in `handle::float_guard`.
#![allow(unsafe_code)] // the control registers can be reached by inline assembly only

use std::fmt;

#[cfg(target_arch = "x86_64")]
use x86_64 as registers;

#[cfg(target_arch = "aarch64")]
use aarch64 as registers;

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use unknown as registers;

/// The control bits of the floating-point unit of the calling thread.
///
/// Exception flags are left out: arithmetic sets them.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct FloatEnv(registers::Control);

/// A change of the floating-point environment; its `Display` says what changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FloatEnvChange {
    /// As it was captured.
    pub before: FloatEnv,
    /// As it was found.
    pub after: FloatEnv,
}

impl FloatEnv {
    /// Reads the calling thread's environment.
    #[inline]
    pub fn capture() -> Self {
        Self(registers::read())
    }

    /// Compares the calling thread's environment now with this one; `None` if nothing changed.
    #[inline]
    pub fn changed_since(&self) -> Option<FloatEnvChange> {
        let after = Self::capture();
        if after == *self { None } else { Some(FloatEnvChange { before: *self, after }) }
    }

    /// Sets the calling thread's environment back to this one; exception flags stay as they are.
    pub fn restore(&self) {
        registers::write(self.0);
    }
}

impl FloatEnvChange {
    /// Each setting that changed: its name, its value before and after.
    pub fn settings(&self) -> Vec<(&'static str, &'static str, &'static str)> {
        let (before, after) = (registers::describe(self.before.0), registers::describe(self.after.0));
        let pairs = before.into_iter().zip(after).filter(|(before, after)| before.1 != after.1);
        pairs.map(|(before, after)| (before.0, before.1, after.1)).collect()
    }
}

impl fmt::Debug for FloatEnv {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(registers::describe(self.0)).finish()
    }
}

impl fmt::Display for FloatEnvChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (name, before, after)) in self.settings().into_iter().enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            write!(f, "{comma}{name} from {before} to {after}")?;
        }
        Ok(())
    }
}

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
const fn on_off(bit: bool) -> &'static str {
    if bit { "on" } else { "off" }
}

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
const fn quiet_traps(quiet: bool) -> &'static str {
    if quiet { "quiet" } else { "trapping" }
}

/// MXCSR and the x87 control word (Intel SDM vol. 1, 8.1.5 and 10.2.3).
#[cfg(target_arch = "x86_64")]
mod x86_64 {
    use super::{on_off, quiet_traps};
    use std::arch::asm;
    use std::mem::MaybeUninit;

    /// Denormals-are-zero, exception masks, rounding, flush-to-zero; not the exception flags.
    const MXCSR_CONTROL: u32 = 0xffc0;
    /// Exception masks, precision, rounding; not the bits without a meaning.
    const X87_CONTROL: u16 = 0x0f3f;

    #[derive(Clone, Copy, PartialEq, Eq)]
    pub(super) struct Control {
        mxcsr: u32,
        x87: u16,
    }

    #[inline]
    pub(super) fn read() -> Control {
        // Left unset: filling them first makes the check half as slow again.
        let (mut mxcsr, mut x87) = (MaybeUninit::<u32>::uninit(), MaybeUninit::<u16>::uninit());
        // SAFETY: each instruction stores its register into a local of the size it writes, kept alive by this
        // function, and changes nothing else; so both are set when they are read.
        let (mxcsr, x87) = unsafe {
            asm!("stmxcsr [{}]", in(reg) mxcsr.as_mut_ptr(), options(nostack, preserves_flags));
            asm!("fnstcw [{}]", in(reg) x87.as_mut_ptr(), options(nostack, preserves_flags));
            (mxcsr.assume_init(), x87.assume_init())
        };
        Control { mxcsr: mxcsr & MXCSR_CONTROL, x87: x87 & X87_CONTROL }
    }

    pub(super) fn write(control: Control) {
        let mut mxcsr = 0_u32;
        // SAFETY: the store is as in `read`; the loads take values that `read` found valid in this process, with
        // the reserved bits of MXCSR clear. The x87 flags are cleared first, because a flag left over from the
        // law would trap at the host's next x87 instruction if the host had that exception unmasked.
        unsafe {
            asm!("stmxcsr [{}]", in(reg) &raw mut mxcsr, options(nostack, preserves_flags));
            let mxcsr = mxcsr & !MXCSR_CONTROL | control.mxcsr;
            // Bit 6 of the x87 word is reserved and always reads as one.
            let x87 = control.x87 | 0x0040;
            if control.x87 & 0x3f != 0x3f {
                asm!("fnclex", options(nomem, nostack, preserves_flags));
            }
            asm!("ldmxcsr [{}]", in(reg) &raw const mxcsr, options(nostack, preserves_flags, readonly));
            asm!("fldcw [{}]", in(reg) &raw const x87, options(nostack, preserves_flags, readonly));
        }
    }

    pub(super) fn describe(control: Control) -> Vec<(&'static str, &'static str)> {
        const ROUNDING: [&str; 4] = ["to nearest", "downward", "upward", "toward zero"];
        const SSE_TRAPS: [&str; 6] = [
            "invalid-operation exception",
            "denormal exception",
            "division-by-zero exception",
            "overflow exception",
            "underflow exception",
            "inexact exception",
        ];
        const X87_TRAPS: [&str; 6] = [
            "x87 invalid-operation exception",
            "x87 denormal exception",
            "x87 division-by-zero exception",
            "x87 overflow exception",
            "x87 underflow exception",
            "x87 inexact exception",
        ];
        const PRECISION: [&str; 4] = ["single", "a reserved value", "double", "extended"];
        let Control { mxcsr, x87 } = control;
        let mut settings = vec![
            ("rounding", ROUNDING[(mxcsr >> 13 & 3) as usize]),
            ("flush-to-zero", on_off(mxcsr & 0x8000 != 0)),
            ("denormals-are-zero", on_off(mxcsr & 0x0040 != 0)),
            ("x87 rounding", ROUNDING[usize::from(x87 >> 10 & 3)]),
            ("x87 precision", PRECISION[usize::from(x87 >> 8 & 3)]),
        ];
        settings.extend((0..6).map(|bit| (SSE_TRAPS[bit], quiet_traps(mxcsr >> (7 + bit) & 1 == 1))));
        settings.extend((0..6).map(|bit| (X87_TRAPS[bit], quiet_traps(x87 >> bit & 1 == 1))));
        settings
    }
}

/// FPCR (Arm ARM, C5.2.8); the exception flags are in another register, FPSR.
#[cfg(target_arch = "aarch64")]
mod aarch64 {
    use super::{on_off, quiet_traps};
    use std::arch::asm;

    pub(super) type Control = u64;

    #[inline]
    pub(super) fn read() -> Control {
        let fpcr: u64;
        // SAFETY: reads a register that every program may read, and changes nothing.
        unsafe { asm!("mrs {}, fpcr", out(reg) fpcr, options(nomem, nostack, preserves_flags)) };
        fpcr
    }

    pub(super) fn write(control: Control) {
        // SAFETY: the value is one that `read` found in this register in this process.
        unsafe { asm!("msr fpcr, {}", in(reg) control, options(nostack, preserves_flags)) };
    }

    pub(super) fn describe(control: Control) -> Vec<(&'static str, &'static str)> {
        const ROUNDING: [&str; 4] = ["to nearest", "upward", "downward", "toward zero"];
        let bit = |index: u32| control >> index & 1 == 1;
        vec![
            ("rounding", ROUNDING[(control >> 22 & 3) as usize]),
            ("flush-to-zero", on_off(bit(24))),
            ("flush-inputs-to-zero", on_off(bit(0))),
            ("alternate handling", on_off(bit(1))),
            ("first elements of vectors", on_off(bit(2))),
            ("default NaN", on_off(bit(25))),
            ("half-precision flush-to-zero", on_off(bit(19))),
            ("alternative half precision", on_off(bit(26))),
            ("invalid-operation exception", quiet_traps(!bit(8))),
            ("division-by-zero exception", quiet_traps(!bit(9))),
            ("overflow exception", quiet_traps(!bit(10))),
            ("underflow exception", quiet_traps(!bit(11))),
            ("inexact exception", quiet_traps(!bit(12))),
            ("denormal exception", quiet_traps(!bit(15))),
        ]
    }
}

/// No way to look: nothing is ever found changed.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod unknown {
    pub(super) type Control = ();

    #[inline]
    pub(super) fn read() -> Control {}

    pub(super) fn write(_control: Control) {}

    pub(super) fn describe(_control: Control) -> Vec<(&'static str, &'static str)> {
        Vec::new()
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::{FloatEnv, FloatEnvChange};
    use std::arch::asm;

    /// Flips bits of both control words, looks, restores, and gives the change and whether the restore worked.
    ///
    /// No arithmetic runs in between.
    fn flip(mxcsr_bits: u32, x87_bits: u16) -> (Option<FloatEnvChange>, bool) {
        let before = FloatEnv::capture();
        let (mut mxcsr, mut x87) = (0_u32, 0_u16);
        // SAFETY: reads both control words into locals and loads them back with valid control bits flipped; the
        // environment is restored below, before any arithmetic.
        unsafe {
            asm!("stmxcsr [{}]", in(reg) &raw mut mxcsr, options(nostack));
            asm!("fnstcw [{}]", in(reg) &raw mut x87, options(nostack));
            mxcsr ^= mxcsr_bits;
            x87 ^= x87_bits;
            asm!("ldmxcsr [{}]", in(reg) &raw const mxcsr, options(nostack));
            asm!("fldcw [{}]", in(reg) &raw const x87, options(nostack));
        }
        let change = before.changed_since();
        before.restore();
        (change, before.changed_since().is_none())
    }

    fn said(mxcsr_bits: u32, x87_bits: u16) -> String {
        let (change, restored) = flip(mxcsr_bits, x87_bits);
        assert!(restored, "{mxcsr_bits:#x} {x87_bits:#x} not restored");
        change.map(|change| change.to_string()).unwrap_or_default()
    }

    #[test]
    fn each_setting_is_found_named_and_restored() {
        assert_eq!(said(0x2000, 0), "rounding from to nearest to downward");
        assert_eq!(said(0x6000, 0), "rounding from to nearest to toward zero");
        assert_eq!(said(0x8000, 0), "flush-to-zero from off to on");
        assert_eq!(said(0x0040, 0), "denormals-are-zero from off to on");
        assert_eq!(said(0x8040, 0), "flush-to-zero from off to on, denormals-are-zero from off to on");
        assert_eq!(said(0x0200, 0), "division-by-zero exception from quiet to trapping");
        assert_eq!(said(0, 0x0800), "x87 rounding from to nearest to upward");
        assert_eq!(said(0, 0x0100), "x87 precision from extended to double");
        assert_eq!(said(0, 0x0001), "x87 invalid-operation exception from quiet to trapping");
        for bit in 6..16 {
            assert!(!said(1 << bit, 0).is_empty(), "MXCSR bit {bit}");
        }
        for bit in [0, 1, 2, 3, 4, 5, 8, 9, 10, 11] {
            assert!(!said(0, 1 << bit).is_empty(), "x87 bit {bit}");
        }
    }

    #[test]
    fn exception_flags_may_change() {
        let before = FloatEnv::capture();
        assert!(std::hint::black_box(1.0_f64 / 3.0) > 0.0);
        assert!(std::hint::black_box(f64::MAX) * std::hint::black_box(2.0) > f64::MAX);
        assert_eq!(before.changed_since(), None);
        assert_eq!(said(0x003f, 0), "");
    }

    #[test]
    fn restore_keeps_the_exception_flags() {
        let flags = |set: u32| {
            let mut mxcsr = 0_u32;
            // SAFETY: reads MXCSR into a local and loads it back with flag bits, which trap nothing, changed.
            unsafe {
                asm!("stmxcsr [{}]", in(reg) &raw mut mxcsr, options(nostack));
                mxcsr = mxcsr & !0x3f | set;
                asm!("ldmxcsr [{}]", in(reg) &raw const mxcsr, options(nostack));
                FloatEnv::capture().restore();
                asm!("stmxcsr [{}]", in(reg) &raw mut mxcsr, options(nostack));
            }
            mxcsr & 0x3f
        };
        assert_eq!(flags(0x11), 0x11);
        assert_eq!(flags(0), 0);
    }
}
