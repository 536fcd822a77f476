//! Bad input of every kind, through the built program: exit code, one telling sentence, nothing half written.
#![cfg(target_os = "linux")]

#[path = "support/c_laws.rs"]
mod c_laws;
#[path = "support/bad_runs.rs"]
mod program;

#[path = "bad_input/behaviour.rs"]
mod behaviour;
#[path = "bad_input/decks.rs"]
mod decks;
#[path = "bad_input/histories.rs"]
mod histories;
#[path = "bad_input/interrupts.rs"]
mod interrupts;
#[path = "bad_input/isolated.rs"]
mod isolated;
#[path = "bad_input/libraries.rs"]
mod libraries;
#[path = "bad_input/missing_inputs.rs"]
mod missing_inputs;
#[path = "bad_input/scenes.rs"]
mod scenes;
#[path = "bad_input/solved_scenes.rs"]
mod solved_scenes;
#[path = "bad_input/struct_sizes.rs"]
mod struct_sizes;
