//! Options that say what lights a scene, and how that light is computed.

use clap::Args;
use octolume::settings::LightChange;
use octolume::settings::lighting::{AddedLight, Lighting, Opacity, Shadows, SunShines};

use super::light_values::{self, SunChoice};
use super::values;
use super::values::set;

#[derive(Debug, Args)]
#[command(next_help_heading = "Light")]
pub struct LightingOptions {
    /// Changes a light of the scene, by its name or its node's: off, on, or KEY=VALUE, where KEY is lux,
    /// candela, color (R,G,B), range (scene units or none), inner or outer (degrees). Repeatable
    #[arg(long = "light", value_name = "NAME:off|on|KEY=VALUE…", value_parser = light_values::light_change)]
    changes: Vec<LightChange>,
    /// Adds a directional, point or spot light: at (X,Y,Z), to (X,Y,Z: the way it shines), name, and what
    /// --light can change, such as spot:at=0,3,0:to=0,-1,0:candela=500. Repeatable
    #[arg(long = "add-light", value_name = "KIND:KEY=VALUE…", value_parser = light_values::added_light)]
    added: Vec<AddedLight>,
    /// The way a sun of our own shines; switches it on
    #[arg(long, value_name = "X,Y,Z", value_parser = values::vector, allow_hyphen_values = true)]
    light_dir: Option<[f64; 3]>,
    /// Our own sun: its illuminance, off, or where the scene neither has lights nor emits; otherwise auto
    #[arg(long, value_name = "LUX|off|auto", value_parser = light_values::sun, allow_hyphen_values = true)]
    sun: Option<SunChoice>,
    /// Radiance that comes from every direction, nits; otherwise 0,0,0
    #[arg(long, value_name = "R,G,B", value_parser = light_values::color, allow_hyphen_values = true)]
    sky: Option<[f64; 3]>,
    /// Multiplies what emissive surfaces emit; otherwise 1
    #[arg(long, value_name = "FACTOR", value_parser = light_values::amount, allow_hyphen_values = true)]
    emission: Option<f64>,
    /// How a voxel learns whether a light reaches it; otherwise map
    #[arg(long, value_name = "map|march|off", value_parser = values::name::<Shadows>)]
    shadows: Option<Shadows>,
    /// Texels along an edge of a shadow map: 512, 1024, 2048, 4096 or 8192; otherwise 2048
    #[arg(long, value_name = "PX")]
    shadow_map: Option<u32>,
    /// How far above its surface a voxel looks for what hides the light, in voxels; otherwise 0.5, or 1 where shadows are marched
    #[arg(long, value_name = "VOXELS", value_parser = values::number, allow_hyphen_values = true)]
    shadow_offset: Option<f64>,
    /// What a node of the octree stops: the same in all directions, or each axis by itself; otherwise isotropic
    #[arg(long, value_name = "isotropic|directional", value_parser = values::name::<Opacity>)]
    opacity: Option<Opacity>,
    /// How often light goes on from voxel to voxel: 0 to 64; otherwise 0
    #[arg(long, value_name = "N")]
    bounces: Option<u32>,
    /// Cones a voxel gathers light with: 1 to 256; otherwise 8
    #[arg(long, value_name = "N")]
    cones: Option<u32>,
    /// Full apex angle of those cones: 0 to 120; otherwise 60
    #[arg(long, value_name = "DEGREES", value_parser = values::number, allow_hyphen_values = true)]
    cone_degrees: Option<f64>,
}

impl LightingOptions {
    /// Puts every option given over what is set. Lights of the scene come later: which they are depends on it.
    pub fn apply(&self, lighting: &mut Lighting) {
        if let Some(direction) = self.light_dir {
            (lighting.sun.direction, lighting.sun.shines) = (direction, SunShines::Always);
        }
        match self.sun {
            Some(SunChoice::Lux(lux)) => (lighting.sun.illuminance_lux, lighting.sun.shines) = (lux, SunShines::Always),
            Some(SunChoice::As(shines)) => lighting.sun.shines = shines,
            None => {}
        }
        for added in &self.added {
            let mut added = added.clone();
            if added.name.is_empty() {
                added.name = lighting.free_name();
            }
            lighting.added.push(added);
        }
        set(&mut lighting.sky_nits, self.sky);
        set(&mut lighting.emission, self.emission);
        set(&mut lighting.shadows, self.shadows);
        set(&mut lighting.shadow_map_px, self.shadow_map);
        lighting.shadow_offset_voxels = self.shadow_offset.or(lighting.shadow_offset_voxels);
        set(&mut lighting.opacity, self.opacity);
        set(&mut lighting.bounces, self.bounces);
        set(&mut lighting.cones, self.cones);
        set(&mut lighting.cone_degrees, self.cone_degrees);
    }

    /// What lights of the scene are to become.
    pub fn changes(&self) -> Vec<LightChange> {
        self.changes.clone()
    }
}
