//! How far a long run is.

use std::io::{IsTerminal, Write};

/// A line on the terminal that says how far it is; silent elsewhere.
#[derive(Debug)]
pub(crate) struct Progress {
    done: usize,
    all: usize,
    shows: bool,
}

impl Progress {
    /// Nothing of `all` steps done.
    pub(crate) fn new(all: usize) -> Self {
        Progress { done: 0, all, shows: std::io::stderr().is_terminal() }
    }

    /// Says what is being done now.
    pub(crate) fn step(&mut self, what: &str) {
        self.done += 1;
        self.write(&format!("\r\x1b[K{}/{} {what}", self.done, self.all));
    }

    /// Clears the line.
    pub(crate) fn done(&self) {
        self.write("\r\x1b[K");
    }

    fn write(&self, text: &str) {
        if self.shows {
            let mut stderr = std::io::stderr();
            let _ = stderr.write_all(text.as_bytes()).and_then(|()| stderr.flush());
        }
    }
}
