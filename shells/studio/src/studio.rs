//! What all tabs share: the folder, who may ask, the texts as they are known, who listens.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde_json::Value;
use tokio::sync::Notify;
use tokio::sync::mpsc::Sender;
use tokio::sync::mpsc::error::TrySendError;

use crate::folder::Folder;
use crate::job::Jobs;
use crate::store::Store;
use crate::tell::{Out, notification};

/// A tab that listens.
#[derive(Debug, Clone)]
pub struct Tab {
    /// Where its messages go.
    pub out: Sender<Out>,
    /// Told when it is let go.
    pub gone: Arc<Notify>,
}

/// See the module.
#[derive(Debug)]
pub struct Studio {
    /// What can be reached.
    pub folder: Folder,
    /// Who knows it may ask.
    pub token: String,
    /// The port.
    pub port: u16,
    /// The names that this start answers to.
    pub hosts: Vec<String>,
    /// Nothing is written.
    pub read_only: bool,
    /// Processes that run.
    pub jobs: Arc<Jobs>,
    store: Mutex<Store>,
    tabs: Mutex<BTreeMap<u64, Tab>>,
    last: AtomicU64,
}

impl Studio {
    /// A studio that nobody looks at yet.
    pub fn new(folder: Folder, token: String, port: u16, read_only: bool, program: PathBuf) -> Studio {
        let root = folder.root().to_path_buf();
        Studio {
            folder,
            token,
            port,
            hosts: ["127.0.0.1", "localhost"].iter().map(|name| format!("{name}:{port}")).collect(),
            read_only,
            jobs: Arc::new(Jobs::new(program, root)),
            store: Mutex::default(),
            tabs: Mutex::default(),
            last: AtomicU64::new(0),
        }
    }

    /// The cookie's name: cookies do not tell ports apart.
    pub fn cookie(&self) -> String {
        format!("groundstate-{}", self.port)
    }

    /// The texts as they are known.
    pub fn store(&self) -> MutexGuard<'_, Store> {
        // What a panic left is whole: each change of it is.
        self.store.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn tabs(&self) -> MutexGuard<'_, BTreeMap<u64, Tab>> {
        self.tabs.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A new tab, if fewer than so many are open.
    pub fn enter(&self, tab: Tab, limit: usize) -> Option<u64> {
        let mut tabs = self.tabs();
        if tabs.len() >= limit {
            return None;
        }
        let number = self.last.fetch_add(1, Ordering::Relaxed);
        tabs.insert(number, tab);
        Some(number)
    }

    /// A tab is gone.
    pub fn leave(&self, tab: u64) {
        self.tabs().remove(&tab);
        self.jobs.stop_of(tab);
    }

    /// Tells all tabs but one.
    pub fn tell(&self, method: &str, params: &Value, but: Option<u64>) {
        self.send(&notification(method, params), but);
    }

    /// Tells the language servers of all tabs that files have changed.
    pub fn files_changed(&self) {
        self.send(&Out::FilesChanged, None);
    }

    fn send(&self, news: &Out, but: Option<u64>) {
        let goes_on = |tab: &Tab| match tab.out.try_send(news.clone()) {
            Ok(()) => true,
            Err(TrySendError::Closed(_) | TrySendError::Full(_)) => {
                tab.gone.notify_one();
                false
            }
        };
        self.tabs().retain(|number, tab| Some(*number) == but || goes_on(tab));
    }
}
