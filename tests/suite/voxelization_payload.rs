//! Voxels and how they are stored: order, tiles, normals, joints, reports.

use std::collections::BTreeSet;

use glam::{DVec3, IVec3, Vec2};
use octolume::data::packing::{pack_normal, unpack_normal};
use octolume::data::voxel_cache::{TILE_CELLS, VoxelCache, VoxelJoints, VoxelizeReport};
use octolume::progress::{Cancelled, Progress};
use octolume::scene::{AlphaMode, Material};
use octolume::settings::JointWeights;
use octolume::settings::VoxelizationMode::{Conservative, Thin};
use octolume::stages::voxelize::{TexturePyramids, VoxelizeError, VoxelizeInput, VoxelizePart, voxelize};

use crate::voxelization::object::{FIRST, MODES, Object, square, texture, validate};
use crate::voxelization::soup::{Random, Soup};

/// A surface with everything: texture, vertex colours, joints, emission, blending.
fn rich_object(random: &mut Random) -> Object {
    let mut object = Object::new(Soup::random(random, 120, 12.0, 2.0));
    let count = object.soup.positions.len();
    object.normals = (0..count).map(|_| random.point(-1.0, 1.0)).collect();
    object.primitive.tex_coords[0] = (0..count).map(|_| random.point(-2.0, 2.0).truncate().as_vec2()).collect();
    object.primitive.colors = (0..count).map(|_| random.point(0.0, 1.0).as_vec3().extend(0.7)).collect();
    object.primitive.joints = (0..count).map(|_| [0; 4].map(|_| random.below(300) as u16)).collect();
    object.primitive.weights = (0..count).map(|_| [0.4, 0.3, 0.2, 0.1]).collect();
    object.material = Material {
        base_color_texture: FIRST,
        alpha_mode: AlphaMode::Blend,
        emissive: [3.0, 0.5, 0.0],
        ..Material::default()
    };
    object.textures = vec![texture(37, 21, |x, y| [7 * x as u8, 11 * y as u8, (x * y) as u8, 100 + 4 * x as u8])];
    object.joints = Some(JointWeights::Interpolated);
    object
}

#[test]
fn nothing_to_voxelize_is_an_empty_cache() {
    for mode in MODES {
        let cache = Object::new(Soup::default()).cache(mode);
        assert_eq!(cache, VoxelCache::default());
        let vertices_only = Soup { positions: vec![DVec3::ONE; 3], triangles: vec![] };
        assert_eq!(Object::new(vertices_only).cache(mode), VoxelCache::default());
        let textures = TexturePyramids::new(&[]);
        let input = VoxelizeInput { parts: vec![], materials: &[], textures: &textures, mode, joints: None };
        assert_eq!(voxelize(&input, &Progress::default()).unwrap(), VoxelCache::default());
    }
}

#[test]
fn degenerate_triangles_are_counted_and_leave_nothing() {
    for mode in MODES {
        let clean = square(6.0);
        let mut object = clean.clone();
        // A repeated index, a repeated position, collinear corners outside the square.
        object.soup.positions.extend([DVec3::splat(20.0), DVec3::splat(21.0), DVec3::splat(23.0), DVec3::splat(20.0)]);
        object.primitive.triangles.extend([[0, 1, 1], [4, 5, 7], [4, 5, 6], [2, 2, 2]]);
        object.normals.resize(8, DVec3::Z);
        object.primitive.tex_coords[0].resize(8, Vec2::ZERO);
        let cache = object.cache(mode);
        assert_eq!(cache.report, VoxelizeReport { triangles: 6, degenerate_triangles: 4, unweighted_vertices: 0 });
        assert_eq!(cache.voxels, clean.cache(mode).voxels);
    }
}

#[test]
fn shuffled_and_doubled_triangles_give_the_identical_cache() {
    let mut random = Random(11);
    for mode in MODES {
        let object = rich_object(&mut random);
        let cache = object.cache(mode);
        assert_eq!((cache.emission.len(), cache.joints.len()), (cache.voxels.len(), cache.voxels.len()));
        for _ in 0..4 {
            assert_eq!(object.shuffled(&mut random).cache(mode), cache);
        }
        let mut doubled = object.clone();
        doubled.primitive.triangles.extend_from_within(..);
        let doubled = doubled.cache(mode);
        assert_eq!(VoxelCache { report: cache.report, ..doubled }, cache);
    }
}

#[test]
fn number_of_threads_changes_nothing() {
    let mut object = Object::new(Soup::sphere(DVec3::splat(50.3), 47.0, 5));
    object.normals = object.soup.positions.iter().map(|p| p - DVec3::splat(50.3)).collect();
    let on = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    assert_eq!(on(1).install(|| object.cache(Thin)), on(5).install(|| object.cache(Thin)));
}

#[test]
fn vertex_normals_do_not_decide_the_cells() {
    let mut random = Random(12);
    let object = Object::new(Soup::random(&mut random, 50, 20.0, 4.0));
    for mode in MODES {
        let cells: Vec<IVec3> = object.cache(mode).cells().collect();
        let with = |normal: fn(usize) -> DVec3| {
            let normals = (0..object.soup.positions.len()).map(normal).collect();
            Object { normals, ..object.clone() }.cache(mode)
        };
        let zero = with(|_| DVec3::ZERO);
        let opposed = with(|vertex| if vertex % 2 == 0 { DVec3::X } else { -DVec3::X });
        assert!(zero.cells().eq(cells.iter().copied()) && opposed.cells().eq(cells.iter().copied()));
        assert!(zero.voxels.iter().all(|voxel| voxel.normal == pack_normal(DVec3::ZERO)));
    }
}

#[test]
fn opposed_normals_cancel_to_zero_length() {
    let mut object = square(5.0);
    object.soup.positions.extend_from_within(..);
    object.primitive.triangles.extend([[4, 6, 5], [4, 7, 6]]);
    object.primitive.tex_coords[0].extend_from_within(..);
    object.normals.extend([-DVec3::Z; 4]);
    let cache = object.cache(Thin);
    assert_eq!(cache.voxels.len(), 25);
    assert!(cache.voxels.iter().all(|voxel| voxel.normal == pack_normal(DVec3::ZERO)));
}

#[test]
fn normals_of_a_sphere_point_outwards() {
    let center = DVec3::new(33.2, 34.9, 35.4);
    let mut object = Object::new(Soup::sphere(center, 30.0, 5));
    object.normals = object.soup.positions.iter().map(|p| p - center).collect();
    let cache = object.cache(Thin);
    for (cell, voxel) in cache.cells().zip(&cache.voxels) {
        let out = (cell.as_dvec3() + 0.5 - center).normalize();
        let normal = unpack_normal(voxel.normal).normalize();
        // The piece lies in the cell: at most half a diagonal, √¾ cells, from its centre.
        assert!(normal.angle_between(out) < 0.75f64.sqrt() / (30.0 - 1.0) + 0.005, "{cell}");
    }
}

#[test]
fn long_objects_are_tiled_and_lose_nothing() {
    for mode in MODES {
        let from = DVec3::new(-1500.25, 3.5, 7.5);
        let strip = Soup::parallelogram(from, DVec3::new(2600.0, 40.0, 1100.0), DVec3::new(0.0, 9.0, 2.0));
        let object = Object { joints: Some(JointWeights::Interpolated), ..Object::new(strip.clone()) };
        let cache = object.cache(mode);
        let mut cells: Vec<[i32; 3]> = cache.cells().map(|cell| cell.to_array()).collect();
        let mut expected: Vec<[i32; 3]> = strip.cells(mode).into_iter().map(|cell| cell.to_array()).collect();
        cells.sort_unstable();
        expected.sort_unstable();
        assert_eq!(cells, expected);
        assert!(cache.tiles.len() >= 3);
        let smallest = cache.cells().reduce(IVec3::min).unwrap();
        assert!(cache.tiles.iter().all(|tile| (tile.origin - smallest) % TILE_CELLS == IVec3::ZERO));
    }
}

#[test]
fn skin_weights_of_triangles_in_a_cell_are_averaged_by_area() {
    // Half of the cell belongs to joint 3, half to joint 8: 127.5 each, and the smaller index gets the half.
    let mut object = square(1.0);
    object.soup.positions = [0, 1, 2, 0, 2, 3].map(|v| object.soup.positions[v]).to_vec();
    object.primitive.triangles = vec![[0, 1, 2], [3, 4, 5]];
    object.normals = vec![DVec3::Z; 6];
    object.primitive.joints = [3, 3, 3, 8, 8, 8].map(|joint| [joint, 0, 0, 0]).to_vec();
    object.primitive.weights = vec![[1.0, 0.0, 0.0, 0.0]; 6];
    object.joints = Some(JointWeights::Interpolated);
    let cache = object.cache(Conservative);
    assert_eq!(cache.joints, [VoxelJoints { joints: [3, 8, 0, 0], weights: [128, 127, 0, 0] }]);
}

/// A joint a corner of a square: flat voxels follow the corner that is nearest in their triangle, alone, where what a
/// cell holds of the triangles agrees.
#[test]
fn flat_weights_are_those_of_the_nearest_corner() {
    let mut object = Object { joints: Some(JointWeights::Flat), ..square(8.0) };
    object.primitive.joints = (0..4).map(|joint| [joint, 0, 0, 0]).collect();
    object.primitive.weights = vec![[1.0, 0.0, 0.0, 0.0]; 4];
    let flat = object.cache(Thin);
    let interpolated = Object { joints: Some(JointWeights::Interpolated), ..object.clone() }.cache(Thin);
    assert_eq!(flat.joints.len(), 64);
    let alone = flat.joints.iter().filter(|voxel| voxel.weights == [255, 0, 0, 0]);
    let by_joint = |joint| alone.clone().filter(|voxel| voxel.joints[0] == joint).count();
    // A triangle's third belongs to each of its corners; cells on the borders between them hold two.
    assert!((0..4).all(|joint| (6..=22).contains(&by_joint(joint))), "{:?}", [0, 1, 2, 3].map(by_joint));
    assert!(alone.count() > 40);
    let blended = interpolated.joints.iter().filter(|voxel| voxel.weights[1] > 0).count();
    assert!(blended > 48, "{blended}");
    for (corner, cell) in [(0, [0, 0]), (1, [7, 0]), (2, [7, 7]), (3, [0, 7])] {
        let at = flat.cells().position(|found| found.x == cell[0] && found.y == cell[1]);
        let voxel = flat.joints[at.expect("a voxel in the corner")];
        assert_eq!((voxel.joints[0], voxel.weights), (corner, [255, 0, 0, 0]));
    }
}

#[test]
fn vertices_without_weights_follow_their_first_joint_and_are_counted() {
    let mut object = Object { joints: Some(JointWeights::Interpolated), ..square(2.0) };
    object.primitive.joints = vec![[9, 1, 2, 3]; 4];
    object.primitive.weights = vec![[0.0; 4]; 4];
    let cache = object.cache(Thin);
    assert_eq!(cache.report.unweighted_vertices, 4);
    let rigid = VoxelJoints { joints: [9, 0, 0, 0], weights: [255, 0, 0, 0] };
    assert_eq!(cache.joints, [rigid; 4]);
}

#[test]
fn cancelling_keeps_nothing_and_progress_arrives() {
    let object = square(30.0);
    let progress = Progress::default();
    progress.add_total(4);
    object.try_cache(Thin, &progress).unwrap();
    assert_eq!(progress.fraction(), 1.0);
    progress.cancel();
    assert_eq!(object.try_cache(Thin, &progress).unwrap_err(), VoxelizeError::Cancelled(Cancelled));
}

#[test]
fn broken_references_are_refused() {
    let mut object = square(2.0);
    object.primitive.material = Some(7);
    let refused = |object: &Object| object.try_cache(Thin, &Progress::default()).unwrap_err().to_string();
    assert_eq!(refused(&object), "primitive 0: its material does not exist");
    object.primitive.material = Some(0);
    object.material.base_color_texture = FIRST;
    assert_eq!(refused(&object), "primitive 0: its material names a texture that is missing or empty");
    object.material.base_color_texture = None;
    object.normals.pop();
    assert_eq!(refused(&object), "primitive 0: normals and positions differ in number");
}

#[test]
fn files_keep_their_promises() {
    let Some(folder) = crate::real_scenes::real_scenes() else { return };
    for name in ["CesiumMan/CesiumMan.glb", "Fox/Fox.glb", "RobotExpressive/robot.glb"] {
        let scene = octolume::scene::load::open(&folder.join(name), &Progress::default()).unwrap();
        let pose = scene.pose(None, 0.0);
        let bounds = scene.bounds_at(&pose).unwrap();
        let span = bounds.size().max_element() / 100.0;
        let textures = TexturePyramids::new(&scene.textures);
        for object in scene.objects() {
            let primitives = &scene.meshes[object.mesh].primitives;
            let part = |(index, primitive)| VoxelizePart {
                primitive,
                positions_cells: scene.posed_positions(&object, index, &pose).iter().map(|p| *p / span).collect(),
                normals: scene.posed_normals(&object, index, &pose),
            };
            let input = |mode| VoxelizeInput {
                parts: primitives.iter().enumerate().map(part).collect(),
                materials: &scene.materials,
                textures: &textures,
                mode,
                joints: Some(JointWeights::Interpolated),
            };
            let [thin, conservative] = MODES.map(|mode| voxelize(&input(mode), &Progress::default()).unwrap());
            validate(&thin);
            validate(&conservative);
            let all: BTreeSet<[i32; 3]> = conservative.cells().map(|cell| cell.to_array()).collect();
            assert!(thin.cells().all(|cell| all.contains(&cell.to_array())), "{name}: thin is part of conservative");
            assert!(thin.joints.len() == thin.voxels.len() && !thin.voxels.is_empty(), "{name}");
        }
    }
}
