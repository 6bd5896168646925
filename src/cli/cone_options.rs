//! Options that say how cones light the surfaces that the camera sees.

use clap::Args;
use octolume::settings::{ConeTracing, Lookup, Sampling};

use super::values::set;
use super::values::{self, IndirectSize, OcclusionDistance, Switch};

#[derive(Debug, Args)]
#[command(next_help_heading = "Cones of surfaces")]
pub struct ConeOptions {
    /// Diffuse cones bring the light of other surfaces and of the sky; otherwise on
    #[arg(long, value_name = "on|off", value_parser = values::name::<Switch>)]
    diffuse_cones: Option<Switch>,
    /// A specular cone does, where a surface is glossy; otherwise on
    #[arg(long, value_name = "on|off", value_parser = values::name::<Switch>)]
    specular_cone: Option<Switch>,
    /// Diffuse cones tell what is near, which darkens the sky where they bring no light; otherwise off
    #[arg(long, value_name = "on|off", value_parser = values::name::<Switch>)]
    occlusion: Option<Switch>,
    /// What is farther away occludes nothing: scene units, or auto: an eighth of the grid
    #[arg(long, value_name = "LENGTH|auto", allow_hyphen_values = true)]
    occlusion_distance: Option<OcclusionDistance>,
    /// Diffuse cones of a pixel: 1 to 64; otherwise 4
    #[arg(long, value_name = "N")]
    pixel_cones: Option<u32>,
    /// Side of the square of pixels that share a set of diffuse cones: 1, 2 or 4; otherwise 4
    #[arg(long, value_name = "PX")]
    cone_pattern: Option<u32>,
    /// Full apex angle of a diffuse cone: 0 to 120; otherwise 30
    #[arg(long, value_name = "DEGREES", value_parser = values::number, allow_hyphen_values = true)]
    aperture: Option<f64>,
    /// From a surface along its normal to the apex of a cone: 0 to 16 voxels; otherwise 1.5
    #[arg(long, value_name = "VOXELS", value_parser = values::number, allow_hyphen_values = true)]
    cone_start: Option<f64>,
    /// Length of a step in diameters of the cone: 0.125 to 2; otherwise 1
    #[arg(long, value_name = "DIAMETERS", value_parser = values::number, allow_hyphen_values = true)]
    cone_step: Option<f64>,
    /// How a cone's samples are taken; otherwise quadrilinear
    #[arg(long, value_name = "nearest|trilinear|quadrilinear", value_parser = values::name::<Sampling>)]
    cone_sampling: Option<Sampling>,
    /// How the nodes around a sample are found; otherwise ranks
    #[arg(long, value_name = "ranks|block-pointers|node-pointers", value_parser = values::name::<Lookup>)]
    cone_lookup: Option<Lookup>,
    /// Largest picture whose every pixel sends out cones, such as 1280x720; otherwise as large as the picture
    #[arg(long, value_name = "WxH|picture")]
    indirect: Option<IndirectSize>,
    /// Diffuse cones at half of that, along each side; otherwise on
    #[arg(long, value_name = "on|off", value_parser = values::name::<Switch>)]
    half_resolution: Option<Switch>,
    /// Rougher surfaces than this take what their diffuse cones see for their reflection: 0 to 1; otherwise 0.6
    #[arg(long, value_name = "ROUGHNESS", value_parser = values::number, allow_hyphen_values = true)]
    glossy: Option<f64>,
}

impl ConeOptions {
    /// Puts every option given over what is set.
    pub fn apply(&self, cones: &mut ConeTracing) {
        let is_on = |switch: Option<Switch>| switch.map(|switch| switch == Switch::On);
        set(&mut cones.diffuse, is_on(self.diffuse_cones));
        set(&mut cones.specular, is_on(self.specular_cone));
        set(&mut cones.ambient_occlusion, is_on(self.occlusion));
        set(&mut cones.half_resolution, is_on(self.half_resolution));
        set(&mut cones.occlusion_distance, self.occlusion_distance.map(|distance| distance.0));
        set(&mut cones.indirect_px, self.indirect.map(|size| size.0));
        set(&mut cones.cones, self.pixel_cones);
        set(&mut cones.pattern_px, self.cone_pattern);
        set(&mut cones.cone_degrees, self.aperture);
        set(&mut cones.start_voxels, self.cone_start);
        set(&mut cones.step_diameters, self.cone_step);
        set(&mut cones.sampling, self.cone_sampling);
        set(&mut cones.lookup, self.cone_lookup);
        set(&mut cones.glossy_roughness, self.glossy);
    }
}
