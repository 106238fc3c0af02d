//! `faircurve edit`: the editor in a browser on this machine, with one file to open and save.
//!
//! What a page from elsewhere could try is refused: the server listens on loopback alone, answers only
//! requests that name it as their host and, if they say so, as their origin, and gives the file only to who
//! knows the token that is in the printed address. There is one file; no request names another.

mod file;
mod server;
mod site;

use std::process::ExitCode;

use crate::args::EditArgs;
use crate::failure::{self, Failure};
use crate::output;
use file::EditedFile;
use server::Server;
use site::Site;

/// Runs until the program is stopped.
pub(crate) fn run(args: &EditArgs) -> Result<ExitCode, Failure> {
    let file = args.file.as_deref().map(EditedFile::open).transpose()?;
    let site = Site::find(args.site.as_deref())?;
    let server = Server::bind(args.port, site, file)?;
    let address = server.address();
    output::to_stdout(format!("{address}\n").as_bytes())?;
    failure::note("note", "the editor is at this address, on this machine alone; Ctrl-C ends it");
    if !args.no_browser && open::that_detached(&address).is_err() {
        failure::hint("open the address in a browser");
    }
    server.serve().map(|()| ExitCode::SUCCESS)
}
