//! A mirror on a floor shows what stands beside it.

use glam::DVec3;
use octolume::data::surface_image::SurfaceTexel;
use octolume::scene::OrbitCamera;
use octolume::settings::{ConeTracing, Lookup};

use crate::cone_forms::{CELLS, DEPTH, FLOOR, built, floor, solid};
use crate::cone_gloss::reflected;
use crate::cone_rig::{NOTHING, Photo, SPOT_PX, dull, mean, plane_distance};
use crate::device::gpu;
use crate::view_rig::grid;

/// A spot on a floor that mirrors an eye's ray along `mirrored`.
fn mirror(point: DVec3, mirrored: DVec3, roughness: f64) -> Photo {
    let grid = grid(DEPTH);
    let world = |cells: DVec3| grid.corner() + cells * grid.span;
    let eye = world(point + 30.0 * DVec3::new(-mirrored.x, -mirrored.y, mirrored.z));
    let camera = OrbitCamera::new(eye, world(point), 0.001);
    Photo::new(gpu(), (&grid, &camera), [SPOT_PX; 2], |_, ray| {
        plane_distance(ray, point, DVec3::Z)
            .map_or(NOTHING, |distance| SurfaceTexel { roughness, ..dull(distance, DVec3::Z) })
    })
}

#[test]
fn a_mirror_shows_the_lit_wall_and_the_sky_above_it() {
    const WALL: i64 = 40;
    let walls = floor(0).chain(solid([WALL, 0, FLOOR], [WALL + 8, CELLS, WALL], 0));
    let octree = built(walls, |cell| if i64::from(cell[0]) >= WALL { 7.0 } else { 0.0 });
    let point = DVec3::new(20.0, 32.0, FLOOR as f64 + 0.5);
    // Where the ray meets the wall's plane, in voxels above the floor; the wall ends at 30.
    for (height, roughness, expected) in
        [(12.0, 0.0, 7.0), (12.0, 0.2, 7.0), (20.0, 0.1, 7.0), (46.0, 0.0, 1.0), (52.0, 0.15, 1.0)]
    {
        let photo = mirror(point, DVec3::new(WALL as f64 - point.x, 0.0, height).normalize(), roughness);
        let found = mean(&reflected(gpu(), &octree.sampled(Lookup::Ranks), &photo, &ConeTracing::default(), [1.0; 3]));
        assert!((found[0] - expected).abs() < 0.02 * expected && found[3] == 1.0, "{height}, {roughness}: {found:?}");
    }
}
