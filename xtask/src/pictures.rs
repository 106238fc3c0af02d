//! Pictures of families, in docs/figures and in the families' READMEs.

use std::fs;
use std::path::{Path, PathBuf};

use faircurve_format::{Picture, png, svg};

use crate::family::Family;
use crate::{at, root};

/// A picture that every family has.
struct Kind {
    /// How its file's name ends.
    suffix: &'static str,
    /// What it shows, for those who don't see it.
    words: &'static str,
    draw: fn(&Family) -> Picture,
}

const KINDS: [Kind; 2] = [
    Kind {
        suffix: "space",
        words: "the segment for each pair of end angles",
        draw: |family| {
            Picture::parameter_space(&title(family, "segments"), &|angles| family.segment(angles))
        },
    },
    Kind {
        suffix: "map",
        words: "curvature at the start of a segment as a function of both end angles",
        draw: |family| {
            let title = title(family, "curvature at the start");
            Picture::curvature_map(&title, &|angles| family.curvature(angles))
        },
    },
];

fn title(family: &Family, what: &str) -> String {
    format!("{}: {what}", family.info.name)
}

fn file(family: &Family, kind: &Kind) -> String {
    format!("{}-{}.svg", family.info.name, kind.suffix)
}

fn figures() -> PathBuf {
    root().join("docs/figures")
}

/// Draws them all, and puts those that a README lacks into it.
pub(crate) fn draw() -> Result<(), String> {
    for family in Family::all() {
        for kind in &KINDS {
            let path = figures().join(file(&family, kind));
            let drawn = svg::write(&(kind.draw)(&family));
            let current = fs::read_to_string(&path).unwrap_or_default();
            // What differs by rounding only stays as it is.
            if difference(&current, &drawn).is_some() {
                fs::write(&path, &drawn).map_err(|error| at(&path, &error))?;
                println!("drew {}", path.display());
            }
        }
        let path = readme(&family);
        let text = fs::read_to_string(&path).map_err(|error| at(&path, &error))?;
        if let Some(text) = with_pictures(&family, &text) {
            fs::write(&path, text).map_err(|error| at(&path, &error))?;
            println!("put pictures into {}", path.display());
        }
    }
    Ok(())
}

/// Fails with the first picture that isn't what the code draws, or that a README lacks.
pub(crate) fn check() -> Result<(), String> {
    let redraw = "run `cargo xtask pictures`, and look at what has changed";
    for family in Family::all() {
        for kind in &KINDS {
            let path = figures().join(file(&family, kind));
            let current = fs::read_to_string(&path).map_err(|error| at(&path, &error))?;
            if let Some(what) = difference(&current, &svg::write(&(kind.draw)(&family))) {
                return Err(format!("{}: {what}; {redraw}", path.display()));
            }
        }
        let path = readme(&family);
        let text = fs::read_to_string(&path).map_err(|error| at(&path, &error))?;
        if with_pictures(&family, &text).is_some() {
            return Err(format!("{}: its pictures aren't in it; {redraw}", path.display()));
        }
    }
    println!("every picture of a family is what the code draws");
    Ok(())
}

/// Draws them as PNG into a folder.
pub(crate) fn draw_png(folder: &Path) -> Result<(), String> {
    for family in Family::all() {
        for kind in &KINDS {
            let path = folder.join(file(&family, kind)).with_extension("png");
            let drawn = png::write(&(kind.draw)(&family), 1000).map_err(|e| e.to_string())?;
            fs::write(&path, drawn).map_err(|error| at(&path, &error))?;
        }
    }
    Ok(())
}

fn readme(family: &Family) -> PathBuf {
    root().join("crates/faircurve/src/families").join(family.folder()).join("README.md")
}

/// The README with the pictures that it lacks before its first section; `None` if it has them.
fn with_pictures(family: &Family, text: &str) -> Option<String> {
    let lacking = KINDS.iter().filter(|kind| !text.contains(&file(family, kind)));
    let lines: Vec<String> = lacking
        .map(|kind| {
            let (name, file) = (family.info.name, file(family, kind));
            format!("![{name}: {}](../../../../../docs/figures/{file})\n", kind.words)
        })
        .collect();
    if lines.is_empty() {
        return None;
    }
    let caption = "\n*θ0 to the right, θ1 upward, drawn by `cargo xtask pictures`. Curvature is that for unit chord, \
                   counterclockwise positive.*\n\n";
    let at = text.find("\n## ").map_or(text.len(), |at| at + 1);
    Some(format!("{}{}{caption}{}", &text[..at], lines.concat(), &text[at..]))
}

/// What differs between two SVG files by more than rounding: the words must be the same, and the
/// numbers nearly.
fn difference(a: &str, b: &str) -> Option<String> {
    /// A tenth of a unit is the last digit written; a unit is a five-hundredth of the picture.
    const NEARLY: f64 = 0.25;
    let (a, b) = (tokens(a), tokens(b));
    for (a, b) in a.iter().zip(&b) {
        match (a, b) {
            (Token::Number(x), Token::Number(y)) if (x - y).abs() <= NEARLY => {}
            (Token::Number(x), Token::Number(y)) => return Some(format!("{x} is now {y}")),
            (Token::Words(x), Token::Words(y)) if x == y => {}
            _ => return Some("the drawing is made of other parts now".to_owned()),
        }
    }
    (a.len() != b.len()).then(|| "there is more or less in the drawing now".to_owned())
}

#[derive(Debug, PartialEq)]
enum Token<'a> {
    Number(f64),
    Words(&'a str),
}

/// Numbers, and what is between them.
fn tokens(text: &str) -> Vec<Token<'_>> {
    let is_number = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let in_number = is_number(first);
        let end = rest.find(|c| is_number(c) != in_number).unwrap_or(rest.len());
        let (here, after) = rest.split_at(end);
        tokens.push(match here.parse() {
            Ok(number) if in_number => Token::Number(number),
            _ => Token::Words(here),
        });
        rest = after;
    }
    tokens
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_differ_by_more_than_rounding() {
        assert_eq!(difference("M1.5,2 L3", "M1.6,2 L3"), None);
        assert!(difference("M1.5,2 L3", "M2.5,2 L3").is_some());
        assert!(difference("M1.5,2 L3", "M1.5,2 M3").is_some());
        assert!(difference("M1.5,2 L3", "M1.5,2 L3 4").is_some());
        assert_eq!(tokens("a-1.5b"), [Token::Words("a"), Token::Number(-1.5), Token::Words("b")]);
    }
}
