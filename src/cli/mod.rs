//! The command line: one file a subcommand, all of them over the same engine and settings as the
//! window.
//!
//! JSON goes to standard output alone, messages and progress to standard error. Exit 0: done;
//! 1: could not, in one sentence naming file and cause; 2: wrong usage.

mod accuracy;
mod bench;
mod cache;
mod cone_options;
mod cone_values;
mod drive;
mod info;
mod light_facts;
mod light_values;
mod lighting_options;
mod look_options;
mod make;
mod node;
mod options;
mod output;
mod plan;
mod reference;
mod render;
mod session;
mod usage;
mod values;
mod view_values;
mod voxelized;
mod voxels;
mod window;

use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};

use options::{Common, Moment};
use usage::Usage;

/// Inspects dynamic scene discretization: a scene becomes voxels once, then its voxels move.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// A .gltf or .glb file, or the name of a built-in scene
    #[arg(default_value = session::DEFAULT_SCENE)]
    scene: std::path::PathBuf,
    /// Opens the window as on its first start, and remembers nothing of it
    #[arg(long)]
    fresh: bool,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    moment: Moment,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    Render(render::Render),
    Info(info::Info),
    Voxels(voxels::Voxels),
    Node(node::Node),
    Plan(plan::Plan),
    Bench(bench::Bench),
    Accuracy(accuracy::Accuracy),
    Make(make::Make),
    Cache(cache::Cache),
}

/// Does what the arguments say.
pub fn run(arguments: Arguments) -> anyhow::Result<()> {
    match arguments.command {
        None => window::run(&arguments.scene, arguments.fresh, &arguments.common, &arguments.moment),
        Some(Command::Render(render)) => render.run(),
        Some(Command::Info(info)) => info.run(),
        Some(Command::Voxels(voxels)) => voxels.run(),
        Some(Command::Node(node)) => node.run(),
        Some(Command::Plan(plan)) => plan.run(),
        Some(Command::Bench(bench)) => bench.run(),
        Some(Command::Accuracy(accuracy)) => accuracy.run(),
        Some(Command::Make(make)) => make.run(),
        Some(Command::Cache(cache)) => cache.run(),
    }
}

/// Says on standard error what went wrong, if anything did.
pub fn report(result: anyhow::Result<()>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    if let Some(usage) = error.downcast_ref::<Usage>() {
        let _ = Arguments::command().error(ErrorKind::ValueValidation, usage).print();
        return ExitCode::from(2);
    }
    output::message(&format!("error: {error:#}"));
    ExitCode::FAILURE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }
}
