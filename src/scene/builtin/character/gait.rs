//! How a person walks a circle, and waves.
//!
//! Feet are planted where the body will be at mid-stance, stay there to the last centimetre, and
//! travel to the next plant while in the air; the legs follow by two-bone inverse kinematics with
//! square roots alone. Arms, spine and cape swing against the legs.

use glam::{DMat3, DQuat, DVec3};

use super::skeleton::{
    CAPE, CHEST, FOOT, FOREARM, HAND, HEAD, JOINTS, NECK, PELVIS, Pose, ROOT, SHIN, SIDE, SPINE, THIGH, TOE, UPPER_ARM,
};
use crate::scene::builtin::exact::{PI, TAU, blend, cos, sin, smoothstep, turn, turns};

/// A walk around the Y axis, counter-clockwise seen from above.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    pub radius_m: f64,
    pub lap_secs: f64,
    /// Strides (two steps) a lap; a whole number, so that the lap closes.
    pub strides: f64,
    /// Where the lap begins, counter-clockwise from +X.
    pub start_radians: f64,
}

const KEYS_A_STRIDE: u32 = 16;
/// Share of a stride that a foot stays on the ground.
const STANCE: f64 = 0.6;
/// Foot pitch over a stride (share, radians; toes down is positive), from heel strike on.
const PITCH: [(f64, f64); 7] =
    [(0.0, -0.28), (0.10, 0.0), (0.36, 0.0), (0.60, 0.80), (0.72, 0.60), (0.90, -0.15), (1.0, -0.28)];

impl Circle {
    fn angle(&self, laps: f64) -> f64 {
        // Whole laps are dropped first, so that the last key equals the first to the bit.
        self.start_radians + TAU * (laps - laps.floor())
    }

    /// A point beside the path at a distance to the walker's left.
    fn point(&self, laps: f64, left_m: f64) -> DVec3 {
        let (angle, radius) = (self.angle(laps), self.radius_m - left_m);
        DVec3::new(radius * cos(angle), 0.0, -radius * sin(angle))
    }

    /// Turns +Z into the walking direction.
    fn heading(&self, laps: f64) -> DQuat {
        turn(DVec3::Y, self.angle(laps) + PI)
    }

    /// Times of keys that catch every stride, evenly spaced over the lap, both ends included.
    pub fn key_times(&self) -> Vec<f64> {
        let keys = self.strides as u32 * KEYS_A_STRIDE;
        (0..=keys).map(|key| self.lap_secs * f64::from(key) / f64::from(keys)).collect()
    }

    /// The pose at a time of the lap.
    pub fn pose(&self, time_secs: f64) -> Pose {
        let laps = time_secs / self.lap_secs;
        let stride = laps * self.strides;
        let phase = TAU * (stride - stride.floor());
        let mut pose = Pose { root: self.point(laps, 0.0), ..Pose::default() };
        pose.rotations[ROOT] = self.heading(laps);
        swing_body(&mut pose, phase);
        for right in [false, true] {
            let (ankle, foot) = self.foot(laps, right);
            place_leg(&mut pose, right, ankle, foot.rotation);
            pose.set_limb(TOE, right, turn(DVec3::X, -foot.toe_bend));
        }
        pose
    }

    /// Where an ankle is, and how its foot is turned.
    fn foot(&self, laps: f64, right: bool) -> (DVec3, FootTurn) {
        let late = if right { 0.5 } else { 0.0 };
        let stride = laps * self.strides - late;
        let (count, share) = (stride.floor(), stride - stride.floor());
        let plant = |count: f64| (count + late + STANCE / 2.0) / self.strides;
        let left_m = if right { -0.075 } else { 0.075 };
        let air = smoothstep(STANCE, 1.0, share);
        let ground = self.point(plant(count), left_m).lerp(self.point(plant(count + 1.0), left_m), air);
        let heading = blend(self.heading(plant(count)), self.heading(plant(count + 1.0)), air);
        let lift = 0.07 * sin(PI * ((share - STANCE) / (1.0 - STANCE)).max(0.0));

        let pitch = pitch_at(share);
        let rotation = heading * turn(DVec3::X, pitch);
        // The foot rolls over its ball when the heel rises, over its heel when the toes do.
        let pivot = if pitch > 0.0 { DVec3::Z * 0.13 } else { DVec3::Z * -0.06 };
        let ankle = DVec3::Y * JOINTS[FOOT].at().y - pivot;
        let place = ground + heading * pivot + rotation * ankle + DVec3::Y * lift;
        let toe_bend = pitch.max(0.0) * smoothstep(STANCE + 0.15, STANCE, share);
        (place, FootTurn { rotation, toe_bend })
    }
}

struct FootTurn {
    rotation: DQuat,
    toe_bend: f64,
}

fn pitch_at(share: f64) -> f64 {
    PITCH.windows(2).find(|pair| share <= pair[1].0).map_or(PITCH[0].1, |pair| {
        let ((from, start), (to, end)) = (pair[0], pair[1]);
        start + (end - start) * smoothstep(from, to, share)
    })
}

/// Everything above the legs; `phase` is 0 when the left heel strikes.
fn swing_body(pose: &mut Pose, phase: f64) {
    let mid_stance = phase - TAU * STANCE / 2.0;
    let forward = cos(phase);
    pose.pelvis_shift = DVec3::new(0.018 * cos(mid_stance), -0.035 + 0.02 * cos(2.0 * mid_stance), 0.0);
    pose.rotations[PELVIS] = turns(0.02, -0.10 * forward, 0.04 * cos(mid_stance));
    pose.rotations[SPINE] = turns(0.03, 0.08 * forward, -0.03 * cos(mid_stance));
    pose.rotations[CHEST] = turns(0.02, 0.12 * forward, -0.02 * cos(mid_stance));
    pose.rotations[NECK] = turns(-0.02, -0.06 * forward, 0.0);
    pose.rotations[HEAD] = turns(-0.02 + 0.02 * cos(2.0 * phase), -0.04 * forward + 0.10, 0.01 * cos(mid_stance));
    for (depth, &joint) in CAPE.iter().enumerate() {
        let late = 2.0 * phase - 0.9 * depth as f64;
        pose.rotations[joint] = turns(0.10 + 0.06 * cos(late), 0.0, 0.05 * cos(phase - 0.7 * depth as f64));
    }
    for right in [false, true] {
        let swing = if right { -forward } else { forward };
        pose.set_limb(UPPER_ARM, right, turn(DVec3::X, 0.06 + 0.42 * swing) * turn(DVec3::Z, -1.36));
        pose.set_limb(FOREARM, right, turn(DVec3::Y, -0.38 + 0.26 * swing));
        pose.set_limb(HAND, right, turns(-0.25, -0.10 + 0.10 * swing, -0.08));
    }
}

/// Bends a leg so that its ankle comes to `ankle`, and turns the foot.
fn place_leg(pose: &mut Pose, right: bool, ankle: DVec3, foot_rotation: DQuat) {
    let side = if right { SIDE } else { 0 };
    let (pelvis_rotation, _) = pose.world(PELVIS);
    let (_, hip) = pose.world(THIGH + side);
    let thigh_m = JOINTS[THIGH].at().distance(JOINTS[SHIN].at());
    let shin_m = JOINTS[SHIN].at().distance(JOINTS[FOOT].at());

    // A leg that cannot reach stays a little bent rather than snapping straight.
    let reach = (ankle - hip).length().min(0.999 * (thigh_m + shin_m));
    let down = (ankle - hip).normalize();
    let along = (thigh_m * thigh_m - shin_m * shin_m + reach * reach) / (2.0 * reach);
    let aside = (thigh_m * thigh_m - along * along).max(0.0).sqrt();
    let ahead = pelvis_rotation * DVec3::Z;
    let ahead = (ahead - down * ahead.dot(down)).normalize();
    let knee = hip + down * along + ahead * aside;
    let hinge = ahead.cross(down).normalize();

    let bone = |from: DVec3, to: DVec3| {
        let up = (from - to).normalize();
        DQuat::from_mat3(&DMat3::from_cols(hinge, up, hinge.cross(up))).normalize()
    };
    let thigh = bone(hip, knee);
    let shin = bone(knee, hip + down * reach);
    pose.rotations[THIGH + side] = (pelvis_rotation.conjugate() * thigh).normalize();
    pose.rotations[SHIN + side] = (thigh.conjugate() * shin).normalize();
    pose.rotations[FOOT + side] = (shin.conjugate() * foot_rotation).normalize();
}

/// Stands at a point and waves with the right hand; `length_secs` is the loop.
pub fn wave(place: DVec3, heading_radians: f64, time_secs: f64, length_secs: f64) -> Pose {
    let heading = turn(DVec3::Y, heading_radians);
    let share = time_secs / length_secs;
    let phase = TAU * (share - share.floor());
    let raised = smoothstep(0.05, 0.25, share) * smoothstep(0.95, 0.75, share);
    let mut pose = Pose { root: place, ..Pose::default() };
    pose.rotations[ROOT] = heading;
    pose.pelvis_shift = DVec3::new(0.012 + 0.006 * sin(phase), -0.012 + 0.004 * cos(2.0 * phase), 0.0);
    pose.rotations[SPINE] = turns(0.01, 0.0, -0.03 * raised);
    pose.rotations[CHEST] = turns(0.01 * cos(phase), -0.10 * raised, -0.04 * raised);
    pose.rotations[HEAD] = turns(0.02 - 0.02 * raised, 0.08 * raised, 0.09 * raised);
    for (depth, &joint) in CAPE.iter().enumerate() {
        pose.rotations[joint] = turns(0.03, 0.0, 0.02 * sin(phase - 0.5 * depth as f64));
    }

    let hanging = [turns(0.0, 0.0, -1.38), turn(DVec3::Y, -0.22), DQuat::IDENTITY];
    let swing = sin(5.0 * phase);
    let waving = [turns(0.0, -0.35, 0.25), turns(0.0, -0.25, 1.05 + 0.30 * swing), turns(1.2, 0.0, 0.18 * swing)];
    for (at, joint) in [UPPER_ARM, FOREARM, HAND].into_iter().enumerate() {
        pose.set_limb(joint, false, hanging[at]);
        pose.set_limb(joint, true, blend(hanging[at], waving[at], raised));
    }
    for right in [false, true] {
        let aside = if right { -0.10 } else { 0.10 };
        let toes_out = heading * turn(DVec3::Y, if right { -0.18 } else { 0.18 });
        let ankle = place + heading * DVec3::new(aside, JOINTS[FOOT].at().y, 0.0);
        place_leg(&mut pose, right, ankle, toes_out);
    }
    pose
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin::character::skeleton::COUNT;

    const PATH: Circle = Circle { radius_m: 2.2, lap_secs: 10.0, strides: 11.0, start_radians: 0.3 };

    /// While a foot lies flat (shares 0.10 to 0.36 of its stride) its ankle stays where it is.
    #[test]
    fn planted_feet_do_not_slide() {
        let stride_secs = PATH.lap_secs / PATH.strides;
        for (side, late) in [(0, 0.0), (SIDE, 0.5)] {
            let ankle = |share: f64| PATH.pose((3.0 + late + share) * stride_secs).world(FOOT + side).1;
            let planted = ankle(0.10);
            for share in [0.15, 0.2, 0.25, 0.3, 0.36] {
                assert!(ankle(share).distance(planted) < 1e-9, "{share}: {} from {planted}", ankle(share));
            }
            assert!((planted.y - JOINTS[FOOT].at().y).abs() < 1e-9);
        }
    }

    #[test]
    fn feet_stay_above_the_ground_and_bones_keep_their_lengths() {
        for step in 0..400 {
            let pose = PATH.pose(10.0 * f64::from(step) / 400.0);
            for joint in 0..COUNT {
                let (_, place) = pose.world(joint);
                assert!(place.y > if joint == ROOT { -1e-12 } else { 0.01 }, "joint {joint} at {place}");
            }
            for joint in [SHIN, FOOT, SHIN + SIDE, FOOT + SIDE] {
                let parent = JOINTS[joint].parent.expect("a limb");
                let length = pose.world(joint).1.distance(pose.world(parent).1);
                let bind = JOINTS[joint].at().distance(JOINTS[parent].at());
                assert!((length - bind).abs() < 1e-9);
            }
        }
    }
}
