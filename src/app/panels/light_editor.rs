//! The controls of one light: kind, colour, intensity, reach and cone; of ours also name, place and
//! direction.

use std::ops::RangeInclusive;

use egui::{ComboBox, Slider, TextEdit, Ui};

use super::{choice, control, named_number, number, slider};
use crate::lights::{KnownLight, LightSource};
use crate::scene::{LightKind, Scene};
use crate::settings::lighting::{AddedLight, LightEdit, Lighting, Sun, SunShines};

/// Largest intensity that can be dragged to.
const MOST: f64 = 1e9;

pub struct Editor<'a> {
    pub known: &'a KnownLight,
    pub scene: &'a Scene,
}

impl Editor<'_> {
    /// Writes what is changed to the settings.
    pub fn ui(&self, ui: &mut Ui, lighting: &mut Lighting) {
        match self.known.source {
            LightSource::Sun => sun_ui(ui, &mut lighting.sun),
            LightSource::Node(node) => {
                let mut light = self.known.light;
                let carried = self.scene.nodes.get(node).map_or("", |node| node.name.as_str());
                let text = format!("{} of \"{carried}\"", light.kind.name());
                control(ui, "Kind", "Place and direction are those of its node.", |ui| {
                    ui.add(egui::Label::new(text).truncate())
                });
                light_ui(ui, &mut light);
                if light != self.known.light {
                    lighting.edits.insert(node, light);
                }
            }
            LightSource::Added(index) => {
                if let Some(added) = lighting.added.get_mut(index) {
                    added_ui(ui, added);
                }
            }
        }
    }
}

fn sun_ui(ui: &mut Ui, sun: &mut Sun) {
    let shines = [
        (SunShines::Unlit, "If unlit", "Where the scene has no lights, and nothing in it emits."),
        (SunShines::Always, "Always", "Beside whatever lights the scene has."),
        (SunShines::Never, "Never", "A scene without lights stays dark."),
    ];
    choice(ui, "Shines", "When our own sun shines.", &mut sun.shines, &shines);
    color_ui(ui, "Light colour", &mut sun.color);
    intensity_ui(ui, &mut sun.illuminance_lux, "lx");
    direction_ui(ui, &mut sun.direction);
}

fn added_ui(ui: &mut Ui, added: &mut AddedLight) {
    control(ui, "Name", "What the light is called.", |ui| {
        ui.add(TextEdit::singleline(&mut added.name).desired_width(140.0))
    });
    let mut kind = added.light.kind;
    control(ui, "Kind", "Directional lights have no place, point lights no direction.", |ui| {
        let combo = ComboBox::from_id_salt("kind of light").width(110.0).selected_text(kind.name());
        let kinds = [LightKind::Directional, LightKind::POINT, LightKind::SPOT];
        let list = combo.show_ui(ui, |ui| {
            for other in kinds {
                let is_same = std::mem::discriminant(&kind) == std::mem::discriminant(&other);
                if ui.selectable_label(is_same, other.name()).clicked() && !is_same {
                    kind = other;
                }
            }
        });
        list.response
    });
    if kind != added.light.kind {
        // Lux say nothing about candela: the light begins anew, in its colour.
        added.light = LightEdit { on: added.light.on, color: added.light.color, ..LightEdit::new(kind) };
    }
    light_ui(ui, &mut added.light);
    if kind != LightKind::Directional {
        position_ui(ui, &mut added.position);
    }
    if !matches!(kind, LightKind::Point { .. }) {
        direction_ui(ui, &mut added.direction);
    }
}

fn light_ui(ui: &mut Ui, light: &mut LightEdit) {
    color_ui(ui, "Light colour", &mut light.color);
    intensity_ui(ui, &mut light.intensity, short_unit(light.kind));
    match &mut light.kind {
        LightKind::Directional => {}
        LightKind::Point { range } => range_ui(ui, range),
        LightKind::Spot { range, inner_cone_radians, outer_cone_radians } => {
            range_ui(ui, range);
            cone_ui(ui, inner_cone_radians, outer_cone_radians);
        }
    }
}

/// Linear RGB; the picker shows and sets channels up to 1.
pub fn color_ui(ui: &mut Ui, name: &str, color: &mut [f64; 3]) {
    let mut shown = color.map(|channel| channel as f32);
    let tip = "Linear red, green and blue, which the intensity multiplies.";
    if control(ui, name, tip, |ui| ui.color_edit_button_rgb(&mut shown)).changed() {
        *color = shown.map(f64::from);
    }
}

/// A number from 0 that may have any size.
fn intensity_ui(ui: &mut Ui, intensity: &mut f64, unit: &str) {
    let tip = "Illuminance in lux of directional lights, intensity in candela of point and spot lights.";
    amount_ui(ui, "Intensity", tip, intensity, unit);
}

/// A number from 0 whose size says how fast it is dragged.
pub fn amount_ui(ui: &mut Ui, name: &str, tip: &str, value: &mut f64, unit: &str) {
    let drag = number(value, 0.0..=MOST).max_decimals(3).suffix(format!(" {unit}"));
    control(ui, name, tip, |ui| ui.add(drag));
}

fn range_ui(ui: &mut Ui, range: &mut Option<f32>) {
    /// Where a reach begins that was unlimited.
    const FIRST: f32 = 10.0;
    let tip = "How far it reaches, in scene units: it fades to nothing there.";
    let mut is_limited = range.is_some();
    let mut reach = range.unwrap_or(FIRST);
    control(ui, "Range", tip, |ui| {
        let response = ui.add_enabled(is_limited, number(&mut reach, 1e-6..=1e9));
        ui.checkbox(&mut is_limited, "Limited range").on_hover_text("Without, it reaches as far as it goes.");
        response
    });
    *range = is_limited.then_some(reach);
}

/// An angle in degrees.
pub fn angle<N: egui::emath::Numeric>(value: &mut N, range: RangeInclusive<N>) -> Slider<'_> {
    slider(value, range).max_decimals(1).suffix("°")
}

/// Half angles; the outer one stays above the inner one.
fn cone_ui(ui: &mut Ui, inner_radians: &mut f32, outer_radians: &mut f32) {
    const LEAST_GAP_DEGREES: f32 = 0.1;
    let [mut inner, mut outer] = [inner_radians.to_degrees(), outer_radians.to_degrees()];
    let tip = "Half angle up to which the light is full.";
    if control(ui, "Inner cone", tip, |ui| ui.add(angle(&mut inner, 0.0..=90.0 - LEAST_GAP_DEGREES))).changed() {
        *inner_radians = inner.to_radians();
        *outer_radians = outer_radians.max((inner + LEAST_GAP_DEGREES).min(90.0).to_radians());
    }
    let tip = "Half angle at which the light ends.";
    if control(ui, "Outer cone", tip, |ui| ui.add(angle(&mut outer, LEAST_GAP_DEGREES..=90.0))).changed() {
        *outer_radians = outer.to_radians();
        *inner_radians = inner_radians.min((outer - LEAST_GAP_DEGREES).max(0.0).to_radians());
    }
}

fn position_ui(ui: &mut Ui, position: &mut [f64; 3]) {
    control(ui, "Position", "In scene units, in the world.", |ui| {
        let row = ui.horizontal(|ui| {
            for (coordinate, name) in position.iter_mut().zip(["Light x", "Light y", "Light z"]) {
                let response = ui.add(number(coordinate, -1e15..=1e15).max_decimals(3));
                named_number(&response, *coordinate, name);
            }
        });
        row.response
    });
}

/// As where the light comes from: elevation above the horizon, azimuth about +y, from +z to +x.
fn direction_ui(ui: &mut Ui, direction: &mut [f64; 3]) {
    let [mut azimuth, mut elevation] = angles_degrees(*direction);
    let tip = "The side the light comes from, about the vertical axis: 0 is +z, 90 is +x.";
    let turned = control(ui, "Azimuth", tip, |ui| ui.add(angle(&mut azimuth, -180.0..=180.0))).changed();
    let tip = "How high above the horizon the light comes from: 90 is straight down.";
    let raised = control(ui, "Elevation", tip, |ui| ui.add(angle(&mut elevation, -90.0..=90.0))).changed();
    if turned || raised {
        *direction = direction_from([azimuth, elevation]);
    }
}

/// Azimuth and elevation of where light comes from that goes along `direction`.
fn angles_degrees(direction: [f64; 3]) -> [f64; 2] {
    let [x, y, z] = (-glam::DVec3::from_array(direction)).normalize_or(glam::DVec3::Y).to_array();
    [x.atan2(z).to_degrees(), y.clamp(-1.0, 1.0).asin().to_degrees()]
}

/// Straight down, the azimuth survives in what rounding leaves of the horizontal part.
fn direction_from([azimuth, elevation]: [f64; 2]) -> [f64; 3] {
    let (sin, cos) = elevation.to_radians().sin_cos();
    let (across, along) = azimuth.to_radians().sin_cos();
    [-cos * across, -sin, -cos * along]
}

pub fn short_unit(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Directional => "lx",
        LightKind::Point { .. } | LightKind::Spot { .. } => "cd",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_and_angles_are_inverse_also_at_the_zenith() {
        for (azimuth, elevation) in [(0.0, 0.0), (90.0, 30.0), (-135.0, -60.0), (45.0, 90.0), (170.0, -90.0)] {
            let back = angles_degrees(direction_from([azimuth, elevation]));
            assert!(
                (back[0] - azimuth).abs() < 1e-6 && (back[1] - elevation).abs() < 1e-6,
                "{azimuth} {elevation} {back:?}"
            );
        }
        let from_above = direction_from([0.0, 90.0]);
        assert!(from_above[1] == -1.0);
        let [x, y, z] = direction_from([90.0, 0.0]);
        assert!(x == -1.0 && y == 0.0 && z.abs() < 1e-15, "from +x it shines along -x");
        assert_eq!(angles_degrees([0.0, -3.0, 0.0])[1], 90.0);
    }
}
