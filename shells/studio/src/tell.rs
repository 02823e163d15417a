//! What goes to a tab.

use serde_json::{Value, json};

/// Messages to a tab that wait at a time. LIMIT: a tab that reads more slowly is let go; it connects again and reads anew.
pub const WAITING: usize = 4_096;

/// A message for a tab.
#[derive(Debug, Clone)]
pub enum Out {
    /// A message to the browser.
    Say(String),
    /// To its language server: files have changed.
    FilesChanged,
}

/// A notification as it is sent.
pub fn notification(method: &str, params: &Value) -> Out {
    Out::Say(json!({ "jsonrpc": "2.0", "method": method, "params": params }).to_string())
}
