//! What the steps of a frame record: buffers and kernels of each, by name.

use std::sync::Arc;

use super::built_octree::BuiltOctree;
use super::scene_on_gpu::SceneOnGpu;
use super::steps::Which;
use super::{Engine, EngineError, Wanted, missing, other_filter};
use crate::data::octree::PointerLayout;
use crate::gpu::{GpuBuffer, GpuError, Recorder};
use crate::plan::{FramePlan, Pass};
use crate::settings::View;
use crate::settings::lighting::Shadows;
use crate::stages::build::link;
use crate::stages::compare::compare_sets;
use crate::stages::sample;
use crate::stages::transform::{MovingVoxels, rigid, skinned};

impl Engine {
    pub(super) fn octree(&mut self, which: Which) -> &mut BuiltOctree {
        match which {
            Which::Shown => &mut self.shown,
            Which::Other => &mut self.other,
        }
    }

    pub(super) fn voxels(&self) -> Result<MovingVoxels, GpuError> {
        self.scene.as_ref().and_then(SceneOnGpu::moving_voxels).ok_or_else(|| missing("world voxel pages"))
    }

    pub(super) fn upload_caches(&mut self) -> Result<(), EngineError> {
        let prepared = self.prepared.as_ref().ok_or(EngineError::NoScene)?;
        self.scene = Some(SceneOnGpu::upload(&self.gpu, prepared, self.segment_order)?);
        Ok(())
    }

    /// Object I-O, the frame's matrices, and the transform of what moved.
    pub(super) fn record_move(&mut self, wanted: &Wanted, plan: &FramePlan) -> Result<Recorder, EngineError> {
        // From here on nothing built before holds, also if this frame fails half-way.
        self.done.moved = false;
        self.done.octree = None;
        self.done.other = None;
        let scene = self.scene.as_mut().ok_or(EngineError::NoScene)?;
        scene.set_frame(&self.gpu, &wanted.frame)?;
        let grid = scene.grid_cells();
        let mut frame = Recorder::default();
        let voxels = self.voxels()?;
        if plan.runs(Pass::TransformRigid) {
            rigid::record(&self.gpu, &mut frame, &voxels, grid);
        }
        if plan.runs(Pass::TransformSkinned) {
            let joints = voxels.cache_joints.as_ref().ok_or_else(|| missing("cache joints"))?;
            skinned::record(&self.gpu, &mut frame, &voxels, joints, grid);
        }
        Ok(frame)
    }

    pub(super) fn record_masks(&mut self, which: Which, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let voxels = self.voxels()?;
        let discretization = &wanted.settings.discretization;
        let filter = match which {
            Which::Shown => discretization.filter,
            Which::Other => other_filter(discretization.filter),
        };
        match which {
            Which::Shown => {
                self.done.octree = None;
                self.done.object_numbers = false;
                self.done.links.clear();
                self.done.emission = false;
                self.done.light = None;
                self.done.irradiance = false;
                self.done.diffuse = None;
                self.done.specular = None;
                // What was marched went through the leaves of before.
                self.done.direct = self.done.direct.take().filter(|lit| lit.lighting.shadows != Shadows::March);
                self.done.view = None;
            }
            Which::Other => self.done.other = None,
        }
        self.done.compared = None;
        let gpu = Arc::clone(&self.gpu);
        let shape = (discretization.depth(), discretization.dense_level(), filter);
        Ok(self.octree(which).record_masks(&gpu, &voxels, shape)?)
    }

    /// Neighbour pointers that the settings follow or show.
    pub(super) fn wanted_pointers(&self, wanted: &Wanted) -> Vec<PointerLayout> {
        let look = &wanted.settings.look;
        let followed = match look.view {
            View::Slice => sample::pointer_layout(look.slice.lookup),
            View::Surfaces => sample::pointer_layout(wanted.settings.cone_tracing.lookup),
            View::Voxels | View::Mesh | View::Ghost | View::ShadowMap => None,
        };
        let shown = look.pointers.then_some(PointerLayout::Blocks);
        [followed, shown.filter(|shown| followed != Some(*shown))].into_iter().flatten().collect()
    }

    pub(super) fn links_missing(&self, wanted: &Wanted) -> bool {
        self.wanted_pointers(wanted).iter().any(|layout| !self.done.links.contains(layout))
    }

    pub(super) fn record_links(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let octree = self.shown.sizes_on_gpu()?.clone();
        let linked = self.shown.linked()?;
        for layout in self.wanted_pointers(wanted) {
            let slot = match layout {
                PointerLayout::Blocks => &mut self.shown.buffers.neighbours,
                PointerLayout::Nodes => &mut self.shown.buffers.node_neighbours,
            };
            let neighbours = slot.ensure(&self.gpu, "neighbour pointers", 4 * layout.words(&octree.params))?;
            link::record(&self.gpu, &mut frame, &octree, &linked, (layout, &neighbours));
        }
        Ok(frame)
    }

    pub(super) fn record_comparison(&mut self, which: Which) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let exact = self.exact_bits()?;
        let counts = self.counts_buffer()?;
        let moved = self.octree(which).buffers.masks.leaf_bits.made("leaf bits")?;
        compare_sets::record(&self.gpu, &mut frame, &moved, &exact, &counts);
        Ok(frame)
    }

    /// The exact set on the GPU, uploaded when it is first compared or shown.
    pub(super) fn exact_bits(&mut self) -> Result<GpuBuffer, EngineError> {
        let exact = self.exact.clone().ok_or_else(|| missing("exact bits"))?;
        if let Some((uploaded, buffer)) = &self.exact_bits
            && Arc::ptr_eq(uploaded, &exact)
        {
            return Ok(buffer.clone());
        }
        let buffer = self.gpu.upload("exact bits", &exact.bits)?;
        self.exact_bits = Some((exact, buffer.clone()));
        Ok(buffer)
    }

    pub(super) fn counts_buffer(&mut self) -> Result<GpuBuffer, GpuError> {
        self.comparison_counts.ensure(&self.gpu, "comparison counts", 4 * compare_sets::COUNT_WORDS)
    }
}
