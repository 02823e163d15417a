//! The studio as browsers meet it, and those who have no business there: over HTTP and WebSockets.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    clippy::disallowed_types,
    reason = "tests of a shell, over files and sockets"
)]

mod attack;
mod beside;
mod browser;
mod system;
mod work;
