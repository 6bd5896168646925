//! Morph targets whose weights a clip moves: what vertices are displaced by (glTF, section 3.7.2.2). Weights that never
//! move are baked on loading, and leave nothing here.

use std::borrow::Cow;

use glam::{Vec3, Vec4};
use rayon::prelude::*;

use super::{Morph, MorphTarget, Primitive};

impl Morph {
    /// Targets with what their weights differ by from those that vertices have; `weights`: one a target.
    fn changes<'a>(&'a self, weights: &'a [f64]) -> impl Iterator<Item = (&'a MorphTarget, f64)> {
        let differences = weights.iter().zip(&self.weights).map(|(weight, baked)| weight - baked);
        self.targets.iter().zip(differences).filter(|&(_, difference)| difference != 0.0)
    }
}

impl Primitive {
    /// `weights`: of the mesh's targets; `None` where they do not move.
    pub fn positions_at(&self, weights: Option<&[f64]>) -> Cow<'_, [Vec3]> {
        self.displaced(&self.positions, weights, |target| &target.positions)
    }

    /// Of any length.
    pub fn normals_at(&self, weights: Option<&[f64]>) -> Cow<'_, [Vec3]> {
        match (&self.morph, weights) {
            (Some(morph), Some(_)) if morph.is_flat => Cow::Owned(flat_normals(&self.positions_at(weights))),
            _ => self.displaced(&self.normals, weights, |target| &target.normals),
        }
    }

    /// The handedness of a tangent is not displaced.
    pub fn tangents_at(&self, weights: Option<&[f64]>) -> Cow<'_, [Vec4]> {
        let along: Vec<Vec3> = self.tangents.iter().map(|tangent| tangent.truncate()).collect();
        match self.displaced(&along, weights, |target| &target.tangents) {
            Cow::Borrowed(_) => Cow::Borrowed(&self.tangents),
            Cow::Owned(moved) => {
                Cow::Owned(moved.iter().zip(&self.tangents).map(|(along, tangent)| along.extend(tangent.w)).collect())
            }
        }
    }

    /// Summed in f64, rounded once.
    fn displaced<'a>(
        &self,
        given: &'a [Vec3],
        weights: Option<&[f64]>,
        of: impl Fn(&MorphTarget) -> &Vec<Vec3> + Sync,
    ) -> Cow<'a, [Vec3]> {
        let Some((morph, weights)) = self.morph.as_ref().zip(weights) else { return Cow::Borrowed(given) };
        let changes: Vec<(&[Vec3], f64)> = morph
            .changes(weights)
            .map(|(target, difference)| (of(target).as_slice(), difference))
            .filter(|(displacements, _)| !displacements.is_empty())
            .collect();
        if changes.is_empty() || given.is_empty() {
            return Cow::Borrowed(given);
        }
        let moved = given.par_iter().enumerate().map(|(vertex, given)| {
            let moved = changes.iter().fold(given.as_dvec3(), |sum, (displacements, difference)| {
                sum + *difference * displacements[vertex].as_dvec3()
            });
            moved.as_vec3()
        });
        Cow::Owned(moved.collect())
    }
}

/// Unit face normals of unshared triangles; zero where a triangle has no area.
pub fn flat_normals(positions: &[Vec3]) -> Vec<Vec3> {
    positions
        .chunks_exact(3)
        .flat_map(|corner| {
            let [a, b, c] = [corner[0].as_dvec3(), corner[1].as_dvec3(), corner[2].as_dvec3()];
            [(b - a).cross(c - a).normalize_or_zero().as_vec3(); 3]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> Primitive {
        let target = |by| MorphTarget { positions: vec![by; 3], ..MorphTarget::default() };
        let up = MorphTarget { positions: vec![Vec3::ZERO, Vec3::ZERO, Vec3::Z], ..MorphTarget::default() };
        Primitive {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            tangents: vec![Vec4::new(1.0, 0.0, 0.0, -1.0); 3],
            triangles: vec![[0, 1, 2]],
            morph: Some(Morph { targets: vec![target(Vec3::X), up], weights: vec![0.5, 0.0], is_flat: true }),
            ..Primitive::default()
        }
    }

    #[test]
    fn vertices_are_displaced_by_what_weights_differ_from_those_they_have() {
        let triangle = triangle();
        assert_eq!(*triangle.positions_at(None), *triangle.positions);
        assert!(matches!(triangle.positions_at(Some(&[0.5, 0.0])), Cow::Borrowed(_)));
        let moved = triangle.positions_at(Some(&[2.0, 3.0]));
        assert_eq!(*moved, [Vec3::X * 1.5, Vec3::X * 2.5, Vec3::new(1.5, 1.0, 3.0)]);
        assert!(matches!(triangle.tangents_at(Some(&[2.0, 3.0])), Cow::Borrowed(_)), "nothing displaces them");
    }

    #[test]
    fn flat_normals_are_those_of_the_displaced_triangle() {
        let normals = triangle().normals_at(Some(&[0.5, 1.0])).into_owned();
        let expected = Vec3::new(0.0, -1.0, 1.0).normalize();
        assert!(normals.iter().all(|normal| normal.distance(expected) < 1e-6), "{normals:?}");
    }
}
