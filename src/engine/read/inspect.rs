//! One node of the octree that is shown: which one a pixel shows, and all that is stored of it, its
//! pointers followed (section 4.4). In: a pixel, or an address. Out: [`NodeFacts`]. Every answer is a
//! handful of small reads that block: for a person who looks at one node, while nothing is drawn.

use std::sync::Arc;

use serde::Serialize;

use super::super::parts::light::Light;
use super::super::parts::links::BlockLinks;
use super::super::parts::topology::Topology;
use super::super::state::FinishedFrame;
use super::super::{Engine, EngineError};
use super::node_reader::{NodeAddress, NodeReader, Payload};
use crate::data::light::LIGHT_BYTES;
use crate::gpu::GpuError;
use crate::settings::View;
use crate::stages::pixels::camera::PixelRays;
use crate::stages::pixels::shown_level;

/// A node that a pointer leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct StoredNode {
    /// Among all stored nodes.
    pub index: u32,
    /// As its own block says.
    pub address: NodeAddress,
    /// Nothing is in it.
    pub is_dummy: bool,
}

/// What is stored of a node.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NodeFacts {
    pub node: StoredNode,
    /// Morton key on its level.
    pub key: u32,
    /// The block of eight that it lies in; `None` on the dense levels.
    pub block: Option<u32>,
    /// The first of its eight children; `None` for leaves, and where nothing below is stored.
    pub first_child: Option<StoredNode>,
    /// The nodes ahead along x, y, z; `None` where nothing is stored there, or the grid ends.
    pub forward: [Option<StoredNode>; 3],
    /// The eight nodes that a place between this node's centre and the next ones is interpolated from,
    /// x fastest: itself, and what its pointers and theirs lead to.
    pub corners: [Option<StoredNode>; 8],
    /// `false`: no pointers are stored, so that neighbours across a block's border are not known.
    pub has_pointers: bool,
    /// 0 to 1.
    pub occupancy: f64,
    /// Linear.
    pub albedo: [f64; 3],
    /// Mean: short where normals disagree.
    pub normal: [f64; 3],
    /// Mean, nits, linear RGB; `None` while no light is computed.
    pub radiance: Option<[f64; 3]>,
}

impl Engine {
    /// Which node of the level that is shown a pixel of the picture shows: the one where half of the
    /// light is stopped. `None` where nothing is, and while another picture is on its way. `pixel`: of
    /// the picture as it was requested, from its upper left corner. Blocks.
    pub fn node_at(&self, pixel: [u32; 2]) -> Result<Option<NodeAddress>, EngineError> {
        let Some(on_screen) = self.on_screen.as_ref().filter(|_| self.is_at_rest()) else { return Ok(None) };
        let (request, picture) = (&on_screen.request, &on_screen.picture);
        let (shot, look) = (&request.shot, &request.settings().method.look);
        if look.view == View::ShadowMap {
            return Ok(None);
        }
        let Some(distance) = picture.read_distance(&self.gpu, pixel)? else { return Ok(None) };
        let rays = PixelRays::new(&shot.camera, request.grid(), shot.size_px);
        let depth = request.grid().depth;
        Ok(cell_at(&rays, pixel, distance.into(), (shown_level(look, depth), depth)))
    }

    /// All that is stored of a node; `None` where no node is stored. Blocks.
    pub fn node_facts(&self, address: NodeAddress) -> Result<Option<NodeFacts>, EngineError> {
        let Some(reader) = self.node_reader().filter(|reader| address.is_in(reader.octree.depth)) else {
            return Ok(None);
        };
        let Some(index) = reader.index_of(address)? else { return Ok(None) };
        let level = address.level;
        let has_pointers = level <= reader.octree.dense_level || reader.neighbours.get().is_some();
        let node = stored(&reader, level, index)?;
        let corners = corners(&reader, level, node, has_pointers)?;
        let (light, payload) = match node.is_dummy {
            true => (None, Payload::default()),
            false => {
                let (entry, payload) = reader.payload(address, index)?;
                (self.radiance_of(entry)?, payload)
            }
        };
        let first_child = reader.first_child(level, index)?;
        Ok(Some(NodeFacts {
            node,
            key: crate::data::grid::morton_key(address.cell),
            block: reader.place(level, index).map(|(block, _)| block),
            first_child: first_child.map(|child| stored(&reader, level + 1, child)).transpose()?,
            forward: [corners[1], corners[2], corners[4]],
            corners,
            has_pointers,
            occupancy: payload.occupancy,
            albedo: payload.albedo,
            normal: payload.normal,
            radiance: light,
        }))
    }

    /// Nothing is being built or drawn, and what is shown is what was asked for last.
    fn is_at_rest(&self) -> bool {
        let is_shown =
            |shown: &FinishedFrame| self.wanted.as_ref().is_some_and(|wanted| Arc::ptr_eq(wanted, &shown.request));
        self.frame.is_none() && self.shown.as_ref().is_some_and(is_shown)
    }

    fn node_reader(&self) -> Option<NodeReader<'_>> {
        let keys = self.shown.as_ref().filter(|_| self.is_at_rest())?.keys.first()?;
        let built = self.shown_octree()?;
        let topology = &self.parts.finished::<Topology>(keys)?.buffers;
        let links = self.parts.finished::<BlockLinks>(keys);
        let neighbours = links.map(|links| links.neighbours.clone()).unwrap_or_default();
        Some(NodeReader { gpu: &self.gpu, octree: &built.counts.params, built, topology, neighbours })
    }

    /// Mean radiance of an entry of the stored light.
    fn radiance_of(&self, entry: u32) -> Result<Option<[f64; 3]>, GpuError> {
        let keys = self.shown.as_ref().and_then(|shown| shown.keys.first());
        let light = keys.and_then(|keys| self.parts.finished::<Light>(keys)?.light.get());
        let Some(light) = light else { return Ok(None) };
        let first = LIGHT_BYTES * u64::from(entry);
        let stored: Vec<f32> = self.gpu.read(light, first..first + LIGHT_BYTES)?;
        let opacity = f64::from(stored[3]);
        Ok((opacity > 0.0).then(|| [0, 1, 2].map(|channel| f64::from(stored[channel]) / opacity)))
    }
}

fn stored(reader: &NodeReader<'_>, level: u32, index: u32) -> Result<StoredNode, GpuError> {
    let address = reader.address_of(level, index)?;
    Ok(StoredNode { index, address, is_dummy: !reader.is_occupied(address)? })
}

/// Each corner is one hop ahead of the one without its highest bit.
fn corners(
    reader: &NodeReader<'_>,
    level: u32,
    node: StoredNode,
    has_pointers: bool,
) -> Result<[Option<StoredNode>; 8], GpuError> {
    let mut corners = [None; 8];
    corners[0] = Some(node);
    for corner in 1..8_usize {
        let axis = corner.ilog2();
        let before: Option<StoredNode> = corners[corner ^ 1 << axis].filter(|_| has_pointers);
        let ahead = before.map(|before| reader.ahead(level, before.index, axis)).transpose()?.flatten();
        corners[corner] = ahead.map(|index| stored(reader, level, index)).transpose()?;
    }
    Ok(corners)
}

/// The cell of a level that begins at a distance from the eye; `None` outside the grid.
fn cell_at(rays: &PixelRays, pixel: [u32; 2], distance: f64, (level, depth): (u32, u32)) -> Option<NodeAddress> {
    // A ray enters a cell where its distance is told: a little further it is inside, whatever was rounded.
    const FURTHER_CELLS: f64 = 1e-3;
    const FURTHER_SHARE: f64 = 1e-6;
    let ray = rays.ray(pixel.map(|at| f64::from(at) + 0.5));
    let t = distance - ray.start_cells + FURTHER_CELLS + FURTHER_SHARE * distance;
    let place = (ray.origin + ray.direction * t) / f64::from(1_u32 << (depth - level));
    let inside =
        place.cmpge(glam::DVec3::ZERO).all() && place.cmplt(glam::DVec3::splat(f64::from(1_u32 << level))).all();
    inside.then(|| NodeAddress { level, cell: place.as_uvec3().to_array() })
}
