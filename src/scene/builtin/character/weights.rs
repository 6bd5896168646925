//! Which joints a point of the body follows, and how strongly.

use glam::DVec3;

use super::skeleton::{
    CAPE, CHEST, CLAVICLE, COUNT, FOOT, FOREARM, HAND, HEAD, NECK, PELVIS, SHIN, SIDE, SPINE, THIGH, TOE, UPPER_ARM,
};
use crate::scene::builtin::exact::smoothstep;
use crate::scene::builtin::glb::Influence;

/// Shares of all joints; they sum to 1.
pub type Shares = [f64; COUNT];

/// Names a rule that says which joints a bind-pose point follows.
pub type Rule = fn(DVec3) -> Shares;

/// A point at `along` on a chain of joints: each link takes over at a place, over twice a half width.
fn chain(first: usize, links: &[(usize, f64, f64)], along: f64) -> Shares {
    let mut shares = [0.0; COUNT];
    shares[first] = 1.0;
    let mut before = first;
    for &(joint, place, half_width) in links {
        let taken = smoothstep(place - half_width, place + half_width, along) * shares[before];
        shares[before] -= taken;
        shares[joint] += taken;
        before = joint;
    }
    shares
}

fn only(joint: usize) -> Shares {
    let mut shares = [0.0; COUNT];
    shares[joint] = 1.0;
    shares
}

fn mixed(a: Shares, b: Shares, share: f64) -> Shares {
    std::array::from_fn(|joint| a[joint] * (1.0 - share) + b[joint] * share)
}

fn side_of(point: DVec3) -> usize {
    if point.x < 0.0 { SIDE } else { 0 }
}

pub fn torso(point: DVec3) -> Shares {
    chain(PELVIS, &[(SPINE, 1.05, 0.08), (CHEST, 1.22, 0.09), (NECK, 1.49, 0.04)], point.y)
}

/// Cloth below the belt follows both thighs, more so the lower it hangs.
pub fn skirt(point: DVec3) -> Shares {
    let right = smoothstep(0.11, -0.11, point.x);
    let thighs = mixed(only(THIGH), only(THIGH + SIDE), right);
    mixed(only(PELVIS), thighs, 0.92 * smoothstep(0.98, 0.80, point.y))
}

pub fn head(point: DVec3) -> Shares {
    chain(NECK, &[(HEAD, 1.55, 0.03)], point.y)
}

pub fn pelvis(_: DVec3) -> Shares {
    only(PELVIS)
}

pub fn cape(point: DVec3) -> Shares {
    chain(CHEST, &[(CAPE[0], -1.32, 0.08), (CAPE[1], -1.10, 0.10), (CAPE[2], -0.90, 0.10)], -point.y)
}

pub fn arm(point: DVec3) -> Shares {
    let side = side_of(point);
    let links = [
        (CLAVICLE + side, 0.12, 0.05),
        (UPPER_ARM + side, 0.185, 0.055),
        (FOREARM + side, 0.455, 0.06),
        (HAND + side, 0.70, 0.035),
    ];
    chain(CHEST, &links, point.x.abs())
}

pub fn leg(point: DVec3) -> Shares {
    let side = side_of(point);
    let links = [(THIGH + side, -0.90, 0.07), (SHIN + side, -0.50, 0.075), (FOOT + side, -0.10, 0.045)];
    chain(PELVIS, &links, -point.y)
}

/// A boot's shaft follows the shin, its foot the foot and the toes.
pub fn boot(point: DVec3) -> Shares {
    let side = side_of(point);
    let sole = chain(FOOT + side, &[(TOE + side, 0.125, 0.03)], point.z);
    mixed(sole, only(SHIN + side), smoothstep(0.085, 0.16, point.y))
}

/// The four strongest shares as integers that sum to exactly 255.
pub fn influence(shares: &Shares) -> Influence {
    let mut order: Vec<usize> = (0..COUNT).collect();
    order.sort_by(|&a, &b| shares[b].total_cmp(&shares[a]).then(a.cmp(&b)));
    let total: f64 = order[..4].iter().map(|&joint| shares[joint]).sum();
    let mut found = Influence::default();
    let mut left = 255;
    for (at, &joint) in order[..4].iter().enumerate() {
        let weight = ((shares[joint] / total * 255.0).round() as u8).min(left);
        left -= weight;
        if weight > 0 {
            (found.joints[at], found.weights[at]) = (joint as u8, weight);
        }
    }
    found.weights[0] += left;
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_255_and_zero_weights_name_joint_0() {
        for step in 0..4000 {
            let t = f64::from(step) / 4000.0;
            let point = DVec3::new(1.8 * t - 0.9, 1.8 * (t * 37.0).fract(), (t * 11.0).fract() - 0.5);
            for rule in [torso as Rule, skirt, head, cape, arm, leg, boot, pelvis] {
                let found = influence(&rule(point));
                assert_eq!(found.weights.iter().map(|&weight| u32::from(weight)).sum::<u32>(), 255);
                assert!(found.weights.iter().zip(found.joints).all(|(&weight, joint)| weight > 0 || joint == 0));
            }
        }
    }
}
