//! The octree on screen, level by level.

use egui::Ui;

use super::table::{self, Cell};
use super::{bytes, grouped, nothing};
use crate::app::numbers::fixed;
use crate::app::palette::Tone;
use crate::data::octree::FULL_WEIGHT;
use crate::engine::{LevelReport, OctreeReport};

/// `shown`: the level in the picture, `None` for the leaves.
pub fn ui(ui: &mut Ui, report: Option<&OctreeReport>, shown: Option<u32>) {
    let Some(report) = report else { return nothing(ui, "No octree is built.") };
    let deepest = report.levels.last().map_or(0, |level| level.level);
    let shown = shown.unwrap_or(deepest).min(deepest);
    let sum = |part: fn(&LevelReport) -> u64| report.levels.iter().map(part).sum::<u64>();
    let total = |count: u64| Cell::new(grouped(count)).color(Tone::Strong);
    let mut rows: Vec<Vec<Cell>> = report.levels.iter().map(|level| row(level, shown, deepest)).collect();
    rows.push(vec![
        Cell::new("All").color(Tone::Strong),
        total(sum(|level| level.nodes)),
        total(sum(|level| level.occupied)),
        total(sum(|level| level.dummies)),
        Cell::new(bytes(report.bytes)).color(Tone::Strong),
    ]);
    let columns = [("level", 0.0), ("nodes", 68.0), ("occupied", 62.0), ("dummies", 66.0), ("size", 64.0)];
    table::show(ui, "octree", &columns, rows);
    weights_ui(ui, report);
}

fn row(level: &LevelReport, shown: u32, deepest: u32) -> Vec<Cell> {
    let name = if level.level == deepest { "leaf".to_owned() } else { level.level.to_string() };
    let name = Cell::new(name).tip(format!("{0}³ cells", 1_u64 << level.level));
    vec![
        if level.level == shown { name.color(Tone::Accent) } else { name },
        grouped(level.nodes).into(),
        grouped(level.occupied).into(),
        Cell::new(grouped(level.dummies)).color(Tone::Weak),
        bytes(level.bytes).into(),
    ]
}

/// Where the weight of the moved voxels went, in voxels.
fn weights_ui(ui: &mut Ui, report: &OctreeReport) {
    let voxels = |weight: u64| fixed(weight as f64 / f64::from(FULL_WEIGHT), 1);
    let rows = vec![
        vec![
            Cell::new("Moved voxels").tip("Kept and clipped weight add up to them, to the last of 2^24 units a voxel."),
            grouped(report.voxels).into(),
        ],
        vec![Cell::new("Kept in the grid"), voxels(report.kept_weight).into()],
        vec![Cell::new("Clipped outside"), voxels(report.clipped_weight).into()],
        vec![
            Cell::new("Clamped, uncovered")
                .tip("What clamping occupancy to 1 removed, and what masks and blended surfaces leave free."),
            voxels(report.excess_weight).into(),
        ],
    ];
    ui.add_space(4.0);
    table::show(ui, "weights", &[("weight", 0.0), ("voxels", 110.0)], rows);
}
