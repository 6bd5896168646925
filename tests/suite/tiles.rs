//! Objects longer than 10-bit positions reach: tiles are a way of storing them and change nothing,
//! neither in the cache nor on the GPU, where only some of them are in the grid.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::{DAffine3, DMat4, DQuat, DVec3, IVec3};
use octolume::data::pages::SegmentOrder;
use octolume::data::voxel_cache::TILE_CELLS;
use octolume::engine::Engine;
use octolume::prepare::{Prepared, PreparedPart, prepare};
use octolume::progress::Progress;
use octolume::scene::{Interpolation, Mesh, Primitive, Property, Scene, Skin, Trs};
use octolume::settings::{Discretization, Filter, Hidden, MotionSettings, Settings, VoxelAnchor};
use octolume::settings::{JointWeights, VoxelizationMode};
use octolume::stages::transform::{rigid_ref, skinned_ref};
use octolume::stages::voxelize::voxelize_cells;

use crate::device::{gpu, open};
use crate::moving::check_moved;
use crate::scenes::{channel, clip, node};
use crate::stage_rig::{RigPart, World, lattice_cell};
use crate::voxelization::object::{MODES, Object};
use crate::voxelization::soup::Soup;

/// Cells along the longest axis.
const LENGTH: f64 = 3000.0;
const SPAN: f64 = 1.0 / 64.0;
/// Longer than the grid, shorter than a tile.
const SLIDE_CELLS: f64 = 1000.0;

/// A tilted plane and a ball of bands, 3000 cells long both. All corners are at whole cells, so that
/// the grid's lattice is the object's.
fn long_soup() -> Soup {
    let centre = DVec3::splat(LENGTH / 2.0);
    let along = DVec3::new(LENGTH, 40.0, 60.0);
    let mut soup = Soup::parallelogram(centre - along / 2.0, along, DVec3::new(0.0, 24.0, 7.0));
    for band in 0..4 {
        let rotation = DQuat::from_euler(glam::EulerRot::XYZ, 0.9 * f64::from(band), 0.4 * f64::from(band), 0.0);
        let place = |step: i32, side: f64| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(step % 60) / 60.0).sin_cos();
            (centre + rotation * DVec3::new(LENGTH / 2.0 * cos, LENGTH / 2.0 * sin, side)).round()
        };
        for step in 0..60 {
            let first = soup.positions.len() as u32;
            soup.positions.extend([place(step, -2.0), place(step + 1, -2.0), place(step + 1, 2.0), place(step, 2.0)]);
            soup.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
    }
    soup
}

/// Voxelized piece by piece, each smaller than a tile and cut elsewhere.
fn untiled(soup: &Soup, mode: VoxelizationMode) -> BTreeSet<[i32; 3]> {
    let pieces = (0..64).map(|piece| IVec3::new(piece & 3, piece >> 2 & 3, piece >> 4) * 800 - 77);
    let cells = |corner: IVec3| voxelize_cells(&soup.positions, &soup.triangles, mode, Some([corner, corner + 800]));
    pieces.flat_map(|corner| cells(corner).expect("voxelizes")).map(|cell| cell.to_array()).collect()
}

#[test]
fn the_cells_of_a_long_object_are_those_of_its_pieces() {
    for mode in MODES {
        let soup = long_soup();
        let cache = Object { joints: Some(JointWeights::Interpolated), ..Object::new(soup.clone()) }.cache(mode);
        let cells: BTreeSet<[i32; 3]> = cache.cells().map(|cell| cell.to_array()).collect();
        assert_eq!(cells.len(), cache.voxels.len(), "each cell once");
        assert!(cells == untiled(&soup, mode));
        assert!(cache.tiles.len() > 9 && cache.validate().is_ok());
    }
}

fn primitive(soup: &Soup) -> Primitive {
    Primitive {
        positions: soup.positions.iter().map(|cells| (*cells * SPAN).as_vec3()).collect(),
        normals: vec![glam::Vec3::Z; soup.positions.len()],
        triangles: soup.triangles.clone(),
        ..Primitive::default()
    }
}

/// Slides along x, by whole cells at whole seconds.
fn sliding(primitive: Primitive) -> Scene {
    let to = SLIDE_CELLS * SPAN;
    let slide = channel(Property::Translation, Interpolation::Linear, &[0.0, 1000.0], &[0.0, 0.0, 0.0, to, 0.0, 0.0]);
    Scene {
        name: "long".to_owned(),
        meshes: vec![Mesh { name: "long".to_owned(), primitives: vec![primitive] }],
        nodes: vec![octolume::scene::Node { mesh: Some(0), ..node(None, Trs::default()) }],
        clips: vec![clip(vec![slide])],
        ..Scene::default()
    }
}

/// Two joints, the second half-way; weights go from one to the other along x.
fn skinned() -> Scene {
    let soup = long_soup();
    let mut primitive = primitive(&soup);
    primitive.joints = vec![[0, 1, 0, 0]; soup.positions.len()];
    primitive.weights = soup.positions.iter().map(|p| (p.x / LENGTH) as f32).map(|w| [1.0 - w, w, 0.0, 0.0]).collect();
    let mut scene = sliding(primitive);
    let middle = DVec3::splat(LENGTH / 2.0 * SPAN);
    scene.nodes[0].skin = Some(0);
    scene.nodes.push(node(None, Trs::default()));
    scene.nodes.push(node(Some(1), Trs { translation: middle, ..Trs::default() }));
    scene.clips[0].channels[0].node = 1;
    let inverse_bind = vec![DMat4::IDENTITY, DMat4::from_translation(-middle)];
    scene.skins.push(Skin { name: "skin".to_owned(), joints: vec![1, 2], inverse_bind });
    scene
}

fn prepared(scene: Scene) -> Arc<Prepared> {
    let discretization = Discretization { grid: 64, span: Some(SPAN), ..Discretization::default() };
    let prepared = prepare(Arc::new(scene), &discretization, None, &Progress::default());
    Arc::new(prepared.unwrap_or_else(|error| panic!("{error}")))
}

/// Cells of the grid that a set fills after a slide by whole cells.
fn in_grid(prepared: &Prepared, cells: &BTreeSet<[i32; 3]>, slide_cells: i32) -> BTreeSet<[i32; 3]> {
    let from_object = prepared.grid.cells_from_anchor(DVec3::ZERO) - prepared.grid.offset_cells.as_dvec3();
    assert_eq!(from_object, from_object.round(), "one lattice");
    let shift = from_object.as_ivec3() + IVec3::X * slide_cells;
    let size = prepared.grid.cells() as i32;
    let moved = cells.iter().map(|&cell| (IVec3::from_array(cell) + shift).to_array());
    moved.filter(|cell| cell.iter().all(|c| (0..size).contains(c))).collect()
}

#[test]
fn a_long_object_slides_through_the_grid_without_a_gap() {
    let cells = untiled(&long_soup(), VoxelizationMode::Thin);
    for scene in [sliding(primitive(&long_soup())), skinned()] {
        let prepared = prepared(scene);
        let mut engine = Engine::new(Arc::new(open()));
        engine.set_prepared(Some(Arc::clone(&prepared)));
        let mut parts_seen = BTreeSet::new();
        let mut at_a_boundary = false;
        // The grid is around the middle of all that is ever filled; in the end two tiles meet in it.
        for slide_cells in [0, 17, 500, 940, 976, 991, 1000] {
            let motion = MotionSettings { time_secs: f64::from(slide_cells), ..MotionSettings::default() };
            let frame = prepared.fold(
                (&motion, &prepared.pose(&motion).expect("poses")),
                VoxelAnchor::Centre,
                &Hidden::default(),
            );
            let inside: Vec<usize> = (0..prepared.parts.len()).filter(|&part| frame.resident[part]).collect();
            assert!(inside.len() < prepared.parts.len(), "some of it is outside");
            parts_seen.extend(inside);
            let mut settings = Settings::default();
            settings.shot.motion = motion;
            settings.method.discretization = Discretization {
                grid: 64,
                span: Some(SPAN),
                filter: Filter::Nearest,
                ..settings.method.discretization
            };
            engine.request(&settings, [1, 1]).expect("requested");
            engine.run_to_end().expect("runs");
            let found: BTreeSet<[i32; 3]> = engine.read_voxels().expect("read").cells.into_iter().collect();
            let expected = in_grid(&prepared, &cells, slide_cells);
            at_a_boundary |= crosses_a_tile_boundary(&prepared, &expected, slide_cells);
            assert!(found == expected, "{slide_cells}: {} cells, {} expected", found.len(), expected.len());
        }
        assert!(parts_seen.len() > 1 && at_a_boundary);
    }
}

/// Are there cells of two tiles among those in the grid?
fn crosses_a_tile_boundary(prepared: &Prepared, cells: &BTreeSet<[i32; 3]>, slide_cells: i32) -> bool {
    let first = prepared.caches[0].tiles[0].origin.x;
    let from_object = prepared.grid.cells_from_anchor(DVec3::ZERO).x as i32 - prepared.grid.offset_cells.x;
    let tile = |cell: &[i32; 3]| (cell[0] - from_object - slide_cells - first).div_euclid(TILE_CELLS);
    cells.iter().map(tile).collect::<BTreeSet<i32>>().len() > 1
}

#[test]
fn every_voxel_of_a_long_object_goes_where_the_reference_puts_it() {
    for scene in [sliding(primitive(&long_soup())), skinned()] {
        let prepared = prepared(scene);
        let motion = MotionSettings { time_secs: 300.5, turn_degrees: [3.0, 40.0, -7.0], ..MotionSettings::default() };
        let frame =
            prepared.fold((&motion, &prepared.pose(&motion).expect("poses")), VoxelAnchor::Centre, &Hidden::default());
        let mut in_the_grid = 0;
        for (number, part) in prepared.parts.iter().enumerate() {
            let rig = rig_part(&prepared, part, &frame, number);
            let maps = maps(&prepared, part, &motion, rig.origin);
            let map = |voxel: usize| match rig.joints.get(voxel) {
                None => (maps[0], 5.0),
                // As for joints of small objects: quotient, product, three sums, then as rigid.
                Some(joints) => (skinned_ref::blended(joints, &maps).expect("joints have a size"), 16.0),
            };
            if !frame.resident[number] {
                let is_inside = |voxel: usize| {
                    let q = rigid_ref::quantise(rigid_ref::centre(lattice_cell(&rig, voxel), &map(voxel).0));
                    q.is_none_or(|q| rigid_ref::overlaps_grid(q, i64::from(prepared.grid.cells())))
                };
                assert!(!(0..rig.voxels.len()).any(is_inside), "part {number} was left out");
                continue;
            }
            let found = World::moved(gpu(), std::slice::from_ref(&rig), prepared.grid.depth, SegmentOrder::default())
                .fragments(gpu());
            for (voxel, found) in found.iter().enumerate() {
                let (map, roundings) = map(voxel);
                check_moved(&rig, &map, voxel, found, roundings).unwrap_or_else(|difference| panic!("{difference}"));
            }
            in_the_grid += found.iter().flatten().count();
        }
        assert!(in_the_grid > 50, "{in_the_grid}");
    }
}

fn rig_part(
    prepared: &Prepared,
    part: &PreparedPart,
    frame: &octolume::prepare::FrameMatrices,
    number: usize,
) -> RigPart {
    let cache = &prepared.caches[prepared.objects[part.object].cache];
    let range = part.tile.voxels.start as usize..part.tile.voxels.end as usize;
    let uploaded = &frame.parts[number];
    RigPart {
        origin: uploaded.origin,
        voxels: cache.voxels[range.clone()].to_vec(),
        joints: if prepared.is_skinned(part) { cache.joints[range].to_vec() } else { Vec::new() },
        matrices: frame.matrices[uploaded.first_matrix as usize..].to_vec(),
        ..RigPart::default()
    }
}

/// `grid_from_cache` of the object or of each joint, in f64, for positions counted from `origin`.
fn maps(prepared: &Prepared, part: &PreparedPart, motion: &MotionSettings, origin: [i32; 3]) -> Vec<DAffine3> {
    let pose = prepared.pose(motion).expect("poses");
    let object = &prepared.objects[part.object];
    let folded_in = part.tile.origin - IVec3::from_array(origin);
    let movers = match prepared.is_skinned(part) {
        true => prepared.scene.joint_matrices(0, &pose),
        false => vec![pose.world_from_node[object.object.node]],
    };
    let cache = object.lattice.space_from_cells() * DMat4::from_translation(folded_in.as_dvec3());
    let map = |mover: DMat4| DAffine3::from_mat4(prepared.grid.grid_from_world() * mover * cache);
    movers.into_iter().map(map).collect()
}

#[test]
fn what_is_too_long_or_too_large_is_refused_with_object_and_limit() {
    let refused = |span: f64| {
        let soup = Soup::parallelogram(DVec3::ZERO, DVec3::new(1_048_575.5, 0.0, 0.0), DVec3::Y);
        let scene = sliding(Primitive {
            positions: soup.positions.iter().map(|position| position.as_vec3()).collect(),
            ..primitive(&soup)
        });
        let discretization = Discretization { grid: 64, span: Some(span), ..Discretization::default() };
        prepare(Arc::new(scene), &discretization, None, &Progress::default()).map_err(|error| error.to_string())
    };
    let longest = refused(1.0).expect("as long as a cache can be");
    assert_eq!((longest.voxel_count(), longest.parts.len()), (1 << 20, 1 << 10));
    assert_eq!(
        refused(0.5).expect_err("too long"),
        "long: object \"node\" cannot be voxelized: it is 2097152 cells long, and 1048576 is the limit; choose a larger \
         span"
    );
    let square = Soup::parallelogram(DVec3::ZERO, DVec3::X * 8192.0, DVec3::Y * 8192.0);
    let discretization = Discretization { grid: 64, span: Some(SPAN), ..Discretization::default() };
    let error = prepare(Arc::new(sliding(primitive(&square))), &discretization, None, &Progress::default());
    assert_eq!(
        error.expect_err("too large").to_string(),
        "long: object \"node\" cannot be voxelized: it covers about 67108864 cells, and 33554432 is the limit; choose a \
         larger span"
    );
}
