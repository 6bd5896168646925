//! Shader sources: embedded at build time, put together from `#import` lines.
//!
//! `#import shared/octree.wgsl` pulls another file of `shaders/` in once, `#import constants` the
//! numbers shared with Rust. A [`Source`] remembers where each line came from, so that errors of
//! the compiler name file and line.

use std::collections::BTreeSet;

use super::GpuError;
use super::constants;

/// Path below `shaders/` and text of every shader.
pub const FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// WGSL without imports.
#[derive(Clone, Debug)]
pub struct Source {
    pub path: String,
    pub wgsl: String,
    /// File and line number (from 1) of every line of `wgsl`.
    lines: Vec<(String, usize)>,
}

impl Source {
    /// A shader of `shaders/`, imports resolved.
    pub fn embedded(path: &str) -> Result<Self, GpuError> {
        let Some(text) = file(path) else {
            return Err(GpuError::Shader { place: path.to_owned(), cause: "there is no such shader".to_owned() });
        };
        Self::inline(path, text)
    }

    /// Text that may import files of `shaders/`; `path` is what errors name it.
    pub fn inline(path: &str, text: &str) -> Result<Self, GpuError> {
        let mut source = Self { path: path.to_owned(), wgsl: String::new(), lines: Vec::new() };
        source.append(path, text, &mut BTreeSet::from([path.to_owned()]))?;
        Ok(source)
    }

    /// `file:line` of a line number (from 1) of the combined text.
    pub fn place(&self, line_number: usize) -> String {
        match self.lines.get(line_number.wrapping_sub(1)) {
            Some((file, line)) => format!("{file}:{line}"),
            None => self.path.clone(),
        }
    }

    fn append(&mut self, path: &str, text: &str, seen: &mut BTreeSet<String>) -> Result<(), GpuError> {
        for (index, line) in text.lines().enumerate() {
            let Some(import) = line.trim_start().strip_prefix("#import ").map(str::trim) else {
                self.push(path, index + 1, line);
                continue;
            };
            if !seen.insert(import.to_owned()) {
                continue;
            }
            if import == "constants" {
                constants::wgsl().lines().for_each(|line| self.push(path, index + 1, line));
            } else if let Some(text) = file(import) {
                self.append(import, text, seen)?;
            } else {
                let cause = format!("#import {import}: there is no such shader");
                return Err(GpuError::Shader { place: format!("{path}:{}", index + 1), cause });
            }
        }
        Ok(())
    }

    fn push(&mut self, path: &str, line_number: usize, line: &str) {
        self.wgsl.push_str(line);
        self.wgsl.push('\n');
        self.lines.push((path.to_owned(), line_number));
    }
}

fn file(path: &str) -> Option<&'static str> {
    FILES.iter().find(|(name, _)| *name == path).map(|(_, text)| *text)
}
