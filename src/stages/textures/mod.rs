//! Smaller levels of images, for surfaces that are seen small: means in linear light, so that a surface keeps its
//! colour and a mask its holes at every distance.

pub mod halve;
pub mod halve_ref;
