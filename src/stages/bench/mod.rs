//! What the hardware can do at best, measured in the same run as the stages.

pub mod copy;
pub mod copy_ref;
