//! The posed triangles of a scene and rays through them: the truth that voxels and their shadows are
//! measured against.
//!
//! In: a prepared scene, a pose, what is hidden. Out: triangles in cells from the grid's corner, f64, and
//! whether anything lies on a segment. What MASK cuts out by its cutoff, and BLEND where it is less than
//! half there, is a hole; from behind, a single-sided surface is none.

use glam::DVec3;

use super::cut_outs::CutOuts;
use super::ray_tree::{RayTree, Segment};
use super::triangle::{PosedTriangle, Sides, weighted};
use crate::prepare::{MotionError, Prepared};
use crate::scene::Pose;
use crate::settings::{Hidden, MotionSettings};

/// How far above its triangle a ray starts. Positions of the file are f32, so that surfaces meant to
/// touch may be 2^-24 of 1024 cells apart: far less than this. A leaf is a thousand times as wide.
pub const START_OFFSET_CELLS: f64 = 1.0 / 1024.0;

/// All triangles of a pose, as rays meet them.
pub struct PosedTriangles<'a> {
    tree: RayTree,
    surfaces: Vec<PosedSurface<'a>>,
    /// Objects that are not at a finite place, a sentence each.
    pub warnings: Vec<String>,
}

/// A primitive of an object.
pub struct PosedSurface<'a> {
    /// Into [`Prepared::objects`].
    pub object: usize,
    /// Of the object's mesh.
    pub primitive: usize,
    /// Of vertices, in world axes, which the grid shares.
    pub normals: Vec<DVec3>,
    /// `None`: there everywhere.
    cut_outs: Option<CutOuts<'a>>,
}

/// A place on a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Cells from the grid's corner.
    pub position: DVec3,
    /// Unit length, of the triangle itself.
    pub face: DVec3,
    /// Unit length, as the mesh's vertices have it.
    pub shading: DVec3,
}

impl SurfacePoint {
    /// Where a ray along `direction` starts so that it does not meet the surface that it leaves.
    pub fn start(&self, direction: DVec3) -> DVec3 {
        self.position + START_OFFSET_CELLS.copysign(self.face.dot(direction)) * self.face
    }
}

impl<'a> PosedTriangles<'a> {
    pub fn new(prepared: &'a Prepared, motion: &MotionSettings, hidden: &Hidden) -> Result<Self, MotionError> {
        let pose = prepared.pose(motion)?;
        let mut posed = Self { tree: RayTree::new(Vec::new()), surfaces: Vec::new(), warnings: Vec::new() };
        let mut triangles = Vec::new();
        for index in (0..prepared.objects.len()).filter(|&index| !hidden.contains(index)) {
            posed.add_object(prepared, index, &pose, &mut triangles);
        }
        posed.tree = RayTree::new(triangles);
        Ok(posed)
    }

    fn add_object(&mut self, prepared: &'a Prepared, number: usize, pose: &Pose, triangles: &mut Vec<PosedTriangle>) {
        let (scene, object) = (&prepared.scene, &prepared.objects[number]);
        let to_grid = prepared.grid.grid_from_world();
        let primitives = &scene.meshes[object.object.mesh].primitives;
        let posed: Vec<Vec<DVec3>> = (0..primitives.len())
            .map(|index| scene.posed_positions(&object.object, index, pose))
            .map(|positions| positions.into_iter().map(|position| to_grid.transform_point3(position)).collect())
            .collect();
        if !posed.iter().flatten().all(|position| position.as_vec3().is_finite()) {
            self.warnings.push(format!("object \"{}\" is not at a finite place", object.object.name));
            return;
        }
        for (index, (primitive, positions)) in primitives.iter().zip(&posed).enumerate() {
            let surface = self.surfaces.len() as u32;
            let mirrored = scene.mirrored_vertices(&object.object, index, pose);
            let is_double_sided = scene.material_of(primitive).double_sided;
            triangles.extend(primitive.triangles.iter().map(|&vertices| {
                let corners = vertices.map(|vertex| positions[vertex as usize]);
                let sides = match mirrored[vertices[0] as usize] {
                    _ if is_double_sided => Sides::Both,
                    true => Sides::Back,
                    false => Sides::Front,
                };
                PosedTriangle { corners, vertices, surface, sides }
            }));
            let normals = scene.posed_normals(&object.object, index, pose);
            let cut_outs = CutOuts::new(prepared, primitive);
            self.surfaces.push(PosedSurface { object: number, primitive: index, normals, cut_outs });
        }
    }

    pub fn len(&self) -> usize {
        self.tree.triangles().len()
    }

    pub fn is_empty(&self) -> bool {
        self.tree.triangles().is_empty()
    }

    /// For rays that ask by themselves what is there.
    pub fn tree(&self) -> &RayTree {
        &self.tree
    }

    /// By [`PosedTriangle::surface`].
    pub fn surfaces(&self) -> &[PosedSurface<'a>] {
        &self.surfaces
    }

    /// Of each triangle, cells².
    pub fn areas(&self) -> impl Iterator<Item = f64> {
        self.tree.triangles().iter().map(|triangle| triangle.doubled_area().length() / 2.0)
    }

    /// Where `place` (a weight a corner, together 1) lies on a triangle; `None` in a hole, and on a
    /// triangle without area.
    pub fn point(&self, triangle: usize, place: DVec3) -> Option<SurfacePoint> {
        let triangle = &self.tree.triangles()[triangle];
        let surface = &self.surfaces[triangle.surface as usize];
        let face = triangle.doubled_area().try_normalize()?;
        if surface.is_hole(triangle.vertices, place) {
            return None;
        }
        let position = weighted(triangle.corners, place);
        let normals = triangle.vertices.map(|vertex| surface.normals[vertex as usize]);
        Some(SurfacePoint { position, face, shading: weighted(normals, place).try_normalize().unwrap_or(face) })
    }

    /// Does anything hide a light that is `length` cells from `from` along `direction` (unit length)? Any length will
    /// do, infinite too. What turns its single side away from the light hides nothing.
    pub fn is_hidden(&self, from: DVec3, direction: DVec3, length: f64) -> bool {
        self.tree.meets_any(Segment { from, direction, length }, |triangle, place| {
            let triangle = &self.tree.triangles()[triangle];
            let is_hole = || self.surfaces[triangle.surface as usize].is_hole(triangle.vertices, place);
            triangle.is_there_along(-direction) && !is_hole()
        })
    }
}

impl PosedSurface<'_> {
    fn is_hole(&self, vertices: [u32; 3], place: DVec3) -> bool {
        self.cut_outs.as_ref().is_some_and(|cut_outs| cut_outs.is_hole(vertices, place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn posed(corners: &[[DVec3; 3]]) -> PosedTriangles<'static> {
        let triangle =
            |&corners: &[DVec3; 3]| PosedTriangle { corners, vertices: [0, 1, 2], surface: 0, sides: Sides::Both };
        let triangles: Vec<PosedTriangle> = corners.iter().map(triangle).collect();
        let surfaces = vec![PosedSurface { object: 0, primitive: 0, normals: vec![DVec3::Y; 3], cut_outs: None }];
        PosedTriangles { tree: RayTree::new(triangles), surfaces, warnings: Vec::new() }
    }

    /// Two triangles across the axis, side 2, around (16, 10, 16).
    fn square() -> PosedTriangles<'static> {
        let corner = |x: f64, z: f64| DVec3::new(16.0 + x, 10.0, 16.0 + z);
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        posed(&[[a, b, c], [a, c, d]])
    }

    #[test]
    fn a_square_hides_what_is_behind_it_and_no_more() {
        let square = square();
        for step in 0..=400 {
            // Along the diagonal both triangles share, and past the corners.
            let at = f64::from(step) / 100.0 - 2.0;
            let from = DVec3::new(16.0 + at, 0.0, 16.0 + at);
            let expected = at.abs() <= 1.0;
            for up in [DVec3::Y, -DVec3::NEG_Y] {
                assert_eq!(square.is_hidden(from, up, f64::INFINITY), expected, "{at} {up}");
            }
            // Leans past the very corner.
            let leaning = DVec3::new(-1e-9, 1.0, 1e-9);
            assert_eq!(square.is_hidden(from, leaning, f64::INFINITY), at.abs() < 1.0, "{at} {leaning}");
            assert!(!square.is_hidden(from, DVec3::NEG_Y, f64::INFINITY));
        }
        let below = DVec3::new(16.3, 9.0, 15.8);
        assert!(!square.is_hidden(below, DVec3::Y, 1.0 - 1e-9) && square.is_hidden(below, DVec3::Y, 1.0 + 1e-9));
    }

    #[test]
    fn points_see_out_of_their_own_surface_to_both_sides() {
        let square = square();
        for place in [DVec3::new(0.3, 0.3, 0.4), DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.0, 0.5, 0.5)] {
            for triangle in 0..2 {
                let point = square.point(triangle, place).expect("has area");
                assert!((point.position.y - 10.0).abs() < 1e-12 && point.face.y.abs() > 1.0 - 1e-12);
                for direction in [DVec3::Y, DVec3::NEG_Y, DVec3::new(1.0, 1e-6, 0.0).normalize()] {
                    assert!(!square.is_hidden(point.start(direction), direction, f64::INFINITY), "{direction}");
                }
            }
        }
    }

    #[test]
    fn nothing_gets_out_of_a_closed_box_and_everything_out_of_nothing() {
        let corner = |i: usize| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64) * 6.0 + 700.0;
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let halves = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        let closed = posed(&halves.map(|triangle| triangle.map(corner)).collect::<Vec<_>>());
        let nothing = posed(&[]);
        for i in 0..1000 {
            let angle = f64::from(i);
            let height = 1.0 - 2.0 * (angle + 0.5) / 1000.0;
            let level = (1.0 - height * height).sqrt();
            let direction = DVec3::new(level * angle.cos(), height, level * angle.sin()).normalize();
            for from in [DVec3::splat(703.0), DVec3::splat(700.01), DVec3::new(705.99, 703.0, 700.5)] {
                assert!(closed.is_hidden(from, direction, f64::INFINITY), "{direction}");
                assert!(!nothing.is_hidden(from, direction, f64::INFINITY));
            }
        }
        // From outside: a ray through the box's diagonal is hidden, one beside it not.
        assert!(closed.is_hidden(DVec3::splat(600.0), DVec3::ONE.normalize(), f64::INFINITY));
        assert!(!closed.is_hidden(DVec3::splat(600.0), DVec3::NEG_ONE.normalize(), f64::INFINITY));
    }
}
