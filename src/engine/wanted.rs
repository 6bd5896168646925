//! What is asked for, what is there, and what differs.

use std::sync::Arc;

use super::cones::TracedBy;
use super::light::LitBy;
use super::shadows::ShadowedBy;
use super::surfaces::SeenBy;
use super::{Engine, EngineError, other_filter, scene_on_gpu};
use crate::data::octree::PointerLayout;
use crate::lights::{self, PosedLight, posed_lights};
use crate::plan::{self, Changes, ConesAsked, SceneFacts};
use crate::prepare::{ExactVoxels, FrameMatrices, Prepared};
use crate::scene::{OrbitCamera, Pose};
use crate::settings::{ColorBy, Filter, Hidden, Look, Settings, View};
use crate::stages::fill::number_objects::OBJECT_MASK;

/// One request, with its pose folded.
#[derive(Clone, Debug)]
pub(super) struct Wanted {
    pub settings: Settings,
    pub size_px: [u32; 2],
    pub camera: OrbitCamera,
    pub placed: Placed,
    pub lights: Vec<PosedLight>,
    pub frame: FrameMatrices,
    pub facts: SceneFacts,
}

/// Where every triangle is, and which are not shown.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    pub pose: Arc<Pose>,
    pub hidden: Hidden,
}

impl Placed {
    /// By bits: a matrix that is not finite is equal to itself.
    pub fn is(&self, other: &Self) -> bool {
        let bits = |pose: &Pose, node: usize| pose.world_from_node[node].to_cols_array().map(f64::to_bits);
        let (a, b) = (&*self.pose, &*other.pose);
        let nodes = a.world_from_node.len();
        self.hidden == other.hidden
            && (Arc::ptr_eq(&self.pose, &other.pose)
                || nodes == b.world_from_node.len() && (0..nodes).all(|node| bits(a, node) == bits(b, node)))
    }
}

impl Wanted {
    /// The octree's light is read for more than its opacity.
    pub fn reads_radiance(&self) -> bool {
        !plan::only_opacity(&self.facts, &self.settings)
    }

    /// Radiance from all directions, as kernels take it.
    pub fn sky_nits(&self) -> [f32; 3] {
        self.settings.lighting.sky_nits.map(|channel| channel as f32)
    }

    pub fn shows_surfaces(&self) -> bool {
        self.settings.look.view == View::Surfaces && !self.shows_nothing()
    }

    pub fn cones_asked(&self) -> ConesAsked {
        ConesAsked::new(&self.facts, &self.settings)
    }

    /// The light whose shadow map is wanted does not shine: the last one's is shown.
    pub fn missing_map(&self) -> Option<String> {
        let (number, last) = (self.settings.look.shadow_map, self.lights.len().checked_sub(1)?);
        (self.settings.look.view == View::ShadowMap && number > last)
            .then(|| format!("there is no shadow map {number}: they are 0 to {last}, and {last} is shown"))
    }

    /// Nothing of the scene is in the picture: all of it is hidden, or outside the grid.
    pub fn shows_nothing(&self) -> bool {
        match self.settings.look.view {
            View::Mesh | View::Surfaces => self.facts.triangles == 0,
            View::ShadowMap => self.facts.triangles == 0 || self.facts.lights == 0,
            View::Voxels | View::Ghost | View::Slice => self.facts.voxels() == 0,
        }
    }
}

/// What the results on the GPU were made from; `None` where there is none, or it is out of date.
#[derive(Clone, Debug, Default)]
pub(super) struct Done {
    /// World voxels follow the matrices that `scene` holds.
    pub moved: bool,
    pub octree: Option<(Filter, u32)>,
    pub object_numbers: bool,
    pub other: Option<(Filter, u32)>,
    pub compared: Option<Arc<ExactVoxels>>,
    pub view: Option<(Look, [u32; 2])>,
    /// What the mesh view last drew.
    pub mesh: Option<Placed>,
    pub exact_masks: Option<Arc<ExactVoxels>>,
    pub links: Vec<PointerLayout>,
    pub emission: bool,
    pub shadows: Option<ShadowedBy>,
    pub light: Option<LitBy>,
    pub irradiance: bool,
    pub surfaces: Option<SeenBy>,
    /// Lights of the surface image's direct light.
    pub direct: Option<LitBy>,
    pub diffuse: Option<TracedBy>,
    pub specular: Option<TracedBy>,
}

impl Engine {
    /// What is wanted now. Cheap: the frame begins with the next [`Self::advance`].
    pub fn request(&mut self, settings: &Settings, size_px: [u32; 2]) -> Result<(), EngineError> {
        let prepared = self.prepared.as_ref().ok_or(EngineError::NoScene)?;
        check_object_numbers(prepared, &settings.look)?;
        let hidden = prepared.hidden(&settings.visibility)?;
        let pose = prepared.pose(&settings.motion)?;
        let frame = prepared.fold((&settings.motion, &pose), settings.discretization.anchor, &hidden);
        let shown = settings.visibility.shown_nodes(&prepared.scene)?;
        let emits = lights::emits(prepared, &settings.lighting);
        let lights = posed_lights(&prepared.scene, &pose, &settings.lighting, &shown, emits);
        let glossy_roughness = settings.cone_tracing.glossy_roughness;
        let facts = scene_on_gpu::facts(prepared, &frame, &hidden, glossy_roughness);
        // A picture has at least one pixel.
        let size_px = size_px.map(|size| size.max(1));
        let facts = SceneFacts { lights: lights.len() as u32, picture_px: size_px, ..facts };
        let placed = Placed { pose: Arc::new(pose), hidden };
        let camera = prepared.camera(settings, &placed.pose, size_px);
        self.wanted = Some(Wanted { settings: settings.clone(), size_px, camera, placed, lights, frame, facts });
        if self.running.is_none() {
            self.make_plan();
        }
        Ok(())
    }

    pub(super) fn changes(&self, wanted: &Wanted) -> Changes {
        let discretization = &wanted.settings.discretization;
        let key = (discretization.filter, discretization.dense_level());
        let other = (other_filter(discretization.filter), discretization.dense_level());
        let of_frame = self.scene.as_ref().map(|scene| scene.changes(&wanted.frame)).unwrap_or_default();
        let fresh = |done: &Option<Arc<ExactVoxels>>| match (&self.exact, done) {
            (Some(exact), Some(done)) => !Arc::ptr_eq(exact, done),
            (exact, done) => exact.is_some() != done.is_some(),
        };
        let drawn = self.done.mesh.as_ref();
        let mesh_moved =
            wanted.settings.look.view == View::Mesh && drawn.is_none_or(|placed| !placed.is(&wanted.placed));
        Changes {
            caches: self.scene.is_none(),
            residents: of_frame.residents,
            rigid_poses: of_frame.rigid_poses || !self.done.moved,
            skinned_poses: of_frame.skinned_poses || !self.done.moved,
            octree: self.done.octree != Some(key),
            other_octree: self.done.other != Some(other),
            exact: fresh(&self.done.compared),
            exact_masks: fresh(&self.done.exact_masks),
            exact_known: self.exact.is_some(),
            view: self.done.view != Some((wanted.settings.look, wanted.size_px)) || mesh_moved,
            object_numbers: !self.done.object_numbers,
            links: self.links_missing(wanted),
            emission: !self.done.emission,
            shadow_maps: self.shadows_changed(wanted),
            lighting: !self.done.light.as_ref().is_some_and(|done| done.serves(wanted)),
            irradiance: !self.done.irradiance,
            surfaces: !self.done.surfaces.as_ref().is_some_and(|done| done.is(wanted)),
            direct: !self.done.direct.as_ref().is_some_and(|done| done.is_of(wanted)),
            diffuse: self.done.diffuse != Some(TracedBy::diffuse(wanted)),
            specular: self.done.specular != Some(TracedBy::specular(wanted)),
        }
    }
}

/// A leaf stores its object in 16 bits, of which the largest number stands for none.
fn check_object_numbers(prepared: &Prepared, look: &Look) -> Result<(), EngineError> {
    let objects = prepared.objects.len();
    if look.view == View::Voxels && look.color == ColorBy::Object && objects > OBJECT_MASK as usize {
        return Err(EngineError::TooManyObjects { scene: prepared.scene.name.clone(), objects });
    }
    Ok(())
}
