//! The occupied cells of a world at one moment, on the CPU.

/// World cells sorted by Morton key; all vectors are equally long.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorldVoxels {
    pub cells: Vec<[i32; 3]>,
    /// 0 to 1.
    pub occupancy: Vec<f32>,
    /// Linear.
    pub albedo: Vec<[f32; 3]>,
    /// Unit length, or zero where normals cancel.
    pub normal: Vec<[f32; 3]>,
}
