//! One request: what is looked at (the shot), and by which methods. A frame holds its request; nothing changes
//! under it, and the exact voxels in it are of its pose and no other.

use std::sync::Arc;

use glam::DVec3;

use super::EngineError;
use super::facts::facts;
use super::misfits::misfits;
use super::shadow_layouts::ShadowLayouts;
use crate::data::grid::Grid;
use crate::digest::Digest;
use crate::lights::{self, PosedLight, posed_lights};
use crate::plan::{Asked, Contents, SceneFacts, WantedFor};
use crate::prepare::{ExactVoxels, FrameMatrices, LeftToEach, Prepared};
use crate::scene::{OrbitCamera, Pose};
use crate::settings::lighting::Lighting;
use crate::settings::{ColorBy, Discretizer, Hidden, Look, Settings, View};
use crate::stages::fill::number_objects::OBJECT_MASK;
use crate::stages::light::illuminate::LightParams;
use crate::stages::light::shadow::ShadowParams;

#[derive(Clone, Debug)]
pub struct Request {
    pub prepared: Arc<Prepared>,
    pub shot: Shot,
    /// The first is shown.
    pub methods: Vec<Method>,
}

/// What is looked at.
#[derive(Clone, Debug)]
pub struct Shot {
    pub pose: Arc<Pose>,
    pub hidden: Hidden,
    /// Stands for both.
    pub placed: Digest,
    pub camera: OrbitCamera,
    pub size_px: [u32; 2],
    /// Of this pose; `None` while they are not made.
    pub exact: Option<Arc<ExactVoxels>>,
    /// Which nodes are not hidden.
    shown: Vec<bool>,
}

/// How it is computed.
#[derive(Clone, Debug)]
pub struct Method {
    pub asked: Asked,
    pub lights: Vec<PosedLight>,
    pub shadow_maps: ShadowLayouts,
    /// Of what is moved.
    pub matrices: FrameMatrices,
    /// What is voxelized every frame, and what is moved.
    pub left_to_each: LeftToEach,
    /// Objects left out of this pose: a matrix of theirs is not finite.
    left_out: Vec<usize>,
}

impl Method {
    pub fn settings(&self) -> &Settings {
        &self.asked.settings
    }

    /// Radiance from all directions, as kernels take it.
    pub fn sky_nits(&self) -> [f32; 3] {
        self.settings().method.lighting.sky_nits.map(|channel| channel as f32)
    }
}

impl Request {
    /// The settings' own method, and the other filter's where both are measured. `exacts`: voxels that are known, of
    /// whatever poses.
    pub fn new(
        prepared: &Arc<Prepared>,
        (settings, size_px): (&Settings, [u32; 2]),
        exacts: &[Arc<ExactVoxels>],
    ) -> Result<Self, EngineError> {
        check_object_numbers(prepared, &settings.method.look)?;
        let shot = Shot::new(prepared, settings, size_px, exacts)?;
        let mut methods = vec![Method::new(prepared, &shot, settings, WantedFor::Picture)?];
        if settings.method.look.accuracy {
            let mut other = settings.clone();
            other.method.discretization.filter = settings.method.discretization.filter.other();
            methods.push(Method::new(prepared, &shot, &other, WantedFor::Comparison)?);
        }
        Ok(Self { prepared: Arc::clone(prepared), shot, methods })
    }

    /// The method that is shown.
    pub fn shown(&self) -> &Method {
        &self.methods[0]
    }

    pub fn settings(&self) -> &Settings {
        self.shown().settings()
    }

    pub fn grid(&self) -> &Grid {
        &self.prepared.grid
    }

    pub fn asked(&self) -> Vec<Asked> {
        self.methods.iter().map(|method| method.asked.clone()).collect()
    }

    /// Nothing of the scene is in the picture: all of it is hidden, or outside the grid.
    pub fn shows_nothing(&self) -> bool {
        let scene = &self.shown().asked.scene;
        match self.settings().method.look.view {
            View::Mesh | View::Surfaces => scene.triangles == 0,
            View::ShadowMap => scene.triangles == 0 || scene.lights == 0,
            View::Voxels | View::Ghost | View::Slice => scene.voxels() == 0,
        }
    }

    /// Something is shown, and none of it is in the grid: a sentence.
    fn all_outside(&self) -> Option<String> {
        let (scene, grid) = (&self.shown().asked.scene, self.grid());
        let is_shown = (0..self.prepared.objects.len()).any(|object| !self.shot.hidden.contains(object));
        (is_shown && scene.voxels() == 0).then(|| {
            let (from, to) = (grid.corner(), grid.corner() + DVec3::splat(f64::from(grid.cells()) * grid.span));
            format!("nothing that is shown is in the grid, which reaches from {from:.3} to {to:.3}: fit it to another thing, or choose a larger span")
        })
    }

    /// Objects whose voxels are moved although they stretch, a sentence each.
    fn torn(&self) -> impl Iterator<Item = String> {
        let not_moved = &self.shown().left_to_each.not_moved;
        let moved = self.prepared.objects.iter().enumerate().filter(|(index, _)| !not_moved.contains(*index));
        moved.filter_map(|(_, object)| {
            let (name, why) = (&object.object.name, object.unmovable?);
            Some(format!("object \"{name}\" {why}: its moved voxels leave its surface, voxelized ones would not"))
        })
    }

    /// Objects that are voxelized every frame where others are moved: their numbers.
    pub fn voxelized(&self) -> impl Iterator<Item = usize> {
        let method = self.shown();
        let is_mixed = method.settings().method.discretization.discretizer == Discretizer::Transform;
        let objects = (0..self.prepared.objects.len()).filter(move |_| is_mixed);
        objects.filter(|object| !method.left_to_each.not_voxelized.contains(*object))
    }

    /// From the eye to the farthest corner of the grid, scene units.
    pub fn depth_range(&self) -> [f64; 2] {
        let grid = self.grid();
        let extent = f64::from(grid.cells()) * grid.span;
        let corners = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|far| f64::from(far) * extent));
        let distances =
            corners.map(|corner| (grid.corner() + DVec3::from_array(corner)).distance(self.shot.camera.eye));
        [0.0, distances.fold(0.0, f64::max)]
    }

    /// Objects that the pose cannot show, lights that are nowhere in it, and settings that do not fit the scene or the
    /// grid, a sentence each.
    pub fn left_out(&self) -> Vec<String> {
        let (prepared, method) = (&self.prepared, self.shown());
        let name = |&object: &usize| &prepared.objects[object].object.name;
        let objects = method.left_out.iter().map(name);
        let objects =
            objects.map(|name| format!("object \"{name}\" is left out: in this pose its matrix is not finite"));
        let lighting = &self.settings().method.lighting;
        let lost = lights::left_out(&prepared.scene, &self.shot.pose, lighting, &self.shot.shown);
        objects
            .chain(self.torn())
            .chain(self.all_outside())
            .chain(lost)
            .chain(misfits(prepared, &method.asked, &method.shadow_maps))
            .collect()
    }
}

impl Shot {
    /// Stands for what is seen, and from where.
    pub fn seen(&self) -> Digest {
        Digest::of_bytes(&[self.placed.bytes(), Digest::of(&(self.camera, self.size_px)).bytes()])
    }

    /// How far from the eye what is shown may be, along the line of sight; scene units.
    pub fn farthest(&self, prepared: &Prepared) -> f64 {
        // A perspective camera sees without end.
        if self.camera.orthographic_height.is_none() {
            return f64::INFINITY;
        }
        let forward = -self.camera.world_from_camera().z_axis.truncate();
        let corners = prepared.bounds_at(&self.pose, &self.hidden).map(|bounds| bounds.corners());
        let depths = corners.into_iter().flatten().map(|corner| (corner - self.camera.eye).dot(forward));
        depths.fold(0.0, f64::max)
    }

    fn new(
        prepared: &Prepared,
        settings: &Settings,
        size_px: [u32; 2],
        exacts: &[Arc<ExactVoxels>],
    ) -> Result<Self, EngineError> {
        let pose = Arc::new(prepared.pose(&settings.shot.motion)?);
        let hidden = prepared.hidden(&settings.shot.visibility, &pose)?;
        let shown = prepared.shown_nodes(&settings.shot.visibility, &pose)?;
        let placed = prepared.placed(&pose, &hidden);
        // A picture has at least one pixel.
        let size_px = size_px.map(|side| side.max(1));
        let camera = prepared.camera(settings, &pose, size_px);
        let exact = exacts.iter().find(|exact| exact.placed == placed).cloned();
        Ok(Self { pose, hidden, placed, camera, size_px, exact, shown })
    }
}

impl Method {
    fn new(prepared: &Prepared, shot: &Shot, settings: &Settings, wanted_for: WantedFor) -> Result<Self, EngineError> {
        let (lighting, discretization) = (&settings.method.lighting, &settings.method.discretization);
        let left_to_each = prepared.left_to_each(discretization, &shot.hidden);
        let fold =
            |left_out: &Hidden| prepared.fold((&settings.shot.motion, &shot.pose), discretization.anchor, left_out);
        let [matrices, of_voxelized] = [&left_to_each.not_moved, &left_to_each.not_voxelized].map(fold);
        let emits = prepared.emits(lighting);
        let lights = posed_lights(&prepared.scene, &shot.pose, lighting, &shot.shown, emits);
        let shadow_maps = ShadowLayouts::new(prepared, &lights, settings);
        let residents = [&matrices, &of_voxelized].map(|frame| &*frame.resident);
        let facts = facts(prepared, residents, &shot.hidden, settings.method.cone_tracing.glossy_roughness);
        let scene = SceneFacts { lights: lights.len() as u32, picture_px: shot.size_px, ..facts };
        let lights_and_maps = (&*light_params(prepared, &lights, lighting), &*shadow_maps.maps);
        let contents = contents(prepared, shot, (&matrices, &left_to_each), lights_and_maps);
        let asked = Asked { scene, settings: settings.clone(), contents, wanted_for };
        let left_out = [&*matrices.left_out, &of_voxelized.left_out].concat();
        Ok(Self { asked, lights, shadow_maps, matrices, left_to_each, left_out })
    }
}

/// Every light as kernels read it.
pub fn light_params(prepared: &Prepared, lights: &[PosedLight], lighting: &Lighting) -> Vec<LightParams> {
    lights.iter().map(|light| LightParams::new(light, &prepared.grid, lighting.offset_voxels())).collect()
}

fn contents(
    prepared: &Prepared,
    shot: &Shot,
    (frame, left_to_each): (&FrameMatrices, &LeftToEach),
    (lights, shadow_maps): (&[LightParams], &[ShadowParams]),
) -> Contents {
    let resident: Vec<u8> = frame.resident.iter().map(|resident| u8::from(*resident)).collect();
    let (rigid, skinned) = frame.matrices.split_at(prepared.rigid_parts().min(frame.matrices.len()));
    let bytes = |matrices| Digest::of_bytes(&[bytemuck::cast_slice(matrices)]);
    Contents {
        // One preparation at a time: what is made of another is dropped with it.
        caches: Digest::default(),
        residents: Digest::of_bytes(&[&resident]),
        rigid: bytes(rigid),
        skinned: bytes(skinned),
        placed: shot.placed,
        voxelized: prepared.placed(&shot.pose, &left_to_each.not_voxelized),
        lights: Digest::of_bytes(&[bytemuck::cast_slice(lights)]),
        shadow_maps: Digest::of_bytes(&[bytemuck::cast_slice(shadow_maps)]),
        camera: Digest::of(&shot.camera),
        exact: shot.exact.as_ref().map(|exact| exact.placed),
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
