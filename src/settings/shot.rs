//! What is looked at: which moment of the scene, what of it, and from where.

use serde::{Deserialize, Serialize};

use super::motion::MotionSettings;
use super::visibility::Visibility;
use crate::scene::OrbitCamera;
use crate::scene::camera::FOV_Y_DEGREES;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ShotSettings {
    pub motion: MotionSettings,
    pub visibility: Visibility,
    /// `None`: frames everything.
    pub camera: Option<OrbitCamera>,
}

impl ShotSettings {
    pub(super) fn check(&self) -> Result<(), String> {
        self.motion.check()?;
        self.camera.map_or(Ok(()), |camera| check_camera(&camera))
    }
}

fn check_camera(camera: &OrbitCamera) -> Result<(), String> {
    if !(camera.eye.is_finite() && camera.target.is_finite()) {
        return Err("the camera's eye and target must be finite".to_owned());
    }
    if camera.eye == camera.target {
        return Err("the camera's eye and target must differ".to_owned());
    }
    if !FOV_Y_DEGREES.contains(&camera.fov_y_degrees) {
        let (least, most) = (FOV_Y_DEGREES.start(), FOV_Y_DEGREES.end());
        return Err(format!("a field of view of {} degrees is not in {least} to {most}", camera.fov_y_degrees));
    }
    Ok(())
}
