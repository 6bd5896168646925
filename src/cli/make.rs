//! `octolume make`: built-in scenes as files.

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;
use octolume::scene::builtin;

use super::usage::Usage;

/// Writes a built-in scene as a .glb file
#[derive(Debug, Args)]
pub struct Make {
    /// Name of the scene
    #[arg(value_parser = clap::builder::PossibleValuesParser::new(builtin::NAMES))]
    name: String,
    /// The .glb file to write
    #[arg(short, long, value_name = "OUT.glb")]
    output: PathBuf,
}

impl Make {
    pub fn run(&self) -> anyhow::Result<()> {
        let made = builtin::make(&self.name).ok_or_else(|| Usage(format!("no built-in scene \"{}\"", self.name)))?;
        let bytes = made.with_context(|| self.name.clone())?;
        std::fs::write(&self.output, bytes).with_context(|| self.output.display().to_string())
    }
}
