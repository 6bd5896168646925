//! The panel "Node under cursor": what lies under the pointer, its pointers followed and drawn.

use egui::{Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable as _;

use crate::rig::{Window, assert_changed, difference};

/// The courtyard with the panel unfolded, and what lies above it folded.
fn window() -> Window {
    let mut window = Window::open("courtyard");
    ["Timings", "Node under cursor"].into_iter().for_each(|section| window.click(section));
    window
}

/// Level and cell of the node looked at.
fn place(window: &Window) -> (u32, [u32; 3]) {
    let text = window.0.get_by_label_contains(", key ").value().expect("a place");
    let text = text.strip_prefix("level ").expect("a level");
    let (level, rest) = text.split_once(", cell ").expect("a cell");
    let (cell, _) = rest.split_once(", key").expect("a key");
    let cell: Vec<u32> = cell.split(',').map(|number| number.parse().expect("a number")).collect();
    (level.parse().expect("a number"), cell.try_into().expect("three"))
}

fn hover(window: &mut Window, at: Pos2) {
    window.0.hover_at(at);
    window.settle();
}

fn alt_click(window: &mut Window, pos: Pos2) {
    let modifiers = Modifiers::ALT;
    window.0.hover_at(pos);
    window.0.step();
    for pressed in [true, false] {
        let event = egui::Event::PointerButton { pos, button: egui::PointerButton::Primary, pressed, modifiers };
        window.0.event_modifiers(event, modifiers);
    }
    window.0.step();
    window.settle();
}

#[test]
fn the_node_under_the_pointer_is_told_and_stays_when_pinned() {
    let mut window = window();
    assert!(window.0.query_by_label_contains(", key ").is_none(), "nothing is pointed at");
    let middle = window.view_rect().center();
    hover(&mut window, middle);
    let first = place(&window);
    assert_eq!(first.0, 6, "a leaf");
    hover(&mut window, middle + vec2(120.0, 60.0));
    let second = place(&window);
    assert_ne!(first, second);
    alt_click(&mut window, middle);
    assert_eq!(place(&window), first);
    hover(&mut window, middle + vec2(120.0, 60.0));
    assert_eq!(place(&window), first, "it is pinned");
    window.click("Release");
    hover(&mut window, middle + vec2(121.0, 60.0));
    assert_ne!(place(&window), first);
    window.set("Level", 3.0);
    hover(&mut window, middle);
    assert_eq!(place(&window).0, 3, "nodes of the level that is shown");
}

#[test]
fn pointers_are_followed_and_drawn() {
    let mut window = window();
    let middle = window.view_rect().center();
    alt_click(&mut window, middle);
    assert!(window.0.query_by_role_and_label(egui::Role::Link, "Ahead x").is_none(), "no pointers are stored");
    assert!(window.count("not stored") >= 2, "pointers that leave the block, and radiance");
    assert_eq!(window.count("none"), 2, "the scene has no warnings, and a leaf no child");
    let plain = window.view();
    window.click("Draw pointers");
    assert!(window.app().settings().method.look.pointers);
    assert_eq!(window.count("not stored"), 1, "radiance, as no light is shown");
    assert_changed(&plain, &window.view(), "drawing pointers");
    let (level, cell) = place(&window);
    window.click("Above");
    assert_eq!(place(&window), (level - 1, cell.map(|c| c / 2)));
    let above = cell.map(|c| c / 2);
    window.click("Ahead y");
    assert_eq!(place(&window), (level - 1, [above[0], above[1] + 1, above[2]]));
    window.click("Back");
    window.click("First child");
    assert_eq!(place(&window), (level, above.map(|c| 2 * c)));
    ["Back", "Back"].into_iter().for_each(|back| window.click(back));
    assert_eq!(place(&window), (level, cell));
    window.click("Draw pointers");
    assert_eq!(difference(&plain, &window.view()), 0, "nothing is left of it");
}
