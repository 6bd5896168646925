//! Tables as pages hold them.

use std::fmt;

/// The widest line of a page that is no row.
pub const COLUMNS: usize = 120;

pub struct Table {
    heads: Vec<String>,
    rows: Vec<Vec<String>>,
    /// Columns of text, from the left; the rest are numbers.
    texts: usize,
}

impl Table {
    pub fn new<S: Into<String>>(texts: usize, heads: impl IntoIterator<Item = S>) -> Self {
        Self { heads: heads.into_iter().map(Into::into).collect(), rows: Vec::new(), texts }
    }

    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        let cells: Vec<String> = cells.into_iter().map(Into::into).collect();
        assert_eq!(cells.len(), self.heads.len(), "a row like the head: {cells:?}");
        self.rows.push(cells);
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let line = |cells: &[String]| format!("| {} |", cells.join(" | "));
        let aligned = |column: usize| if column < self.texts { "---" } else { "--:" };
        let under: Vec<_> = (0..self.heads.len()).map(aligned).collect();
        writeln!(f, "{}\n|{}|", line(&self.heads), under.join("|"))?;
        self.rows.iter().try_for_each(|row| writeln!(f, "{}", line(row)))
    }
}

/// Milliseconds, or other sizes: three digits that count, at least.
pub fn three_digits(value: f64) -> String {
    match value.abs() {
        size if size >= 99.95 => format!("{value:.0}"),
        size if size >= 9.995 => format!("{value:.1}"),
        _ => format!("{value:.2}"),
    }
}

/// A dash where nothing was measured.
pub fn or_dash<T>(value: Option<T>, text: impl Fn(T) -> String) -> String {
    value.map_or_else(|| "–".to_owned(), text)
}

/// Breaks lines between words.
pub fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let last = lines.len() - 1;
        let line = &mut lines[last];
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > COLUMNS {
            lines.push(word.to_owned());
        } else {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(word);
        }
    }
    lines.join("\n")
}
