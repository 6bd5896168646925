//! The posed triangles as kernels go through them: a number each, batch by batch.

use super::posed::{PosedMesh, Shown};
use crate::data::fragments::{PosedTriangles, TriangleBatch, TriangleDraw, TriangleList};
use crate::data::octree::Slot;
use crate::gpu::{Gpu, GpuError};

impl PosedMesh<'_> {
    /// All that is not hidden. `slot` is overwritten at once: record when the recording before has run.
    pub fn triangles(&self, gpu: &Gpu, slot: &mut Slot, grid_cells: u32) -> Result<PosedTriangles, GpuError> {
        let default_material = self.mesh.scene.materials.len();
        let mut of_batch: Vec<Vec<Shown<'_>>> = self.mesh.batches.iter().map(|_| Vec::new()).collect();
        self.shown().for_each(|shown| of_batch[shown.place.batch].push(shown));
        let (mut draws, mut batches, mut triangle) = (Vec::new(), Vec::new(), 0);
        for (batch, of_batch) in self.mesh.batches.iter().zip(of_batch) {
            let (first_draw, first_triangle) = (draws.len() as u32, triangle);
            for shown in of_batch {
                draws.push(TriangleDraw {
                    first_triangle: triangle,
                    first_index: shown.place.first_index,
                    first_vertex: shown.place.first_vertex,
                    first_matrix: shown.first_matrix,
                    object: shown.number,
                    material: shown.primitive.material.unwrap_or(default_material).min(default_material) as u32,
                    is_skinned: u32::from(shown.joints.is_some()),
                    pad: 0,
                });
                triangle += shown.place.index_count / 3;
            }
            let (end_draw, end_triangle) = (draws.len() as u32, triangle);
            if end_triangle > first_triangle {
                let list = TriangleList { first_draw, end_draw, first_triangle, end_triangle, grid_cells };
                let (vertices, indices) = (batch.vertices.clone(), batch.indices.clone());
                batches.push(TriangleBatch { vertices, indices, joints: batch.joints.clone(), list });
            }
        }
        let buffer = slot.ensure(gpu, "triangle draws", size_of_val(&*draws) as u64)?;
        gpu.write(&buffer, 0, bytemuck::cast_slice(&draws))?;
        Ok(PosedTriangles { batches, draws: buffer, matrices: self.matrices.clone(), count: triangle })
    }
}
