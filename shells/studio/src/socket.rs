//! One tab: a WebSocket with messages of JSON-RPC, and a language server of its own.
//!
//! What begins with `studio/` is answered here, by `request`; everything else is the language server's, which runs in memory on threads of
//! its own and reaches only files of the folder. LIMIT: tabs at a time, bytes of a message.

use std::sync::Arc;

use axum::extract::State;
use axum::extract::ws::{Message as Frame, WebSocket, WebSocketUpgrade};
use axum::response::Response;
use lsp_server::{Connection, Message, Notification};
use serde_json::{Value, json};
use tokio::sync::Notify;
use tokio::sync::mpsc::{Receiver, Sender, channel};

use crate::folder::BYTES;
use crate::request;
use crate::studio::{Studio, Tab};
use crate::tell::{Out, WAITING};

/// LIMIT: tabs at a time.
const TABS: usize = 16;

/// A tab connects.
pub async fn connect(State(studio): State<Arc<Studio>>, upgrade: WebSocketUpgrade) -> Response {
    // A file in JSON is longer than it is.
    let most = 4 * BYTES as usize;
    upgrade.max_message_size(most).max_frame_size(most).on_upgrade(move |socket| serve(studio, socket))
}

async fn serve(studio: Arc<Studio>, mut socket: WebSocket) {
    let (out, outgoing) = channel(WAITING);
    let gone = Arc::new(Notify::new());
    let Some(tab) = studio.enter(Tab { out: out.clone(), gone: Arc::clone(&gone) }, TABS) else {
        let sorry = json!({ "jsonrpc": "2.0", "method": "studio/refused",
                            "params": { "reason": format!("{TABS} tabs are open: close one first") } });
        _ = socket.send(Frame::Text(sorry.to_string().into())).await;
        return;
    };
    let server = language_server(&studio, out.clone());
    tokio::select! {
        () = talk(&studio, tab, &mut socket, out, outgoing, &server) => {}
        () = gone.notified() => {}
    }
    studio.leave(tab);
    // The server ends with its connection.
    drop(server);
}

/// Starts a language server whose answers go to the tab. Out: where its messages come in.
fn language_server(studio: &Arc<Studio>, out: Sender<Out>) -> lsp_server::Connection {
    let (own, its) = Connection::memory();
    let root = studio.folder.root().to_path_buf();
    std::thread::spawn(move || {
        // A tab that is closed before it has begun is no trouble.
        _ = lsp::serve_within(&its, &root);
    });
    let answers = own.receiver.clone();
    std::thread::spawn(move || {
        for message in &answers {
            if out.blocking_send(Out::Say(written(&message))).is_err() {
                break;
            }
        }
    });
    own
}

fn written(message: &Message) -> String {
    let mut value = serde_json::to_value(message).unwrap_or_default();
    value["jsonrpc"] = Value::from("2.0");
    value.to_string()
}

async fn talk(
    studio: &Arc<Studio>,
    tab: u64,
    socket: &mut WebSocket,
    out: Sender<Out>,
    mut outgoing: Receiver<Out>,
    server: &Connection,
) {
    loop {
        tokio::select! {
            told = outgoing.recv() => {
                let sent = match told {
                    Some(Out::Say(told)) => socket.send(Frame::Text(told.into())).await.is_ok(),
                    Some(Out::FilesChanged) => server.sender.send(files_changed()).is_ok(),
                    None => false,
                };
                if !sent {
                    return;
                }
            }
            frame = socket.recv() => {
                let Some(Ok(frame)) = frame else { return };
                let Frame::Text(text) = frame else { continue };
                let Ok(message) = serde_json::from_str::<Value>(&text) else {
                    let wrong = json!({ "jsonrpc": "2.0", "id": null, "error": { "code": -32700, "message": "this is no JSON" } });
                    if socket.send(Frame::Text(wrong.to_string().into())).await.is_err() {
                        return;
                    }
                    continue;
                };
                let method = message["method"].as_str().unwrap_or_default().to_string();
                if method.starts_with("studio/") {
                    let answer = answered(studio, tab, &out, method, message).await;
                    if socket.send(Frame::Text(answer.into())).await.is_err() {
                        return;
                    }
                } else if let Ok(message) = serde_json::from_value::<Message>(message)
                    && server.sender.send(message).is_err()
                {
                    return;
                }
            }
        }
    }
}

fn files_changed() -> Message {
    let none = json!({ "changes": [] });
    Message::Notification(Notification::new("workspace/didChangeWatchedFiles".to_string(), none))
}

/// The answer to a request that may wait for the disk.
async fn answered(studio: &Arc<Studio>, tab: u64, out: &Sender<Out>, method: String, message: Value) -> String {
    let (studio, out) = (Arc::clone(studio), out.clone());
    let id = message["id"].clone();
    let work = move || request::answer(&studio, tab, &out, &method, &message["params"]);
    match tokio::task::spawn_blocking(work).await {
        Ok(Ok(result)) => json!({ "jsonrpc": "2.0", "id": id, "result": result }).to_string(),
        Ok(Err(reason)) => {
            json!({ "jsonrpc": "2.0", "id": id, "error": { "code": -32803, "message": reason } }).to_string()
        }
        Err(_) => {
            json!({ "jsonrpc": "2.0", "id": id, "error": { "code": -32603, "message": "the request failed; the studio goes on" } })
                .to_string()
        }
    }
}
