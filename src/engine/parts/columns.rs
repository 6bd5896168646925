//! How many columns of cells each posed triangle runs through, before any of them is voxelized. What is behind has room
//! for as many as the last time and a share more, where there was one.

use super::{Made, Making, Parts, Read};
use crate::data::fragments::{FragmentCounts, PosedTriangles};
use crate::data::octree::Slot;
use crate::engine::EngineError;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::plan::{Part, Pass};
use crate::stages::build::scan::{self, Scanned};
use crate::stages::voxelize::count;

#[derive(Debug, Default)]
pub struct Columns {
    triangles: Option<PosedTriangles>,
    draws: Slot,
    matrices: Slot,
    columns: Slot,
    starts: Slot,
    sums: Vec<Slot>,
    total: Slot,
    /// What there is likely to be.
    likely: Option<FragmentCounts>,
    counted: Option<u32>,
}

impl Columns {
    /// Exact, or likely; `None` while nothing is known.
    pub fn count(&self) -> Option<u32> {
        self.counted.or(self.likely.map(|likely| likely.columns))
    }

    /// There are more than the parts behind had room for.
    pub fn has_outgrown(&self) -> bool {
        matches!((self.counted, self.likely), (Some(counted), Some(likely)) if counted > likely.columns)
    }

    pub fn triangles(&self) -> Result<&PosedTriangles, GpuError> {
        self.triangles.as_ref().ok_or_else(|| GpuError::Missing { label: "posed triangles".to_owned() })
    }

    /// By triangle, the first of its columns.
    pub fn starts(&self) -> Result<GpuBuffer, GpuError> {
        self.starts.made("first columns of triangles")
    }

    /// How many there are, on the GPU.
    pub fn total(&self) -> Result<GpuBuffer, GpuError> {
        self.total.made("number of columns")
    }
}

impl Made for Columns {
    const PART: Part = Part::Columns;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, grid) = (making.gpu, making.request.grid());
        self.likely = parts.likely.fragments(making.own_key()?.method(), making.estimated_share, u32::MAX);
        self.counted = None;
        let left_out = &making.method.left_to_each.not_voxelized;
        let posed = parts.posed_mesh_without(left_out, making, &mut self.matrices, &grid.grid_from_world())?;
        let triangles = posed.triangles(gpu, &mut self.draws, grid.cells())?;
        let bytes = 4 * u64::from(triangles.count);
        let columns = self.columns.ensure(gpu, "columns of triangles", bytes)?;
        let starts = self.starts.ensure(gpu, "first columns of triangles", bytes + 4)?;
        let total = self.total.ensure(gpu, "number of columns", 8)?;
        making.begin(frame, Pass::CountColumns);
        let mode = making.request.prepared.mode;
        count::record(gpu, frame, (&triangles, mode), (&columns, &total));
        scan::record(gpu, frame, (Scanned::Words, triangles.count), &columns, &starts, &mut self.sums)?;
        self.triangles = Some(triangles);
        Ok(Some((total, 0..8)))
    }

    fn received(&mut self, gpu: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(bytes);
        if words[1] > 0 {
            let bytes = (u64::from(words[1]) << 32 | u64::from(words[0])) * 4;
            let (limit, adapter) = (gpu.limits.max_storage_buffer_binding_size, gpu.info.name.clone());
            return Err(GpuError::BufferTooLarge { label: "columns of triangles".to_owned(), bytes, limit, adapter });
        }
        self.counted = Some(words[0]);
        Ok(())
    }
}
