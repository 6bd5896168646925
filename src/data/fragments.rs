//! What the posed triangles leave in cells on their way to world voxels, where they are voxelized every frame.
//!
//! ```text
//! draws        a primitive of an object: its triangles are numbered from first_triangle on
//! starts       by triangle: its first column of cells along its dominant axis; how many there are at the end
//! heads        word 0: how many fragments there are; then by bucket the last fragment + 1, 0 = none
//! fragments    FRAGMENT_WORDS words each, 2 more where something emits
//!   covered    cell's Morton key | next of the bucket + 1 | triangle | area                     | s t   | share
//!   shaded     cell's Morton key | next of the bucket + 1 | object   | area 21 bits, opacity 11 | color | normal | emission
//! ```
//!
//! A key's highest bit says that the fragment is not shaded yet. Areas count 2^-20 cells². s and t, 16 bits each, are the
//! second and third corner's weight at the middle of what lies in the cell; `share` is its share of the triangle. Colours
//! are roots and normals biased, both of 10 bits, as in leaves. A bucket is a cell (dense), or all cells with one hash
//! (sparse).

use bytemuck::{Pod, Zeroable};

use crate::gpu::{Constant, GpuBuffer, Kernel, Mirror, PassBuilder, constants, mirror};

pub const FRAGMENT_WORDS: u32 = 6;
/// Of a fragment's, where something emits.
pub const EMISSION_WORDS: u32 = 2;
/// Of a voxel's emission, which has the words of a fragment's.
pub const EMISSION_BYTES: u64 = 4 * EMISSION_WORDS as u64;
/// One cell² in units of areas.
pub const AREA_ONE: u32 = 1 << 20;
/// Bits of an area: a triangle has at most √2 cells² in a cell.
pub const AREA_BITS: u32 = 21;
/// What is there as a whole.
pub const OPACITY_ONE: u32 = (1 << (32 - AREA_BITS)) - 1;
/// Of a key whose fragment is not shaded yet.
pub const UNSHADED: u32 = 1 << 31;

pub const CONSTANTS: &[Constant] = constants![
    integer FRAGMENT_WORDS,
    integer EMISSION_WORDS,
    integer AREA_ONE,
    integer AREA_BITS,
    integer OPACITY_ONE,
    integer UNSHADED,
];

/// Visible area, rounded: `area` times `opacity` / [`OPACITY_ONE`].
pub fn visible(area: u32, opacity: u32) -> u32 {
    (area * opacity + OPACITY_ONE / 2) / OPACITY_ONE
}

/// A primitive of an object. Mirror of `TriangleDraw` in shaders/shared/triangle_list.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct TriangleDraw {
    pub first_triangle: u32,
    pub first_index: u32,
    pub first_vertex: u32,
    pub first_matrix: u32,
    pub object: u32,
    pub material: u32,
    pub is_skinned: u32,
    pub pad: u32,
}

/// What a dispatch goes through. Mirror of `TriangleList` in shaders/shared/triangle_list.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct TriangleList {
    pub first_draw: u32,
    pub end_draw: u32,
    pub first_triangle: u32,
    pub end_triangle: u32,
    pub grid_cells: u32,
}

/// Where fragments find room. Mirror of `FragmentRoom` in shaders/shared/fragments.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct FragmentRoom {
    pub fragments: u32,
    pub voxels: u32,
    /// log2 of how many there are.
    pub bucket_bits: u32,
    /// Hints of the work list, behind which the voxels' objects lie.
    pub hints: u32,
}

/// What only the GPU can count. Mirror of `FragmentCounts` in shaders/shared/fragments.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct FragmentCounts {
    pub columns: u32,
    pub fragments: u32,
    pub voxels: u32,
    pub pad: u32,
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(FragmentCounts, "shared/fragments.wgsl", "FragmentCounts", columns, fragments, voxels, pad),
    mirror!(
        TriangleDraw,
        "shared/triangle_list.wgsl",
        "TriangleDraw",
        first_triangle,
        first_index,
        first_vertex,
        first_matrix,
        object,
        material,
        is_skinned,
        pad
    ),
    mirror!(
        TriangleList,
        "shared/triangle_list.wgsl",
        "TriangleList",
        first_draw,
        end_draw,
        first_triangle,
        end_triangle,
        grid_cells
    ),
    mirror!(FragmentRoom, "shared/fragments.wgsl", "FragmentRoom", fragments, voxels, bucket_bits, hints),
];

/// Triangles whose vertices lie in the same buffers.
#[derive(Clone, Debug)]
pub struct TriangleBatch {
    pub vertices: GpuBuffer,
    pub indices: GpuBuffer,
    /// Where any of them is skinned.
    pub joints: Option<GpuBuffer>,
    pub list: TriangleList,
}

/// The posed triangles of all that is shown, in cells from the grid's corner.
#[derive(Clone, Debug)]
pub struct PosedTriangles {
    pub batches: Vec<TriangleBatch>,
    pub draws: GpuBuffer,
    pub matrices: GpuBuffer,
    pub count: u32,
}

impl PosedTriangles {
    /// A batch by the names in shaders/shared/triangle_list.wgsl.
    pub fn bind<'r>(&self, pass: PassBuilder<'r, Kernel>, batch: &TriangleBatch) -> PassBuilder<'r, Kernel> {
        pass.uniform("list", &batch.list)
            .bind("draws", &self.draws)
            .bind("indices", &batch.indices)
            .bind("vertices", &batch.vertices)
            // Without skins nobody reads it.
            .bind("vertex_joints", batch.joints.as_ref().unwrap_or(&batch.vertices))
            .bind("matrices", &self.matrices)
    }
}
