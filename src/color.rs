//! sRGB's transfer function, both ways: between what files and screens store and linear light.

pub fn linear_from_gamma(value: f64) -> f64 {
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// Clamps to 0 … 1.
pub fn gamma_from_linear(value: f64) -> f64 {
    let value = value.clamp(0.0, 1.0);
    if value <= 0.003_130_8 { value * 12.92 } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}

/// A channel of linear light as files and screens store it. Clamps to 0 … 255.
pub fn srgb_byte(linear: f32) -> u8 {
    (gamma_from_linear(f64::from(linear)) * 255.0).round() as u8
}

/// What the eye makes of linear sRGB's red, green and blue.
pub const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Of linear sRGB.
pub fn luminance([r, g, b]: [f64; 3]) -> f64 {
    LUMINANCE[0] * r + LUMINANCE[1] * g + LUMINANCE[2] * b
}
