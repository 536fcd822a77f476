//! Fourier transforms by a given set of instructions: complex ones of rustfft, and real ones made of them.
//!
//! A crate of its own because planners are generic: their kernels are compiled where they are asked for, here as one unit.

mod instructions;
mod real;

use std::sync::Arc;

use rustfft::FftPlannerScalar;
pub use rustfft::num_complex::Complex;
pub use rustfft::{Fft, FftDirection};

pub use instructions::{INSTRUCTIONS_VARIABLE, Instructions, InstructionsError};
pub use real::Real;

/// The transform of complex lines of one length, in place; not normalised.
#[must_use]
pub fn complex(set: Instructions, length: usize, direction: FftDirection) -> Arc<dyn Fft<f64>> {
    let planned = match set {
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx2 => rustfft::FftPlannerAvx::new().ok().map(|mut planner| planner.plan_fft(length, direction)),
        #[cfg(target_arch = "aarch64")]
        Instructions::Neon => {
            rustfft::FftPlannerNeon::new().ok().map(|mut planner| planner.plan_fft(length, direction))
        }
        _ => None,
    };
    planned.unwrap_or_else(|| FftPlannerScalar::new().plan_fft(length, direction))
}
