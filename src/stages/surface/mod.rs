//! The surfaces that the camera sees, and what light they send to it.
//!
//! ```text
//! posed triangles ─► draw (surface image) ─► direct (a light at a time) ─► compose ─► sum_luminance (exposure)
//!                          └─► cones::diffuse, cones::specular ───────────▲   └─► view::show_surfaces
//! ```

pub mod compose;
pub mod sum_luminance;
