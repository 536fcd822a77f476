//! Constants of the power kernel, written by `coefficients.py`; do not edit.

// Each decimal is the shortest that reads back as the double meant.
#![allow(clippy::excessive_precision, clippy::approx_constant)]

/// 2 / ln 2, rounded to double.
pub(super) const C0_HI: f64 = 2.8853900817779268;
/// What `C0_HI` leaves out.
pub(super) const C0_LO: f64 = 4.0710547481862066e-17;
/// 2 / (3 ln 2), rounded to double.
pub(super) const C1: f64 = 0.9617966939259756;
/// ln 2, rounded to double.
pub(super) const LN2_HI: f64 = 0.6931471805599453;
/// What `LN2_HI` leaves out.
pub(super) const LN2_LO: f64 = 2.3190468138462996e-17;

/// `(log2((1 + s) / (1 - s)) / s - C0 - C1 z) / z^2` in `z = s^2`, for `|s| <= 3 - sqrt 8`;
/// largest error 2^-51.1.
pub(super) const LOG_TAIL: [f64; 7] = [
    0.5770780163555858,
    0.4121985831098338,
    0.3205988986801571,
    0.2623080459898803,
    0.22196692033039647,
    0.1916759909945492,
    0.18630236736117636,
];

/// `(2^f - 1 - f ln 2) / f^2` for `|f| <= 1/2`;
/// largest error 2^-53.8.
pub(super) const EXP_TAIL: [f64; 10] = [
    0.24022650695910075,
    0.05550410866482158,
    0.009618129107618665,
    0.0013333558146423213,
    0.00015403530424776529,
    1.5252733820795803e-05,
    1.3215451633221434e-06,
    1.0178067267449427e-07,
    7.070977866508168e-09,
    4.454103410587056e-10,
];
