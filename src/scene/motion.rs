//! What moves, and how: the objects of a scene and the stretch each bakes into its voxels
//! (right-polar decomposition W = R·U).
//!
//! The paper moves voxels rigidly. What a world matrix does beyond turning and shifting, U, is
//! baked into the mesh before voxelization, as its mean over the clip that is played; an object whose
//! U strays from that mean by half a cell or more is voxelized every frame instead, where settings allow it. Where it is
//! moved, a rigid one has its largest U: its voxels are more than it needs when it is small, and never leave holes.

use std::collections::HashMap;
use std::fmt;

use glam::DMat3;

use super::{Channel, Interpolation, LocalTransform, Property, Scene, Warning};

/// One drawable: a node with a mesh. The unit of Object I-O (section 4.2).
#[derive(Clone, Debug)]
pub struct Object {
    pub name: String,
    pub node: usize,
    pub mesh: usize,
    pub motion: Motion,
    /// U, baked into the mesh before voxelization: what is left to move is rigid.
    /// The node's for rigid objects; one for all parts of a skin, the mean over its joints. Over the clip that is
    /// played the mean, and the largest where that would leave holes. Flat where the object always is; the identity
    /// where it never has an area: the object is hidden.
    pub stretch: DMat3,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// No clip moves the node or its ancestors.
    Static,
    /// The node's world matrix moves it.
    Rigid,
    /// The joints of this skin move it.
    Skinned { skin: usize },
}

/// Exporters write scales and rest values that differ in the last bits of an f32; this share of
/// a value is not motion, and not stretch.
pub(super) const LAST_BITS: f64 = 1.0 / (1 << 20) as f64;

/// The objects of a scene, and those among them (by index) that the method shows in part or not at all.
#[derive(Clone, Debug)]
pub struct MotionReport {
    pub objects: Vec<Object>,
    /// Their matrices leave no area, or are not finite, at all times.
    pub hidden: Vec<usize>,
    /// They are no rigid motion of their voxels: their stretch strays from its mean so far that some vertex is half a
    /// cell or more off at some time, or blended joints take voxels of a skin as far from where they should be; the
    /// largest such distance in cells.
    pub stretching: Vec<(usize, f64)>,
    /// Morph targets take some vertex half a cell or more away from where it rests; the largest such distance in cells.
    pub morphing: Vec<(usize, f64)>,
}

/// Why the voxels of an object cannot be moved as they are: by how many cells they would be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unmovable {
    Stretches { cells: f64 },
    Morphs { cells: f64 },
}

/// What follows the object's name in a sentence.
impl fmt::Display for Unmovable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stretches { cells } => write!(f, "stretches by up to {cells:.1} cells"),
            Self::Morphs { cells } => write!(f, "has morph targets that move it by up to {cells:.1} cells"),
        }
    }
}

impl MotionReport {
    /// By object that cannot be moved as it is. One that stretches and morphs is said to do what takes it farther.
    pub fn unmovable(&self) -> HashMap<usize, Unmovable> {
        let stretching = self.stretching.iter().map(|&(object, cells)| (object, Unmovable::Stretches { cells }));
        let mut found: HashMap<usize, Unmovable> = stretching.collect();
        for &(object, cells) in &self.morphing {
            let morphs = Unmovable::Morphs { cells };
            let place = found.entry(object).or_insert(morphs);
            if matches!(*place, Unmovable::Stretches { cells: stretch } if stretch < cells) {
                *place = morphs;
            }
        }
        found
    }

    /// A sentence for each object that is hidden.
    pub fn warnings(&self) -> Vec<Warning> {
        let hidden = self.hidden.iter().map(|&object| {
            let Object { name, node, .. } = &self.objects[object];
            let why = "its matrix leaves no area, or is not finite, at all times";
            Warning::new(format!("object \"{name}\" is hidden: {why}")).at(*node)
        });
        hidden.collect()
    }
}

impl Scene {
    /// One object per node with a mesh, in node order, as the first clip stretches them.
    pub fn objects(&self) -> Vec<Object> {
        self.motion_report(f64::INFINITY, self.first_clip()).objects
    }

    /// The clip that is played where none is asked for.
    pub fn first_clip(&self) -> Option<usize> {
        (!self.clips.is_empty()).then_some(0)
    }

    /// The objects as a clip moves them, or at rest, and what of that cannot be shown with cells of `span` scene
    /// units. An object that strays from its mean stretch gets its largest: then no moment leaves holes.
    pub fn motion_report(&self, span: f64, clip: Option<usize>) -> MotionReport {
        let mut objects: Vec<Object> = self.mesh_nodes().collect();
        let means = self.mean_stretches(&objects, clip);
        for (object, mean) in objects.iter_mut().zip(&means) {
            object.stretch = mean.unwrap_or(DMat3::IDENTITY);
        }
        let hidden = (0..objects.len()).filter(|&object| means[object].is_none()).collect();
        if !span.is_finite() {
            // In cells that know no end nothing is off by half of one.
            return MotionReport { objects, hidden, stretching: Vec::new(), morphing: Vec::new() };
        }
        let stretching = self.strays(&objects, span, clip);
        self.enlarge(&mut objects, &stretching, clip);
        let morphing = self.morphs(&objects, span, clip);
        MotionReport { objects, hidden, stretching, morphing }
    }

    /// By index into [`Scene::objects`]; see [`MotionReport::stretching`].
    pub fn stretching_objects(&self, span: f64) -> Vec<(usize, f64)> {
        self.motion_report(span, self.first_clip()).stretching
    }

    /// The objects before their stretch is known.
    pub fn mesh_nodes(&self) -> impl Iterator<Item = Object> {
        let moving = self.moving_nodes();
        let mesh_nodes = self.nodes.iter().enumerate().filter_map(|(index, node)| Some((index, node, node.mesh?)));
        mesh_nodes.map(move |(index, node, mesh)| Object {
            name: node.name.clone(),
            node: index,
            mesh,
            motion: match node.skin {
                Some(skin) => Motion::Skinned { skin },
                None if moving[index] => Motion::Rigid,
                None => Motion::Static,
            },
            stretch: DMat3::IDENTITY,
        })
    }

    /// By node: does any clip move it or one of its ancestors?
    pub(super) fn moving_nodes(&self) -> Vec<bool> {
        let mut moving = vec![false; self.nodes.len()];
        for channel in self.clips.iter().flat_map(|clip| &clip.channels) {
            moving[channel.node] |= match self.nodes[channel.node].local {
                LocalTransform::Matrix(_) => false,
                LocalTransform::Trs(rest) => match channel.property {
                    Property::Translation => channel.leaves(rest.translation.to_array()),
                    Property::Scale => channel.leaves(rest.scale.to_array()),
                    Property::Visibility | Property::MorphWeights { .. } => false,
                    Property::Rotation => {
                        channel.leaves(rest.rotation.to_array()) && channel.leaves((-rest.rotation).to_array())
                    }
                },
            };
        }
        for index in 0..self.nodes.len() {
            moving[index] |= self.nodes[index].parent.is_some_and(|parent| moving[parent]);
        }
        moving
    }
}

impl Channel {
    /// Does it ever take its node off the rest value, by more than the last bits of an f32?
    fn leaves<const N: usize>(&self, rest: [f64; N]) -> bool {
        let largest = |numbers: &[f64]| numbers.iter().fold(0.0, |largest: f64, number| largest.max(number.abs()));
        let tolerance = LAST_BITS * largest(&rest);
        let strays = |values: &[f64]| values.iter().zip(&rest).any(|(value, rest)| (value - rest).abs() > tolerance);
        match self.interpolation {
            Interpolation::Step | Interpolation::Linear => self.values.chunks_exact(N).any(strays),
            Interpolation::CubicSpline => {
                let duration_secs =
                    self.times_secs.last().copied().unwrap_or(0.0) - self.times_secs.first().copied().unwrap_or(0.0);
                self.values.chunks_exact(3 * N).any(|key| {
                    strays(&key[N..2 * N]) || largest(&key[..N]).max(largest(&key[2 * N..])) * duration_secs > tolerance
                })
            }
        }
    }
}
