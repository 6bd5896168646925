//! Clips: channels with key times that do not decrease and as many values as those call for.

use std::collections::HashSet;

use gltf::json::{
    self,
    animation::{Interpolation as FileInterpolation, Property as FileProperty},
    validation::Checked,
};

use serde_json::Value;

use super::{
    error::Defect,
    file_object::{FileObject, label},
    keys::{self, KeyRepairs},
    nodes::VISIBILITY,
    source::Source,
};
use crate::scene::{Channel, Clip, Interpolation, LocalTransform, Mesh, Node, Property, Warning};

/// `rank` leads from the file's node numbers to those of `nodes`. Channels that cannot be read are left out with a
/// warning.
pub(super) fn load(
    source: &Source,
    index: usize,
    animation: &json::Animation,
    rank: &[usize],
    (nodes, meshes): (&[Node], &[Mesh]),
    warnings: &mut Vec<Warning>,
) -> Result<Clip, Defect> {
    let name = FileObject::item("animation", index, animation.name.as_deref());
    let mut channels: Vec<Channel> = Vec::new();
    let mut taken = HashSet::new();
    for channel in &animation.channels {
        let target = &channel.target;
        let Some(&node) = rank.get(target.node.value()) else {
            return Err(Defect::new(name, "animates a node that does not exist"));
        };
        let node_label = label("node", target.node.value(), Some(&nodes[node].name));
        let property = match target.path {
            Checked::Valid(FileProperty::Translation) => Property::Translation,
            Checked::Valid(FileProperty::Rotation) => Property::Rotation,
            Checked::Valid(FileProperty::Scale) => Property::Scale,
            Checked::Valid(FileProperty::MorphTargetWeights) => match morph_weights(&nodes[node], meshes) {
                Some(property) => property,
                None => {
                    let what = name.member(format_args!("morph weights of {node_label}"));
                    let cause = "it animates morph weights of a node that shows no morph target; it is left out";
                    warnings.push(what.warning(cause).at(node));
                    continue;
                }
            },
            Checked::Invalid => {
                let sentence = format!("{name}, a property of {node_label}, which glTF does not know; it is left out");
                warnings.push(Warning { part: name.part(), ..Warning::new(sentence) }.at(node));
                continue;
            }
        };
        let object = name.member(format_args!("{} of {node_label}", property.name()));
        let loaded = match taken.insert((node, property)) {
            true if places(property) && matches!(nodes[node].local, LocalTransform::Matrix(_)) => {
                Err("its node has a matrix, which cannot be animated".to_owned())
            }
            true => load_channel(source, animation, channel.sampler.value(), (node, property)),
            false => Err("it animates what another channel of the clip animates".to_owned()),
        };
        match loaded {
            Ok((channel, repairs)) => {
                warnings.extend(repairs.told().map(|told| object.warning(told).at(node)));
                channels.push(channel);
            }
            Err(cause) => leave_out(source, &object, &cause, node, warnings)?,
        }
    }
    for (sampler, node) in visibility(animation) {
        let Some((&node, file_node)) = rank.get(node).zip(Some(node)) else {
            warnings.push(name.warning(format!("it animates the visibility of node {node}, which does not exist")));
            continue;
        };
        let object = name.member(format_args!("visibility of {}", label("node", file_node, Some(&nodes[node].name))));
        match load_channel(source, animation, sampler, (node, Property::Visibility)) {
            Ok((channel, repairs)) => {
                warnings.extend(repairs.told().map(|told| object.warning(told).at(node)));
                channels.push(channel);
            }
            Err(cause) => leave_out(source, &object, &cause, node, warnings)?,
        }
    }
    Ok(Clip {
        name: animation.name.clone().unwrap_or_else(|| format!("animation {index}")),
        duration_secs: channels.iter().filter_map(|channel| channel.times_secs.last()).copied().fold(0.0, f64::max),
        channels,
    })
}

/// Where a mesh with morph targets is shown.
fn morph_weights(node: &Node, meshes: &[Mesh]) -> Option<Property> {
    let mesh = node.mesh?;
    let morphs = meshes[mesh].primitives.iter().filter_map(|primitive| primitive.morph.as_ref());
    Some(Property::MorphWeights { mesh, targets: morphs.map(|morph| morph.targets.len()).max()? })
}

/// It moves the node.
fn places(property: Property) -> bool {
    matches!(property, Property::Translation | Property::Rotation | Property::Scale)
}

/// A channel that cannot be read is left out, unless for want of memory.
fn leave_out(
    source: &Source,
    object: &FileObject,
    cause: &str,
    node: usize,
    warnings: &mut Vec<Warning>,
) -> Result<(), Defect> {
    if source.budget.is_exceeded() {
        return Err(Defect::new(object.clone(), cause));
    }
    warnings.push(object.warning(format!("{cause}; it is left out")).at(node));
    Ok(())
}

/// Sampler and node of each channel that shows and hides, as [`super::json`] sets them apart.
fn visibility(animation: &json::Animation) -> Vec<(usize, usize)> {
    let apart = animation.extensions.as_ref().and_then(|all| all.others.get(VISIBILITY)?.get("channels")?.as_array());
    let number = |channel: &Value, pointer: &str| Some(channel.pointer(pointer)?.as_u64()? as usize);
    let channels = apart.into_iter().flatten();
    channels.filter_map(|channel| Some((number(channel, "/sampler")?, number(channel, "/target/node")?))).collect()
}

/// Errors are causes.
fn load_channel(
    source: &Source,
    animation: &json::Animation,
    sampler: usize,
    (node, property): (usize, Property),
) -> Result<(Channel, KeyRepairs), String> {
    let sampler = animation.samplers.get(sampler).ok_or("it names a sampler that does not exist")?;
    let times = &source.root.accessors[sampler.input.value()];
    if times.buffer_view.is_none() && times.sparse.is_none() && times.count.0 > 1 {
        return Err("its key times have no data".to_owned());
    }
    let it = |cause: String| format!("it {cause}");
    let mut channel = read_channel(source, sampler, node, property).map_err(it)?;
    channel.check_count().map_err(it)?;
    let repairs = keys::repair(&mut channel);
    channel.check().map_err(it)?;
    Ok((channel, repairs))
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
        Property::Visibility | Property::MorphWeights { .. } => {
            output.floats::<1>(0..output.count)?.into_iter().flatten().map(f64::from).collect()
        }
        _ => output.floats::<3>(0..output.count)?.into_iter().flatten().map(f64::from).collect(),
    };
    Ok(Channel { node, property, interpolation, times_secs, values })
}
