//! The one file that is edited.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::path::{Path, PathBuf};

use faircurve_format::{Document, Kind, read};

use crate::failure::Failure;
use crate::{input, output};

/// The version of a file that isn't there yet.
const ABSENT: &str = "\"absent\"";

/// A file to open and save, by its name on the command line.
#[derive(Debug)]
pub(crate) struct EditedFile {
    path: PathBuf,
    kind: &'static Kind,
}

/// Why the file was not saved.
#[derive(Debug)]
pub(crate) enum Unsaved {
    /// It isn't on disk what it was when it was opened.
    Changed,
    /// What was sent isn't a file of its kind, or the kind can't be written.
    Refused(String, String),
    /// The disk has refused.
    Unwritable(io::Error),
}

impl EditedFile {
    /// The file; one that isn't there yet begins empty. It is read to be sure that it can be.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        let place = path.display().to_string();
        let kind = input::kind_of(path).map_err(|failure| failure.within(&place))?;
        if path.exists() {
            input::read(&[path.to_owned()], Some(kind.name))?;
        } else if kind.write.is_none() {
            let hint = "name a .json file to begin a drawing".to_owned();
            return Err(Failure::new("there is no such file").hint(hint).within(&place));
        }
        // Where the program is started from must not matter later.
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        Ok(EditedFile { path, kind })
    }

    /// The file's name without folders.
    pub(crate) fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// What is on disk now, and its version.
    pub(crate) fn contents(&self) -> io::Result<(Vec<u8>, String)> {
        match fs::read(&self.path) {
            Ok(bytes) => {
                let version = version_of(&bytes);
                Ok((bytes, version))
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let empty = Document::unnamed([]);
                let text = self.kind.write.map(|write| write(&empty)).and_then(Result::ok);
                Ok((text.unwrap_or_default().into_bytes(), ABSENT.to_owned()))
            }
            Err(error) => Err(error),
        }
    }

    /// Saves `bytes` whole or not at all, if the file is still of that version (`*`: whatever there is);
    /// its new version.
    pub(crate) fn save(&self, bytes: &[u8], version: &str) -> Result<String, Unsaved> {
        if self.kind.write.is_none() {
            return Err(Unsaved::Refused(
                format!("{} files can be read, but not written", self.kind.name),
                "save among your downloads, or start `faircurve edit` with a .json file".to_owned(),
            ));
        }
        read(bytes, self.kind)
            .map_err(|error| Unsaved::Refused(error.to_string(), error.hint.unwrap_or_default()))?;
        if version != "*" {
            let (_, now) = self.contents().map_err(Unsaved::Unwritable)?;
            if now != version {
                return Err(Unsaved::Changed);
            }
        }
        output::to_file(&self.path, bytes).map_err(Unsaved::Unwritable)?;
        Ok(version_of(bytes))
    }
}

/// Tells versions of the file apart; it guards against accidents, not against forgers.
fn version_of(bytes: &[u8]) -> String {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    format!("\"{:016x}-{:x}\"", hasher.finish(), bytes.len())
}
