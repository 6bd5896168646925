//! Joints and weights of a primitive: any number of sets merged into the four strongest that sum to 1.

use gltf::json::mesh::Semantic;

use super::{
    attributes::Attributes,
    error::{About, Defect, counted},
    file_object::FileObject,
};
use crate::scene::Warning;

/// Influences kept a vertex.
const KEPT: usize = 4;
/// Weights of normalised bytes, four of them, sum to 1 within this.
const SUM_TOLERANCE: f64 = 0.01;

/// What [`Influences::of`] had to change, counted over the vertices of one primitive.
#[derive(Default)]
struct Repairs {
    without_weight: usize,
    negative: usize,
    not_normalized: usize,
    repeated: usize,
    dropped: usize,
    largest_dropped_share: f64,
}

/// Four joints and their weights a vertex, strongest first where more than one set was merged.
pub(super) struct Influences {
    pub joints: Vec<[u16; KEPT]>,
    pub weights: Vec<[f32; KEPT]>,
}

impl Influences {
    /// `None` where the primitive has no skin attributes.
    pub fn of(attributes: &Attributes, warnings: &mut Vec<Warning>) -> Result<Option<Self>, Defect> {
        let sets = attributes.joint_sets();
        if sets == 0 {
            return Ok(None);
        }
        let mut joints = Vec::with_capacity(sets as usize);
        let mut weights = Vec::with_capacity(sets as usize);
        for set in 0..sets {
            joints.push(attributes.unsigned::<4>(&Semantic::Joints(set))?);
            weights.push(attributes.repaired::<4>(&Semantic::Weights(set), [0.0; 4], warnings)?);
        }
        let mut repairs = Repairs::default();
        let mut influences = Self { joints: Vec::new(), weights: Vec::new() };
        for vertex in 0..attributes.vertex_count() {
            let all = (0..sets as usize).flat_map(|set| joints[set][vertex].into_iter().zip(weights[set][vertex]));
            let (kept_joints, kept_weights) = strongest(all.collect(), &mut repairs);
            let joints =
                kept_joints.map(|joint| u16::try_from(joint).map_err(|_| format!("joint {joint} is too large")));
            let [a, b, c, d] = joints;
            let object = || attributes.object(&Semantic::Joints(0));
            influences.joints.push([a.about(object)?, b.about(object)?, c.about(object)?, d.about(object)?]);
            influences.weights.push(kept_weights);
        }
        repairs.report(&attributes.primitive, warnings);
        Ok(Some(influences))
    }
}

/// The strongest influences of one vertex, renormalised. Those of no weight name joint 0.
fn strongest(mut all: Vec<(u32, f32)>, repairs: &mut Repairs) -> ([u32; KEPT], [f32; KEPT]) {
    let first_joint = all[0].0;
    repairs.negative += usize::from(all.iter().any(|&(_, weight)| weight < 0.0));
    all.retain(|&(_, weight)| weight > 0.0);
    let total: f64 = all.iter().map(|&(_, weight)| f64::from(weight)).sum();
    repairs.not_normalized += usize::from(!all.is_empty() && (total - 1.0).abs() > SUM_TOLERANCE);
    let is_repeated = |(slot, (joint, _)): (usize, &(u32, f32))| all[..slot].iter().any(|(other, _)| other == joint);
    repairs.repeated += usize::from(all.iter().enumerate().any(is_repeated));
    if all.len() > KEPT {
        all.sort_by(|a, b| b.1.total_cmp(&a.1)); // stable: equal weights stay in the file's order
    }
    let kept: f64 = all.iter().take(KEPT).map(|&(_, weight)| f64::from(weight)).sum();
    if all.len() > KEPT {
        repairs.dropped += 1;
        repairs.largest_dropped_share = repairs.largest_dropped_share.max(1.0 - kept / total);
    }
    if all.is_empty() {
        repairs.without_weight += 1;
        return ([first_joint, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]);
    }
    let mut joints = [0; KEPT];
    let mut weights = [0.0; KEPT];
    for (slot, (joint, weight)) in all.into_iter().take(KEPT).enumerate() {
        joints[slot] = joint;
        weights[slot] = (f64::from(weight) / kept) as f32;
    }
    (joints, weights)
}

impl Repairs {
    fn report(&self, primitive: &FileObject, warnings: &mut Vec<Warning>) {
        let vertices = |count| counted(count, "vertex", "vertices");
        if self.without_weight > 0 {
            let count = vertices(self.without_weight);
            warnings.push(primitive.warning(format!("{count} without joint weight, bound to the first joint named")));
        }
        if self.negative > 0 {
            let count = vertices(self.negative);
            warnings.push(primitive.warning(format!("{count} with negative joint weights, taken as 0")));
        }
        if self.not_normalized > 0 {
            let count = vertices(self.not_normalized);
            warnings
                .push(primitive.warning(format!("{count} whose joint weights do not sum to 1; they are normalised")));
        }
        if self.repeated > 0 {
            let count = vertices(self.repeated);
            warnings.push(primitive.warning(format!("{count} with a joint named twice; its weights are added")));
        }
        if self.dropped > 0 {
            let (count, percent) = (vertices(self.dropped), 100.0 * self.largest_dropped_share);
            warnings.push(primitive.warning(format!(
                "{count} with more than {KEPT} joints, of which the strongest are kept; \
                 up to {percent:.2} % of the weight of a vertex is dropped"
            )));
        }
    }
}
