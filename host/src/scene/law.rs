//! The law section of a scene.

/// Which normal traction the wear is computed from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// The contact pressure.
    Pressure,
    /// The nodal stress of the solid below the contact.
    NodalStress,
}

/// What is done with the wear that a law returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The geometry moves.
    Apply,
    /// The wear is recorded only.
    Post,
}
