//! Right-polar decomposition W = R·U: what turns (and mirrors) apart from what stretches.

use glam::DMat3;

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
