//! What is asked for wrongly.

/// Options that are valid one by one but not together.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Usage(pub String);
