//! Averages occupancy, albedo and normal up to the root (section 4.1, "generate data for non-leaf
//! nodes"). The step from the leaves is fused into gathering.

pub mod average;
pub mod average_ref;
