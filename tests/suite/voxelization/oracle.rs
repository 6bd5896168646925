//! Slow answers, cell by cell, that share no code with the voxelizer.
//!
//! On lattices (coordinates multiples of 1/4, so that ties abound) everything is exact in integers:
//! units of 1/4 cell, products far below 2^63. Elsewhere an area by clipping decides, and what
//! is too close to call is left open.

use std::collections::BTreeSet;

use glam::{DVec3, I64Vec3, IVec3};

/// Units of a lattice coordinate in a cell.
pub const UNITS: i64 = 4;

/// Cells `low..high` on every axis.
pub fn all_cells(low: i32, high: i32) -> impl Iterator<Item = IVec3> {
    (low..high).flat_map(move |x| (low..high).flat_map(move |y| (low..high).map(move |z| IVec3::new(x, y, z))))
}

fn edges(t: [I64Vec3; 3]) -> [I64Vec3; 3] {
    [t[1] - t[0], t[2] - t[1], t[0] - t[2]]
}

fn normal(t: [I64Vec3; 3]) -> I64Vec3 {
    (t[1] - t[0]).cross(t[2] - t[0])
}

/// The interval of `points` along `axis`.
fn interval(axis: I64Vec3, points: impl IntoIterator<Item = I64Vec3>) -> (i64, i64) {
    let values = points.into_iter().map(|p| axis.dot(p));
    values.fold((i64::MAX, i64::MIN), |(low, high), v| (low.min(v), high.max(v)))
}

/// Shares the triangle an area with the half-open cell? All 13 separating axes, both ways.
pub fn shares_area(t: [I64Vec3; 3], cell: IVec3) -> bool {
    let low = cell.as_i64vec3() * UNITS;
    for axis in 0..3 {
        if t.iter().all(|p| p[axis] == t[0][axis]) {
            // In a plane across this axis: the cell it lies in, or above, and the other axes strictly.
            return (low[axis]..low[axis] + UNITS).contains(&t[0][axis])
                && separating_axes(t).into_iter().all(|a| a[axis] != 0 || overlaps(a, t, low));
        }
    }
    separating_axes(t).into_iter().all(|axis| overlaps(axis, t, low))
}

fn separating_axes(t: [I64Vec3; 3]) -> Vec<I64Vec3> {
    let units = [I64Vec3::X, I64Vec3::Y, I64Vec3::Z];
    let mut axes = vec![normal(t)];
    axes.extend(units);
    axes.extend(edges(t).into_iter().flat_map(|edge| units.map(|unit| edge.cross(unit))));
    axes.retain(|axis| *axis != I64Vec3::ZERO);
    axes
}

fn overlaps(axis: I64Vec3, t: [I64Vec3; 3], low: I64Vec3) -> bool {
    let corners = (0..8).map(|i| low + UNITS * I64Vec3::new(i & 1, i >> 1 & 1, i >> 2));
    let ((a, b), (c, d)) = (interval(axis, t), interval(axis, corners));
    // The triangle lies in a plane across the axis, or both overlap in more than a point.
    if a == b { c < a && a < d } else { a < d && c < b }
}

/// The definition of *thin*, word for word.
pub fn is_thin(t: [I64Vec3; 3], cell: IVec3) -> bool {
    let n = normal(t);
    let low = cell.as_i64vec3() * UNITS;
    let center = low + UNITS / 2;
    for axis in 0..3 {
        let (a, b) = interval(I64Vec3::AXES[axis], t);
        let overlaps =
            if a == b { low[axis] <= a && a < low[axis] + UNITS } else { a < low[axis] + UNITS && low[axis] < b };
        if !overlaps {
            return false;
        }
    }
    let size = n.abs();
    let dominant = (0..3).rev().max_by(|&a, &b| size[a].cmp(&size[b]).then(a.cmp(&b))).unwrap();
    if (n.dot(center - t[0])).abs() * 2 > size[dominant] * UNITS {
        return false;
    }
    (0..3).all(|axis| {
        n[axis] == 0
            || (0..3).all(|i| {
                let (from, to) = (t[i], t[(i + 1) % 3]);
                // Inward in the projection along `axis`.
                let inward = I64Vec3::AXES[axis].cross(to - from) * n[axis].signum();
                let reach = inward.abs().max_element() * UNITS;
                2 * inward.dot(center - from) + reach >= 0
            })
    })
}

/// Does the triangle meet the closed segment between the centres of two axial neighbours?
pub fn crosses_step(t: [I64Vec3; 3], cell: IVec3, axis: usize) -> bool {
    // Doubled, so that every centre is an integer whatever the unit.
    let t = t.map(|p| 2 * p);
    let a = 2 * cell.as_i64vec3() * UNITS + UNITS;
    let b = a + 2 * UNITS * I64Vec3::AXES[axis];
    let n = normal(t);
    if n[axis] == 0 {
        return false;
    }
    let (from, to) = (n.dot(a - t[0]), n.dot(b - t[0]));
    if from.signum() * to.signum() > 0 {
        return false;
    }
    (0..3).all(|i| {
        let edge = t[(i + 1) % 3] - t[i];
        I64Vec3::AXES[axis].cross(edge).dot(a - t[i]) * n[axis].signum() >= 0
    })
}

/// Area of the triangle inside the cell grown by `margin` on every side.
pub fn clipped_area(t: [DVec3; 3], cell: IVec3, margin: f64) -> f64 {
    let mut polygon = t.to_vec();
    for axis in 0..3 {
        for (sign, bound) in [(1.0, f64::from(cell[axis]) - margin), (-1.0, -f64::from(cell[axis]) - 1.0 - margin)] {
            let inside = |p: &DVec3| sign * p[axis] - bound;
            let mut kept = Vec::new();
            for i in 0..polygon.len() {
                let (p, q) = (polygon[i], polygon[(i + 1) % polygon.len()]);
                if inside(&p) >= 0.0 {
                    kept.push(p);
                }
                if inside(&p) * inside(&q) < 0.0 {
                    kept.push(p.lerp(q, inside(&p) / (inside(&p) - inside(&q))));
                }
            }
            polygon = kept;
        }
    }
    let fan = polygon.windows(2).map(|pair| 0.5 * (pair[0] - polygon[0]).cross(pair[1] - polygon[0]).length());
    fan.sum()
}

/// Empty cells of [-1, n]³ that axial steps reach from its corner without entering `walls`.
pub fn flooded(walls: &BTreeSet<[i32; 3]>, n: i32) -> BTreeSet<[i32; 3]> {
    let start = [-1; 3];
    let (mut seen, mut open) = (BTreeSet::from([start]), vec![start]);
    while let Some(cell) = open.pop() {
        for (axis, step) in [(0, 1), (0, -1), (1, 1), (1, -1), (2, 1), (2, -1)] {
            let mut next = cell;
            next[axis] += step;
            if (-1..=n).contains(&next[axis]) && !walls.contains(&next) && seen.insert(next) {
                open.push(next);
            }
        }
    }
    seen
}
