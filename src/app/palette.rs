//! The colours of panels, dark and light: every text is legible on every ground it lies on.

use egui::{Color32, Theme, Ui};

pub struct Palette {
    /// Behind everything, and of what is typed into.
    pub sunken: Color32,
    pub panel: Color32,
    /// Every second row of a table.
    pub faint: Color32,
    pub control: Color32,
    pub hovered: Color32,
    pub selected: Color32,
    pub line: Color32,
    pub text: Color32,
    pub strong: Color32,
    pub weak: Color32,
    pub accent: Color32,
    pub warning: Color32,
    pub error: Color32,
    hole: Color32,
    spill: Color32,
    joint: Color32,
    camera: Color32,
    light: Color32,
    /// Along x, y and z.
    pub axes: [Color32; 3],
}

const fn rgb(r: u8, g: u8, b: u8) -> Color32 {
    Color32::from_rgb(r, g, b)
}

pub const DARK: Palette = Palette {
    sunken: rgb(17, 19, 22),
    panel: rgb(25, 27, 31),
    faint: rgb(30, 33, 38),
    control: rgb(43, 47, 54),
    hovered: rgb(56, 62, 71),
    selected: rgb(24, 92, 86),
    line: rgb(46, 50, 57),
    text: rgb(206, 211, 218),
    strong: rgb(240, 243, 247),
    weak: rgb(137, 145, 156),
    accent: rgb(64, 178, 164),
    warning: rgb(232, 184, 86),
    error: rgb(238, 108, 98),
    hole: rgb(236, 84, 74),
    spill: rgb(92, 148, 245),
    joint: rgb(176, 148, 226),
    camera: rgb(120, 170, 230),
    light: rgb(222, 204, 112),
    axes: [rgb(255, 120, 110), rgb(130, 210, 120), rgb(110, 160, 255)],
};

pub const LIGHT: Palette = Palette {
    sunken: rgb(255, 255, 255),
    panel: rgb(243, 244, 246),
    faint: rgb(234, 236, 240),
    control: rgb(221, 225, 231),
    hovered: rgb(205, 211, 219),
    selected: rgb(150, 214, 204),
    line: rgb(196, 202, 210),
    text: rgb(42, 47, 54),
    strong: rgb(10, 13, 17),
    weak: rgb(84, 91, 102),
    accent: rgb(0, 108, 98),
    warning: rgb(134, 80, 0),
    error: rgb(176, 32, 26),
    hole: rgb(186, 38, 30),
    spill: rgb(28, 84, 196),
    joint: rgb(104, 68, 172),
    camera: rgb(26, 90, 168),
    light: rgb(108, 90, 0),
    axes: [rgb(184, 44, 34), rgb(24, 110, 34), rgb(28, 84, 196)],
};

fn palette_of(ui: &Ui) -> &'static Palette {
    match Theme::from_dark_mode(ui.visuals().dark_mode) {
        Theme::Dark => &DARK,
        Theme::Light => &LIGHT,
    }
}

/// Of x, y and z, where text is coloured by them.
pub fn axes(ui: &Ui) -> [Color32; 3] {
    palette_of(ui).axes
}

/// What a colour of text means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    Strong,
    Weak,
    /// What is selected or runs.
    Accent,
    Warning,
    Error,
    /// Cells of the exact set that no moved voxel reached.
    Hole,
    /// Cells that moved voxels reached outside the exact set.
    Spill,
    Joint,
    Camera,
    Light,
}

impl Tone {
    /// In the colours of the window that this is laid out in.
    pub fn of(self, ui: &Ui) -> Color32 {
        self.in_palette(palette_of(ui))
    }

    fn in_palette(self, palette: &Palette) -> Color32 {
        match self {
            Self::Strong => palette.strong,
            Self::Weak => palette.weak,
            Self::Accent => palette.accent,
            Self::Warning => palette.warning,
            Self::Error => palette.error,
            Self::Hole => palette.hole,
            Self::Spill => palette.spill,
            Self::Joint => palette.joint,
            Self::Camera => palette.camera,
            Self::Light => palette.light,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLOURS: [Tone; 10] = [
        Tone::Strong,
        Tone::Weak,
        Tone::Accent,
        Tone::Warning,
        Tone::Error,
        Tone::Hole,
        Tone::Spill,
        Tone::Joint,
        Tone::Camera,
        Tone::Light,
    ];

    /// By WCAG 2.
    fn contrast(a: Color32, b: Color32) -> f64 {
        let luminance = |color: Color32| {
            let [r, g, b] = [color.r(), color.g(), color.b()].map(|byte| {
                let value = f64::from(byte) / 255.0;
                if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
            });
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let [a, b] = [a, b].map(luminance);
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn every_text_is_legible_on_every_ground() {
        for (name, palette) in [("dark", &DARK), ("light", &LIGHT)] {
            let on = |text: Color32, grounds: &[Color32], what: &str| {
                for ground in grounds {
                    let contrast = contrast(text, *ground);
                    assert!(contrast >= 4.5, "{name}: {what} {text:?} on {ground:?}: {contrast:.2}");
                }
            };
            let panels = [palette.panel, palette.faint, palette.sunken];
            let controls = [palette.control, palette.hovered, palette.selected];
            COLOURS.into_iter().for_each(|tone| on(tone.in_palette(palette), &panels, &format!("{tone:?}")));
            palette.axes.into_iter().for_each(|axis| on(axis, &panels, "an axis"));
            on(palette.text, &[&panels[..], &[palette.control]].concat(), "text");
            on(palette.strong, &controls, "strong text");
        }
    }

    #[test]
    fn colours_that_mean_something_keep_their_hue() {
        let channels = |color: Color32| [color.r(), color.g(), color.b()];
        let largest = |color| (0..3).max_by_key(|at| channels(color)[*at]);
        for tone in [Tone::Error, Tone::Hole, Tone::Spill, Tone::Joint, Tone::Camera, Tone::Warning, Tone::Light] {
            let [dark, light] = [&DARK, &LIGHT].map(|palette| tone.in_palette(palette));
            assert_eq!(largest(dark), largest(light), "{tone:?}");
        }
        for (dark, light) in DARK.axes.into_iter().zip(LIGHT.axes) {
            assert_eq!(largest(dark), largest(light));
        }
    }
}
