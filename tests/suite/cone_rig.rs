//! Surface images made by the CPU, and cones from them: what a camera would see, without triangles.

use glam::DVec3;
use octolume::data::grid::Grid;
use octolume::data::surface_image::{SurfaceImage, SurfaceTexel};
use octolume::gpu::Gpu;
use octolume::scene::OrbitCamera;
use octolume::settings::Look;
use octolume::stages::cones::blur_ref::FilterPoint;
use octolume::stages::cones::diffuse::{self, DiffuseCones, DiffuseParams, DiffuseTerms};
use octolume::stages::cones::diffuse_ref::SurfacePoint;
use octolume::stages::cones::{ConesInput, Surfaces, image_bytes};
use octolume::stages::pixels::camera::{PixelRay, PixelRays};
use octolume::stages::pixels::{NO_DEPTH, ViewParams};
use octolume::stages::sample::{SampledOctree, Sampler};

use crate::stage_rig::{buffer, read, run};

/// A pixel without a surface.
pub const NOTHING: SurfaceTexel = SurfaceTexel {
    distance_cells: NO_DEPTH,
    normal: DVec3::Z,
    face: DVec3::Z,
    albedo: [0.0; 3],
    roughness: 1.0,
    metallic: 0.0,
    emission_nits: [0.0; 3],
};

/// A dull surface that faces along `normal`, at `distance_cells` from the eye.
pub fn dull(distance_cells: f64, normal: DVec3) -> SurfaceTexel {
    let distance_cells = distance_cells as f32;
    SurfaceTexel { distance_cells, normal, face: normal, albedo: [0.5; 3], ..NOTHING }
}

/// Distance from the eye at which a ray meets the plane through `point`, from its front.
pub fn plane_distance(ray: &PixelRay, point: DVec3, normal: DVec3) -> Option<f64> {
    let t = (point - ray.origin).dot(normal) / ray.direction.dot(normal);
    (ray.direction.dot(normal) < 0.0 && t > 0.0).then_some(ray.start_cells + t)
}

/// A point of the grid in the scene.
fn world(grid: &Grid, cells: DVec3) -> DVec3 {
    grid.corner() + cells * grid.span
}

/// Side of the images of [`spot`]: a whole pattern of any size.
pub const SPOT_PX: u32 = 4;

/// A few pixels that all see the same point of a plane.
pub fn spot(gpu: &Gpu, grid: &Grid, point: DVec3, face: DVec3) -> Photo {
    // Aside of the face, whichever axis is up.
    let eye = world(grid, point + 20.0 * (face + DVec3::new(0.02, 0.03, 0.025)).normalize());
    let camera = OrbitCamera::new(eye, world(grid, point), 0.001);
    Photo::new(gpu, (grid, &camera), [SPOT_PX; 2], |_, ray| {
        plane_distance(ray, point, face).map_or(NOTHING, |distance| dull(distance, face))
    })
}

/// Mean of all pixels.
pub fn mean(image: &[[f32; 4]]) -> [f64; 4] {
    [0, 1, 2, 3].map(|channel| image.iter().map(|pixel| f64::from(pixel[channel])).sum::<f64>() / image.len() as f64)
}

/// Surfaces on the GPU with what was stored of them.
pub struct Photo {
    pub rays: PixelRays,
    pub view: ViewParams,
    pub image: SurfaceImage,
    pub texels: Vec<SurfaceTexel>,
}

impl Photo {
    /// `seen`: what the ray of pixel (x, y) meets.
    pub fn new(
        gpu: &Gpu,
        (grid, camera): (&Grid, &OrbitCamera),
        size_px: [u32; 2],
        seen: impl Fn([u32; 2], &PixelRay) -> SurfaceTexel,
    ) -> Self {
        let rays = PixelRays::new(camera, grid, size_px);
        let pixels = (0..size_px[1]).flat_map(|y| (0..size_px[0]).map(move |x| [x, y]));
        let texels: Vec<_> = pixels.map(|pixel| seen(pixel, &ray(&rays, pixel))).collect();
        let image = SurfaceImage::new(gpu, size_px).unwrap_or_else(|error| panic!("{error}"));
        image.write(gpu, &texels);
        let stored = |texel: &SurfaceTexel| {
            let (near, stuff) = texel.encode();
            SurfaceTexel::decode(near, stuff)
        };
        let texels = texels.iter().map(stored).collect();
        Self { rays, view: ViewParams::new(&rays, &Look::default(), grid.depth), image, texels }
    }

    pub fn surfaces(&self) -> Surfaces<'_> {
        Surfaces { image: &self.image, view: &self.view }
    }

    pub fn size_px(&self) -> [u32; 2] {
        self.image.size_px()
    }

    pub fn texel(&self, [x, y]: [u32; 2]) -> Option<&SurfaceTexel> {
        let texel = &self.texels[(y * self.size_px()[0] + x) as usize];
        (texel.distance_cells < NO_DEPTH).then_some(texel)
    }

    pub fn point(&self, pixel: [u32; 2]) -> Option<SurfacePoint> {
        let texel = self.texel(pixel)?;
        let ray = ray(&self.rays, pixel);
        let position = ray.origin + ray.direction * (f64::from(texel.distance_cells) - ray.start_cells);
        Some(SurfacePoint { position, normal: texel.normal, face: texel.face })
    }

    pub fn filter_point(&self, pixel: [u32; 2]) -> Option<FilterPoint> {
        let (texel, point) = (self.texel(pixel)?, self.point(pixel)?);
        let ray = ray(&self.rays, pixel);
        let distance = f64::from(texel.distance_cells);
        Some(FilterPoint {
            position: point.position,
            normal: texel.normal,
            face: texel.face,
            distance,
            pixel_cells: ray.width + (distance - ray.start_cells) * ray.widening,
        })
    }
}

/// The ray through a pixel's middle.
pub fn ray(rays: &PixelRays, [x, y]: [u32; 2]) -> PixelRay {
    rays.ray([f64::from(x) + 0.5, f64::from(y) + 0.5])
}

/// The surface pixel that a pixel of a smaller image stands for.
pub fn source(photo: &Photo, pixel: [u32; 2], size_px: [u32; 2]) -> [u32; 2] {
    let large = photo.size_px();
    [0, 1].map(|axis| octolume::stages::cones::upsample_ref::source(pixel[axis], size_px[axis], large[axis]))
}

/// The diffuse image of a photo: radiance and open share of each pixel.
pub fn diffuse(
    gpu: &Gpu,
    (octree, sampler): (&SampledOctree, &Sampler),
    photo: &Photo,
    (cones, terms): (&DiffuseCones, DiffuseTerms),
    (sky, size_px): ([f32; 3], [u32; 2]),
) -> Vec<[f32; 4]> {
    let image = buffer(gpu, "diffuse", image_bytes(size_px) / 4);
    let input = ConesInput { octree, surfaces: photo.surfaces() };
    let params = DiffuseParams::new(cones, sky, size_px);
    run(gpu, |frame| diffuse::record(gpu, frame, &input, (sampler, terms), &params, &image));
    read(gpu, &image, image_bytes(size_px) / 16)
}
