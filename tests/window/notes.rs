//! What the window tells: notes over the picture, the log behind them, errors beside the window; and what it asks for
//! where the desktop has no file dialog.

use std::path::PathBuf;
use std::sync::Mutex;

use egui::accesskit::Role;
use egui::{Key, Modifiers, OutputCommand};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use octolume::app::{App, Host, Start};

use crate::rig::{Window, small_grid, wgpu_setup};

fn on_host(host: Host, scene: &str) -> Window {
    let scene = PathBuf::from(scene);
    Window::build(wgpu_setup(), move |context| {
        App::new(context, &scene, Start { settings: small_grid(), host, ..Start::default() }).expect("a window")
    })
}

#[test]
fn a_long_error_wraps_over_the_picture_and_leads_to_the_log() {
    let mut window = Window::open("courtyard");
    window.click("Measurements");
    let path = format!("/no/such/{}.glb", "folder/".repeat(40));
    window.type_into("Path", &path);
    window.click("Open");
    let is_note = |node: &egui_kittest::Node<'_>| node.accesskit_node().role() == Role::Button;
    let note = window.0.query_all_by_label_contains(&path).find(is_note).expect("a note");
    let (rect, view) = (note.rect(), window.view_rect());
    assert!(view.contains_rect(rect) && rect.height() > 60.0, "{rect} in {view}");
    assert!(window.0.query_by_label("Clear log").is_none());
    note.click();
    window.settle();
    window.0.run_steps(4);
    let clear = window.0.get_by_label("Clear log").rect();
    assert!(clear.top() > 0.0 && clear.bottom() < 1000.0, "the log is in view: {clear}");
    assert_eq!(window.0.query_all_by_label_contains(&path).filter(is_note).count(), 0, "the note is gone");
}

#[test]
fn screenshots_go_to_a_folder_that_is_made_and_the_log_has_its_path() {
    let folder = tempfile::tempdir().expect("a folder");
    let screenshots = folder.path().join("Pictures/Octolume");
    let mut window = on_host(Host { screenshots: screenshots.clone(), ..Host::default() }, "courtyard");
    window.click("Screenshot");
    let file = screenshots.join("octolume-courtyard-1.png");
    assert!(file.exists());
    let path = file.display().to_string();
    assert!(window.log_holds(&format!("Saved {path}")));
    window.0.get_by_label("Copy path").click();
    window.0.step();
    let commands = &window.0.output().platform_output.commands;
    assert!(commands.contains(&OutputCommand::CopyText(path)), "{commands:?}");
    // What is pasted has quotes around it; a folder that was typed is not made.
    window.type_into("Save to", &format!("\"{}\"", folder.path().display()));
    window.click("Screenshot");
    assert!(folder.path().join("octolume-courtyard-1.png").exists());
    let missing = folder.path().join("missing");
    window.type_into("Save to", &missing.display().to_string());
    window.click("Screenshot");
    assert!(!missing.exists() && window.log_holds("cannot be written"));
}

#[test]
fn without_a_file_dialog_the_path_field_asks_for_a_path() {
    let mut window = Window::open("courtyard");
    window.click("Scene");
    window.click("Controls");
    window.press(Modifiers::COMMAND, Key::O);
    window.0.run_steps(4);
    let field = window.0.get_by_label("Path");
    assert!(field.accesskit_node().is_focused());
    assert!(window.log_holds("There is no file dialog here"));
}

#[test]
fn what_a_file_dialog_chooses_is_opened() {
    let choose_file = || -> octolume::app::Choice { Box::pin(std::future::ready(Some(PathBuf::from("no/such.glb")))) };
    let mut window = on_host(Host { choose_file, ..Host::default() }, "courtyard");
    window.click("Choose…");
    assert!(window.log_holds("no/such.glb: cannot be read"));
}

#[test]
fn errors_are_told_beside_the_window_too() {
    static TOLD: Mutex<Vec<String>> = Mutex::new(Vec::new());
    let tell_error = |error: &str| TOLD.lock().expect("told").push(error.to_owned());
    let mut window = on_host(Host { tell_error, ..Host::default() }, "no/such.glb");
    let told = TOLD.lock().expect("told").clone();
    assert!(told.len() == 1 && told[0].starts_with("no/such.glb: cannot be read"), "{told:?}");
    assert!(window.log_holds(&told[0]));
}
