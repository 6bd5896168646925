//! The window in a harness: controls by label, pixels of the view.

use std::path::PathBuf;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Key, Modifiers, PointerButton, Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use image::RgbaImage;
use octolume::app::{App, Start};
use octolume::gpu::Gpu;
use octolume::settings::{NodeNames, Settings};

/// No build or voxelization of these scenes takes longer, on any machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// One device for all windows of a run.
pub fn wgpu_setup() -> egui_wgpu::WgpuSetup {
    static SETUP: OnceLock<egui_wgpu::WgpuSetup> = OnceLock::new();
    SETUP.get_or_init(new_device).clone()
}

pub fn new_device() -> egui_wgpu::WgpuSetup {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    let adapter = Gpu::choose_adapter(adapters, None).expect("an adapter");
    let opened = adapter.request_device(&Gpu::device_descriptor(&adapter));
    let (device, queue) = pollster::block_on(opened).expect("a device");
    egui_wgpu::WgpuSetup::Existing(egui_wgpu::WgpuSetupExisting { instance, adapter, device, queue })
}

pub fn small_grid() -> Settings {
    let mut settings = Settings::default();
    settings.method.discretization.grid = 64;
    settings
}

pub struct Window(pub Harness<'static, App>);

impl Window {
    pub fn open(scene: &str) -> Self {
        Self::on(wgpu_setup(), scene)
    }

    pub fn on(device: egui_wgpu::WgpuSetup, scene: &str) -> Self {
        Self::with(device, scene, small_grid(), NodeNames::default())
    }

    pub fn with(device: egui_wgpu::WgpuSetup, scene: &str, settings: Settings, names: NodeNames) -> Self {
        let scene = PathBuf::from(scene);
        Self::build(device, move |context| {
            App::new(context, &scene, Start { settings, names, ..Start::default() }).expect("a window")
        })
    }

    /// The same in a window of another size.
    pub fn sized(device: egui_wgpu::WgpuSetup, scene: &str, settings: Settings, size: egui::Vec2) -> Self {
        let scene = PathBuf::from(scene);
        Self::build_sized(device, size, move |context| {
            App::new(context, &scene, Start { settings, ..Start::default() }).expect("a window")
        })
    }

    pub fn build(device: egui_wgpu::WgpuSetup, app: impl FnOnce(&mut eframe::CreationContext<'static>) -> App) -> Self {
        Self::build_sized(device, vec2(1100.0, 1000.0), app)
    }

    fn build_sized(
        device: egui_wgpu::WgpuSetup,
        size: egui::Vec2,
        app: impl FnOnce(&mut eframe::CreationContext<'static>) -> App,
    ) -> Self {
        let builder = Harness::builder().with_size(size).with_render_cursor(false);
        let mut window = Self(builder.wgpu_setup(device).build_eframe(app));
        window.settle();
        window
    }

    /// Runs frames until nothing is opened, built or drawn any more.
    pub fn settle(&mut self) {
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

    /// Lets the notes in the corner go: they lie over the view.
    pub fn outlast_notes(&mut self) {
        // A step is a quarter of a second of the window's clock, and no note stays for ten.
        self.0.run_steps(40);
    }

    pub fn app(&self) -> &App {
        self.0.state()
    }

    /// Clicks the control of this name, not the text beside it.
    pub fn click(&mut self, label: &str) {
        let controls = self.0.get_all_by_label(label).filter(|node| node.accesskit_node().role() != Role::Label);
        let controls: Vec<_> = controls.collect();
        assert_eq!(controls.len(), 1, "controls called {label}");
        controls[0].click();
        self.settle();
    }

    /// Unfolds the scene tree in the place of the measurements.
    pub fn open_tree(&mut self) {
        self.click("Measurements");
        self.click("Tree");
    }

    /// Clicks the row of the scene tree with this name, so many times in a row.
    pub fn click_row(&mut self, name: &str, button: PointerButton, times: usize) {
        let rows = self.0.get_all_by_label(name).filter(|node| node.accesskit_node().role() == Role::Label);
        let pos = rows.map(|node| node.rect().center()).next().unwrap_or_else(|| panic!("no row is called {name}"));
        // Every event is a frame of its own, a quarter of a second of the window's clock.
        self.0.ctx.options_mut(|options| options.input_options.max_double_click_delay = 2.0);
        self.0.hover_at(pos);
        for _ in 0..times {
            for pressed in [true, false] {
                self.0.event(egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
            }
            self.0.step();
        }
        self.settle();
    }

    pub fn select(&mut self, name: &str) {
        self.click_row(name, PointerButton::Primary, 1);
    }

    /// How many rows or facts are called like this.
    pub fn count(&self, name: &str) -> usize {
        self.0.query_all_by_label(name).filter(|node| node.accesskit_node().role() == Role::Label).count()
    }

    /// Clicks the one button of this name that can be clicked.
    pub fn click_enabled(&mut self, label: &str) {
        let buttons = self.0.get_all_by_label(label).filter(|node| !node.accesskit_node().is_disabled());
        let buttons: Vec<_> = buttons.filter(|node| node.accesskit_node().role() == Role::Button).collect();
        assert_eq!(buttons.len(), 1, "buttons called {label} that can be clicked");
        buttons[0].click();
        self.settle();
    }

    /// How many lines of the log hold this; the log is unfolded by it, and the measurements above it folded.
    pub fn log_count(&mut self, text: &str) -> usize {
        if self.0.query_by_label("Clear log").is_none() {
            ["Timings", "Octree", "Frame plan", "Log"].into_iter().for_each(|section| self.click(section));
        }
        self.0.query_all_by_label_contains(text).count()
    }

    pub fn log_holds(&mut self, text: &str) -> bool {
        self.log_count(text) > 0
    }

    /// Sets a slider, or a number that has none.
    pub fn set(&mut self, label: &str, value: f64) {
        let slider = self.0.query_by_role_and_label(Role::Slider, label);
        let number = || self.0.get_by_role_and_label(Role::SpinButton, label);
        slider.unwrap_or_else(number).set_value_accesskit(value);
        self.settle();
    }

    pub fn type_into(&mut self, label: &str, text: &str) {
        self.0.get_by_label(label).set_text_value_accesskit(text);
        self.settle();
    }

    /// Opens a list and takes an entry.
    pub fn choose(&mut self, list: &str, entry: &str) {
        self.click(list);
        self.click(entry);
    }

    pub fn press(&mut self, modifiers: Modifiers, key: Key) {
        self.0.key_press_modifiers(modifiers, key);
        self.settle();
    }

    pub fn view_rect(&self) -> Rect {
        self.0.get_by_label("View of the scene").rect()
    }

    /// Pixels of the view, without the texts at its edges.
    pub fn view(&mut self) -> RgbaImage {
        let rect = self.view_rect();
        let window = self.0.render().expect("a picture of the window");
        let (x, y) = (rect.left() as u32, rect.top() as u32 + 60);
        image::imageops::crop_imm(&window, x, y, rect.width() as u32, rect.height() as u32 - 90).to_image()
    }
}

/// How many pixels differ.
pub fn difference(a: &RgbaImage, b: &RgbaImage) -> usize {
    assert_eq!(a.dimensions(), b.dimensions());
    a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count()
}

/// Fewer are dust, not another picture.
const CHANGED: usize = 200;

#[track_caller]
pub fn assert_changed(before: &RgbaImage, after: &RgbaImage, what: &str) {
    let pixels = difference(before, after);
    assert!(pixels >= CHANGED, "{what} changed {pixels} pixels");
}
