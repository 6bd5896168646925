//! Rust structs and the WGSL structs they mirror, for the test that compares them.
//!
//! A struct that a uniform or storage binding holds must be listed here; fields have the same
//! names on both sides, and padding is spelled out on both.

use std::mem::offset_of;

use super::Threads;

/// Both sides of a layout, as Rust sees it.
#[derive(Clone, Copy, Debug)]
pub struct Mirror {
    pub rust_name: &'static str,
    /// The file of `shaders/` that defines the WGSL struct.
    pub file: &'static str,
    pub wgsl_name: &'static str,
    pub bytes: usize,
    /// Every field and its offset in bytes.
    pub fields: &'static [(&'static str, usize)],
}

macro_rules! mirror {
    ($rust:ty, $file:literal, $wgsl:literal, $($field:ident),+ $(,)?) => {
        Mirror {
            rust_name: stringify!($rust),
            file: $file,
            wgsl_name: $wgsl,
            bytes: size_of::<$rust>(),
            fields: &[$((stringify!($field), offset_of!($rust, $field))),+],
        }
    };
}

pub const MIRRORS: &[Mirror] = &[mirror!(Threads, "shared/threads.wgsl", "Threads", first, end)];
