//! What was decided of a frame.

use serde::Serialize;

use super::{Key, Keys, Part, Pass, Row, State};

/// A part that a frame makes.
#[derive(Clone, Debug)]
pub struct PlannedPart {
    pub part: Part,
    pub key: Key,
    /// The first method that calls for it, by number in the request.
    pub method: usize,
}

#[derive(Clone, Debug, Default, Serialize)]
#[serde(transparent)]
pub struct FramePlan {
    pub rows: Vec<Row>,
    #[serde(skip)]
    pub(super) to_run: Vec<PlannedPart>,
    #[serde(skip)]
    pub(super) keys: Vec<Keys>,
}

impl FramePlan {
    /// Whether a pass runs for any method.
    pub fn runs(&self, pass: Pass) -> bool {
        self.rows.iter().any(|row| row.pass == pass && row.state == State::Run)
    }

    /// No part runs: no dispatch, no repaint.
    pub fn is_idle(&self) -> bool {
        self.to_run.is_empty()
    }

    /// What a frame makes, in flow order, each part once however many methods share it.
    pub fn to_run(&self) -> &[PlannedPart] {
        &self.to_run
    }

    /// What every part of a method is made from; by the method's number in the request.
    pub fn keys(&self) -> &[Keys] {
        &self.keys
    }
}
