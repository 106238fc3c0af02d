//! What became of a call.

use std::ffi::{CStr, c_int};

use crate::fc_status;

/// Every status with what it says.
const MESSAGES: [(fc_status, &CStr); 10] = [
    (fc_status::FC_OK, c"done"),
    (fc_status::FC_NULL_ARGUMENT, c"an argument is NULL that must not be"),
    (fc_status::FC_BAD_OPTIONS, c"the options have a size or a value that means nothing"),
    (fc_status::FC_BAD_DOCUMENT, c"the text is not a faircurve document"),
    (fc_status::FC_BAD_CONTOUR, c"a contour can't be solved at all: a number in it has no meaning"),
    (fc_status::FC_UNKNOWN_NAME, c"there is no spline of that name, or it lacks that parameter"),
    (fc_status::FC_OUT_OF_RANGE, c"a number is beyond what there is"),
    (fc_status::FC_NO_CURVE, c"the contour has no segment"),
    (fc_status::FC_TOO_SMALL, c"the array is too small"),
    (fc_status::FC_BUG, c"faircurve has failed inside; please report it"),
];

/// What a status says, for people; for numbers that are none, that.
pub(crate) fn message(status: c_int) -> &'static CStr {
    let known = MESSAGES.iter().find(|(known, _)| *known as c_int == status);
    known.map_or(c"there is no such status", |(_, message)| *message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_status_has_its_own_message() {
        for (i, (status, message)) in MESSAGES.iter().enumerate() {
            assert_eq!(*status as usize, i);
            assert!(MESSAGES[..i].iter().all(|(_, other)| other != message));
            assert_eq!(super::message(i as c_int), *message);
        }
        for none in [-1, MESSAGES.len() as c_int, c_int::MAX] {
            assert_eq!(message(none), c"there is no such status");
        }
    }
}
