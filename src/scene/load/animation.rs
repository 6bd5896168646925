//! Clips: channels with strictly increasing key times and as many values as those call for.

use gltf::json::{
    self,
    animation::{Interpolation as FileInterpolation, Property as FileProperty},
    validation::Checked,
};

use super::{
    error::{About, Defect, counted, label},
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
    let mut morphs = 0;
    for (number, channel) in animation.channels.iter().enumerate() {
        let object = || format!("{name}, channel {number}");
        let property = match channel.target.path {
            Checked::Valid(FileProperty::Translation) => Property::Translation,
            Checked::Valid(FileProperty::Rotation) => Property::Rotation,
            Checked::Valid(FileProperty::Scale) => Property::Scale,
            Checked::Valid(FileProperty::MorphTargetWeights) => {
                morphs += 1;
                continue;
            }
            Checked::Invalid => return Err(Defect::new(object(), "animates an unknown property")),
        };
        let node = rank.get(channel.target.node.value()).copied();
        let node = node.ok_or_else(|| Defect::new(object(), "animates a node that does not exist"))?;
        if let LocalTransform::Matrix(_) = nodes[node].local {
            warnings.push(format!("{}: its node has a matrix, which cannot be animated; it is left out", object()));
            continue;
        }
        if channels.iter().any(|other| other.node == node && other.property == property) {
            return Err(Defect::new(object(), "animates what another channel of the clip animates"));
        }
        let sampler = animation.samplers.get(channel.sampler.value());
        let sampler = sampler.ok_or_else(|| Defect::new(object(), "names a sampler that does not exist"))?;
        channels.push(read_channel(source, sampler, node, property).about(object)?);
    }
    if morphs > 0 {
        let left_out = counted(morphs, "channel", "channels");
        warnings.push(format!("{name}: {left_out} left out: morph targets are not animated"));
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
