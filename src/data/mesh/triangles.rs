//! The posed triangles as kernels go through them: a number each, batch by batch.

use super::posed::PosedMesh;
use crate::data::fragments::{PosedTriangles, TriangleBatch, TriangleDraw, TriangleList};
use crate::data::octree::Slot;
use crate::gpu::{Gpu, GpuError};

impl PosedMesh<'_> {
    /// All that is not hidden. `slot` is overwritten at once: record when the recording before has run.
    pub fn triangles(&self, gpu: &Gpu, slot: &mut Slot, grid_cells: u32) -> Result<PosedTriangles, GpuError> {
        let mut of_batch: Vec<Vec<TriangleDraw>> = vec![Vec::new(); self.mesh.batches.len()];
        let mut counts: Vec<Vec<u32>> = vec![Vec::new(); self.mesh.batches.len()];
        for (batch, draw, triangles) in self.triangle_draws() {
            of_batch[batch].push(draw);
            counts[batch].push(triangles);
        }
        let (mut draws, mut batches, mut triangle) = (Vec::new(), Vec::new(), 0);
        for (batch, (of_batch, counts)) in self.mesh.batches.iter().zip(of_batch.into_iter().zip(counts)) {
            let (first_draw, first_triangle) = (draws.len() as u32, triangle);
            for (draw, count) in of_batch.into_iter().zip(counts) {
                draws.push(TriangleDraw { first_triangle: triangle, ..draw });
                triangle += count;
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

    /// Batch, draw and how many triangles it has, of every primitive of every object that is shown.
    fn triangle_draws(&self) -> impl Iterator<Item = (usize, TriangleDraw, u32)> {
        let mesh = self.mesh;
        let default_material = mesh.scene.materials.len();
        let objects = mesh.objects.iter().zip(&self.first);
        let moved = objects.filter_map(|((number, object), first)| Some((*number, object, (*first)?)));
        moved.flat_map(move |(number, object, first)| {
            let primitives = mesh.scene.meshes[object.mesh].primitives.iter().zip(&mesh.places[object.mesh]);
            primitives.filter_map(move |(primitive, place)| {
                let place = place.as_ref()?;
                let is_skinned = mesh.is_skinned(object, primitive, place);
                let draw = TriangleDraw {
                    first_index: place.first_index,
                    first_vertex: place.first_vertex,
                    first_matrix: if is_skinned { first.joints } else { first.node },
                    object: number,
                    material: primitive.material.unwrap_or(default_material).min(default_material) as u32,
                    is_skinned: u32::from(is_skinned),
                    ..TriangleDraw::default()
                };
                Some((place.batch, draw, place.index_count / 3))
            })
        })
    }
}
