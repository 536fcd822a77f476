//! What a law answers: statuses, ordered by how bad they are.

/// The values are good.
pub const WL_OK: i32 = 0;
/// The values may be used, with a warning: near the edge of what the law was made for.
pub const WL_UNRELIABLE: i32 = 1;
/// The values are void; a substep shorter by the output's `dt_factor` may work.
pub const WL_CUT_STEP: i32 = 2;
/// The values are void; the inputs are outside what the law can answer, and a shorter substep does not help.
pub const WL_OUT_OF_DOMAIN: i32 = 3;
/// The values are void; an input that the law needs was not given (bits in the output's `missing`).
pub const WL_MISSING_INPUT: i32 = 4;
/// The values are void; the law failed. A host takes every value it does not know for this one.
pub const WL_FAILED: i32 = 5;

/// Answer of the entry and of `describe` past the last index.
pub const WL_NO_MORE: i32 = -1;
