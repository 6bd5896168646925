//! Axis-aligned boxes: of a pose exactly, and over all clips conservatively.
//!
//! Bounds follow the pose, never the bind pose. Over time, a rigid object counts with its
//! transformed box, a skinned one with the transformed boxes of what each joint moves: a skinned
//! vertex is a weighted mean of its joints' images, so it never leaves them.

use glam::{DMat4, DVec3};

use super::{Mesh, Motion, Object, Pose, Scene};

/// A box in scene units; `min` is nowhere above `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    pub min: DVec3,
    pub max: DVec3,
}

impl Aabb {
    /// `None` for no points.
    pub fn from_points(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        points.into_iter().fold(None, |bounds: Option<Self>, point| {
            let point = Self { min: point, max: point };
            Some(bounds.map_or(point, |bounds| bounds.union(&point)))
        })
    }

    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    pub fn center(&self) -> DVec3 {
        self.min.midpoint(self.max)
    }

    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }

    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|corner| {
            DVec3::from_array(std::array::from_fn(|axis| {
                if corner >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] }
            }))
        })
    }

    /// The box of the transformed box.
    pub fn transformed(&self, matrix: &DMat4) -> Self {
        let [first, rest @ ..] = self.corners().map(|corner| matrix.transform_point3(corner));
        let first = Self { min: first, max: first };
        rest.iter().fold(first, |bounds, &corner| bounds.union(&Self { min: corner, max: corner }))
    }

    fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }
}

/// Of what is there.
pub fn union(a: Option<Aabb>, b: Option<Aabb>) -> Option<Aabb> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(&b)),
        (a, b) => a.or(b),
    }
}

/// By object; `None` where there is nothing to see of it.
pub struct ClipBoxes {
    /// When the clip begins, exactly.
    pub at_first: Vec<Option<Aabb>>,
    /// Over all of it.
    pub over: Vec<Option<Aabb>>,
}

/// Poses a clip is looked at, at most, for bounds over time.
const MAX_BOUNDS_SAMPLES: usize = 257;

impl Scene {
    /// The box of every vertex in a pose, exactly. `None` where there is nothing to see; objects
    /// whose matrices are not finite do not count.
    pub fn bounds_at(&self, pose: &Pose) -> Option<Aabb> {
        let seen = self.mesh_nodes().filter(|object| self.is_seen(object, pose));
        seen.fold(None, |bounds, object| union(bounds, self.object_bounds(&object, pose)))
    }

    /// A box that holds the scene at rest and over all its clips: at every key and half-way between
    /// keys, or at 257 of these moments, evenly picked, where a clip has more.
    pub fn bounds_over_time(&self) -> Option<Aabb> {
        let rest = self.pose(None, 0.0);
        let objects: Vec<Object> = self.mesh_nodes().collect();
        let at_rest = objects.iter().fold(None, |bounds, object| union(bounds, self.object_bounds(object, &rest)));
        (0..self.clips.len()).fold(at_rest, |bounds, clip| {
            self.boxes_over_clip(&objects, Some(clip)).over.into_iter().fold(bounds, union)
        })
    }

    /// The boxes over a clip, or at rest without one.
    pub fn boxes_over_clip(&self, objects: &[Object], clip: Option<usize>) -> ClipBoxes {
        let Some((index, clip)) = clip.and_then(|clip| Some((clip, self.clips.get(clip)?))) else {
            let at_rest = self.boxes_at(objects, &self.pose(None, 0.0));
            return ClipBoxes { at_first: at_rest.clone(), over: at_rest };
        };
        let times = clip.sample_times(MAX_BOUNDS_SAMPLES);
        let first = self.pose(Some(index), times.first().copied().unwrap_or(0.0));
        let moving = self.moving_nodes();
        let at_first = self.boxes_at(objects, &first);
        let mut over = at_first.clone();
        let movers: Vec<(usize, Mover)> = (0..)
            .zip(objects)
            .filter_map(|(number, object)| Some((number, self.mover_box(object, &moving)?)))
            .collect();
        for pose in times.iter().skip(1).map(|&time_secs| self.pose(Some(index), time_secs)) {
            for (number, mover) in &movers {
                if self.is_seen(&objects[*number], &pose) {
                    over[*number] = union(over[*number], self.mover_bounds(mover, &pose));
                }
            }
        }
        ClipBoxes { at_first, over }
    }

    /// By object the box in a pose, exactly; `None` where there is nothing to see of it.
    pub fn boxes_at(&self, objects: &[Object], pose: &Pose) -> Vec<Option<Aabb>> {
        let bounds = |object: &Object| self.object_bounds(object, pose).filter(|_| self.is_seen(object, pose));
        objects.iter().map(bounds).collect()
    }

    /// Whether a pose leaves anything to see of an object. The node that carries a skinned one only hides it.
    pub fn is_seen(&self, object: &Object, pose: &Pose) -> bool {
        match object.motion {
            Motion::Skinned { .. } => pose.is_visible[object.node],
            Motion::Static | Motion::Rigid => pose.shows(object.node),
        }
    }

    fn mover_box(&self, object: &Object, moving: &[bool]) -> Option<Mover> {
        match object.motion {
            _ if self.meshes[object.mesh].is_morphing() => Some(Mover::Morphing(object.clone())),
            Motion::Rigid => Some(Mover::Rigid(object.node, self.mesh_box(object.mesh))),
            Motion::Skinned { skin } if self.skins[skin].joints.iter().any(|&joint| moving[joint]) => {
                let joints = self.skins[skin].joints.len();
                Some(Mover::Skinned(skin, joint_boxes(&self.meshes[object.mesh], joints)))
            }
            Motion::Static | Motion::Skinned { .. } => None,
        }
    }

    fn mover_bounds(&self, mover: &Mover, pose: &Pose) -> Option<Aabb> {
        let finite = |bounds: Aabb| Some(bounds).filter(Aabb::is_finite);
        match mover {
            Mover::Rigid(node, bounds) => bounds.and_then(|b| finite(b.transformed(&pose.world_from_node[*node]))),
            Mover::Skinned(skin, boxes) => {
                let matrices = self.joint_matrices(*skin, pose);
                let joints = boxes.iter().zip(&matrices);
                joints.fold(None, |all, (bounds, matrix)| {
                    union(all, bounds.and_then(|bounds| finite(bounds.transformed(matrix))))
                })
            }
            Mover::Morphing(object) => self.object_bounds(object, pose),
        }
    }

    fn object_bounds(&self, object: &Object, pose: &Pose) -> Option<Aabb> {
        let primitives = 0..self.meshes[object.mesh].primitives.len();
        let bounds = primitives.fold(None, |bounds, primitive| {
            union(bounds, Aabb::from_points(self.posed_positions(object, primitive, pose)))
        });
        bounds.filter(Aabb::is_finite)
    }

    /// Of a mesh in its own space.
    pub fn mesh_box(&self, mesh: usize) -> Option<Aabb> {
        let primitives = &self.meshes[mesh].primitives;
        Aabb::from_points(primitives.iter().flat_map(|p| &p.positions).map(|position| position.as_dvec3()))
    }
}

/// What moves, with what it moves in its own space.
enum Mover {
    Rigid(usize, Option<Aabb>),
    Skinned(usize, Vec<Option<Aabb>>),
    /// Looked at vertex by vertex.
    Morphing(Object),
}

/// For each joint the box, in mesh space, of the vertices it has a weight on.
pub(super) fn joint_boxes(mesh: &Mesh, joint_count: usize) -> Vec<Option<Aabb>> {
    let mut boxes = vec![None; joint_count];
    for primitive in &mesh.primitives {
        for ((position, joints), weights) in primitive.positions.iter().zip(&primitive.joints).zip(&primitive.weights) {
            let point = position.as_dvec3();
            for (&joint, _) in joints.iter().zip(weights).filter(|&(_, &weight)| weight > 0.0) {
                let place = &mut boxes[joint as usize];
                *place = union(*place, Some(Aabb { min: point, max: point }));
            }
        }
    }
    boxes
}
