//! The best roots known, in files of JSON lines, one file a class or font: what exists, whether or not
//! faircurve finds it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::Failure;
use crate::residual::LOOP;
use crate::rivals::Ours;

/// Runs of at most this many segments are kept with their k₀ … k₃.
const SHORT: usize = 8;

/// The best root of a contour that is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Entry {
    /// Class and case, or font, glyph, layer and contour.
    pub(crate) place: String,
    /// ∫|κ| ds in radians; null where no root was found.
    pub(crate) turning: Option<f64>,
    /// Segments longer than 4 chords.
    pub(crate) loops: usize,
    /// The fewest such segments of any root found, which may be another one.
    pub(crate) fewest_loops: usize,
    /// Recomputed.
    pub(crate) residual: f64,
    /// By which kind of start.
    pub(crate) how: String,
    /// k₀ … k₃ of each segment, of short contours.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) k: Option<Vec<[f64; 4]>>,
}

impl Entry {
    /// A root.
    pub(crate) fn new(place: &str, root: &Ours, fewest_loops: usize, how: &str) -> Entry {
        let lengths = root.lengths.iter();
        let k: Vec<[f64; 4]> = root.pieces.iter().map(|piece| piece.k).collect();
        Entry {
            place: place.to_owned(),
            turning: Some(root.turning),
            loops: lengths.filter(|length| **length > LOOP).count(),
            fewest_loops,
            residual: root.as_asked.value,
            how: how.to_owned(),
            k: (k.len() <= SHORT).then_some(k),
        }
    }

    /// Searched in vain.
    pub(crate) fn unsolved(place: &str) -> Entry {
        Entry {
            place: place.to_owned(),
            turning: None,
            loops: 0,
            fewest_loops: 0,
            residual: 0.0,
            how: "not found".to_owned(),
            k: None,
        }
    }

    /// Whether it turns less than the other, by more than rounding.
    pub(crate) fn is_better_than(&self, other: &Entry) -> bool {
        match (self.turning, other.turning) {
            (Some(own), Some(other)) => own < other - 1e-6,
            (own, other) => own.is_some() && other.is_none(),
        }
    }

    /// The class or font that it belongs to.
    pub(crate) fn group(&self) -> &str {
        match self.place.split_once(" case ") {
            Some((class, _)) => class,
            None => self.place.split(' ').next().unwrap_or_default(),
        }
    }
}

/// The best roots known, by place.
#[derive(Clone, Debug, Default)]
pub(crate) struct Yardstick(BTreeMap<String, Entry>);

/// Where the repository keeps it.
pub(crate) fn default_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("yardstick")
}

impl Yardstick {
    /// Reads every `.jsonl` file of a folder; nothing if there is no such folder.
    ///
    /// # Errors
    /// If a file can't be read or understood.
    pub(crate) fn read(folder: &Path) -> Result<Yardstick, Failure> {
        let mut yardstick = Yardstick::default();
        let Ok(files) = std::fs::read_dir(folder) else { return Ok(yardstick) };
        for file in files.flatten().map(|file| file.path()) {
            if file.extension().is_none_or(|extension| extension != "jsonl") {
                continue;
            }
            let text = std::fs::read_to_string(&file).map_err(|error| in_file(&file, &error))?;
            for line in text.lines() {
                let entry = serde_json::from_str(line).map_err(|error| in_file(&file, &error))?;
                yardstick.improve(entry);
            }
        }
        Ok(yardstick)
    }

    /// Writes the file of the class or font that a place belongs to, and leaves the others alone.
    ///
    /// # Errors
    /// If it can't be written.
    pub(crate) fn write_group_of(&self, place: &str, folder: &Path) -> Result<(), Failure> {
        let Some(group) = self.get(place).map(Entry::group) else { return Ok(()) };
        let mut text = String::new();
        for entry in self.entries().filter(|entry| entry.group() == group) {
            text += &serde_json::to_string(entry).map_err(|error| in_file(folder, &error))?;
            text.push('\n');
        }
        std::fs::create_dir_all(folder).map_err(|error| in_file(folder, &error))?;
        let file = folder.join(format!("{}.jsonl", group.replace([' ', '/'], "-")));
        std::fs::write(&file, text).map_err(|error| in_file(&file, &error))
    }

    /// What is known of a place.
    pub(crate) fn get(&self, place: &str) -> Option<&Entry> {
        self.0.get(place)
    }

    /// All that is known, by place.
    pub(crate) fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.0.values()
    }

    /// Takes an entry if it is the first of its place or better than the one there, and of both the
    /// fewer loops.
    pub(crate) fn improve(&mut self, mut entry: Entry) {
        let Some(old) = self.0.get_mut(&entry.place) else {
            self.0.insert(entry.place.clone(), entry);
            return;
        };
        if entry.turning.is_some() && old.turning.is_some() {
            let fewest = entry.fewest_loops.min(old.fewest_loops);
            (entry.fewest_loops, old.fewest_loops) = (fewest, fewest);
        }
        if entry.is_better_than(old) {
            *old = entry;
        }
    }
}

fn in_file(file: &Path, error: &dyn std::fmt::Display) -> Failure {
    Failure {
        message: format!("{}: {error}", file.display()),
        hint: "name a folder of yardstick files with `--yardstick`".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_only_ever_improves() {
        let entry = |turning| Entry { turning, ..Entry::unsolved("walk open g4 4 case 1") };
        let mut yardstick = Yardstick::default();
        for (offered, kept) in [
            (None, None),
            (Some(3.0), Some(3.0)),
            (None, Some(3.0)),
            (Some(4.0), Some(3.0)),
            (Some(2.0), Some(2.0)),
        ] {
            yardstick.improve(entry(offered));
            let found = yardstick.get("walk open g4 4 case 1").unwrap();
            assert_eq!(found.turning, kept);
            assert_eq!(found.group(), "walk open g4 4");
        }
    }
}
