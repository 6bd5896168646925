//! Everything the window can be told to do. Panels, shortcuts, drops and scripts all end here.

use std::path::PathBuf;

use crate::scene::OrbitCamera;
use crate::settings::{Discretization, Look, MotionSettings};

#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Opens a file, or a built-in scene by its name.
    Open(PathBuf),
    /// Lets the desktop's dialog choose one.
    ChooseFile,
    CancelLoading,
    Discretize(Discretization),
    Look(Look),
    /// Another clip or turn, or a scrub of the timeline.
    Move(MotionSettings),
    TogglePlaying,
    /// Pauses, and goes by so many steps of 1/30 s.
    Step(i32),
    Loop(bool),
    Speed(f64),
    /// The person moves the camera: coarse until it rests.
    Camera(OrbitCamera),
    /// Back to the camera that frames everything.
    FrameAll,
    SaveScreenshot,
    ClearLog,
}
