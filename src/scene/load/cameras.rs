//! Cameras whose projection makes sense.

use gltf::json::{self, Root, camera::Type as CameraType, validation::Checked};

use super::file_object::FileObject;
use super::unique_names::UniqueNames;
use crate::scene::{Projection, SceneCamera, Warning};

/// The cameras that make sense, and for each of the file where it went.
pub(super) fn load(root: &Root, warnings: &mut Vec<Warning>) -> (Vec<SceneCamera>, Vec<Option<usize>>) {
    let (mut cameras, mut names) = (Vec::new(), UniqueNames::default());
    let places = root.cameras.iter().enumerate().map(|(index, camera)| match projection(camera) {
        Some(projection) => {
            let name = camera.name.clone().or_else(|| name_of_node(root, index));
            let name = names.of(name.unwrap_or_else(|| format!("camera {index}")));
            cameras.push(SceneCamera { name, projection });
            Some(cameras.len() - 1)
        }
        None => {
            let object = FileObject::item("camera", index, camera.name.as_deref());
            warnings.push(object.warning("its projection makes no sense; it is left out"));
            None
        }
    });
    let places = places.collect();
    (cameras, places)
}

/// Of the first that carries it.
fn name_of_node(root: &Root, camera: usize) -> Option<String> {
    let node = root.nodes.iter().find(|node| node.camera.is_some_and(|carried| carried.value() == camera))?;
    node.name.clone()
}

fn projection(camera: &json::Camera) -> Option<Projection> {
    let positive = |value: f32| (value.is_finite() && value > 0.0).then_some(f64::from(value));
    match camera.type_ {
        Checked::Valid(CameraType::Perspective) => {
            let lens = camera.perspective.as_ref()?;
            let far = match lens.zfar {
                Some(far) => Some(positive(far).filter(|_| far > lens.znear)?),
                None => None,
            };
            let fov_y_radians = positive(lens.yfov).filter(|&fov| fov < std::f64::consts::PI)?;
            let aspect = lens.aspect_ratio.and_then(positive);
            Some(Projection::Perspective { fov_y_radians, aspect, near: positive(lens.znear)?, far })
        }
        Checked::Valid(CameraType::Orthographic) => {
            let lens = camera.orthographic.as_ref()?;
            let near = Some(f64::from(lens.znear)).filter(|&near| near >= 0.0)?;
            let far = positive(lens.zfar).filter(|&far| far > near)?;
            // Negative magnifications are discouraged, not forbidden; they mirror the image.
            let (half_width, half_height) = (positive(lens.xmag.abs())?, positive(lens.ymag.abs())?);
            Some(Projection::Orthographic { half_width, half_height, near, far })
        }
        Checked::Invalid => None,
    }
}
