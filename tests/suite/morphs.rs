//! Morph targets whose weights a clip moves: as glTF defines them, on the CPU and on the GPU.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use octolume::prepare::prepare;
use octolume::progress::Progress;
use octolume::scene::{Scene, Unmovable, bounds::Aabb};
use octolume::settings::{Fit, FitTo, Settings};
use serde_json::json;

use crate::document::Document;

/// The triangle with two targets, and a clip of their weights.
fn morphing(interpolation: &str, times: &[f32], weights: &[f32]) -> Document {
    let mut document = Document::with_triangle();
    let up = document.floats("VEC3", &[0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0]);
    let aside = document.floats("VEC3", &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    document.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": up }, { "POSITION": aside }]);
    document.json["meshes"][0]["weights"] = json!([0.5, 0.0]);
    let (times, weights) = (document.floats("SCALAR", times), document.floats("SCALAR", weights));
    document.add(
        "animations",
        json!({
            "name": "a", "samplers": [{ "input": times, "output": weights, "interpolation": interpolation }],
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "weights" } }],
        }),
    );
    document
}

fn positions(scene: &Scene, time_secs: f64) -> Vec<DVec3> {
    scene.posed_positions(&scene.objects()[0], 0, &scene.pose(Some(0), time_secs))
}

#[test]
fn vertices_are_the_weighted_sum_of_their_displacements() {
    let moved = |up: f64, aside: f64| {
        let base = [DVec3::X, DVec3::Y, DVec3::Z];
        let steps = [DVec3::new(aside, 0.0, 2.0 * up), DVec3::Z * 2.0 * up, DVec3::Z * 4.0 * up];
        base.iter().zip(steps).map(|(base, step)| *base + step).collect::<Vec<_>>()
    };
    let scene = morphing("LINEAR", &[0.0, 2.0], &[0.0, 1.0, 1.0, -1.0]).open().expect("opens");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    for (time, up, aside) in [(-1.0, 0.0, 1.0), (0.0, 0.0, 1.0), (0.5, 0.25, 0.5), (2.0, 1.0, -1.0), (9.0, 1.0, -1.0)] {
        assert_eq!(positions(&scene, time), moved(up, aside), "{time} s");
    }
    let resting = scene.posed_positions(&scene.objects()[0], 0, &scene.pose(None, 0.0));
    assert_eq!(resting, moved(0.5, 0.0), "without a clip at the mesh's own weights");
    let stepped = morphing("STEP", &[0.0, 2.0], &[0.0, 1.0, 1.0, -1.0]).open().expect("opens");
    assert_eq!(positions(&stepped, 1.9), moved(0.0, 1.0));
    // In-tangents, values, out-tangents of both keys: half-way the mean, and an eighth of the tangents' difference.
    let keys = [[0.0; 2], [0.0, 1.0], [4.0, 0.0], [-4.0, 0.0], [1.0, -1.0], [0.0; 2]].concat();
    let spline = morphing("CUBICSPLINE", &[0.0, 1.0], &keys).open().expect("opens");
    assert_eq!(positions(&spline, 0.5), moved(0.5 + (4.0 + 4.0) / 8.0, 0.0));
    assert_eq!(positions(&spline, 1.0), moved(1.0, -1.0));
}

/// Flat normals are those of the displaced triangle.
#[test]
fn normals_follow_and_each_node_has_weights_of_its_own() {
    let mut document = morphing("LINEAR", &[0.0, 1.0], &[0.0, 0.0, 1.0, 0.0]);
    document.add("nodes", json!({ "name": "still", "mesh": 0 }));
    let scene = document.open().expect("opens");
    let pose = scene.pose(Some(0), 1.0);
    let objects = scene.objects();
    let expected = (Vec3::Y - Vec3::X).cross(Vec3::new(-1.0, 0.0, 3.0)).normalize().as_dvec3();
    let normals = scene.posed_normals(&objects[0], 0, &pose);
    assert!(normals.iter().all(|normal| normal.distance(expected) < 1e-6), "{normals:?}");
    let still: Vec<DVec3> = scene.posed_positions(&objects[1], 0, &pose);
    assert_eq!(still, [DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 1.0, 1.0), DVec3::Z * 3.0]);
}

#[test]
fn bounds_and_the_grid_follow_the_shape() {
    let scene = Arc::new(morphing("LINEAR", &[0.0, 1.0], &[0.0, 0.0, 10.0, 0.0]).open().expect("opens"));
    let highest = |bounds: Option<Aabb>| bounds.expect("something").max.z;
    assert_eq!(highest(scene.bounds_at(&scene.pose(Some(0), 0.5))), 21.0);
    assert_eq!(highest(scene.bounds_over_time()), 41.0);
    let mut settings = Settings::default();
    settings.shot.fit = Fit { to: FitTo::Clip, ..Fit::default() };
    let prepared = prepare(Arc::clone(&scene), &settings, None, &Progress::default()).expect("it fits");
    assert!(prepared.grid.span * f64::from(prepared.grid.cells()) >= 41.0);
    let Some(Unmovable::Morphs { cells }) = prepared.objects[0].unmovable else { panic!("it morphs") };
    assert!((cells - 9.5 * 4.0 / prepared.grid.span).abs() < 1e-3, "{cells}");
}

#[test]
fn a_target_that_cannot_be_read_displaces_nothing_and_is_named() {
    let mut document = morphing("LINEAR", &[0.0, 1.0], &[0.0, 0.0, 1.0, 1.0]);
    let broken = document.floats("VEC3", &[0.0, 0.0, 1.0, f32::NAN, 0.0, 0.0, 0.0, 0.0, 1.0]);
    let short = document.floats("VEC3", &[0.0, 0.0, 1.0]);
    let targets = json!([{ "POSITION": broken }, { "POSITION": short }]);
    document.json["meshes"][0]["primitives"][0]["targets"] = targets;
    document.json["meshes"][0]["weights"] = json!([0.0, 0.0]);
    let scene = document.open().expect("opens");
    let told: Vec<String> = scene.warnings.iter().map(ToString::to_string).collect();
    for part in [
        "not finite at 1 vertex, which it does not displace",
        "it has 1 elements, and POSITION has 3; it displaces nothing",
    ] {
        assert!(told.iter().any(|warning| warning.contains(part)), "{part}: {told:?}");
    }
    assert_eq!(positions(&scene, 1.0), [DVec3::new(1.0, 0.0, 1.0), DVec3::Y, DVec3::Z * 2.0]);
}
