//! The cells that a ray crosses, by sorting all planes it meets: the reference of every march.

use glam::{DVec3, IVec3};

/// A cell and the part of the ray inside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    pub cell: IVec3,
    pub from: f64,
    pub to: f64,
    /// Against the ray, of the face or faces it entered through; zero where it starts inside.
    pub entered: DVec3,
}

/// All crossings of a lattice of `cells`³ unit cells, from t = 0 on.
pub fn crossings(origin: DVec3, direction: DVec3, cells: u32) -> Vec<Crossing> {
    let mut planes: Vec<(f64, DVec3)> = vec![(0.0, DVec3::ZERO)];
    for (axis, unit) in DVec3::AXES.into_iter().enumerate() {
        let against = -unit * direction[axis].signum();
        let times = (0..=cells).map(|plane| (f64::from(plane) - origin[axis]) / direction[axis]);
        planes.extend(times.filter(|t| t.is_finite() && *t >= 0.0).map(|t| (t, against)));
    }
    planes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let between = planes.windows(2).filter(|pair| pair[0].0 < pair[1].0);
    let inside = between.filter_map(|pair| {
        let (from, to) = (pair[0].0, pair[1].0);
        let middle = origin + direction * (0.5 * (from + to));
        // A middle lies on no plane; where it seems to, rounding has swallowed a tiny step ahead.
        let ahead = |axis: usize| if direction[axis] < 0.0 { middle[axis].ceil() - 1.0 } else { middle[axis].floor() };
        let cell = DVec3::new(ahead(0), ahead(1), ahead(2)).as_ivec3();
        let is_inside = cell.cmpge(IVec3::ZERO).all() && cell.cmplt(IVec3::splat(cells as i32)).all();
        // All faces reached at that moment count, the start of the ray does not.
        let faces = planes.iter().filter(|(t, _)| *t == from && from > 0.0).map(|(_, against)| *against);
        is_inside.then(|| Crossing { cell, from, to, entered: faces.sum() })
    });
    inside.collect()
}
