//! The frame plan: every pass, whether it runs, is reused or skipped, and why.

use egui::Ui;

use super::table::{self, Cell};
use crate::app::palette::Tone;
use crate::plan::{FramePlan, Pass, Row, State};

pub fn ui(ui: &mut Ui, plan: &FramePlan) {
    let rows = plan.rows.iter().map(|row| {
        let (state, color) = state(row.state);
        vec![
            Cell::new(name(row)).color(pass_color(row.state)).tip(kernels(row.pass)),
            Cell::new(state).color(color),
            Cell::new(row.reason).color(Tone::Weak).tip(row.reason),
        ]
    });
    table::show(ui, "plan", &[("pass", 0.0), ("state", 34.0), ("reason", 160.0)], rows.collect());
}

/// Of methods beside the one that is shown, their number too.
fn name(row: &Row) -> String {
    match row.method {
        0 => format!("{:?}", row.pass),
        method => format!("{}: {:?}", method + 1, row.pass),
    }
}

fn state(state: State) -> (&'static str, Tone) {
    match state {
        State::Run => ("run", Tone::Accent),
        State::Reuse => ("reuse", Tone::Warning),
        State::Skip => ("skip", Tone::Weak),
    }
}

fn pass_color(state: State) -> Tone {
    if state == State::Skip { Tone::Weak } else { Tone::Strong }
}

fn kernels(pass: Pass) -> String {
    match pass.kernels() {
        [] => "Work of the CPU".to_owned(),
        kernels => format!("Kernels: {}", kernels.join(", ")),
    }
}
