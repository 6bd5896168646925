//! Rust structs and the WGSL structs they mirror, for the test that compares them. What a uniform or storage binding
//! holds is listed beside its Rust struct by [`mirror!`]; fields have the same names on both sides, and padding is
//! spelled out on both.

/// A Rust struct and its twin: fields with their offsets in bytes.
#[derive(Clone, Copy, Debug)]
pub struct Mirror {
    pub rust_name: &'static str,
    /// Below `shaders/`.
    pub file: &'static str,
    pub wgsl_name: &'static str,
    pub bytes: usize,
    pub fields: &'static [(&'static str, usize)],
}

/// `mirror!(RustName, "folder/file.wgsl", "WgslName", field, field)`.
macro_rules! mirror {
    ($rust:ty, $file:literal, $wgsl:literal, $($field:ident),+ $(,)?) => {
        $crate::gpu::Mirror {
            rust_name: stringify!($rust),
            file: $file,
            wgsl_name: $wgsl,
            bytes: size_of::<$rust>(),
            fields: &[$((stringify!($field), std::mem::offset_of!($rust, $field))),+],
        }
    };
}

pub(crate) use mirror;
