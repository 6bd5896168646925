//! Values that nobody expects.

use bolero::TypeGenerator;
use serde_json::{Map, Value, json};

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

/// 5124 is not one.
const COMPONENT_TYPES: [u32; 7] = [5120, 5121, 5122, 5123, 5124, 5125, 5126];

impl Odd {
    pub fn value(&self) -> Value {
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
    pub fn value(&self) -> Value {
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
    pub fn value(&self) -> f32 {
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
