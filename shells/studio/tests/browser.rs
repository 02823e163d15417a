//! A studio over a folder of its own, and the browser's end of it.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::thread::JoinHandle;
use std::time::Duration;

use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// A studio that runs until it is dropped.
pub struct Running {
    place: Option<tempfile::TempDir>,
    pub port: u16,
    pub token: String,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Running {
    /// Starts one over a folder `project` with these files.
    pub fn over(files: &[(&str, &str)]) -> Running {
        Running::with(files, false, Path::new("/bin/false"))
    }

    /// The same, with a program for jobs.
    pub fn with(files: &[(&str, &str)], read_only: bool, program: &Path) -> Running {
        let place = tempfile::tempdir().expect("a folder");
        let folder = place.path().join("project");
        std::fs::create_dir(&folder).expect("made");
        for (name, text) in files {
            let path = folder.join(name);
            std::fs::create_dir_all(path.parent().expect("it has one")).expect("made");
            std::fs::write(path, text).expect("written");
        }
        Running::at(place, read_only, program)
    }

    /// Starts one over the folder `project` in a place.
    fn at(place: tempfile::TempDir, read_only: bool, program: &Path) -> Running {
        let folder = place.path().join("project");
        let stop = Arc::new(AtomicBool::new(false));
        let options = studio::Options { folder, port: 0, read_only, program: program.to_path_buf() };
        let (told, started) = channel();
        let stopped = Arc::clone(&stop);
        let thread = std::thread::spawn(move || {
            let tell = |started: &studio::Started| _ = told.send(started.address.clone());
            studio::serve(&options, tell, || stopped.load(Ordering::Relaxed)).expect("it serves");
        });
        let address = started.recv_timeout(Duration::from_secs(20)).expect("it starts");
        let (host, token) = address.split_once("/?token=").expect("an address with a token");
        let port = host.rsplit(':').next().and_then(|port| port.parse().ok()).expect("a port");
        Running { place: Some(place), port, token: token.to_string(), stop, thread: Some(thread) }
    }

    /// Stops it, and starts another one over the same folder.
    pub fn again(mut self) -> Running {
        let place = self.place.take().expect("it has one until it is dropped");
        drop(self);
        Running::at(place, false, Path::new("/bin/false"))
    }

    pub fn folder(&self) -> PathBuf {
        self.place().join("project")
    }

    /// Where the folder lies, and what else tests put beside it.
    pub fn place(&self) -> &Path {
        self.place.as_ref().expect("it has one until it is dropped").path()
    }

    pub fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.folder().join(name)).expect("it is there")
    }

    pub fn cookie(&self) -> String {
        format!("groundstate-{}={}", self.port, self.token)
    }

    pub fn uri(&self, name: &str) -> String {
        let folder = std::fs::canonicalize(self.folder()).expect("it is there");
        format!("file://{}/{name}", folder.display())
    }

    /// What is answered to bytes that were written by hand.
    pub fn raw(&self, request: &str) -> String {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("connected");
        stream.set_read_timeout(Some(Duration::from_secs(10))).expect("set");
        // A server may answer and close before all is written.
        _ = stream.write_all(request.as_bytes());
        let mut answer = Vec::new();
        _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    /// The answer to a GET with these headers.
    pub fn get(&self, path: &str, headers: &[(&str, &str)]) -> String {
        let own = format!("127.0.0.1:{}", self.port);
        let host =
            if headers.iter().any(|(name, _)| *name == "Host") { String::new() } else { format!("Host: {own}\r\n") };
        let headers: String = headers.iter().map(|(name, value)| format!("{name}: {value}\r\n")).collect();
        self.raw(&format!("GET {path} HTTP/1.1\r\n{host}{headers}Connection: close\r\n\r\n"))
    }

    /// A tab.
    pub fn tab(&self) -> Tab {
        self.tab_from(&format!("http://127.0.0.1:{}", self.port), &self.cookie()).expect("let in")
    }

    /// A tab of a page from elsewhere.
    pub fn tab_from(&self, origin: &str, cookie: &str) -> Result<Tab, String> {
        let mut request = format!("ws://127.0.0.1:{}/ws", self.port).into_client_request().expect("a request");
        if !origin.is_empty() {
            request.headers_mut().insert("Origin", origin.parse().expect("a value"));
        }
        request.headers_mut().insert("Cookie", cookie.parse().expect("a value"));
        let stream = TcpStream::connect(("127.0.0.1", self.port)).expect("connected");
        stream.set_read_timeout(Some(Duration::from_secs(20))).expect("set");
        let (socket, _) = tungstenite::client(request, stream).map_err(|error| error.to_string())?;
        Ok(Tab { socket, last: 0, heard: Vec::new() })
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            _ = thread.join();
        }
    }
}

/// A tab of the browser.
pub struct Tab {
    socket: WebSocket<TcpStream>,
    last: u64,
    /// Notifications that nobody has asked for yet.
    heard: Vec<Value>,
}

impl Tab {
    pub fn send(&mut self, text: String) -> bool {
        self.socket.send(Message::text(text)).is_ok()
    }

    /// The next message; none if the socket is closed.
    pub fn next(&mut self) -> Option<Value> {
        loop {
            match self.socket.read() {
                Ok(Message::Text(text)) => return serde_json::from_str(&text).ok(),
                Ok(Message::Close(_)) | Err(_) => return None,
                Ok(_) => {}
            }
        }
    }

    /// The result of a request, or what refuses it.
    pub fn ask(&mut self, method: &str, params: Value) -> Result<Value, String> {
        self.last += 1;
        let id = self.last;
        self.send(json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }).to_string());
        loop {
            let message = self.next().unwrap_or_else(|| panic!("{method} is answered"));
            if message["id"] == id && message.get("method").is_none() {
                return match message.get("error") {
                    Some(error) => Err(error["message"].as_str().unwrap_or_default().to_string()),
                    None => Ok(message["result"].clone()),
                };
            }
            self.heard.push(message);
        }
    }

    pub fn tell(&mut self, method: &str, params: Value) {
        self.send(json!({ "jsonrpc": "2.0", "method": method, "params": params }).to_string());
    }

    /// Waits for a notification.
    pub fn hear(&mut self, method: &str, wanted: impl Fn(&Value) -> bool) -> Value {
        let fits = |message: &Value| message["method"] == method && wanted(&message["params"]);
        if let Some(at) = self.heard.iter().position(fits) {
            return self.heard.remove(at)["params"].clone();
        }
        loop {
            let message = self.next().unwrap_or_else(|| panic!("{method} comes"));
            if fits(&message) {
                return message["params"].clone();
            }
            self.heard.push(message);
        }
    }

    /// Begins to speak with the language server.
    pub fn initialize(&mut self, running: &Running) {
        let root = running.uri("");
        let params = json!({ "processId": null, "rootUri": root.trim_end_matches('/'), "capabilities": {} });
        self.ask("initialize", params).expect("it begins");
        self.tell("initialized", json!({}));
    }
}
