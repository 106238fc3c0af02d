//! Contours on which faircurve does worse than libspiro, and those differences that are accepted.

use std::collections::BTreeSet;

use faircurve::Contour;
use serde::{Deserialize, Serialize};

use crate::report::{describe, list};
use crate::residual::LOOP;
use crate::rivals::{Ours, Theirs};

/// A curve that turns this many times as much as another is worse.
const MUCH: f64 = 1.5;

/// In which way ours is worse than a curve by libspiro that is true.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Worse {
    /// Ours is relaxed.
    Relaxed,
    /// Ours has a segment longer than 4 chords, libspiro's has none.
    Loops,
    /// ∫|κ| ds of ours is more than 1.5 times that of libspiro's, which doesn't save its turning by a
    /// segment longer than 4 chords where ours has none.
    TurnsMore,
}

impl Worse {
    /// The comparison of one contour; `None` where ours is no worse.
    fn judge(ours: &Ours, theirs: &Theirs) -> Option<Worse> {
        let curve = theirs.curve.as_ref().filter(|_| theirs.is_truly_solved())?;
        match () {
            () if !ours.is_solved() => Some(Worse::Relaxed),
            () if ours.longest > LOOP && curve.longest <= LOOP => Some(Worse::Loops),
            () if ours.longest <= LOOP && curve.longest > LOOP => None,
            () if ours.turning > MUCH * curve.turning + 1e-6 => Some(Worse::TurnsMore),
            () => None,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Worse::Relaxed => "relaxed",
            Worse::Loops => "loops",
            Worse::TurnsMore => "turns more",
        }
    }
}

/// An entry of `accepted.json`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Accepted {
    worse: Worse,
    /// Class and case, or font, glyph, layer and contour.
    place: String,
    /// Why it is right so.
    reason: String,
}

/// The differences seen by a run, held against the list of those that are accepted.
#[derive(Debug)]
pub(crate) struct Differences {
    accepted: Vec<Accepted>,
    /// Every contour that was compared.
    compared: BTreeSet<String>,
    found: BTreeSet<(String, Worse)>,
    descriptions: Vec<String>,
}

impl Differences {
    /// None so far, against the list of the repository.
    pub(crate) fn new() -> Self {
        Differences::against(include_str!("../accepted.json"))
    }

    fn against(list: &str) -> Self {
        // A list that can't be read accepts nothing; the tests read it.
        let accepted = serde_json::from_str(list).unwrap_or_default();
        Differences {
            accepted,
            compared: BTreeSet::new(),
            found: BTreeSet::new(),
            descriptions: Vec::new(),
        }
    }

    /// Compares both curves of a contour. Returns how ours is worse, if it is, and whether
    /// that isn't accepted.
    pub(crate) fn compare(
        &mut self,
        place: &str,
        contour: &Contour,
        ours: &Ours,
        theirs: &Theirs,
    ) -> (Option<Worse>, bool) {
        let worse = Worse::judge(ours, theirs);
        let numbers = |longest: f64, turning: f64| {
            format!("∫|κ| ds {turning:.2}, longest segment {longest:.1} chords")
        };
        let description = || {
            let curve = theirs.curve.as_ref();
            let theirs = curve.map_or(String::new(), |c| numbers(c.longest, c.turning));
            let ours = numbers(ours.longest, ours.turning);
            format!("ours {ours}; libspiro's {theirs}; {}", describe(contour))
        };
        let description = if worse.is_some() { description() } else { String::new() };
        (worse, self.note(place, worse, &description))
    }

    /// Notes that a contour was compared, and with what result. Whether the difference, if there is
    /// one, isn't accepted.
    fn note(&mut self, place: &str, worse: Option<Worse>, description: &str) -> bool {
        self.compared.insert(place.to_owned());
        let Some(worse) = worse else { return false };
        self.found.insert((place.to_owned(), worse));
        let reason = self.reason(place, worse);
        let accepted = reason.map_or(String::new(), |reason| format!("; accepted: {reason}"));
        let is_new = reason.is_none();
        self.descriptions.push(format!("{place}: {}; {description}{accepted}", worse.name()));
        is_new
    }

    fn reason(&self, place: &str, worse: Worse) -> Option<&str> {
        let entry = self.accepted.iter().find(|a| a.place == place && a.worse == worse);
        entry.map(|entry| entry.reason.as_str())
    }

    /// One line for each difference that isn't accepted.
    pub(crate) fn alarms(&self) -> Vec<String> {
        let new = self.found.iter().filter(|(place, worse)| self.reason(place, *worse).is_none());
        new.map(|(place, worse)| format!("{place}: worse than libspiro: {}", worse.name()))
            .collect()
    }

    /// Accepted differences of contours that were compared, which no longer occur.
    pub(crate) fn stale(&self) -> Vec<String> {
        let occurs = |a: &Accepted| self.found.contains(&(a.place.clone(), a.worse));
        let stale = self.accepted.iter().filter(|a| self.compared.contains(&a.place) && !occurs(a));
        stale.map(|a| format!("{}: {}", a.place, a.worse.name())).collect()
    }

    /// What happened, for people.
    pub(crate) fn text(&self) -> String {
        [
            list("worse than libspiro", &self.descriptions),
            list(
                "accepted differences that no longer occur: take them off the list",
                &self.stale(),
            ),
        ]
        .concat()
    }

    /// The same for programs.
    pub(crate) fn json(&self) -> serde_json::Value {
        serde_json::json!({
            "compared": self.compared.len(),
            "worse_than_libspiro": self.descriptions,
            "stale": self.stale(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_can_be_read_and_gives_reasons() {
        let list: Vec<Accepted> = serde_json::from_str(include_str!("../accepted.json")).unwrap();
        assert!(list.iter().all(|entry| !entry.reason.is_empty()));
        let places: BTreeSet<_> = list.iter().map(|entry| (&entry.place, entry.worse)).collect();
        assert_eq!(places.len(), list.len());
    }

    #[test]
    fn what_is_not_listed_is_an_alarm_and_what_does_not_occur_is_stale() {
        let entry = |worse: &str, place: &str| {
            format!(r#"{{"worse": "{worse}", "place": "{place}", "reason": "because"}}"#)
        };
        let list = [entry("relaxed", "a"), entry("loops", "b"), entry("loops", "elsewhere")];
        let mut differences = Differences::against(&format!("[{}]", list.join(",")));
        assert!(!differences.note("a", Some(Worse::Relaxed), ""));
        assert!(!differences.note("b", None, ""));
        assert!(differences.note("c", Some(Worse::TurnsMore), ""));
        assert_eq!(differences.alarms(), ["c: worse than libspiro: turns more"]);
        assert_eq!(differences.stale(), ["b: loops"]);
    }
}
