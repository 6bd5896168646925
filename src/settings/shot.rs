//! What is looked at: which moment of the scene, what of it, and from where.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use super::fit::Fit;
use super::motion::MotionSettings;
use super::visibility::Visibility;
use crate::scene::camera::FOV_Y_DEGREES;
use crate::scene::{OrbitCamera, SceneIdentity};

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ShotSettings {
    pub motion: MotionSettings,
    pub visibility: Visibility,
    /// What the grid encloses.
    pub fit: Fit,
    /// `None`: that of the file.
    pub camera: Option<OrbitCamera>,
    /// Which of the file's cameras is looked through, by name or by number from 0; as the clip moves it. `None`: the
    /// first, and where there is none all is framed.
    pub file_camera: Option<String>,
    /// Width and height of the picture. What is saved tells its own; `None`: whoever draws decides, the window by
    /// its own size.
    pub size_px: Option<[u32; 2]>,
    /// What was looked at. Written by who saves, and changes nothing.
    pub scene: Option<SceneIdentity>,
}

impl ShotSettings {
    /// Of a picture; every adapter can draw as many.
    pub const SIDES_PX: RangeInclusive<u32> = 1..=8192;

    pub(super) fn check(&self) -> Result<(), String> {
        self.motion.check()?;
        self.fit.check()?;
        if let Some([width, height]) = self.size_px.filter(|sides| !sides.iter().all(|px| Self::SIDES_PX.contains(px)))
        {
            let (least, most) = (Self::SIDES_PX.start(), Self::SIDES_PX.end());
            return Err(format!("a picture of {width} x {height} pixels: a side has {least} to {most}"));
        }
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
    if !camera.roll_degrees.is_finite() {
        return Err(format!("a roll of {} degrees is not finite", camera.roll_degrees));
    }
    if let Some(height) = camera.orthographic_height.filter(|height| !(height.is_finite() && *height > 0.0)) {
        return Err(format!("an orthographic view of height {height} is not positive and finite"));
    }
    if !FOV_Y_DEGREES.contains(&camera.fov_y_degrees) {
        let (least, most) = (FOV_Y_DEGREES.start(), FOV_Y_DEGREES.end());
        return Err(format!("a field of view of {} degrees is not in {least} to {most}", camera.fov_y_degrees));
    }
    Ok(())
}
