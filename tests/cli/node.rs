//! `octolume node`: one node's facts, and pointers that can be followed from call to call.

use serde_json::{Value, json};

use crate::{fields, json, octolume, succeed};

fn node(level: u64, cell: &Value) -> Value {
    let cell: Vec<String> = cell.as_array().expect("a cell").iter().map(Value::to_string).collect();
    json(["node", "courtyard", "--json", "--level", &level.to_string(), "--cell", &cell.join(",")])
}

#[test]
fn pointers_are_followed_from_node_to_node() {
    let mut here = node(0, &json!([0, 0, 0]));
    for level in 0..6 {
        let names = ["albedo", "block", "corners", "first_child", "forward", "has_pointers", "key", "node", "normal"];
        assert!(names.iter().all(|name| fields(&here).contains(name)), "{here}");
        assert_eq!(here["node"]["address"]["level"], level);
        let child = here["first_child"].clone();
        here = node(level + 1, &child["address"]["cell"]);
        assert_eq!(here["node"], child, "the pointer leads there");
        let ahead = &here["forward"][0];
        let cell = |node: &Value| node["address"]["cell"][0].as_u64().expect("a number");
        assert_eq!(cell(ahead), cell(&here["node"]) + 1);
        if here["first_child"].is_null() {
            // A dummy without children: go on where something is.
            here = node(level + 1, &ahead["address"]["cell"]);
        }
        if here["first_child"].is_null() {
            break;
        }
    }
}

#[test]
fn a_node_reads_well_without_json() {
    let text = succeed(["node", "courtyard", "--level", "0", "--cell", "0,0,0", "--sun", "500"]);
    assert!(text.starts_with("node 0 (level 0, cell 0,0,0), on a dense level, key 0\noccupancy 0."), "{text}");
    assert!(text.contains("\nradiance ") && text.contains("first child: 1 (level 1, cell 0,0,0"), "{text}");
    assert!(text.contains("ahead along z: none"), "{text}");
}

#[test]
fn cells_that_are_not_there_are_told() {
    for (options, code, cause) in [
        (["--level", "8", "--cell", "0,0,0"], 2, "0 (the root) to 7"),
        (["--level", "3", "--cell", "0,8,0"], 2, "0 to 7 along an axis"),
        (["--level", "3", "--cell", "0,-1,0"], 2, "whole numbers from 0"),
        (["--level", "7", "--cell", "63,127,63"], 1, "no node is stored at level 7, cell 63,127,63"),
    ] {
        let output = octolume(["node", "courtyard"].iter().chain(&options));
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{options:?}: {errors}");
        assert!(errors.contains(cause), "{options:?}: {errors}");
    }
}
