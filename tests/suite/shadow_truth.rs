//! Shadows in the voxels against rays through the posed triangles: a square over a floor, whose shadow has
//! a closed form, under every kind of light and every method.

use std::sync::Arc;

use glam::{DQuat, DVec3, Vec2};
use image::{Rgba, RgbaImage};
use octolume::accuracy::alone;
use octolume::accuracy::posed_triangles::PosedTriangles;
use octolume::accuracy::shadows::{LeafPlaces, ShadowError, TrueShadows, spread};
use octolume::engine::Engine;
use octolume::lights::{KnownLight, LightSource, Shines, posed_lights};
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{AlphaMode, LightKind, LocalTransform, Material, Node, Scene, Texture, TextureRef, Trs, Wrap};
use octolume::settings::lighting::{AddedLight, LightEdit, Shadows, SunShines};
use octolume::settings::{ColorBy, Hidden, Settings};

use crate::device;
use crate::mesh_rig::{node, one_square};

const POINTS: usize = 20_000;
/// Half sides of floor and square, and how high the square is: scene units.
const FLOOR: f64 = 8.0;
const SQUARE: f64 = 2.0;
const HEIGHT: f64 = 4.0;
const BULB_HEIGHT: f64 = 12.0;
/// Floor, and the square's upper side.
const AREA: f64 = 4.0 * (FLOOR * FLOOR + SQUARE * SQUARE);

/// Level, facing up.
fn level(height: f64, half: f64) -> LocalTransform {
    let rotation = DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    LocalTransform::Trs(Trs { translation: DVec3::Y * height, rotation, scale: DVec3::splat(half) })
}

fn scene(material: Material) -> Scene {
    let mut scene = one_square(material);
    scene.nodes[0].local = level(0.0, FLOOR);
    scene.nodes.push(Node { mesh: Some(0), local: level(HEIGHT, SQUARE), ..node("over", DVec3::ZERO) });
    scene
}

fn settings() -> Settings {
    let mut settings = Settings::default();
    settings.method.discretization.grid = 64;
    settings.method.look.color = ColorBy::Radiance;
    settings.method.lighting.shadow_map_px = 1024;
    settings
}

fn under_sun(direction: [f64; 3]) -> Settings {
    let mut settings = settings();
    (settings.method.lighting.sun.direction, settings.method.lighting.sun.shines) = (direction, SunShines::Always);
    settings
}

fn under_bulb() -> Settings {
    let mut settings = settings();
    settings.method.lighting.sun.shines = SunShines::Never;
    let bulb = AddedLight::new("bulb".to_owned(), LightKind::POINT);
    settings.method.lighting.added.push(AddedLight { position: [0.0, BULB_HEIGHT, 0.0], ..bulb });
    settings
}

fn prepared(scene: Scene) -> Arc<Prepared> {
    let prepared = prepare(Arc::new(scene), &settings().method.discretization, None, &Progress::default());
    Arc::new(prepared.unwrap_or_else(|error| panic!("{error}")))
}

fn posed(prepared: &Prepared) -> PosedTriangles<'_> {
    PosedTriangles::new(prepared, &settings().shot.motion, &Hidden::default()).expect("a pose")
}

fn lit(engine: &mut Engine, settings: &Settings, shadows: Shadows) -> Vec<[f32; 3]> {
    let mut settings = settings.clone();
    settings.method.lighting.shadows = shadows;
    engine.request(&settings, [1, 1]).expect("a frame");
    engine.run_to_end().expect("runs");
    engine.read_irradiance().expect("is lit")
}

/// By shadow map, by marching, and with none.
fn errors(settings: &Settings) -> ([ShadowError; 3], f64) {
    let prepared = prepared(scene(Material::default()));
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::clone(&prepared)));
    let found = [Shadows::Map, Shadows::March, Shadows::Off].map(|shadows| lit(&mut engine, settings, shadows));
    let triangles = posed(&prepared);
    let leaves = LeafPlaces::new(&engine.read_voxels().expect("is built"), &prepared.grid);
    let pose = prepared.pose(&settings.shot.motion).expect("a pose");
    let lights = posed_lights(&prepared.scene, &pose, &settings.method.lighting, &[true; 2], false);
    let points = spread(&triangles, POINTS);
    let truth = TrueShadows::new(&triangles, &points, &lights[0], &prepared.grid, &leaves);
    (found.each_ref().map(|shadowed| truth.compare(shadowed, &found[2])), prepared.grid.span)
}

/// A light, the half side of the square's shadow, and how fast rays to the light leave the vertical at it.
fn cases() -> [(Settings, f64, f64); 3] {
    let grown = SQUARE * BULB_HEIGHT / (BULB_HEIGHT - HEIGHT);
    [
        (under_sun([0.0, -1.0, 0.0]), SQUARE, 0.0),
        (under_sun([0.5, -1.0, 0.3]), SQUARE, 0.5),
        (under_bulb(), grown, grown / BULB_HEIGHT),
    ]
}

#[test]
fn a_square_shades_as_much_of_the_floor_in_truth_as_its_closed_form_says() {
    for (settings, half, _) in cases() {
        let ([_, _, off], span) = errors(&settings);
        let hidden = 4.0 * half * half / AREA;
        // Points are this far apart, so that as many may lie on the wrong side of the border.
        let apart = (AREA / POINTS as f64).sqrt();
        let tolerance = 8.0 * half * apart / AREA;
        assert!((off.lit_percent / 100.0 - (1.0 - hidden)).abs() < tolerance, "{off:?}: {hidden} is hidden");
        assert_eq!((off.points + off.without_leaf, off.turned_away), (POINTS as u64, 0));
        // A cell of which a corner of floor or square covers less than a quarter may have no thin voxel.
        let in_a_cell = POINTS as f64 * span * span / AREA;
        assert!(off.without_leaf as f64 <= 8.0 * in_a_cell / 4.0, "{off:?}");
        // Without shadows all that is dark in truth is an error, and nothing else is.
        assert_eq!((off.lost_percent, off.mean_error_percent), (0.0, off.leaked_percent));
        assert!((off.leaked_percent + off.lit_percent - 100.0).abs() < 1e-9, "{off:?}");
    }
}

#[test]
fn maps_and_marching_err_at_the_border_of_the_shadow_alone() {
    for (settings, half, slope) in cases() {
        let ([mapped, marched, _], span) = errors(&settings);
        let grown = half / SQUARE;
        // A point is half a cell from its leaf's centre, which looks from up to 1/2 + 3/2 cells above the
        // floor; texels are less than 1/5 cell, and four of them are blended.
        let map_cells = 0.5 + 2.0 * slope + 2.0 * 0.2;
        // The square's leaves reach a cell beyond it, and half a cell above or below.
        let march_cells = map_cells + grown * (1.0 + slope);
        for (error, cells) in [(mapped, map_cells), (marched, march_cells)] {
            let band = 2.0 * cells * span;
            let percent = 100.0 * (8.0 * half + 4.0 * band) * band / AREA;
            assert!(error.mean_error_percent < percent, "{error:?} is not below {percent} %");
            assert!(error.lost_percent + error.leaked_percent < percent, "{error:?} is not below {percent} %");
            assert!(error.lit_percent < 99.0, "{error:?}");
        }
    }
}

#[test]
fn points_are_spread_evenly_by_area_and_holes_have_none() {
    let solid = prepared(scene(Material::default()));
    let triangles = posed(&solid);
    let points = spread(&triangles, POINTS);
    assert_eq!((triangles.len(), points.len()), (4, POINTS));
    assert_eq!(points, spread(&triangles, POINTS));
    let size = 1.0 / solid.grid.span;
    assert!((triangles.areas().sum::<f64>() - AREA * size * size).abs() < 1e-6 * AREA * size * size);
    // As many in each of 8 x 8 parts of the floor.
    let corner = solid.grid.grid_from_world().transform_point3(DVec3::new(-FLOOR, 0.0, -FLOOR));
    let mut counts = [[0_u32; 8]; 8];
    for point in points.iter().filter(|point| (point.position.y - corner.y).abs() < 1e-6) {
        let part = ((point.position - corner) / (2.0 * FLOOR * size) * 8.0).clamp(DVec3::ZERO, DVec3::splat(7.9));
        counts[part.x as usize][part.z as usize] += 1;
        assert!((point.face.y.abs() - 1.0).abs() < 1e-12 && (point.shading - DVec3::Y).length() < 1e-6, "{point:?}");
    }
    let mean = POINTS as f64 * 4.0 * FLOOR * FLOOR / AREA / 64.0;
    // Along the border of a part every point may be on the wrong side.
    let slack = 4.0 * mean.sqrt();
    assert!(counts.iter().flatten().all(|&count| (f64::from(count) - mean).abs() < slack), "{mean}: {counts:?}");
    let mask = AlphaMode::Mask { cutoff: 0.5 };
    let gone = prepared(scene(Material { alpha_mode: mask, base_color: [1.0, 1.0, 1.0, 0.4], ..Material::default() }));
    assert!(spread(&posed(&gone), POINTS).is_empty());
}

/// Opaque left of the middle, `alpha` right of it.
fn half_there(alpha: u8, alpha_mode: AlphaMode) -> Scene {
    let image = RgbaImage::from_fn(2, 1, |x, _| Rgba([255, 255, 255, if x == 0 { 255 } else { alpha }]));
    let texture =
        Texture { name: "half".to_owned(), image: Arc::new(image), wrap: [Wrap::ClampToEdge; 2], nearest: true };
    let slot = TextureRef { uv_from_tex_coord: glam::Affine2::from_scale(Vec2::ONE), ..TextureRef::new(0, 0) };
    let mut scene = scene(Material { alpha_mode, base_color_texture: Some(slot), ..Material::default() });
    scene.textures.push(texture);
    scene
}

#[test]
fn what_alpha_cuts_out_hides_nothing() {
    let mask = AlphaMode::Mask { cutoff: 0.25 };
    // Alpha right of the middle in 255ths, mode, and whether it hides there.
    let cases = [
        (0, mask, false),
        (63, mask, false),
        (64, mask, true),
        (127, AlphaMode::Blend, false),
        (128, AlphaMode::Blend, true),
        (0, AlphaMode::Opaque, true),
    ];
    for (alpha, mode, expected) in cases {
        let prepared = prepared(half_there(alpha, mode));
        let triangles = posed(&prepared);
        let to_grid = prepared.grid.grid_from_world();
        let is_hidden = |x: f64, z: f64| {
            let from = to_grid.transform_point3(DVec3::new(x, HEIGHT / 2.0, z));
            triangles.is_hidden(from, DVec3::Y, f64::INFINITY)
        };
        for z in [-1.5, -0.1, 0.7] {
            assert!(is_hidden(-1.0, z), "{mode:?} {alpha}");
            assert_eq!(is_hidden(1.0, z), expected, "{mode:?} {alpha}");
        }
    }
}

#[test]
fn one_light_alone_is_what_is_left() {
    let mut scene = scene(Material::default());
    scene.lights.push(octolume::scene::Light {
        name: "lamp".to_owned(),
        kind: LightKind::POINT,
        color: [1.0, 0.5, 0.0],
        intensity: 3.0,
    });
    scene.nodes[1].light = Some(0);
    let prepared = prepared(scene);
    let mut settings = under_sun([0.0, -1.0, 0.0]);
    settings.method.lighting.added = under_bulb().method.lighting.added;
    settings.method.lighting.sky_nits = [1.0; 3];
    let known = prepared.known_lights(&settings).expect("known");
    assert_eq!(known.len(), 3);
    for light in &known {
        let lighting = alone(&settings.method.lighting, &known, light.source);
        assert_eq!((lighting.sky_nits, lighting.emission), ([0.0; 3], 0.0));
        let mut left = settings.clone();
        left.method.lighting = lighting;
        let left = prepared.known_lights(&left).expect("known");
        let shining: Vec<(LightSource, LightEdit)> =
            left.iter().filter(|light| light.shines == Shines::Yes).map(|light| (light.source, light.light)).collect();
        assert_eq!(shining, [(light.source, light.light)]);
    }
    let sources: Vec<LightSource> = known.iter().map(|light: &KnownLight| light.source).collect();
    assert_eq!(sources, [LightSource::Node(1), LightSource::Sun, LightSource::Added(0)]);
}

#[test]
fn irradiance_of_what_is_not_lit_is_an_error() {
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(prepared(scene(Material::default()))));
    let mut settings = under_bulb();
    settings.method.look.color = ColorBy::Albedo;
    engine.request(&settings, [1, 1]).expect("a frame");
    engine.run_to_end().expect("runs");
    let error = engine.read_irradiance().expect_err("not lit").to_string();
    assert!(error.contains("irradiance") && error.contains("before any stage has made it"), "{error}");
    settings.method.look.color = ColorBy::Radiance;
    let lit = lit(&mut engine, &settings, Shadows::Off);
    assert_eq!(lit.len(), engine.read_voxels().expect("is built").cells.len());
    assert!(lit.iter().flatten().all(|lux| lux.is_finite() && *lux >= 0.0) && lit.iter().any(|lux| lux[0] > 0.0));
}
