//! The files of the editor's page, as `cargo xtask editor` builds them.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Where the site is looked for, seen from the program's folder: as it is installed, and as it is built.
const PLACES: [&str; 4] = ["editor", "../share/faircurve/editor", "../editor", "../../editor"];

/// What a file is sent as, by its extension.
const TYPES: &[(&str, &str)] = &[
    ("html", "text/html; charset=utf-8"),
    ("js", "text/javascript; charset=utf-8"),
    ("css", "text/css; charset=utf-8"),
    ("svg", "image/svg+xml"),
    ("wasm", "application/wasm"),
    ("json", "application/json"),
];

/// Every file of the site by its path in addresses. Nothing else can be asked for.
#[derive(Debug)]
pub(crate) struct Site {
    files: BTreeMap<String, PathBuf>,
}

impl Site {
    /// The site in that folder, or where it is installed.
    pub(crate) fn find(folder: Option<&Path>) -> Result<Self, Failure> {
        let folder = match folder {
            Some(folder) if is_site(folder) => folder.to_owned(),
            Some(folder) => {
                return Err(Failure::new("the editor isn't in this folder")
                    .hint("name the folder that `cargo xtask editor` has built")
                    .within(&folder.display().to_string()));
            }
            None => installed().ok_or_else(|| {
                Failure::new("the editor's page isn't installed beside this program")
                    .hint("build it with `cargo xtask editor`, or name its folder with --site")
            })?,
        };
        let mut files = BTreeMap::new();
        collect(&folder, "", &mut files).map_err(|error| {
            Failure::new(format!("the editor's page can't be read: {error}"))
                .within(&folder.display().to_string())
        })?;
        Ok(Site { files })
    }

    /// The file of that path, and what it is sent as.
    pub(crate) fn file(&self, path: &str) -> Option<(io::Result<Vec<u8>>, &'static str)> {
        let path = if path.is_empty() { "index.html" } else { path };
        let file = self.files.get(path)?;
        let extension = file.extension().unwrap_or_default().to_string_lossy();
        let found = TYPES.iter().find(|(known, _)| *known == extension);
        Some((fs::read(file), found.map_or("application/octet-stream", |(_, kind)| kind)))
    }
}

fn is_site(folder: &Path) -> bool {
    folder.join("index.html").is_file() && folder.join("faircurve/index.js").is_file()
}

fn installed() -> Option<PathBuf> {
    let program = std::env::current_exe().ok()?;
    let beside = program.parent()?;
    PLACES.iter().map(|place| beside.join(place)).find(|folder| is_site(folder))
}

/// Every file in the folder and below, by its path with `/` between the parts.
fn collect(folder: &Path, before: &str, files: &mut BTreeMap<String, PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = format!("{before}{}", entry.file_name().to_string_lossy());
        if entry.file_type()?.is_dir() {
            collect(&entry.path(), &format!("{name}/"), files)?;
        } else {
            files.insert(name, entry.path());
        }
    }
    Ok(())
}
