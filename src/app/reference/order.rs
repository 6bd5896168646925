//! What a person asks of the reference.

/// What lies over the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Comparison {
    /// Nothing: cones alone.
    #[default]
    Cones,
    Paths,
    /// Cones left of a divider, paths right of it.
    Wipe,
    /// Cones less paths.
    Difference,
}

/// What a person does with the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Order {
    /// Traces the picture that is shown, or goes on with it.
    Start,
    Stop,
    /// Whether another picture that is shown is traced in the place of the one before.
    Restart(bool),
    /// Samples a pixel to end with.
    Samples(u32),
    Compare(Comparison),
    /// The divider's place, 0 left to 1 right.
    Divide(f32),
}
