//! Cones from the surfaces that a camera sees, against the f64 reference.

use glam::{DVec3, Vec3};
use octolume::data::surface_image::SurfaceTexel;
use octolume::gpu::Gpu;
use octolume::settings::lighting::Opacity;
use octolume::settings::{ConeTracing, Filter, Lookup, Sampling};
use octolume::stages::cones::diffuse::{DiffuseCones, DiffuseTerms};
use octolume::stages::cones::diffuse_ref;
use octolume::stages::light::gather::Cones;
use octolume::stages::pixels::LEAST_LIGHT;
use octolume::stages::sample::Sampler;

use crate::cone_rig::{NOTHING, Photo, diffuse, dull, source};
use crate::device::gpu;
use crate::lit_octree::LitBuild;
use crate::octree_rules::Cell;
use crate::random;
use crate::stage_build::Shape;
use crate::stage_checks::{Check, holds, same};
use crate::view_rig::{camera, grid};

pub const DEPTH: u32 = 5;
pub const SIZE_PX: [u32; 2] = [37, 21];
pub const SKY: [f32; 3] = [1.0, 2.0, 0.5];

fn colourful(cell: Cell, a: f64) -> (DVec3, f64) {
    (DVec3::from_array(cell.map(|c| f64::from(c % 5) * 0.25)), a)
}

pub fn random_octree(seed: u64, count: usize) -> LitBuild {
    LitBuild::new(gpu(), &random::scene(seed, count, DEPTH), &Shape::new(DEPTH, 2, Filter::Split), colourful)
}

/// Surfaces at all depths of the grid and around it, facing everywhere, with normals that are not their
/// faces', and background between them.
pub fn scattered() -> Photo {
    let grid = grid(DEPTH);
    let camera = camera(&grid, DVec3::new(1.0, 0.5, 1.3), 1.4);
    Photo::new(gpu(), (&grid, &camera), SIZE_PX, |[x, y], ray| {
        let i = f64::from(y * SIZE_PX[0] + x);
        if (i as u32).is_multiple_of(13) {
            return NOTHING;
        }
        let turn = |i: f64| DVec3::new((i * 0.7).sin(), (i * 1.3).cos(), (i * 2.1).sin() * 0.8).normalize();
        let (face, tilted) = (turn(i), turn(i + 0.3));
        let normal = if tilted.dot(face) > 0.2 { tilted } else { face };
        let distance = ray.start_cells + 8.0 + (i * 5.3) % 40.0;
        SurfaceTexel { normal, roughness: (i * 0.37) % 1.0, metallic: (i % 3.0) / 2.0, ..dull(distance, face) }
    })
}

/// How far a cone's mean may be off: it ends early with LEAST_LIGHT to go. A place is off by the roundings of a
/// pixel's ray and of a sum of steps, 2^-24 of 64 cells a step; α changes by at most 3 a cell, beside a horizon
/// five times that and four times as much again where the rest is made up for, and stands in a power of up to 32.
pub fn tolerance() -> f64 {
    2.0 * (LEAST_LIGHT + 3.0 * 5.0 * 4.0 * 32.0 * 64.0 * 2.0_f64.powi(-24))
}

/// What settings say of cones, by the words of the settings alone: lengths in cells of 0.25 scene units.
fn as_set(settings: &ConeTracing) -> DiffuseCones {
    let cones = Cones {
        count: settings.cones,
        aperture_degrees: settings.cone_degrees,
        start_cells: settings.start_voxels,
        step_diameters: settings.step_diameters,
        reach_cells: f64::INFINITY,
    };
    let occlusion_cells = settings.occlusion_distance.expect("set") / 0.25;
    DiffuseCones { cones, pattern_px: settings.pattern_px, occlusion_cells }
}

/// How diffuse cones are traced.
#[derive(Clone, Copy, Debug)]
pub struct Mode {
    pub pattern_px: u32,
    pub cone_degrees: f64,
    pub sampler: Sampler,
    pub terms: DiffuseTerms,
    pub size_px: [u32; 2],
}

pub const BOTH: DiffuseTerms = DiffuseTerms { radiance: true, occlusion: true };

fn modes() -> [Mode; 5] {
    let quadrilinear = Sampler::default();
    let by = |sampling| Sampler { sampling, ..Sampler::default() };
    let directional = Sampler { opacity: Opacity::Directional, ..quadrilinear };
    let [light, occlusion] = [true, false].map(|radiance| DiffuseTerms { radiance, occlusion: !radiance });
    let mode =
        |pattern_px, cone_degrees, sampler, terms, size_px| Mode { pattern_px, cone_degrees, sampler, terms, size_px };
    [
        mode(1, 2.0, quadrilinear, BOTH, SIZE_PX),
        mode(2, 30.0, directional, light, [19, 11]),
        mode(4, 30.0, by(Sampling::Trilinear), BOTH, [19, 11]),
        mode(4, 90.0, quadrilinear, occlusion, SIZE_PX),
        mode(2, 90.0, by(Sampling::Nearest), light, [12, 7]),
    ]
}

/// Diffuse cones against the reference.
pub fn check_diffuse(gpu: &Gpu, mode: &Mode) -> Check {
    let photo = scattered();
    let Mode { pattern_px, cone_degrees, sampler, terms, size_px } = *mode;
    let octree = random_octree(21 + u64::from(pattern_px), 1500);
    let settings = ConeTracing { cones: 3, pattern_px, cone_degrees, ..occluded() };
    let cones = DiffuseCones::new(&settings, 1 << DEPTH, 0.25);
    let expected_cones = as_set(&settings);
    let sampled = octree.sampled(Lookup::Ranks);
    let found = diffuse(gpu, (&sampled, &sampler), &photo, (&cones, terms), (SKY, size_px));
    let lit = octree.lit(sampler.opacity);
    let mut compared = 0;
    for (i, found) in found.iter().enumerate() {
        let pixel = [i as u32 % size_px[0], i as u32 / size_px[0]];
        let Some(point) = photo.point(source(&photo, pixel, size_px)) else {
            same("background", found, &[0.0, 0.0, 0.0, 1.0])?;
            continue;
        };
        let sky = Vec3::from_array(SKY).as_dvec3();
        let rules = (&expected_cones, sampler.sampling, terms);
        let (radiance, open) = diffuse_ref::diffuse(&lit, rules, sky, &point, pixel);
        let off = (Vec3::from_slice(found).as_dvec3() - radiance).abs().max_element();
        // Nodes begin where others end: a place beside a border is in either.
        let may_jump = sampler.sampling == Sampling::Nearest && off < 0.5;
        let limit = tolerance();
        let off = off.max((f64::from(found[3]) - open).abs());
        holds(off < limit || may_jump, || {
            format!("{pixel:?} {settings:?} {sampler:?}: {found:?}, not {radiance} {open}")
        })?;
        compared += 1;
    }
    holds(compared * 2 > found.len(), || format!("{compared} pixels"))
}

/// Things within 7.5 cells occlude.
fn occluded() -> ConeTracing {
    ConeTracing { occlusion_distance: Some(1.875), ..ConeTracing::default() }
}

#[test]
fn diffuse_cones_match_the_reference_in_every_mode() {
    for mode in modes() {
        assert_eq!(check_diffuse(gpu(), &mode), Ok(()), "{mode:?}");
    }
}

#[test]
fn every_look_up_traces_the_same_bits() {
    let octree = random_octree(31, 1500);
    let photo = scattered();
    let cones = DiffuseCones::new(&ConeTracing::default(), 1 << DEPTH, 0.25);
    let bits = [Lookup::Ranks, Lookup::BlockPointers, Lookup::NodePointers].map(|lookup| {
        let sampler = Sampler { lookup, ..Sampler::default() };
        let input = (&octree.sampled(lookup), &sampler);
        bytemuck::pod_collect_to_vec::<[f32; 4], u32>(&diffuse(gpu(), input, &photo, (&cones, BOTH), (SKY, SIZE_PX)))
    });
    assert!(bits[0] == bits[1] && bits[0] == bits[2]);
}
