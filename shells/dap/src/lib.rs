//! The debug adapter: the Debug Adapter Protocol over stdio, around the sessions of `groundstate`.
//!
//! In: requests, as a debugger's front end sends them, and the files of the shell. Out: responses and events. `frame` reads and
//! writes messages; `adapter` keeps the order of a debug session and has the requests; the run has a thread of its own.
//! INVARIANT: each request is answered once; what is wrong with a request is its answer, never the end of the adapter; a run can be
//! paused and ended at any time.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    clippy::disallowed_types,
    reason = "a shell: threads and messages are its work"
)]

mod adapter;
mod breakpoints;
mod console;
mod events;
mod frame;
mod launch;
mod message;
mod say;
mod stack;
mod target;
mod variables;

use std::io::{BufReader, Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use groundstate::workspace::Files;
use serde_json::Value;

use crate::adapter::Adapter;
use crate::frame::{Wrong, read_message, write_message};

/// While something runs, how often it is looked at.
const LOOK: Duration = Duration::from_millis(5);

/// Serves one debugger over stdin and stdout, until it disconnects or goes away.
///
/// # Errors
/// The debugger went away without saying so, or sent what is no message; a sentence for the log.
pub fn serve_stdio(files: impl Files + 'static) -> Result<(), String> {
    serve(std::io::stdin(), &mut std::io::stdout().lock(), files)
}

/// Serves one debugger.
///
/// # Errors
/// As [`serve_stdio`].
pub fn serve(input: impl Read + Send + 'static, output: &mut dyn Write, files: impl Files) -> Result<(), String> {
    let (sender, messages) = channel();
    let reader = std::thread::Builder::new().name("read".to_string()).spawn(move || {
        let mut input = BufReader::new(input);
        loop {
            let message = read_message(&mut input);
            let ends = matches!(&message, Ok(None) | Err(Wrong::Frame(_)));
            if sender.send(message).is_err() || ends {
                return;
            }
        }
    });
    reader.map_err(|error| format!("no thread can be started: {error}"))?;
    let mut adapter = Adapter::new(files);
    loop {
        let message = match adapter.is_running() {
            true => messages.recv_timeout(LOOK),
            false => messages.recv().map_err(|_| RecvTimeoutError::Disconnected),
        };
        match message {
            Ok(Ok(Some(message))) => request(&mut adapter, &message),
            Ok(Ok(None)) if adapter.has_ended() => return Ok(()),
            Ok(Ok(None)) => return Err("the debugger ended without `disconnect`".to_string()),
            Ok(Err(Wrong::Content(reason))) => adapter.log(&reason),
            Ok(Err(Wrong::Frame(reason))) => return Err(reason),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Err("nothing can be read any more".to_string()),
        }
        adapter.look();
        for message in adapter.take_messages() {
            write_message(output, &message).map_err(|error| format!("the debugger does not read: {error}"))?;
        }
        if adapter.has_ended() {
            return Ok(());
        }
    }
}

/// A panic is an error of the request that it happened in.
fn request<F: Files>(adapter: &mut Adapter<F>, message: &Value) {
    let before = adapter.answered();
    if catch_unwind(AssertUnwindSafe(|| adapter.request(message))).is_err() && adapter.answered() == before {
        adapter.fail(message, "this request failed: that is a defect of groundstate");
    }
}
