//! Wear on an elastic foundation (Winkler): independent springs, p = k (approach - gap - w) where that is positive.
//! Here are one spring with any pressure exponent, parabolic bodies in closed form, and any springs at once by following
//! the times at which they come into contact and leave it. Not here: contact models that solve such problems in a run.

pub mod discrete;
pub mod parabola;
pub mod point;
