//! Reference of shared/brdf.wgsl: glTF's metallic-roughness reflection (glTF 2.0, appendix B.3), and its
//! directional albedo by integration.
//!
//! ```text
//! f = (1 − F) c_diff / π + F D V       F = f0 + (1 − f0)(1 − v·h)⁵      α = max(roughness, 0.045)²
//! D = α² / (π ((n·h)²(α² − 1) + 1)²)
//! V = 1 / 2 (n·l √((n·v)²(1 − α²) + α²) + n·v √((n·l)²(1 − α²) + α²))
//! ```

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::{DIELECTRIC_REFLECTANCE, LEAST_ROUGHNESS};

/// By how much the fit in shared/brdf.wgsl misses the specular albedo at most, at cosines from 0.005: where a
/// nearly perfect mirror is seen edge-on. In the mean it is 0.003.
pub const ALBEDO_FIT_ERROR: f64 = 0.13;

/// What reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflector {
    /// Linear RGB.
    pub albedo: DVec3,
    pub roughness: f64,
    pub metallic: f64,
}

impl Reflector {
    pub fn f0(&self) -> DVec3 {
        DVec3::splat(DIELECTRIC_REFLECTANCE).lerp(self.albedo, self.metallic)
    }

    /// Per steradian; all directions of unit length and away from the surface, on the normal's side.
    pub fn brdf(&self, normal: DVec3, to_light: DVec3, to_eye: DVec3) -> DVec3 {
        let half_way = (to_light + to_eye).normalize();
        let f0 = self.f0();
        let fresnel = if f0 == DVec3::ZERO { f0 } else { f0 + (1.0 - f0) * (1.0 - to_eye.dot(half_way)).powi(5) };
        let lobe = lobe(self.roughness, normal, to_light, to_eye, half_way);
        (1.0 - fresnel) * self.albedo * (1.0 - self.metallic) / PI + fresnel * lobe
    }
}

/// D · V.
fn lobe(roughness: f64, n: DVec3, l: DVec3, v: DVec3, h: DVec3) -> f64 {
    let alpha = roughness.max(LEAST_ROUGHNESS).powi(2);
    let a2 = alpha * alpha;
    let distribution = a2 / (PI * (n.dot(h).powi(2) * (a2 - 1.0) + 1.0).powi(2));
    let (n_l, n_v) = (n.dot(l), n.dot(v));
    let seen = n_l * (n_v * n_v * (1.0 - a2) + a2).sqrt() + n_v * (n_l * n_l * (1.0 - a2) + a2).sqrt();
    distribution * 0.5 / seen
}

/// Share of a uniform sky that the lobe F·D·V reflects to an eye at this cosine: (a, b) of f0·a + b. Half
/// vectors are drawn where D · n·h is, `steps`² of them.
pub fn specular_albedo(roughness: f64, cosine: f64, steps: u32) -> (f64, f64) {
    let alpha2 = roughness.max(LEAST_ROUGHNESS).powi(4);
    let eye = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(steps);
    let (mut scale, mut bias) = (0.0, 0.0);
    for (i, j) in (0..steps).flat_map(|i| (0..steps).map(move |j| (i, j))) {
        let z = ((1.0 - at(i)) / (1.0 + (alpha2 - 1.0) * at(i))).sqrt();
        let (turn, level) = (TAU * at(j), (1.0 - z * z).max(0.0).sqrt());
        let half_way = DVec3::new(level * turn.cos(), level * turn.sin(), z);
        let v_h = eye.dot(half_way);
        let light = 2.0 * v_h * half_way - eye;
        if light.z > 0.0 && v_h > 0.0 {
            // Their density is D n·h / (4 v·h) in directions of the light, which leaves V of the lobe.
            let visibility = lobe(roughness, DVec3::Z, light, eye, half_way) / distribution(alpha2, z);
            let weight = visibility * light.z * 4.0 * v_h / z;
            let grazing = (1.0 - v_h).powi(5);
            scale += weight * (1.0 - grazing);
            bias += weight * grazing;
        }
    }
    let count = f64::from(steps).powi(2);
    (scale / count, bias / count)
}

fn distribution(alpha2: f64, n_h: f64) -> f64 {
    alpha2 / (PI * (n_h * n_h * (alpha2 - 1.0) + 1.0).powi(2))
}
