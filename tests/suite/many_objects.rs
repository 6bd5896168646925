//! More objects than most scenes have: each has a place of its own in the pages, and none is lost.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use octolume::engine::Engine;
use octolume::prepare::prepare;
use octolume::progress::Progress;
use octolume::scene::{Node, Primitive, Scene};
use octolume::settings::Settings;

use crate::device;
use crate::mesh_rig::{node, scene};

/// Along each axis; two cells apart.
const SIDES: [i32; 3] = [33, 34, 30];

/// A triangle that fills a corner of one cell.
fn triangle() -> Primitive {
    Primitive {
        positions: vec![Vec3::new(0.2, 0.2, 0.5), Vec3::new(0.9, 0.2, 0.5), Vec3::new(0.2, 0.9, 0.5)],
        normals: vec![Vec3::Z; 3],
        triangles: vec![[0, 1, 2]],
        ..Primitive::default()
    }
}

fn triangles() -> Scene {
    let place = |i: i32| {
        DVec3::new(f64::from(i % SIDES[0]), f64::from(i / SIDES[0] % SIDES[1]), f64::from(i / (SIDES[0] * SIDES[1])))
            * 2.0
    };
    let nodes = (0..SIDES.iter().product()).map(|i| Node { mesh: Some(0), ..node("triangle", place(i)) });
    scene(vec![triangle()], nodes.collect())
}

#[test]
fn thirty_three_thousand_objects_each_fill_their_cell() {
    let scene = triangles();
    let count = scene.nodes.len();
    assert!(count > 33_000);
    let mut settings = Settings::default();
    (settings.method.discretization.grid, settings.method.discretization.span) = (128, Some(1.0));
    let prepared = prepare(Arc::new(scene), &settings.method.discretization, None, &Progress::default());
    let prepared = Arc::new(prepared.unwrap_or_else(|error| panic!("{error}")));
    let per_object = prepared.voxel_count() / count as u64;
    assert_eq!(prepared.voxel_count(), per_object * count as u64);
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::clone(&prepared)));
    engine.request(&settings, [1, 1]).expect("a frame");
    engine.run_to_end().expect("runs");
    let cells = engine.read_voxels().expect("is built").cells;
    assert_eq!(cells.len() as u64, per_object * count as u64);
}
