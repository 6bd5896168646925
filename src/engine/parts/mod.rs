//! What the GPU holds: a file a kind of part, its buffers and how they are made. The frame is the list of
//! [`crate::plan::Part`]s in the order of section 4.1; the plan says which are made, and from what.
//!
//! ```text
//! store (pools by type) ─► a file a kind, each from those before it ─► kinds (the list of them) ─► the engine
//! ```

pub mod caches;
pub mod columns;
pub mod composed;
pub mod cones;
pub mod emission;
pub mod exact;
pub mod joined_voxels;
pub mod kinds;
pub mod light;
pub mod links;
mod likely;
mod making;
pub mod masks;
pub mod materials;
mod moving;
pub mod object_numbers;
pub mod pages;
pub mod payload;
pub mod picture;
pub mod posed_voxels;
pub mod shadow_maps;
mod store;
pub mod surfaces;
pub mod topology;
pub mod world_voxels;

pub use making::{Making, part_and_pass};
pub use store::{Made, Parts, Read};
