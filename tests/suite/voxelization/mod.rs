//! Which cells are covered: against brute force, closed forms, and the voxelizer's own promises.

use std::collections::BTreeSet;

use glam::{DQuat, DVec3, I64Vec3, IVec3};
use octolume::data::grid::morton_key;
use octolume::settings::VoxelizationMode::{Conservative, Thin};
use octolume::stages::voxelize::{VoxelizeError, voxelize_cells};

pub mod object;
mod oracle;
pub mod soup;

use object::MODES;
use soup::{Random, Soup};

fn sorted(cells: Vec<IVec3>) -> BTreeSet<[i32; 3]> {
    let count = cells.len();
    let set: BTreeSet<[i32; 3]> = cells.into_iter().map(|cell| cell.to_array()).collect();
    assert_eq!(set.len(), count, "each cell once");
    set
}

/// Triangles on the lattice of quarter cells inside [0, 5)³, most with ties; none degenerate.
fn lattice_triangles(count: usize) -> Vec<[I64Vec3; 3]> {
    let mut random = Random(1);
    let mut triangles = Vec::new();
    while triangles.len() < count {
        // Coarse coordinates tie more often.
        let step = [1, 2, 4][random.below(3)];
        let mut coordinate = || random.below((20 / step) as usize) as i64 * step;
        let t = [0; 3].map(|_| I64Vec3::new(coordinate(), coordinate(), coordinate()));
        if (t[1] - t[0]).cross(t[2] - t[0]) != I64Vec3::ZERO {
            triangles.push(t);
        }
    }
    triangles
}

fn in_cells(t: [I64Vec3; 3]) -> Soup {
    Soup::triangle(t.map(|p| p.as_dvec3() / oracle::UNITS as f64))
}

#[test]
fn conservative_equals_exact_brute_force_with_ties() {
    for t in lattice_triangles(3000) {
        let expected: Vec<IVec3> = oracle::all_cells(-1, 6).filter(|&cell| oracle::shares_area(t, cell)).collect();
        assert_eq!(sorted(in_cells(t).cells(Conservative)), sorted(expected), "{t:?}");
    }
}

#[test]
fn thin_equals_its_definition_with_ties() {
    for t in lattice_triangles(3000) {
        let expected: Vec<IVec3> = oracle::all_cells(-1, 6).filter(|&cell| oracle::is_thin(t, cell)).collect();
        assert_eq!(sorted(in_cells(t).cells(Thin)), sorted(expected), "{t:?}");
    }
}

#[test]
fn thin_leaves_no_axial_step_through_a_triangle() {
    for t in lattice_triangles(2000) {
        let thin = sorted(in_cells(t).cells(Thin));
        assert!(thin.is_subset(&sorted(in_cells(t).cells(Conservative))), "{t:?}");
        for cell in oracle::all_cells(-1, 6) {
            for axis in 0..3 {
                let next = cell + IVec3::AXES[axis];
                let stopped = thin.contains(&cell.to_array()) || thin.contains(&next.to_array());
                assert!(stopped || !oracle::crosses_step(t, cell, axis), "{t:?} between {cell} and {next}");
            }
        }
    }
}

#[test]
fn conservative_equals_clipped_areas_on_random_triangles() {
    let mut random = Random(2);
    for i in 0..1500 {
        // Large, sub-voxel and sliver triangles.
        let size = [4.0, 0.4, 1e-4][i % 3];
        let place = random.point(2.0, 4.0);
        let mut t = [0; 3].map(|_| place + random.point(-size, size));
        if i % 2 == 0 {
            t[2] = t[0].lerp(t[1], random.unit()) + random.point(-1e-7, 1e-7);
        }
        let found = sorted(Soup::triangle(t).cells(Conservative));
        assert!(!found.is_empty());
        for cell in oracle::all_cells(-3, 9) {
            let covered = found.contains(&cell.to_array());
            let area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length();
            // Within 1e-12 cells of a border the areas cannot tell.
            assert!(covered || oracle::clipped_area(t, cell, -1e-12) <= 1e-9 * area, "missed {cell} of {t:?}");
            assert!(!covered || oracle::clipped_area(t, cell, 1e-12) > 0.0, "{cell} is too much for {t:?}");
        }
    }
}

#[test]
fn sliver_and_sub_voxel_triangles_get_a_cell() {
    let mut random = Random(3);
    for i in 0..20_000 {
        let place = random.point(-50.0, 50.0);
        let size = 10.0f64.powi(-(i % 12));
        let (a, b) = (place, place + random.point(-size, size));
        let c = a.lerp(b, random.unit()) + random.point(-1.0, 1.0) * 1e-13;
        let cross = (b - a).cross(c - a);
        if cross.length() > 1e-12 * (b - a).length().max(1e-12) {
            assert!(!Soup::triangle([a, b, c]).cells(Conservative).is_empty(), "{a} {b} {c}");
        }
    }
    // A sliver of an ulp's width along a cell plane is one that rounding would lose.
    let ulp = 8.0f64.next_up();
    let sliver = [DVec3::new(0.5, 8.0, 8.0), DVec3::new(90.5, 8.0, ulp), DVec3::new(45.5, ulp, 8.0)];
    assert_eq!(Soup::triangle(sliver).cells(Conservative).len(), 91);
}

#[test]
fn triangle_in_a_cell_plane_covers_one_layer_either_way_round() {
    for mode in MODES {
        for axis in 0..3 {
            for layer in [-3, 0, 7] {
                let turn = |p: DVec3| DVec3::from_array([0, 1, 2].map(|k| p[(k + 3 - axis) % 3]));
                let square = Soup::parallelogram(DVec3::ZERO, 5.0 * DVec3::Y, 5.0 * DVec3::Z)
                    .map(|p| turn(p + f64::from(layer) * DVec3::X));
                let flipped =
                    Soup { triangles: square.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(), ..square.clone() };
                let cells = sorted(square.cells(mode));
                assert_eq!(cells.len(), 25);
                assert!(cells.iter().all(|cell| cell[axis] == layer));
                assert_eq!(cells, sorted(flipped.cells(mode)));
            }
        }
    }
}

#[test]
fn slope_of_45_degrees_covers_its_columns() {
    for mode in MODES {
        // Through the cells' diagonals: n × n cells, whatever the mode.
        let slope = Soup::parallelogram(DVec3::ZERO, DVec3::new(9.0, 0.0, 9.0), 9.0 * DVec3::Y);
        assert_eq!(slope.cells(mode).len(), 81);
    }
    // A quarter off the diagonals a column holds one thin cell and two conservative ones; one more
    // where the last column's upper cell starts.
    let slope = Soup::parallelogram(DVec3::new(0.0, 0.0, 0.25), DVec3::new(9.0, 0.0, 9.0), 9.0 * DVec3::Y);
    assert_eq!(slope.cells(Thin).len(), 81);
    assert_eq!(slope.cells(Conservative).len(), 2 * 81);
}

#[test]
fn spheres_cover_cells_in_proportion_to_their_area() {
    let radius = 100.0;
    let sphere = Soup::sphere(DVec3::new(101.3, 102.1, 103.7), radius, 6);
    // A patch covers its area projected on the dominant axis, thin, or on all three, conservative:
    // the means of max |n| and of |nx| + |ny| + |nz| over the sphere.
    let thin_share = 3.0 * std::f64::consts::SQRT_2 / std::f64::consts::PI * (0.5f64).sqrt().atan();
    for (mode, share) in [(Thin, thin_share), (Conservative, 1.5)] {
        let expected = share * sphere.area();
        let found = sphere.cells(mode).len() as f64;
        // The dominant axis changes on twelve arcs of acos(1/3) radians: there, and at no other
        // place, the count of a smooth sphere is open, by less than two cells a cell of length.
        let arcs = 12.0 * (1.0f64 / 3.0).acos() * radius;
        // Facets cross cells in pieces; a corner of a cell that two planes differ on counts twice.
        // Planes of neighbours that meet at an angle of edge/radius differ by at most half of it
        // in a cell, and at most all cells lie on an edge.
        let edge = (4.0 * sphere.area() / (3f64.sqrt() * sphere.triangles.len() as f64)).sqrt();
        let facets = 0.5 * edge / radius * expected;
        assert!((found - expected).abs() < 2.0 * arcs + facets, "{mode:?}: {found} for {expected}");
    }
}

#[test]
fn no_path_of_empty_cells_leads_into_a_thin_closed_surface() {
    let mut random = Random(4);
    let n = 40;
    for round in 0..12 {
        let turn = random.rotation();
        let center = random.point(19.0, 21.0);
        let solid = match round % 3 {
            0 => Soup::sphere(DVec3::ZERO, 16.0, [0, 2, 4][round / 3 % 3]),
            1 => Soup::torus(DVec3::ZERO, 12.0, 4.0, 24),
            // Corners on cell corners, faces, edges and centres.
            _ => Soup::sphere(DVec3::ZERO, 16.0, 3).map(|p| (2.0 * p).round() / 2.0),
        };
        let inside = if round % 3 == 1 { 12.0 * DVec3::X } else { DVec3::ZERO };
        let (turn, center) = if round % 3 == 2 { (DQuat::IDENTITY, DVec3::splat(20.5)) } else { (turn, center) };
        let place = |p: DVec3| center + turn * p;
        let walls = sorted(solid.map(place).cells(Thin));
        let outside = oracle::flooded(&walls, n);
        let heart = place(inside).floor().as_ivec3().to_array();
        assert!(!walls.contains(&heart));
        assert!(!outside.contains(&heart), "round {round}");
    }
}

#[test]
fn shuffled_and_duplicate_triangles_cover_the_same_cells() {
    let mut random = Random(5);
    let soup = Soup::random(&mut random, 300, 40.0, 3.0);
    for mode in MODES {
        let cells = soup.cells(mode);
        for _ in 0..5 {
            let (mut other, _) = soup.shuffled(&mut random);
            other.triangles.extend_from_within(..50);
            assert_eq!(other.cells(mode), cells);
        }
    }
}

#[test]
fn whole_cell_moves_shift_the_set() {
    let mut random = Random(6);
    // Dyadic coordinates, so that moving them rounds nothing.
    let soup = Soup::random(&mut random, 200, 30.0, 4.0).map(|p| (p * 1024.0).round() / 1024.0);
    for mode in MODES {
        let moved = IVec3::new(-1000, 77, 1 << 20);
        let shifted: Vec<IVec3> = soup.cells(mode).into_iter().map(|cell| cell + moved).collect();
        assert_eq!(soup.clone().map(|p| p + moved.as_dvec3()).cells(mode), shifted);
    }
}

#[test]
fn clipping_keeps_exactly_the_cells_of_the_box_in_morton_order() {
    let mut random = Random(7);
    let soup = Soup::random(&mut random, 100, 64.0, 20.0);
    let clip = [IVec3::splat(16), IVec3::new(48, 40, 32)];
    for mode in MODES {
        let inside = |cell: &IVec3| cell.cmpge(clip[0]).all() && cell.cmplt(clip[1]).all();
        let mut expected: Vec<IVec3> = soup.cells(mode).into_iter().filter(inside).collect();
        expected.sort_by_key(|&cell| morton_key((cell - clip[0]).as_uvec3().to_array()));
        let found = voxelize_cells(&soup.positions, &soup.triangles, mode, Some(clip)).unwrap();
        assert_eq!(found, expected);
    }
}

#[test]
fn unusable_geometry_is_refused() {
    let far = Soup::triangle([DVec3::ZERO, DVec3::X, DVec3::new(0.0, f64::NAN, 0.0)]);
    let refused = |soup: &Soup| voxelize_cells(&soup.positions, &soup.triangles, Thin, None).unwrap_err();
    assert_eq!(refused(&far), VoxelizeError::Position { part: 0, vertex: 2 });
    let missing = Soup { triangles: vec![[0, 1, 3]], ..Soup::triangle([DVec3::ZERO, DVec3::X, DVec3::Y]) };
    assert!(matches!(refused(&missing), VoxelizeError::Part { part: 0, .. }));
    let long = Soup::triangle([DVec3::ZERO, DVec3::Y, 2e6 * DVec3::X]);
    assert!(matches!(refused(&long), VoxelizeError::TooLong { .. }));
    let wide = Soup::triangle([DVec3::ZERO, 1e5 * DVec3::Y, 1e5 * DVec3::X]);
    assert!(matches!(refused(&wide), VoxelizeError::TooMany { .. }));
}
