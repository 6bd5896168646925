//! The stretch U that is baked into an object's voxels, and how far the scene strays from it.
//!
//! In: posed matrices W of nodes, or of joints with their inverse bind. Out: the mean of U over the
//! keys of a clip (over the joints too for a skin, weighted by use), the distance in cells by which U
//! takes vertices away from that mean, and the largest U.

use std::collections::BTreeMap;

use glam::{DMat3, DMat4, DVec3};

use super::{
    Mesh, Motion, Object, Pose, Scene,
    bounds::{Aabb, joint_boxes},
    motion::LAST_BITS,
    polar::{right_polar_or_flat, unflattened},
    strain::{Strains, affordable_moments},
};

/// Poses a clip is looked at, at most.
const MAX_STRETCH_SAMPLES: usize = 65;
/// However many triangles there are: the first, the last and one between.
const LEAST_STRETCH_SAMPLES: usize = 3;

/// From here on an object counts as stretching.
const STRETCHING_CELLS: f64 = 0.5;

impl Scene {
    /// Objects of which some vertex is at some time half a cell or more away from where the baked
    /// mean would have it, and skins whose blended joints take voxels as far from where they should be: index and the
    /// largest distance in cells. A shift common to all vertices of an object or joint does not count.
    pub(super) fn strays(&self, objects: &[Object], span: f64, clip: Option<usize>) -> Vec<(usize, f64)> {
        let moving = objects.iter().enumerate().filter(|(_, object)| object.motion != Motion::Static);
        let mut probes: Vec<(usize, Probe)> =
            moving.map(|(index, object)| (index, Probe::new(self, object, STRETCHING_CELLS * span))).collect();
        if probes.is_empty() {
            return Vec::new();
        }
        self.for_each_sample(clip, |pose| {
            for (_, probe) in &mut probes {
                probe.look_at(self, pose);
            }
        });
        let mut cells: BTreeMap<usize, f64> =
            probes.into_iter().map(|(index, probe)| (index, probe.largest / span)).collect();
        for (index, strained) in self.strains(objects, span, clip) {
            cells.entry(index).and_modify(|cells| *cells = cells.max(strained));
        }
        cells.into_iter().filter(|&(_, cells)| cells >= STRETCHING_CELLS).collect()
    }

    /// Objects that morph targets take half a cell or more away from where they rest: index and the largest distance of a
    /// vertex in cells, at the size that is baked.
    pub(super) fn morphs(&self, objects: &[Object], span: f64, clip: Option<usize>) -> Vec<(usize, f64)> {
        let morphing = (0..).zip(objects).filter(|(_, object)| self.meshes[object.mesh].is_morphing());
        let mut farthest: Vec<(usize, &Object, f64)> = morphing.map(|(index, object)| (index, object, 0.0)).collect();
        if farthest.is_empty() {
            return Vec::new();
        }
        self.for_each_sample(clip, |pose| {
            for (_, object, farthest) in &mut farthest {
                *farthest = farthest.max(self.largest_displacement(object, pose));
            }
        });
        let cells = farthest.into_iter().map(|(index, _, farthest)| (index, farthest / span));
        cells.filter(|&(_, cells)| cells >= STRETCHING_CELLS).collect()
    }

    fn largest_displacement(&self, object: &Object, pose: &Pose) -> f64 {
        let primitives = self.meshes[object.mesh].primitives.iter();
        let distances = primitives.flat_map(|primitive| {
            let moved = primitive.positions_at(pose.weights(object.mesh)).into_owned();
            let steps = moved.into_iter().zip(&primitive.positions);
            steps.map(|(moved, resting)| (object.stretch * (moved.as_dvec3() - resting.as_dvec3())).length())
        });
        distances.fold(0.0, f64::max)
    }

    /// How far blended joints take the voxels of skins off: index and cells.
    fn strains(&self, objects: &[Object], span: f64, clip: Option<usize>) -> impl Iterator<Item = (usize, f64)> {
        let mut strains = Strains::new(self, objects, span);
        if !strains.is_empty() {
            let moments = affordable_moments(self, objects).clamp(LEAST_STRETCH_SAMPLES, MAX_STRETCH_SAMPLES);
            self.for_each_of(moments, clip, |pose| strains.look_at(self, pose));
        }
        strains.found()
    }

    /// By object; `None` where no moment has a regular matrix.
    pub(super) fn mean_stretches(&self, objects: &[Object], clip: Option<usize>) -> Vec<Option<DMat3>> {
        let mut nodes = vec![Mean::EMPTY; objects.len()];
        let mut skins: Vec<(Mean, Vec<f64>)> =
            (0..self.skins.len()).map(|skin| (Mean::EMPTY, self.joint_uses(skin, objects))).collect();
        let rest = self.pose(None, 0.0);
        for (mean, object) in nodes.iter_mut().zip(objects).filter(|(_, object)| object.motion == Motion::Static) {
            mean.add(&rest.world_from_node[object.node], 1.0);
        }
        self.for_each_sample(clip, |pose| {
            for (mean, object) in nodes.iter_mut().zip(objects).filter(|(_, object)| object.motion == Motion::Rigid) {
                mean.add(&pose.world_from_node[object.node], 1.0);
            }
            for (skin, (mean, uses)) in skins.iter_mut().enumerate() {
                for (matrix, &weight) in self.joint_matrices(skin, pose).iter().zip(&*uses).filter(|&(_, &w)| w > 0.0) {
                    mean.add(matrix, weight);
                }
            }
        });
        let means = objects.iter().zip(&nodes).map(|(object, node)| match object.motion {
            Motion::Skinned { skin } => skins[skin].0.get(),
            Motion::Static | Motion::Rigid => node.get(),
        });
        means.collect()
    }

    /// By joint, the weight it has over all vertices of all parts of a skin.
    fn joint_uses(&self, skin: usize, objects: &[Object]) -> Vec<f64> {
        let mut uses = vec![0.0; self.skins[skin].joints.len()];
        let parts = objects.iter().filter(|object| object.motion == Motion::Skinned { skin });
        for primitive in parts.flat_map(|object| &self.meshes[object.mesh].primitives) {
            for (joints, weights) in primitive.joints.iter().zip(&primitive.weights) {
                for (&joint, &weight) in joints.iter().zip(weights).filter(|&(_, &weight)| weight > 0.0) {
                    uses[joint as usize] += f64::from(weight);
                }
            }
        }
        uses
    }

    /// Gives rigid objects that stray from their mean stretch the largest.
    pub(super) fn enlarge(&self, objects: &mut [Object], straying: &[(usize, f64)], clip: Option<usize>) {
        let rigid =
            straying.iter().map(|&(object, _)| object).filter(|&object| objects[object].motion == Motion::Rigid);
        let mut largest: Vec<(usize, Largest)> =
            rigid.map(|object| (object, Largest::beside(objects[object].stretch))).collect();
        if largest.is_empty() {
            return;
        }
        self.for_each_sample(clip, |pose| {
            for (object, largest) in &mut largest {
                largest.add(&pose.world_from_node[objects[*object].node]);
            }
        });
        for (object, largest) in largest {
            objects[object].stretch = largest.get();
        }
    }

    /// The rest pose without a clip; else a clip at its keys and half-way between.
    fn for_each_sample(&self, clip: Option<usize>, look: impl FnMut(&Pose)) {
        self.for_each_of(MAX_STRETCH_SAMPLES, clip, look);
    }

    /// The same at fewer moments.
    fn for_each_of(&self, moments: usize, clip: Option<usize>, mut look: impl FnMut(&Pose)) {
        match clip.and_then(|clip| Some((clip, self.clips.get(clip)?))) {
            None => look(&self.pose(None, 0.0)),
            Some((index, clip)) => {
                let times = clip.sample_times(moments);
                let moments = if times.is_empty() { vec![0.0] } else { times };
                moments.into_iter().for_each(|time_secs| look(&self.pose(Some(index), time_secs)));
            }
        }
    }
}

/// The weighted mean of the stretches of matrices; singular ones do not count.
#[derive(Clone)]
struct Mean {
    sum: DMat3,
    weight: f64,
}

impl Mean {
    const EMPTY: Self = Self { sum: DMat3::ZERO, weight: 0.0 };

    fn add(&mut self, world_from_mesh: &DMat4, weight: f64) {
        if let Some(polar) = right_polar_or_flat(DMat3::from_mat4(*world_from_mesh)) {
            self.sum += polar.stretch * weight;
            self.weight += weight;
        }
    }

    fn get(&self) -> Option<DMat3> {
        (self.weight > 0.0).then(|| without_last_bits(self.sum * (1.0 / self.weight)))
    }
}

/// A stretch that no other of an object exceeds along any direction.
struct Largest {
    mean: DMat3,
    inverse_mean: DMat3,
    /// Of the lengths along the axes, where all stretches have those alone.
    axes: Option<DVec3>,
    /// What any other is at most, in sizes of the mean.
    factor: f64,
}

impl Largest {
    fn beside(mean: DMat3) -> Self {
        Self { mean, inverse_mean: unflattened(mean).inverse(), axes: Some(DVec3::ZERO), factor: 1.0 }
    }

    fn add(&mut self, world_from_mesh: &DMat4) {
        let Some(polar) = right_polar_or_flat(DMat3::from_mat4(*world_from_mesh)) else { return };
        let diagonal = polar.stretch.diagonal();
        let is_along_axes = polar.stretch == DMat3::from_diagonal(diagonal);
        self.axes = self.axes.filter(|_| is_along_axes).map(|axes| axes.max(diagonal));
        self.factor = self.factor.max(largest_stretch(&(polar.stretch * self.inverse_mean)));
    }

    fn get(&self) -> DMat3 {
        without_last_bits(self.axes.map_or(self.mean * self.factor, DMat3::from_diagonal))
    }
}

/// By how much a matrix lengthens what it lengthens most: the root of the largest eigenvalue of MᵀM, by iteration.
fn largest_stretch(matrix: &DMat3) -> f64 {
    const STEPS: usize = 32;
    let square = matrix.transpose() * *matrix;
    let columns = [square.x_axis, square.y_axis, square.z_axis];
    let longest = columns.into_iter().fold(DVec3::ZERO, |a, b| if b.length() > a.length() { b } else { a });
    let direction = (0..STEPS).fold(longest, |direction, _| (square * direction).normalize_or_zero());
    (*matrix * direction).length()
}

/// Rounds what an f32 file cannot mean: shear, and differences between axes or from 1, in the last
/// bits. The matrix that moves the object divides by the same U, so this costs nothing; it lets
/// a rotation be exactly the identity here.
fn without_last_bits(stretch: DMat3) -> DMat3 {
    let diagonal = stretch.diagonal();
    let tolerance = LAST_BITS * diagonal.max_element();
    if (stretch - DMat3::from_diagonal(diagonal)).to_cols_array().iter().any(|shear| shear.abs() > tolerance) {
        return stretch;
    }
    if (diagonal - DVec3::ONE).abs().max_element() <= LAST_BITS {
        return DMat3::IDENTITY;
    }
    let mean = diagonal.element_sum() / 3.0;
    let uniform = (diagonal - DVec3::splat(mean)).abs().max_element() <= tolerance;
    DMat3::from_diagonal(if uniform { DVec3::splat(mean) } else { diagonal })
}

/// Finds how far one object strays from its mean stretch.
struct Probe<'a> {
    object: &'a Object,
    mesh: &'a Mesh,
    /// Of what each joint moves; a single one for a rigid object.
    boxes: Vec<Option<Aabb>>,
    /// The largest distance found, scene units. Smaller ones are not worth looking at.
    largest: f64,
    threshold: f64,
}

impl<'a> Probe<'a> {
    fn new(scene: &'a Scene, object: &'a Object, threshold: f64) -> Self {
        let mesh = &scene.meshes[object.mesh];
        let boxes = match object.motion {
            Motion::Skinned { skin } => joint_boxes(mesh, scene.skins[skin].joints.len()),
            Motion::Static | Motion::Rigid => vec![scene.mesh_box(object.mesh)],
        };
        Self { object, mesh, boxes, largest: 0.0, threshold }
    }

    fn look_at(&mut self, scene: &Scene, pose: &Pose) {
        let matrices = match self.object.motion {
            Motion::Skinned { skin } => scene.joint_matrices(skin, pose),
            Motion::Static | Motion::Rigid => vec![pose.world_from_node[self.object.node]],
        };
        let strays: Vec<Stray> = matrices.iter().zip(&self.boxes).map(|(matrix, b)| self.stray(matrix, b)).collect();
        let bound = strays.iter().fold(0.0, |largest: f64, stray| largest.max(stray.bound));
        if bound >= self.threshold.max(self.largest) {
            self.largest = self.largest.max(self.largest_distance(&strays));
        }
    }

    fn stray(&self, matrix: &DMat4, bounds: &Option<Aabb>) -> Stray {
        let (Some(bounds), Some(polar)) = (bounds, right_polar_or_flat(DMat3::from_mat4(*matrix))) else {
            return Stray { difference: DMat3::ZERO, center: DVec3::ZERO, bound: 0.0 };
        };
        let (difference, center) = (polar.stretch - self.object.stretch, bounds.center());
        let distances = bounds.corners().map(|corner| (difference * (corner - center)).length());
        Stray { difference, center, bound: distances.into_iter().fold(0.0, f64::max) }
    }

    fn largest_distance(&self, strays: &[Stray]) -> f64 {
        let primitives = self.mesh.primitives.iter();
        let distances = primitives.flat_map(|primitive| {
            primitive.positions.iter().enumerate().map(|(vertex, position)| {
                let point = position.as_dvec3();
                match (self.object.motion, primitive.joints.get(vertex)) {
                    (Motion::Skinned { .. }, Some(joints)) => {
                        let influences =
                            joints.iter().zip(primitive.weights[vertex]).filter(|&(_, weight)| weight > 0.0);
                        influences.map(|(&joint, w)| f64::from(w) * strays[joint as usize].distance(point)).sum()
                    }
                    _ => strays[0].distance(point),
                }
            })
        });
        distances.fold(0.0, f64::max)
    }
}

/// How one matrix's stretch differs from the mean, about the centre of what it moves.
struct Stray {
    difference: DMat3,
    center: DVec3,
    /// No vertex is farther off than this, scene units.
    bound: f64,
}

impl Stray {
    fn distance(&self, point: DVec3) -> f64 {
        (self.difference * (point - self.center)).length()
    }
}
