//! What a picture is kept by: a hash of everything that paths read, and of the version.
//!
//! Structs are taken apart field by field without `..`, so that a new field does not compile before
//! somebody has decided whether paths read it.

use super::TracedScene;
use super::camera::CameraRays;
use super::lights::Punctual;
use super::options::{Options, PixelSampling, Reflection};
use super::surface::SurfaceReader;
use crate::accuracy::posed_triangles::PosedSurface;
use crate::accuracy::triangle::PosedTriangle;
use crate::disk_cache::ContentKey;
use crate::prepare::kept::ContentWriter;
use crate::scene::{AlphaMode, LightKind, Material, Primitive};

/// Goes up with every change of what a path brings.
const ALGORITHM_VERSION: u64 = 2;

impl TracedScene<'_> {
    /// What a picture of it is kept by on disk.
    pub fn key(&self) -> ContentKey {
        let TracedScene {
            triangles,
            readers,
            punctual,
            emitters: _,
            sky_nits,
            occlusion_cells,
            rays,
            options,
            textures,
        } = self;
        let mut writer = ContentWriter::new(textures);
        writer.number(ALGORITHM_VERSION);
        let posed = triangles.tree().triangles();
        writer.number(posed.len() as u64);
        for PosedTriangle { corners, vertices, surface, sides } in posed {
            writer.list(corners);
            writer.list(vertices);
            writer.number(u64::from(*surface));
            writer.number(*sides as u64);
        }
        writer.number(readers.len() as u64);
        for (reader, surface) in readers.iter().zip(triangles.surfaces()) {
            write_surface(&mut writer, reader, surface);
        }
        writer.number(punctual.len() as u64);
        punctual.iter().for_each(|light| write_light(&mut writer, light));
        writer.list(&sky_nits.to_array());
        writer.list(&[*occlusion_cells]);
        let CameraRays { eye, forward, right, up, is_orthographic, near_cells, size_px: _ } = rays;
        [eye, forward, right, up].into_iter().for_each(|vector| writer.list(&vector.to_array()));
        writer.list(&[*near_cells]);
        writer.number(u64::from(*is_orthographic));
        write_options(&mut writer, options);
        writer.finish()
    }
}

fn write_surface(writer: &mut ContentWriter, reader: &SurfaceReader, surface: &PosedSurface) {
    let SurfaceReader { primitive, material, textures: _, tangents, emission, reflection: _ } = reader;
    let Primitive {
        material: _,  // its content is written, not its number
        positions: _, // posed ones are
        normals: _,   // likewise
        tangents: _,  // likewise
        joints: _,    // pose is all they are for
        weights: _,   // likewise
        triangles: _, // posed ones name their vertices
        morph: _,     // posed ones are displaced
        tex_coords,
        colors,
    } = primitive;
    writer.list(&surface.normals);
    writer.list(tangents);
    tex_coords.iter().for_each(|set| writer.list(set));
    writer.list(colors);
    writer.list(&[*emission]);
    write_material(writer, material);
}

fn write_material(writer: &mut ContentWriter, material: &Material) {
    let Material {
        name: _,
        base_color,
        base_color_texture,
        metallic,
        roughness,
        metallic_roughness_texture,
        normal_texture,
        normal_scale,
        emissive,
        emissive_texture,
        alpha_mode,
        double_sided: _, // its triangles tell
        unlit,
    } = material;
    writer.list(base_color);
    writer.list(emissive);
    writer.list(&[*metallic, *roughness, *normal_scale]);
    let (mode, cutoff) = match *alpha_mode {
        AlphaMode::Opaque => (0, 0.0),
        AlphaMode::Mask { cutoff } => (1, cutoff),
        AlphaMode::Blend => (2, 0.0),
    };
    writer.number(mode);
    writer.list(&[cutoff]);
    writer.number(u64::from(*unlit));
    let slots = [base_color_texture, metallic_roughness_texture, normal_texture, emissive_texture];
    slots.into_iter().for_each(|slot| writer.slot(*slot));
}

fn write_light(writer: &mut ContentWriter, light: &Punctual) {
    let Punctual { kind, strength, position, direction, span } = light;
    let (number, [range, inner, outer]) = match *kind {
        LightKind::Directional => (0, [0.0; 3]),
        LightKind::Point { range } => (1, [range.unwrap_or(f32::INFINITY), 0.0, 0.0]),
        LightKind::Spot { range, inner_cone_radians, outer_cone_radians } => {
            (2, [range.unwrap_or(f32::INFINITY), inner_cone_radians, outer_cone_radians])
        }
    };
    writer.number(number);
    writer.list(&[range, inner, outer]);
    [strength, position, direction].into_iter().for_each(|vector| writer.list(&vector.to_array()));
    writer.list(&[*span]);
}

fn write_options(writer: &mut ContentWriter, options: &Options) {
    let Options { size_px, seed, pixel, reflection } = options;
    writer.list(size_px);
    writer.number(*seed);
    writer.number(match pixel {
        PixelSampling::Centre => 0,
        PixelSampling::Area => 1,
    });
    writer.number(match reflection {
        Reflection::MetallicRoughness => 0,
        Reflection::Lambert => 1,
    });
}
