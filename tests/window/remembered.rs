//! What the window remembers from one start to the next. The storage is a map, as nothing here may touch a home.

use std::collections::HashMap;
use std::path::PathBuf;

use eframe::{App as _, Storage};
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use octolume::app::{App, Host, Start};
use octolume::settings::Settings;
use serde_json::json;

use crate::files::write;
use crate::rig::{Window, small_grid, wgpu_setup};

#[derive(Clone, Default)]
struct Shelf(HashMap<String, String>);

impl Storage for Shelf {
    fn get_string(&self, key: &str) -> Option<String> {
        self.0.get(key).cloned()
    }

    fn set_string(&mut self, key: &str, value: String) {
        self.0.insert(key.to_owned(), value);
    }

    fn remove_string(&mut self, key: &str) {
        self.0.remove(key);
    }

    fn flush(&mut self) {}
}

const EGUI_KEY: &str = "egui";

/// A window that starts from what is on a shelf, as eframe has it.
fn start(shelf: Shelf, scene: &str, host: Host) -> Window {
    let scene = PathBuf::from(scene);
    Window::build(wgpu_setup(), move |context| {
        if let Some(memory) = eframe::get_value::<egui::Memory>(&shelf, EGUI_KEY) {
            context.egui_ctx.memory_mut(|current| *current = memory);
        }
        context.storage = Some(Box::leak(Box::new(shelf)));
        App::new(context, &scene, Start { settings: small_grid(), host, ..Start::default() }).expect("a window")
    })
}

/// Remembers, in a file that is never made.
fn host() -> Host {
    Host { remembered_in: Some(PathBuf::from("not/made/window.ron")), ..Host::default() }
}

/// Closes a window, as eframe does.
fn close(mut window: Window) -> Shelf {
    let mut shelf = Shelf::default();
    if window.app().persist_egui_memory() {
        window.0.ctx.memory(|memory| eframe::set_value(&mut shelf, EGUI_KEY, memory));
    }
    window.0.state_mut().save(&mut shelf);
    shelf
}

impl Window {
    /// How many buttons are called like this.
    fn buttons(&self, name: &str) -> usize {
        self.0.query_all_by_label(name).filter(|node| node.accesskit_node().role() == Role::Button).count()
    }

    fn recent(&mut self, entry: &str) -> usize {
        self.click("Recent");
        let count = self.buttons(entry);
        self.press(egui::Modifiers::NONE, egui::Key::Escape);
        count
    }
}

#[test]
fn panels_folder_and_recent_scenes_come_back_and_settings_do_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = write(folder.path(), "flight", &[0], vec![json!({ "mesh": 0 })], None);
    let mut window = start(Shelf::default(), &file.display().to_string(), host());
    window.set("Level", 5.0);
    window.type_into("Save to", "/somewhere/else");
    window.click("Measurements");
    window.click("Tree");
    window.click("Filter");
    let mut window = start(close(window), "courtyard", host());
    assert!(window.0.query_by_label("Timings").is_none(), "the measurements are folded");
    assert!(window.0.query_by_label("Nearest").is_none(), "the filter is folded");
    assert!(window.0.query_by_label("Octolume").is_some() && window.0.query_by_label("Coverage").is_some());
    assert_eq!(window.0.get_by_label("Save to").value().as_deref(), Some("/somewhere/else"));
    assert_eq!(window.app().settings().method.look, Settings::default().method.look);
    assert_eq!((window.recent("flight.gltf"), window.recent("courtyard")), (1, 1));
    // A scene that is gone is told, and can be taken off the list.
    std::fs::remove_file(&file).expect("removed");
    window.choose("Recent", "flight.gltf");
    window.choose("Recent", "Forget flight.gltf");
    assert_eq!(window.recent("flight.gltf"), 0);
    window.click("Measurements");
    assert!(window.log_holds("flight.gltf: cannot be read"));
}

#[test]
fn what_is_whole_or_not_there_is_not_told() {
    let mut whole = Shelf::default();
    eframe::set_value(&mut whole, EGUI_KEY, &egui::Memory::default());
    for shelf in [Shelf::default(), whole] {
        let mut window = start(shelf, "courtyard", Host::default());
        assert_eq!(window.log_count("the window opens as it did at first"), 0);
    }
}

#[test]
fn what_is_broken_is_told_and_the_window_opens_as_at_first() {
    let app = ["{ broken", r#"{ "format": 99 }"#].map(|text| (eframe::APP_KEY, text));
    let egui = ["(((", "(options"].map(|text| (EGUI_KEY, text));
    for (key, text) in app.into_iter().chain(egui) {
        let shelf = Shelf(HashMap::from([(key.to_owned(), text.to_owned())]));
        let mut window = start(shelf, "courtyard", host());
        assert!(window.0.query_by_label("Nearest").is_some() && window.0.query_by_label("Timings").is_some());
        assert_eq!(window.log_count("the window opens as it did at first"), 1, "{key} {text}");
    }
}

#[test]
fn a_file_of_which_nothing_is_readable_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("window.ron");
    std::fs::write(&file, "half of a fi").expect("written");
    let host = Host { remembered_in: Some(file), ..Host::default() };
    let mut window = start(Shelf::default(), "courtyard", host);
    assert_eq!(window.log_count("window.ron: nothing in it is readable"), 1);
}

#[test]
fn a_window_that_is_to_remember_nothing_writes_nothing() {
    let mut window = start(Shelf::default(), "courtyard", Host::default());
    window.click("Filter");
    assert!(close(window).0.is_empty());
}
