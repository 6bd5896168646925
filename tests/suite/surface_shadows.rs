//! Shadow maps on surfaces: shadows end where rays say, and no surface shadows itself.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use octolume::scene::{LocalTransform, Scene, Trs};
use octolume::stages::light::illuminate_ref::Source;

use crate::direct_light::{floor, level, lights, shot, white};
use crate::mesh_rig::one_square;
use crate::surface_rig::{Hiding, is_there};

/// How far inside the shadow of a level square a place is, cells; negative outside.
fn inside_shadow(place: DVec3, source: Source, centre: DVec3, half: f64) -> f64 {
    let to_light = match source {
        Source::Sun(direction) => -direction,
        Source::Point(position, _) | Source::Spot(position, ..) => position - place,
    };
    let at = place + to_light * ((centre.y - place.y) / to_light.y) - centre;
    half - at.x.abs().max(at.z.abs())
}

/// A square over a floor: the floor is dark where its shadow falls, and neither surface shadows itself.
#[test]
fn shadows_fall_where_rays_say_and_nothing_shadows_itself() {
    let centre = DVec3::new(15.0, 8.0, 15.0);
    let mut scene = floor(white());
    scene.nodes.push(level("over", centre, 3.0));
    let shot = shot(&scene);
    let surfaces = shot.drawn();
    for (posed, light) in lights() {
        let open = shot.lit(&surfaces, std::slice::from_ref(&posed), &Hiding::Nothing);
        let hidden = shot.lit(&surfaces, &[posed], &Hiding::Map(256));
        let (mut dark, mut bright) = (0, 0);
        for (pixel, texel) in surfaces.texels.iter().enumerate().filter(|(_, texel)| is_there(texel)) {
            let (place, _) = shot.place(pixel, texel);
            let inside = if place.y > 5.0 { -1e9 } else { inside_shadow(place, light.source, centre, 3.0) };
            // A texel of the widest map, on each side of the shadow's edge.
            if inside.abs() < 2.0 * 64.0 / 128.0 || open[pixel][1] == 0.0 {
                continue;
            }
            let expected = if inside > 0.0 { 0.0 } else { open[pixel][1] };
            assert_eq!(hidden[pixel][1], expected, "{:?} at {place}, {inside} inside", light.source);
            (dark, bright) = (dark + usize::from(inside > 0.0), bright + usize::from(inside < 0.0));
        }
        assert!(dark > 10 && bright > 500, "{:?}: {dark} dark, {bright} bright", light.source);
    }
}

/// A sphere, its vertices' normals its own: no pixel that faces the light by more than the facets differ is dark.
#[test]
fn a_smooth_sphere_does_not_shadow_itself() {
    let scene = sphere();
    let shot = shot(&scene);
    let surfaces = shot.drawn();
    for (posed, light) in lights() {
        let open = shot.lit(&surfaces, std::slice::from_ref(&posed), &Hiding::Nothing);
        let hidden = shot.lit(&surfaces, &[posed], &Hiding::Map(256));
        let pixels = surfaces.texels.iter().enumerate().filter(|(pixel, _)| open[*pixel][1] > 0.0);
        let mut count = 0;
        for (pixel, texel) in pixels {
            assert_eq!(open[pixel][1], hidden[pixel][1], "{:?} at {:?}", light.source, shot.place(pixel, texel).0);
            count += 1;
        }
        assert!(count > 100, "{count}");
    }
}

fn sphere() -> Scene {
    const ROWS: u32 = 24;
    let mut scene = one_square(white());
    let primitive = &mut scene.meshes[0].primitives[0];
    let point = |row: u32, column: u32| {
        let (down, turn) = (PI * f64::from(row) / f64::from(ROWS), PI * f64::from(column) / f64::from(ROWS));
        DVec3::new(down.sin() * turn.sin(), down.cos(), down.sin() * turn.cos()).as_vec3()
    };
    let count = 2 * ROWS + 1;
    let points: Vec<Vec3> = (0..=ROWS).flat_map(|row| (0..count).map(move |column| point(row, column))).collect();
    primitive.normals = points.clone();
    primitive.positions = points;
    primitive.tex_coords = [vec![], vec![]];
    let quads = (0..ROWS).flat_map(|row| (0..2 * ROWS).map(move |column| row * count + column));
    primitive.triangles = quads.flat_map(|a| [[a, a + count, a + 1], [a + 1, a + count, a + count + 1]]).collect();
    scene.nodes[0].local = LocalTransform::Trs(Trs {
        translation: DVec3::new(16.0, 6.0, 16.0),
        scale: DVec3::splat(6.0),
        ..Trs::default()
    });
    scene
}
