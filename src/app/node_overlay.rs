//! A node drawn over the picture: its box, arrows to its three forward neighbours in the colours of the
//! axes, and the eight nodes that a place beside it is interpolated from. Dummies are dashed and hollow.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, pos2};
use glam::DVec3;

use super::theme;
use crate::engine::{NodeAddress, NodeFacts, StoredNode};
use crate::stages::pixels::camera::PixelRays;

const DASH: f32 = 4.0;
/// Of the balls at interpolation corners, in points; of small nodes this share of an edge.
const BALL_RADIUS: f32 = 3.5;
const BALL_SHARE: f32 = 0.12;
/// What comes nearer to the eye is cut off.
const LEAST_DEPTH_CELLS: f64 = 0.01;

/// Where leaf cells are in the view.
pub struct Projection {
    pub rays: PixelRays,
    /// Of the whole picture, in points.
    pub rect: Rect,
    /// The octree's.
    pub depth: u32,
}

/// Draws over the picture.
pub fn paint(painter: &Painter, projection: &Projection, facts: &NodeFacts) {
    painter.extend(shapes(projection, facts));
}

fn shapes(projection: &Projection, facts: &NodeFacts) -> Vec<Shape> {
    let mut shapes = Vec::new();
    for (ahead, color) in facts.forward.iter().zip(theme::AXES) {
        if let Some(ahead) = ahead {
            outline(&mut shapes, projection, ahead, Stroke::new(1.0, color.gamma_multiply(0.85)));
            arrow(&mut shapes, projection, [&facts.node, ahead], color);
        }
    }
    outline(&mut shapes, projection, &facts.node, Stroke::new(1.5, theme::STRONG));
    for corner in facts.corners.iter().flatten() {
        if let Some((at, edge)) = projection.node(corner.address) {
            let radius = (edge * BALL_SHARE).clamp(1.0, BALL_RADIUS);
            shapes.push(Shape::circle_filled(
                at,
                radius,
                if corner.is_dummy { Color32::TRANSPARENT } else { theme::STRONG },
            ));
            shapes.push(Shape::circle_stroke(at, radius, Stroke::new(1.2, theme::STRONG)));
        }
    }
    shapes
}

/// The twelve edges of a node's box.
fn outline(shapes: &mut Vec<Shape>, projection: &Projection, node: &StoredNode, stroke: Stroke) {
    let (low, edge) = projection.cube(node.address);
    let corner = |bits: usize| low + edge * DVec3::from_array([0, 1, 2].map(|axis| (bits >> axis & 1) as f64));
    for bits in 0..8_usize {
        for axis in (0..3).filter(|axis| bits >> axis & 1 == 0) {
            line(shapes, projection, [corner(bits), corner(bits | 1 << axis)], stroke, node.is_dummy);
        }
    }
}

fn line(shapes: &mut Vec<Shape>, projection: &Projection, ends: [DVec3; 2], stroke: Stroke, is_dashed: bool) {
    let Some(ends) = projection.segment(ends) else { return };
    if is_dashed {
        shapes.extend(Shape::dashed_line(&ends, stroke, DASH, DASH));
    } else {
        shapes.push(Shape::line_segment(ends, stroke));
    }
}

/// From centre to centre; towards a dummy dashed, with a hollow head.
fn arrow(shapes: &mut Vec<Shape>, projection: &Projection, nodes: [&StoredNode; 2], color: Color32) {
    const HEAD: f32 = 9.0;
    let centers = nodes.map(|node| projection.center(node.address));
    let stroke = Stroke::new(2.0, color);
    line(shapes, projection, centers, stroke, nodes[1].is_dummy);
    let (Some(tail), Some(tip)) = (projection.place(centers[0]), projection.place(centers[1])) else { return };
    // Short of the ball at the centre.
    let way = (tip - tail).normalized();
    let tip = tip - way * BALL_RADIUS.min((tip - tail).length() / 4.0);
    let along = way * HEAD.min((tip - tail).length());
    let across = along.rot90() * 0.4;
    let head = vec![tip, tip - along + across, tip - along - across];
    let fill = if nodes[1].is_dummy { Color32::TRANSPARENT } else { color };
    shapes.push(Shape::convex_polygon(head, fill, Stroke::new(1.2, color)));
}

impl Projection {
    /// Low corner and edge of a node, leaf cells.
    fn cube(&self, address: NodeAddress) -> (DVec3, f64) {
        let edge = f64::from(1_u32 << (self.depth - address.level));
        (DVec3::from_array(address.cell.map(f64::from)) * edge, edge)
    }

    fn center(&self, address: NodeAddress) -> DVec3 {
        let (low, edge) = self.cube(address);
        low + edge / 2.0
    }

    /// Centre and edge of a node in the view, in points, the edge as seen from the front.
    fn node(&self, address: NodeAddress) -> Option<(Pos2, f32)> {
        let center = self.center(address);
        let at = self.place(center)?;
        let (_, depth) = self.rays.project(center)?;
        let cell_points = f64::from(self.rect.height()) / (2.0 * depth * self.rays.direction_y.length());
        Some((at, (self.cube(address).1 * cell_points) as f32))
    }

    /// In the view, in points; `None` behind the eye.
    fn place(&self, cells: DVec3) -> Option<Pos2> {
        let ([x, y], _) = self.rays.project(cells).filter(|(_, depth)| *depth >= LEAST_DEPTH_CELLS)?;
        let [width, height] = self.rays.size_px.map(f64::from);
        let share = [x / width, y / height].map(|share| share.clamp(-100.0, 100.0) as f32);
        Some(pos2(self.rect.left() + share[0] * self.rect.width(), self.rect.top() + share[1] * self.rect.height()))
    }

    /// What of a line is in front of the eye.
    fn segment(&self, ends: [DVec3; 2]) -> Option<[Pos2; 2]> {
        let eye = self.rays.origin - self.rays.direction * self.rays.start_cells;
        let [near, far] = ends.map(|end| (end - eye).dot(self.rays.direction) - 2.0 * LEAST_DEPTH_CELLS);
        if near < 0.0 && far < 0.0 {
            return None;
        }
        let cut = |from: DVec3, to: DVec3, from_depth: f64, to_depth: f64| match from_depth < 0.0 {
            true => from + (to - from) * (from_depth / (from_depth - to_depth)),
            false => from,
        };
        Some([self.place(cut(ends[0], ends[1], near, far))?, self.place(cut(ends[1], ends[0], far, near))?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::grid::Grid;
    use crate::scene::OrbitCamera;

    /// Looks along −z at the middle of 8³ cells of one unit, at the origin.
    fn projection(distance: f64) -> Projection {
        let grid = Grid { anchor: DVec3::ZERO, offset_cells: glam::IVec3::ZERO, span: 1.0, depth: 3 };
        let target = DVec3::splat(4.0);
        let camera = OrbitCamera::new(target + DVec3::Z * distance, target, 90.0);
        let rect = Rect::from_min_size(pos2(10.0, 20.0), egui::vec2(50.0, 50.0));
        Projection { rays: PixelRays::new(&camera, &grid, [100, 100]), rect, depth: 3 }
    }

    #[test]
    fn nodes_are_where_the_picture_shows_them() {
        let projection = projection(10.0);
        assert_eq!(projection.place(DVec3::splat(4.0)), Some(pos2(35.0, 45.0)), "the middle of the view");
        // Half the field of view is 45°: ten cells right at a distance of ten are at the edge.
        let right = projection.place(DVec3::new(14.0, 4.0, 4.0)).expect("in view");
        assert!((right.x - 60.0).abs() < 1e-4 && (right.y - 45.0).abs() < 1e-4, "{right}");
        assert_eq!(projection.cube(NodeAddress { level: 1, cell: [1, 0, 1] }), (DVec3::new(4.0, 0.0, 4.0), 4.0));
        assert_eq!(projection.place(DVec3::new(4.0, 4.0, 15.0)), None, "behind the eye");
        // Two cells at a distance of nine, of eighteen cells in 50 points.
        let (_, edge) = projection.node(NodeAddress { level: 2, cell: [2, 2, 2] }).expect("in view");
        assert!((edge - 50.0 * 2.0 / 18.0).abs() < 1e-4, "{edge}");
    }

    #[test]
    fn lines_are_cut_at_the_eye() {
        let projection = projection(10.0);
        let [inside, behind] = [DVec3::new(5.0, 4.0, 4.0), DVec3::new(5.0, 4.0, 20.0)];
        let cut = projection.segment([inside, behind]).expect("half of it");
        assert_eq!(cut[0], projection.place(inside).expect("in view"));
        assert!(cut[1].x > 60.0 && cut[1].is_finite(), "{cut:?}");
        assert_eq!(projection.segment([behind, behind]), None);
        let flipped = projection.segment([behind, inside]).expect("half of it");
        assert_eq!([flipped[1], flipped[0]], cut);
    }
}
