//! What is shown of lit surfaces: every term against its reference, and the picture of it.

use glam::DVec3;
use octolume::data::surface_image::{SurfaceImage, SurfaceTexel};
use octolume::gpu::{Gpu, GpuBuffer, Job, Recorder};
use octolume::settings::{ColorBy, Look, SurfaceView, ToneCurve};
use octolume::stages::pixels::camera::PixelRays;
use octolume::stages::pixels::{NO_DEPTH, Picture, ViewParams};
use octolume::stages::surface::brdf_ref;
use octolume::stages::surface::compose::{self, ComposeParams, Terms};
use octolume::stages::surface::compose_ref::{self, Light};
use octolume::stages::view::palette::legend_value;
use octolume::stages::view::show_surfaces::{self, ShowSurfacesParams, ShownExposure};
use octolume::stages::view::{Palette, show_surfaces_ref};
use wgpu::BufferUsages;

use crate::device::gpu;
use crate::view_rig::{self, Numbers, SIZE_PX, pixels};

/// Every part of the light and of the surfaces that can be shown.
pub const ALL: [SurfaceView; 10] = [
    SurfaceView::Final,
    SurfaceView::Direct,
    SurfaceView::Diffuse,
    SurfaceView::Specular,
    SurfaceView::Ao,
    SurfaceView::Irradiance,
    SurfaceView::Albedo,
    SurfaceView::Normal,
    SurfaceView::Depth,
    SurfaceView::Roughness,
];
const GLOSSY: f64 = 0.5;
const SPAN: f64 = 0.25;
/// Of pictures of light.
const EXPOSURE: f64 = 0.02;
const SKY: [f32; 3] = [3.0, 5.0, 9.0];

/// Random surfaces in random light; every seventh pixel sees none.
struct Rig {
    rays: PixelRays,
    texels: Vec<SurfaceTexel>,
    lights: Vec<Light>,
    image: SurfaceImage,
    view: ViewParams,
}

fn rig(gpu: &Gpu) -> Rig {
    let grid = view_rig::grid(6);
    let rays = PixelRays::new(&view_rig::camera(&grid, DVec3::new(1.0, 0.6, 2.0), 1.5), &grid, SIZE_PX);
    let mut numbers = Numbers(7);
    let mut share = || f64::from(numbers.below(1001)) / 1000.0;
    let (mut texels, mut lights) = (Vec::new(), Vec::new());
    for (i, at) in pixels() {
        let to_eye = -rays.ray(at).direction;
        let aside = DVec3::new(share() - 0.5, share() - 0.5, share() - 0.5);
        let albedo = [share(), share(), share()];
        // Stored in 8 bits, and here exactly.
        let [roughness, metallic] = [share(), share()].map(|value| (value * 255.0).round() / 255.0);
        let normal = (to_eye + aside).normalize();
        let distance_cells = if i % 7 == 0 { NO_DEPTH } else { 10.0 + i as f32 };
        let texel =
            SurfaceTexel { distance_cells, normal, face: to_eye, albedo, roughness, metallic, emission_nits: [0.0; 3] };
        let (near, stuff) = texel.encode();
        texels.push(SurfaceTexel::decode(near, stuff));
        let mut color = |most: f64| DVec3::new(share(), share(), share()) * most;
        lights.push(Light { direct: color(20.0), mean: color(1e5), open_share: color(1.0).x, specular: color(10.0) });
    }
    let image = SurfaceImage::new(gpu, SIZE_PX).expect("small");
    image.write(gpu, &texels);
    Rig { view: ViewParams::new(&rays, &Look::default(), grid.depth), rays, texels, lights, image }
}

fn upload(gpu: &Gpu, lights: &[Light], value: impl Fn(&Light) -> (DVec3, f64)) -> GpuBuffer {
    let pixels: Vec<[f32; 4]> = lights.iter().map(value).map(|(rgb, a)| rgb.extend(a).as_vec4().to_array()).collect();
    gpu.upload("a term", &pixels).expect("small")
}

fn buffer(gpu: &Gpu, bytes: u64) -> GpuBuffer {
    gpu.buffer("out", bytes, BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST).expect("small")
}

impl Rig {
    fn shown(&self, gpu: &Gpu, surface: SurfaceView) -> Vec<[f32; 4]> {
        let direct = upload(gpu, &self.lights, |light| (light.direct, 1.0));
        let diffuse = upload(gpu, &self.lights, |light| (light.mean, light.open_share));
        let specular = upload(gpu, &self.lights, |light| (light.specular, 1.0));
        let terms =
            Terms { direct: Some(&direct), diffuse: Some(&diffuse), specular: Some(&specular), nothing: &direct };
        self.composed(gpu, surface, terms)
    }

    fn composed(&self, gpu: &Gpu, surface: SurfaceView, terms: Terms<'_>) -> Vec<[f32; 4]> {
        let params =
            ComposeParams { sky: SKY, glossy_roughness: GLOSSY as f32, span: SPAN as f32, pad: 0, pad_end: [0; 2] };
        let shown = buffer(gpu, 16 * self.texels.len() as u64);
        let mut frame = Recorder::default();
        compose::record(gpu, &mut frame, &self.image, (&self.view, &params), (surface, terms), &shown);
        Job::new(frame).run_to_end(gpu).expect("runs");
        gpu.read(&shown, 0..shown.bytes()).expect("readable")
    }
}

#[test]
fn every_term_is_that_of_the_reference() {
    let gpu = gpu();
    let rig = rig(gpu);
    for surface in ALL {
        for ((i, at), found) in pixels().zip(rig.shown(gpu, surface)) {
            let texel = &rig.texels[i];
            let seen = DVec3::new(found[0].into(), found[1].into(), found[2].into());
            if texel.distance_cells == NO_DEPTH {
                let sees_sky = matches!(surface, SurfaceView::Final | SurfaceView::Direct);
                let sky = DVec3::from_array(SKY.map(f64::from));
                assert_eq!((seen, found[3]), (if sees_sky { sky } else { DVec3::ZERO }, 0.0), "{surface:?}");
                continue;
            }
            let to_eye = -rig.rays.ray(at).direction;
            let expected = compose_ref::shown(surface, (texel, to_eye), &rig.lights[i], (GLOSSY, SPAN));
            // The kernel's directional albedo is a fit: its error times what it multiplies.
            let by_fit = match surface {
                SurfaceView::Final => rig.lights[i].mean.max_element() + rig.lights[i].specular.max_element(),
                SurfaceView::Diffuse | SurfaceView::Specular => rig.lights[i].mean.max_element(),
                _ => 0.0,
            };
            let tolerance = by_fit * brdf_ref::ALBEDO_FIT_ERROR + 1e-5 * expected.abs().max_element();
            let error = (seen - expected).abs().max_element();
            assert!(error <= tolerance + 1e-5, "{surface:?} at {at:?}: {seen} is not {expected} by {error}");
            assert_eq!(found[3], 1.0);
        }
    }
}

#[test]
fn what_was_not_traced_is_black() {
    let gpu = gpu();
    let rig = rig(gpu);
    let direct = upload(gpu, &rig.lights, |light| (light.direct, 1.0));
    let terms = Terms { direct: Some(&direct), diffuse: None, specular: None, nothing: &direct };
    for surface in [SurfaceView::Diffuse, SurfaceView::Specular, SurfaceView::Irradiance] {
        assert!(rig.composed(gpu, surface, terms).iter().all(|pixel| pixel[..3] == [0.0; 3]), "{surface:?}");
    }
}

#[test]
fn pictures_are_exposed_and_curved_and_scales_end_where_they_should() {
    let gpu = gpu();
    let rig = rig(gpu);
    let params = ShowSurfacesParams { least: 2.0, most: 500.0, sky: 0, pad: 0 };
    for curve in [ToneCurve::Linear, ToneCurve::Reinhard, ToneCurve::Aces] {
        for surface in ALL {
            let values = rig.shown(gpu, surface);
            let shown = gpu.upload("shown", &values).expect("small");
            let picture = Picture::new(gpu, SIZE_PX).expect("small");
            let mut frame = Recorder::default();
            let palette = Palette::new(ColorBy::Occupancy);
            let seen = (&rig.image, &shown);
            let with = (&rig.view, &palette, &params);
            let exposed = (surface, curve, ShownExposure::Set(EXPOSURE));
            show_surfaces::record(gpu, &mut frame, seen, exposed, with, &picture);
            let picture = view_rig::seen(gpu, frame, &picture);
            for (i, [r, g, b, a]) in values.into_iter().enumerate().filter(|(_, value)| value[3] > 0.0) {
                assert_eq!(picture.distances[i], rig.texels[i].distance_cells);
                let value = DVec3::new(r.into(), g.into(), b.into());
                let expected = match show_surfaces_ref::color(surface, value, EXPOSURE, curve) {
                    Some(color) => color,
                    None => {
                        let share = (500.0 - value.x) / 498.0;
                        DVec3::from_array(legend_value(ColorBy::Occupancy, share).map(|byte| f64::from(byte) / 255.0))
                    }
                };
                let error = (picture.colors[i] - expected).abs().max_element();
                let step = if surface == SurfaceView::Depth { 3.0 } else { 1.0 };
                assert!(error <= step / 255.0, "{surface:?} {curve:?}: {} is not {expected}, {a}", picture.colors[i]);
            }
        }
    }
}
