//! A path-traced picture as a file: see [`crate::disk_cache::Sealed`] for its head.
//!
//! ```text
//! description  size, samples, seconds that they took
//! pixels       200 bytes each, as in memory: sums of terms, so that more samples go on from there
//! ```

use std::io;

use serde::{Deserialize, Serialize};

use super::Film;
use crate::disk_cache::{ContentKey, DiskCache, Kind, Sealed, open, take};

pub(super) const KIND: Kind = Kind { magic: *b"OCTPATHS", format_version: 1, extension: "film" };

#[derive(Serialize, Deserialize)]
struct Description {
    size_px: [u32; 2],
    samples: u32,
    secs: f64,
}

pub(super) fn encode<'a>(key: &ContentKey, film: &'a Film) -> io::Result<Sealed<'a>> {
    let description = Description { size_px: film.size_px(), samples: film.samples(), secs: film.secs() };
    Sealed::new(&KIND, key, &description, vec![bytemuck::cast_slice(film.pixels())])
}

/// `None` where anything is wrong, or the picture is of another size.
pub(super) fn decode(bytes: &[u8], key: &ContentKey, size_px: [u32; 2]) -> Option<Film> {
    let (description, mut rest) = open(bytes, &KIND, key)?;
    let (description, []) = postcard::take_from_bytes::<Description>(description).ok()? else { return None };
    let Description { size_px: stored_px, samples, secs } = description;
    let pixels = take(&mut rest, u64::from(size_px[0]) * u64::from(size_px[1]))?;
    (rest.is_empty() && stored_px == size_px).then(|| Film::from_pixels(size_px, samples, secs, pixels))?
}

impl DiskCache {
    /// The picture of that key with no more than `most_samples` a pixel; `None` where there is none, or it is
    /// damaged.
    pub fn load_film(&self, key: &ContentKey, size_px: [u32; 2], most_samples: u32) -> Option<Film> {
        let bytes = self.read(&KIND, key)?;
        let film = decode(&bytes, key, size_px)?;
        self.touch(&KIND, key);
        (film.samples() <= most_samples).then_some(film)
    }

    /// Keeps a picture whose pixels all have as many samples; of several, the one with most is kept.
    pub fn store_film(&self, key: &ContentKey, film: &Film) -> io::Result<()> {
        let kept = self.load_film(key, film.size_px(), u32::MAX);
        if kept.is_some_and(|kept| kept.samples() >= film.samples()) {
            return Ok(());
        }
        self.write_entry(&KIND, key, &encode(key, film)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prepare::kept::{ContentWriter, TextureHashes};

    fn key(number: u64) -> ContentKey {
        let textures = TextureHashes::new(&[]);
        let mut writer = ContentWriter::new(&textures);
        writer.number(number);
        writer.finish()
    }

    fn bytes(film: &Film) -> Vec<u8> {
        let mut bytes = Vec::new();
        encode(&key(1), film).expect("encodes").write(&mut bytes).expect("memory takes everything");
        bytes
    }

    #[test]
    fn a_picture_comes_back_and_a_damaged_one_does_not() {
        let film = Film::new([3, 2]);
        let good = bytes(&film);
        assert_eq!(decode(&good, &key(1), [3, 2]), Some(film));
        assert_eq!(decode(&good, &key(2), [3, 2]), None);
        assert_eq!(decode(&good, &key(1), [2, 3]), None);
        for at in 0..good.len() {
            assert_eq!(decode(&good[..at], &key(1), [3, 2]), None, "{at} bytes");
            let mut flipped = good.clone();
            flipped[at] ^= 1 << (at % 8);
            assert_eq!(decode(&flipped, &key(1), [3, 2]), None, "byte {at}");
        }
    }

    #[test]
    fn sums_that_no_samples_have_are_refused() {
        for value in [f64::NAN, f64::INFINITY, -1.0] {
            let mut pixels = Film::new([1, 1]).pixels().to_vec();
            bytemuck::cast_slice_mut::<_, f64>(&mut pixels)[0] = value;
            let description = Description { size_px: [1, 1], samples: 4, secs: 1.0 };
            let forged = Sealed::new(&KIND, &key(1), &description, vec![bytemuck::cast_slice(&pixels)]);
            let mut bytes = Vec::new();
            forged.expect("encodes").write(&mut bytes).expect("memory takes everything");
            assert_eq!(decode(&bytes, &key(1), [1, 1]), None, "{value}");
        }
    }
}
