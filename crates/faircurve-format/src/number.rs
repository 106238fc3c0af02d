//! Numbers as text, the same in every format: only finite ones, and they round-trip.

use faircurve::tolerance::LARGEST_COORDINATE;

/// Reads a finite number; the error says what is wrong with `text`.
pub(crate) fn parse(text: &str) -> Result<f64, String> {
    // Rust's own parser also takes the words that stand for numbers that aren't.
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) if text.contains(|c: char| c.is_ascii_digit()) => {
            Err(format!("`{}` is beyond the largest number", excerpt(text)))
        }
        Ok(_) => Err(format!("`{text}` is not a finite number")),
        Err(_) if text.is_empty() => Err("a number is missing".to_owned()),
        Err(_) => Err(format!("`{}` is not a number", excerpt(text))),
    }
}

/// Reads a coordinate: a number that the solvers can take.
pub(crate) fn parse_coordinate(text: &str) -> Result<f64, String> {
    let number = parse(text)?;
    if number.abs() > LARGEST_COORDINATE {
        return Err(format!("`{}` lies beyond {LARGEST_COORDINATE:e} units", excerpt(text)));
    }
    Ok(number)
}

/// The shortest text that reads back as the same number, without a needless `.0`. Only for finite
/// numbers.
pub(crate) fn write(number: f64) -> String {
    // `{:?}` changes to an exponent where `{}` would write hundreds of digits.
    let text = format!("{number:?}");
    match text.strip_suffix(".0") {
        Some(whole) => whole.to_owned(),
        None => text,
    }
}

/// The start of a text that may be long or hold anything, for messages: one line, printable.
pub(crate) fn excerpt(text: &str) -> String {
    /// More than any sensible token, less than a line.
    const LONGEST: usize = 40;
    let mut shown = String::new();
    for c in text.chars().take(LONGEST) {
        match c {
            '"' | '\'' | '\\' => shown.push(c),
            _ => shown.extend(c.escape_debug()),
        }
    }
    if text.chars().nth(LONGEST).is_some() {
        shown.push('…');
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn written_numbers_read_back(bits: u64) {
            let number = f64::from_bits(bits);
            prop_assume!(number.is_finite());
            let read = parse(&write(number)).unwrap();
            prop_assert_eq!(read.to_bits(), bits);
        }
    }

    #[test]
    fn whole_numbers_have_no_point() {
        assert_eq!(write(90.0), "90");
        assert_eq!(write(-0.5), "-0.5");
        assert_eq!(write(1e300), "1e300");
    }

    #[test]
    fn what_is_no_number_says_so() {
        assert_eq!(parse("NaN").unwrap_err(), "`NaN` is not a finite number");
        assert_eq!(parse("-inf").unwrap_err(), "`-inf` is not a finite number");
        assert_eq!(parse("1e999").unwrap_err(), "`1e999` is beyond the largest number");
        assert_eq!(parse("").unwrap_err(), "a number is missing");
        assert_eq!(parse("1,5").unwrap_err(), "`1,5` is not a number");
        assert_eq!(parse_coordinate("1e300").unwrap_err(), "`1e300` lies beyond 1e55 units");
    }
}
