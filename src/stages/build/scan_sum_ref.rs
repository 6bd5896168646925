//! Reference of `scan_sum.wgsl`: sums of chunks, in integers that cannot wrap.

/// Sum of every `chunk` consecutive values, the last chunk as long as it is.
pub fn chunk_sums(values: &[u32], chunk: usize) -> Vec<u64> {
    values.chunks(chunk).map(|chunk| chunk.iter().copied().map(u64::from).sum()).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn ones_sum_to_the_chunk_lengths() {
        assert_eq!(super::chunk_sums(&[1; 10], 4), [4, 4, 2]);
    }
}
