//! What fragments look like: materials, and textures as voxelization reads them.

use bytemuck::{Pod, Zeroable};

use super::CellStore;
use crate::data::fragments::{FragmentCounts, PosedTriangles};
use crate::data::mesh::{TextureSlot, alpha_of};
use crate::gpu::{Constant, Counted, Gpu, GpuBuffer, Mirror, Recorder, constants, mirror};
use crate::scene::{Material, TextureRef, Wrap};

pub const WRAP_REPEAT: u32 = 0;
pub const WRAP_MIRRORED: u32 = 1;
pub const WRAP_CLAMP: u32 = 2;

pub const CONSTANTS: &[Constant] = constants![
    integer WRAP_REPEAT,
    integer WRAP_MIRRORED,
];

/// Mirror of `SurfaceTexture` in shaders/shared/surface_texture.wgsl. All zero: white.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SurfaceTexture {
    pub slot: TextureSlot,
    pub size: [u32; 2],
    pub first_level: u32,
    pub end_level: u32,
    pub wrap: [u32; 2],
    pub nearest: u32,
    pub is_covering: u32,
    pub first_word: u32,
    pub pad: [u32; 3],
}

/// Mirror of `SurfaceMaterial` in shaders/voxelize/shade.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SurfaceMaterial {
    pub base_color: [f32; 4],
    pub emissive: [f32; 3],
    pub alpha_mode: u32,
    pub base_color_texture: SurfaceTexture,
    pub emissive_texture: SurfaceTexture,
    pub cutoff: f32,
    pub pad: [u32; 3],
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(
        SurfaceTexture,
        "shared/surface_texture.wgsl",
        "SurfaceTexture",
        slot,
        size,
        first_level,
        end_level,
        wrap,
        nearest,
        is_covering,
        first_word,
        pad
    ),
    mirror!(
        SurfaceMaterial,
        "voxelize/shade.wgsl",
        "SurfaceMaterial",
        base_color,
        emissive,
        alpha_mode,
        base_color_texture,
        emissive_texture,
        cutoff,
        pad
    ),
];

impl SurfaceTexture {
    /// `levels` says where a texture's levels begin, how large its image is, and which of its levels are there.
    pub(super) fn new(slot: TextureRef, (wrap, nearest): ([Wrap; 2], bool), levels: &Self) -> Self {
        let number = |wrap: Wrap| match wrap {
            Wrap::Repeat => WRAP_REPEAT,
            Wrap::MirroredRepeat => WRAP_MIRRORED,
            Wrap::ClampToEdge => WRAP_CLAMP,
        };
        Self {
            slot: TextureSlot::new(Some(slot), true),
            wrap: wrap.map(number),
            nearest: u32::from(nearest),
            ..*levels
        }
    }
}

impl SurfaceMaterial {
    /// `brightest`: of the scene, nits; 0: nothing emits.
    pub(super) fn new(material: &Material, brightest: f32, textures: [SurfaceTexture; 2]) -> Self {
        let [base_color_texture, emissive_texture] = textures;
        let (alpha_mode, cutoff) = alpha_of(material);
        let in_units = |nits: f32| if brightest > 0.0 { nits / brightest } else { 0.0 };
        Self {
            base_color: material.base_color,
            emissive: material.emissive.map(in_units),
            alpha_mode,
            cutoff,
            base_color_texture,
            emissive_texture,
            pad: [0; 3],
        }
    }
}

/// `materials`, and the levels of textures that they name.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    triangles: &PosedTriangles,
    (materials, texels): (&GpuBuffer, &GpuBuffer),
    store: &CellStore,
) {
    let kernel = gpu.kernel("voxelize/shade.wgsl", &store.constants());
    let fragment_bytes = store.fragment_bytes();
    for batch in &triangles.batches {
        let pass = triangles.bind(frame.pass(&kernel), batch);
        pass.uniform("room", &store.room)
            .bind("counts", &store.counts)
            .bind("materials", materials)
            .bind("texels", texels)
            .bind("fragments", &store.fragments)
            .counted(&store.counts, move |counts: &FragmentCounts| Counted {
                threads: u64::from(counts.fragments),
                bytes: u64::from(counts.fragments) * (fragment_bytes + 20),
            })
            .dispatch(u64::from(store.room.fragments));
    }
}
