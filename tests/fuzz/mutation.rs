//! Ways to spoil a file: its bytes, the members of its document, the numbers of its accessors.

use bolero::TypeGenerator;
use serde_json::{Map, Value, json};

/// A change of raw bytes. Places count from the start and wrap around.
#[derive(Clone, Debug, TypeGenerator)]
pub enum Edit {
    Set { at: u16, to: u8 },
    Flip { at: u16, bit: u8 },
    Word { at: u16, to: Number },
    Insert { at: u16, bytes: [u8; 3] },
    Remove { at: u16, count: u8 },
    Cut { keep: u16 },
}

impl Edit {
    pub fn apply(&self, bytes: &mut Vec<u8>) {
        if bytes.is_empty() {
            return;
        }
        let place = |at: u16| usize::from(at) % bytes.len();
        match *self {
            Self::Set { at, to } => {
                let at = place(at);
                bytes[at] = to;
            }
            Self::Flip { at, bit } => {
                let at = place(at);
                bytes[at] ^= 1 << (bit % 8);
            }
            Self::Word { at, ref to } => {
                let at = place(at) & !3;
                let word = (to.value().as_f64().unwrap_or(0.0) as i64 as u32).to_le_bytes();
                bytes.iter_mut().skip(at).zip(word).for_each(|(byte, new)| *byte = new);
            }
            Self::Insert { at, bytes: new } => {
                let at = place(at);
                bytes.splice(at..at, new);
            }
            Self::Remove { at, count } => {
                let at = place(at);
                let end = (at + usize::from(count)).min(bytes.len());
                bytes.drain(at..end);
            }
            Self::Cut { keep } => {
                let keep = place(keep);
                bytes.truncate(keep);
            }
        }
    }
}

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

/// A value that has no business there.
#[derive(Clone, Debug, TypeGenerator)]
pub enum Odd {
    Null,
    True,
    Text,
    LongText,
    List,
    Object,
    Nested { depth: u8 },
    Small { number: i8 },
    Number(Number),
}

#[derive(Clone, Debug, TypeGenerator)]
pub enum Number {
    Zero,
    MinusOne,
    Half,
    Byte { value: u8 },
    Short { value: u16 },
    Million,
    HalfWord,
    Word,
    Long,
    Huge,
    Tiny,
    Component { which: u8 },
}

#[derive(Clone, Debug, TypeGenerator)]
pub enum Float {
    Nan,
    Infinite,
    Largest,
    Smallest,
    Far,
    Zero,
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

/// 5124 is not one.
const COMPONENT_TYPES: [u32; 7] = [5120, 5121, 5122, 5123, 5124, 5125, 5126];

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

impl Odd {
    fn value(&self) -> Value {
        match self {
            Self::Null => Value::Null,
            Self::True => json!(true),
            Self::Text => json!("data:,%zz"),
            Self::LongText => json!("\u{10ffff}".repeat(1000)),
            Self::List => json!([]),
            Self::Object => Value::Object(Map::new()),
            Self::Nested { depth } => (0..*depth).fold(json!(0), |inner, _| json!([inner])),
            Self::Small { number } => json!(number),
            Self::Number(number) => number.value(),
        }
    }
}

impl Number {
    fn value(&self) -> Value {
        match *self {
            Self::Zero => json!(0),
            Self::MinusOne => json!(-1),
            Self::Half => json!(0.5),
            Self::Byte { value } => json!(value),
            Self::Short { value } => json!(value),
            Self::Million => json!(1_000_000),
            Self::HalfWord => json!(1_u32 << 31),
            Self::Word => json!(u32::MAX),
            Self::Long => json!(u64::MAX),
            Self::Huge => json!(1e300),
            Self::Tiny => json!(1e-300),
            Self::Component { which } => json!(COMPONENT_TYPES[usize::from(which) % COMPONENT_TYPES.len()]),
        }
    }
}

impl Float {
    fn value(&self) -> f32 {
        match self {
            Self::Nan => f32::NAN,
            Self::Infinite => f32::NEG_INFINITY,
            Self::Largest => f32::MAX,
            Self::Smallest => f32::from_bits(1),
            Self::Far => 1e30,
            Self::Zero => 0.0,
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
