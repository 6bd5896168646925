//! Animations of a file: tracks of keys, gathered into a clip.

use glam::{DQuat, DVec3};
use gltf::json::accessor::Accessor;
use gltf::json::animation::{Animation, Channel, Interpolation, Property, Sampler, Target};
use gltf::json::validation::Checked::Valid;
use gltf::json::{Index, Node};

use super::{GlbWriter, float3, float4};
use crate::scene::builtin::exact::{STEPS, rounded};

/// Keys of one property of a node, one a time.
#[derive(Clone, Debug)]
pub enum Track {
    Translation(Vec<DVec3>),
    Scale(Vec<DVec3>),
    /// Key by key, one a morph target.
    MorphWeights(Vec<f64>),
    Rotation(Vec<DQuat>),
    /// Holds each key until the next.
    SteppedRotation(Vec<DQuat>),
    /// (in-tangent, value, out-tangent), tangents per second.
    SplineRotation(Vec<[DQuat; 3]>),
}

/// A clip in the making; [`GlbWriter::clip`] stores it.
pub struct ClipWriter {
    name: String,
    tracks: Vec<(Index<Node>, Vec<f64>, Track)>,
}

impl ClipWriter {
    pub fn new(name: &str) -> Self {
        Self { name: name.into(), tracks: Vec::new() }
    }

    pub fn track(&mut self, node: Index<Node>, times_secs: &[f64], track: Track) {
        self.tracks.push((node, times_secs.to_vec(), track));
    }
}

impl GlbWriter {
    pub fn clip(&mut self, clip: ClipWriter) {
        let mut channels = Vec::new();
        let mut samplers = Vec::new();
        // Tracks with the same key times share one accessor.
        let mut inputs: Vec<(Vec<f64>, Index<Accessor>)> = Vec::new();
        for (node, times_secs, track) in clip.tracks {
            let input = match inputs.iter().find(|(known, _)| *known == times_secs) {
                Some((_, input)) => *input,
                None => {
                    let rows: Vec<[f32; 1]> = times_secs.iter().map(|&time| [rounded(time, STEPS)]).collect();
                    let input = self.floats(&rows, None, true);
                    inputs.push((times_secs, input));
                    input
                }
            };
            let (path, interpolation, output) = self.keys(track);
            let interpolation = Valid(interpolation);
            let sampler =
                Index::push(&mut samplers, Sampler { input, interpolation, output, extensions: None, extras: None });
            let target = Target { node, path: Valid(path), extensions: None, extras: None };
            channels.push(Channel { sampler, target, extensions: None, extras: None });
        }
        self.root.push(Animation { name: Some(clip.name), channels, samplers, extensions: None, extras: None });
    }

    fn keys(&mut self, track: Track) -> (Property, Interpolation, Index<Accessor>) {
        let rotations = |keys: Vec<DQuat>| -> Vec<[f32; 4]> { one_hemisphere(keys).into_iter().map(float4).collect() };
        let vectors = |keys: Vec<DVec3>| -> Vec<[f32; 3]> { keys.into_iter().map(float3).collect() };
        match track {
            Track::Translation(keys) => {
                (Property::Translation, Interpolation::Linear, self.floats(&vectors(keys), None, false))
            }
            Track::Scale(keys) => (Property::Scale, Interpolation::Linear, self.floats(&vectors(keys), None, false)),
            Track::MorphWeights(keys) => {
                let rows: Vec<[f32; 1]> = keys.into_iter().map(|key| [rounded(key, STEPS)]).collect();
                (Property::MorphTargetWeights, Interpolation::Linear, self.floats(&rows, None, false))
            }
            Track::Rotation(keys) => {
                (Property::Rotation, Interpolation::Linear, self.floats(&rotations(keys), None, false))
            }
            Track::SteppedRotation(keys) => {
                (Property::Rotation, Interpolation::Step, self.floats(&rotations(keys), None, false))
            }
            Track::SplineRotation(keys) => {
                let rows: Vec<[f32; 4]> = keys.as_flattened().iter().map(|&key| float4(key)).collect();
                (Property::Rotation, Interpolation::CubicSpline, self.floats(&rows, None, false))
            }
        }
    }
}

/// Signs such that neighbouring keys are near each other, for players that blend component by component.
fn one_hemisphere(mut keys: Vec<DQuat>) -> Vec<DQuat> {
    for at in 1..keys.len() {
        if keys[at].dot(keys[at - 1]) < 0.0 {
            keys[at] = -keys[at];
        }
    }
    keys
}
