//! A GPU that is lost in the middle of a frame: an error at once, which is a sentence, and no wait.
//! The command line ends with it as with any error; the window opens again.

use std::sync::Arc;
use std::time::Duration;

use octolume::engine::{Engine, EngineError};
use octolume::gpu::GpuError;
use octolume::prepare::prepare;
use octolume::progress::Progress;
use octolume::scene::Trs;
use octolume::settings::{Settings, View};

use crate::device;
use crate::scenes::cube_scene;

/// Loses the device after so many slices of a frame; the error the frame ends with.
fn lost_after(slices: usize, view: View) -> EngineError {
    let mut settings = Settings::default();
    settings.method.discretization.grid = 64;
    settings.method.look.view = view;
    let prepared =
        prepare(Arc::new(cube_scene(Trs::default())), &settings.method.discretization, None, &Progress::default());
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::new(prepared.expect("a scene"))));
    engine.request(&settings, [16, 16]).expect("a request");
    for _ in 0..slices {
        engine.advance(Duration::from_millis(1)).expect("a slice");
        engine.gpu().wait().expect("a device");
    }
    engine.gpu().device.destroy();
    // The results that are there may be all there is to do: then reading them fails.
    let ended = engine.run_to_end().and_then(|()| engine.read_image());
    ended.expect_err("a lost device")
}

#[test]
fn wherever_in_a_frame_the_device_is_lost_the_frame_ends_with_a_sentence() {
    for view in [View::Voxels, View::Mesh] {
        for slices in [0, 1, 2, 3, 5, 8, 40] {
            let error = lost_after(slices, view);
            assert!(matches!(error, EngineError::Gpu(GpuError::Lost(_))), "after {slices} slices: {error:?}");
            let sentence = error.to_string();
            assert!(sentence.contains("GPU") && sentence.lines().count() == 1, "{sentence}");
        }
    }
}
