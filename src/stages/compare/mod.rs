//! What accuracy costs: moved voxels against the exact voxelization of the posed mesh.

pub mod compare_sets;
pub mod compare_sets_ref;
