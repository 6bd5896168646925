//! What the camera sees, a pixel each, in two textures of four words. `shaders/shared/surface.wgsl` is the
//! mirror.
//!
//! ```text
//! near   x  distance from the eye along the pixel's ray, cells, f32; NO_DEPTH where nothing is
//!        y  shading normal, octahedral, 16 | 16
//!        z  normal of the triangle on the eye's side, octahedral, 16 | 16
//!        w  albedo red | green, 16-bit shares
//! stuff  x  albedo blue, 16-bit share | roughness, 8 bits | metallic, 8 bits
//!        yzw  emission, nits, linear RGB, f32
//! ```
//!
//! Normals are in the axes of the grid, which are the world's. Albedo is the material's base colour;
//! surfaces without shading (KHR_materials_unlit) have none, and emit it.

use glam::{DVec2, DVec3};

use crate::gpu::{Gpu, GpuError, GpuTexture};

pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

const U16: f64 = 65535.0;
const U8: f64 = 255.0;

/// Both textures, of one size.
#[derive(Clone, Debug)]
pub struct SurfaceImage {
    pub near: GpuTexture,
    pub stuff: GpuTexture,
}

impl SurfaceImage {
    /// The error names the size where a side is zero or beyond the device's limit.
    pub fn new(gpu: &Gpu, size_px: [u32; 2]) -> Result<Self, GpuError> {
        let texture = |label| {
            use wgpu::TextureUsages as Usage;
            gpu.texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size_px[0], height: size_px[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: FORMAT,
                usage: Usage::RENDER_ATTACHMENT | Usage::TEXTURE_BINDING | Usage::COPY_SRC | Usage::COPY_DST,
                view_formats: &[],
            })
        };
        Ok(Self { near: texture("surface places")?, stuff: texture("surface materials")? })
    }

    pub fn size_px(&self) -> [u32; 2] {
        self.near.size_px()
    }

    /// All texels, rows from the top. Blocks until submitted work is done.
    pub fn read(&self, gpu: &Gpu) -> Result<Vec<SurfaceTexel>, GpuError> {
        let words =
            |texture| gpu.read_texture(texture).map(|bytes| bytemuck::pod_collect_to_vec::<u8, [u32; 4]>(&bytes));
        let (near, stuff) = (words(&self.near)?, words(&self.stuff)?);
        Ok(near.into_iter().zip(stuff).map(|(near, stuff)| SurfaceTexel::decode(near, stuff)).collect())
    }

    /// Replaces all texels; there must be as many as pixels.
    pub fn write(&self, gpu: &Gpu, texels: &[SurfaceTexel]) {
        let [width, height] = self.size_px();
        let (near, stuff): (Vec<_>, Vec<_>) = texels.iter().map(SurfaceTexel::encode).unzip();
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(16 * width), rows_per_image: None };
        for (texture, words) in [(&self.near, near), (&self.stuff, stuff)] {
            gpu.queue.write_texture(texture.raw().as_image_copy(), bytemuck::cast_slice(&words), layout, size);
        }
    }
}

/// One pixel's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceTexel {
    /// From the eye along the pixel's ray; [`crate::stages::pixels::NO_DEPTH`] where nothing is.
    pub distance_cells: f32,
    /// Unit length.
    pub normal: DVec3,
    /// Unit length, of the triangle, towards the eye.
    pub face: DVec3,
    /// Linear RGB, 0 to 1.
    pub albedo: [f64; 3],
    pub roughness: f64,
    pub metallic: f64,
    pub emission_nits: [f32; 3],
}

impl SurfaceTexel {
    pub fn encode(&self) -> ([u32; 4], [u32; 4]) {
        let share = |value: f64, most: f64| (value.clamp(0.0, 1.0) * most).round() as u32;
        let [r, g, b] = self.albedo.map(|channel| share(channel, U16));
        let [er, eg, eb] = self.emission_nits.map(f32::to_bits);
        let near =
            [self.distance_cells.to_bits(), pack_octahedral(self.normal), pack_octahedral(self.face), r | g << 16];
        (near, [b | share(self.roughness, U8) << 16 | share(self.metallic, U8) << 24, er, eg, eb])
    }

    pub fn decode(near: [u32; 4], stuff: [u32; 4]) -> Self {
        let share = |word: u32, shift: u32| f64::from(word >> shift & 0xffff) / U16;
        let byte = |shift: u32| f64::from(stuff[0] >> shift & 0xff) / U8;
        Self {
            distance_cells: f32::from_bits(near[0]),
            normal: unpack_octahedral(near[1]),
            face: unpack_octahedral(near[2]),
            albedo: [share(near[3], 0), share(near[3], 16), share(stuff[0], 0)],
            roughness: byte(16),
            metallic: byte(24),
            emission_nits: [stuff[1], stuff[2], stuff[3]].map(f32::from_bits),
        }
    }
}

/// A unit vector on the octahedron's net, 16 bits an axis: off by 4e-5 at most (Cigolle et al. 2014).
pub fn pack_octahedral(n: DVec3) -> u32 {
    let sum = n.abs().element_sum();
    let flat = DVec2::new(n.x, n.y) / sum;
    let folded = if n.z < 0.0 {
        DVec2::new((1.0 - flat.y.abs()).copysign(flat.x), (1.0 - flat.x.abs()).copysign(flat.y))
    } else {
        flat
    };
    let word = |value: f64| ((value * 0.5 + 0.5).clamp(0.0, 1.0) * U16).round() as u32;
    word(folded.x) | word(folded.y) << 16
}

pub fn unpack_octahedral(packed: u32) -> DVec3 {
    let part = |shift: u32| f64::from(packed >> shift & 0xffff) / U16 * 2.0 - 1.0;
    let (x, y) = (part(0), part(16));
    let z = 1.0 - x.abs() - y.abs();
    let folded = (-z).max(0.0);
    DVec3::new(x - folded.copysign(x), y - folded.copysign(y), z).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texel_comes_back() {
        for i in 0..1000 {
            let turn = f64::from(i) * 2.399;
            let z = 1.0 - (f64::from(i) + 0.5) / 500.0;
            let level = (1.0 - z * z).sqrt();
            let normal = DVec3::new(level * turn.cos(), level * turn.sin(), z);
            let texel = SurfaceTexel {
                distance_cells: i as f32 * 0.37,
                normal,
                face: -normal,
                albedo: [0.25, 0.5, f64::from(i) / 1000.0],
                roughness: 0.4,
                metallic: 1.0,
                emission_nits: [1e6, 0.0, 3.5],
            };
            let (near, stuff) = texel.encode();
            let back = SurfaceTexel::decode(near, stuff);
            assert!(back.normal.distance(normal) < 6e-5 && back.face.distance(-normal) < 6e-5, "{normal}");
            assert!(back.albedo.iter().zip(texel.albedo).all(|(a, b)| (a - b).abs() <= 0.5 / U16));
            assert!((back.roughness - 0.4).abs() <= 0.5 / U8 && back.metallic == 1.0);
            assert_eq!((back.distance_cells, back.emission_nits), (texel.distance_cells, texel.emission_nits));
        }
    }
}
