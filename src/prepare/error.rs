//! Why a scene cannot be prepared.

use bytesize::ByteSize;

use super::MotionError;
use crate::progress::Cancelled;
use crate::settings::VisibilityError;
use crate::stages::voxelize::VoxelizeError;

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PrepareError {
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Visibility(#[from] VisibilityError),
    #[error("{scene}: object \"{object}\" cannot be voxelized: {cause}")]
    Object { scene: String, object: String, cause: VoxelizeError },
    #[error("the span is {0}; it must be a positive, finite number of scene units")]
    Span(f64),
    #[error(
        "{scene}: at a span of {span} it is {cells:.3e} cells wide, and {limit} is the limit; choose a larger span"
    )]
    TooWide { scene: String, span: f64, cells: f64, limit: f64 },
    #[error(
        "{scene}: at a span of {span} about {millions:.1} million voxels are expected, {bytes} in a buffer, and \
         \"{adapter}\" allows {limit}; {would_fit} would fit"
    )]
    NoRoom {
        scene: String,
        millions: f64,
        span: f64,
        bytes: ByteSize,
        limit: ByteSize,
        adapter: String,
        would_fit: String,
    },
    #[error("the grid has {0} cells along an axis; it must be 64, 128, 256, 512 or 1024")]
    Grid(u32),
}
