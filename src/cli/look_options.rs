//! Options that say what a picture shows, and how.

use clap::Args;
use octolume::settings::{AlphaRule, ColorBy, Look, Lookup, Sampling, SliceValue, ToneCurve, View};

use super::values::set;
use super::values::{self, Exposure, SliceChoice, SliceScale, ViewChoice};

#[derive(Debug, Args)]
#[command(next_help_heading = "What is shown")]
pub struct LookOptions {
    /// What to show; `:N` the octree's level N, or the shadow map of light N, both from 0. Surfaces lit by
    /// lights and cones, or a part of that: final, direct, diffuse, specular, ao, albedo, normal, depth,
    /// roughness, surfaces:irradiance
    #[arg(
        long,
        value_name = "voxels|mesh|ghost|level:N|radiance[:N]|irradiance[:N]|slice|shadow-map[:N]|surfaces[:PART]"
    )]
    view: Option<ViewChoice>,
    /// What colours mean
    #[arg(
        long,
        value_name = "albedo|normal|occupancy|object|level|radiance|irradiance",
        value_parser = values::name::<ColorBy>
    )]
    color: Option<ColorBy>,
    /// How a voxel of partial occupancy covers what is behind it
    #[arg(long, value_name = "paper|length", value_parser = values::name::<AlphaRule>)]
    alpha: Option<AlphaRule>,
    /// Draws the edges of voxels
    #[arg(long)]
    edges: bool,
    /// Shows bare colours, without the headlight
    #[arg(long)]
    no_shading: bool,
    /// Light is multiplied by 2 to this before it is shown: -40 to 40; otherwise (auto) so that one lit pixel in twenty is
    /// nearly white, or the mean of voxels grey; that of the first picture holds for all of a sequence
    #[arg(long, value_name = "STOPS|auto", allow_hyphen_values = true)]
    exposure: Option<Exposure>,
    /// How exposed light becomes the brightness of a screen; otherwise aces
    #[arg(long, value_name = "linear|reinhard|aces", value_parser = values::name::<ToneCurve>)]
    curve: Option<ToneCurve>,
    /// Shows the slice across an axis, at a height of 0 to 1 of the grid; otherwise y:0.5
    #[arg(long, value_name = "x|y|z:HEIGHT", allow_hyphen_values = true)]
    slice: Option<SliceChoice>,
    /// What a slice shows; otherwise radiance
    #[arg(long, value_name = "radiance|irradiance|occupancy", value_parser = values::name::<SliceValue>)]
    slice_value: Option<SliceValue>,
    /// How the colours of a slice grow with its value; otherwise logarithmic
    #[arg(long, value_name = "linear|logarithmic", value_parser = values::name::<SliceScale>)]
    slice_scale: Option<SliceScale>,
    /// How a place between nodes gets its value; otherwise quadrilinear
    #[arg(long, value_name = "nearest|trilinear|quadrilinear", value_parser = values::name::<Sampling>)]
    sampling: Option<Sampling>,
    /// How the nodes around a place are found; otherwise ranks
    #[arg(long, value_name = "ranks|block-pointers|node-pointers", value_parser = values::name::<Lookup>)]
    lookup: Option<Lookup>,
    /// Width of a slice's samples: 1 to 1024 cells; otherwise 1
    #[arg(long, value_name = "CELLS", value_parser = values::number, allow_hyphen_values = true)]
    width: Option<f64>,
}

impl LookOptions {
    pub fn names_view(&self) -> bool {
        self.view.is_some()
    }

    /// Puts every option given over what is set.
    pub fn apply(&self, look: &mut Look) {
        if let Some(choice) = self.view {
            (look.view, look.level) = (choice.view, choice.level);
            set(&mut look.color, choice.color);
            set(&mut look.shadow_map, choice.shadow_map);
            set(&mut look.surface, choice.surface);
        } else if self.slice.is_some() {
            look.view = View::Slice;
        }
        set(&mut look.color, self.color);
        set(&mut look.alpha, self.alpha);
        look.voxel_edges |= self.edges;
        look.shaded &= !self.no_shading;
        set(&mut look.exposure_stops, self.exposure.map(|exposure| exposure.0));
        set(&mut look.tone_curve, self.curve);
        if let Some(SliceChoice { axis, height }) = self.slice {
            (look.slice.axis, look.slice.height) = (axis, height);
        }
        set(&mut look.slice.value, self.slice_value);
        set(&mut look.slice.logarithmic, self.slice_scale.map(|scale| scale == SliceScale::Logarithmic));
        set(&mut look.slice.sampling, self.sampling);
        set(&mut look.slice.lookup, self.lookup);
        set(&mut look.slice.width_cells, self.width);
    }
}
