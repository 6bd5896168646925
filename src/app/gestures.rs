//! What the mouse does: drags of the picture by a table that is read there, and the rest in words for the help.

use egui::{PointerButton, Response, Ui};

/// What a drag of the picture does to the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drag {
    Orbit,
    Pan,
}

struct DragGesture {
    button: PointerButton,
    shift: bool,
    drag: Drag,
    how: &'static str,
}

/// The first that fits counts; Shift that a gesture does not name is ignored.
const DRAGS: [DragGesture; 4] = [
    DragGesture { button: PointerButton::Primary, shift: true, drag: Drag::Pan, how: "Shift and drag" },
    DragGesture { button: PointerButton::Primary, shift: false, drag: Drag::Orbit, how: "Drag" },
    DragGesture { button: PointerButton::Secondary, shift: false, drag: Drag::Pan, how: "Drag, right button" },
    DragGesture { button: PointerButton::Middle, shift: false, drag: Drag::Pan, how: "Drag, middle button" },
];

const OTHERS: [(&str, &str); 9] = [
    ("Wheel, pinch", "comes nearer or goes away"),
    ("Double click", "looks as at first"),
    ("Alt and click", "keeps the node of the octree under the pointer, while \"Node under cursor\" is unfolded"),
    ("Drag the divider", "moves the edge between cones and paths, where both are compared by a wipe"),
    ("Drop a file", "opens a scene, or a picture or settings that were saved"),
    ("Double click in the tree", "brings the node into view"),
    ("Right click in the tree", "tells what can be done with the node"),
    ("Drag a number", "changes it; a click lets you type it"),
    ("Drag a panel's edge", "makes it wider or narrower"),
];

/// What the drag of this frame does.
pub fn drag(ui: &Ui, response: &Response) -> Option<Drag> {
    let shift = ui.input(|input| input.modifiers.shift);
    let fits = |gesture: &&DragGesture| response.dragged_by(gesture.button) && (shift || !gesture.shift);
    DRAGS.iter().find(fits).map(|gesture| gesture.drag)
}

/// Every gesture, and what it does.
pub fn all() -> impl Iterator<Item = (&'static str, &'static str)> {
    let drags = DRAGS.iter().map(|gesture| {
        let does = match gesture.drag {
            Drag::Orbit => "turns the camera around what it looks at",
            Drag::Pan => "shifts the camera",
        };
        (gesture.how, does)
    });
    drags.chain(OTHERS)
}
