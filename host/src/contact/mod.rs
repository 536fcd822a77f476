//! Contact pressure from load and gap, one module per contact model.
//! Here is the prescribed model: pressure and motion are data read from a history.
//! Not here: what wear does with the pressure (integrator) and which columns a scene needs (plan).

pub mod prescribed;
