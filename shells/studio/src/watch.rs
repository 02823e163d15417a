//! What others change in the folder, as it happens.
//!
//! Where the system tells nothing (a network's disk, too many folders), the folder is looked at each second instead.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

use notify::{Config, EventKind, PollWatcher, RecursiveMode, Watcher};
use serde_json::{Value, json};

use crate::request::{changed, files};
use crate::studio::Studio;

/// How long nothing has to happen before it is looked: an editor writes a file in several steps.
const REST: Duration = Duration::from_millis(25);
/// How often the folder is looked at where the system tells nothing.
const SECOND: Duration = Duration::from_secs(1);

/// Watches until the studio is gone; keep what it gives as long as that.
///
/// # Errors
/// The folder cannot be watched in either way; a sentence.
pub fn watch(studio: &Arc<Studio>) -> Result<Box<dyn Watcher + Send>, String> {
    let (events, happened) = channel();
    let root = studio.folder.root().to_path_buf();
    let by_system = notify::recommended_watcher(listener(events.clone()))
        .and_then(|mut watcher| watcher.watch(&root, RecursiveMode::Recursive).map(|()| watcher));
    let watcher: Box<dyn Watcher + Send> = match by_system {
        Ok(watcher) => Box::new(watcher),
        Err(_) => {
            let config = Config::default().with_poll_interval(SECOND);
            let cannot = |error: notify::Error| format!("the folder cannot be watched: {error}");
            let mut watcher = PollWatcher::new(listener(events), config).map_err(cannot)?;
            watcher.watch(&root, RecursiveMode::Recursive).map_err(cannot)?;
            Box::new(watcher)
        }
    };
    let studio = Arc::clone(studio);
    std::thread::spawn(move || follow(&studio, &happened));
    Ok(watcher)
}

fn listener(events: Sender<()>) -> impl Fn(notify::Result<notify::Event>) {
    move |event: notify::Result<notify::Event>| {
        if event.is_ok_and(|event| !matches!(event.kind, EventKind::Access(_))) {
            _ = events.send(());
        }
    }
}

fn follow(studio: &Studio, happened: &Receiver<()>) {
    let mut listed: Vec<Value> = files(&studio.folder);
    while happened.recv().is_ok() {
        loop {
            match happened.recv_timeout(REST) {
                Ok(()) => {}
                Err(RecvTimeoutError::Timeout) => break,
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
        // What is written meanwhile is told after this, not before.
        let mut store = studio.store();
        for (path, now) in store.changed(&studio.folder) {
            changed(studio, &path, now, None);
        }
        drop(store);
        let present = files(&studio.folder);
        if present != listed {
            studio.tell("studio/files", &json!({ "files": present }), None);
            listed = present;
        }
        studio.files_changed();
    }
}
