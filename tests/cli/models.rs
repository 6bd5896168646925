//! The real models of the shared folder: what `octolume info` counts in each is what their list
//! says; where it is not, the difference is listed here with its reason.

use std::collections::BTreeMap;
use std::fs;

use rayon::prelude::*;
use serde_json::Value;

use crate::json;
use crate::real_scenes::real_scenes;

/// What is compared.
type Counts = BTreeMap<&'static str, u64>;

/// Columns of the list, and their names in the program's JSON; of lists, the length.
const COLUMNS: [(&str, &str); 5] =
    [("tris", "triangles"), ("mesh nodes", "objects"), ("skins", "skins"), ("joints", "joints"), ("anims", "clips")];

/// File, what differs, the program's count, and why.
const EXPLAINED: [(&str, &str, u64, &str); 4] = [
    ("MultipleScenes/MultipleScenes.gltf", "triangles", 2, "the list counts both scenes, and one is shown"),
    ("MultipleScenes/MultipleScenes.gltf", "objects", 1, "the list counts both scenes, and one is shown"),
    ("SimpleInstancing/SimpleInstancing.gltf", "triangles", 1500, "the list does not multiply the 125 instances"),
    ("SimpleInstancing/SimpleInstancing.gltf", "objects", 125, "the list does not multiply the 125 instances"),
];

/// The rows of the Markdown table: file and counts.
fn listed(markdown: &str) -> Vec<(String, Counts)> {
    let cells = |line: &str| line.split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>();
    let mut lines = markdown.lines().skip_while(|line| !line.starts_with("| file "));
    let heads = cells(lines.next().expect("a table"));
    let column = |name: &str| heads.iter().position(|head| head == name).expect("a column");
    let count = |row: &[String], name: &str| -> u64 {
        let digits: String = row[column(name)].chars().filter(|c| *c != ',').take_while(char::is_ascii_digit).collect();
        digits.parse().expect("a number")
    };
    lines
        .skip(1)
        .take_while(|line| line.starts_with('|'))
        .map(cells)
        .map(|row| {
            (row[column("file")].clone(), COLUMNS.iter().map(|&(head, name)| (name, count(&row, head))).collect())
        })
        .collect()
}

fn counted(info: &Value) -> Counts {
    let count = |value: &Value| value.as_u64().unwrap_or_else(|| value.as_array().expect("a list").len() as u64);
    COLUMNS.iter().map(|&(_, name)| (name, count(&info[name]))).collect()
}

#[test]
fn models_hold_what_their_list_says() {
    let Some(folder) = real_scenes() else { return };
    let listed = listed(&fs::read_to_string(folder.join("README.md")).expect("a list"));
    assert_eq!(listed.len(), 66);
    for (explained, ..) in EXPLAINED {
        assert!(listed.iter().any(|(file, _)| file == explained), "{explained} is not listed");
    }
    let wrong: Vec<String> = listed
        .par_iter()
        .flat_map_iter(|(file, counts)| {
            let mut expected = counts.clone();
            for (_, name, count, why) in EXPLAINED.iter().filter(|(explained, ..)| explained == file) {
                assert_ne!(expected.insert(name, *count), Some(*count), "{file}: no longer to be explained: {why}");
            }
            let found = counted(&json(["info".as_ref(), folder.join(file).as_os_str(), "--json".as_ref()]));
            (found != expected).then(|| format!("{file}: {found:?}, not {expected:?}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
