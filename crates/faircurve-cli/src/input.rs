//! Reading documents.

use std::ffi::OsStr;
use std::io::Read;
use std::path::{Path, PathBuf};

use faircurve_format::{Document, Kind};

use crate::failure::Failure;

/// A document and the name of the file that it is from.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub(crate) name: String,
    pub(crate) document: Document,
}

/// Reads every input; `-` is stdin.
pub(crate) fn read(inputs: &[PathBuf], from: Option<&str>) -> Result<Vec<Source>, Failure> {
    let from = from.map(Kind::from_name).transpose()?;
    if inputs.iter().filter(|path| is_stdio(path)).count() > 1 {
        return Err(Failure::new("stdin (`-`) can be read only once"));
    }
    inputs.iter().map(|path| read_one(path, from)).collect()
}

/// Whether it stands for stdin or stdout.
pub(crate) fn is_stdio(path: &Path) -> bool {
    path == Path::new("-")
}

fn read_one(path: &Path, from: Option<&'static Kind>) -> Result<Source, Failure> {
    let name = if is_stdio(path) { "stdin".to_owned() } else { path.display().to_string() };
    let kind = match from {
        Some(kind) => kind,
        None => kind_of(path).map_err(|failure| failure.within(&name))?,
    };
    let bytes = bytes_of(path).map_err(|failure| failure.within(&name))?;
    if bytes.trim_ascii().is_empty() {
        let hint = format!("a {} file holds contours with their knots", kind.name);
        return Err(Failure::new("the file is empty").hint(hint).within(&name));
    }
    match faircurve_format::read(&bytes, kind) {
        Ok(document) => Ok(Source { name, document }),
        Err(error) => Err(Failure::in_source(error.in_file(name), &bytes)),
    }
}

pub(crate) fn kind_of(path: &Path) -> Result<&'static Kind, Failure> {
    if is_stdio(path) {
        return Ok(Kind::from_name("json")?);
    }
    let extension = path.extension().unwrap_or(OsStr::new("")).to_string_lossy();
    Kind::from_extension(&extension).or_else(|error| {
        // What isn't there, or is a folder, has no format that anyone could name.
        let found = std::fs::metadata(path).map_err(|error| unreadable(&error))?;
        if found.is_dir() {
            return Err(is_folder());
        }
        let hint = error.hint.clone().unwrap_or_default();
        Err(Failure::from(error).hint(format!("{hint}, or name the format with --from")))
    })
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, Failure> {
    if is_stdio(path) {
        let mut bytes = Vec::new();
        std::io::stdin().lock().read_to_end(&mut bytes).map_err(|error| unreadable(&error))?;
        return Ok(bytes);
    }
    if path.is_dir() {
        return Err(is_folder());
    }
    std::fs::read(path).map_err(|error| unreadable(&error))
}

fn is_folder() -> Failure {
    Failure::new("this is a folder, not a file").hint("name the file in it")
}

fn unreadable(error: &std::io::Error) -> Failure {
    match error.kind() {
        std::io::ErrorKind::NotFound => {
            Failure::new("there is no such file").hint("check the name, and the folder you are in")
        }
        std::io::ErrorKind::PermissionDenied => {
            Failure::new("you may not read this file").hint("check its permissions")
        }
        _ => Failure::new(format!("the file can't be read: {error}")),
    }
}
