//! The real window without a display: driven by label on the software GPU, its pixels compared.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use image::RgbaImage;
use octolume::app::App;
use octolume::export::read_settings;
use octolume::gpu::Gpu;
use octolume::settings::{Filter, Settings, View};

/// No build or voxelization of these scenes takes longer, on any machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// One device for all windows of a run.
fn wgpu_setup() -> egui_wgpu::WgpuSetup {
    static SETUP: OnceLock<egui_wgpu::WgpuSetupExisting> = OnceLock::new();
    let setup = SETUP.get_or_init(|| {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
        let adapter = Gpu::choose_adapter(adapters, None).expect("an adapter");
        let opened = adapter.request_device(&Gpu::device_descriptor(&adapter));
        let (device, queue) = pollster::block_on(opened).expect("a device");
        egui_wgpu::WgpuSetupExisting { instance, adapter, device, queue }
    });
    egui_wgpu::WgpuSetup::Existing(setup.clone())
}

struct Window(Harness<'static, App>);

impl Window {
    fn open(scene: &str) -> Self {
        let mut settings = Settings::default();
        settings.discretization.grid = 64;
        let scene = PathBuf::from(scene);
        let harness = Harness::builder()
            .with_size(vec2(1000.0, 1000.0))
            .with_render_cursor(false)
            .wgpu_setup(wgpu_setup())
            .build_eframe(move |context| App::new(context, &scene, settings).expect("a window"));
        let mut window = Self(harness);
        window.settle();
        window
    }

    /// Runs frames until nothing is opened, built or drawn any more.
    fn settle(&mut self) {
        let until = Instant::now() + PATIENCE;
        self.0.run_steps(4);
        while !self.app().is_settled() {
            assert!(Instant::now() < until, "the window does not come to rest");
            std::thread::sleep(Duration::from_millis(1));
            self.0.step();
        }
        self.0.run_steps(4);
        self.0.check_accessibility();
    }

    fn app(&self) -> &App {
        self.0.state()
    }

    /// Clicks the control of this name, not the text beside it.
    fn click(&mut self, label: &str) {
        let controls = self.0.get_all_by_label(label).filter(|node| node.accesskit_node().role() != Role::Label);
        let controls: Vec<_> = controls.collect();
        assert_eq!(controls.len(), 1, "controls called {label}");
        controls[0].click();
        self.settle();
    }

    /// Sets a slider, or a number that has none.
    fn set(&mut self, label: &str, value: f64) {
        let slider = self.0.query_by_role_and_label(Role::Slider, label);
        let number = || self.0.get_by_role_and_label(Role::SpinButton, label);
        slider.unwrap_or_else(number).set_value_accesskit(value);
        self.settle();
    }

    fn type_into(&mut self, label: &str, text: &str) {
        self.0.get_by_label(label).set_text_value_accesskit(text);
        self.settle();
    }

    /// Opens a list and takes an entry.
    fn choose(&mut self, list: &str, entry: &str) {
        self.click(list);
        self.click(entry);
    }

    fn press(&mut self, modifiers: Modifiers, key: Key) {
        self.0.key_press_modifiers(modifiers, key);
        self.settle();
    }

    fn view_rect(&self) -> Rect {
        self.0.get_by_label("View of the scene").rect()
    }

    /// Pixels of the view, without the texts at its edges.
    fn view(&mut self) -> RgbaImage {
        let rect = self.view_rect();
        let window = self.0.render().expect("a picture of the window");
        let (x, y) = (rect.left() as u32, rect.top() as u32 + 60);
        image::imageops::crop_imm(&window, x, y, rect.width() as u32, rect.height() as u32 - 90).to_image()
    }
}

/// How many pixels differ.
fn difference(a: &RgbaImage, b: &RgbaImage) -> usize {
    assert_eq!(a.dimensions(), b.dimensions());
    a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count()
}

/// Fewer are dust, not another picture.
const CHANGED: usize = 200;

#[track_caller]
fn assert_changed(before: &RgbaImage, after: &RgbaImage, what: &str) {
    let pixels = difference(before, after);
    assert!(pixels >= CHANGED, "{what} changed {pixels} pixels");
}

#[test]
fn every_control_of_the_picture_changes_pixels_and_back() {
    let mut window = Window::open("courtyard");
    let first = window.view();
    let colors: std::collections::HashSet<_> = first.pixels().collect();
    assert!(colors.len() > 50, "the view shows {} colours", colors.len());
    for (there, back) in [
        ("Nearest", "Split"),
        ("Mesh", "Voxels"),
        ("Ghost", "Voxels"),
        ("By length", "Per voxel"),
        ("Shaded", "Shaded"),
        ("Voxel edges", "Voxel edges"),
        ("Corner", "Centre"),
    ] {
        if there == "Corner" {
            window.set("Turn y", 30.0);
        }
        let before = window.view();
        window.click(there);
        assert_changed(&before, &window.view(), there);
        window.click(back);
        assert_eq!(difference(&before, &window.view()), 0, "{back} brings the picture back");
    }
    window.set("Turn y", 0.0);
    assert_eq!(difference(&first, &window.view()), 0, "turning back brings the picture back");
}

#[test]
fn levels_colours_and_grids_change_the_picture() {
    let mut window = Window::open("courtyard");
    let mut before = window.view();
    for (level, name) in [(5.0, "level 5"), (2.0, "level 2"), (6.0, "leaves")] {
        window.set("Level", level);
        let after = window.view();
        assert_changed(&before, &after, name);
        before = after;
    }
    for color in ["Normal", "Occupancy", "Object", "Octree level", "Albedo"] {
        window.choose("Colour", color);
        let after = window.view();
        assert_changed(&before, &after, color);
        before = after;
    }
    window.choose("Grid", "128³ cells");
    assert_changed(&before, &window.view(), "another grid");
    assert_eq!(window.app().settings().discretization.grid, 128);
}

#[test]
fn the_timeline_moves_the_scene_and_scrubbing_returns_to_the_same_picture() {
    let mut window = Window::open("courtyard");
    let start = window.view();
    (0..6).for_each(|_| window.click("Step forward"));
    let stepped = window.view();
    assert_changed(&start, &stepped, "stepping");
    window.set("Time", 0.0);
    assert_eq!(difference(&start, &window.view()), 0, "time 0 looks the same again");
    window.set("Time", 0.2);

    assert_eq!(difference(&stepped, &window.view()), 0, "scrubbed to the time stepped to");
    window.choose("Clip", "Rest pose");
    assert_eq!(window.app().settings().motion.clip.as_deref(), Some(""));

    window.choose("Clip", "walk (10.00 s)");
    window.0.get_by_label("Play").click();
    window.0.run_steps(8);
    window.0.get_by_label("Pause").click();
    window.settle();
    assert!(window.app().settings().motion.time_secs > 0.0);
    window.press(Modifiers::NONE, Key::ArrowLeft);
    let thirtieths = window.app().settings().motion.time_secs * 30.0;
    assert!((thirtieths - thirtieths.round()).abs() < 1e-9, "a step lands on a thirtieth");
}

#[test]
fn the_camera_orbits_pans_zooms_and_frames_everything_again() {
    let mut window = Window::open("courtyard");
    let through_its_camera = window.view();
    window.press(Modifiers::NONE, Key::F);
    let framed = window.view();
    assert_changed(&through_its_camera, &framed, "framing everything");
    let center = window.view_rect().center();
    let drag = |window: &mut Window, button| {
        let press = |pressed, pos| egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE };
        window.0.hover_at(center);
        window.0.event(press(true, center));
        window.0.hover_at(center + vec2(60.0, 40.0));
        window.0.event(press(false, center + vec2(60.0, 40.0)));
        window.settle();
    };
    for button in [egui::PointerButton::Primary, egui::PointerButton::Secondary, egui::PointerButton::Middle] {
        drag(&mut window, button);
        assert_changed(&framed, &window.view(), "dragging");
        window.press(Modifiers::NONE, Key::F);
        assert_eq!(difference(&framed, &window.view()), 0, "F frames everything again");
    }
}

#[test]
fn a_screenshot_carries_the_settings_and_has_the_size_of_the_view() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("courtyard");
    window.type_into("Save to", &folder.path().display().to_string());
    window.click("Nearest");
    window.set("Level", 5.0);
    window.click("Screenshot");
    let file = folder.path().join("octolume-courtyard-1.png");
    let (settings, size_px) = read_settings(&file).expect("settings in the picture");
    assert_eq!(settings.discretization.filter, Filter::Nearest);
    assert_eq!(settings.look.level, Some(5));
    assert!(settings.look.camera.is_some(), "the camera is told, also where it frames everything");
    let rect = window.view_rect();
    assert_eq!(size_px, Some([rect.width().round() as u32, rect.height().round() as u32]));
    window.press(Modifiers::COMMAND, Key::S);
    assert!(folder.path().join("octolume-courtyard-2.png").exists());
}

#[test]
fn measuring_shows_holes_and_spill_of_both_filters() {
    let mut window = Window::open("courtyard");
    window.set("Turn y", 10.0);
    window.click("Measure both filters");
    let values: Vec<_> = window.0.get_all_by_label_contains(" %").filter_map(|node| node.value()).collect();
    // Shares of time have no decimals.
    let shares = values.iter().filter(|value| value.contains('.')).count();
    assert_eq!(shares, 2, "of nearest and of split: {values:?}");
}

#[test]
fn a_file_that_cannot_be_opened_leaves_the_scene_open() {
    let mut window = Window::open("courtyard");
    let before = window.view();
    window.type_into("Path", "no/such/file.glb");
    window.click("Open");
    ["Timings", "Octree", "Frame plan"].into_iter().for_each(|folded| window.click(folded));
    window.click("Log");
    assert!(window.0.query_all_by_label_contains("no/such/file.glb: cannot be read").next().is_some());
    assert_eq!(difference(&before, &window.view()), 0);
}

#[test]
fn a_still_scene_asks_for_no_repaint_and_runs_nothing() {
    let mut window = Window::open("courtyard");
    window.0.run_steps(8);
    assert!(!window.0.ctx.has_requested_repaint());
    let counters = window.app().gpu().counters();
    window.0.run_steps(8);
    assert_eq!(window.app().gpu().counters(), counters);
}

#[test]
fn input_to_paint_is_measured() {
    let mut window = Window::open("courtyard");
    window.0.set_render_every_step(true);
    let before = window.app().latency().count();
    for x in 0..5 {
        window.0.hover_at(window.view_rect().center() + vec2(x as f32, 0.0));
        window.0.step();
    }
    std::thread::sleep(Duration::from_millis(50));
    assert!(window.app().latency().count() > before);
    assert!(window.app().latency().p95_ms().is_some_and(|ms| ms > 0.0));
}

#[test]
fn real_files_open_by_drop() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = ["../shared/gltf", "../../shared/gltf"].map(|folder| root.join(folder));
    let Some(folder) = folders.into_iter().find(|folder| folder.is_dir()) else { return };
    let mut window = Window::open("courtyard");
    let courtyard = window.view();
    window.0.input_mut().dropped_files.push(std::sync::Arc::new(Dropped(folder.join("Fox/Fox.glb"))));
    window.settle();
    assert_changed(&courtyard, &window.view(), "another scene");
    assert!(window.0.query_all_by_label("Fox").next().is_some());
    window.click("Ghost");
    assert_eq!(window.app().settings().look.view, View::Ghost);
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}
