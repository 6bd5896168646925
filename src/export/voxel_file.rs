//! World voxels as arrays (.npz, exact numbers) and as points (.ply, for viewers), in Morton order.

use std::io::Cursor;
use std::path::Path;

use glam::{DVec3, IVec3};
use ndarray::{arr0, arr1, aview1, aview2};
use ndarray_npy::{NpzWriter, WriteNpzError};
use ply_rs_bw::ply::{Addable, ElementDef, Encoding, Ply, PropertyAccess, PropertyDef, PropertyType, ScalarType};
use ply_rs_bw::writer::Writer;

use super::{ExportError, write_file};
use crate::color::srgb_byte;
use crate::data::grid::Grid;
use crate::data::world_voxels::WorldVoxels;

/// Writes `cells` int32 `[n, 3]`, `occupancy` float32 `[n]`, `albedo` (linear) and `normal` float32
/// `[n, 3]`, `grid_corner` float64 `[3]`, `span` float64.
pub fn write_npz(file: &Path, voxels: &WorldVoxels, grid: &Grid) -> Result<(), ExportError> {
    let bytes = npz(voxels, grid).map_err(|error| ExportError::new(file, error))?;
    write_file(file, &bytes)
}

fn npz(voxels: &WorldVoxels, grid: &Grid) -> Result<Vec<u8>, WriteNpzError> {
    let mut npz = NpzWriter::new(Cursor::new(Vec::new()));
    npz.add_array("cells", &aview2(&voxels.cells))?;
    npz.add_array("occupancy", &aview1(&voxels.occupancy))?;
    npz.add_array("albedo", &aview2(&voxels.albedo))?;
    npz.add_array("normal", &aview2(&voxels.normal))?;
    npz.add_array("grid_corner", &arr1(&grid.corner().to_array()))?;
    npz.add_array("span", &arr0(grid.span))?;
    Ok(npz.finish()?.into_inner())
}

/// Writes a point a cell, at its centre in scene units, with `nx ny nz`, `red green blue` (8-bit
/// sRGB), `occupancy` and the cell's `i j k`.
pub fn write_ply(file: &Path, voxels: &WorldVoxels, grid: &Grid) -> Result<(), ExportError> {
    let mut ply = Ply::<Point>::new();
    ply.header.encoding = Encoding::BinaryLittleEndian;
    let corner = grid.corner();
    ply.header.comments.push(format!("grid_corner {} {} {}", corner.x, corner.y, corner.z));
    ply.header.comments.push(format!("span {}", grid.span));
    let mut vertex = ElementDef::new("vertex".to_owned());
    for (name, kind) in Point::properties() {
        vertex.properties.add(PropertyDef::new(name.to_owned(), PropertyType::Scalar(kind)));
    }
    ply.header.elements.add(vertex);
    ply.payload.insert("vertex".to_owned(), points(voxels, grid));
    let mut bytes = Vec::new();
    Writer::new().write_ply(&mut bytes, &mut ply).map_err(|error| ExportError::new(file, error))?;
    write_file(file, &bytes)
}

fn points(voxels: &WorldVoxels, grid: &Grid) -> Vec<Point> {
    let WorldVoxels { cells, occupancy, albedo, normal } = voxels;
    let point = |index: usize| Point {
        position: grid.corner() + (IVec3::from_array(cells[index]).as_dvec3() + 0.5) * grid.span,
        normal: normal[index],
        color: albedo[index].map(srgb_byte),
        occupancy: occupancy[index],
        cell: cells[index],
    };
    (0..cells.len()).map(point).collect()
}

struct Point {
    position: DVec3,
    normal: [f32; 3],
    color: [u8; 3],
    occupancy: f32,
    cell: [i32; 3],
}

const POSITION: [&str; 3] = ["x", "y", "z"];
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];
const COLOR: [&str; 3] = ["red", "green", "blue"];
const OCCUPANCY: &str = "occupancy";
const CELL: [&str; 3] = ["i", "j", "k"];

impl Point {
    fn properties() -> impl Iterator<Item = (&'static str, ScalarType)> {
        let triple = |names: [&'static str; 3], kind: ScalarType| names.map(|name| (name, kind.clone())).into_iter();
        triple(POSITION, ScalarType::Double)
            .chain(triple(NORMAL, ScalarType::Float))
            .chain(triple(COLOR, ScalarType::UChar))
            .chain([(OCCUPANCY, ScalarType::Float)])
            .chain(triple(CELL, ScalarType::Int))
    }
}

fn component<T: Copy>(names: [&str; 3], name: &str, values: [T; 3]) -> Option<T> {
    names.iter().position(|known| *known == name).map(|axis| values[axis])
}

impl PropertyAccess for Point {
    fn new() -> Self {
        Self { position: DVec3::ZERO, normal: [0.0; 3], color: [0; 3], occupancy: 0.0, cell: [0; 3] }
    }

    fn get_double(&self, name: &str) -> Option<f64> {
        component(POSITION, name, self.position.to_array())
    }

    fn get_float(&self, name: &str) -> Option<f32> {
        if name == OCCUPANCY { Some(self.occupancy) } else { component(NORMAL, name, self.normal) }
    }

    fn get_uchar(&self, name: &str) -> Option<u8> {
        component(COLOR, name, self.color)
    }

    fn get_int(&self, name: &str) -> Option<i32> {
        component(CELL, name, self.cell)
    }
}

#[cfg(test)]
mod tests {
    use ndarray::{Array0, Array1, Array2};
    use ndarray_npy::NpzReader;
    use ply_rs_bw::parser::Parser;
    use ply_rs_bw::ply::{DefaultElement, Property};

    use super::*;

    fn two_voxels() -> (WorldVoxels, Grid) {
        let voxels = WorldVoxels {
            cells: vec![[1, 2, 3], [63, 0, 7]],
            occupancy: vec![1.0, 0.25],
            albedo: vec![[0.0, 0.5, 1.0], [0.2, 0.2, 0.2]],
            normal: vec![[0.0, 1.0, 0.0], [0.6, 0.0, -0.8]],
        };
        let grid = Grid { anchor: DVec3::new(10.0, 0.0, 0.0), offset_cells: IVec3::splat(-4), span: 0.5, depth: 6 };
        (voxels, grid)
    }

    #[test]
    fn arrays_come_back_as_they_were() {
        let (voxels, grid) = two_voxels();
        let mut npz = NpzReader::new(Cursor::new(npz(&voxels, &grid).unwrap())).unwrap();
        let cells: Array2<i32> = npz.by_name("cells").unwrap();
        assert_eq!(cells, aview2(&voxels.cells));
        let occupancy: Array1<f32> = npz.by_name("occupancy").unwrap();
        assert_eq!(occupancy, aview1(&voxels.occupancy));
        for (name, expected) in [("albedo", &voxels.albedo), ("normal", &voxels.normal)] {
            let triples: Array2<f32> = npz.by_name(name).unwrap();
            assert_eq!(triples, aview2(expected));
        }
        let corner: Array1<f64> = npz.by_name("grid_corner").unwrap();
        assert_eq!(corner.to_vec(), [8.0, -2.0, -2.0]);
        let span: Array0<f64> = npz.by_name("span").unwrap();
        assert_eq!(span.into_scalar(), 0.5);
    }

    #[test]
    fn points_lie_at_cell_centres() {
        let (voxels, grid) = two_voxels();
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("voxels.ply");
        write_ply(&file, &voxels, &grid).unwrap();
        let mut reader = std::io::BufReader::new(std::fs::File::open(&file).unwrap());
        let ply = Parser::<DefaultElement>::new().read_ply(&mut reader).unwrap();
        assert_eq!(ply.header.comments, ["grid_corner 8 -2 -2", "span 0.5"]);
        let point = &ply.payload["vertex"][0];
        assert_eq!(point["x"], Property::Double(8.75));
        assert_eq!((&point["j"], &point["occupancy"]), (&Property::Int(2), &Property::Float(1.0)));
        assert_eq!((&point["green"], &point["blue"]), (&Property::UChar(188), &Property::UChar(255)));
        assert_eq!(ply.payload["vertex"][1]["nz"], Property::Float(-0.8));
    }
}
