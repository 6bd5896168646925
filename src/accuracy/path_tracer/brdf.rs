//! How a surface reflects: glTF 2.0's metallic-roughness BRDF (appendix B), written from its equations.
//!
//! F = f0 + (1 − f0)(1 − |v·h|)⁵; diffuse (1 − F)·c/π; specular F·D·V with D of GGX and the
//! height-correlated V of Smith, α = roughness². Directions are unit vectors away from the surface, on the
//! side of its normal. Densities are per steradian.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

/// Smoother surfaces count as this rough, here and in the shaders: no highlight is thinner than a sample.
const LEAST_ROUGHNESS: f64 = 0.045;

#[derive(Clone, Copy, Debug)]
pub struct Brdf {
    /// Columns: two tangents and the normal.
    frame: DMat3,
    /// c: what is neither reflected nor absorbed.
    diffuse: DVec3,
    gloss: Option<Gloss>,
}

#[derive(Clone, Copy, Debug)]
struct Gloss {
    /// At normal incidence.
    f0: DVec3,
    /// α².
    alpha_squared: f64,
}

/// A direction that was chosen, and what follows.
#[derive(Clone, Copy, Debug)]
pub struct Scattered {
    pub direction: DVec3,
    /// Of having chosen it.
    pub density: f64,
    /// BRDF times cosine over density.
    pub weight: DVec3,
}

impl Brdf {
    pub fn new(normal: DVec3, base_color: DVec3, metallic: f64, roughness: f64) -> Self {
        let alpha = roughness.max(LEAST_ROUGHNESS).powi(2);
        let gloss = Gloss { f0: DVec3::splat(0.04).lerp(base_color, metallic), alpha_squared: alpha * alpha };
        Self { frame: frame(normal), diffuse: base_color * (1.0 - metallic), gloss: Some(gloss) }
    }

    /// Reflects `color` of all light, every way alike.
    pub fn lambert(normal: DVec3, color: DVec3) -> Self {
        Self { frame: frame(normal), diffuse: color, gloss: None }
    }

    pub fn normal(&self) -> DVec3 {
        self.frame.z_axis
    }

    pub fn is_diffuse(&self) -> bool {
        self.diffuse.max_element() > 0.0
    }

    pub fn is_glossy(&self) -> bool {
        self.gloss.is_some_and(|gloss| gloss.f0.max_element() > 0.0)
    }

    pub fn reflects(&self) -> bool {
        self.is_diffuse() || self.is_glossy()
    }

    /// The diffuse lobe, per steradian.
    pub fn diffuse(&self, view: DVec3, light: DVec3) -> DVec3 {
        let entering = self.gloss.map_or(DVec3::ONE, |gloss| DVec3::ONE - gloss.fresnel(half(view, light).dot(view)));
        entering * self.diffuse / PI
    }

    /// The specular lobe, per steradian.
    pub fn specular(&self, view: DVec3, light: DVec3) -> DVec3 {
        let Some(gloss) = self.gloss else { return DVec3::ZERO };
        let h = half(view, light);
        let [n_v, n_l, n_h] = [view, light, h].map(|direction| self.normal().dot(direction));
        if n_v <= 0.0 || n_l <= 0.0 {
            return DVec3::ZERO;
        }
        gloss.fresnel(h.dot(view)) * (gloss.distribution(n_h) * gloss.visibility(n_v, n_l))
    }

    /// Cosine-weighted. `None` where rounding leaves no cosine.
    pub fn scatter_diffuse(&self, view: DVec3, [u, v]: [f64; 2]) -> Option<Scattered> {
        let (radius, turn) = (u.sqrt(), 2.0 * PI * v);
        let direction = self.frame * DVec3::new(radius * turn.cos(), radius * turn.sin(), (1.0 - u).sqrt());
        let density = self.diffuse_density(direction);
        (density > 0.0).then(|| Scattered { direction, density, weight: self.diffuse(view, direction) * PI })
    }

    pub fn diffuse_density(&self, light: DVec3) -> f64 {
        self.normal().dot(light).max(0.0) / PI
    }

    /// By the normals that are visible (Heitz 2018). `None` where the direction lies below the surface.
    pub fn scatter_specular(&self, view: DVec3, numbers: [f64; 2]) -> Option<Scattered> {
        let alpha = self.gloss?.alpha_squared.sqrt();
        let h = self.frame * visible_normal(self.frame.transpose() * view, alpha, numbers);
        let direction = (2.0 * h.dot(view) * h - view).try_normalize()?;
        let density = self.specular_density(view, direction);
        let cosine = self.normal().dot(direction);
        (density > 0.0 && cosine > 0.0).then(|| {
            let weight = self.specular(view, direction) * (cosine / density);
            Scattered { direction, density, weight }
        })
    }

    /// G₁(v)·D(h)/(4·n·v).
    pub fn specular_density(&self, view: DVec3, light: DVec3) -> f64 {
        let Some(gloss) = self.gloss else { return 0.0 };
        let [n_v, n_h] = [view, half(view, light)].map(|direction| self.normal().dot(direction));
        if n_v <= 0.0 || n_h <= 0.0 { 0.0 } else { gloss.distribution(n_h) / (2.0 * (n_v + gloss.smith_root(n_v))) }
    }

    /// Chance of choosing the specular lobe of both: what it reflects at this angle beside all that may be
    /// reflected, and neither lobe left out.
    fn specular_chance(&self, view: DVec3) -> f64 {
        let Some(gloss) = self.gloss else { return 0.0 };
        let specular = gloss.fresnel(self.normal().dot(view)).element_sum();
        let diffuse = self.diffuse.element_sum();
        if diffuse > 0.0 { (specular / (specular + diffuse)).clamp(0.1, 0.9) } else { 1.0 }
    }

    /// Chooses by both lobes; three numbers.
    pub fn scatter(&self, view: DVec3, [choice, u, v]: [f64; 3]) -> Option<Scattered> {
        let is_specular = choice < self.specular_chance(view);
        let chosen =
            if is_specular { self.scatter_specular(view, [u, v]) } else { self.scatter_diffuse(view, [u, v]) }?;
        let density = self.density(view, chosen.direction);
        let weight = self.both(view, chosen.direction) * (self.normal().dot(chosen.direction) / density);
        Some(Scattered { density, weight, ..chosen })
    }

    /// Of [`Self::scatter`].
    pub fn density(&self, view: DVec3, light: DVec3) -> f64 {
        let specular = self.specular_chance(view);
        (1.0 - specular) * self.diffuse_density(light) + specular * self.specular_density(view, light)
    }

    /// Both lobes, per steradian.
    pub fn both(&self, view: DVec3, light: DVec3) -> DVec3 {
        self.diffuse(view, light) + self.specular(view, light)
    }
}

impl Gloss {
    fn fresnel(&self, v_h: f64) -> DVec3 {
        self.f0 + (DVec3::ONE - self.f0) * (1.0 - v_h.abs()).clamp(0.0, 1.0).powi(5)
    }

    fn distribution(&self, n_h: f64) -> f64 {
        let a = self.alpha_squared;
        a / (PI * (n_h * n_h * (a - 1.0) + 1.0).powi(2))
    }

    fn visibility(&self, n_v: f64, n_l: f64) -> f64 {
        0.5 / (n_l * self.smith_root(n_v) + n_v * self.smith_root(n_l))
    }

    fn smith_root(&self, cosine: f64) -> f64 {
        (cosine * cosine * (1.0 - self.alpha_squared) + self.alpha_squared).sqrt()
    }
}

fn half(a: DVec3, b: DVec3) -> DVec3 {
    (a + b).normalize_or_zero()
}

/// Columns: two tangents and `normal` (Duff et al. 2017: no direction is singular).
fn frame(normal: DVec3) -> DMat3 {
    let sign = 1.0_f64.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    let tangent = DVec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    let bitangent = DVec3::new(b, sign + normal.y * normal.y * a, -normal.y);
    DMat3::from_cols(tangent, bitangent, normal)
}

/// A microfacet's normal, by its share of what is seen along `view` (both with the surface's normal as z).
fn visible_normal(view: DVec3, alpha: f64, [u, v]: [f64; 2]) -> DVec3 {
    let stretched = DVec3::new(alpha * view.x, alpha * view.y, view.z).normalize();
    let across = DVec3::new(-stretched.y, stretched.x, 0.0).try_normalize().unwrap_or(DVec3::X);
    let up = stretched.cross(across);
    let (radius, turn) = (u.sqrt(), 2.0 * PI * v);
    let x = radius * turn.cos();
    let share = 0.5 * (1.0 + stretched.z);
    let y = (1.0 - share) * (1.0 - x * x).max(0.0).sqrt() + share * radius * turn.sin();
    let normal = x * across + y * up + (1.0 - x * x - y * y).max(0.0).sqrt() * stretched;
    DVec3::new(alpha * normal.x, alpha * normal.y, normal.z.max(0.0)).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_orthonormal_around_every_axis_and_diagonal() {
        let steps = [-1.0, 0.0, 1.0];
        let all = steps.into_iter().flat_map(|x| steps.map(|y| (x, y))).flat_map(|(x, y)| steps.map(|z| [x, y, z]));
        let normals = all.filter_map(|axes| DVec3::from_array(axes).try_normalize());
        for normal in normals.chain([DVec3::new(1e-9, -1e-9, -1.0), DVec3::NEG_Z]) {
            let frame = frame(normal);
            assert!((frame.transpose() * frame - DMat3::IDENTITY).to_cols_array().iter().all(|x| x.abs() < 1e-12));
            assert!((frame.determinant() - 1.0).abs() < 1e-12 && frame.z_axis == normal, "{normal}");
        }
    }

    #[test]
    fn light_and_eye_can_be_swapped() {
        let brdf = Brdf::new(DVec3::Z, DVec3::new(0.9, 0.5, 0.1), 0.4, 0.3);
        let [a, b] = [DVec3::new(0.3, 0.2, 0.9), DVec3::new(-0.7, 0.1, 0.4)].map(DVec3::normalize);
        assert!((brdf.both(a, b) - brdf.both(b, a)).length() < 1e-12);
    }
}
