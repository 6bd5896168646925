//! Numbers that Rust and WGSL share: defined once in Rust, beside what they are about, and listed there by
//! [`constants!`]; a shader gets them by `#import constants`.

/// A number by the name it has in WGSL.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant {
    pub name: &'static str,
    pub value: Number,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// A `u32`.
    Integer(u32),
    /// Rounded to an `f32`.
    Float(f64),
}

impl Constant {
    pub const fn integer(name: &'static str, value: u32) -> Self {
        Self { name, value: Number::Integer(value) }
    }

    pub const fn float(name: &'static str, value: f64) -> Self {
        Self { name, value: Number::Float(value) }
    }

    /// Its declaration.
    pub(super) fn wgsl(&self) -> String {
        let name = self.name;
        match self.value {
            Number::Integer(value) => format!("const {name}: u32 = {value}u;"),
            Number::Float(value) => format!("const {name}: f32 = {:?}f;", value as f32),
        }
    }
}

/// `constants![integer TERM_AO, float NEAR = NEAR_CELLS]`: a slice of [`Constant`]s; a name without a value is that of
/// the Rust constant.
macro_rules! constants {
    (@value $name:ident) => { $name };
    (@value $name:ident $value:expr) => { $value };
    ($($kind:ident $name:ident $(= $value:expr)?),* $(,)?) => {
        &[$($crate::gpu::Constant::$kind(stringify!($name), $crate::gpu::constants!(@value $name $($value)?))),*]
    };
}

pub(crate) use constants;
