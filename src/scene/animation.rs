//! Clips and channels, sampled as glTF defines it (appendix C of its specification).

#[derive(Clone, Debug)]
pub struct Clip {
    pub name: String,
    /// Largest key time over its channels.
    pub duration_secs: f64,
    pub channels: Vec<Channel>,
}

#[derive(Clone, Debug)]
pub struct Channel {
    pub node: usize,
    pub property: Property,
    pub interpolation: Interpolation,
    /// Strictly increasing, seconds.
    pub times_secs: Vec<f64>,
    /// Per key: 3 or 4 numbers ([`Property::width`]); for CUBICSPLINE in-tangent, value, out-tangent.
    pub values: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    Translation,
    Rotation,
    Scale,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    Step,
    Linear,
    CubicSpline,
}
