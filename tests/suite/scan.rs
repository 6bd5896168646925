//! Prefix sums of any length against their definition.

use octolume::stages::build::scan::{self, Scanned};
use octolume::stages::build::{scan_spread_ref, scan_sum, scan_sum_ref};
use proptest::prelude::RngExt;

use crate::device::gpu;
use crate::random;
use crate::stage_rig::{buffer, read, run, upload};

#[test]
fn scans_of_any_length_are_prefix_sums() {
    let mut rng = random::rng(11);
    for count in [0, 1, 63, 64, 65, 4096, 4097, 300_001] {
        let words: Vec<u32> = (0..2 * count).map(|_| rng.random_range(0..6000)).collect();
        let bits: Vec<u32> = (0..count).map(|_| rng.random_range(0..=u32::MAX)).collect();
        let scanned = |scanned: Scanned, values: &[u32]| -> Vec<u64> {
            let entries = u64::from(scanned.channels()) * (count as u64 + 1);
            let (from, to) = (upload(gpu(), "values", values), buffer(gpu(), "prefixes", entries));
            run(gpu(), |frame| {
                scan::record(gpu(), frame, (scanned, count as u32), &from, &to, &mut Vec::new()).expect("fits");
            });
            read::<u32>(gpu(), &to, entries).into_iter().map(u64::from).collect()
        };
        let channel =
            |values: &[u32], channel: usize| values.iter().copied().skip(channel).step_by(2).collect::<Vec<_>>();
        let pairs = scanned(Scanned::Pairs, &words);
        for c in 0..2 {
            let found: Vec<u64> = pairs.iter().copied().skip(c).step_by(2).collect();
            assert!(found == scan_spread_ref::prefixes(&channel(&words, c)), "{count} pairs");
        }
        let ones: Vec<u32> = bits.iter().map(|word| word.count_ones()).collect();
        assert!(scanned(Scanned::Bits, &bits) == scan_spread_ref::prefixes(&ones), "{count} words of bits");
    }
}

#[test]
fn chunk_sums_are_sums_of_chunks() {
    let values: Vec<u32> = (0..1000).collect();
    let (from, to) = (upload(gpu(), "values", &values), buffer(gpu(), "sums", 16));
    let constants = Scanned::Pairs.constants(true);
    run(gpu(), |frame| scan_sum::record(gpu(), frame, constants, 500, &from, &to));
    let found: Vec<u64> = read::<u32>(gpu(), &to, 16).into_iter().map(u64::from).collect();
    for channel in 0..2 {
        let of_channel: Vec<u32> = values.iter().copied().skip(channel).step_by(2).collect();
        let sums: Vec<u64> = found.iter().copied().skip(channel).step_by(2).collect();
        assert_eq!(sums, scan_sum_ref::chunk_sums(&of_channel, 64));
    }
    // In closed form: the first 64 even numbers.
    assert_eq!(found[0], 63 * 64);
}
