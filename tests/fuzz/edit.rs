//! Ways to spoil a file without knowing what is in it.

use bolero::TypeGenerator;

use crate::odd::Number;

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
