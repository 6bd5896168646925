//! Links of pages to files, pictures and headings.

use std::collections::BTreeSet;
use std::path::Path;

use super::{pages, text};

/// Targets of `[…](…)`, outside of code.
fn targets(text: &str) -> Vec<&str> {
    let prose = text.split("\n```").step_by(2).flat_map(str::lines).filter(|line| !line.starts_with("    "));
    prose.flat_map(|line| line.split("](").skip(1).filter_map(|rest| rest.split(')').next())).collect()
}

/// As the anchors of a rendered page: lower case, spaces as hyphens, no punctuation.
fn anchors(text: &str) -> BTreeSet<String> {
    let headings = text.lines().filter(|line| line.starts_with('#')).map(|line| line.trim_start_matches('#').trim());
    let kept = |c: char| c.is_alphanumeric() || "-_".contains(c);
    let anchor = |heading: &str| -> String {
        heading.to_lowercase().chars().map(|c| if c == ' ' { '-' } else { c }).filter(|c| kept(*c)).collect()
    };
    headings.map(anchor).collect()
}

fn check(page: &Path, target: &str) -> Result<(), String> {
    let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
    let file = match file {
        "" => page.to_owned(),
        file => page.parent().unwrap_or(page).join(file),
    };
    if !file.exists() {
        return Err(format!("{}: {target} is not there", page.display()));
    }
    if !anchor.is_empty() && !anchors(&text(&file)).contains(anchor) {
        return Err(format!("{}: {target} has no such heading", page.display()));
    }
    Ok(())
}

#[test]
fn links_lead_to_files_and_headings() {
    let mut count = 0;
    for page in pages() {
        let text = text(&page);
        for target in targets(&text).into_iter().filter(|target| !target.contains("://")) {
            check(&page, target).unwrap_or_else(|error| panic!("{error}"));
            count += 1;
        }
    }
    assert!(count > 20, "only {count} links were found");
}

#[test]
fn a_wrong_link_is_found() {
    let readme = super::root().join("README.md");
    assert!(check(&readme, "docs/none.md").is_err());
    assert!(check(&readme, "#no-such-heading").is_err());
    assert!(check(&readme, "LICENSE-MIT").is_ok());
    assert_eq!(targets("a [b](c.md#d) e ![f](g.png)\n    [no](code)\n"), ["c.md#d", "g.png"]);
    assert!(anchors("# What's a *node*?\n").contains("whats-a-node"));
}
