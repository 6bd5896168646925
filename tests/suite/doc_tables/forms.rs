//! Tables of tests: what is measured beside a closed form.

use super::markdown::Table;
use super::measured::Files;
use crate::cone_forms::{HoleRow, WallRow};
use crate::furnace::FurnaceRow;
use crate::leaks::LeakRow;

/// By the width of the nodes that are sampled.
pub fn leaks(files: &Files) -> Table {
    let rows = files.rows::<LeakRow>();
    let widths = rows.first().expect("a row").transmission.keys().map(u32::to_string);
    let mut table = Table::new(1, ["voxels, offset, opacity".to_owned()].into_iter().chain(widths));
    for row in &rows {
        let opacity = format!("{:?}", row.opacity).to_lowercase();
        let wall = format!("{}, {}, {opacity}", row.thickness, row.offset_cells);
        let cells = row.transmission.values().map(|[centre, between]| format!("{centre:.2} {between:.2}"));
        table.row([wall].into_iter().chain(cells));
    }
    table
}

pub fn furnace(files: &Files) -> Table {
    let heads = ["walls, voxels", "opacity", "ρ", "aperture °", "closed form", "mean of faces", "darkest", "brightest"];
    let mut table = Table::new(2, heads);
    for row in files.rows::<FurnaceRow>() {
        let radiances = [row.closed, row.mean, row.least, row.most].map(|radiance| format!("{radiance:.3}"));
        let room = [
            row.thickness.to_string(),
            format!("{:?}", row.opacity).to_lowercase(),
            row.albedo.to_string(),
            row.aperture_degrees.to_string(),
        ];
        table.row(room.into_iter().chain(radiances));
    }
    table
}

/// Share of the sky that a wall hides.
pub fn walls(files: &Files) -> Table {
    let rows = files.rows::<WallRow>();
    let cones: Vec<u32> = rows.first().expect("a row").hidden.keys().rev().copied().collect();
    let heads = ["aperture °", "opacity", "wall at, voxels", "infinite wall", "this wall"].map(Into::into);
    let mut table = Table::new(2, heads.into_iter().chain(cones.iter().map(|cones| format!("{cones} cones"))));
    for row in &rows {
        let opacity = format!("{:?}", row.opacity).to_lowercase();
        let shares = [row.infinite, row.closed].into_iter().chain(row.hidden.values().rev().copied());
        let place = [row.aperture_degrees.to_string(), opacity, row.distance_voxels.to_string()];
        table.row(place.into_iter().chain(shares.map(|share| format!("{share:.3}"))));
    }
    table
}

/// Share of the sky that a hole lets in.
pub fn holes(files: &Files) -> Table {
    let mut table = Table::new(0, ["hole of, voxels", "closed form", "cones of 4°", "cones of 30°"]);
    for row in files.rows::<HoleRow>() {
        let shares = [row.closed, row.narrow, row.wide].map(|share| format!("{share:.3}"));
        table.row([row.side_voxels.to_string()].into_iter().chain(shares));
    }
    table
}
