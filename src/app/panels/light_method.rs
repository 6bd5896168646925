//! Light that comes from no lamp, and how light is computed: sky, emission, shadows, opacity, bounces.

use egui::{ComboBox, Ui};

use super::light_editor::{amount_ui, angle, color_ui};
use super::{choice, control, slider};
use crate::settings::lighting::{Lighting, Opacity, Shadows};

pub fn ui(ui: &mut Ui, lighting: &mut Lighting) {
    sky_ui(ui, &mut lighting.sky_nits);
    let tip = "Multiplies what emissive surfaces emit; 0 switches it off.";
    amount_ui(ui, "Emission", tip, &mut lighting.emission, "×");
    shadows_ui(ui, lighting);
    let opacities = [
        (
            Opacity::Isotropic,
            "Isotropic",
            "The occupied share of a node's volume, whatever the direction: the paper's way.",
        ),
        (Opacity::Directional, "Directional", "Along each axis by itself, so that a thin wall stays a wall."),
    ];
    choice(ui, "Opacity", "What an inner node stops of the light that passes it.", &mut lighting.opacity, &opacities);
    let tip = "How often light goes on from voxel to voxel; 0 is direct light alone.";
    control(ui, "Bounces", tip, |ui| {
        ui.add(slider(&mut lighting.bounces, 0..=Lighting::MAX_BOUNCES).logarithmic(true))
    });
    let gathers = lighting.bounces > 0 || lighting.sky_nits != [0.0; 3];
    ui.add_enabled_ui(gathers, |ui| {
        let tip = "Cones a voxel sends out for sky and bounces; every one costs the same time.";
        control(ui, "Cones", tip, |ui| ui.add(slider(&mut lighting.cones, 1..=Lighting::MAX_CONES).logarithmic(true)));
        let tip = "Full apex angle of those cones: wide ones are fast and blurred, and leak.";
        control(ui, "Aperture", tip, |ui| ui.add(angle(&mut lighting.cone_degrees, Lighting::CONE_DEGREES)));
    });
}

/// One radiance and a colour whose largest channel is 1. A black sky has no colour to keep.
fn sky_ui(ui: &mut Ui, sky_nits: &mut [f64; 3]) {
    let before = sky_nits.iter().copied().fold(0.0, f64::max);
    let mut radiance = before;
    let tip = "Radiance that comes from every direction, in nits; a clear blue sky has some thousand.";
    amount_ui(ui, "Sky", tip, &mut radiance, "nits");
    if radiance != before {
        *sky_nits = if before > 0.0 { sky_nits.map(|channel| channel / before * radiance) } else { [radiance; 3] };
    }
    ui.add_enabled_ui(radiance > 0.0, |ui| {
        let scale = radiance.max(f64::MIN_POSITIVE);
        let shown = sky_nits.map(|channel| channel / scale);
        let mut color = shown;
        color_ui(ui, "Sky colour", &mut color);
        let brightest = color.iter().copied().fold(0.0, f64::max);
        if color != shown && brightest > 0.0 {
            *sky_nits = color.map(|channel| channel / brightest * radiance);
        }
    });
}

fn shadows_ui(ui: &mut Ui, lighting: &mut Lighting) {
    let ways = [
        (Shadows::Map, "Map", "A shadow map of the posed triangles, one a light and pose."),
        (Shadows::March, "March", "A march through the octree towards the light; needs no triangles."),
        (Shadows::Off, "None", "Every light reaches everything."),
    ];
    choice(ui, "Shadows", "How a voxel learns whether a light reaches it.", &mut lighting.shadows, &ways);
    ui.add_enabled_ui(lighting.shadows == Shadows::Map, |ui| {
        let tip = "Texels along an edge of a shadow map; half as many on the six faces around a point light.";
        control(ui, "Map size", tip, |ui| {
            let text = |px: u32| format!("{px}² texels");
            let combo = ComboBox::from_id_salt("shadow map").width(110.0).selected_text(text(lighting.shadow_map_px));
            let list = combo.show_ui(ui, |ui| {
                for px in Lighting::SHADOW_MAPS_PX {
                    ui.selectable_value(&mut lighting.shadow_map_px, px, text(px));
                }
            });
            list.response
        });
    });
    ui.add_enabled_ui(lighting.shadows != Shadows::Off, |ui| {
        let tip = "How far above its surface a voxel looks for what hides the light, in voxels: less shows every \
                   step of the voxels, more lets light under thin things.";
        control(ui, "Offset", tip, |ui| {
            // Beside the box, within the width of the other rows: a wider panel would push the picture aside.
            ui.spacing_mut().slider_width -= 60.0;
            let mut automatic = lighting.shadow_offset_voxels.is_none();
            let mut offset = lighting.offset_voxels();
            let response = ui.add(slider(&mut offset, Lighting::SHADOW_OFFSETS_VOXELS).max_decimals(2));
            automatic &= !response.changed();
            ui.checkbox(&mut automatic, "Auto").on_hover_text("The offset that errs least against rays.");
            if response.changed() || automatic != lighting.shadow_offset_voxels.is_none() {
                lighting.shadow_offset_voxels = (!automatic).then_some(offset);
            }
            response
        });
    });
}
