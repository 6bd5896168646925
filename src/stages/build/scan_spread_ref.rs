//! Reference of `scan_spread.wgsl`, and so of the whole scan: exclusive prefix sums by definition.

/// `prefixes[i]` = sum of the values before `i`; one entry more than values, the total.
pub fn prefixes(values: &[u32]) -> Vec<u64> {
    let running = |sum: &mut u64, value: &u32| {
        *sum += u64::from(*value);
        Some(*sum)
    };
    std::iter::once(0).chain(values.iter().scan(0, running)).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn ones_count_up() {
        assert_eq!(super::prefixes(&[1; 4]), [0, 1, 2, 3, 4]);
        assert_eq!(super::prefixes(&[]), [0]);
    }
}
