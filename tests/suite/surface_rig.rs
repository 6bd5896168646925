//! Surface images of small scenes, for tests of what the camera sees and of direct light.

use std::sync::Arc;
use std::time::Duration;

use glam::DVec3;
use octolume::data::grid::Grid;
use octolume::data::mesh::{MeshScene, PosedMesh, Textures};
use octolume::data::octree::Slot;
use octolume::data::surface_image::{SurfaceImage, SurfaceTexel};
use octolume::gpu::{Gpu, Job, Recorder};
use octolume::lights::PosedLight;
use octolume::scene::{Aabb, OrbitCamera, Pose, Scene};
use octolume::settings::{Hidden, Look};
use octolume::stages::light::LitOctree;
use octolume::stages::light::illuminate::LightParams;
use octolume::stages::light::shadow::{ShadowMap, ShadowParams};
use octolume::stages::pixels::camera::PixelRays;
use octolume::stages::pixels::projection;
use octolume::stages::pixels::{NO_DEPTH, ViewParams, picture};
use octolume::stages::surface::draw::{self, Viewpoint};
use octolume::stages::surface::{Lit, direct, direct_march, emission};
use octolume::stages::textures::halve::record_levels;

use crate::device::gpu;
use crate::mesh_rig::FARTHEST;
use crate::stage_rig::{buffer, read, run};

/// What a test looks at.
pub struct Shot<'a> {
    pub scene: &'a Scene,
    pub pose: Pose,
    pub camera: OrbitCamera,
    pub grid: Grid,
    pub size_px: [u32; 2],
    /// Of an emissive factor of 1, nits.
    pub emission: f64,
}

/// What it sees: texels, and the image they came from.
pub struct Surfaces {
    pub image: SurfaceImage,
    pub texels: Vec<SurfaceTexel>,
}

/// What hides a light.
pub enum Hiding<'a> {
    Nothing,
    /// Of all triangles; texels a side.
    Map(u32),
    Leaves(&'a LitOctree, f64),
}

fn uploaded(gpu: &Gpu, scene: &Scene) -> MeshScene {
    let objects = (0..).zip(scene.objects()).collect();
    let mut mesh = MeshScene::new(Arc::new(scene.clone()), objects, record_levels);
    while !mesh.upload(gpu, (&Hidden::default(), Textures::All), Duration::ZERO).expect("fits") {}
    mesh
}

impl<'a> Shot<'a> {
    /// The scene at rest.
    pub fn new(scene: &'a Scene, camera: OrbitCamera, grid: Grid, size_px: [u32; 2]) -> Self {
        Self { scene, pose: scene.pose(None, 0.0), camera, grid, size_px, emission: 1.0 }
    }

    pub fn rays(&self) -> PixelRays {
        PixelRays::new(&self.camera, &self.grid, self.size_px)
    }

    pub fn view(&self) -> ViewParams {
        ViewParams::new(&self.rays(), &Look::default(), self.grid.depth)
    }

    /// Uploads and records.
    pub fn recorded(&self, gpu: &Gpu) -> (Recorder, SurfaceImage) {
        let mesh = uploaded(gpu, self.scene);
        let image = SurfaceImage::new(gpu, self.size_px).expect("fits");
        let depth = picture::depth_buffer(gpu, self.size_px).expect("fits");
        let camera_from_world = projection::camera_from_world(&self.camera, &self.grid);
        let of_pose = (&self.pose, &Hidden::default());
        let posed = PosedMesh::new(gpu, &mesh, &mut Slot::default(), of_pose, &camera_from_world).expect("fits");
        let mut frame = Recorder::default();
        let seen = Viewpoint { camera: &self.camera, grid: &self.grid, farthest: FARTHEST, emission: self.emission };
        draw::record(gpu, &mut frame, &posed, seen, (&image, &depth));
        (frame, image)
    }

    pub fn drawn(&self) -> Surfaces {
        let (frame, image) = self.recorded(gpu());
        Job::new(frame).run_to_end(gpu()).unwrap_or_else(|error| panic!("{error}"));
        Surfaces { texels: image.read(gpu()).expect("readable"), image }
    }

    /// Direct light of what was drawn, nits; the fourth number is 1 where something is.
    pub fn lit(&self, surfaces: &Surfaces, lights: &[PosedLight], hiding: &Hiding<'_>) -> Vec<[f32; 4]> {
        let pixels = u64::from(self.size_px[0] * self.size_px[1]);
        let sum = buffer(gpu(), "direct", 4 * pixels);
        let view = self.view();
        let lit = Lit { image: &surfaces.image, view: &view, direct: &sum };
        run(gpu(), |frame| emission::record(gpu(), frame, &lit));
        for light in lights {
            self.add(&lit, light, hiding);
        }
        read(gpu(), &sum, pixels)
    }

    fn add(&self, lit: &Lit<'_>, light: &PosedLight, hiding: &Hiding<'_>) {
        let params = |offset| LightParams::new(light, &self.grid, offset);
        match hiding {
            Hiding::Nothing => {
                let map = ShadowMap::new(gpu(), ShadowParams::default()).expect("small");
                run(gpu(), |frame| direct::record(gpu(), frame, lit, &params(0.0), &map));
            }
            Hiding::Map(size_px) => {
                let map = self.map(light, *size_px);
                run(gpu(), |frame| direct::record(gpu(), frame, lit, &params(0.0), &map));
            }
            Hiding::Leaves(octree, offset) => {
                run(gpu(), |frame| direct_march::record(gpu(), frame, lit, &params(*offset), octree));
            }
        }
    }

    fn map(&self, light: &PosedLight, size_px: u32) -> ShadowMap {
        let mesh = uploaded(gpu(), self.scene);
        let of_pose = (&self.pose, &Hidden::default());
        let to_grid = self.grid.grid_from_world();
        let posed = PosedMesh::new(gpu(), &mesh, &mut Slot::default(), of_pose, &to_grid).expect("fits");
        let params = ShadowParams::new(light, &self.grid, self.bounds(), size_px);
        let map = ShadowMap::new(gpu(), params).expect("fits");
        run(gpu(), |frame| map.record(gpu(), frame, &posed));
        map
    }

    fn bounds(&self) -> Option<Aabb> {
        let objects = self.scene.objects();
        let positions = objects.iter().flat_map(|object| {
            let primitives = 0..self.scene.meshes[object.mesh].primitives.len();
            primitives.flat_map(|primitive| self.scene.posed_positions(object, primitive, &self.pose))
        });
        positions.fold(None, |bounds: Option<Aabb>, p| {
            Some(bounds.map_or(Aabb { min: p, max: p }, |b| Aabb { min: b.min.min(p), max: b.max.max(p) }))
        })
    }

    /// Middle of a pixel, from the upper left corner of the picture.
    pub fn middle(&self, pixel: usize) -> [f64; 2] {
        let width = self.size_px[0] as usize;
        [(pixel % width) as f64 + 0.5, (pixel / width) as f64 + 0.5]
    }

    /// Where a texel's surface is, cells from the grid's corner, and the way to the eye.
    pub fn place(&self, pixel: usize, texel: &SurfaceTexel) -> (DVec3, DVec3) {
        let ray = self.rays().ray(self.middle(pixel));
        let t = f64::from(texel.distance_cells) - ray.start_cells;
        (ray.origin + ray.direction * t, -ray.direction)
    }
}

pub fn is_there(texel: &SurfaceTexel) -> bool {
    texel.distance_cells < NO_DEPTH
}
