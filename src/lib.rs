//! Octolume: see how a dynamic scene becomes voxels, and what their accuracy costs.
//!
//! ```text
//! glTF file ──► Scene ──► VoxelCache ──► VoxelPages ──► Octree ──► light ──► cones ──► view
//!         scene::load  stages::voxelize  ::transform  ::build   ::light   ::surface ::view
//!                     (once per object)  (per frame)  ::fill    ::sample  ::cones
//!                                                     ::averaging
//! ```
//!
//! Modules in the order of the flow: each imports only what stands above it here, which a test sees to. The core
//! knows nothing of egui: window and command line drive the same engine with the same settings.

pub mod digest;
pub mod spread;
pub mod progress;
pub mod color;
pub mod gpu;
pub mod disk_cache;
pub mod scene;
pub mod settings;
pub mod data;
pub mod lights;
pub mod stages;
pub mod prepare;
pub mod plan;
pub mod accuracy;
pub mod engine;
pub mod export;
pub mod experiment;
#[cfg(feature = "gui")]
pub mod app;
