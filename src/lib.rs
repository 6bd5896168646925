//! Octolume: see how a dynamic scene becomes voxels, and what their accuracy costs.
//!
//! ```text
//! glTF file ──► Scene ──► VoxelCache ──► VoxelPages ──► Octree ──► light ──► cones ──► view
//!         scene::load  stages::voxelize  ::transform  ::build   ::light   ::surface ::view
//!                     (once per object)  (per frame)  ::fill    ::sample  ::cones
//!                                                     ::averaging
//! ```
//!
//! Modules in the order of the flow. The core knows nothing of egui: window and command line
//! drive the same engine with the same settings.

pub mod accuracy;
#[cfg(feature = "gui")]
pub mod app;
pub mod color;
pub mod data;
pub mod digest;
pub mod disk_cache;
pub mod engine;
pub mod experiment;
pub mod export;
pub mod gpu;
pub mod lights;
pub mod plan;
pub mod prepare;
pub mod progress;
pub mod scene;
pub mod settings;
pub mod spread;
pub mod stages;
