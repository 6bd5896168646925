//! Colour by object stores a number a leaf in 16 bits: scenes with more objects are told so.

use std::sync::Arc;

use octolume::engine::Engine;
use octolume::prepare::prepare;
use octolume::progress::Progress;
use octolume::scene::{Node, Scene, Trs};
use octolume::settings::{ColorBy, Settings, View};

use crate::device::open;
use crate::scenes::{at, cube_scene, node};

/// Cubes side by side that share a mesh.
fn row(objects: usize) -> Scene {
    let mut scene = Scene { name: "row".to_owned(), ..cube_scene(Trs::default()) };
    scene.nodes = (0..objects).map(|i| Node { mesh: Some(0), ..node(None, at(4.0 * i as f64, 0.0, 0.0)) }).collect();
    scene
}

#[test]
fn more_objects_than_a_leaf_can_tell_apart_are_refused_where_they_are_shown_only() {
    let mut engine = Engine::new(Arc::new(open()));
    let mut request = |objects: usize, color: ColorBy, view: View| {
        let mut settings = Settings::default();
        (settings.method.look.color, settings.method.look.view) = (color, view);
        let prepared = prepare(Arc::new(row(objects)), &settings.method.discretization, None, &Progress::default());
        engine.set_prepared(Some(Arc::new(prepared.expect("prepares"))));
        engine.request(&settings, [1, 1]).map_err(|error| error.to_string())
    };
    assert_eq!(request(65_535, ColorBy::Object, View::Voxels), Ok(()));
    assert_eq!(
        request(65_536, ColorBy::Object, View::Voxels),
        Err("row has 65536 objects, and colour by object can tell 65535 apart; choose another colour".to_owned())
    );
    assert_eq!(request(65_536, ColorBy::Object, View::Mesh), Ok(()));
    assert_eq!(request(65_536, ColorBy::Albedo, View::Voxels), Ok(()));
}
