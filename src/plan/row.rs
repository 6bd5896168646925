//! What a plan says of a pass.

use serde::Serialize;

use super::Pass;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum State {
    Run,
    /// The last result still holds.
    Reuse,
    /// Nothing in the scene, or nobody looking, calls for it.
    Skip,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Row {
    /// Number in the request; 0 is what is shown. Of the others only what they do not share.
    pub method: usize,
    pub pass: Pass,
    pub state: State,
    pub reason: &'static str,
}
