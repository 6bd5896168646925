//! The stages of the pipeline, a folder each, in flow order. In a stage, `X.rs` records the
//! dispatch of `shaders/…/X.wgsl`, and `X_ref.rs` is its f64 reference, written from the paper.

pub mod averaging;
pub mod build;
pub mod compare;
pub mod cones;
pub mod fill;
pub mod light;
pub mod pixels;
pub mod sample;
mod shaders;
pub mod surface;
pub mod textures;
pub mod transform;
pub mod view;
pub mod voxelize;

pub use shaders::{MIRRORS, SHADERS};
