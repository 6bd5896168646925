//! Ways to spoil a document: its members, the numbers of its accessors, its buffer.

use bolero::TypeGenerator;
use serde_json::Value;

use crate::odd::{Float, Number, Odd};

/// A change of a document or its buffer. A place is a value of the tree, counted in the order of its
/// text.
#[derive(Clone, Debug, TypeGenerator)]
pub enum Mutation {
    Remove {
        place: u16,
    },
    Put {
        place: u16,
        odd: Odd,
    },
    PutNumber {
        number_place: u16,
        number: Number,
    },
    /// Another index, type or count of the same document.
    CopyNumber {
        from: u16,
        to: u16,
    },
    Copy {
        from: u16,
        to: u16,
    },
    Repeat {
        place: u16,
        times: u8,
    },
    Member {
        place: u16,
        name: u8,
        odd: Odd,
    },
    Accessor {
        accessor: u8,
        member: u8,
        number: Number,
    },
    Float {
        at: u16,
        number: Float,
    },
    Byte {
        at: u16,
        to: u8,
    },
    Cut {
        keep: u16,
    },
}

/// Members that change how others are read.
const NAMES: [&str; 24] = [
    "sparse",
    "byteStride",
    "byteOffset",
    "normalized",
    "count",
    "bufferView",
    "buffer",
    "uri",
    "mimeType",
    "matrix",
    "translation",
    "rotation",
    "scale",
    "weights",
    "children",
    "skin",
    "mesh",
    "camera",
    "extensions",
    "extras",
    "targets",
    "indices",
    "mode",
    "skeleton",
];

const ACCESSOR_MEMBERS: [&str; 5] = ["byteOffset", "count", "componentType", "bufferView", "normalized"];

impl Mutation {
    pub fn apply(&self, json: &mut Value, binary: &mut Vec<u8>) {
        match self {
            Self::Remove { place } => remove(json, *place),
            Self::Put { place, odd } => with_value(json, *place, |value| *value = odd.value()),
            Self::PutNumber { number_place, number } => with_number(json, *number_place, number.value()),
            Self::CopyNumber { from, to } => {
                let number = pick(&paths(json, Value::is_number), *from).and_then(|path| json.pointer(path)).cloned();
                number.into_iter().for_each(|number| with_number(json, *to, number));
            }
            Self::Copy { from, to } => {
                let copy = pick(&paths(json, |_| true), *from).and_then(|path| json.pointer(path)).cloned();
                copy.into_iter().for_each(|copy| with_value(json, *to, |value| *value = copy));
            }
            Self::Repeat { place, times } => repeat(json, *place, *times),
            Self::Member { place, name, odd } => with_value(json, *place, |value| {
                if let Value::Object(members) = value {
                    members.insert(NAMES[usize::from(*name) % NAMES.len()].to_owned(), odd.value());
                }
            }),
            Self::Accessor { accessor, member, number } => spoil_accessor(json, *accessor, *member, number.value()),
            Self::Float { at, number } if !binary.is_empty() => {
                let at = (usize::from(*at) % binary.len()) & !3;
                let bytes = number.value().to_le_bytes();
                binary.iter_mut().skip(at).zip(bytes).for_each(|(byte, new)| *byte = new);
            }
            Self::Byte { at, to } if !binary.is_empty() => {
                let at = usize::from(*at) % binary.len();
                binary[at] = *to;
            }
            Self::Cut { keep } => binary.truncate(usize::from(*keep)),
            Self::Float { .. } | Self::Byte { .. } => {}
        }
    }
}

fn pick(paths: &[String], place: u16) -> Option<&str> {
    paths.get(usize::from(place) % paths.len().max(1)).map(String::as_str)
}

/// JSON pointers of what `keep` keeps, the document itself left out.
fn paths(json: &Value, keep: fn(&Value) -> bool) -> Vec<String> {
    fn walk(value: &Value, path: &str, keep: fn(&Value) -> bool, found: &mut Vec<String>) {
        let mut enter = |key: &str, child: &Value| {
            let path = format!("{path}/{}", key.replace('~', "~0").replace('/', "~1"));
            walk(child, &path, keep, found);
            if keep(child) {
                found.push(path);
            }
        };
        match value {
            Value::Array(items) => items.iter().enumerate().for_each(|(index, item)| enter(&index.to_string(), item)),
            Value::Object(members) => members.iter().for_each(|(key, member)| enter(key, member)),
            _ => {}
        }
    }
    let mut found = Vec::new();
    walk(json, "", keep, &mut found);
    found
}

fn with_value(json: &mut Value, place: u16, act: impl FnOnce(&mut Value)) {
    let paths = paths(json, |_| true);
    if let Some(value) = pick(&paths, place).and_then(|path| json.pointer_mut(path)) {
        act(value);
    }
}

fn with_number(json: &mut Value, place: u16, number: Value) {
    let paths = paths(json, Value::is_number);
    if let Some(value) = pick(&paths, place).and_then(|path| json.pointer_mut(path)) {
        *value = number;
    }
}

fn remove(json: &mut Value, place: u16) {
    let paths = paths(json, |_| true);
    let Some((parent, key)) = pick(&paths, place).and_then(|path| path.rsplit_once('/')) else { return };
    match json.pointer_mut(parent) {
        Some(Value::Array(items)) => {
            key.parse::<usize>().ok().filter(|&index| index < items.len()).map(|index| items.remove(index));
        }
        Some(Value::Object(members)) => {
            members.remove(&key.replace("~1", "/").replace("~0", "~"));
        }
        _ => {}
    }
}

/// Items of a list follow themselves.
fn repeat(json: &mut Value, place: u16, times: u8) {
    let paths = paths(json, |value| value.as_array().is_some_and(|items| !items.is_empty()));
    if let Some(Value::Array(items)) = pick(&paths, place).and_then(|path| json.pointer_mut(path)) {
        let last = items[items.len() - 1].clone();
        items.extend(std::iter::repeat_n(last, usize::from(times)));
    }
}

fn spoil_accessor(json: &mut Value, accessor: u8, member: u8, number: Value) {
    let Some(Value::Array(accessors)) = json.get_mut("accessors") else { return };
    let length = accessors.len().max(1);
    if let Some(Value::Object(accessor)) = accessors.get_mut(usize::from(accessor) % length) {
        accessor.insert(ACCESSOR_MEMBERS[usize::from(member) % ACCESSOR_MEMBERS.len()].to_owned(), number);
    }
}
