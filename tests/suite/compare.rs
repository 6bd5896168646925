//! Set differences of leaves, and the copy kernel, against their references.

use std::collections::BTreeSet;

use octolume::experiment::bench::{copy, copy_ref};
use octolume::stages::compare::compare_sets::{self, COUNT_WORDS};
use octolume::stages::compare::compare_sets_ref::holes_spill_both;

use crate::device::gpu;
use crate::stage_rig::{read, run, upload};
use crate::view_rig::Numbers;

/// About `percent` of 32 · `words` bits.
fn bits(words: usize, percent: u32, seed: u64) -> (Vec<u32>, BTreeSet<u32>) {
    let mut numbers = Numbers(seed);
    let set: BTreeSet<u32> = (0..32 * words as u32).filter(|_| numbers.below(100) < percent).collect();
    let mut masks = vec![0; words];
    set.iter().for_each(|bit| masks[(bit / 32) as usize] |= 1 << (bit % 32));
    (masks, set)
}

#[test]
fn holes_and_spill_are_set_differences() {
    for (words, moved_percent, exact_percent) in
        [(1, 50, 50), (2, 0, 100), (63, 100, 0), (64, 30, 30), (1024, 3, 60), (5000, 100, 100), (128, 0, 0)]
    {
        let ((moved_masks, moved), (exact_masks, exact)) =
            (bits(words, moved_percent, 1), bits(words, exact_percent, 2));
        let [moved_bits, exact_bits] = [moved_masks, exact_masks].map(|masks| upload(gpu(), "leaf bits", &masks));
        // What lay there before counts nothing.
        let counts = upload(gpu(), "counts", &[7_u32; 2 * COUNT_WORDS as usize]);
        run(gpu(), |frame| compare_sets::record(gpu(), frame, &moved_bits, &exact_bits, &counts));
        let found = read::<u32>(gpu(), &counts, COUNT_WORDS).into_iter().map(u64::from);
        assert!(found.eq(holes_spill_both(&moved, &exact)), "{words} words, {moved_percent} and {exact_percent} %");
    }
}

#[test]
fn a_copy_ends_where_it_should() {
    let mut numbers = Numbers(3);
    let original: Vec<u32> = (0..4096).map(|_| numbers.below(u32::MAX)).collect();
    let from = upload(gpu(), "original", &original);
    for words in [4, 60, 256, 1000, 4096] {
        let mut expected = vec![9; original.len()];
        let to = upload(gpu(), "duplicate", &expected);
        run(gpu(), |frame| copy::record(gpu(), frame, &from, &to, 4 * words as u64));
        copy_ref::copy(&original, &mut expected, words);
        assert_eq!(read::<u32>(gpu(), &to, original.len() as u64), expected, "{words} words");
    }
}
