//! The contours to run: every contour of some files.

use std::path::{Path, PathBuf};

use faircurve::Contour;
use faircurve_format::{FormatError, Kind};

use crate::Failure;

/// A contour and where it comes from.
#[derive(Clone, Debug)]
pub(crate) struct FontContour {
    /// The file's name without its extension.
    pub(crate) font: String,
    /// Glyph, layer and contour index, such as `a/Fore/0`.
    pub(crate) place: String,
    /// The contour.
    pub(crate) contour: Contour,
}

impl FontContour {
    /// Font and place.
    pub(crate) fn name(&self) -> String {
        format!("{} {}", self.font, self.place)
    }
}

/// Real fonts that may lie next to the repository.
fn default_files() -> Vec<PathBuf> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data"));
    ["Cantarell-Regular-Spiro.sfd", "Chomsky.sfd", "KJV1611.sfd"]
        .into_iter()
        .map(|name| folder.join(name))
        .collect()
}

/// Every contour of the given files, in order; of the default files if none is given.
///
/// # Errors
/// If a file can't be read.
pub(crate) fn read(files: &[PathBuf]) -> Result<Vec<FontContour>, Failure> {
    let files = if files.is_empty() { default_files() } else { files.to_vec() };
    let mut contours = Vec::new();
    for file in files {
        contours.extend(read_file(&file)?);
    }
    Ok(contours)
}

fn read_file(file: &Path) -> Result<Vec<FontContour>, Failure> {
    let in_words = |error: FormatError| {
        let error = error.in_file(file.display().to_string());
        Failure { message: error.to_string(), hint: error.hint.unwrap_or_default() }
    };
    let extension = file.extension().unwrap_or_default().to_string_lossy();
    let kind = Kind::from_extension(&extension).map_err(in_words)?;
    let bytes = std::fs::read(file).map_err(|error| Failure {
        message: format!("can't read {}: {error}", file.display()),
        hint: "name the files to run, such as SFD fonts or faircurve documents".to_owned(),
    })?;
    let document = faircurve_format::read(&bytes, kind).map_err(in_words)?;
    let font = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let contours = document.glyphs.into_iter().flat_map(|glyph| {
        let font = font.clone();
        glyph.contours.into_iter().enumerate().map(move |(index, contour)| FontContour {
            font: font.clone(),
            place: format!("{}/{}/{index}", glyph.name, glyph.layer),
            contour: contour.contour,
        })
    });
    Ok(contours.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    #[expect(clippy::print_stdout, reason = "tests say why they are skipped")]
    fn the_fonts_have_the_contours_that_they_are_known_for() {
        let files = default_files();
        if !files.iter().all(|file| file.exists()) {
            println!("skipped: the fonts don't lie next to the repository");
            return;
        }
        let counts: Vec<usize> = files
            .iter()
            .map(|file| read_file(file).unwrap_or_else(|f| panic!("{}", f.message)).len())
            .collect();
        assert_eq!(counts, [180, 760, 93]);
    }

    #[test]
    fn what_cannot_be_read_is_named_with_a_way_out() {
        for name in ["missing.sfd", "font.xyz", "no-extension"] {
            let failure = read(&[PathBuf::from(name)]).unwrap_err();
            assert!(failure.message.contains(name), "{}", failure.message);
            assert!(!failure.hint.is_empty());
        }
    }
}
