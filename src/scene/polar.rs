//! Right-polar decomposition W = R·U: what turns (and mirrors) apart from what stretches.

use glam::{DMat3, DVec3};

/// R orthogonal (det −1 where W mirrors), U symmetric and positive definite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polar {
    pub rotation: DMat3,
    pub stretch: DMat3,
}

/// |det W| below this share of ‖W‖³ leaves no room to turn in: the matrix counts as singular.
const SINGULAR_SHARE: f64 = 1e-15;

/// Newton's iteration converges quadratically once near; scaled, in about ten steps from anywhere.
const MAX_STEPS: usize = 40;

/// `None` for singular or non-finite matrices.
pub fn right_polar(w: DMat3) -> Option<Polar> {
    let norm = frobenius(&w);
    let regular = norm.is_finite() && w.determinant().abs() > SINGULAR_SHARE * norm.powi(3);
    if !regular {
        return None;
    }
    if let Some(stretch) = stretch_along_axes(&w) {
        return Some(Polar { rotation: w * stretch.inverse(), stretch });
    }
    let mut r = w;
    for _ in 0..MAX_STEPS {
        let inverse_transpose = r.inverse().transpose();
        let scale = (frobenius(&inverse_transpose) / frobenius(&r)).sqrt();
        let next = (r * scale + inverse_transpose * (1.0 / scale)) * 0.5;
        let step = frobenius(&(next - r));
        r = next;
        if step <= 4.0 * f64::EPSILON {
            break;
        }
    }
    let stretch = r.transpose() * w;
    Some(Polar { rotation: r, stretch: (stretch + stretch.transpose()) * 0.5 })
}

/// The same for matrices that flatten along one axis, with a stretch that does; `None` where no area is left.
pub fn right_polar_or_flat(w: DMat3) -> Option<Polar> {
    if let Some(polar) = right_polar(w) {
        return Some(polar);
    }
    let (completed, flat) = completed(w)?;
    let polar = right_polar(completed)?;
    // What was added is the square of the length that W gives its null direction.
    Some(Polar { stretch: polar.stretch - outer(flat, flat) * frobenius(&w), ..polar })
}

/// A matrix that flattens along one axis with that axis put back, as long as the matrix is large, and the direction
/// that it flattens. `None` where no area is left.
fn completed(w: DMat3) -> Option<(DMat3, DVec3)> {
    let size = frobenius(&w);
    let across = |m: DMat3| {
        let normals = [m.x_axis.cross(m.y_axis), m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis)];
        let normal = longest(normals);
        // Where the columns are nearly parallel, their products know it less well than the longest column does.
        let column = longest([m.x_axis, m.y_axis, m.z_axis]);
        let (area, normal) = (normal.length(), normal.normalize_or_zero());
        (area > SINGULAR_SHARE * size * size).then(|| normal.reject_from(column).normalize())
    };
    let (from, to) = (across(w.transpose())?, across(w)?);
    (size.is_finite()).then(|| (w + outer(to, from) * size, from))
}

/// `w` with length 1 along what it flattens; as it is where it flattens nothing.
pub fn unflattened(w: DMat3) -> DMat3 {
    match (right_polar(w), completed(w)) {
        (None, Some((completed, flat))) => {
            let added = completed * flat;
            completed - outer(added, flat) * (1.0 - 1.0 / added.length())
        }
        _ => w,
    }
}

fn longest(vectors: [DVec3; 3]) -> DVec3 {
    vectors.into_iter().fold(DVec3::ZERO, |a, b| if b.length() > a.length() { b } else { a })
}

/// a · bᵀ.
fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// U where it is diagonal, as for every node that is not below a non-uniformly scaled one:
/// then WᵀW is U², and no iteration is needed.
fn stretch_along_axes(w: &DMat3) -> Option<DMat3> {
    let axes = [w.x_axis, w.y_axis, w.z_axis];
    let lengths = axes.map(|axis| axis.length());
    let right_angle = |a: usize, b: usize| axes[a].dot(axes[b]).abs() <= 4.0 * f64::EPSILON * lengths[a] * lengths[b];
    (right_angle(0, 1) && right_angle(1, 2) && right_angle(2, 0)).then(|| DMat3::from_diagonal(lengths.into()))
}

fn frobenius(matrix: &DMat3) -> f64 {
    matrix.to_cols_array().iter().map(|value| value * value).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flattening_matrix_is_a_turn_after_a_flat_stretch() {
        let turn = |angle: f64| DMat3::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), angle);
        for scale in [DVec3::new(2.0, 0.0, 0.5), DVec3::new(0.0, 3.0, 3.0), DVec3::new(1e-3, 1e3, 0.0)] {
            let axes = turn(0.4);
            let stretch = axes * DMat3::from_diagonal(scale) * axes.transpose();
            let w = turn(1.9) * stretch;
            let polar = right_polar_or_flat(w).expect("an area is left");
            let off = |a: DMat3, b: DMat3| frobenius(&(a - b)) / frobenius(&stretch);
            assert!(off(polar.stretch, stretch) < 1e-12, "{} is not {stretch}", polar.stretch);
            assert!(off(polar.rotation * polar.stretch, w) < 1e-12);
            // So does the matrix with that length put back …
            let thick = unflattened(polar.stretch);
            assert!(off(polar.rotation * thick, unflattened(w)) < 1e-12);
            // … and behind its stretch it turns alone. An inverse by cofactors loses the condition twice.
            let turned = unflattened(w) * thick.inverse();
            let lengths = DVec3::select(scale.cmpeq(DVec3::ZERO), DVec3::ONE, scale);
            let condition = lengths.max_element() / lengths.min_element();
            let bound = 16.0 * f64::EPSILON * condition * condition;
            assert!(frobenius(&(turned.transpose() * turned - DMat3::IDENTITY)) < bound, "{turned}");
        }
        assert_eq!(right_polar_or_flat(DMat3::from_diagonal(DVec3::X)), None);
        let regular = DMat3::from_diagonal(DVec3::new(1.0, 2.0, 3.0));
        assert_eq!((unflattened(regular), right_polar_or_flat(regular)), (regular, right_polar(regular)));
    }
}
