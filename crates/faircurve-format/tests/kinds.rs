//! The table of formats.

use faircurve_format::{KINDS, Kind};
use insta::assert_snapshot;

#[test]
fn formats_are_found_by_name_and_extension() {
    for kind in KINDS {
        assert_eq!(Kind::from_name(kind.name).unwrap().name, kind.name);
        for extension in kind.extensions {
            assert_eq!(Kind::from_extension(extension).unwrap().name, kind.name);
            let upper = extension.to_uppercase();
            assert_eq!(Kind::from_extension(&upper).unwrap().name, kind.name);
        }
    }
}

#[test]
fn no_two_formats_share_a_name_or_extension() {
    let mut names: Vec<&str> = KINDS.iter().map(|kind| kind.name).collect();
    let mut extensions: Vec<&str> =
        KINDS.iter().flat_map(|kind| kind.extensions.iter().copied()).collect();
    for list in [&mut names, &mut extensions] {
        let count = list.len();
        list.sort_unstable();
        list.dedup();
        assert_eq!(list.len(), count);
    }
}

#[test]
fn unknown_formats_are_explained() {
    let shown = |found: Result<&Kind, faircurve_format::FormatError>| {
        let error = found.unwrap_err();
        format!("{error}\n  hint: {}", error.hint.as_deref().unwrap())
    };
    assert_snapshot!(shown(Kind::from_name("jsn")), @r#"
    there is no input format `jsn`
      hint: did you mean `json`?
    "#);
    assert_snapshot!(shown(Kind::from_name("ufo")), @r#"
    there is no input format `ufo`
      hint: use one of `json`, `csv`, `sfd`
    "#);
    assert_snapshot!(shown(Kind::from_extension("sdf")), @r#"
    no input format has the extension `sdf`
      hint: use one of `json`, `csv`, `sfd`, `glyph`
    "#);
    assert_snapshot!(shown(Kind::from_extension("")), @r#"
    the file's name has no extension that tells its format
      hint: use one of `json`, `csv`, `sfd`, `glyph`
    "#);
}
