//! Scenes made by our own generator: a name in, the bytes of a `.glb` file out.
//!
//! The generator is a toolkit ([`shapes`], [`textures`], [`character`], [`glb`]) that scenes
//! share; a scene is one module that arranges it. Lengths are metres, +Y is up, colours linear.
//! The same name gives the same bytes on every machine: see [`exact`] for how.

pub mod character;
mod courtyard;
mod error;
pub mod exact;
pub mod glb;
pub mod shapes;
pub mod textures;

pub use error::MakeError;

/// Names that [`make`] and [`bytes`] know.
pub const NAMES: &[&str] = &["courtyard"];

/// Generates a scene as the bytes of a `.glb` file; `None` for an unknown name.
pub fn make(name: &str) -> Option<Result<Vec<u8>, MakeError>> {
    match name {
        "courtyard" => Some(courtyard::make()),
        _ => None,
    }
}

/// The committed file of a scene, equal to what [`make`] gives; `None` for an unknown name.
pub fn bytes(name: &str) -> Option<&'static [u8]> {
    match name {
        "courtyard" => Some(include_bytes!("../../../assets/courtyard.glb")),
        _ => None,
    }
}
