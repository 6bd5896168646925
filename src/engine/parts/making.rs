//! What a part is made with: the request, the method that calls for it, the keys of its inputs.

use super::Parts;
use crate::data::mesh::PosedMesh;
use crate::data::octree::{OctreeRef, OctreeSizes, PointerLayout, Slot};
use crate::data::pages::SegmentOrder;
use crate::engine::EngineError;
use crate::engine::request::{Method, Request};
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::plan::{Key, Keys, Part, Pass, calls_for};
use crate::settings::{Look, Lookup};
use crate::stages::pixels::ViewParams;
use crate::stages::pixels::camera::PixelRays;
use crate::stages::sample::pointer_layout;

#[derive(Clone, Copy)]
pub struct Making<'a> {
    pub gpu: &'a Gpu,
    pub request: &'a Request,
    pub method: &'a Method,
    pub keys: &'a Keys,
    pub part: Part,
    /// Its number among what the frame makes.
    pub number: usize,
    pub order: SegmentOrder,
    /// Of what is likely to be counted; 1 but in tests.
    pub estimated_share: f64,
}

/// Passes of a part are told apart by the low bits of their group.
const PASS_BITS: u32 = 8;

/// The number of the part that ran a group of commands, and which pass it was.
pub fn part_and_pass(group: u32) -> (usize, Option<Pass>) {
    let pass = Pass::ALL.get((group & ((1 << PASS_BITS) - 1)) as usize).copied();
    ((group >> PASS_BITS) as usize, pass)
}

impl Making<'_> {
    /// Commands recorded from here on belong to this pass.
    pub fn begin(&self, frame: &mut Recorder, pass: Pass) {
        frame.begin((self.number as u32) << PASS_BITS | pass as u32);
    }

    pub fn key(&self, part: Part) -> Result<&Key, EngineError> {
        Ok(self.keys.get(part).ok_or_else(|| GpuError::Missing { label: format!("{part:?}") })?)
    }

    /// Of the part itself. The plan has it: else the part would not be made.
    pub fn own_key(&self) -> Result<&Key, EngineError> {
        self.key(self.part)
    }

    /// The method calls for this pass of a part that is made.
    pub fn runs(&self, pass: Pass) -> bool {
        calls_for(pass, &self.method.asked)
    }

    /// Rays of the picture's pixels.
    pub fn view(&self) -> ViewParams {
        self.view_of(&self.method.settings().method.look)
    }

    pub fn view_of(&self, look: &Look) -> ViewParams {
        let (shot, grid) = (&self.request.shot, self.request.grid());
        ViewParams::new(&PixelRays::new(&shot.camera, grid, shot.size_px), look, grid.depth)
    }
}

impl Parts {
    /// Sizes of the method's octree: exact, or with room for what is likely.
    pub fn sizes(&self, making: &Making<'_>) -> Result<&OctreeSizes, EngineError> {
        let masks = self.masks.made(making.key(Part::Masks)?, "octree masks")?;
        Ok(masks.sizes().ok_or_else(|| GpuError::Missing { label: "octree sizes".to_owned() })?)
    }

    /// The method's octree as its readers bind it.
    pub fn octree(&self, making: &Making<'_>) -> Result<OctreeRef<'_>, EngineError> {
        Ok(OctreeRef {
            sizes: self.sizes(making)?,
            masks: &self.masks.made(making.key(Part::Masks)?, "octree masks")?.buffers,
            topology: &self.topology.made(making.key(Part::Topology)?, "octree nodes")?.buffers,
            payload: &self.payload.made(making.key(Part::Payload)?, "octree payload")?.buffers,
        })
    }

    /// The neighbour pointers that a look-up follows, where it follows any and they are linked.
    pub fn pointers(&self, keys: &Keys, lookup: Lookup) -> Option<GpuBuffer> {
        let links = match pointer_layout(lookup)? {
            PointerLayout::Blocks => self.block_links.get(keys.get(Part::BlockLinks)?),
            PointerLayout::Nodes => self.node_links.get(keys.get(Part::NodeLinks)?),
        };
        links?.neighbours.get().cloned()
    }

    /// The posed triangles of what is not hidden, in the space that is drawn in.
    pub fn posed_mesh(
        &self,
        making: &Making<'_>,
        matrices: &mut Slot,
        space_from_world: &glam::DMat4,
    ) -> Result<PosedMesh<'_>, EngineError> {
        let mesh = self.mesh.as_ref().ok_or_else(|| GpuError::Missing { label: "mesh vertices".to_owned() })?;
        let shot = &making.request.shot;
        Ok(PosedMesh::new(making.gpu, mesh, matrices, (&shot.pose, &shot.hidden), space_from_world)?)
    }
}
