//! Tables of `octolume bench`: kernels of a rebuild, light, samples, bytes, and passes of lit surfaces.

use std::collections::BTreeMap;

use octolume::settings::Settings;
use serde::de::Error;
use serde::{Deserialize, Deserializer};
use serde_json::Value;

use super::markdown::{Table, or_dash, three_digits};
use super::measured::Files;

/// Of a kernel that is compared with its floor; less takes no time that could be told.
const LEAST_BYTES: u64 = 50_000;

#[derive(Deserialize)]
struct Report {
    scene: String,
    #[serde(deserialize_with = "of_any_format")]
    settings: Settings,
    copy: Cost,
    kernels: Vec<Cost>,
    rebuild: Cost,
    light: Option<Light>,
    surfaces: Option<Surfaces>,
}

#[derive(Deserialize)]
struct Cost {
    kernel: String,
    median_ms: f64,
    p5_ms: f64,
    p95_ms: f64,
    bytes: u64,
    floor_ms: f64,
    ratio: Option<f64>,
}

#[derive(Deserialize)]
struct Light {
    passes: Vec<Cost>,
    sampling: Vec<Samples>,
    memory: Memory,
}

#[derive(Deserialize)]
struct Samples {
    sampling: String,
    lookup: String,
    near_leaves: bool,
    million_samples_per_s: f64,
}

#[derive(Deserialize)]
struct Memory {
    nodes: u64,
    bytes_per_node: f64,
    bytes_per_node_with_node_pointers: f64,
}

#[derive(Deserialize)]
struct Surfaces {
    variants: Vec<Variant>,
}

#[derive(Deserialize)]
struct Variant {
    name: String,
    kernels_ms: BTreeMap<String, f64>,
    total: Total,
}

#[derive(Deserialize)]
struct Total {
    median_ms: f64,
}

fn of_any_format<'de, D: Deserializer<'de>>(settings: D) -> Result<Settings, D::Error> {
    Settings::from_json(&Value::deserialize(settings)?.to_string()).map_err(D::Error::custom)
}

impl Report {
    /// "Sponza at 512³, turned by 10°".
    fn title(&self) -> String {
        let turned = match self.settings.shot.motion.turn_degrees[1] {
            0.0 => String::new(),
            degrees => format!(", turned by {degrees}°"),
        };
        format!("{} at {}³{turned}", self.scene, self.settings.method.discretization.grid)
    }

    /// In the order of a frame, the whole and the copy last; without clears and copies, which no folder has.
    fn costs(&self) -> impl Iterator<Item = &Cost> {
        let kernels = self.kernels.iter().filter(|cost| cost.kernel.contains('/'));
        kernels.chain([&self.rebuild, &self.copy])
    }

    fn light(&self) -> &Light {
        self.light.as_ref().expect("a report with --lighting")
    }
}

impl Cost {
    fn megabytes(&self) -> String {
        format!("{:.1}", self.bytes as f64 / 1e6)
    }

    /// None of what moves next to nothing.
    fn ratio(&self) -> String {
        or_dash(self.ratio.filter(|_| self.bytes >= LEAST_BYTES), |ratio| format!("{ratio:.1}"))
    }
}

/// Medians of every scene and pose; what the last has to move.
pub fn rebuild(files: &Files) -> Table {
    let reports: Vec<Report> = files.reports();
    let (last, before) = reports.split_last().expect("a file");
    let title = |report: &Report| format!("{}, ms", report.title());
    let heads = ["kernel".to_owned()].into_iter().chain(before.iter().map(title)).chain([title(last)]);
    let mut table =
        Table::new(1, heads.chain(["p5 to p95", "MB to move", "floor ms", "times the floor"].map(Into::into)));
    for cost in last.costs() {
        let of_kernel = |report: &Report| {
            let found = report.costs().find(|found| found.kernel == cost.kernel);
            or_dash(found, |found| three_digits(found.median_ms))
        };
        let spread = format!("{} to {}", three_digits(cost.p5_ms), three_digits(cost.p95_ms));
        let floor = [spread, cost.megabytes(), three_digits(cost.floor_ms), cost.ratio()];
        let times = before.iter().map(of_kernel).chain([three_digits(cost.median_ms)]);
        table.row([cost.kernel.clone()].into_iter().chain(times).chain(floor));
    }
    table
}

/// Kernels by variant, four columns a scene.
pub fn light(files: &Files) -> Table {
    let reports: Vec<Report> = files.reports();
    let heads = |report: &Report| [format!("{}, ms", report.title()), "MB to move".into(), "times the floor".into()];
    let mut table = Table::new(1, ["kernel, variant".into()].into_iter().chain(reports.iter().flat_map(heads)));
    for pass in &reports[0].light().passes {
        let cells = |report: &Report| {
            let found = report.light().passes.iter().find(|found| found.kernel == pass.kernel);
            [
                or_dash(found, |cost| three_digits(cost.median_ms)),
                or_dash(found, Cost::megabytes),
                or_dash(found, Cost::ratio),
            ]
        };
        table.row([pass.kernel.clone()].into_iter().chain(reports.iter().flat_map(cells)));
    }
    table
}

/// Million samples a second.
pub fn samples(files: &Files) -> Table {
    let reports: Vec<Report> = files.reports();
    let heads = |report: &Report| [format!("{}, at leaves", report.title()), "anywhere".into()];
    let mut table =
        Table::new(1, ["million samples a second".into()].into_iter().chain(reports.iter().flat_map(heads)));
    let ways = reports[0].light().sampling.iter().filter(|samples| samples.near_leaves);
    for Samples { sampling, lookup, .. } in ways {
        let cells = |report: &Report| {
            [true, false].map(|near_leaves| {
                let is_it = |found: &&Samples| {
                    (&found.sampling, &found.lookup, found.near_leaves) == (sampling, lookup, near_leaves)
                };
                let found = report.light().sampling.iter().find(is_it);
                or_dash(found, |found| format!("{:.1}", found.million_samples_per_s))
            })
        };
        table.row([format!("{sampling}, {lookup}")].into_iter().chain(reports.iter().flat_map(cells)));
    }
    table
}

pub fn node_bytes(files: &Files) -> Table {
    let mut table = Table::new(1, ["scene", "nodes", "bytes a node, block pointers", "node pointers"]);
    for report in files.reports::<Report>() {
        let Memory { nodes, bytes_per_node, bytes_per_node_with_node_pointers } = report.light().memory;
        let bytes = [bytes_per_node, bytes_per_node_with_node_pointers].map(|bytes| format!("{bytes:.1}"));
        table.row([report.title(), nodes.to_string()].into_iter().chain(bytes));
    }
    table
}

/// Columns of passes, and how the names of their kernels begin.
const PASSES: [(&str, &[&str]); 6] = [
    ("surfaces", &["surface/draw"]),
    ("direct", &["surface/emission", "surface/direct"]),
    ("diffuse", &["cones/diffuse"]),
    ("filter", &["cones/blur", "cones/upsample"]),
    ("specular", &["cones/glossy", "cones/list", "cones/specular"]),
    ("compose", &["surface/compose", "surface/sum", "surface/mean"]),
];

pub fn passes(files: &Files) -> Table {
    let reports: Vec<Report> = files.reports();
    let [report] = &reports[..] else { panic!("one file a table of passes") };
    let heads = PASSES.map(|(head, _)| head.to_owned());
    let mut table = Table::new(1, [format!("{}, ms", report.title())].into_iter().chain(heads).chain(["all".into()]));
    for variant in &report.surfaces.as_ref().expect("a report with --surfaces").variants {
        let of_pass = |(_, starts): (&str, &[&str])| {
            let belongs = |kernel: &str| starts.iter().any(|start| kernel.starts_with(start));
            let ms = variant.kernels_ms.iter().filter(|(kernel, _)| belongs(kernel)).map(|(_, ms)| ms);
            // The sum of no numbers would be −0.
            three_digits(ms.fold(0.0, |sum, ms| sum + ms))
        };
        let all = three_digits(variant.total.median_ms);
        table.row([variant.name.clone()].into_iter().chain(PASSES.map(of_pass)).chain([all]));
    }
    table
}
