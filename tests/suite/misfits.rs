//! Settings that do not fit the scene or the grid: what stands in for them is told, a sentence each.

use std::sync::Arc;

use octolume::engine::Engine;
use octolume::prepare::prepare;
use octolume::progress::Progress;
use octolume::scene::LightKind;
use octolume::settings::lighting::{AddedLight, Shadows};
use octolume::settings::{ColorBy, Settings, View};

use crate::device;
use crate::scenes::sliding_scene;

type Change = fn(&mut Settings);

/// Of a clip of 1.7 s in a grid of 64 cells.
fn told(change: Change) -> Vec<String> {
    let mut settings = Settings::default();
    settings.method.discretization.grid = 64;
    change(&mut settings);
    let discretization = &settings.method.discretization;
    let prepared = prepare(Arc::new(sliding_scene()), discretization, None, &Progress::default()).expect("it fits");
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::new(prepared)));
    engine.request(&settings, [8, 8]).expect("a request");
    engine.left_out()
}

fn with_bulb(settings: &mut Settings) {
    settings.method.look.color = ColorBy::Radiance;
    settings.method.lighting.shadow_map_px = 8192;
    settings.method.lighting.added = vec![AddedLight::new("bulb".to_owned(), LightKind::POINT)];
}

#[test]
fn what_does_not_fit_is_told_with_what_stands_in_for_it() {
    let cases: [(Change, &str); 7] = [
        (|s| s.shot.motion.time_secs = 2.0, "clip \"clip\" ends at 1.7 s; its last pose is shown"),
        (
            |s| (s.shot.motion.time_secs, s.shot.motion.clip) = (2.0, Some(String::new())),
            "no clip is played, so the time changes nothing",
        ),
        (
            |s| s.method.discretization.dense_level = Some(6),
            "dense level 6 does not fit a grid of 64 cells, whose leaves are level 6: levels 0 to 5 are stored densely",
        ),
        (
            |s| (s.method.look.color, s.method.look.level) = (ColorBy::Object, Some(3)),
            "only leaves know their object: level 3 is coloured by albedo",
        ),
        (
            |s| (s.method.look.view, s.method.look.slice.width_cells) = (View::Slice, 65.0),
            "samples of 65 cells are wider than the grid of 64: the root is sampled",
        ),
        (
            with_bulb,
            "shadow maps of 8192 texels along an edge would take 640.0 MiB, and all may take 256.0 MiB together: \
             they have 4096",
        ),
        (
            |s| (s.method.look.view, s.method.look.shadow_map) = (View::ShadowMap, 2),
            "there is no shadow map 2: they are 0 to 0, and 0 is shown",
        ),
    ];
    for (change, sentence) in cases {
        assert_eq!(told(change), [sentence]);
    }
}

#[test]
fn what_fits_or_is_not_looked_at_is_not_told() {
    let cases: [Change; 6] = [
        |_| (),
        |s| s.method.discretization.dense_level = Some(5),
        |s| (s.method.look.view, s.method.discretization.dense_level) = (View::Mesh, Some(6)),
        |s| s.method.look.slice.width_cells = 65.0,
        |s| (with_bulb(s), s.method.lighting.shadows = Shadows::March).1,
        |s| (with_bulb(s), s.method.look.color = ColorBy::Albedo).1,
    ];
    for (number, change) in cases.into_iter().enumerate() {
        assert_eq!(told(change), [""; 0], "case {number}");
    }
}

/// In the window, a level outlives the grid it was chosen in.
#[test]
fn a_level_of_a_finer_grid_is_told() {
    let sentence = "level 7 is not one of 0 (the root) to 6 (the leaves): the leaves are shown";
    assert_eq!(told(|s| s.method.look.level = Some(7)), [sentence]);
    assert_eq!(told(|s| (s.method.look.level, s.method.look.view) = (Some(7), View::Mesh)), [""; 0]);
}
