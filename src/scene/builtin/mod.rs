//! Scenes made by our own generator: a name in, the bytes of a `.glb` file out.
//!
//! The generator is a toolkit ([`shapes`], [`textures`], [`character`], [`glb`]) that scenes
//! share; a scene is one module that arranges it. Lengths are metres, +Y is up, colours linear.
//! The same name gives the same bytes on every machine: see [`exact`] for how.

mod atrium;
pub mod character;
mod courtyard;
mod crowd;
mod elastic;
mod error;
pub mod exact;
pub mod glb;
pub mod shapes;
pub mod textures;

pub use crowd::MOST as MOST_CHARACTERS;
pub use error::MakeError;

/// Names that [`bytes`] knows: scenes that open by their name.
pub const NAMES: &[&str] = &["courtyard"];
/// Names that [`make`] knows.
pub const MADE: &[&str] = &["courtyard", "character", "atrium", "elastic", DYNAMIC];
/// The scene whose [`make`] counts characters.
pub const DYNAMIC: &str = "dynamic";

/// Generates a scene as the bytes of a `.glb` file; `None` for an unknown name. `characters`: how many walk in
/// [`DYNAMIC`], 1 to [`MOST_CHARACTERS`]; other scenes have as many as they have.
pub fn make(name: &str, characters: usize) -> Option<Result<Vec<u8>, MakeError>> {
    match name {
        "courtyard" => Some(courtyard::make()),
        "character" => Some(crowd::character()),
        "atrium" => Some(atrium::make()),
        "elastic" => Some(elastic::make()),
        DYNAMIC => Some(crowd::dynamic(characters.clamp(1, MOST_CHARACTERS))),
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
