//! The lights of a pose: those of the scene as the settings want them, our own sun, and what was added.
//!
//! In: a scene, its pose, the settings. Out: lights in world space, in the order in which the shadow map
//! view and the light panel count them. Lights of hidden nodes are off.

use glam::DVec3;

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

/// How a light of the file is without an edit.
pub fn unedited(light: &crate::scene::Light) -> LightEdit {
    let color = light.color.map(f64::from);
    LightEdit { on: true, kind: light.kind, color, intensity: f64::from(light.intensity) }
}

/// Lights that are on and not black. `shown`: by node; `emits`: something in the scene does.
pub fn posed_lights(scene: &Scene, pose: &Pose, lighting: &Lighting, shown: &[bool], emits: bool) -> Vec<PosedLight> {
    let carried = scene.nodes.iter().enumerate().filter_map(|(node, of)| Some((node, scene.lights.get(of.light?)?)));
    let mut lights: Vec<PosedLight> = carried
        .filter(|(node, _)| shown.get(*node).copied().unwrap_or(true))
        .filter_map(|(node, light)| {
            let edit = lighting.edits.get(&node).copied().unwrap_or_else(|| unedited(light));
            let world_from_node = pose.world_from_node.get(node)?;
            let direction = world_from_node.transform_vector3(DVec3::NEG_Z).normalize_or_zero();
            posed(light.name.clone(), Some(node), &edit, world_from_node.w_axis.truncate(), direction)
        })
        .collect();
    if sun_shines(scene, lighting, emits) {
        let sun = &lighting.sun;
        let edit =
            LightEdit { on: true, kind: LightKind::Directional, color: sun.color, intensity: sun.illuminance_lux };
        let direction = DVec3::from_array(sun.direction).normalize_or_zero();
        lights.extend(posed("sun".to_owned(), None, &edit, DVec3::ZERO, direction));
    }
    lights.extend(lighting.added.iter().filter_map(|added| {
        let direction = DVec3::from_array(added.direction).normalize_or_zero();
        posed(added.name.clone(), None, &added.light, DVec3::from_array(added.position), direction)
    }));
    lights
}

/// Whether our own sun is among the lights.
pub fn sun_shines(scene: &Scene, lighting: &Lighting, emits: bool) -> bool {
    match lighting.sun.shines {
        SunShines::Always => true,
        SunShines::Never => false,
        SunShines::Unlit => !emits && !scene.nodes.iter().any(|node| node.light.is_some()),
    }
}

/// `None` where it is off, black, or its node's transform is not finite.
fn posed(name: String, node: Option<usize>, edit: &LightEdit, position: DVec3, direction: DVec3) -> Option<PosedLight> {
    let strength = DVec3::from_array(edit.color) * edit.intensity;
    let is_on = edit.on && strength.max_element() > 0.0;
    let is_placed = match edit.kind {
        LightKind::Directional => direction != DVec3::ZERO,
        LightKind::Point { .. } => position.is_finite(),
        LightKind::Spot { .. } => position.is_finite() && direction != DVec3::ZERO,
    };
    (is_on && is_placed).then_some(PosedLight { name, node, kind: edit.kind, strength, position, direction })
}
