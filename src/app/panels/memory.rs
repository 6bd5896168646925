//! GPU memory by buffer.

use std::collections::BTreeMap;

use egui::Ui;

use super::table::{self, Cell};
use super::{bytes, grouped};
use crate::app::palette::Tone;
use crate::gpu::BufferUse;

/// Buffers of one label count together; largest first.
pub fn ui(ui: &mut Ui, buffers: &[BufferUse]) {
    let mut by_label: BTreeMap<&str, (u64, u64)> = BTreeMap::new();
    for buffer in buffers {
        let (count, total) = by_label.entry(&buffer.label).or_default();
        *count += 1;
        *total += buffer.bytes;
    }
    let mut uses: Vec<_> = by_label.into_iter().collect();
    uses.sort_by_key(|(_, (_, total))| std::cmp::Reverse(*total));
    let total: u64 = uses.iter().map(|(_, (_, total))| total).sum();
    let mut rows = vec![vec![
        Cell::new("All buffers").color(Tone::Strong),
        Cell::new(grouped(buffers.len() as u64)).color(Tone::Strong),
        Cell::new(bytes(total)).color(Tone::Strong),
    ]];
    rows.extend(uses.into_iter().map(|(label, (count, total))| {
        vec![
            Cell::new(label).tip(label),
            grouped(count).into(),
            Cell::new(bytes(total)).tip(format!("{} bytes", grouped(total))),
        ]
    }));
    table::show(ui, "memory", &[("buffer", 0.0), ("count", 40.0), ("size", 72.0)], rows);
}
