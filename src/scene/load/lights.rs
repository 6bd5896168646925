//! KHR_lights_punctual, in its units.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use gltf::json::{
    Root,
    extensions::scene::khr_lights_punctual::{Light as FileLight, Type},
    validation::Checked,
};

use super::file_object::FileObject;
use crate::scene::{Light, LightKind, Warning};

/// The lights that make sense, and for each of the file where it went.
pub(super) fn load(root: &Root, warnings: &mut Vec<Warning>) -> (Vec<Light>, Vec<Option<usize>>) {
    let declared = root.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
    let mut lights = Vec::new();
    let places = declared.iter().flat_map(|lights| &lights.lights).enumerate().map(|(index, light)| {
        let object = FileObject::item("light", index, light.name.as_deref());
        match kind(light, &object, warnings) {
            Ok(kind) => {
                let name = light.name.clone().unwrap_or_else(|| format!("light {index}"));
                lights.push(Light { name, kind, color: light.color, intensity: light.intensity });
                Some(lights.len() - 1)
            }
            Err(cause) => {
                warnings.push(object.warning(format!("it {cause}; it is left out")));
                None
            }
        }
    });
    let places = places.collect();
    (lights, places)
}

fn kind(light: &FileLight, object: &FileObject, warnings: &mut Vec<Warning>) -> Result<LightKind, String> {
    if !light.intensity.is_finite() || !light.color.iter().all(|channel| channel.is_finite()) {
        return Err("has a colour or intensity that is not finite".to_owned());
    }
    let range = light.range.filter(|range| *range > 0.0);
    match (&light.type_, &light.spot) {
        (Checked::Valid(Type::Directional), _) => Ok(LightKind::Directional),
        (Checked::Valid(Type::Point), _) => Ok(LightKind::Point { range }),
        (Checked::Valid(Type::Spot), spot) => {
            let (inner, outer) =
                spot.as_ref().map_or((0.0, FRAC_PI_4), |spot| (spot.inner_cone_angle, spot.outer_cone_angle));
            if spot.is_none() {
                warnings.push(object.warning("it is a spot light without a cone; it gets glTF's default"));
            }
            let (inner_cone_radians, outer_cone_radians) = cone([inner, outer]);
            if (inner_cone_radians, outer_cone_radians) != (inner, outer) {
                warnings.push(object.warning(format!(
                    "it has a cone from {inner} to {outer} radians, which must grow from 0 to at most π/2; it is taken \
                     from {inner_cone_radians} to {outer_cone_radians}"
                )));
            }
            Ok(LightKind::Spot { range, inner_cone_radians, outer_cone_radians })
        }
        (Checked::Invalid, _) => Err("is of a type that glTF does not know".to_owned()),
    }
}

/// The nearest cone that makes sense; where the inner angle is the outer one, its edge is hard.
fn cone(angles: [f32; 2]) -> (f32, f32) {
    let outer = if angles[1] > 0.0 { angles[1].min(FRAC_PI_2) } else { FRAC_PI_4 };
    let inner = if angles[0] > 0.0 { angles[0].min(outer) } else { 0.0 };
    (inner, outer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cones_keep_what_makes_sense_of_them() {
        assert_eq!(cone([0.1, 0.2]), (0.1, 0.2));
        assert_eq!(cone([0.3, 0.3]), (0.3, 0.3), "a hard edge");
        assert_eq!(cone([0.9, FRAC_PI_4]), (FRAC_PI_4, FRAC_PI_4));
        assert_eq!(cone([-1.0, 3.0]), (0.0, FRAC_PI_2));
        assert_eq!(cone([f32::NAN, f32::NAN]), (0.0, FRAC_PI_4));
    }
}
