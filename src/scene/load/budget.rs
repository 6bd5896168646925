//! The memory that opening a file may take. Whoever allocates by a number of the file asks first.

use std::sync::atomic::{AtomicU64, Ordering};

use bytesize::ByteSize;

/// Bytes that may be spent, and those that are. Shared by all threads that read one file.
#[derive(Debug)]
pub(super) struct Budget {
    limit: u64,
    spent: AtomicU64,
}

impl Budget {
    pub fn new(limit_bytes: u64) -> Self {
        Self { limit: limit_bytes, spent: AtomicU64::new(0) }
    }

    /// Sets `bytes` aside, or says how much would be needed. Nothing is given back: what opening
    /// reads stays in the scene, or was as large as what stays.
    pub fn spend(&self, bytes: u64) -> Result<(), String> {
        let add = |spent: u64| Some(spent.saturating_add(bytes));
        let before = self.spent.fetch_update(Ordering::Relaxed, Ordering::Relaxed, add);
        let total = before.unwrap_or(u64::MAX).saturating_add(bytes);
        if total <= self.limit {
            return Ok(());
        }
        let [total, limit] = [total, self.limit].map(|bytes| ByteSize(bytes).display().iec());
        Err(format!("needs memory: {total} with all before it, and {limit} are allowed for opening a file"))
    }

    /// [`Self::spend`] for `count` elements of `size` bytes.
    pub fn spend_on(&self, count: usize, size: usize) -> Result<(), String> {
        self.spend((count as u64).saturating_mul(size as u64))
    }

    /// Something was refused.
    pub fn is_exceeded(&self) -> bool {
        self.spent_bytes() > self.limit
    }

    pub fn spent_bytes(&self) -> u64 {
        self.spent.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_exceeds_the_limit_is_refused_with_both_numbers() {
        let budget = Budget::new(3 << 20);
        assert_eq!(budget.spend_on(1 << 10, 1 << 11), Ok(()));
        assert_eq!(budget.spent_bytes(), 2 << 20);
        let refused = budget.spend(2 << 20).expect_err("1 MiB is left");
        assert!(refused.contains("4.0 MiB") && refused.contains("3.0 MiB"), "{refused}");
        assert!(budget.spend(u64::MAX).is_err(), "no overflow");
        assert!(budget.is_exceeded() && !Budget::new(1).is_exceeded());
    }
}
