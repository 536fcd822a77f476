//! Wear on contact that answers back, through the library: what laws do to it, and what it leaves out.

#[path = "coupled/behaviour.rs"]
mod behaviour;
#[path = "coupled/difficult_laws.rs"]
mod difficult_laws;
#[path = "wear_reference/laws.rs"]
#[allow(dead_code)] // other tests use the rest
mod laws;
#[path = "support/solved.rs"]
mod solved;
