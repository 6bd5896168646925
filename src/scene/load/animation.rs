//! Clips: channels with strictly increasing key times and as many values as those call for.

use std::collections::{BTreeSet, HashSet};

use gltf::json::{
    self,
    animation::{Interpolation as FileInterpolation, Property as FileProperty},
    validation::Checked,
};

use super::{
    error::{About, Defect, label},
    nodes::unit_quaternion,
    source::Source,
};
use crate::scene::{Channel, Clip, Interpolation, LocalTransform, Node, Property};

/// `rank` leads from the file's node numbers to those of `nodes`.
pub(super) fn load(
    source: &Source,
    index: usize,
    animation: &json::Animation,
    rank: &[usize],
    nodes: &[Node],
    warnings: &mut Vec<String>,
) -> Result<Clip, Defect> {
    let name = label("animation", index, animation.name.as_deref());
    let mut channels: Vec<Channel> = Vec::new();
    let mut taken = HashSet::new();
    let mut morphed = BTreeSet::new();
    for channel in &animation.channels {
        let target = &channel.target;
        let Some(&node) = rank.get(target.node.value()) else {
            return Err(Defect::new(name, "animates a node that does not exist"));
        };
        let object =
            |what: &str| format!("{name}, {what} of {}", label("node", target.node.value(), Some(&nodes[node].name)));
        let property = match target.path {
            Checked::Valid(FileProperty::Translation) => Property::Translation,
            Checked::Valid(FileProperty::Rotation) => Property::Rotation,
            Checked::Valid(FileProperty::Scale) => Property::Scale,
            Checked::Valid(FileProperty::MorphTargetWeights) => {
                morphed.insert(node);
                continue;
            }
            Checked::Invalid => {
                warnings.push(format!("{}, which glTF does not know; it is left out", object("a property")));
                continue;
            }
        };
        let object = || object(property.name());
        if let LocalTransform::Matrix(_) = nodes[node].local {
            warnings.push(format!("{}: its node has a matrix, which cannot be animated; it is left out", object()));
            continue;
        }
        if !taken.insert((node, property)) {
            return Err(Defect::new(object(), "animates what another channel of the clip animates"));
        }
        let sampler = animation.samplers.get(channel.sampler.value());
        let sampler = sampler.ok_or_else(|| Defect::new(object(), "names a sampler that does not exist"))?;
        channels.push(read_channel(source, sampler, node, property).about(object)?);
    }
    for node in morphed {
        let node = &nodes[node].name;
        warnings
            .push(format!("{name}: the morph weights of \"{node}\" move, which is not shown; its resting shape moves"));
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
    let times: Vec<[f32; 1]> = input.floats(0..input.count)?;
    let times_secs: Vec<f64> = times.into_iter().map(|[time]| f64::from(time)).collect();
    let output = source.elements(sampler.output)?;
    let mut values: Vec<f64> = match property {
        Property::Rotation => output.floats::<4>(0..output.count)?.into_iter().flatten().map(f64::from).collect(),
        _ => output.floats::<3>(0..output.count)?.into_iter().flatten().map(f64::from).collect(),
    };
    if property == Property::Rotation && interpolation != Interpolation::CubicSpline {
        for (key, rotation) in values.chunks_exact_mut(4).enumerate() {
            let unit = unit_quaternion([rotation[0], rotation[1], rotation[2], rotation[3]]);
            let unit = unit.ok_or_else(|| format!("has a rotation at key {key} that is zero or not finite"))?;
            rotation.copy_from_slice(&unit.to_array());
        }
    }
    let channel = Channel { node, property, interpolation, times_secs, values };
    channel.check()?;
    Ok(channel)
}
