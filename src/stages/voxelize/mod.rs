//! Pre-voxelization (section 3.1): triangles to cells, on the CPU, once per object.
