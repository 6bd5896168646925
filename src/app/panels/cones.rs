//! How cones light the surfaces that the camera sees (section 4.5): which are traced, how many, how wide,
//! and at which size of picture.

use egui::Ui;

use super::light_editor::angle;
use super::slice::{lookup_ui, sampling_ui};
use super::{choice, control, list, nothing, number, slider, unless};
use crate::app::command::Command;
use crate::settings::{ConeTracing, Look, SurfaceView, View};

const NO_CONES: &str = "No cone is traced.";
const NO_DIFFUSE: &str = "No diffuse cone is traced.";

/// What there is to change, and what it depends on.
#[derive(Clone, Copy)]
pub struct ConesPanel<'a> {
    pub cones: &'a ConeTracing,
    pub look: &'a Look,
    /// Beyond which nothing occludes, where no distance is set; scene units.
    pub occlusion_distance: f64,
}

pub fn ui(ui: &mut Ui, panel: ConesPanel<'_>) -> Vec<Command> {
    let mut cones = *panel.cones;
    if panel.look.view != View::Surfaces {
        nothing(ui, "The view \"Surfaces\" shows what cones bring.");
    }
    let shows_occlusion = panel.look.surface == SurfaceView::Ao;
    traced_ui(ui, &mut cones);
    let any_diffuse = cones.diffuse || cones.ambient_occlusion || shows_occlusion;
    let no_diffuse = (!any_diffuse).then_some(NO_DIFFUSE);
    let none = (!any_diffuse && !cones.specular).then_some(NO_CONES);
    unless(ui, no_diffuse, |ui| diffuse_ui(ui, &mut cones));
    unless(ui, none, |ui| march_ui(ui, &mut cones));
    let is_guessed = shows_occlusion || cones.ambient_occlusion && !cones.diffuse;
    let no_occlusion =
        (!is_guessed).then_some("Occlusion is neither shown nor asked for in the place of diffuse light.");
    unless(ui, no_occlusion, |ui| occlusion_ui(ui, &mut cones.occlusion_distance, panel.occlusion_distance));
    unless(ui, none, |ui| size_ui(ui, &mut cones));
    let tip = "Rougher surfaces than this take what their diffuse cones see for their reflection.";
    unless(ui, (!cones.specular).then_some("The specular cone is off."), |ui| {
        control(ui, "Glossy to", tip, |ui| ui.add(slider(&mut cones.glossy_roughness, 0.0..=1.0).max_decimals(2)));
    });
    if cones == *panel.cones { Vec::new() } else { vec![Command::TraceCones(cones)] }
}

fn traced_ui(ui: &mut Ui, cones: &mut ConeTracing) {
    control(ui, "Trace", "Which cones a surface sends out.", |ui| {
        let row = ui.horizontal(|ui| {
            ui.checkbox(&mut cones.diffuse, "Diffuse")
                .on_hover_text("Cones all over the hemisphere bring the light of other surfaces and of the sky.");
            ui.checkbox(&mut cones.specular, "Specular")
                .on_hover_text("One cone where it reflects, as wide as it is rough, where a surface is glossy.");
        });
        row.response
    });
    // A row of its own: a wider panel would push the picture aside.
    unless(ui, cones.diffuse.then_some("Diffuse cones tell what is occluded already."), |ui| {
        let tip = "Without diffuse light: the sky's light, darkened by what is near.";
        // Named by itself, not by the empty name of its row.
        control(ui, "", tip, |ui| ui.horizontal(|ui| ui.checkbox(&mut cones.ambient_occlusion, "Occlusion")).response);
    });
}

fn diffuse_ui(ui: &mut Ui, cones: &mut ConeTracing) {
    let tip = "Diffuse cones of a pixel; every one costs the same time.";
    control(ui, "Cones", tip, |ui| ui.add(slider(&mut cones.cones, 1..=ConeTracing::MAX_CONES).logarithmic(true)));
    let patterns = [
        (1, "1 × 1", "Every pixel sends out the same cones, and keeps them to itself."),
        (2, "2 × 2", "Four pixels share a set of four times as many cones."),
        (4, "4 × 4", "Sixteen pixels share a set of sixteen times as many cones."),
    ];
    choice(
        ui,
        "Pattern",
        "Pixels that share a set of cones, each tracing its part of it.",
        &mut cones.pattern_px,
        &patterns,
    );
    let tip = "Full apex angle of a diffuse cone: wide ones are fast and blurred, and leak.";
    control(ui, "Aperture", tip, |ui| ui.add(angle(&mut cones.cone_degrees, ConeTracing::CONE_DEGREES)));
}

fn march_ui(ui: &mut Ui, cones: &mut ConeTracing) {
    let tip = "From a surface along its normal to the apex of a cone, in voxels: less darkens surfaces by themselves, \
               more misses what is near.";
    control(ui, "Start", tip, |ui| ui.add(slider(&mut cones.start_voxels, ConeTracing::START_VOXELS).max_decimals(2)));
    let tip = "Length of a step in diameters of the cone.";
    control(ui, "Step", tip, |ui| {
        ui.add(slider(&mut cones.step_diameters, ConeTracing::STEP_DIAMETERS).max_decimals(3))
    });
    sampling_ui(ui, &mut cones.sampling);
    lookup_ui(ui, &mut cones.lookup);
}

/// `unset`: the distance where none is set.
fn occlusion_ui(ui: &mut Ui, distance: &mut Option<f64>, unset: f64) {
    let tip = "What is farther away occludes nothing; scene units.";
    let mut automatic = distance.is_none();
    let mut value = distance.unwrap_or(unset);
    control(ui, "Reach", tip, |ui| {
        let response = ui.add_enabled(!automatic, number(&mut value, 1e-6..=1e15).max_decimals(4));
        ui.checkbox(&mut automatic, "Auto reach").on_hover_text("An eighth of the grid.");
        response
    });
    *distance = (!automatic).then_some(value);
}

fn size_ui(ui: &mut Ui, cones: &mut ConeTracing) {
    let name =
        |size_px: Option<[u32; 2]>| size_px.map_or("as the picture".to_owned(), |[w, h]| format!("{w} × {h} px"));
    // What settings from elsewhere ask for stays to be chosen.
    let mut sizes = vec![None, Some(ConeTracing::PAPER_INDIRECT_PX)];
    sizes.extend((!sizes.contains(&cones.indirect_px)).then_some(cones.indirect_px));
    let names: Vec<String> = sizes.iter().map(|size_px| name(*size_px)).collect();
    let tip = "Largest picture whose every pixel sends out cones.";
    let options: Vec<_> = sizes.into_iter().zip(&names).map(|(size_px, name)| (size_px, name.as_str(), tip)).collect();
    list(
        ui,
        "Traced at",
        "Larger pictures take cones from neighbours; the paper has 1280 × 720.",
        &mut cones.indirect_px,
        &options,
    );
    ui.checkbox(&mut cones.half_resolution, "Half resolution").on_hover_text(
        "Diffuse cones at half the size along each side; a filter that knows depth and normals fills in.",
    );
}
