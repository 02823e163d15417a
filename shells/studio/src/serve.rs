//! The studio from its start to its end.

use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::middleware::from_fn_with_state;
use axum::routing::get;
use groundstate::text_fingerprint;
use tokio::net::TcpListener;

use crate::folder::Folder;
use crate::guard::{guard, token};
use crate::studio::Studio;
use crate::{asset, socket, watch};

/// What a studio is started with.
#[derive(Debug, Clone)]
pub struct Options {
    /// The project.
    pub folder: PathBuf,
    /// The port; 0 for the folder's own, or one that is free where that is taken.
    pub port: u16,
    /// Nothing is written.
    pub read_only: bool,
    /// This program, for jobs.
    pub program: PathBuf,
}

/// What is told when a studio answers.
#[derive(Debug, Clone)]
pub struct Started {
    /// The address to open, with the token.
    pub address: String,
    /// The folder, without links.
    pub folder: PathBuf,
}

/// How long jobs may take to end when the studio does.
const GRACE: Duration = Duration::from_secs(3);

/// How often it is looked whether the studio is to end.
const LOOK: Duration = Duration::from_millis(50);

/// Serves a folder to browsers of this machine until it is to be `stopped`.
///
/// # Errors
/// The folder or the port cannot be had; a sentence.
pub fn serve(options: &Options, started: impl FnOnce(&Started), stopped: impl Fn() -> bool) -> Result<(), String> {
    let folder = Folder::at(&options.folder)?;
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    let runtime = runtime.map_err(|error| format!("the studio cannot be started: {error}"))?;
    runtime.block_on(async {
        let cannot = |error: std::io::Error| format!("port {} of this machine cannot be had: {error}", options.port);
        let listener = listener(folder.root(), options.port).await.map_err(cannot)?;
        let port = listener.local_addr().map_err(cannot)?.port();
        let root = folder.root().to_path_buf();
        let studio = Arc::new(Studio::new(folder, token()?, port, options.read_only, options.program.clone()));
        let _watcher = watch::watch(&studio)?;
        let routes = Router::new().route("/ws", get(socket::connect)).fallback(get(asset::answer));
        let routes = routes.layer(from_fn_with_state(Arc::clone(&studio), guard)).with_state(Arc::clone(&studio));
        started(&Started { address: format!("http://127.0.0.1:{port}/?token={}", studio.token), folder: root });
        let served = axum::serve(listener, routes);
        // Open sockets end with the runtime.
        tokio::select! {
            served = served => served.map_err(|error| format!("the studio ended: {error}"))?,
            () = async { while !stopped() { tokio::time::sleep(LOOK).await } } => {}
        }
        studio.jobs.stop_all();
        let last = tokio::time::Instant::now() + GRACE;
        while !studio.jobs.is_idle() && tokio::time::Instant::now() < last {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
        Ok::<(), String>(())
    })?;
    runtime.shutdown_background();
    Ok(())
}

/// Ports of folders: below those that systems give to anybody.
const OWN_PORTS: std::ops::Range<u64> = 20_000..30_000;

/// The port of a folder. It is the same at each start, so that a page that was left open finds the studio again.
fn own_port(root: &Path) -> u16 {
    let number = u64::from_str_radix(&text_fingerprint(&root.to_string_lossy()), 16).unwrap_or_default();
    (OWN_PORTS.start + number % (OWN_PORTS.end - OWN_PORTS.start)) as u16
}

async fn listener(root: &Path, port: u16) -> std::io::Result<TcpListener> {
    let at = |port: u16| TcpListener::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)));
    match port {
        0 => match at(own_port(root)).await {
            Ok(listener) => Ok(listener),
            Err(_) => at(0).await,
        },
        port => at(port).await,
    }
}
