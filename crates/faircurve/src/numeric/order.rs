//! Sorting lists of few items, such as knots in the order of their strain.

use std::cmp::Ordering;

/// Sorts as [`slice::sort_by`] does: equal items stay in their order. That is compiled anew for every
/// kind of item and order, each 5 to 30 kB of a program; this is compiled once, and clones the items.
pub(crate) fn sort_by<T: Clone>(items: &mut [T], compare: impl Fn(&T, &T) -> Ordering) {
    let order = ordered(items.len(), &|i, j| compare(&items[i], &items[j]));
    let sorted: Vec<T> = order.into_iter().map(|i| items[i].clone()).collect();
    items.clone_from_slice(&sorted);
}

/// The indices of `count` items in order.
fn ordered(count: usize, compare: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|i, j| compare(*i, *j));
    order
}

#[cfg(test)]
mod tests {
    use super::sort_by;

    #[test]
    fn is_that_of_the_standard_library() {
        // Numbers of a linear congruence, with many alike.
        let mut items: Vec<(u32, usize)> =
            (0..500).map(|i| ((i as u32).wrapping_mul(2_654_435_761) >> 27, i)).collect();
        let mut expected = items.clone();
        expected.sort_by_key(|item| item.0);
        sort_by(&mut items, |a, b| a.0.cmp(&b.0));
        assert_eq!(items, expected);
        sort_by::<f64>(&mut [], f64::total_cmp);
    }
}
