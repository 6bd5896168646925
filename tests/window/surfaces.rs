//! The view of lit surfaces and the panel "Cone tracing": by label, from control to setting and back.

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use octolume::settings::{ConeTracing, Lookup, NodeNames, Sampling, SurfaceView, ToneCurve, View};

use crate::rig::{Window, small_grid, wgpu_setup};

/// The courtyard with the view of surfaces, and what lies above the panel folded.
fn window() -> Window {
    let mut settings = small_grid();
    settings.method.look.view = View::Surfaces;
    let mut window = Window::with(wgpu_setup(), "courtyard", settings, NodeNames::default());
    ["Scene", "Discretization", "Filter"].into_iter().for_each(|section| window.click(section));
    window
}

fn cones(window: &Window) -> ConeTracing {
    window.app().settings().method.cone_tracing
}

fn can_be_used(window: &Window, label: &str) -> bool {
    let controls =
        window.0.get_all_by_label(label).filter(|node| node.accesskit_node().role() != egui::accesskit::Role::Label);
    controls.into_iter().all(|node| !node.accesskit_node().is_disabled())
}

#[test]
fn parts_and_tone_curves_are_chosen() {
    let mut window = Window::open("courtyard");
    window.click("Surfaces");
    assert_eq!(window.app().settings().method.look.view, View::Surfaces);
    let parts = [
        ("Direct", SurfaceView::Direct),
        ("Diffuse", SurfaceView::Diffuse),
        ("Specular", SurfaceView::Specular),
        ("Occlusion", SurfaceView::Ao),
        ("Irradiance", SurfaceView::Irradiance),
        ("Albedo", SurfaceView::Albedo),
        ("Normal", SurfaceView::Normal),
        ("Depth", SurfaceView::Depth),
        ("Roughness", SurfaceView::Roughness),
        ("Final", SurfaceView::Final),
    ];
    for (name, part) in parts {
        window.choose("Part", name);
        assert_eq!(window.app().settings().method.look.surface, part);
        let is_toned = window.0.query_by_label("Reinhard").is_some();
        assert_eq!((is_toned, window.0.query_by_label("Auto exposure").is_some()), (part.is_light(), part.is_light()));
    }
    for (name, curve) in [("Reinhard", ToneCurve::Reinhard), ("Linear", ToneCurve::Linear), ("Film", ToneCurve::Aces)] {
        window.click(name);
        assert_eq!(window.app().settings().method.look.tone_curve, curve);
    }
    window.click("Auto exposure");
    window.set("Exposure", -3.0);
    assert_eq!(window.app().settings().method.look.exposure_stops, Some(-3.0));
}

#[test]
fn cones_are_counted_widened_and_placed() {
    let mut window = window();
    window.click("Cone tracing");
    for (control, value) in [("Cones", 9.0), ("Aperture", 45.0), ("Start", 2.5), ("Step", 0.5), ("Glossy to", 0.25)] {
        window.set(control, value);
    }
    window.click("2 × 2");
    window.choose("Sampling", "Trilinear");
    window.choose("Look-up", "Block pointers");
    window.choose("Traced at", "1280 × 720 px");
    window.click("Half resolution");
    let expected = ConeTracing {
        cones: 9,
        cone_degrees: 45.0,
        start_voxels: 2.5,
        step_diameters: 0.5,
        glossy_roughness: 0.25,
        pattern_px: 2,
        sampling: Sampling::Trilinear,
        lookup: Lookup::BlockPointers,
        indirect_px: Some(ConeTracing::PAPER_INDIRECT_PX),
        half_resolution: false,
        ..ConeTracing::default()
    };
    assert_eq!(cones(&window), expected);
    window.press(egui::Modifiers::COMMAND, egui::Key::Z);
    assert!(cones(&window) != expected, "undo takes back the last of it");
}

#[test]
fn what_has_no_effect_cannot_be_set() {
    let mut window = window();
    window.click("Cone tracing");
    assert!(!can_be_used(&window, "Occlusion"), "diffuse cones tell it");
    assert!(!can_be_used(&window, "Reach"));
    window.click("Diffuse");
    assert!(!can_be_used(&window, "Cones") && can_be_used(&window, "Start"), "the specular cone steps too");
    window.click("Occlusion");
    assert!(can_be_used(&window, "Cones") && can_be_used(&window, "Auto reach"));
    window.click("Auto reach");
    window.set("Reach", 1.5);
    assert_eq!(cones(&window).occlusion_distance, Some(1.5));
    window.click("Auto reach");
    assert_eq!(cones(&window).occlusion_distance, None);
    window.click("Occlusion");
    window.click("Specular");
    for control in ["Cones", "Start", "Half resolution", "Glossy to"] {
        assert!(!can_be_used(&window, control), "{control}");
    }
}

#[test]
fn looking_at_cones_changes_none_of_them() {
    let mut settings = small_grid();
    settings.method.look.view = View::Surfaces;
    settings.method.cone_tracing.cone_degrees = 33.333_333;
    settings.method.cone_tracing.step_diameters = 1.234_567_8;
    settings.method.cone_tracing.occlusion_distance = Some(1e-9);
    settings.method.cone_tracing.indirect_px = Some([333, 111]);
    let set = settings.method.cone_tracing;
    let mut window = Window::with(wgpu_setup(), "courtyard", settings, NodeNames::default());
    ["Scene", "Discretization", "Filter", "Cone tracing"].into_iter().for_each(|section| window.click(section));
    assert!(window.0.query_all_by_label("Half resolution").next().is_some());
    assert_eq!(cones(&window), set);
}
