//! Version numbers, fixed sizes and symbol names.

/// Major version of the ABI; part of the entry's name, so that two majors can never meet.
pub const WL_ABI_MAJOR: i32 = 1;
/// Minor version of the ABI that this header describes; fields are only ever appended between minors.
pub const WL_ABI_MINOR: i32 = 0;
/// Bytes of a name, with its closing NUL.
pub const WL_NAME_SIZE: usize = 64;
/// Bytes of a version text, with its closing NUL.
pub const WL_VERSION_SIZE: usize = 32;
/// Bytes of a summary or source text, with its closing NUL.
pub const WL_SUMMARY_SIZE: usize = 256;

/// Name of the exported entry, as the dynamic linker wants it.
pub const ENTRY_SYMBOL: &[u8] = b"wearlaw_entry_1\0";
/// Name of the optional exported layout record of laws written in Rust.
pub const LAYOUT_SYMBOL: &[u8] = b"wearlaw_layout_1\0";
