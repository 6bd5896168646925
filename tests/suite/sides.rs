//! Single-sided surfaces are there for who looks at their front, and for nobody behind them: in pictures, shadow maps
//! and paths, turned, mirrored or skinned. Double-sided ones face whoever looks.

use glam::{DQuat, DVec3, Vec3};
use octolume::accuracy::path_tracer::Term;
use octolume::accuracy::posed_triangles::PosedTriangles;
use octolume::scene::{LightKind, LocalTransform, Material, Primitive, Scene, Trs};
use octolume::settings::Hidden;
use octolume::stages::pixels::NO_DEPTH;

use crate::device::{gpu, open};
use crate::light_rig::{light, sun};
use crate::mesh_rig::{drawn, look, one_square, skinned_square};
use crate::path_tracer_rig::{floor, looking, material, mean, of_panels, panel, prepared, traced, under_sky};
use crate::shadow_maps::{mapped, occluder, read_map};
use crate::surface_image::{self, inside};
use crate::surface_rig::is_there;

const IN_FRONT: [(f64, f64); 2] = [(0.0, 1.0), (0.0, -1.0)];
const BEHIND: [(f64, f64); 2] = [(180.0, 1.0), (180.0, -1.0)];

const SPOT: LightKind = LightKind::Spot { range: None, inner_cone_radians: 0.0, outer_cone_radians: 0.7 };

/// Seen from the front where it is not turned, mirrored or not.
fn turned(double_sided: bool, (turn_degrees, scale_x): (f64, f64)) -> Scene {
    let mut scene = one_square(Material { double_sided, ..Material::default() });
    scene.nodes[0].local = LocalTransform::Trs(Trs {
        rotation: DQuat::from_rotation_y(turn_degrees.to_radians()),
        scale: DVec3::new(scale_x, 1.0, 1.0),
        ..Trs::default()
    });
    scene
}

#[test]
fn pictures_show_the_front_of_single_sided_surfaces_and_both_of_others() {
    let gpu = open();
    for double_sided in [false, true] {
        for side in IN_FRONT.into_iter().chain(BEHIND) {
            let scene = turned(double_sided, side);
            let is_shown = double_sided || IN_FRONT.contains(&side);
            for (place, texel) in inside(&surface_image::drawn(&scene)) {
                assert_eq!(is_there(texel), is_shown, "double sided: {double_sided}, {side:?}, at {place}");
                if is_shown {
                    assert!(texel.face.distance(DVec3::Z) < 1e-4, "{} of {side:?} at {place}", texel.face);
                    assert!(texel.normal.distance(DVec3::Z) < 1e-4, "{} of {side:?} at {place}", texel.normal);
                }
            }
            let distances = drawn(&gpu, scene, &look()).distances;
            assert_eq!(distances.iter().any(|distance| *distance != NO_DEPTH), is_shown, "{double_sided}, {side:?}");
        }
    }
}

/// The joints' matrices decide, not the node's.
#[test]
fn skinned_surfaces_are_mirrored_by_their_joints() {
    let mirror = Trs { scale: DVec3::new(-1.0, 1.0, 1.0), ..Trs::default() };
    for (joints, node) in [(false, false), (true, false), (false, true)] {
        let mut scene = skinned_square([DVec3::ZERO; 2], [[0.5, 0.5, 0.0, 0.0]; 4]);
        let mirrored = |scene: &mut Scene, index: usize| scene.nodes[index].local = LocalTransform::Trs(mirror);
        (1..3).filter(|_| joints).for_each(|joint| mirrored(&mut scene, joint));
        if node {
            mirrored(&mut scene, 0);
        }
        for (place, texel) in inside(&surface_image::drawn(&scene)) {
            assert!(is_there(texel), "mirrored joints: {joints}, node: {node}, at {place}");
        }
        let mirrored = scene.mirrored_vertices(&scene.objects()[0], 0, &scene.pose(None, 0.0));
        assert_eq!(mirrored, [joints; 4]);
    }
}

/// Lights see as eyes do: what turns its back on a light casts no shadow.
#[test]
fn shadows_are_cast_by_the_sides_that_lights_see() {
    for double_sided in [false, true] {
        for is_turned in [false, true] {
            let mut scene = occluder(Material { double_sided, ..Material::default() });
            if is_turned {
                let LocalTransform::Trs(placed) = &mut scene.nodes[0].local else { panic!("is placed") };
                placed.rotation *= DQuat::from_rotation_x(std::f64::consts::PI);
            }
            for lit in [sun(DVec3::NEG_Y, 1.0), light(SPOT, DVec3::ONE, DVec3::new(16.0, 24.0, 16.0), DVec3::NEG_Y)] {
                let casts = read_map(&mapped(gpu(), &scene, &lit)).len() > 1;
                assert_eq!(casts, double_sided || !is_turned, "{double_sided}, turned: {is_turned}, {:?}", lit.kind);
            }
        }
    }
}

/// A square between a point and a light that is behind the square or before it.
#[test]
fn rays_are_stopped_by_what_lights_see() {
    for double_sided in [false, true] {
        for side in IN_FRONT.into_iter().chain(BEHIND) {
            let settings = looking(DVec3::Z * 4.0, DVec3::ZERO);
            let prepared = prepared(turned(double_sided, side), &settings);
            let triangles = PosedTriangles::new(&prepared, &settings.shot.motion, &Hidden::default()).expect("a pose");
            let from = |z: f64| prepared.grid.grid_from_world().transform_point3(DVec3::new(0.2, 0.1, z));
            let before = triangles.is_hidden(from(-1.0), DVec3::Z, f64::INFINITY);
            let behind = triangles.is_hidden(from(1.0), DVec3::NEG_Z, f64::INFINITY);
            let is_in_front = IN_FRONT.contains(&side);
            assert_eq!((before, behind), (double_sided || is_in_front, double_sided || !is_in_front), "{side:?}");
        }
    }
}

fn inverted(primitive: Primitive) -> Primitive {
    let triangles = primitive.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let normals = primitive.normals.iter().map(|normal| -*normal).collect::<Vec<Vec3>>();
    Primitive { triangles, normals, ..primitive }
}

/// A black lid over a white floor, under a sky: from above, a lid that faces down hides nothing; its lower side hides
/// the sky from the floor all the same, but for what comes in past its edges, 8 away and 1 high.
#[test]
fn a_lid_that_faces_down_is_seen_from_below_only() {
    let lid = || panel(DVec3::Y, DVec3::X * 8.0, DVec3::NEG_Z * 8.0, 1);
    let of = |lid| of_panels(vec![floor(8.0, 0), lid], vec![material(1.0), material(0.0)]);
    let settings = under_sky(looking(DVec3::Y * 4.0, DVec3::ZERO), 1.0);
    let above = traced(of(lid()), &settings, 64);
    assert_eq!(mean(&above, Term::FinalAll), 0.0);
    let through = traced(of(inverted(lid())), &settings, 64);
    assert!((0.001..0.05).contains(&mean(&through, Term::FinalAll)), "{}", mean(&through, Term::FinalAll));
    assert!(through.coverage().iter().all(|share| *share == 1.0));
}
