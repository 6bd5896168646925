//! Light at the leaves.

pub mod gather;
pub mod gather_ref;
