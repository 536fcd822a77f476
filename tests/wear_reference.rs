//! Wear under prescribed pressure and velocity against numbers that are known, through the library.

#[path = "wear_reference/accuracy.rs"]
mod accuracy;
#[path = "wear_reference/events.rs"]
mod events;
#[path = "wear_reference/laws.rs"]
mod laws;
#[path = "wear_reference/loading.rs"]
mod loading;
#[path = "wear_reference/settings.rs"]
mod settings;
#[path = "support/solved.rs"]
mod solved;
#[path = "wear_reference/with_memory.rs"]
mod with_memory;
