//! The studio: a project's folder in a browser. Charts are drawn and edited, models run, checks started.
//!
//! In: a folder, and what a browser asks over HTTP and one WebSocket a tab (docs/studio.md). Out: answers; files of the folder, written
//! whole. A browser is an editor: what it asks about texts, charts and runs goes to a language server of its own (`lsp`), in memory.
//! What takes long is a process of this program (`job`), so it can be stopped whatever it does. `guard` says who may ask, `folder` what
//! can be reached, `store` how nobody's words are lost.
//! INVARIANT: nothing outside the folder is read or written, but the built-in libraries; nobody gets an answer who does not know the token
//! of this start; a file on the disk is whole at any time.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    clippy::disallowed_types,
    reason = "a shell: files, processes, threads and sockets are its work"
)]

mod asset;
mod export;
mod folder;
mod generated;
mod guard;
mod home;
mod inputs;
mod job;
mod line;
mod machines;
mod model;
mod names;
mod program;
mod request;
mod serve;
mod socket;
mod sources;
mod store;
mod studio;
mod tell;
mod watch;

pub use export::{Export, export};
pub use serve::{Options, Started, serve};
