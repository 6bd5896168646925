//! While a clip plays: a picture costs one window frame, what is measured is of the pose that is drawn, and a
//! screenshot is of the frame on screen. The window's clock goes by a fixed step; nothing here looks at another.

use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Key, Modifiers, vec2};
use octolume::app::Pace;
use octolume::engine::Engine;
use octolume::export::read_settings;
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::builtin;
use octolume::scene::load;
use octolume::settings::{ColorBy, NodeNames, Settings, View};

use crate::rig::{Window, small_grid, wgpu_setup};

const FRAMES: u64 = 12;
/// An exact set of the courtyard at 64³ takes no longer, on any machine.
const PATIENCE: Duration = Duration::from_secs(60);

type Change = fn(&mut Settings);

fn settings(set: Change) -> Settings {
    let mut settings = small_grid();
    set(&mut settings);
    settings
}

/// A window whose clip plays. All of a picture fits the budget of its frames, on any machine.
fn playing(settings: Settings) -> Window {
    let mut window = Window::sized(wgpu_setup(), "courtyard", settings, vec2(700.0, 100.0));
    let pace = Pace { budget: PATIENCE, budget_under_input: PATIENCE, blink: PATIENCE };
    window.0.state_mut().set_pace(pace);
    window.0.key_press_modifiers(Modifiers::NONE, Key::Space);
    window.0.step();
    window
}

impl Window {
    /// One frame of the window, and time for what it has started.
    fn frame(&mut self) {
        self.0.step();
        let until = Instant::now() + PATIENCE;
        while self.app().is_voxelizing() {
            assert!(Instant::now() < until, "the exact voxelization does not end");
            std::thread::sleep(Duration::from_millis(1));
        }
        self.app().gpu().wait().expect("a device");
    }

    fn last_frame(&self) -> u64 {
        self.app().engine().last_frame().map_or(0, |(number, _)| number)
    }
}

#[test]
fn a_picture_of_a_playing_clip_costs_one_window_frame() {
    let views: [(&str, Change); 4] = [
        ("voxels", |_| {}),
        ("ghost, measured", |s| (s.method.look.view, s.method.look.accuracy) = (View::Ghost, true)),
        ("radiance", |s| s.method.look.color = ColorBy::Radiance),
        ("surfaces", |s| s.method.look.view = View::Surfaces),
    ];
    for (name, set) in views {
        let mut window = playing(settings(set));
        // Kernels learn what they cost, and the engine how large things are.
        (0..FRAMES).for_each(|_| window.frame());
        let (frame, moment) = (window.last_frame(), window.app().engine().moment_on_screen().cloned());
        (0..FRAMES).for_each(|_| window.frame());
        let finished = window.last_frame() - frame;
        // An outgrown octree is built again, which takes a frame more.
        assert!(finished + 1 >= FRAMES, "{name}: {finished} pictures in {FRAMES} frames of the window");
        assert_ne!(window.app().engine().moment_on_screen(), moment.as_ref(), "{name}");
    }
}

fn courtyard(settings: &Settings) -> Arc<Prepared> {
    let bytes = builtin::bytes("courtyard").expect("the built-in scene");
    let scene = load::open_bytes("courtyard", bytes, None, &Progress::default()).expect("opens");
    let prepared = prepare(Arc::new(scene), &settings.method.discretization, None, &Progress::default());
    Arc::new(prepared.expect("voxelizes"))
}

/// Holes and spill of nearest and split at a moment, by an engine that was never asked for another.
fn true_counts(engine: &mut Engine, prepared: &Arc<Prepared>, settings: &Settings) -> [(Option<u64>, Option<u64>); 2] {
    let exact = prepared.exact(&settings.shot.motion, &Default::default(), &Progress::default()).expect("an exact set");
    engine.set_prepared(Some(Arc::clone(prepared)));
    engine.offer_exact(Arc::new(exact));
    engine.request(settings, [8, 8]).expect("a request");
    engine.run_to_end().expect("a frame");
    counts(engine)
}

fn counts(engine: &Engine) -> [(Option<u64>, Option<u64>); 2] {
    let report = engine.accuracy().expect("an octree");
    [report.nearest, report.split].map(|filter| filter.map_or((None, None), |filter| (filter.holes, filter.spill)))
}

#[test]
fn what_is_measured_is_of_the_pose_that_is_drawn_or_said_to_be_on_its_way() {
    let settings = settings(|s| s.method.look.accuracy = true);
    let prepared = courtyard(&settings);
    let mut window = playing(settings.clone());
    let gpu = octolume::gpu::Gpu::headless(&octolume::stages::SHADERS, None).expect("a device");
    let mut fresh = Engine::new(Arc::new(gpu));
    for _ in 0..20 {
        for _ in 0..4 {
            window.frame();
            window.check(&mut fresh, &prepared);
        }
        // At rest it is there, however long it took.
        window.press(Modifiers::NONE, Key::Space);
        assert!(window.check(&mut fresh, &prepared), "not measured at rest");
        window.0.key_press_modifiers(Modifiers::NONE, Key::Space);
    }
}

impl Window {
    /// Compares what is measured with the truth; `false` where the window says that it is on its way.
    fn check(&self, fresh: &mut Engine, prepared: &Arc<Prepared>) -> bool {
        let engine = self.app().engine();
        let Some(drawn) = engine.settings_on_screen() else { return false };
        if engine.accuracy().is_none_or(|report| report.exact_cells.is_none()) {
            return false;
        }
        assert_eq!(counts(engine), true_counts(fresh, prepared, drawn), "at {} s", drawn.shot.motion.time_secs);
        true
    }
}

#[test]
fn a_screenshot_while_a_clip_plays_is_of_the_frame_on_screen() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::with(wgpu_setup(), "courtyard", small_grid(), NodeNames::default());
    window.type_into("Save to", &folder.path().display().to_string());
    window.0.key_press_modifiers(Modifiers::NONE, Key::Space);
    (0..6).for_each(|_| window.frame());
    let on_screen = |window: &Window| window.app().engine().moment_on_screen().expect("a picture").time_secs;
    let before = on_screen(&window);
    window.0.key_press_modifiers(Modifiers::COMMAND, Key::S);
    // Every event is a frame of its own.
    window.frame();
    let after = on_screen(&window);
    let file = folder.path().join("octolume-courtyard-1.png");
    let until = Instant::now() + PATIENCE;
    while !std::fs::metadata(&file).is_ok_and(|file| file.len() > 0) {
        assert!(Instant::now() < until, "no screenshot comes");
        window.frame();
    }
    window.0.key_press_modifiers(Modifiers::NONE, Key::Space);
    window.settle();
    let settings = read_settings(&file).expect("settings in the picture");
    let saved = settings.shot.motion.time_secs;
    assert!((before..=after).contains(&saved), "{saved} s, and {before} to {after} s were on screen");
    assert_ne!(settings.shot.motion.time_secs, window.app().settings().shot.motion.time_secs);
}
