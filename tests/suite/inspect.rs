//! One node at a time: what is read of it against what was built, its pointers against its place.

use std::sync::Arc;

use glam::DVec3;
use octolume::engine::{Engine, NodeAddress, NodeFacts};
use octolume::prepare::prepare;
use octolume::progress::Progress;
use octolume::scene::{builtin, load};
use octolume::settings::{ColorBy, Settings, SliceValue, View};
use octolume::stages::pixels::camera::PixelRays;

use crate::device::open;

const SIZE_PX: [u32; 2] = [64, 48];

/// The courtyard at 64³ with dense levels 0 to 3.
fn settings() -> Settings {
    let mut settings = Settings::default();
    settings.method.discretization.grid = 64;
    settings.method.discretization.dense_level = Some(3);
    settings.method.look.pointers = true;
    settings
}

fn engine(settings: &Settings) -> Engine {
    let bytes = builtin::bytes("courtyard").expect("a built-in scene");
    let scene = load::open_bytes("courtyard", bytes, None, &Progress::default()).expect("it opens");
    let prepared =
        prepare(Arc::new(scene), &settings.method.discretization, None, &Progress::default()).expect("it fits");
    let mut engine = Engine::new(Arc::new(open()));
    engine.set_prepared(Some(Arc::new(prepared)));
    engine.request(settings, SIZE_PX).expect("a request");
    engine.run_to_end().expect("it is built");
    engine
}

fn facts(engine: &Engine, level: u32, cell: [u32; 3]) -> Option<NodeFacts> {
    engine.node_facts(NodeAddress { level, cell }).expect("it is read")
}

/// Every so many leaves.
fn some_leaves(engine: &Engine, step: usize) -> Vec<(usize, [u32; 3])> {
    let voxels = engine.read_voxels().expect("leaves");
    voxels.cells.iter().map(|cell| cell.map(|c| c as u32)).enumerate().step_by(step).collect()
}

#[test]
fn leaves_hold_what_was_built() {
    let engine = engine(&settings());
    let voxels = engine.read_voxels().expect("leaves");
    for (number, cell) in some_leaves(&engine, 501) {
        let leaf = facts(&engine, 6, cell).expect("a stored leaf");
        assert_eq!(leaf.occupancy as f32, voxels.occupancy[number]);
        assert_eq!(leaf.albedo.map(|channel| channel as f32), voxels.albedo[number]);
        assert!(!leaf.node.is_dummy && leaf.first_child.is_none() && leaf.radiance.is_none());
        assert_eq!(leaf.node.address, NodeAddress { level: 6, cell });
    }
}

#[test]
fn pointers_lead_one_cell_ahead_to_what_is_stored_there() {
    let engine = engine(&settings());
    let mut dummies = 0;
    let mut ends = 0;
    for (_, leaf) in some_leaves(&engine, 1201) {
        for level in [6, 5, 4, 3, 2] {
            let cell = leaf.map(|c| c >> (6 - level));
            let node = facts(&engine, level, cell).expect("above a leaf");
            for corner in 0..8_usize {
                let ahead = [0, 1, 2].map(|axis| cell[axis] + (corner >> axis & 1) as u32);
                let there = facts(&engine, level, ahead);
                let found = node.corners[corner];
                assert!(found.is_none_or(|found| found.address.cell == ahead), "{level} {cell:?} {corner}");
                match (found, &there) {
                    (Some(found), Some(there)) => assert_eq!(found, there.node),
                    (Some(found), None) => panic!("{level} {cell:?} {corner}: {found:?} is not stored"),
                    // A dummy that no dummy leads to: nothing is in it.
                    (None, Some(there)) => assert!(there.node.is_dummy, "{level} {cell:?} {corner}"),
                    (None, None) => ends += 1,
                }
                dummies += usize::from(found.is_some_and(|found| found.is_dummy));
            }
            assert_eq!(node.forward, [1, 2, 4].map(|corner| node.corners[corner]));
            assert_eq!(node.block.is_none(), level <= 3);
        }
    }
    assert!(dummies > 20 && ends > 20, "{dummies} dummies, {ends} ends: too few to say anything");
}

#[test]
fn children_fill_their_parents() {
    let engine = engine(&settings());
    let (_, leaf) = some_leaves(&engine, 5000)[1];
    for level in 0..6 {
        let node = facts(&engine, level, leaf.map(|c| c >> (6 - level))).expect("above a leaf");
        let first = node.first_child.expect("children");
        assert_eq!(first.address.parent(), Some(node.node.address));
        let child = |child: u32| [0, 1, 2].map(|axis| first.address.cell[axis] + (child >> axis & 1));
        let children = (0..8).map(|number| facts(&engine, level + 1, child(number)).expect("all eight are stored"));
        let occupancies: Vec<f64> = children.map(|child| child.occupancy).collect();
        // Sums of integers below 2^53, and powers of two.
        assert_eq!(occupancies.iter().sum::<f64>() / 8.0, node.occupancy, "level {level}: {occupancies:?}");
    }
}

#[test]
fn without_pointers_or_nodes_that_is_said() {
    let mut plain = settings();
    plain.method.look.pointers = false;
    let engine = engine(&plain);
    let (_, leaf) = some_leaves(&engine, 5000)[1];
    let node = facts(&engine, 6, leaf).expect("a leaf");
    assert!(!node.has_pointers && node.forward == [None; 3] && node.corners[1..] == [None; 7]);
    assert!(facts(&engine, 3, leaf.map(|c| c >> 3)).expect("dense").has_pointers, "dense levels need none");
    for (level, cell) in [(6, [64, 0, 0]), (7, [0, 0, 0]), (2, [0, 4, 0])] {
        assert_eq!(facts(&engine, level, cell), None, "outside the grid");
    }
    let empty = facts(&engine, 3, [3, 7, 3]).expect("dense levels store everything");
    assert!(empty.node.is_dummy && empty.occupancy == 0.0 && empty.radiance.is_none());
}

#[test]
fn lit_nodes_tell_their_radiance() {
    let mut lit = settings();
    lit.method.look.color = ColorBy::Radiance;
    let engine = engine(&lit);
    let leaves = some_leaves(&engine, 997);
    let radiances: Vec<[f64; 3]> =
        leaves.iter().filter_map(|(_, cell)| facts(&engine, 6, *cell).and_then(|leaf| leaf.radiance)).collect();
    assert_eq!(radiances.len(), leaves.len(), "every leaf has some, if only zero");
    assert!(radiances.iter().any(|radiance| radiance[0] > 0.0), "the sun shines somewhere");
    assert!(facts(&engine, 0, [0; 3]).and_then(|root| root.radiance).expect("the mean")[0] > 0.0);
}

#[test]
fn a_pixel_shows_the_node_its_ray_meets() {
    for level in [None, Some(4)] {
        let mut settings = settings();
        settings.method.look.level = level;
        let camera = octolume::scene::OrbitCamera::new(DVec3::new(9.0, 7.0, 12.0), DVec3::new(0.0, 2.0, 0.0), 60.0);
        settings.shot.camera = Some(camera);
        let engine = engine(&settings);
        let grid = engine.prepared().expect("a scene").grid;
        let rays = PixelRays::new(&camera, &grid, SIZE_PX);
        let mut met = 0;
        for y in (0..SIZE_PX[1]).step_by(5) {
            for x in (0..SIZE_PX[0]).step_by(5) {
                let Some(address) = engine.node_at([x, y]).expect("it is read") else { continue };
                met += 1;
                assert_eq!(address.level, level.unwrap_or(6));
                assert!(!facts(&engine, address.level, address.cell).expect("stored").node.is_dummy, "{address}");
                let edge = f64::from(1 << (6 - address.level));
                let low = DVec3::from_array(address.cell.map(f64::from)) * edge;
                let ray = rays.ray([f64::from(x) + 0.5, f64::from(y) + 0.5]);
                let [near, far] = [low, low + edge].map(|plane| (plane - ray.origin) / ray.direction);
                let (enter, leave) = (near.min(far).max_element(), near.max(far).min_element());
                assert!(enter < leave && leave > 0.0, "{address} is not on the ray of {x}, {y}");
            }
        }
        assert!(met > 60, "{met} pixels show a node");
        assert_eq!(engine.node_at(SIZE_PX).expect("no pixel"), None);
    }
}

/// Light that was stored before is kept for its opacity; its radiance is not on screen.
#[test]
fn a_slice_of_occupancy_has_the_exposure_of_no_light_whatever_was_shown_before() {
    let mut occupancy = settings();
    (occupancy.method.look.view, occupancy.method.look.slice.value) = (View::Slice, SliceValue::Occupancy);
    assert_eq!(engine(&occupancy).exposure(), 1.0);
    let mut radiance = occupancy.clone();
    radiance.method.look.slice.value = SliceValue::Radiance;
    let mut engine = engine(&radiance);
    assert_ne!(engine.exposure(), 1.0, "the courtyard is lit");
    engine.request(&occupancy, SIZE_PX).expect("a request");
    engine.run_to_end().expect("a frame");
    assert_eq!(engine.exposure(), 1.0);
}
