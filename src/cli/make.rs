//! `octolume make`: built-in scenes as files.

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;
use octolume::scene::builtin;

use super::usage::Usage;

/// Of "dynamic", where none are asked for.
const CHARACTERS: u16 = 16;

/// Writes a scene of our own as a .glb file
#[derive(Debug, Args)]
pub struct Make {
    /// Name of the scene
    #[arg(value_parser = clap::builder::PossibleValuesParser::new(builtin::MADE))]
    name: String,
    /// How many characters walk in "dynamic", and as many rings and cubes turn; otherwise 16
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=builtin::MOST_CHARACTERS as i64))]
    characters: Option<u16>,
    /// The .glb file to write
    #[arg(short, long, value_name = "OUT.glb")]
    output: PathBuf,
}

impl Make {
    pub fn run(&self) -> anyhow::Result<()> {
        if self.characters.is_some() && self.name != builtin::DYNAMIC {
            return Err(Usage(format!("--characters counts those of \"{}\" alone", builtin::DYNAMIC)).into());
        }
        let characters = usize::from(self.characters.unwrap_or(CHARACTERS));
        let made = builtin::make(&self.name, characters)
            .ok_or_else(|| Usage(format!("no built-in scene \"{}\"", self.name)))?;
        let bytes = made.with_context(|| self.name.clone())?;
        std::fs::write(&self.output, bytes).with_context(|| self.output.display().to_string())
    }
}
