//! Reference of sampling (section 4.4) over a map of nodes, in f64, from the paper's words: a point is
//! rounded down to a node location, eight nodes are interpolated, and two such results of neighbouring
//! levels are interpolated again.
//!
//! In: nodes by level and coordinates; none outside the grid, none where nothing is. Out: a
//! [`Sampled`]. Positions in leaf cells from the grid's corner.

use std::collections::BTreeMap;

use glam::{DVec3, IVec3};

use super::{HORIZON_CELLS, HORIZON_FADE, HORIZON_SHARE, LEAST_THROUGH};
use crate::settings::Sampling;

/// What a node holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LitNode {
    /// Mean radiance · opacity.
    pub radiance: DVec3,
    /// Occupied share of the volume, opacity per cell of length.
    pub opacity: f64,
    /// Opacity of the whole node along x, y, z; `None` under isotropic opacity.
    pub across: Option<DVec3>,
}

/// Radiance · α, and α: opacity per cell of length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sampled {
    pub radiance: DVec3,
    pub alpha: f64,
}

impl Sampled {
    fn plus(self, weight: f64, other: Self) -> Self {
        Self { radiance: self.radiance + weight * other.radiance, alpha: self.alpha + weight * other.alpha }
    }
}

/// The plane of a surface, below which nodes do not count for what is seen from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Horizon {
    pub position: DVec3,
    /// Unit length.
    pub face: DVec3,
}

impl Horizon {
    /// The part for which a node of some width counts: by the height of its lowest corner.
    fn part(&self, node: IVec3, width: f64) -> f64 {
        let corners = (0..8).map(|i| (node + IVec3::new(i & 1, i >> 1 & 1, i >> 2)).as_dvec3() * width);
        let height = |corner: DVec3| (corner - self.position).dot(self.face) - HORIZON_CELLS;
        let lowest = corners.map(height).fold(f64::INFINITY, f64::min);
        (lowest / (HORIZON_FADE * width)).clamp(0.0, 1.0)
    }
}

/// A lit octree; level `depth` is the leaves.
#[derive(Clone, Debug, Default)]
pub struct LitNodes {
    pub depth: u32,
    pub nodes: BTreeMap<(u32, [i32; 3]), LitNode>,
}

impl LitNodes {
    fn width_cells(&self, level: u32) -> f64 {
        f64::from(1_u32 << (self.depth - level))
    }

    fn seen(&self, level: u32, node: IVec3, direction: DVec3) -> Sampled {
        let Some(node) = self.nodes.get(&(level, node.to_array())) else { return Sampled::default() };
        if node.opacity == 0.0 {
            return Sampled::default();
        }
        let alpha = match node.across {
            None => node.opacity,
            Some(across) => {
                // Optical depths of the axes mix by the squared direction, over the node's width.
                let depth = |axis: usize| -(1.0 - across[axis]).max(LEAST_THROUGH).ln() * direction[axis].powi(2);
                1.0 - (-(depth(0) + depth(1) + depth(2)) / self.width_cells(level)).exp()
            }
        };
        Sampled { radiance: node.radiance / node.opacity * alpha, alpha }
    }

    pub fn nearest(&self, level: u32, p: DVec3, direction: DVec3) -> Sampled {
        self.seen(level, (p / self.width_cells(level)).floor().as_ivec3(), direction)
    }

    pub fn trilinear(&self, level: u32, p: DVec3, direction: DVec3) -> Sampled {
        self.above(None, level, p, direction)
    }

    /// Trilinear over the nodes above a horizon: the weight of those that count makes up for that of the others.
    fn above(&self, horizon: Option<&Horizon>, level: u32, p: DVec3, direction: DVec3) -> Sampled {
        let width = self.width_cells(level);
        // Node centres lie at ½.
        let lattice = p / width - 0.5;
        let base = lattice.floor();
        let f = lattice - base;
        let corners = (0..8).map(|corner| IVec3::new(corner & 1, corner >> 1 & 1, corner >> 2));
        let (sum, share) = corners.fold((Sampled::default(), 0.0), |(sum, share), offset| {
            let node = base.as_ivec3() + offset;
            let weight: f64 = (0..3).map(|axis| if offset[axis] == 1 { f[axis] } else { 1.0 - f[axis] }).product();
            let counts = weight * horizon.map_or(1.0, |horizon| horizon.part(node, width));
            (sum.plus(counts, self.seen(level, node, direction)), share + counts)
        });
        if horizon.is_some() { made_up(sum, share) } else { sum }
    }

    pub fn quadrilinear(&self, width_cells: f64, p: DVec3, direction: DVec3) -> Sampled {
        self.quadrilinear_above(None, width_cells, p, direction)
    }

    fn quadrilinear_above(&self, horizon: Option<&Horizon>, width_cells: f64, p: DVec3, direction: DVec3) -> Sampled {
        let rise = width_cells.max(1.0).log2().min(self.depth.into());
        let (fine, coarse) = (self.depth - rise.floor() as u32, self.depth - rise.ceil() as u32);
        let blend = rise.fract();
        Sampled::default()
            .plus(1.0 - blend, self.above(horizon, fine, p, direction))
            .plus(blend, self.above(horizon, coarse, p, direction))
    }

    /// What a cone of that width sees from a surface: without quadrilinear sampling, in the level of the nearest
    /// width.
    pub fn at_width(
        &self,
        (sampling, horizon): (Sampling, Option<&Horizon>),
        width_cells: f64,
        p: DVec3,
        direction: DVec3,
    ) -> Sampled {
        let level = self.depth - (width_cells.max(1.0).log2().round() as u32).min(self.depth);
        match sampling {
            Sampling::Nearest => {
                let seen = self.nearest(level, p, direction);
                let node = (p / self.width_cells(level)).floor().as_ivec3();
                horizon.map_or(seen, |horizon| {
                    let part = horizon.part(node, self.width_cells(level));
                    made_up(Sampled::default().plus(part, seen), part)
                })
            }
            Sampling::Trilinear => self.above(horizon, level, p, direction),
            Sampling::Quadrilinear => self.quadrilinear_above(horizon, width_cells, p, direction),
        }
    }
}

fn made_up(sum: Sampled, share: f64) -> Sampled {
    Sampled::default().plus(1.0 / share.max(HORIZON_SHARE), sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_leaf_fades_to_its_neighbours_centres() {
        let node = LitNode { radiance: DVec3::ONE, opacity: 0.5, across: None };
        let lit = LitNodes { depth: 2, nodes: BTreeMap::from([((2, [1, 1, 1]), node)]) };
        let at = |x: f64| lit.trilinear(2, DVec3::new(x, 1.5, 1.5), DVec3::X).alpha;
        assert_eq!([0.5, 1.0, 1.5, 2.0, 2.5, 3.0].map(at), [0.0, 0.25, 0.5, 0.25, 0.0, 0.0]);
        // Level 1 is empty, so a width of √2 halves it.
        let width = std::f64::consts::SQRT_2;
        assert!((lit.quadrilinear(width, DVec3::splat(1.5), DVec3::X).alpha - 0.25).abs() < 1e-15);
    }

    #[test]
    fn directional_opacity_is_spread_over_the_nodes_width() {
        let across = DVec3::new(0.75, 0.0, 1.0);
        let node = LitNode { radiance: DVec3::splat(0.2), opacity: 0.1, across: Some(across) };
        let lit = LitNodes { depth: 1, nodes: BTreeMap::from([((0, [0; 3]), node)]) };
        let along = |direction: DVec3| lit.nearest(0, DVec3::ONE, direction);
        let near = |found: f64, expected: f64| (found - expected).abs() < 1e-12;
        assert!(near(along(DVec3::X).alpha, 0.5) && along(DVec3::Y).alpha == 0.0);
        // 2^-12 of each of two cells, 2^-24 in all.
        assert!(near(along(DVec3::Z).alpha, 1.0 - 1.0 / 4096.0));
        assert!(near(along(DVec3::Z).radiance.x, 2.0 * along(DVec3::Z).alpha));
        // At 45° between x, which stops ¾, and z, which stops all, even the least share of z stops most.
        let slanted = along(DVec3::new(1.0, 0.0, 1.0).normalize()).alpha;
        assert!(near(slanted, 1.0 - (0.25_f64.sqrt() / 4096.0).sqrt()));
    }
}
