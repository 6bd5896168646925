//! The scene tree: found by name, selected, hidden, shown alone, framed.

use egui::{Key, Modifiers, PointerButton};
use egui_kittest::kittest::Queryable as _;
use octolume::export::read_settings;
use octolume::settings::{NodeNames, Visibility};
use serde_json::json;

use crate::files;
use crate::rig::{Window, assert_changed, difference, small_grid, wgpu_setup};

fn courtyard() -> Window {
    let mut window = Window::open("courtyard");
    window.open_tree();
    window
}

#[test]
fn a_node_tells_what_it_carries_and_how_it_moves() {
    let mut window = courtyard();
    assert_eq!(window.count("colonnade"), 1);
    assert_eq!(window.count("No node is selected."), 1);
    window.select("court");
    for fact in ["Mesh", "Triangles", "Materials", "Voxels", "Moves", "still"] {
        assert!(window.count(fact) > 0, "{fact}");
    }
    window.type_into("Find", "TRAVELLER");
    window.select("traveller head");
    assert!(window.0.query_all_by_label_contains("skinned by").next().is_some());
    assert!(window.0.query_all_by_label_contains("25 joints").next().is_some());
    window.type_into("Find", "no such node");
    assert_eq!(window.count("No node is called like this."), 1);
}

#[test]
fn hiding_changes_the_picture_and_showing_brings_it_back() {
    let mut window = courtyard();
    let all = window.view();
    window.select("walls");
    window.click("Hide");
    let without = window.view();
    assert_changed(&all, &without, "hiding");
    assert_eq!(window.app().settings().shot.visibility.hidden.len(), 1);
    window.click_enabled("Show");
    assert_eq!(difference(&all, &window.view()), 0);
    window.press(Modifiers::NONE, Key::H);
    assert_eq!(difference(&without, &window.view()), 0, "H hides the selection");
    window.press(Modifiers::ALT, Key::H);
    assert_eq!(difference(&all, &window.view()), 0, "Alt+H shows everything");
    assert!(window.app().settings().shot.visibility.shows_all());
}

#[test]
fn hiding_is_undone_and_done_again() {
    let mut window = courtyard();
    let all = window.view();
    window.select("walls");
    window.press(Modifiers::NONE, Key::H);
    let without = window.view();
    // Later, or it would be one step with the hiding.
    window.0.run_steps(8);
    window.click("Nearest");
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(difference(&without, &window.view()), 0, "the filter is undone");
    window.click("Undo");
    assert_eq!(difference(&all, &window.view()), 0, "the hiding is undone");
    window.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(difference(&without, &window.view()), 0, "and done again");
}

#[test]
fn isolating_shows_one_alone_in_every_view() {
    let mut window = courtyard();
    let mut all = window.view();
    window.select("colonnade");
    for view in ["Voxels", "Mesh", "Ghost"] {
        window.click(view);
        if view != "Voxels" {
            all = window.view();
        }
        window.press(Modifiers::SHIFT, Key::H);
        assert_changed(&all, &window.view(), view);
        window.click("Show all");
        assert_eq!(difference(&all, &window.view()), 0, "{view}");
    }
    window.click("Isolate");
    assert_eq!(window.app().settings().shot.visibility.only.len(), 1);
}

#[test]
fn the_menu_of_a_row_acts_on_its_node() {
    let mut window = courtyard();
    window.click_row("roofs", PointerButton::Secondary, 1);
    // The menu and the panel have a button each; the panel's is of no selection, and cannot be clicked.
    window.click_enabled("Hide");
    assert_eq!(window.app().settings().shot.visibility.hidden.len(), 1);
    window.select("court");
    assert_eq!(window.app().settings().shot.visibility.hidden.len(), 1, "the court is another node");
}

#[test]
fn a_selected_node_is_framed_by_key_and_double_click() {
    let mut window = courtyard();
    let before = window.view();
    window.select("court");
    window.press(Modifiers::NONE, Key::F);
    let court = window.app().settings().shot.camera;
    assert_changed(&before, &window.view(), "framing the court");
    window.click_row("roofs", PointerButton::Primary, 2);
    let roofs = window.app().settings().shot.camera;
    assert!(roofs.is_some() && roofs != court, "a double click frames");
    window.click_row("court", PointerButton::Primary, 1);
    window.click("Frame");
    let distance = window.app().settings().shot.camera.map(|camera| camera.distance());
    let again = court.map(|camera| camera.distance());
    assert!(distance.zip(again).is_some_and(|(a, b)| (a - b).abs() < 1e-9 * b), "{distance:?} {again:?}");
}

#[test]
fn a_found_node_stays_selected_and_is_unfolded_to() {
    let mut window = courtyard();
    assert_eq!(window.count("back bracket 3"), 0, "folded at first");
    window.type_into("Find", "bracket 3");
    window.select("back bracket 3");
    window.type_into("Find", "");
    assert!(window.count("back bracket 3") > 0);
    assert!(window.count("back bracket 4") > 0, "its neighbour is unfolded too");
}

#[test]
fn a_screenshot_carries_what_is_hidden() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = courtyard();
    window.type_into("Save to", &folder.path().display().to_string());
    window.select("walls");
    window.press(Modifiers::NONE, Key::H);
    window.click("Screenshot");
    let settings = read_settings(&folder.path().join("octolume-courtyard-1.png")).expect("settings");
    assert_eq!(settings.shot.visibility, window.app().settings().shot.visibility);
    assert!(!settings.shot.visibility.shows_all());
}

#[test]
fn where_nothing_is_shown_the_window_says_so_and_still_saves_pictures() {
    let folder = tempfile::tempdir().expect("a folder");
    let nodes = vec![json!({ "name": "sail", "mesh": 0 })];
    let scene = files::write(folder.path(), "boat", &[0], nodes, None);
    let mut window = Window::open(&scene.display().to_string());
    window.open_tree();
    let shown = window.view();
    window.select("sail");
    window.press(Modifiers::NONE, Key::H);
    assert_changed(&shown, &window.view(), "hiding all there is");
    window.type_into("Save to", &folder.path().display().to_string());
    window.click("Screenshot");
    let picture = image::open(folder.path().join("octolume-boat-1.png")).expect("a picture").to_rgba8();
    assert_eq!(picture.pixels().collect::<std::collections::HashSet<_>>().len(), 1, "background alone");
    window.click("Show all");
    window.outlast_notes();
    assert_eq!(difference(&shown, &window.view()), 0);
}

#[test]
fn ten_thousand_nodes_lay_out_the_rows_on_screen_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut nodes = vec![json!({ "name": "root", "children": (1..10_000).collect::<Vec<_>>() })];
    nodes.extend((1..10_000).map(|number| json!({ "name": format!("twig {number}"), "translation": [number, 0, 0] })));
    nodes[9_999]["mesh"] = json!(0);
    let scene = files::write(folder.path(), "forest", &[0], nodes, None);
    let mut window = Window::open(&scene.display().to_string());
    window.open_tree();
    let rows = |window: &Window| window.0.query_all_by_label_contains("twig ").count();
    assert_eq!(rows(&window), 0, "folded at first");
    window.select("root");
    window.press(Modifiers::NONE, Key::ArrowRight);
    assert!((10..100).contains(&rows(&window)), "{} rows", rows(&window));
    window.type_into("Find", "twig 9999");
    window.select("twig 9999");
    window.click("Isolate");
    assert_eq!(window.app().settings().shot.visibility.only, [9_999].into());
}

#[test]
fn another_scene_is_shown_whole_and_names_of_the_command_line_hide() {
    let names = NodeNames { hide: vec!["walls".to_owned()], ..NodeNames::default() };
    let mut window = Window::with(wgpu_setup(), "courtyard", small_grid(), names);
    assert_eq!(window.app().settings().shot.visibility.hidden.len(), 1);
    let folder = tempfile::tempdir().expect("a folder");
    let nodes = vec![json!({ "name": "sail", "mesh": 0 })];
    let scene = files::write(folder.path(), "boat", &[0], nodes, None);
    window.type_into("Path", &scene.display().to_string());
    window.click("Open");
    assert_eq!(window.app().settings().shot.visibility, Visibility::default());

    let mut settings = small_grid();
    settings.shot.visibility.hidden.insert(99_999);
    let mut window = Window::with(wgpu_setup(), "courtyard", settings, NodeNames::default());
    assert!(window.app().settings().shot.visibility.shows_all());
    assert!(window.log_holds("courtyard: node 99999 cannot be hidden or shown"));
}

#[test]
fn what_a_pose_leaves_out_is_logged_once_a_change() {
    let folder = tempfile::tempdir().expect("a folder");
    // A place times 1e296 is at rest zero, else infinite; the scales below undo those above.
    let scaled = |scale: f64, child: usize| json!({ "scale": [scale, scale, scale], "children": [child] });
    let mut nodes = vec![json!({ "name": "orbit", "children": [9] })];
    nodes.extend((1..=8).map(|level| scaled(1e37, if level < 8 { level + 1 } else { 0 })));
    nodes.extend((9..=16).map(|level| scaled(1e-37, level + 1)));
    nodes.extend([json!({ "name": "comet", "mesh": 0 }), json!({ "name": "earth", "mesh": 0 })]);
    let scene = files::write(folder.path(), "space", &[1, 18], nodes, Some([[0.0; 3], [3.0e38, 0.0, 0.0]]));
    let mut window = Window::open(&scene.display().to_string());
    let sentence = "object \"comet\" is left out: in this pose its matrix is not finite";
    assert_eq!(window.log_count(sentence), 0);
    for (time_secs, times) in [(1.0, 1), (0.5, 1), (0.0, 1), (1.0, 2)] {
        window.set("Time", time_secs);
        assert_eq!(window.log_count(sentence), times, "at {time_secs} s");
    }
}
