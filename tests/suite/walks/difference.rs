//! How the end of a walk differs from that of a fresh engine.

use octolume::data::world_voxels::WorldVoxels;
use octolume::engine::{Engine, EngineError, FilterReport};

/// What of two engines' results is not the same, bit for bit, and how.
pub fn difference(walked: &Engine, fresh: &Engine) -> Option<String> {
    let counts = |engine: &Engine| {
        let report = engine.accuracy();
        let of = |filter: Option<FilterReport>| {
            filter.map(|f| (f.filter, f.voxels, f.leaves, f.nodes, f.bytes, f.holes, f.spill))
        };
        report.map(|report| (of(report.nearest), of(report.split), report.exact_cells))
    };
    let light = |engine: &Engine| (engine.exposure().to_bits(), engine.value_range(), engine.glossy_tiles());
    let image = |engine: &Engine| read(engine.read_image()).map(image::RgbaImage::into_raw);
    let lists = [
        lists_differ("the picture", image(walked), image(fresh)),
        lists_differ("the voxels", voxels(walked), voxels(fresh)),
        lists_differ("the light of surfaces", bits(walked), bits(fresh)),
        differ("the octree's report", &walked.octree_report(), &fresh.octree_report()),
        differ("holes and spill", &counts(walked), &counts(fresh)),
        differ("exposure or scale", &light(walked), &light(fresh)),
        differ("what is left out", &walked.left_out(), &fresh.left_out()),
    ];
    lists.into_iter().flatten().next()
}

fn read<T>(read: Result<T, EngineError>) -> Result<T, String> {
    read.map_err(|error| error.to_string())
}

type Voxel = ([i32; 3], f32, [f32; 3], [f32; 3]);

fn voxels(engine: &Engine) -> Result<Vec<Voxel>, String> {
    let WorldVoxels { cells, occupancy, albedo, normal } = read(engine.read_voxels())?;
    let rest = occupancy.into_iter().zip(albedo).zip(normal);
    Ok(cells
        .into_iter()
        .zip(rest)
        .map(|(cell, ((occupancy, albedo), normal))| (cell, occupancy, albedo, normal))
        .collect())
}

fn bits(engine: &Engine) -> Result<Vec<u32>, String> {
    let light = read(engine.read_surfaces())?.unwrap_or_default();
    Ok(light.as_flattened().iter().map(|value| value.to_bits()).collect())
}

fn differ<T: PartialEq + std::fmt::Debug>(what: &str, walked: &T, fresh: &T) -> Option<String> {
    (walked != fresh).then(|| format!("{what} differs: {walked:?}, fresh {fresh:?}"))
}

/// Lists are too long to print: how many there are, where the first two differ, or why one could not be read.
fn lists_differ<T>(what: &str, walked: Result<Vec<T>, String>, fresh: Result<Vec<T>, String>) -> Option<String>
where
    T: PartialEq + std::fmt::Debug,
{
    let (Ok(walked), Ok(fresh)) = (&walked, &fresh) else {
        let told = [&walked, &fresh].map(|list| list.as_ref().map(Vec::len));
        return differ(what, &told[0], &told[1]);
    };
    let first = walked.iter().zip(fresh).position(|(walked, fresh)| walked != fresh);
    let first = first.or((walked.len() != fresh.len()).then(|| walked.len().min(fresh.len())))?;
    let at = |list: &[T]| format!("{:?} of {}", list.get(first), list.len());
    Some(format!("{what} differ at {first}: {}, fresh {}", at(walked), at(fresh)))
}
