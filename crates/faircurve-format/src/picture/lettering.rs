//! Words and numbers in pictures: single-stroke letters, drawn with the splines themselves, so that
//! SVG and PNG show the same and no font is needed.
//!
//! Each letter is a few strokes on a grid: x-height 4, capital height 6, descenders to −2. A knot is
//! `x,y` and a letter for its join: none, corner; `o`, smooth; `[`, a curve runs into a straight line;
//! `]`, out of one. `z` closes a stroke.

use std::collections::HashMap;
use std::sync::LazyLock;

use faircurve::kurbo::{Affine, BezPath, Shape};
use faircurve::{Contour, Join, Knot, catalog, convert, solve};

const LETTERS: &[(char, &str)] = &[
    ('a', "3.4,2o 1.7,4o 0,2o 1.7,0o z; 3.4,4 3.4,0"),
    ('b', "3.4,2o 1.7,4o 0,2o 1.7,0o z; 0,6 0,0"),
    ('c', "3.2,3.1 1.8,4o 0,2o 1.8,0o 3.2,0.9"),
    ('d', "3.4,2o 1.7,4o 0,2o 1.7,0o z; 3.4,6 3.4,0"),
    ('e', "0.1,2.2 3.4,2.2 1.75,4o 0,2o 1.9,0o 3.3,0.8"),
    ('f', "2.5,5.8 2,6o 0.9,4.8[ 0.9,0; 0,4 2.2,4"),
    ('g', "3.4,2o 1.7,4o 0,2o 1.7,0o z; 3.4,4 3.4,-0.4] 1.7,-2o 0.3,-1.4"),
    ('h', "0,6 0,0; 0,2 1.8,4o 3.3,2.4[ 3.3,0"),
    ('i', "0.3,4 0.3,0; 0.3,5.3 0.3,5.8"),
    ('j', "1.2,4 1.2,-0.9] 0.3,-2o 0,-2; 1.2,5.3 1.2,5.8"),
    ('k', "0,6 0,0; 2.9,4 0,1.5; 1.1,2.4 3.1,0"),
    ('l', "0.3,6 0.3,0"),
    ('m', "0,4 0,0; 0,2.2 1.5,4o 2.7,2.5[ 2.7,0; 2.7,2.2 4.2,4o 5.4,2.5[ 5.4,0"),
    ('n', "0,4 0,0; 0,2 1.8,4o 3.3,2.4[ 3.3,0"),
    ('o', "3.6,2o 1.8,4o 0,2o 1.8,0o z"),
    ('p', "3.4,2o 1.7,4o 0,2o 1.7,0o z; 0,4 0,-2"),
    ('q', "3.4,2o 1.7,4o 0,2o 1.7,0o z; 3.4,4 3.4,-2"),
    ('r', "0,4 0,0; 0,2 1.4,3.9o 2.2,4"),
    ('s', "2.9,3.3 1.5,4o 0.2,3o 1.55,2.05o 3,1o 1.5,0o 0,0.7"),
    ('t', "0.9,5.4 0.9,1.2] 1.9,0o 2.5,0.1; 0,4 2.3,4"),
    ('u', "0,4 0,1.6] 1.5,0o 3.3,2; 3.3,4 3.3,0"),
    ('v', "0,4 1.6,0 3.2,4"),
    ('w', "0,4 1.2,0 2.5,4 3.8,0 5,4"),
    ('x', "0,4 3.1,0; 3.1,4 0,0"),
    ('y', "0,4 1.7,0; 3.3,4 0.9,-2"),
    ('z', "0,4 3,4 0,0 3.1,0"),
    ('0', "1.7,6o 0,3o 1.7,0o 3.4,3o z"),
    ('1', "0.5,4.9 2,6 2,0"),
    ('2', "0.1,4.5 1.7,6o 3.3,4.4o 0,0 3.4,0"),
    ('3', "0.2,5.1 1.6,6o 3.1,4.6o 1.4,3.2 3.4,1.6o 1.6,0o 0,1"),
    ('4', "2.6,0 2.6,6 0,1.8 3.5,1.8"),
    ('5', "3.1,6 0.5,6 0.3,3.3 1.7,3.8o 3.4,1.9o 1.6,0o 0,0.8"),
    ('6', "1.7,3.7o 0,1.85o 1.7,0o 3.4,1.85o z; 0,1.85 0.9,4.5o 2.8,6"),
    ('7', "0,6 3.4,6 1.2,0"),
    ('8', "1.7,3.2o 0.3,4.6o 1.7,6o 3.1,4.6o z; 1.7,3.2o 0,1.6o 1.7,0o 3.4,1.6o z"),
    ('9', "1.7,6o 0,4.15o 1.7,2.3o 3.4,4.15o z; 3.4,4.15 2.5,1.5o 0.6,0"),
    (' ', ""),
    ('-', "0.2,2.2 2.4,2.2"),
    ('−', "0.2,2.6 2.8,2.6"),
    ('+', "0,2.2 3,2.2; 1.5,3.7 1.5,0.7"),
    ('±', "0,2.9 3,2.9; 1.5,4.4 1.5,1.4; 0,0.4 3,0.4"),
    ('=', "0,2.9 3,2.9; 0,1.5 3,1.5"),
    ('.', "0.3,0 0.3,0.6"),
    (',', "0.4,0.6 0,-1"),
    (':', "0.3,0 0.3,0.6; 0.3,3.2 0.3,3.8"),
    ('·', "0.3,1.9 0.3,2.5"),
    ('/', "0,-0.6 2.6,6.4"),
    ('_', "0,-0.6 3.2,-0.6"),
    ('(', "1.3,6.8 0,2.8o 1.3,-1.2"),
    (')', "0,6.8 1.3,2.8o 0,-1.2"),
    ('|', "0.3,6.8 0.3,-1.2"),
    ('*', "1.2,5.6 1.2,2.8; 0,4.9 2.4,3.5; 2.4,4.9 0,3.5"),
    ('^', "0,4.2 1.2,6 2.4,4.2"),
    ('<', "2.6,4 0,2.2 2.6,0.4"),
    ('>', "0,4 2.6,2.2 0,0.4"),
    ('%', "1,6o 0,4.9o 1,3.8o 2,4.9o z; 3.2,2.2o 2.2,1.1o 3.2,0o 4.2,1.1o z; 4,6 0.4,0"),
    ('\'', "0.7,6.4 0.3,4.7"),
    ('′', "0.7,6.4 0.3,4.7"),
    ('°', "0.9,6.2o 0,5.3o 0.9,4.4o 1.8,5.3o z"),
    ('²', "0.3,5.6 1.1,6.4o 1.9,5.6o 0.3,3.6 2,3.6"),
    ('³', "0,6 0.8,6.4o 1.5,5.8o 0.8,5.1 1.7,4.3o 0.8,3.5o 0,4"),
    ('κ', "0,4 0,0; 2.8,4 0,1.6; 1,2.4 3,0"),
    ('θ', "1.7,6o 0,3o 1.7,0o 3.4,3o z; 0,3 3.4,3"),
    ('α', "3.6,4 1.5,0o 0,2o 1.5,4o 3.7,0"),
    ('π', "0,4 3.8,4; 0.9,4 0.7,0; 2.8,4 2.9,0"),
    ('∫', "2.7,6.6 2.1,7o 1.35,5.6[ 1.35,-0.2] 0.6,-1.6o 0,-1.2"),
];

/// What stands for a character that isn't there: an empty box.
const MISSING: &str = "0,0 3,0 3,6 0,6 z";

/// Between letters, on the grid.
const SPACE: f64 = 1.5;
/// A digit's width with its space, the same for all, so that columns of numbers stand straight.
const DIGIT: f64 = 3.4 + SPACE;
/// A blank's width.
const BLANK: f64 = 3.0;
/// Height of capitals on the grid: the size of a text is this high.
const CAPITAL: f64 = 6.0;

struct Letter {
    path: BezPath,
    advance: f64,
}

static DRAWN: LazyLock<HashMap<char, Letter>> = LazyLock::new(|| {
    LETTERS.iter().map(|(letter, strokes)| (*letter, draw(*letter, strokes))).collect()
});

static BOX: LazyLock<Letter> = LazyLock::new(|| draw('\0', MISSING));

fn draw(letter: char, strokes: &str) -> Letter {
    let path: BezPath = strokes.split(';').flat_map(|text| stroke(text).into_iter()).collect();
    let advance = match letter {
        ' ' => BLANK,
        '0'..='9' => DIGIT,
        _ => path.bounding_box().x1 + SPACE,
    };
    Letter { path, advance }
}

fn stroke(text: &str) -> BezPath {
    let mut contour = Contour::default();
    for word in text.split_whitespace() {
        if word == "z" {
            contour.closed = true;
            continue;
        }
        let place = word.trim_end_matches(['o', '[', ']']);
        let join = match &word[place.len()..] {
            "o" => Join::G4,
            "[" => Join::CurveToTerminal,
            "]" => Join::TerminalToCurve,
            _ => Join::Corner,
        };
        let (x, y) = place.split_once(',').unwrap_or_default();
        let number = |text: &str| text.parse::<f64>().unwrap_or_default();
        contour.knots.push(Knot::new((number(x), number(y))).join(join));
    }
    let solution = catalog::spline("spiro").ok().and_then(|spiro| solve(&contour, &*spiro).ok());
    solution.map_or_else(BezPath::new, |solution| convert::to_bezpath(&solution.curve, 0.02))
}

/// One line of text whose capitals are `size` high, from the origin to the right, y up; letters have
/// no capital form. Stroke it with [`weight`] times `size`.
pub(super) fn text(words: &str, size: f64) -> BezPath {
    let scale = size / CAPITAL;
    let mut x = 0.0;
    let mut path = BezPath::new();
    for letter in letters(words) {
        let place = Affine::translate((x * scale, 0.0)) * Affine::scale(scale);
        path.extend((place * letter.path.clone()).iter());
        x += letter.advance;
    }
    path
}

/// How wide [`text`] is, from the first letter to the last.
pub(super) fn width(words: &str, size: f64) -> f64 {
    let advance: f64 = letters(words).map(|letter| letter.advance).sum();
    (advance - SPACE).max(0.0) * size / CAPITAL
}

/// The width of the strokes, as a part of the size.
pub(super) const fn weight() -> f64 {
    0.11
}

fn letters(words: &str) -> impl Iterator<Item = &'static Letter> + '_ {
    words.chars().flat_map(char::to_lowercase).map(|letter| DRAWN.get(&letter).unwrap_or(&BOX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_is_there_and_stays_on_the_grid() {
        for (letter, _) in LETTERS {
            let drawn = &DRAWN[letter];
            assert!(drawn.path.is_empty() == (*letter == ' '), "{letter}");
            let bounds = drawn.path.bounding_box();
            assert!(
                bounds.x0 >= -0.25 && bounds.y0 >= -2.3 && bounds.y1 <= 7.2,
                "{letter} {bounds}"
            );
            assert!(bounds.x1 <= drawn.advance, "{letter}");
        }
        for letter in ('a'..='z').chain('0'..='9') {
            assert!(DRAWN.contains_key(&letter), "{letter}");
        }
    }

    #[test]
    fn numbers_stand_in_columns() {
        assert_eq!(width("111", 6.0), width("888", 6.0));
        assert!(width("", 6.0) == 0.0 && width("m", 6.0) > width("i", 6.0));
        assert!(!text("\u{4e00}", 6.0).is_empty());
    }
}
