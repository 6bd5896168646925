//! Joint weights of a voxel: sums over the triangles in its cell, then four integers that sum to 255.

use glam::DVec3;

use crate::data::voxel_cache::{JOINT_WEIGHT_SUM, VoxelJoints};
use crate::scene::Primitive;
use crate::settings::JointWeights;

/// A corner's weight of 1, as an integer.
const WEIGHT_ONE: f64 = 65536.0;
const TOTAL: u64 = JOINT_WEIGHT_SUM as u64;

/// Integer weight sums by joint; empty at the start of a cell.
#[derive(Debug, Default)]
pub(super) struct JointSums {
    sums: Vec<(u16, u64)>,
}

/// Joints and weights of a vertex. Without a positive weight it moves rigidly with its first joint.
fn influences(primitive: &Primitive, vertex: usize) -> ([u16; 4], [f32; 4]) {
    let joints = primitive.joints.get(vertex).copied().unwrap_or_default();
    let weights = primitive.weights.get(vertex).copied().unwrap_or_default();
    if weights.iter().any(|&weight| weight > 0.0) { (joints, weights) } else { (joints, [1.0, 0.0, 0.0, 0.0]) }
}

/// Vertices that [`influences`] had to fall back for.
pub(super) fn unweighted_vertices(primitive: &Primitive) -> u64 {
    let weighted = primitive.weights.iter().filter(|weights| weights.iter().any(|&weight| weight > 0.0)).count();
    primitive.positions.len().saturating_sub(weighted) as u64
}

/// What each corner of a triangle has to say at barycentric `place`. Of corners that are equally near the first speaks.
pub(super) fn shares(place: DVec3, weights: JointWeights) -> DVec3 {
    match weights {
        JointWeights::Interpolated => place,
        JointWeights::Flat if place.x >= place.y && place.x >= place.z => DVec3::X,
        JointWeights::Flat if place.y >= place.z => DVec3::Y,
        JointWeights::Flat => DVec3::Z,
    }
}

impl JointSums {
    pub fn clear(&mut self) {
        self.sums.clear();
    }

    /// Adds the weights of the vertices by their `shares`, times `weight`.
    pub fn add(&mut self, primitive: &Primitive, vertices: [u32; 3], shares: DVec3, weight: u64) {
        for (vertex, share) in vertices.into_iter().zip(shares.to_array()) {
            let (joints, weights) = influences(primitive, vertex as usize);
            for (joint, joint_weight) in joints.into_iter().zip(weights) {
                let amount = weight * (share * f64::from(joint_weight.max(0.0)) * WEIGHT_ONE).round() as u64;
                if amount == 0 {
                    continue;
                }
                match self.sums.iter_mut().find(|(known, _)| *known == joint) {
                    Some((_, sum)) => *sum += amount,
                    None => self.sums.push((joint, amount)),
                }
            }
        }
    }

    /// The four strongest, strongest first (of equals the smaller index), summing to exactly 255.
    pub fn quantized(&mut self) -> VoxelJoints {
        self.sums.sort_unstable_by_key(|&(joint, sum)| (std::cmp::Reverse(sum), joint));
        self.sums.truncate(4);
        let total: u64 = self.sums.iter().map(|&(_, sum)| sum).sum();
        let mut voxel = VoxelJoints { joints: [0; 4], weights: [0; 4] };
        if total == 0 {
            voxel.weights[0] = TOTAL as u8;
            return voxel;
        }
        let mut remainders = [(0, 0, 0); 4];
        let mut left = TOTAL;
        for (slot, &(joint, sum)) in self.sums.iter().enumerate() {
            let product = u128::from(sum) * u128::from(TOTAL);
            let whole = (product / u128::from(total)) as u64;
            voxel.joints[slot] = joint;
            voxel.weights[slot] = whole as u8;
            remainders[slot] = (product % u128::from(total), joint, slot);
            left -= whole;
        }
        let used = &mut remainders[..self.sums.len()];
        used.sort_unstable_by_key(|&(remainder, joint, _)| (std::cmp::Reverse(remainder), joint));
        for &(_, _, slot) in used.iter().take(left as usize) {
            voxel.weights[slot] += 1;
        }
        for slot in 0..4 {
            if voxel.weights[slot] == 0 {
                voxel.joints[slot] = 0;
            }
        }
        voxel
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quantized(sums: &[(u16, u64)]) -> VoxelJoints {
        JointSums { sums: sums.to_vec() }.quantized()
    }

    #[test]
    fn largest_remainders_fill_up_to_255() {
        // Thirds: 85 each. Sevenths of 3, 2, 2: 109.29, 72.86, 72.86.
        assert_eq!(quantized(&[(5, 1), (1, 1), (9, 1)]).weights, [85, 85, 85, 0]);
        let sevenths = quantized(&[(5, 2), (1, 3), (9, 2)]);
        assert_eq!((sevenths.joints, sevenths.weights), ([1, 5, 9, 0], [109, 73, 73, 0]));
    }

    #[test]
    fn the_nearest_corner_speaks_alone_where_weights_are_flat() {
        for (place, nearest) in [([0.5, 0.3, 0.2], DVec3::X), ([0.3, 0.4, 0.3], DVec3::Y), ([0.4, 0.2, 0.4], DVec3::X)]
        {
            let place = DVec3::from_array(place);
            assert_eq!(shares(place, JointWeights::Flat), nearest);
            assert_eq!(shares(place, JointWeights::Interpolated), place);
        }
        assert_eq!(shares(DVec3::new(0.1, 0.2, 0.7), JointWeights::Flat), DVec3::Z);
    }

    #[test]
    fn four_strongest_are_kept_and_order_does_not_matter() {
        let mut sums = [(4, 10), (2, 40), (7, 30), (1, 10), (3, 20), (9, 5)];
        let first = quantized(&sums);
        assert_eq!(first.joints, [2, 7, 3, 1]);
        sums.reverse();
        assert_eq!(quantized(&sums), first);
    }

    #[test]
    fn joints_too_weak_for_a_unit_are_left_out() {
        let voxel = quantized(&[(300, 1 << 40), (12, 1)]);
        assert_eq!((voxel.joints, voxel.weights), ([300, 0, 0, 0], [255, 0, 0, 0]));
    }
}
