//! The table of formats that documents come in.

use faircurve::catalog::suggest;

use crate::document::Document;
use crate::error::FormatError;
use crate::{csv, json, sfd};

/// Reads a whole file.
pub type Read = fn(&[u8]) -> Result<Document, FormatError>;

/// Writes a whole file.
pub type Write = fn(&Document) -> Result<String, FormatError>;

/// A format of documents: one row of the [table](KINDS).
#[derive(Debug)]
pub struct Kind {
    /// The name used on the command line.
    pub name: &'static str,
    /// One line for lists.
    pub summary: &'static str,
    /// How names of such files end, without the dot, in lower case.
    pub extensions: &'static [&'static str],
    /// Reads a whole file.
    pub read: Read,
    /// Writes a whole file, if documents can be written in this format; refuses documents that
    /// hold more than the format can.
    pub write: Option<Write>,
}

/// Every format that documents are read from, in the order in which lists show them.
pub const KINDS: &[Kind] = &[
    Kind {
        name: "json",
        summary: "faircurve document: everything",
        extensions: &["json"],
        read: json::read,
        write: Some(json::write),
    },
    Kind {
        name: "csv",
        summary: "rows of x,y,join: one drawing",
        extensions: &["csv"],
        read: csv::read,
        write: Some(csv::write),
    },
    Kind {
        name: "sfd",
        summary: "FontForge font or glyph: the Spiro points of every glyph and layer",
        extensions: &["sfd", "glyph"],
        read: sfd::read,
        write: None,
    },
];

impl Kind {
    /// The format of that name.
    ///
    /// # Errors
    /// [`FormatError`] whose hint has the near names.
    pub fn from_name(name: &str) -> Result<&'static Kind, FormatError> {
        KINDS.iter().find(|kind| kind.name == name).ok_or_else(|| {
            FormatError::new(format!("there is no input format `{name}`"))
                .hint(suggest(name, KINDS.iter().map(|kind| kind.name)))
        })
    }

    /// The format of files whose name ends so: an extension without the dot, in any case.
    ///
    /// # Errors
    /// [`FormatError`] whose hint has the near extensions.
    pub fn from_extension(extension: &str) -> Result<&'static Kind, FormatError> {
        let extension = extension.to_lowercase();
        KINDS.iter().find(|kind| kind.extensions.contains(&extension.as_str())).ok_or_else(|| {
            let known = KINDS.iter().flat_map(|kind| kind.extensions.iter().copied());
            let message = match extension.as_str() {
                "" => "the file's name has no extension that tells its format".to_owned(),
                _ => format!("no input format has the extension `{extension}`"),
            };
            FormatError::new(message).hint(suggest(&extension, known))
        })
    }
}

/// Reads a whole file of that kind.
///
/// # Errors
/// [`FormatError`] with the place in the file; never half a document.
///
/// ```
/// use faircurve_format::{Kind, read};
/// let document = read(b"0,0\n10,10\n20,0\n", Kind::from_extension("csv")?)?;
/// assert_eq!(document.glyphs[0].contours[0].contour.knots.len(), 3);
/// # Ok::<(), faircurve_format::FormatError>(())
/// ```
pub fn read(bytes: &[u8], kind: &Kind) -> Result<Document, FormatError> {
    (kind.read)(bytes)
}
