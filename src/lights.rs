//! The lights of a pose: those of the scene as the settings want them, our own sun, and what was added.
//!
//! In: a scene, its pose, the settings. Out: every light there is, with whether it shines and why not; and
//! of those that shine their place in world space, in the order in which the shadow map view and the
//! light panel count them. Lights of hidden nodes are off.

use glam::DVec3;

use crate::color::luminance;
use crate::scene::{LightKind, Pose, Scene};
use crate::settings::lighting::{LightEdit, Lighting, SunShines};

/// A light where it is now. Directional lights have no position, point lights no direction.
#[derive(Clone, Debug, PartialEq)]
pub struct PosedLight {
    pub name: String,
    /// The node that carries it; `None`: it is not in the file.
    pub node: Option<usize>,
    pub kind: LightKind,
    /// Colour times intensity: lux or candela, linear RGB.
    pub strength: DVec3,
    /// World space.
    pub position: DVec3,
    /// The way it shines, unit length.
    pub direction: DVec3,
}

/// Where a light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightSource {
    /// The file; carried by this node.
    Node(usize),
    Sun,
    /// Into [`Lighting::added`].
    Added(usize),
}

/// Whether a light shines, and if not, why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shines {
    Yes,
    Off,
    /// Its colour or intensity is zero.
    Black,
    /// Its node is.
    Hidden,
    /// In this pose its node gives it no finite place, or no direction.
    Nowhere,
}

/// A light, whether it shines or not.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownLight {
    pub source: LightSource,
    pub name: String,
    /// As it shall be.
    pub light: LightEdit,
    pub shines: Shines,
    position: DVec3,
    direction: DVec3,
}

/// Whether our own sun is among the lights. `emits`: something in the scene does.
pub fn sun_shines(scene: &Scene, lighting: &Lighting, emits: bool) -> bool {
    match lighting.sun.shines {
        SunShines::Always => true,
        SunShines::Never => false,
        SunShines::Unlit => !emits && !scene.nodes.iter().any(|node| node.light.is_some()),
    }
}

/// Every light: of the scene in the order of its nodes, the sun, then what was added. `shown`: by node.
pub fn known_lights(scene: &Scene, pose: &Pose, lighting: &Lighting, shown: &[bool], emits: bool) -> Vec<KnownLight> {
    let carried = scene.nodes.iter().enumerate().filter_map(|(node, of)| Some((node, scene.lights.get(of.light?)?)));
    let of_scene = carried.map(|(node, light)| {
        let edit = lighting.edits.get(&node).copied().unwrap_or_else(|| LightEdit::of(light));
        let is_hidden = !shown.get(node).copied().unwrap_or(true);
        // A pose has as many matrices as the scene has nodes.
        let world_from_node = pose.world_from_node.get(node).copied().unwrap_or(glam::DMat4::NAN);
        let place = (world_from_node.w_axis.truncate(), world_from_node.transform_vector3(DVec3::NEG_Z));
        KnownLight::new(LightSource::Node(node), light.name.clone(), edit, is_hidden, place)
    });
    let sun = &lighting.sun;
    let on = sun_shines(scene, lighting, emits);
    let light = LightEdit { on, kind: LightKind::Directional, color: sun.color, intensity: sun.illuminance_lux };
    let place = (DVec3::ZERO, DVec3::from_array(sun.direction));
    let sun = KnownLight::new(LightSource::Sun, "sun".to_owned(), light, false, place);
    let added = lighting.added.iter().enumerate().map(|(index, added)| {
        let place = (DVec3::from_array(added.position), DVec3::from_array(added.direction));
        KnownLight::new(LightSource::Added(index), added.name.clone(), added.light, false, place)
    });
    of_scene.chain([sun]).chain(added).collect()
}

/// Lights that are on and not black. `shown`: by node; `emits`: something in the scene does.
pub fn posed_lights(scene: &Scene, pose: &Pose, lighting: &Lighting, shown: &[bool], emits: bool) -> Vec<PosedLight> {
    known_lights(scene, pose, lighting, shown, emits).into_iter().filter_map(KnownLight::posed).collect()
}

/// Lights that would shine, were they anywhere: a sentence each.
pub fn left_out(scene: &Scene, pose: &Pose, lighting: &Lighting, shown: &[bool]) -> Vec<String> {
    let known = known_lights(scene, pose, lighting, shown, false);
    let lost = known.into_iter().filter(|light| light.shines == Shines::Nowhere);
    lost.map(|light| {
        let node = match light.source {
            LightSource::Node(node) => format!(" of node \"{}\"", scene.nodes[node].name),
            LightSource::Sun | LightSource::Added(_) => String::new(),
        };
        format!("light \"{}\"{node} is left out: in this pose it has no finite place or no direction", light.name)
    })
    .collect()
}

/// The most that one of the lights brings to a point, were nothing between: luminance, lux. `None` where none shines.
pub fn brightest_at(known: &[KnownLight], point: DVec3) -> Option<f64> {
    let shining = known.iter().filter(|light| light.shines == Shines::Yes);
    let lux = shining.map(|light| {
        let away = match light.light.kind {
            LightKind::Directional => 1.0,
            LightKind::Point { .. } | LightKind::Spot { .. } => light.position.distance_squared(point),
        };
        luminance(strength(&light.light).to_array()) / away
    });
    lux.filter(|lux| lux.is_finite()).reduce(f64::max)
}

impl KnownLight {
    /// `place`: position and direction, of any length.
    fn new(source: LightSource, name: String, light: LightEdit, is_hidden: bool, place: (DVec3, DVec3)) -> Self {
        let (position, direction) = (place.0, place.1.normalize_or_zero());
        let is_placed = match light.kind {
            LightKind::Directional => direction != DVec3::ZERO,
            LightKind::Point { .. } => position.is_finite(),
            LightKind::Spot { .. } => position.is_finite() && direction != DVec3::ZERO,
        };
        let shines = match () {
            () if !light.on => Shines::Off,
            () if strength(&light).max_element() <= 0.0 => Shines::Black,
            () if is_hidden => Shines::Hidden,
            () if !is_placed => Shines::Nowhere,
            () => Shines::Yes,
        };
        Self { source, name, light, shines, position, direction }
    }

    /// `None` where it does not shine.
    fn posed(self) -> Option<PosedLight> {
        let node = match self.source {
            LightSource::Node(node) => Some(node),
            LightSource::Sun | LightSource::Added(_) => None,
        };
        let Self { name, light, position, direction, .. } = self;
        let strength = strength(&light);
        (self.shines == Shines::Yes).then_some(PosedLight {
            name,
            node,
            kind: light.kind,
            strength,
            position,
            direction,
        })
    }
}

fn strength(light: &LightEdit) -> DVec3 {
    DVec3::from_array(light.color) * light.intensity
}
