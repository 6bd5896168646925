//! What tests of the mesh view share: scenes of squares, a camera, and where its rays meet planes.

use std::sync::Arc;
use std::time::Duration;

use glam::{DMat4, DVec3, IVec3, Vec2, Vec3};
use octolume::color::gamma_from_linear;
use octolume::data::grid::Grid;
use octolume::data::mesh::{MeshScene, PosedMesh, Textures};
use octolume::data::octree::Slot;
use octolume::gpu::{Gpu, Job, Recorder};
use octolume::scene::{LocalTransform, Material, Mesh, Node, OrbitCamera, Primitive, Scene, Skin, Trs};
use octolume::settings::{Hidden, Look};
use octolume::stages::pixels::camera::PixelRays;
use octolume::stages::pixels::projection;
use octolume::stages::pixels::{BACKGROUND, Picture, picture};
use octolume::stages::textures::halve::record_levels;
use octolume::stages::view::mesh::{self, MeshTarget, MeshView};

pub const SIZE_PX: [u32; 2] = [64, 48];

pub fn grid() -> Grid {
    Grid { anchor: DVec3::ZERO, offset_cells: IVec3::splat(-8), span: 0.125, depth: 4 }
}

/// No scene reaches farther, scene units.
pub const FARTHEST: f64 = 1e3;

pub fn camera() -> OrbitCamera {
    OrbitCamera::new(DVec3::new(0.4, 0.7, 3.0), DVec3::ZERO, 40.0)
}

pub fn node(name: &str, translation: DVec3) -> Node {
    let local = LocalTransform::Trs(Trs { translation, ..Trs::default() });
    Node {
        name: name.to_owned(),
        parent: None,
        local,
        mesh: None,
        skin: None,
        camera: None,
        light: None,
        is_visible: true,
    }
}

/// A square of side 2 around the origin in the xy plane.
pub fn square() -> Primitive {
    Primitive {
        positions: vec![
            Vec3::new(-1.0, -1.0, 0.0),
            Vec3::new(1.0, -1.0, 0.0),
            Vec3::new(1.0, 1.0, 0.0),
            Vec3::new(-1.0, 1.0, 0.0),
        ],
        normals: vec![Vec3::Z; 4],
        tex_coords: [vec![Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 0.0)], vec![]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Primitive::default()
    }
}

pub fn scene(primitives: Vec<Primitive>, nodes: Vec<Node>) -> Scene {
    Scene { nodes, meshes: vec![Mesh { name: "mesh".to_owned(), primitives }], ..Scene::default() }
}

pub fn one_square(material: Material) -> Scene {
    let primitive = Primitive { material: Some(0), ..square() };
    Scene {
        materials: vec![material],
        ..scene(vec![primitive], vec![Node { mesh: Some(0), ..node("square", DVec3::ZERO) }])
    }
}

pub struct Seen {
    pub colors: Vec<DVec3>,
    pub distances: Vec<f32>,
}

pub fn look() -> Look {
    Look { shaded: false, ..Look::default() }
}

/// The rest pose of a scene, uploaded and recorded.
pub fn recorded(gpu: &Gpu, scene: &Scene, look: &Look) -> (Recorder, Picture) {
    let objects = (0..).zip(scene.objects()).collect();
    let mut mesh = MeshScene::new(Arc::new(scene.clone()), objects, record_levels);
    while !mesh.upload(gpu, (&Hidden::default(), Textures::BaseColor), Duration::ZERO).expect("fits") {}
    let picture = Picture::new(gpu, SIZE_PX).expect("fits");
    let depth = picture::depth_buffer(gpu, SIZE_PX).expect("fits");
    let (camera, grid) = (camera(), grid());
    let of_pose = (&scene.pose(None, 0.0), &Hidden::default());
    let camera_from_world = projection::camera_from_world(&camera, &grid);
    let posed = PosedMesh::new(gpu, &mesh, &mut Slot::default(), of_pose, &camera_from_world).expect("fits");
    let mut recorder = Recorder::default();
    let seen = MeshView { camera: &camera, grid: &grid, farthest: FARTHEST, look };
    mesh::record(gpu, &mut recorder, &posed, seen, MeshTarget { picture: &picture, depth: &depth });
    (recorder, picture)
}

pub fn drawn(gpu: &Gpu, scene: Scene, look: &Look) -> Seen {
    let (recorder, picture) = recorded(gpu, &scene, look);
    Job::new(recorder).run_to_end(gpu).expect("runs");
    let bytes = picture.read(gpu).expect("readable").into_raw();
    let color = |p: &[u8]| DVec3::new(p[0].into(), p[1].into(), p[2].into()) / 255.0;
    Seen { colors: bytes.chunks(4).map(color).collect(), distances: picture.read_distances(gpu).expect("readable") }
}

pub fn pixels() -> impl Iterator<Item = (usize, [f64; 2])> {
    let [width, height] = SIZE_PX;
    (0..width * height).map(move |i| (i as usize, [f64::from(i % width) + 0.5, f64::from(i / width) + 0.5]))
}

/// Where a pixel's ray meets the plane z = `z` (scene units), and how far that is from the eye, cells.
pub fn meets(point_px: [f64; 2], z: f64) -> (DVec3, f64) {
    let grid = grid();
    let ray = PixelRays::new(&camera(), &grid, SIZE_PX).ray(point_px);
    let plane = grid.grid_from_world().transform_point3(DVec3::new(0.0, 0.0, z)).z;
    let t = (plane - ray.origin.z) / ray.direction.z;
    let place = grid.grid_from_world().inverse().transform_point3(ray.origin + ray.direction * t);
    (place, ray.start_cells + t)
}

pub fn assert_color(color: DVec3, linear: DVec3, what: &str) {
    let expected = DVec3::from_array(linear.to_array().map(gamma_from_linear));
    assert!((color - expected).abs().max_element() < 1.0 / 255.0, "{what}: {color} is not {expected}");
}

pub fn background() -> DVec3 {
    DVec3::from_array(BACKGROUND.map(f64::from))
}

/// The square's upper half follows the second joint.
pub fn skinned_square(joint_moves: [DVec3; 2], weights: [[f32; 4]; 4]) -> Scene {
    let primitive = Primitive { joints: vec![[0, 1, 2, 0]; 4], weights: weights.to_vec(), ..square() };
    let mesh_node = Node { mesh: Some(0), skin: Some(0), ..node("skinned", DVec3::new(5.0, 0.0, 0.0)) };
    let mut broken = node("broken", DVec3::ZERO);
    broken.local = LocalTransform::Matrix(DMat4::from_cols_array(&[f64::NAN; 16]));
    let nodes = vec![mesh_node, node("joint 0", joint_moves[0]), node("joint 1", joint_moves[1]), broken];
    let skin = Skin { name: "skin".to_owned(), joints: vec![1, 2, 3], inverse_bind: vec![DMat4::IDENTITY; 3] };
    Scene { skins: vec![skin], ..scene(vec![primitive], nodes) }
}
