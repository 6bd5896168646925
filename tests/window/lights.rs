//! The panel "Light", and the views of light: by label, from control to setting and back.

use egui_kittest::kittest::Queryable as _;
use octolume::progress::Progress;
use octolume::scene::{LightKind, builtin, load};
use octolume::settings::lighting::{Opacity, Shadows, SunShines};
use octolume::settings::{Lighting, Lookup, Sampling, SliceAxis, SliceValue, View};

use crate::rig::Window;

/// The courtyard with the panel unfolded, and what lies above it folded.
fn window() -> Window {
    let mut window = Window::open("courtyard");
    ["Scene", "Discretization", "Filter", "View", "Light"].into_iter().for_each(|section| window.click(section));
    window
}

fn lighting(window: &Window) -> &Lighting {
    &window.app().settings().method.lighting
}

/// Where the courtyard's own camera is, through which it is looked at first.
fn eye_of_the_file() -> [f64; 3] {
    let bytes = builtin::bytes("courtyard").expect("is built in");
    let scene = load::open_bytes("courtyard", bytes, None, &Progress::default()).expect("opens");
    scene.camera_at(0, &scene.pose(scene.first_clip(), 0.0), 1.0).expect("is carried by a node").eye.to_array()
}

#[test]
fn a_light_of_the_scene_is_switched_changed_and_reset() {
    let mut window = window();
    window.click("Switch sun");
    assert!(lighting(&window).edits.values().all(|edit| !edit.on) && lighting(&window).edits.len() == 1);
    window.click("Switch sun");
    window.click("sun");
    window.set("Intensity", 250.0);
    let edit = *lighting(&window).edits.values().next().expect("an edit");
    assert!(edit.on && edit.intensity == 250.0 && edit.kind == LightKind::Directional);
    window.click("Reset light");
    assert!(lighting(&window).edits.is_empty());
    window.press(egui::Modifiers::COMMAND, egui::Key::Z);
    assert_eq!(lighting(&window).edits.len(), 1, "undo brings the edit back");
}

#[test]
fn our_own_sun_is_switched_and_turned() {
    let mut window = window();
    window.click("Own sun");
    window.click("Always");
    assert_eq!(lighting(&window).sun.shines, SunShines::Always);
    window.set("Azimuth", 90.0);
    window.set("Elevation", 30.0);
    let [x, y, z] = lighting(&window).sun.direction;
    assert!((x + 30_f64.to_radians().cos()).abs() < 1e-9 && (y + 0.5).abs() < 1e-9 && z.abs() < 1e-9, "{x} {y} {z}");
    window.click("Switch Own sun");
    assert_eq!(lighting(&window).sun.shines, SunShines::Never);
    window.click("If unlit");
    assert_eq!(lighting(&window).sun.shines, SunShines::Unlit);
}

#[test]
fn lights_are_added_at_the_camera_changed_and_removed() {
    let mut window = window();
    window.choose("Add light", "Spot light");
    let added = lighting(&window).added[0].clone();
    assert_eq!((added.name.as_str(), added.position), ("light 1", eye_of_the_file()));
    for (control, value) in [("Intensity", 40.0), ("Inner cone", 10.0), ("Outer cone", 20.0), ("Light x", 1.5)] {
        window.set(control, value);
    }
    window.click("Limited range");
    window.set("Range", 4.0);
    let added = &lighting(&window).added[0];
    assert_eq!((added.light.intensity, added.position[0]), (40.0, 1.5));
    let (inner_cone_radians, outer_cone_radians) = (10_f32.to_radians(), 20_f32.to_radians());
    assert_eq!(added.light.kind, LightKind::Spot { range: Some(4.0), inner_cone_radians, outer_cone_radians });
    window.set("Inner cone", 30.0);
    let LightKind::Spot { outer_cone_radians, .. } = lighting(&window).added[0].light.kind else { panic!("a spot") };
    assert!(outer_cone_radians > 30_f32.to_radians(), "the outer cone stays outside");
    window.choose("Kind", "point");
    assert_eq!(lighting(&window).added[0].light.kind, LightKind::POINT);
    window.type_into("Name", "lantern");
    assert_eq!(lighting(&window).added[0].name, "lantern");
    window.click("Remove light");
    assert!(lighting(&window).added.is_empty());
}

#[test]
fn sky_shadows_and_bounces_are_set() {
    let mut window = window();
    window.set("Sky", 50.0);
    assert_eq!(lighting(&window).sky_nits, [50.0; 3]);
    window.set("Emission", 2.5);
    window.choose("Map size", "512² texels");
    window.set("Offset", 3.0);
    window.click("March");
    window.click("Directional");
    window.set("Bounces", 2.0);
    window.set("Cones", 16.0);
    window.set("Aperture", 40.0);
    let set = lighting(&window);
    assert_eq!((set.emission, set.shadow_map_px, set.shadow_offset_voxels), (2.5, 512, Some(3.0)));
    assert_eq!((set.shadows, set.opacity), (Shadows::March, Opacity::Directional));
    assert_eq!((set.bounces, set.cones, set.cone_degrees), (2, 16, 40.0));
    window.click("None");
    window.click("Isotropic");
    assert_eq!((lighting(&window).shadows, lighting(&window).opacity), (Shadows::Off, Opacity::Isotropic));
}

#[test]
fn slices_shadow_maps_and_exposure_are_set() {
    let mut window = Window::open("courtyard");
    ["Scene", "Discretization", "Filter"].into_iter().for_each(|section| window.click(section));
    window.click("Slice");
    window.click("Across x");
    window.set("Height", 0.3);
    window.choose("Value", "Occupancy");
    window.choose("Sampling", "Trilinear");
    window.choose("Look-up", "Block pointers");
    window.set("Width", 4.0);
    window.click("Logarithmic");
    let look = window.app().settings().method.look;
    assert_eq!((look.view, look.slice.axis, look.slice.height), (View::Slice, SliceAxis::X, 0.3));
    assert_eq!((look.slice.value, look.slice.sampling), (SliceValue::Occupancy, Sampling::Trilinear));
    assert_eq!((look.slice.lookup, look.slice.width_cells), (Lookup::BlockPointers, 4.0));
    assert!(!look.slice.logarithmic);
    window.click("Shadow map");
    assert_eq!(window.app().settings().method.look.view, View::ShadowMap);
    window.choose("Map of", "0: sun");
    window.click("Voxels");
    window.choose("Colour", "Radiance");
    window.click("Auto exposure");
    window.set("Exposure", -3.0);
    assert_eq!(window.app().settings().method.look.exposure_stops, Some(-3.0));
    window.click("Auto exposure");
    assert_eq!(window.app().settings().method.look.exposure_stops, None);
}

#[test]
fn looking_at_settings_changes_none_of_them() {
    let mut settings = crate::rig::small_grid();
    settings.method.lighting.shadow_offset_voxels = Some(1.234_567_8);
    settings.method.lighting.cone_degrees = 33.333_333;
    settings.method.lighting.sky_nits = [1e12, 0.123_456_789, 3.0];
    settings.method.look.slice.height = 0.123_456_789;
    settings.method.look.slice.width_cells = 1.234_567_8;
    settings.method.look.view = View::Slice;
    let names = octolume::settings::NodeNames::default();
    let mut window = Window::with(crate::rig::wgpu_setup(), "courtyard", settings.clone(), names);
    assert!(window.0.query_by_label("Logarithmic").is_some());
    ["Scene", "Discretization", "Filter", "View", "Light", "Own sun", "sun"]
        .into_iter()
        .for_each(|name| window.click(name));
    assert_eq!(*lighting(&window), settings.method.lighting);
    assert_eq!(window.app().settings().method.look.slice, settings.method.look.slice);
    assert!(window.0.query_by_label("Reset light").is_some());
}
