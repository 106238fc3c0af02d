//! libspiro's lists of points as contours.

use faircurve::kurbo::Vec2;
use faircurve::{Contour, Join, Knot};

use crate::abi::SpiroCp;

/// How a list says where it ends and whether it is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// By its letters: `{` … `}` is open, … `z` closed.
    Tagged,
    /// By the caller, who says that it is open. The letters of both ends mean nothing.
    Open,
    /// By the caller, who says that it is closed; yet letters that say open win. A `z` may follow.
    Closed,
}

/// A list as a contour.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Points {
    /// A knot for each point that isn't a handle.
    pub(crate) contour: Contour,
    /// For each knot its place in the list; that of an anchor is its own, not its handle's.
    pub(crate) places: Vec<usize>,
}

/// Whether the letter ends a list.
pub(crate) fn is_end_mark(letter: u8) -> bool {
    matches!(letter, b'z' | b'}')
}

impl Points {
    /// What the list says; `None` if it has no point. What follows an end mark is ignored.
    ///
    /// | letter | knot |
    /// |---|---|
    /// | `v`, and any that isn't here | corner |
    /// | `c` `o` | G2, G4 |
    /// | `[` `]` | curve-to-terminal, terminal-to-curve |
    /// | `a`, then `h` | at `a`, smooth, the tangent a→h, the curvature 0 on both sides; a corner if both are in one place |
    /// | `h` alone | none |
    pub(crate) fn read(list: &[SpiroCp], form: Form) -> Option<Points> {
        let end = list.iter().position(|cp| is_end_mark(cp.letter()));
        let (list, ends_open) = match end {
            // The caller's count says where the list ends.
            Some(_) if form == Form::Open => (list, true),
            Some(at) if list[at].letter() == b'z' => (&list[..at], false),
            Some(at) => (&list[..=at], true),
            None => (list, false),
        };
        let first = list.first()?;
        let open = form == Form::Open || ends_open || first.letter() == b'{';
        let last = list.len() - 1;
        let (mut knots, mut places) = (Vec::with_capacity(list.len()), Vec::new());
        let mut i = 0;
        while i < list.len() {
            let here = &list[i];
            let is_end = open && (i == 0 || i == last);
            let knot = Knot::new((here.x, here.y));
            let handle = list.get(i + 1).filter(|next| {
                here.letter() == b'a'
                    && next.letter() == b'h'
                    && !is_end
                    && !(open && i + 1 == last)
            });
            let knot = match here.letter() {
                _ if is_end => Some(knot),
                b'c' => Some(knot.join(Join::G2)),
                b'o' => Some(knot.join(Join::G4)),
                b'[' => Some(knot.join(Join::CurveToTerminal)),
                b']' => Some(knot.join(Join::TerminalToCurve)),
                b'h' => None,
                _ => Some(match handle {
                    Some(handle) => anchor(knot, Vec2::new(handle.x - here.x, handle.y - here.y)),
                    None => knot.join(Join::Corner),
                }),
            };
            if let Some(knot) = knot {
                knots.push(knot);
                places.push(i);
            }
            i += if handle.is_some() { 2 } else { 1 };
        }
        Some(Points { contour: Contour { knots, closed: !open }, places })
            .filter(|points| !points.contour.knots.is_empty())
    }
}

/// The knot with a given tangent, flat on both sides, as libspiro solves it.
fn anchor(knot: Knot, tangent: Vec2) -> Knot {
    if tangent == Vec2::ZERO {
        return knot.join(Join::Corner);
    }
    knot.join(Join::G1).tangent(tangent).curvature_in(0.0).curvature_out(0.0)
}

/// Whether every coordinate that counts is finite: all but those of a closing `z`.
pub(crate) fn is_finite(list: &[SpiroCp]) -> bool {
    let counts = list.iter().take_while(|cp| cp.letter() != b'z');
    counts.into_iter().all(|cp: &SpiroCp| cp.x.is_finite() && cp.y.is_finite())
}

/// Turns a list round, so that it describes the same contour travelled the other way, starting from
/// the last point. A closing `z` stays where it is, `{` and `}` too; `[` and `]` are exchanged; a
/// handle moves to the other side of its anchor.
pub(crate) fn reverse(list: &mut [SpiroCp]) {
    let end = match list.last() {
        Some(last) if last.letter() == b'z' => list.len() - 1,
        _ => list.len(),
    };
    let list = &mut list[..end];
    list.reverse();
    for i in 0..list.len() {
        let letter = match list[i].letter() {
            b'[' => b']',
            b']' => b'[',
            b'{' => b'}',
            b'}' => b'{',
            letter => letter,
        };
        list[i] = list[i].with_letter(letter);
        if letter == b'h' && list.get(i + 1).is_some_and(|next| next.letter() == b'a') {
            let (handle, anchor) = (list[i], list[i + 1]);
            list[i] = anchor;
            list[i + 1] =
                SpiroCp { x: 2.0 * anchor.x - handle.x, y: 2.0 * anchor.y - handle.y, ..handle };
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use faircurve::kurbo::Point;

    /// `0,0,o 100,50,c`: points with their letters.
    pub(crate) fn list(text: &str) -> Vec<SpiroCp> {
        let point = |word: &str| {
            let parts: Vec<&str> = word.splitn(3, ',').collect();
            let number = |i: usize| parts[i].parse().unwrap();
            SpiroCp { x: number(0), y: number(1), ty: parts[2].as_bytes()[0] as _ }
        };
        text.split_whitespace().map(point).collect()
    }

    fn read(text: &str, form: Form) -> Contour {
        Points::read(&list(text), form).unwrap().contour
    }

    fn joins(contour: &Contour) -> Vec<Option<Join>> {
        contour.knots.iter().map(|knot| knot.join).collect()
    }

    #[test]
    fn letters_are_joins_and_unknown_ones_corners() {
        let contour = read("0,0,v 1,0,o 2,0,c 3,0,[ 4,0,] 5,0,x 6,0,{ 0,0,z", Form::Tagged);
        assert!(contour.closed);
        let expected = [
            Join::Corner,
            Join::G4,
            Join::G2,
            Join::CurveToTerminal,
            Join::TerminalToCurve,
            Join::Corner,
            Join::Corner,
        ];
        assert_eq!(joins(&contour), expected.map(Some));
    }

    #[test]
    fn every_form_of_an_open_list_is_the_same_contour() {
        let tagged = read("0,0,{ 1,2,o 3,0,}", Form::Tagged);
        assert_eq!((tagged.closed, tagged.knots.len()), (false, 3));
        assert_eq!(joins(&tagged), [None, Some(Join::G4), None]);
        assert_eq!(read("0,0,o 1,2,o 3,0,v", Form::Open), tagged);
        assert_eq!(read("0,0,{ 1,2,o 3,0,}", Form::Open), tagged);
        // Letters that say open win over a caller who says closed.
        assert_eq!(read("0,0,{ 1,2,o 3,0,}", Form::Closed), tagged);
        // As SFD files end open contours.
        assert_eq!(read("0,0,{ 1,2,o 3,0,o 0,0,z", Form::Tagged), tagged);
    }

    #[test]
    fn every_form_of_a_closed_list_is_the_same_contour() {
        let tagged = read("0,0,o 1,2,o 3,0,v 7,7,z", Form::Tagged);
        assert_eq!((tagged.closed, tagged.knots.len()), (true, 3));
        assert_eq!(read("0,0,o 1,2,o 3,0,v", Form::Closed), tagged);
        assert_eq!(read("0,0,o 1,2,o 3,0,v 7,7,z", Form::Closed), tagged);
    }

    #[test]
    fn an_anchor_and_its_handle_are_one_knot() {
        let points = Points::read(&list("0,0,v 1,1,a 3,1,h 5,0,v 0,0,z"), Form::Tagged).unwrap();
        assert_eq!(points.places, [0, 1, 3]);
        let knot = &points.contour.knots[1];
        assert_eq!(knot.point, Point::new(1.0, 1.0));
        assert_eq!(knot.tangent_in, Some(Vec2::new(2.0, 0.0)));
        assert_eq!(knot.tangent_out, knot.tangent_in);
    }

    #[test]
    fn anchors_and_handles_without_each_other_do_no_harm() {
        // A handle alone is nothing, an anchor alone a corner, and so are both in one place.
        assert_eq!(read("0,0,{ 9,9,h 1,1,o 2,0,}", Form::Tagged).knots.len(), 3);
        for text in ["0,0,o 1,1,a 2,0,o 0,0,z", "0,0,o 1,1,a 1,1,h 2,0,o 0,0,z"] {
            let contour = read(text, Form::Tagged);
            assert_eq!(contour.knots[1], Knot::new((1.0, 1.0)).join(Join::Corner));
            assert_eq!(contour.knots.len(), 3);
        }
        assert_eq!(Points::read(&list("1,1,h 0,0,z"), Form::Tagged), None);
        assert_eq!(Points::read(&list("0,0,z"), Form::Tagged), None);
        assert_eq!(Points::read(&[], Form::Open), None);
    }

    #[test]
    fn reversing_twice_is_nothing_and_once_the_other_way_round() {
        for text in [
            "0,0,{ 1,1,o 2,0,[ 3,3,}",
            "0,0,o 1,1,o 2,0,[ 3,3,v 0,0,z",
            "0,0,o 1,1,a 1,2,h 2,0,] 3,3,v 0,0,z",
            "0,0,o 1,1,]",
        ] {
            let original = list(text);
            let mut reversed = original.clone();
            reverse(&mut reversed);
            let form = if text.ends_with(']') { Form::Closed } else { Form::Tagged };
            let contour = Points::read(&original, form).unwrap().contour;
            assert_eq!(
                Points::read(&reversed, form).unwrap().contour,
                contour.reversed(),
                "{text}"
            );
            reverse(&mut reversed);
            assert_eq!(reversed, original, "{text}");
        }
    }

    #[test]
    fn only_the_place_of_the_closing_mark_may_be_anything() {
        assert!(is_finite(&list("0,0,o NaN,0,z")));
        assert!(!is_finite(&list("0,0,o NaN,0,o 0,0,z")));
        assert!(!is_finite(&list("0,0,{ 1,inf,}")));
    }
}
