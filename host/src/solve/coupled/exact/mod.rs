//! Exact answers for the cells of a scene: whether one covers the scene, and what it says at every cell.
//!
//! An answer is first [`Asked`](asked::Asked) for, which finds what it does not cover before anything is computed, and then
//! given at the time that a run has reached. The functions themselves are in [`crate::reference`]; what an error is measured
//! in is in the file beside.

mod answer;
mod asked;
mod loading;
mod published;
mod springs;

pub(super) use answer::Answer;
pub(super) use asked::Asked;
pub(super) use published::Published;
