//! Pictures of what the stages made: the octree ray-marched (Fig. 8), the posed triangles, and the
//! moved voxels over the exact ones. In: buffers of the stages, a camera, a [`Look`](crate::settings::Look). Out: a
//! [`Picture`](crate::stages::pixels::Picture), gamma-encoded 8-bit colour and the distance to what is seen.

pub mod ghost;
pub mod ghost_ref;
pub mod march;
pub mod march_light;
pub mod march_light_ref;
pub mod march_ref;
pub mod mesh;
pub mod palette;
pub mod show_shadow;
pub mod show_shadow_ref;
pub mod show_surfaces;
pub mod show_surfaces_ref;
pub mod slice;
pub mod slice_ref;

pub use palette::{GHOST_COLORS, GhostColors, Palette};
