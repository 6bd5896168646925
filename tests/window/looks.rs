//! How the window looks and behaves at its edges: help, narrow windows, colours, quick clicks, rows that stay in place.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Theme, ThemePreference, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use octolume::settings::View;

use crate::rig::{Window, assert_changed, difference, small_grid, wgpu_setup};

fn sized(width: f32, height: f32) -> Window {
    Window::sized(wgpu_setup(), "courtyard", small_grid(), vec2(width, height))
}

/// Where what can be used lies, inside this part of the window.
fn controls(window: &Window, within: Rect) -> Vec<(String, Rect)> {
    let can_be_used = [Role::Button, Role::CheckBox, Role::ComboBox, Role::Slider, Role::SpinButton];
    let nodes = can_be_used.into_iter().flat_map(|role| window.0.query_all_by_role(role));
    let placed = nodes.map(|node| (node.accesskit_node().label().unwrap_or_default(), node.rect()));
    placed.filter(|(_, rect)| within.contains(rect.center())).collect()
}

#[track_caller]
fn assert_apart(controls: &[(String, Rect)]) {
    for (index, (name, rect)) in controls.iter().enumerate() {
        // A slider and its number have one name.
        for (other, other_rect) in controls[index + 1..].iter().filter(|(other, _)| other != name) {
            let overlap = rect.shrink(1.0).intersect(other_rect.shrink(1.0));
            assert!(!overlap.is_positive(), "{name} {rect} lies over {other} {other_rect}");
        }
    }
}

#[test]
fn help_lists_keys_and_gestures_and_goes_away() {
    let mut window = Window::open("courtyard");
    let listed =
        |window: &Window| ["Ctrl+Shift+Z", "F1", "Alt+H", "Drag, middle button"].map(|name| window.count(name));
    assert_eq!(listed(&window), [0; 4]);
    window.press(Modifiers::NONE, Key::F1);
    assert_eq!(listed(&window), [1; 4]);
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(listed(&window), [0; 4]);
    window.press(Modifiers::SHIFT, Key::Questionmark);
    assert_eq!(listed(&window), [1; 4]);
    window.click("Help");
    assert_eq!(listed(&window), [0; 4]);
}

#[test]
fn narrow_windows_fold_panels_and_leave_room_for_the_picture() {
    let mut window = sized(1440.0, 900.0);
    let shown = |window: &Window| ["Filter", "Timings"].map(|section| window.0.query_by_label(section).is_some());
    for (width, expected) in
        [(1440.0, [true, true]), (1000.0, [true, false]), (640.0, [false, false]), (1440.0, [true, true])]
    {
        window.0.set_size(vec2(width, 400.0));
        window.settle();
        assert_eq!(shown(&window), expected, "{width}");
    }
    window.0.set_size(vec2(640.0, 400.0));
    window.settle();
    for panel in ["Controls", "Tree", "Measurements"] {
        window.click(panel);
        let view = window.view_rect();
        assert!(view.width() >= 180.0 && view.height() >= 300.0, "{panel}: {view}");
    }
    assert_eq!(shown(&window), [false, true], "the last one unfolded stays");
}

#[test]
fn nothing_overlaps_in_the_smallest_window() {
    let window = sized(640.0, 400.0);
    let bar = controls(&window, Rect::from_min_size(Pos2::ZERO, vec2(640.0, 34.0)));
    assert!(bar.len() >= 5, "{bar:?}");
    assert_apart(&bar);
    assert!(bar.iter().all(|(_, rect)| rect.left() >= 0.0 && rect.right() <= 640.0), "{bar:?}");
    let timeline = controls(&window, Rect::from_min_size(Pos2::new(0.0, 364.0), vec2(640.0, 36.0)));
    assert!(timeline.len() >= 5, "{timeline:?}");
    assert_apart(&timeline);
}

#[test]
fn what_a_narrow_bar_has_no_room_for_is_in_its_menu() {
    let mut window = sized(640.0, 400.0);
    window.click("Menu");
    for name in ["Undo", "Redo", "Screenshot", "Dark colours", "Light colours"] {
        assert!(window.0.query_all_by_label(name).count() > 0, "{name}");
    }
}

#[test]
fn light_colours_are_chosen_and_leave_the_picture_alone() {
    let mut window = Window::open("courtyard");
    let (view, ctx) = (window.view(), window.0.ctx.clone());
    assert_eq!(ctx.theme(), Theme::Dark);
    let panel = |window: &mut Window| window.0.render().expect("a picture of the window").get_pixel(280, 300).0;
    assert!(panel(&mut window)[0] < 60);
    window.click("Menu");
    window.click("Light colours");
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(ctx.options(|options| options.theme_preference), ThemePreference::Light);
    assert!(panel(&mut window)[0] > 200);
    assert_eq!(difference(&view, &window.view()), 0);
}

#[test]
fn a_click_within_one_frame_sets_a_slider() {
    let mut window = Window::open("courtyard");
    let rect = window.0.get_by_role_and_label(Role::Slider, "Level").rect();
    let pos = Pos2::new(rect.left() + 40.0, rect.center().y);
    window.0.hover_at(pos);
    window.0.step();
    let press =
        |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
    window.0.input_mut().events.extend([press(true), press(false)]);
    window.settle();
    let level = window.app().settings().method.look.level;
    assert!(level.is_some_and(|level| level < 5), "{level:?}");
}

#[test]
fn a_scene_without_light_says_why_it_has_no_shadow_map() {
    let mut window = Window::open("courtyard");
    window.click("Shadow map");
    let map = window.view();
    window.click("Light");
    window.click("Switch sun");
    assert_eq!(window.app().settings().method.look.view, View::ShadowMap);
    assert_changed(&map, &window.view(), "switching the only light off");
}

#[test]
fn measuring_moves_no_row() {
    let mut window = Window::open("courtyard");
    let place = |window: &Window| window.0.get_by_label("Measure both filters").rect();
    let before = place(&window);
    window.0.get_by_label("Measure both filters").click();
    for _ in 0..8 {
        window.0.step();
        assert_eq!(place(&window), before, "while it is on its way");
    }
    window.settle();
    assert_eq!(place(&window), before, "measured");
}
