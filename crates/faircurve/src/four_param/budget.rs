//! What a search may spend, counted in work.

/// Segment evaluations that may still be made. Whoever overspends by a step is forgiven.
#[derive(Debug)]
pub(super) struct Budget(usize);

impl Budget {
    /// So many evaluations.
    pub(super) fn new(evaluations: usize) -> Self {
        Budget(evaluations)
    }

    /// What is left.
    pub(super) fn left(&self) -> usize {
        self.0
    }

    /// Whether nothing is left.
    pub(super) fn is_spent(&self) -> bool {
        self.0 == 0
    }

    /// Takes off what has been spent.
    pub(super) fn spend(&mut self, evaluations: usize) {
        self.0 = self.0.saturating_sub(evaluations);
    }

    /// Sets a share of it aside.
    pub(super) fn split_off(&mut self, share: f64) -> Budget {
        let part = (self.0 as f64 * share) as usize;
        self.spend(part);
        Budget(part)
    }

    /// Puts back what was left of what was set aside.
    pub(super) fn put_back(&mut self, rest: Budget) {
        self.0 += rest.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost_and_nothing_below_zero() {
        let mut budget = Budget::new(1000);
        let mut part = budget.split_off(0.25);
        assert_eq!((budget.left(), part.left()), (750, 250));
        part.spend(100);
        budget.put_back(part);
        assert_eq!(budget.left(), 900);
        budget.spend(2000);
        assert!(budget.is_spent());
    }
}
