//! What a material shows at a place of a triangle: glTF's metallic-roughness at the textures' finest level.
//!
//! Normals of what is met are turned to the eye, and bent to
//! it until [`LEAST_FACING`] where interpolation or a normal map turns them away.

use glam::{DVec2, DVec3};

use super::Reflection;
use super::brdf::Brdf;
use crate::accuracy::posed_triangles::SurfacePoint;
use crate::accuracy::triangle::{PosedTriangle, weighted};
use crate::data::texels::Texels;
use crate::scene::{AlphaMode, Material, Primitive, TextureRef};
use crate::stages::voxelize::TexturePyramids;

/// Least cosine of shading normal and view direction.
const LEAST_FACING: f64 = 0.01;

/// A primitive of an object, posed.
pub struct SurfaceReader<'a> {
    pub primitive: &'a Primitive,
    pub material: &'a Material,
    pub textures: &'a TexturePyramids,
    /// Of vertices, as [`crate::scene::Scene::posed_tangents`] has them.
    pub tangents: Vec<[DVec3; 2]>,
    /// Multiplies what the material emits.
    pub emission: f64,
    pub reflection: Reflection,
}

/// A triangle of such a primitive.
pub struct Shape<'a> {
    pub number: usize,
    pub triangle: &'a PosedTriangle,
    /// Of the primitive's vertices.
    pub normals: &'a [DVec3],
}

/// A place that a ray has met.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    pub triangle: usize,
    /// Its face is turned to where the ray came from.
    pub point: SurfacePoint,
    /// Along the ray.
    pub distance: f64,
    /// Towards where the ray came from.
    pub view: DVec3,
    /// Linear RGB, nits.
    pub emission: DVec3,
    /// What an unlit surface shows whoever looks straight at it, nits.
    pub unlit: DVec3,
    pub brdf: Brdf,
}

impl SurfaceReader<'_> {
    /// Chance that a ray meets the surface here.
    pub fn presence(&self, vertices: [u32; 3], place: DVec3) -> f64 {
        match self.material.alpha_mode {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Mask { cutoff } => f64::from(self.base_color(vertices, place)[3] >= f64::from(cutoff)),
            AlphaMode::Blend => self.base_color(vertices, place)[3],
        }
    }

    pub fn is_opaque(&self) -> bool {
        self.material.alpha_mode == AlphaMode::Opaque
    }

    /// What is unlit shows itself to the eye alone, and lights nothing.
    pub fn emits(&self) -> bool {
        let emits = self.emission > 0.0 && self.material.emissive.iter().any(|channel| *channel > 0.0);
        emits && !self.material.unlit
    }

    /// Linear RGB, nits.
    pub fn emission(&self, vertices: [u32; 3], place: DVec3) -> DVec3 {
        if !self.emits() {
            return DVec3::ZERO;
        }
        let texture = self.sample(self.material.emissive_texture, Texels::Opaque, vertices, place);
        DVec3::from_slice(&texture) * DVec3::from_array(self.material.emissive.map(f64::from)) * self.emission
    }

    /// Seen along `direction` from `distance` cells away; `None` on a triangle without area.
    pub fn read(&self, shape: &Shape, place: DVec3, (direction, distance): (DVec3, f64)) -> Option<Surface> {
        let (vertices, view) = (shape.triangle.vertices, -direction);
        let face = shape.triangle.doubled_area().try_normalize()?;
        let face = if face.dot(view) < 0.0 { -face } else { face };
        let normal = bent(self.normal(shape, place, face), view);
        let position = weighted(shape.triangle.corners, place);
        Some(Surface {
            triangle: shape.number,
            point: SurfacePoint { position, face, shading: normal },
            distance,
            view,
            emission: self.emission(vertices, place),
            unlit: self.unlit(vertices, place),
            brdf: self.brdf(vertices, place, normal),
        })
    }

    fn unlit(&self, vertices: [u32; 3], place: DVec3) -> DVec3 {
        if self.material.unlit { DVec3::from_slice(&self.base_color(vertices, place)) } else { DVec3::ZERO }
    }

    fn brdf(&self, vertices: [u32; 3], place: DVec3, normal: DVec3) -> Brdf {
        if self.material.unlit {
            return Brdf::lambert(normal, DVec3::ZERO);
        }
        let base_color = DVec3::from_slice(&self.base_color(vertices, place));
        if self.reflection == Reflection::Lambert {
            return Brdf::lambert(normal, base_color);
        }
        let [_, rough, metal, _] =
            self.sample(self.material.metallic_roughness_texture, Texels::Linear, vertices, place);
        let share = |factor: f32, texture: f64| (f64::from(factor) * texture).clamp(0.0, 1.0);
        let (metallic, roughness) = (share(self.material.metallic, metal), share(self.material.roughness, rough));
        Brdf::new(normal, base_color, metallic, roughness)
    }

    /// Linear RGBA, 0 to 1.
    fn base_color(&self, vertices: [u32; 3], place: DVec3) -> [f64; 4] {
        let texels = if self.is_opaque() { Texels::Opaque } else { Texels::Covering };
        let texture = self.sample(self.material.base_color_texture, texels, vertices, place);
        let corner = |vertex: u32| self.primitive.colors.get(vertex as usize).map_or([1.0; 4], |c| c.to_array());
        let corners = vertices.map(corner);
        std::array::from_fn(|c| {
            let vertex: f64 = corners.iter().zip(place.to_array()).map(|(color, w)| w * f64::from(color[c])).sum();
            (f64::from(self.material.base_color[c]) * texture[c] * vertex).clamp(0.0, 1.0)
        })
    }

    fn sample(&self, slot: Option<TextureRef>, texels: Texels, vertices: [u32; 3], place: DVec3) -> [f64; 4] {
        let Some(slot) = slot else { return [1.0; 4] };
        let [a, b, c] = self.corner_uvs(slot, vertices);
        self.textures.sample(slot.texture, texels, a * place.x + b * place.y + c * place.z, 0.0)
    }

    fn corner_uvs(&self, slot: TextureRef, vertices: [u32; 3]) -> [DVec2; 3] {
        let coordinates = self.primitive.tex_coords.get(slot.tex_coord).map_or(&[][..], Vec::as_slice);
        vertices.map(|vertex| slot.uv(coordinates.get(vertex as usize).copied().unwrap_or_default()).as_dvec2())
    }

    /// Unit length, on the side of `face`.
    fn normal(&self, shape: &Shape, place: DVec3, face: DVec3) -> DVec3 {
        let normals = shape.triangle.vertices.map(|vertex| shape.normals[vertex as usize]);
        let Some(smooth) = weighted(normals, place).try_normalize() else { return face };
        let normal =
            self.material.normal_texture.map_or(smooth, |slot| self.bumped(slot, shape.triangle, place, smooth));
        if smooth.dot(face) < 0.0 { -normal } else { normal }
    }

    fn bumped(&self, slot: TextureRef, triangle: &PosedTriangle, place: DVec3, smooth: DVec3) -> DVec3 {
        let axes = if self.tangents.is_empty() {
            tangents_of(triangle.corners, self.corner_uvs(slot, triangle.vertices), smooth)
        } else {
            let corners = triangle.vertices.map(|vertex| self.tangents[vertex as usize]);
            let axis = |number: usize| weighted(corners.map(|axes| axes[number]), place);
            across(axis(0), smooth).zip(across(axis(1), smooth))
        };
        let Some((along, up)) = axes else { return smooth };
        let texel = DVec3::from_slice(&self.sample(Some(slot), Texels::Linear, triangle.vertices, place));
        let scale = f64::from(self.material.normal_scale);
        let bump = (texel * 2.0 - 1.0) * DVec3::new(scale, scale, 1.0);
        (along * bump.x + up * bump.y + smooth * bump.z).try_normalize().unwrap_or(smooth)
    }
}

/// Where red and green of a normal map point: the way u grows, and the way v falls, since pictures hang
/// from their upper edge and green points up. Unit length, across `normal`.
fn tangents_of([a, b, c]: [DVec3; 3], uvs: [DVec2; 3], normal: DVec3) -> Option<(DVec3, DVec3)> {
    let (ab, ac) = (b - a, c - a);
    let (uv_b, uv_c) = (uvs[1] - uvs[0], uvs[2] - uvs[0]);
    let turned = uv_b.perp_dot(uv_c);
    let along_u = across((ab * uv_c.y - ac * uv_b.y) * turned.signum(), normal)?;
    let against_v = across((ab * uv_c.x - ac * uv_b.x) * turned.signum(), normal)?;
    (turned != 0.0).then_some((along_u, against_v))
}

/// The part of `axis` across `normal`, unit length.
fn across(axis: DVec3, normal: DVec3) -> Option<DVec3> {
    (axis - normal * normal.dot(axis)).try_normalize()
}

fn bent(normal: DVec3, view: DVec3) -> DVec3 {
    let facing = normal.dot(view);
    if facing >= LEAST_FACING { normal } else { (normal + view * (LEAST_FACING - facing)).normalize() }
}
