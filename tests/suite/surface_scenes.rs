//! The surface image and direct light of real scenes beside rays: what the path tracer's camera rays meet,
//! and its direct light, which share no code with the shaders.

use std::sync::Arc;

use glam::DVec3;
use octolume::accuracy::path_tracer::{Options, PixelSampling, Reflection, Term, TracedScene};
use octolume::accuracy::posed_triangles::{PosedTriangles, SurfacePoint};
use octolume::accuracy::ray_tree::Segment;
use octolume::data::surface_image::SurfaceTexel;
use octolume::lights::posed_lights;
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{self, AlphaMode, Material, OrbitCamera};
use octolume::settings::lighting::SunShines;
use octolume::settings::{Hidden, Settings};
use octolume::stages::surface::LEAST_EYE_COSINE;

use crate::real_scenes::real_scenes as folder;
use crate::surface_rig::{Hiding, Shot, is_there};

const SIZE_PX: [u32; 2] = [160, 90];

/// A file below the folder of real scenes, and where it is seen from if not from its own camera.
struct RealScene {
    file: &'static str,
    from: Option<[DVec3; 2]>,
}

fn real_scenes() -> [RealScene; 3] {
    let nave = [DVec3::new(4.0, 1.5, 0.0), DVec3::new(0.0, 1.5, 3.0)];
    [
        RealScene { file: "CornellBox/CornellBox.glb", from: None },
        RealScene {
            file: "KayKit-Knight/Knight.glb",
            from: Some([DVec3::new(0.8, 1.8, 2.2), DVec3::new(0.0, 1.1, 0.0)]),
        },
        RealScene { file: "Sponza/Sponza.gltf", from: Some(nave) },
    ]
}

impl RealScene {
    /// `None`: it is not there.
    fn opened(&self) -> Option<(Prepared, Settings)> {
        let scene = scene::load::open(&folder()?.join(self.file), &Progress::default()).expect("a scene");
        let mut settings = Settings::default();
        settings.method.discretization.grid = 64;
        settings.shot.camera = self.from.map(|[eye, target]| OrbitCamera::new(eye, target, 60.0));
        let prepared = prepare(Arc::new(scene), &settings.method.discretization, None, &Progress::default());
        Some((prepared.expect("fits"), settings))
    }
}

fn shot<'a>(prepared: &'a Prepared, settings: &Settings) -> Shot<'a> {
    let pose = prepared.pose(&settings.shot.motion).expect("a pose");
    let camera = prepared.camera(settings, &pose, SIZE_PX);
    Shot { pose, ..Shot::new(&prepared.scene, camera, prepared.grid, SIZE_PX) }
}

fn material<'a>(prepared: &'a Prepared, posed: &PosedTriangles<'_>, triangle: usize) -> Option<&'a Material> {
    let surface = &posed.surfaces()[posed.tree().triangles()[triangle].surface as usize];
    let mesh = prepared.objects[surface.object].object.mesh;
    prepared.scene.materials.get(prepared.scene.meshes[mesh].primitives[surface.primitive].material?)
}

/// Triangles are drawn from corners at 1/256 of a pixel, which is 2 · tan 30° / 90 of the distance wide: 5e-5 of it on
/// what is seen straight on, twice that at 60°.
const ELSEWHERE: f64 = 1e-4;
/// 16 bits an axis of an octahedron, 2^-16 stretched by 3 at most, and f32 corners, 2^-24 of 64 cells, over edges
/// of 1/100 cell and more: 4e-4 each way.
const TURNED: f64 = 1e-3;

/// How many texels were compared, and how many of them are not what the ray through the pixel's middle meets.
#[derive(Debug, Default)]
struct Agreement {
    texels: usize,
    /// By more than [`ELSEWHERE`] of the distance.
    elsewhere: usize,
    /// Normals of the triangle or of its vertices by more than [`TURNED`].
    turned: usize,
    /// Albedos of materials without a texture.
    recoloured: usize,
}

fn agreement(prepared: &Prepared, shot: &Shot<'_>, posed: &PosedTriangles<'_>) -> Agreement {
    let mut found = Agreement::default();
    for (pixel, texel) in shot.drawn().texels.iter().enumerate() {
        let ray = shot.rays().ray(shot.middle(pixel));
        let from = ray.origin - ray.direction * ray.start_cells;
        let segment = Segment { from, direction: ray.direction, length: f64::INFINITY };
        let Some(met) = posed.tree().nearest(segment, |_, _| true) else { continue };
        let material = material(prepared, posed, met.triangle);
        // What cut-outs and thin surfaces let through is filtered here and not there.
        if !is_there(texel) || material.is_some_and(|material| material.alpha_mode != AlphaMode::Opaque) {
            continue;
        }
        found.texels += 1;
        if (f64::from(texel.distance_cells) - met.distance).abs() > ELSEWHERE * met.distance {
            found.elsewhere += 1;
            continue;
        }
        let point = posed.point(met.triangle, met.place).expect("has area");
        let is_smooth = material.is_none_or(|material| material.normal_texture.is_none());
        found.turned += usize::from(is_turned(texel, &point, ray.direction, is_smooth));
        if let Some(material) = material.filter(|material| material.base_color_texture.is_none()) {
            let expected = DVec3::from_slice(&material.base_color.map(f64::from));
            let apart = (DVec3::from_array(texel.albedo) - expected).abs().max_element();
            found.recoloured += usize::from(apart >= 1.0 / 255.0);
        }
    }
    found
}

/// `is_smooth`: no normal map turns the normal.
fn is_turned(texel: &SurfaceTexel, point: &SurfacePoint, direction: DVec3, is_smooth: bool) -> bool {
    let towards = |n: DVec3, side: DVec3| if n.dot(side) < 0.0 { -n } else { n };
    let face = towards(point.face, -direction);
    let smooth = towards(point.shading, face);
    let is_bent = -smooth.dot(direction) < LEAST_EYE_COSINE;
    texel.face.distance(face) > TURNED || is_smooth && !is_bent && texel.normal.distance(smooth) > TURNED
}

#[test]
fn real_scenes_are_where_rays_meet_them() {
    for real in real_scenes() {
        let Some((prepared, settings)) = real.opened() else { continue };
        let shot = shot(&prepared, &settings);
        let posed = PosedTriangles::new(&prepared, &settings.shot.motion, &Hidden::default()).expect("a pose");
        let found = agreement(&prepared, &shot, &posed);
        // Triangles are drawn from corners at 1/256 of a pixel: at an edge a ray may meet the neighbour.
        assert!(found.texels > 2000, "{}: {found:?}", real.file);
        let differ = found.elsewhere.max(found.turned).max(found.recoloured);
        assert!(differ * 100 < found.texels, "{}: {found:?}", real.file);
    }
}

/// The sun shines on all of them.
#[test]
fn direct_light_of_real_scenes_is_the_path_tracers() {
    for real in real_scenes() {
        let Some((prepared, mut settings)) = real.opened() else { continue };
        settings.method.lighting.sun.shines = SunShines::Always;
        let found = drawn_light(&prepared, &settings);
        let truth = traced_light(&prepared, &settings);
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        // Textures are filtered from mip levels here, and read at a point there.
        let is_apart = |(a, b): (&f64, &f64)| (a - b).abs() > 0.02 * (b + mean(&truth));
        let apart = found.iter().zip(&truth).filter(|pair| is_apart(*pair)).count();
        let off = mean(&found) / mean(&truth) - 1.0;
        // Edges of shadows are as wide as texels of the map: their pixels may be apart, a twentieth of all. All others
        // are within 0.02 of twice the mean, if all erred one way by 0.04.
        let what = format!("{}: {apart} pixels apart, {off} of the mean", real.file);
        println!("{what}");
        assert!(apart * 20 < truth.len() && off.abs() < 0.025, "{what}");
    }
}

/// Green of every pixel, nits.
fn drawn_light(prepared: &Prepared, settings: &Settings) -> Vec<f64> {
    let shot = shot(prepared, settings);
    let shown = prepared.shown_nodes(&settings.shot.visibility, &shot.pose).expect("all");
    let emits = prepared.emits(&settings.method.lighting);
    let lights = posed_lights(&prepared.scene, &shot.pose, &settings.method.lighting, &shown, emits);
    let found = shot.lit(&shot.drawn(), &lights, &Hiding::Map(1024));
    found.iter().map(|rgb| f64::from(rgb[1])).collect()
}

fn traced_light(prepared: &Prepared, settings: &Settings) -> Vec<f64> {
    let (pixel, reflection) = (PixelSampling::Centre, Reflection::MetallicRoughness);
    let options = Options { size_px: SIZE_PX, seed: 1, pixel, reflection };
    let traced = TracedScene::new(prepared, settings, options).expect("a pose");
    let mut film = traced.new_film();
    // Lights are not chosen by chance at what the camera sees: one sample has all of them.
    traced.trace(&mut film, 1, &Progress::default()).expect("not cancelled");
    film.image(Term::Direct).iter().map(|rgb| f64::from(rgb[1])).collect()
}
