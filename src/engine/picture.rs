//! The picture of a frame: which view draws it, from which camera.

use std::sync::Arc;
use std::time::Duration;

use super::{Engine, EngineError, Wanted, missing};
use crate::color::srgb_byte;
use crate::data::octree::{OctreeParams, OctreeSizes, Slot};
use crate::gpu::{GpuError, GpuTexture, Recorder};
use crate::settings::View;
use crate::stages::build::COUNTERS;
use crate::stages::build::reduce::{self, Masks};
use crate::stages::mesh::{MeshScene, PosedMesh, Textures};
use crate::stages::view::camera::PixelRays;
use crate::stages::view::ghost::{self, LeafSet};
use crate::stages::view::march::{self, MarchedOctree};
use crate::stages::view::mesh::{self, MeshTarget, MeshView};
use crate::stages::view::picture::depth_buffer;
use crate::stages::view::{BACKGROUND, GHOST_COLORS, Palette, Picture, ViewParams, shown_color};

/// The masks above the exact leaves. Blocks and counters are by-products nobody reads.
#[derive(Debug, Default)]
pub struct ExactMasks {
    occupied: Slot,
    blocks: Slot,
    counters: Slot,
}

impl Engine {
    pub(super) fn record_exact_masks(&mut self) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let leaf_bits = self.exact_bits()?;
        let depth = self.shown.params.depth;
        let octree = OctreeParams::new(depth, depth - 1);
        let gpu = &self.gpu;
        let sizes = OctreeSizes::upload(gpu, &octree)?;
        let own = &mut self.exact_masks;
        let masks = Masks {
            leaf_bits,
            occupied: own.occupied.ensure(gpu, "exact occupied masks", 4 * u64::from(octree.occupied_words()))?,
            blocks: own.blocks.ensure(gpu, "exact block masks", 4 * u64::from(octree.blocks_words()))?,
            counters: own.counters.ensure(gpu, "exact counters", 8 * u64::from(COUNTERS))?,
        };
        for level in (0..depth).rev() {
            reduce::record(gpu, &mut frame, &sizes, &masks, level);
        }
        Ok(frame)
    }

    pub(super) fn record_picture(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let picture = self.ensure_picture(wanted.size_px)?;
        let grid = self.prepared.as_ref().ok_or(EngineError::NoScene)?.grid;
        let rays = PixelRays::new(&wanted.camera, &grid, wanted.size_px);
        let look = &wanted.settings.look;
        match look.view {
            View::Voxels if self.plan.shows_light() => {
                self.record_light_view(&mut frame, wanted, (&rays, &picture))?;
            }
            View::Voxels => {
                let octree = self.marched_octree()?;
                let palette = Palette::new(shown_color(look, grid.depth));
                let view = ViewParams::new(&rays, look, grid.depth);
                march::record(&self.gpu, &mut frame, &octree, (&view, &palette), &picture);
            }
            View::Ghost => {
                let leaves = crate::settings::Look { level: None, ..*look };
                let view = ViewParams::new(&rays, &leaves, grid.depth);
                let (moved, exact) = self.ghost_sets()?;
                let octree = self.shown.sizes_on_gpu()?.clone();
                ghost::record(&self.gpu, &mut frame, &octree, (&moved, &exact), (&view, &GHOST_COLORS), &picture);
            }
            View::Mesh => self.record_mesh(&mut frame, wanted, &picture)?,
            View::Slice => self.record_slice(&mut frame, wanted, (&rays, &picture))?,
            View::ShadowMap => self.record_shadow_map(&mut frame, wanted, (&rays, &picture))?,
            View::Surfaces => self.record_surfaces(&mut frame, wanted, &picture)?,
        }
        Ok(frame)
    }

    fn record_mesh(&mut self, frame: &mut Recorder, wanted: &Wanted, picture: &Picture) -> Result<(), EngineError> {
        let prepared = self.prepared.clone().ok_or(EngineError::NoScene)?;
        let depth = self.mesh_depth(wanted.size_px)?;
        let mesh = self.mesh.as_ref().ok_or_else(|| missing("mesh vertices"))?;
        let camera_from_world = mesh::camera_from_world(&wanted.camera, &prepared.grid);
        let of_pose = (&*wanted.placed.pose, &wanted.placed.hidden);
        let posed = PosedMesh::new(&self.gpu, mesh, &mut self.mesh_matrices, of_pose, &camera_from_world)?;
        let seen = MeshView { camera: &wanted.camera, grid: &prepared.grid, look: &wanted.settings.look };
        mesh::record(&self.gpu, frame, &posed, seen, MeshTarget { picture, depth: &depth });
        Ok(())
    }

    /// Uploads what is drawn of the triangles, for about `budget`; says whether all is there.
    pub(super) fn upload_mesh(&mut self, wanted: &Wanted, budget: Duration) -> Result<bool, EngineError> {
        let prepared = self.prepared.as_ref().ok_or(EngineError::NoScene)?;
        let objects = || prepared.objects.iter().zip(0..).map(|(object, number)| (number, object.object.clone()));
        let mesh = self.mesh.get_or_insert_with(|| MeshScene::new(Arc::clone(&prepared.scene), objects().collect()));
        let view = wanted.settings.look.view;
        let textures = if view == View::Surfaces { Textures::All } else { Textures::BaseColor };
        Ok(mesh.upload(&self.gpu, (&wanted.placed.hidden, textures), budget)?)
    }

    fn mesh_depth(&mut self, size_px: [u32; 2]) -> Result<GpuTexture, GpuError> {
        if let Some(depth) = &self.mesh_depth
            && depth.size_px() == size_px
        {
            return Ok(depth.clone());
        }
        Ok(self.mesh_depth.insert(depth_buffer(&self.gpu, size_px)?).clone())
    }

    fn marched_octree(&self) -> Result<MarchedOctree, GpuError> {
        MarchedOctree::new(self.shown.octree()?, self.shown.buffers.leaf_objects.get())
    }

    fn ghost_sets(&mut self) -> Result<(LeafSet, LeafSet), EngineError> {
        let b = &self.shown.buffers.masks;
        let moved = LeafSet { leaf_bits: b.leaf_bits.made("leaf bits")?, occupied: b.occupied.made("occupied masks")? };
        let occupied = self.exact_masks.occupied.made("exact occupied masks")?;
        Ok((moved, LeafSet { leaf_bits: self.exact_bits()?, occupied }))
    }

    fn ensure_picture(&mut self, size_px: [u32; 2]) -> Result<Picture, GpuError> {
        if let Some(picture) = &self.picture
            && picture.size_px() == size_px
        {
            return Ok(picture.clone());
        }
        Ok(self.picture.insert(Picture::new(&self.gpu, size_px)?).clone())
    }

    /// The picture, gamma-encoded sRGB; `None` before the first, and where nothing is to be seen.
    pub fn image(&self) -> Option<&GpuTexture> {
        let picture = self.picture.as_ref().filter(|_| !self.shows_nothing());
        picture.map(|picture| &picture.color)
    }

    /// The picture's pixels, all background where nothing is to be seen. Blocks until they are here.
    pub fn read_image(&self) -> Result<image::RgbaImage, EngineError> {
        if let Some(wanted) = self.wanted.as_ref().filter(|wanted| wanted.shows_nothing()) {
            let [width, height] = wanted.size_px;
            return Ok(image::RgbaImage::from_pixel(width, height, background_pixel()));
        }
        Ok(self.picture.as_ref().ok_or_else(|| missing("picture"))?.read(&self.gpu)?)
    }
}

fn background_pixel() -> image::Rgba<u8> {
    let [r, g, b] = BACKGROUND.map(srgb_byte);
    image::Rgba([r, g, b, u8::MAX])
}
