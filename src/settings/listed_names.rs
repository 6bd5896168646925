//! Names that an error offers in place of one that means nothing.

use std::collections::BTreeSet;

/// At most so many.
const LISTED_NAMES: usize = 12;

/// `what` names the names, as in "its lights are"; `none` is the sentence where there are none.
pub(super) fn listed(what: &str, none: &str, names: &BTreeSet<&str>) -> String {
    let listed: Vec<String> = names.iter().take(LISTED_NAMES).map(|name| format!("\"{name}\"")).collect();
    match names.len() - listed.len() {
        0 if listed.is_empty() => none.to_owned(),
        0 => format!("{what} {}", listed.join(", ")),
        more => format!("{what} {} and {more} more", listed.join(", ")),
    }
}
