//! Time that other programs don't lengthen.

use std::time::Instant;

/// A clock that runs while this thread does, where the system tells (Linux); elsewhere one on the
/// wall. Good to a few milliseconds: what the system counts between its ticks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    wall: Instant,
    on_cpu: Option<f64>,
}

impl Clock {
    /// Starts it.
    pub(crate) fn start() -> Clock {
        Clock { on_cpu: seconds_on_cpu(), wall: Instant::now() }
    }

    /// Seconds since the start.
    pub(crate) fn seconds(self) -> f64 {
        let wall = self.wall.elapsed().as_secs_f64();
        match (self.on_cpu, seconds_on_cpu()) {
            (Some(start), Some(end)) => (end - start).min(wall),
            _ => wall,
        }
    }
}

/// Seconds for which this thread has run.
fn seconds_on_cpu() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split(' ').next()?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}
