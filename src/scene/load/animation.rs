//! Clips: channels with strictly increasing key times and as many values as those call for.

use std::collections::{BTreeSet, HashSet};

use gltf::json::{
    self,
    animation::{Interpolation as FileInterpolation, Property as FileProperty},
    validation::Checked,
};

use super::{
    error::{About, Defect},
    file_object::{FileObject, label},
    nodes::unit_quaternion,
    source::Source,
};
use crate::scene::{Channel, Clip, Interpolation, LocalTransform, Node, Property, Warning};

/// Quaternions of normalised bytes are this far from unit length.
const UNIT_TOLERANCE: f64 = 0.01;

/// `rank` leads from the file's node numbers to those of `nodes`.
pub(super) fn load(
    source: &Source,
    index: usize,
    animation: &json::Animation,
    rank: &[usize],
    nodes: &[Node],
    warnings: &mut Vec<Warning>,
) -> Result<Clip, Defect> {
    let name = FileObject::item("animation", index, animation.name.as_deref());
    let mut channels: Vec<Channel> = Vec::new();
    let mut taken = HashSet::new();
    let mut morphed = BTreeSet::new();
    for channel in &animation.channels {
        let target = &channel.target;
        let Some(&node) = rank.get(target.node.value()) else {
            return Err(Defect::new(name, "animates a node that does not exist"));
        };
        let object = |what: &str| {
            name.member(format!("{what} of {}", label("node", target.node.value(), Some(&nodes[node].name))))
        };
        let property = match target.path {
            Checked::Valid(FileProperty::Translation) => Property::Translation,
            Checked::Valid(FileProperty::Rotation) => Property::Rotation,
            Checked::Valid(FileProperty::Scale) => Property::Scale,
            Checked::Valid(FileProperty::MorphTargetWeights) => {
                morphed.insert(node);
                continue;
            }
            Checked::Invalid => {
                let sentence = format!("{}, which glTF does not know; it is left out", object("a property"));
                let warning = Warning { part: name.part(), ..Warning::new(sentence) }.at(node);
                warnings.push(warning);
                continue;
            }
        };
        let object = || object(property.name());
        if let LocalTransform::Matrix(_) = nodes[node].local {
            warnings.push(object().warning("its node has a matrix, which cannot be animated; it is left out").at(node));
            continue;
        }
        if !taken.insert((node, property)) {
            return Err(Defect::new(object(), "animates what another channel of the clip animates"));
        }
        let sampler = animation.samplers.get(channel.sampler.value());
        let sampler = sampler.ok_or_else(|| Defect::new(object(), "names a sampler that does not exist"))?;
        let times = &source.root.accessors[sampler.input.value()];
        if times.buffer_view.is_none() && times.sparse.is_none() && times.count.0 > 1 {
            warnings.push(object().warning("its key times have no data; it is left out").at(node));
            continue;
        }
        let mut channel = read_channel(source, sampler, node, property).about(object)?;
        if property == Property::Rotation {
            let off = make_unit(&mut channel).about(object)?;
            if off > UNIT_TOLERANCE {
                warnings.push(
                    object()
                        .warning(format!(
                            "its rotations are not unit quaternions (off by {off:.3}); they are normalised"
                        ))
                        .at(node),
                );
            }
        }
        channel.check().about(object)?;
        channels.push(channel);
    }
    for node in morphed {
        let moved = &nodes[node].name;
        warnings.push(
            name.warning(format!("the morph weights of \"{moved}\" move, which is not shown; its resting shape moves"))
                .at(node),
        );
    }
    Ok(Clip {
        name: animation.name.clone().unwrap_or_else(|| format!("animation {index}")),
        duration_secs: channels.iter().filter_map(|channel| channel.times_secs.last()).copied().fold(0.0, f64::max),
        channels,
    })
}

fn read_channel(
    source: &Source,
    sampler: &json::animation::Sampler,
    node: usize,
    property: Property,
) -> Result<Channel, String> {
    let interpolation = match sampler.interpolation {
        Checked::Valid(FileInterpolation::Step) => Interpolation::Step,
        Checked::Valid(FileInterpolation::Linear) => Interpolation::Linear,
        Checked::Valid(FileInterpolation::CubicSpline) => Interpolation::CubicSpline,
        Checked::Invalid => return Err("has an unknown interpolation".to_owned()),
    };
    let input = source.elements(sampler.input)?;
    let output = source.elements(sampler.output)?;
    // Every channel has its own copy, however many share one sampler.
    source.budget.spend_on(output.number_count().saturating_add(input.count), size_of::<f64>())?;
    let times: Vec<[f32; 1]> = input.floats(0..input.count)?;
    let times_secs: Vec<f64> = times.into_iter().map(|[time]| f64::from(time)).collect();
    let values: Vec<f64> = match property {
        Property::Rotation => output.floats::<4>(0..output.count)?.into_iter().flatten().map(f64::from).collect(),
        _ => output.floats::<3>(0..output.count)?.into_iter().flatten().map(f64::from).collect(),
    };
    Ok(Channel { node, property, interpolation, times_secs, values })
}

/// Normalises the rotations at the keys, where nothing normalises after interpolation; returns by
/// how much the length of one is off.
fn make_unit(channel: &mut Channel) -> Result<f64, String> {
    let mut off: f64 = 0.0;
    let is_spline = channel.interpolation == Interpolation::CubicSpline;
    for (row, rotation) in channel.values.chunks_exact_mut(4).enumerate() {
        // Of the three rows of a spline's key, the first and last are tangents.
        if is_spline && row % 3 != 1 {
            continue;
        }
        let value = [rotation[0], rotation[1], rotation[2], rotation[3]];
        off = off.max((value.iter().map(|lane| lane * lane).sum::<f64>().sqrt() - 1.0).abs());
        if !is_spline {
            let unit = unit_quaternion(value)
                .ok_or_else(|| format!("has a rotation at key {row} that is zero or not finite"))?;
            rotation.copy_from_slice(&unit.to_array());
        }
    }
    Ok(off)
}
