//! Defects on purpose: the assertions of the real tests must see them.

use octolume::gpu::Gpu;
use octolume::settings::lighting::Opacity;
use octolume::settings::{Filter, Sampling};
use octolume::stages::SHADERS;
use octolume::stages::light::gather::Gathered;
use octolume::stages::sample::Sampler;

use crate::cone_gloss::check_specular;
use crate::cone_light::{BOTH, Mode, check_diffuse};
use crate::cones::{check_cloth, check_random_scene};
use crate::device::gpu;
use crate::octree_rules as rules;
use crate::random;
use crate::stage_build::Shape;
use crate::stage_checks::{Check, Expected};
use crate::stage_rig::{World, world_voxel};
use crate::textures::check_halving;
use crate::transform::check_quarter_turns;
use crate::{illuminate, light_store, sampling};

#[test]
fn moving_the_corner_instead_of_the_centre_is_caught() {
    assert_eq!(check_quarter_turns(0.5), Ok(()));
    let caught = check_quarter_turns(0.0).expect_err("a turned corner lands elsewhere");
    assert!(caught.starts_with("a voxel turned by"), "{caught}");
}

#[test]
fn dropped_dummies_are_caught() {
    let voxels = random::scene(1, 200, 6);
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    let world = World::given(gpu(), &words);
    let shape = Shape::new(6, 3, Filter::Split);
    let expected = Expected::new(voxels.into_iter().map(Some).collect(), &shape);
    let [sound, mutated] = [true, false].map(|dummies| world.build(gpu(), &Shape { dummies, ..shape }));
    assert_eq!(rules::check_interpolation_corners(&sound), Ok(()));
    assert_eq!(expected.check_pyramids(&sound), Ok(()));
    let lacking = rules::check_interpolation_corners(&mutated).expect_err("corners are missing");
    assert!(lacking.contains("lacks its dummy"), "{lacking}");
    expected.check_pyramids(&mutated).expect_err("the masks differ");
    // Only the dummies are gone: the octree without them is a sound one.
    assert_eq!(rules::validate(&mutated), Ok(()));
    assert_eq!(expected.check_leaves(&mutated), Ok(()));
}

/// `check` passes the kernel as it is, and sees each of its changes: places of the text with all that it imports.
fn assert_caught(path: &str, check: impl Fn(&Gpu) -> Check, changes: &[(&str, &str)]) {
    let whole = SHADERS.embedded(path).unwrap_or_else(|error| panic!("{error}")).wgsl;
    assert_eq!(check(gpu()), Ok(()), "{path}");
    for (from, to) in changes {
        assert_eq!(whole.matches(from).count(), 1, "{path}: {from}");
        // One that does not compile panics.
        let caught = check(&gpu().with_shader(path, &whole.replace(from, to)));
        assert!(caught.is_err(), "{path}: nothing sees that \"{from}\" has become \"{to}\"");
    }
}

#[test]
fn defects_of_sampling_are_caught() {
    let caught = |sampling, opacity, change| {
        let check = |gpu: &Gpu| sampling::check_sampler(gpu, 2, (sampling, opacity));
        assert_caught("sample/sample_points.wgsl", check, &[change]);
    };
    let (isotropic, directional) = (Opacity::Isotropic, Opacity::Directional);
    caught(Sampling::Nearest, isotropic, ("let node = floor(p / width);", "let node = floor(p / width + 0.5);"));
    // Node centres lie at ½.
    caught(Sampling::Trilinear, isotropic, ("let lattice = p / width - 0.5;", "let lattice = p / width;"));
    let weights = ("select(1.0 - f, f, corner_offset(j)", "select(f, 1.0 - f, corner_offset(j)");
    caught(Sampling::Trilinear, isotropic, weights);
    let depth = ("log2(through)) / width);", "log2(through)));");
    caught(Sampling::Nearest, directional, depth);
    let mixed = ("dot(direction * direction, log2(through))", "dot(abs(direction), log2(through))");
    caught(Sampling::Nearest, directional, mixed);
    caught(Sampling::Nearest, directional, ("stored.xyz * (alpha / stored.w), alpha", "stored.xyz, alpha"));
    let blend = ("(1.0 - blend) * fine + blend * sample_trilinear", "blend * fine + (1.0 - blend) * sample_trilinear");
    caught(Sampling::Quadrilinear, isotropic, blend);
}

#[test]
fn defects_of_diffuse_cones_are_caught() {
    let changes = [
        // Half of the apex angle.
        ("max(1.0, t * cone.widening)", "max(1.0, 0.5 * t * cone.widening)"),
        ("let middle = t + 0.5 * length;", "let middle = t + length;"),
        ("transmittance(seen.w, min(length, occlusion_cells - t))", "transmittance(seen.w, length)"),
        ("dot(face, position) + HORIZON_CELLS", "dot(face, position)"),
        ("return sum / max(share, HORIZON_SHARE);", "return sum;"),
        ("let basis = basis_of(s.normal);", "let basis = basis_of(s.face);"),
        ("cosine_direction(part + i * parts,", "cosine_direction(part * params.count + i,"),
        ("2.0 * min(dot(direction, face), 0.0) * face", "min(dot(direction, face), 0.0) * face"),
        ("select(seen.open, seen.through, RADIANCE)", "seen.open"),
    ];
    let sampler = Sampler { sampling: Sampling::Trilinear, ..Sampler::default() };
    let mode = Mode { pattern_px: 4, cone_degrees: 30.0, sampler, terms: BOTH, size_px: [19, 11] };
    assert_caught("cones/diffuse.wgsl", |gpu| check_diffuse(gpu, &mode), &changes);
}

#[test]
fn defects_of_specular_cones_are_caught() {
    let changes = [
        ("reflect(s.from_eye, s.normal)", "reflect(s.from_eye, s.face)"),
        ("let tangent = roughness * roughness;", "let tangent = roughness;"),
        ("s.position + shape.start_cells * s.face", "s.position"),
        ("seen.through * params.sky", "params.sky"),
        ("s.roughness <= most_roughness", "s.roughness < 0.5 * most_roughness"),
    ];
    assert_caught("cones/specular.wgsl", check_specular, &changes);
}

#[test]
fn defects_of_gathering_are_caught() {
    let caught = |what, change| {
        let check = |gpu: &Gpu| check_random_scene(gpu, (2, 2000), (30.0, 1.0, Opacity::Isotropic), what);
        assert_caught("light/gather.wgsl", check, &[change]);
    };
    caught(Gathered::Bounce, ("center + cone.shape.start_cells * n", "center"));
    caught(Gathered::Bounce, ("(sum.through - through) / seen.w * seen.xyz", "(sum.through - through) * seen.xyz"));
    caught(Gathered::Sky, ("select(0.0, irradiance[place], SKY)", "0.0"));
    let halves = ("PI * 0.5 * (mean_radiance(center, up)", "PI * (mean_radiance(center, up)");
    assert_caught("light/gather.wgsl", check_cloth, &[halves]);
}

#[test]
fn defects_of_illumination_are_caught() {
    let changes = [
        ("var falloff = 1.0 / (distance * distance);", "var falloff = 1.0 / distance;"),
        ("1.0 - part * part * part * part", "1.0 - part * part"),
        ("falloff *= inside * inside;", "falloff *= inside;"),
        ("max(length(to_light), least_distance)", "length(to_light) + least_distance"),
        ("(1.0 - r) * SPREAD_COSINE", "(1.0 - r)"),
        ("select(min(sqrt(square), 1.0), 1.0, abs(square - 1.0) < PACKED_UNIT_SLACK)", "1.0"),
        ("irradiance[3u * slot + 1u] += arrived.y;", "irradiance[3u * slot + 1u] += arrived.x;"),
    ];
    assert_caught("light/illuminate.wgsl", illuminate::check_unhidden, &changes);
    let hidden = [
        ("let length = min(exit.t, end) - walk.t;", "let length = 1.0;"),
        ("centre + light.offset_cells * select(to.direction", "centre + select(to.direction"),
        ("through *= transmittance(leaf_occupancy(key), length);", "through *= 1.0 - leaf_occupancy(key);"),
    ];
    assert_caught("light/illuminate.wgsl", illuminate::check_marched, &hidden);
}

#[test]
fn defects_of_injection_and_averaging_are_caught() {
    let injected = [
        (" * INVERSE_PI * arriving", " * arriving"),
        ("leaving += params.emission_nits * emitted;", "leaving += 2.0 * params.emission_nits * emitted;"),
        ("vec4<f32>(leaving * opacity, opacity)", "vec4<f32>(leaving, opacity)"),
        ("f32(leaves[3u * slot]) / f32(FULL_WEIGHT)", "1.0"),
    ];
    assert_caught("light/inject.wgsl", light_store::check_store, &injected);
    let averaged = [
        ("children.light / 8.0", "children.light / 4.0"),
        ("occupied / full)", "min(occupied / full, 0.125))"),
        ("1.0 - (1.0 - near) * (1.0 - far)", "max(near, far)"),
        ("behind(o[0].y, o[2].y)", "behind(o[0].y, o[4].y)"),
        ("vec3<f32>(light[slot].w)", "vec3<f32>(1.0)"),
        ("return vec3<f32>(x, y, z) / 4.0;", "return vec3<f32>(x, y, z);"),
    ];
    assert_caught("light/average_light.wgsl", light_store::check_store, &averaged);
}

#[test]
fn defects_of_mip_levels_are_caught() {
    assert_caught(
        "textures/halve.wgsl",
        check_halving,
        &[
            ("linear_from_gamma(texel.rgb)", "texel.rgb"),
            ("select(texel.rgb, gamma_from_linear(texel.rgb), params.are_colors != 0u)", "texel.rgb"),
            ("there += present * color", "there += part * color"),
            (">= params.least_alpha", "> params.least_alpha"),
            ("(at + 1u) * finer_size + size - 1u", "(at + 1u) * finer_size"),
        ],
    );
}
