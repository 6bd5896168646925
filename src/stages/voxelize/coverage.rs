//! Which cells a triangle covers, exactly (section 3.1; Schwarz & Seidel 2010).
//!
//! In: corners in cells and a box of cells to stay in. Out: every covered cell, once.
//! *Conservative*: the cells the triangle shares an area with. *Thin*: the cells that overlap its
//! bounds, whose axis cross along the face's dominant axis the plane meets, and whose projected
//! axis crosses reach inside all projected edges. Of two axial neighbours at least one is among
//! them if the triangle meets the step from centre to centre, so a closed surface is 6-separating.
//! A triangle that meets no such step, a sub-voxel one, may therefore have no thin cell.
//! Cells are half-open only for a triangle that lies in a cell plane: it covers the layer above.
//! All decisions are signs of exact predicates, so neither winding nor rounding changes a cell.

use glam::IVec3;

use super::plane::Plane;
use super::triangle::Triangle;
use crate::settings::VoxelizationMode;

/// A half-open box of cells, `min` to `max`.
pub type CellBox = [IVec3; 2];

/// A triangle in axes (u, v, w) = a cyclic permutation of (x, y, z) that puts the dominant axis last.
struct Scan {
    mode: VoxelizationMode,
    /// Inclusive cell range of the triangle's bounds, inside the clip box.
    low: [i32; 3],
    high: [i32; 3],
    /// Edges in the dominant projection, along w.
    edges: [Edge; 3],
    /// What columns that pass have to pass still. `None`: conservative, and the bounds span one
    /// layer along w, so that a column that shares an area with the triangle shares it there.
    depth: Option<Depth>,
}

/// Where in its column a triangle runs.
struct Depth {
    plane: Plane,
    /// Edges in the projections along u and v; `None`: edge-on, the plane test says it all.
    side_edges: [Option<[Edge; 3]>; 2],
}

/// Calls `emit` with every cell in `clip` that the triangle covers, in no particular order.
pub(super) fn for_each_cell(triangle: &Triangle, mode: VoxelizationMode, clip: CellBox, mut emit: impl FnMut(IVec3)) {
    let axis = triangle.dominant_axis();
    let permute = |v: [i32; 3]| [0, 1, 2].map(|k| v[(axis + 1 + k) % 3]);
    let Some(scan) = Scan::new(triangle, mode, clip.map(|corner| permute(corner.to_array()))) else { return };
    match axis {
        0 => scan.run(|u, v, w| emit(IVec3::new(w, u, v))),
        1 => scan.run(|u, v, w| emit(IVec3::new(v, w, u))),
        _ => scan.run(|u, v, w| emit(IVec3::new(u, v, w))),
    }
}

impl Scan {
    fn new(triangle: &Triangle, mode: VoxelizationMode, clip: [[i32; 3]; 2]) -> Option<Self> {
        let axis = triangle.dominant_axis();
        let corners = triangle.corners.map(|corner| [0, 1, 2].map(|k| corner.to_array()[(axis + 1 + k) % 3]));
        let areas = [0, 1, 2].map(|k| triangle.projected_areas[(axis + 1 + k) % 3]);

        let bounds = [0, 1, 2].map(|k| cell_range(corners.map(|corner| corner[k])));
        let low = [0, 1, 2].map(|k| bounds[k][0].max(clip[0][k]));
        let high = [0, 1, 2].map(|k| bounds[k][1].min(clip[1][k] - 1));
        if (0..3).any(|k| low[k] > high[k]) {
            return None;
        }
        let edges = |k: usize| {
            let flat = corners.map(|corner| [corner[(k + 1) % 3], corner[(k + 2) % 3]]);
            Edge::all(flat, areas[k] > 0.0, mode)
        };
        let column_decides = mode == VoxelizationMode::Conservative && bounds[2][0] == bounds[2][1];
        let depth = (!column_decides).then(|| Depth {
            plane: Plane::new(corners, areas, mode),
            side_edges: [0, 1].map(|k| (areas[k] != 0.0).then(|| edges(k))),
        });
        Some(Self { mode, low, high, edges: edges(2), depth })
    }

    fn run(&self, mut emit: impl FnMut(i32, i32, i32)) {
        for v in self.low[1]..=self.high[1] {
            let [first, last] = self.row(v, Reach::Furthest);
            let [sure_first, sure_last] = self.row(v, Reach::Least);
            for u in first..=last {
                let sure = (sure_first..=sure_last).contains(&u);
                if !sure && !self.inside(&self.edges, [u, v]) {
                    continue;
                }
                let Some(depth) = &self.depth else {
                    emit(u, v, self.low[2]);
                    continue;
                };
                let [bottom, top] = depth.plane.candidates(u, v);
                for w in bottom.max(self.low[2])..=top.min(self.high[2]) {
                    if depth.plane.meets(u, v, w) && (sure || self.inside_sides(depth, u, v, w)) {
                        emit(u, v, w);
                    }
                }
            }
        }
    }

    fn inside(&self, edges: &[Edge; 3], cell: [i32; 2]) -> bool {
        match self.mode {
            VoxelizationMode::Conservative => edges.iter().all(|edge| edge.square_reaches_inside(cell)),
            VoxelizationMode::Thin => edges.iter().all(|edge| edge.cross_touches_inside(cell)),
        }
    }

    fn inside_sides(&self, depth: &Depth, u: i32, v: i32, w: i32) -> bool {
        let [along_u, along_v] = &depth.side_edges;
        along_u.as_ref().is_none_or(|edges| self.inside(edges, [v, w]))
            && along_v.as_ref().is_none_or(|edges| self.inside(edges, [w, u]))
    }

    /// Columns of row `v`, inclusive. `Furthest`: all that can be inside all edges, at times one too
    /// many. `Least`: columns surely inside, with their whole square (conservative) or their centre
    /// (thin): there the triangle fills the column's square or meets its axis, so that the plane
    /// alone decides.
    fn row(&self, v: i32, reach: Reach) -> [i32; 2] {
        let (mut first, mut last) = (self.low[0], self.high[0]);
        for edge in &self.edges {
            let [reach_u, reach_v] = match (reach, self.mode) {
                (Reach::Furthest, _) => edge.reach[0],
                (Reach::Least, VoxelizationMode::Conservative) => edge.reach[0].map(|offset| 1.0 - offset),
                (Reach::Least, VoxelizationMode::Thin) => [0.5; 2],
            };
            let [along, rise] = [edge.to[0] - edge.from[0], edge.to[1] - edge.from[1]];
            let from_edge = f64::from(v) + reach_v - edge.from[1];
            if rise == 0.0 {
                if reach == Reach::Least && along * from_edge <= 0.0 {
                    return [0, -1];
                }
                continue;
            }
            // Differences of inputs round once, so the quotient is good to a few ulp.
            let run = along * from_edge / rise;
            let crossing = edge.from[0] + run - reach_u;
            let slack = 1e-12 * (1.0 + run.abs() + edge.from[0].abs());
            let slack = if reach == Reach::Furthest { slack } else { -slack };
            if rise < 0.0 {
                first = first.max((crossing - slack).ceil() as i32);
            } else {
                last = last.min((crossing + slack).floor() as i32);
            }
        }
        [first, last]
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Reach {
    Furthest,
    Least,
}

/// Cells that the open interval between the smallest and the largest value overlaps; a single
/// integer belongs to the cell above it.
fn cell_range(values: [f64; 3]) -> [i32; 2] {
    let min = values[0].min(values[1]).min(values[2]);
    let max = values[0].max(values[1]).max(values[2]);
    let low = min.floor() as i32;
    [low, (max.ceil() as i32 - 1).max(low)]
}

/// A projected edge, directed so that the triangle lies to its left.
#[derive(Clone, Copy)]
struct Edge {
    from: [f64; 2],
    to: [f64; 2],
    /// The point of a cell that lies furthest to the left, from the cell's lower corner. A cross
    /// has two candidates, the further one (up to rounding) first.
    reach: [[f64; 2]; 2],
}

impl Edge {
    fn all(corners: [[f64; 2]; 3], counter_clockwise: bool, mode: VoxelizationMode) -> [Self; 3] {
        [0, 1, 2].map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let (from, to) = if counter_clockwise { (a, b) } else { (b, a) };
            // The left normal; the signs of both differences are exact.
            let normal = [from[1] - to[1], to[0] - from[0]];
            let step = normal.map(|component| if component > 0.0 { 1.0 } else { 0.0 });
            let reach = match mode {
                VoxelizationMode::Conservative => [step; 2],
                VoxelizationMode::Thin if normal[0].abs() >= normal[1].abs() => [[step[0], 0.5], [0.5, step[1]]],
                VoxelizationMode::Thin => [[0.5, step[1]], [step[0], 0.5]],
            };
            Self { from, to, reach }
        })
    }

    /// Positive to the left, exact in sign.
    fn side(&self, cell: [i32; 2], reach: [f64; 2]) -> f64 {
        let coord = |p: [f64; 2]| robust::Coord { x: p[0], y: p[1] };
        let point = [f64::from(cell[0]) + reach[0], f64::from(cell[1]) + reach[1]];
        robust::orient2d(coord(self.from), coord(self.to), coord(point))
    }

    fn square_reaches_inside(&self, cell: [i32; 2]) -> bool {
        self.side(cell, self.reach[0]) > 0.0
    }

    fn cross_touches_inside(&self, cell: [i32; 2]) -> bool {
        self.side(cell, self.reach[0]) >= 0.0 || self.side(cell, self.reach[1]) >= 0.0
    }
}
