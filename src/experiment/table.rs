//! Rows as text.

use serde::Serialize;

/// Columns by their heads, a row a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// What its files are called.
    pub stem: &'static str,
    pub heads: Vec<&'static str>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn new(stem: &'static str, heads: &[&'static str], rows: impl Iterator<Item = Vec<String>>) -> Self {
        Self { stem, heads: heads.to_vec(), rows: rows.collect() }
    }
}

/// A value's name in JSON.
pub(super) fn name_of(value: &impl Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(name)) => name,
        other => other.map(|value| value.to_string()).unwrap_or_default(),
    }
}

/// As angles about x, y and z in tables.
pub(super) fn turn([x, y, z]: [f64; 3]) -> String {
    format!("{x} {y} {z}")
}
