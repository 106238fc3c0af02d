//! The files that faircurve reads and writes: one module a format, all through one [`Document`].

pub mod catalogue_json;
pub mod csv;
pub mod document;
pub mod error;
pub mod json;
pub mod kind;
mod number;
pub mod path;
pub mod picture;
#[cfg(feature = "png")]
pub mod png;
pub mod sfd;
pub mod solution_json;
pub mod solved;
pub mod svg;
mod text;

pub use document::{Document, DocumentContour, Glyph, SplineChoice};
pub use error::{FormatError, Location};
pub use kind::{KINDS, Kind, read};
pub use picture::{Panel, Picture, Show};
pub use solved::{SolvedContour, SolvedGlyph};
