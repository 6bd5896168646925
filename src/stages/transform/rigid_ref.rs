//! Reference of `rigid.wgsl`: Eqs. 1 and 2 of section 4.2 and the object's transform, in f64.
//!
//! In: a cell i of a cache, `grid_from_cache`, a normal. Out: the centre g in cells from the grid's
//! corner, then, as a step of its own, its quotient q in 2^-k cells: base cell `q >> k`, fraction
//! `q & (2^k − 1)` (k = 8). Normals move with sign(det)·cofactor(M) and are unit or zero.

use glam::{DAffine3, DMat3, DVec3};

use crate::data::octree::FRACTION_BITS;

/// A cell is this many units of q.
pub const ONE: i64 = 1 << FRACTION_BITS;

/// g: where the centre of cell `i` lands, in cells from the grid's corner.
pub fn centre(i: [i32; 3], grid_from_cache: &DAffine3) -> DVec3 {
    grid_from_cache.transform_point3(DVec3::from_array(i.map(f64::from)) + 0.5)
}

/// q: the lower corner of a unit cube centred at `g`, rounded half up to 2^-k cells. `None` where a
/// coordinate is no number or too large to be one of a cell.
pub fn quantise(g: DVec3) -> Option<[i64; 3]> {
    let q = ((g - 0.5) * ONE as f64 + 0.5).floor();
    let is_cell = q.is_finite() && q.abs().max_element() < (1_u64 << 53) as f64;
    is_cell.then(|| q.to_array().map(|component| component as i64))
}

/// Whether the unit cube at `q` overlaps the grid of `cells`³ cells by any volume.
pub fn overlaps_grid(q: [i64; 3], cells: i64) -> bool {
    q.iter().all(|&lower| lower + ONE > 0 && lower < cells * ONE)
}

/// A direction across a surface that M moves: unit, or zero where there is none.
pub fn move_normal(m: &DMat3, normal: DVec3) -> DVec3 {
    let cofactor = DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    (cofactor * normal * m.determinant().signum()).normalize_or_zero()
}

/// The words of a world voxel's q, each axis biased by one guard cell: `x 19 | y 19 | z 19` bits.
pub fn pack_q(q: [i64; 3]) -> [u32; 2] {
    let biased = q.map(|component| (component + ONE) as u64);
    let bits = biased[0] | biased[1] << 19 | biased[2] << 38;
    [bits as u32, (bits >> 32) as u32]
}

pub fn unpack_q(words: [u32; 2]) -> [i64; 3] {
    let bits = u64::from(words[0]) | u64::from(words[1]) << 32;
    [0, 19, 38].map(|shift| (bits >> shift & 0x7_ffff) as i64 - ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_centre_on_the_lattice_has_no_fraction_and_half_a_cell_has_half() {
        let identity = DAffine3::IDENTITY;
        assert_eq!(quantise(centre([3, 0, 7], &identity)), Some([3 * ONE, 0, 7 * ONE]));
        let moved = DAffine3::from_translation(DVec3::new(0.5, -0.25, 0.0));
        assert_eq!(quantise(centre([3, 0, 7], &moved)), Some([3 * ONE + ONE / 2, -ONE / 4, 7 * ONE]));
    }

    #[test]
    fn packing_keeps_the_guard_layer_and_the_far_end() {
        for q in [[-ONE, 0, -1], [1024 * ONE - 1, -ONE + 1, 512 * ONE], [1024 * ONE - 1; 3]] {
            assert_eq!(unpack_q(pack_q(q)), q);
        }
    }

    #[test]
    fn a_mirror_keeps_normals_outside() {
        // The plane x = 0 seen from +x; mirrored in x it is seen from −x.
        let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
        assert_eq!(move_normal(&mirror, DVec3::X), -DVec3::X);
        assert_eq!(move_normal(&mirror, DVec3::Y), DVec3::Y);
        assert_eq!(move_normal(&mirror, DVec3::ZERO), DVec3::ZERO);
    }
}
