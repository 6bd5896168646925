//! Reference of `inject.wgsl`: what leaves a leaf, L = ρ/π · E + Lₑ (Lambert), before it is averaged.

use std::f64::consts::PI;

use glam::DVec3;

/// Albedo ρ 0 … 1, irradiance E in lux, emission Lₑ in nits. Out: nits.
pub fn radiance(albedo: DVec3, irradiance: DVec3, emission: DVec3) -> DVec3 {
    albedo / PI * irradiance + emission
}

/// As stored: light times opacity, and opacity.
pub fn stored(light: DVec3, opacity: f64) -> [f64; 4] {
    (light * opacity).extend(opacity).to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_white_plane_under_pi_lux_leaves_a_nit() {
        assert_eq!(radiance(DVec3::ONE, DVec3::splat(PI), DVec3::ZERO), DVec3::ONE);
        assert_eq!(stored(radiance(DVec3::ZERO, DVec3::ONE, DVec3::new(2.0, 0.0, 4.0)), 0.5), [1.0, 0.0, 2.0, 0.5]);
    }
}
