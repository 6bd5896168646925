//! Shader sources: embedded at build time, put together from `#import` lines.
//!
//! `#import shared/octree.wgsl` pulls another file of `shaders/` in once, `#import constants` the
//! numbers shared with Rust. A [`Source`] remembers where each line came from, so that errors of
//! the compiler name file and line.

use std::collections::BTreeSet;

use super::{Constant, GpuError};

/// What kernels are compiled from.
#[derive(Debug)]
pub struct Shaders {
    /// Path below `shaders/` and text of every shader.
    pub files: &'static [(&'static str, &'static str)],
    /// What `#import constants` stands for, list by list.
    pub constants: &'static [&'static [Constant]],
}

impl Shaders {
    /// A shader of `shaders/`, imports resolved.
    pub fn embedded(&self, path: &str) -> Result<Source, GpuError> {
        let Some(text) = self.file(path) else {
            return Err(GpuError::Shader { place: path.to_owned(), cause: "there is no such shader".to_owned() });
        };
        self.inline(path, text)
    }

    /// Text that may import files of `shaders/`; `path` is what errors name it.
    pub fn inline(&self, path: &str, text: &str) -> Result<Source, GpuError> {
        let mut source = Source { path: path.to_owned(), wgsl: String::new(), lines: Vec::new() };
        source.append(self, (path, text), &mut BTreeSet::from([path.to_owned()]))?;
        Ok(source)
    }

    fn file(&self, path: &str) -> Option<&'static str> {
        self.files.iter().find(|(name, _)| *name == path).map(|(_, text)| *text)
    }
}

/// WGSL without imports.
#[derive(Clone, Debug)]
pub struct Source {
    pub path: String,
    pub wgsl: String,
    /// File and line number (from 1) of every line of `wgsl`.
    lines: Vec<(String, usize)>,
}

impl Source {
    /// `file:line` of a line number (from 1) of the combined text.
    pub fn place(&self, line_number: usize) -> String {
        match self.lines.get(line_number.wrapping_sub(1)) {
            Some((file, line)) => format!("{file}:{line}"),
            None => self.path.clone(),
        }
    }

    fn append(
        &mut self,
        shaders: &Shaders,
        (path, text): (&str, &str),
        seen: &mut BTreeSet<String>,
    ) -> Result<(), GpuError> {
        for (index, line) in text.lines().enumerate() {
            let Some(import) = line.trim_start().strip_prefix("#import ").map(str::trim) else {
                self.push(path, index + 1, line);
                continue;
            };
            if !seen.insert(import.to_owned()) {
                continue;
            }
            if import == "constants" {
                let constants = shaders.constants.iter().copied().flatten();
                constants.for_each(|constant| self.push(path, index + 1, &constant.wgsl()));
            } else if let Some(text) = shaders.file(import) {
                self.append(shaders, (import, text), seen)?;
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
