//! The front end, as the browser gets it: the files that `make web` makes, embedded in the program.
//!
//! A program that was built without them says how they are made.

use axum::body::Body;
use axum::http::{Response, StatusCode, Uri, header};
use rust_embed::RustEmbed;

/// The files, by their paths.
#[derive(RustEmbed)]
#[folder = "../../web/dist"]
#[allow_missing = true]
pub struct Front;

/// Shown where there is no front end.
const NOT_BUILT: &str = "<!doctype html><meta charset=utf-8><title>Groundstate studio</title><p>This program was built without the \
                         studio's pages. In a clone of the project, <code>make studio</code> makes them and starts it.";

/// The file at a path; the page itself at `/`.
pub async fn answer(uri: Uri) -> Response<Body> {
    let path = match uri.path().trim_start_matches('/') {
        "" => "index.html",
        path => path,
    };
    match Front::get(path) {
        // Names of built files have a hash of what is in them.
        Some(file) => {
            let age = if path.starts_with("assets/") { "public, max-age=31536000, immutable" } else { "no-store" };
            respond(StatusCode::OK, kind(path), age, Body::from(file.data.into_owned()))
        }
        None if path == "index.html" => {
            respond(StatusCode::OK, "text/html; charset=utf-8", "no-store", NOT_BUILT.into())
        }
        None => {
            respond(StatusCode::NOT_FOUND, "text/plain; charset=utf-8", "no-store", "There is no such page.".into())
        }
    }
}

/// A response of this kind.
pub fn respond(status: StatusCode, kind: &'static str, age: &'static str, body: Body) -> Response<Body> {
    let mut response = Response::new(body);
    *response.status_mut() = status;
    response.headers_mut().insert(header::CONTENT_TYPE, header::HeaderValue::from_static(kind));
    response.headers_mut().insert(header::CACHE_CONTROL, header::HeaderValue::from_static(age));
    response
}

fn kind(path: &str) -> &'static str {
    match path.rsplit('.').next().unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "ico" => "image/x-icon",
        "woff2" => "font/woff2",
        "json" | "map" | "webmanifest" => "application/json",
        _ => "application/octet-stream",
    }
}
