//! The language server: the protocol over stdio, around the answers of `ide`.
//!
//! In: messages of the Language Server Protocol 3.17. Out: messages. `session` reads them and keeps the texts that are being
//! edited; `worker` has the project on a thread of its own and asks `ide`; `answer` turns what it says into the protocol's types.
//! INVARIANT: the thread that reads messages never computes, so a cancellation or a change is known at once; an answer for a
//! text that has changed meanwhile is never sent, an error is; a panic while one request is answered is an error of that request
//! alone.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    clippy::disallowed_types,
    reason = "a shell: files, threads and messages are its work"
)]

mod answer;
mod background;
mod capabilities;
mod chart_view;
mod composite_view;
mod disk;
mod location;
mod pending;
mod places_view;
mod publish;
mod route;
mod run;
mod session;
mod settings;
mod system_view;
mod worker;

pub use disk::{Folder, project_files};
pub use location::{path_of, uri_of};
pub use lsp_server::Connection;
pub use session::{Ended, serve, serve_within};

/// Serves one editor over stdin and stdout, until it says that it has ended.
///
/// # Errors
/// The connection broke, or the editor ended without saying so first; a sentence for the log.
pub fn serve_stdio() -> Result<(), String> {
    let (connection, threads) = Connection::stdio();
    let ended = serve(&connection);
    drop(connection);
    match ended {
        Ok(Ended::AfterShutdown) => threads.join().map_err(|error| error.to_string()),
        Ok(Ended::WithoutShutdown) => Err("the editor ended without `shutdown`".to_string()),
        Err(reason) => Err(reason),
    }
}
