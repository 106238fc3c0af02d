//! A progress bar for work that takes longer than a second.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Counts glyphs, or whatever is worked on, on stderr, if that is a terminal, from a second after its creation on.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    /// Dropped at the end, which wakes the thread that shows the bar.
    _end: Sender<()>,
}

impl Progress {
    /// Work that takes longer than this shows its progress.
    const PATIENCE: Duration = Duration::from_secs(1);

    pub(crate) fn new(glyphs: usize) -> Self {
        Progress::of("solving", glyphs, "glyphs")
    }

    /// Of so many things: `measuring`, 12, `splines`.
    pub(crate) fn of(doing: &str, count: usize, things: &str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(count as u64), ProgressDrawTarget::hidden());
        let template = format!("{doing} {{wide_bar}} {{pos}}/{{len}} {things}, {{elapsed}}");
        let style = ProgressStyle::with_template(&template);
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        let (end, ended) = channel::<()>();
        let shown = bar.clone();
        std::thread::spawn(move || {
            if ended.recv_timeout(Self::PATIENCE) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(Duration::from_millis(100));
            }
        });
        Progress { bar, _end: end }
    }

    /// One more is done.
    pub(crate) fn step(&self) {
        self.bar.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
