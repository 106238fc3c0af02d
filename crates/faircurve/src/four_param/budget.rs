//! What a search may spend, counted in work.

/// Segment evaluations that may still be made. Whoever overspends by a step is forgiven.
#[derive(Debug, Default)]
pub(super) struct Budget {
    left: usize,
    reserved: usize,
}

impl Budget {
    /// So many evaluations.
    pub(super) fn new(evaluations: usize) -> Self {
        Budget { left: evaluations, reserved: 0 }
    }

    /// What is left, but for what is reserved.
    pub(super) fn left(&self) -> usize {
        self.left
    }

    /// Whether nothing is left, but for what is reserved.
    pub(super) fn is_spent(&self) -> bool {
        self.left == 0
    }

    /// Takes off what has been spent.
    pub(super) fn spend(&mut self, evaluations: usize) {
        self.left = self.left.saturating_sub(evaluations);
    }

    /// Sets a share of it aside.
    pub(super) fn reserve(&mut self, share: f64) {
        let part = (self.left as f64 * share) as usize;
        self.spend(part);
        self.reserved += part;
    }

    /// Makes what is reserved free to spend; whether there was anything.
    pub(super) fn release(&mut self) -> bool {
        let part = std::mem::take(&mut self.reserved);
        self.left += part;
        part > 0
    }

    /// Puts back what was left of a part.
    pub(super) fn put_back(&mut self, rest: Budget) {
        self.left += rest.left;
        self.reserved += rest.reserved;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost_and_nothing_below_zero() {
        let mut budget = Budget::new(1000);
        budget.reserve(0.25);
        assert_eq!(budget.left(), 750);
        budget.spend(2000);
        assert!(budget.is_spent());
        assert!(budget.release());
        assert_eq!(budget.left(), 250);
        budget.put_back(Budget::new(50));
        assert_eq!(budget.left(), 300);
        assert!(!budget.release());
    }
}
