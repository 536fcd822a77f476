//! Contact solves of the half-space: filled by the solver's own branch.
