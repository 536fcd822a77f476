//! The laws that are part of this program.
#![allow(unsafe_code)] // reason: vouches for the entry functions of laws that are compiled in.

use std::sync::Arc;

use wearlaw_plugin_api::abi;

use super::entry::{Embedded, Entry};

/// Their names.
pub const NAMES: &[&str] = &["archard"];

/// The entry function of a law of this program.
pub fn function(name: &str) -> Option<abi::EntryFn> {
    match name {
        "archard" => Some(wearlaw_archard::wearlaw_entry_1),
        _ => None,
    }
}

/// The entry of a law of this program.
pub fn entry(name: &str) -> Option<Arc<dyn Entry>> {
    let function = function(name)?;
    // SAFETY: the function is made by `export_laws!`, which keeps the contract of the ABI's entry.
    Some(Arc::new(unsafe { Embedded::new(&format!("embedded:{name}"), function) }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Plugin;

    #[test]
    fn every_name_has_an_entry_with_a_law_of_that_name() {
        for name in NAMES {
            let plugin = Plugin::from_entry(entry(name).unwrap()).unwrap();
            assert_eq!(plugin.law(Some(name)).unwrap().descriptor().name, *name);
            assert!(plugin.facts().is_none());
        }
        assert!(entry("mine").is_none());
    }
}
