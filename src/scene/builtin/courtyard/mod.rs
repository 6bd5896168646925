//! `courtyard`: a cloistered court of about 14 x 14 x 7 m with things that stand, turn and walk.
//!
//! Glossy paving with polished inlays, a red and a blue wall that bleed colour, instanced
//! columns, cloth between them, a fountain with an armillary sphere (LINEAR), a vane on its top
//! (STEP), a swinging lantern that glows (CUBICSPLINE), mirrored and unevenly scaled ornaments,
//! and a skinned traveller. Clips: `walk` (all of that, 10 s) and `wave` (the traveller, 4 s).

mod building;
mod fountain;
mod furnishing;
mod palette;
mod traveller;
mod walk;
mod walls;

use glam::DVec3;

use super::MakeError;
use super::exact::facing;
use super::glb::GlbWriter;
use palette::Palette;

pub fn make() -> Result<Vec<u8>, MakeError> {
    let mut glb = GlbWriter::default();
    let mut walk = walk::clip();
    let palette = Palette::new(&mut glb)?;
    building::add(&mut glb, &palette);
    walls::add(&mut glb, &palette);
    furnishing::add(&mut glb, &palette, &mut walk);
    fountain::add(&mut glb, &palette, &mut walk);
    let wave = traveller::add(&mut glb, &palette, &mut walk);
    glb.clip(walk);
    glb.clip(wave);

    let sun = facing(DVec3::new(6.5, 7.8, 2.6), DVec3::ZERO);
    glb.sun("sun", sun, [1.0, 0.94, 0.84], 8.0);
    glb.camera("view", facing(DVec3::new(1.5, 2.55, 6.8), DVec3::new(0.2, 1.85, -1.0)), 0.92);
    glb.finish("courtyard")
}
