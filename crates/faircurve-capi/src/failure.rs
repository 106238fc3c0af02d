//! Why a call failed: a status, and words with the place and what to do.

use faircurve::InputError;
use faircurve::catalog::CatalogError;
use faircurve_format::FormatError;

use crate::fc_status;

/// Why a call failed.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) status: fc_status,
    /// `error: …`, and `hint: …` on a second line where there is something to say; empty where the status says
    /// it all.
    pub(crate) text: String,
}

impl Failure {
    fn new(status: fc_status, message: &str, hint: Option<&str>) -> Self {
        let hint = hint.map(|hint| format!("\nhint: {hint}")).unwrap_or_default();
        Failure { status, text: format!("error: {message}{hint}") }
    }

    /// An option that means nothing.
    pub(crate) fn option(message: &str, hint: &str) -> Self {
        Failure::new(fc_status::FC_BAD_OPTIONS, message, Some(hint))
    }

    /// A contour that can't be solved at all; `place` says which.
    pub(crate) fn contour(place: &str, error: &InputError) -> Self {
        Failure::new(fc_status::FC_BAD_CONTOUR, &format!("{place}: {error}"), Some(error.hint()))
    }
}

impl From<fc_status> for Failure {
    fn from(status: fc_status) -> Self {
        Failure { status, text: String::new() }
    }
}

impl From<FormatError> for Failure {
    fn from(error: FormatError) -> Self {
        Failure::new(fc_status::FC_BAD_DOCUMENT, &error.to_string(), error.hint.as_deref())
    }
}

impl From<CatalogError> for Failure {
    fn from(error: CatalogError) -> Self {
        Failure::new(fc_status::FC_UNKNOWN_NAME, &error.to_string(), Some(&error.hint()))
    }
}
