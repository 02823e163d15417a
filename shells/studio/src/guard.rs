//! Who may ask: a browser on this machine that was started with the address that the program printed.
//!
//! The address has a token, drawn anew at each start; it becomes a cookie, so that it does not stay in the address. A page of another
//! site has no cookie (`SameSite=Strict`), another `Origin`, and, where it made its name point to this machine, another `Host`.
//! All three are looked at. What is answered may load nothing from elsewhere and run no script that is not a file of ours.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, Response, StatusCode, header};
use axum::middleware::Next;

use crate::asset::respond;
use crate::studio::Studio;

/// LIMIT: bytes of an address that is asked for.
const ADDRESS: usize = 2_048;

/// What a page may do; React Flow and CodeMirror set styles of elements.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; \
                      font-src 'self'; worker-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; \
                      frame-ancestors 'none'";

/// A new token: 128 bits, as 32 hexadecimal digits.
///
/// # Errors
/// The system gives no random bytes.
pub fn token() -> Result<String, String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|error| format!("the system gives no random bytes: {error}"))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Lets through who may ask.
pub async fn guard(State(studio): State<Arc<Studio>>, request: Request, next: Next) -> Response<Body> {
    let mut response = match check(&studio, &request) {
        Ok(()) => next.run(request).await,
        Err(Refused::Enter) => entered(&studio),
        Err(Refused::With(status, reason)) => {
            respond(status, "text/plain; charset=utf-8", "no-store", Body::from(reason))
        }
    };
    let headers = response.headers_mut();
    let mut set = |name: HeaderName, value: &'static str| _ = headers.insert(name, HeaderValue::from_static(value));
    set(header::CONTENT_SECURITY_POLICY, POLICY);
    set(header::X_CONTENT_TYPE_OPTIONS, "nosniff");
    set(header::REFERRER_POLICY, "no-referrer");
    set(header::X_FRAME_OPTIONS, "DENY");
    set(HeaderName::from_static("cross-origin-opener-policy"), "same-origin");
    set(HeaderName::from_static("cross-origin-resource-policy"), "same-origin");
    response
}

enum Refused {
    /// It is the address with the token: the cookie is set, and the address gets rid of it.
    Enter,
    /// A status and a sentence.
    With(StatusCode, &'static str),
}

fn check(studio: &Studio, request: &Request) -> Result<(), Refused> {
    let headers = request.headers();
    if request.uri().path_and_query().is_some_and(|address| address.as_str().len() > ADDRESS) {
        return Err(Refused::With(StatusCode::URI_TOO_LONG, "The address is too long."));
    }
    if request.method() != Method::GET && request.method() != Method::HEAD {
        return Err(Refused::With(StatusCode::METHOD_NOT_ALLOWED, "Only GET is answered."));
    }
    let host = one(headers, header::HOST).unwrap_or_default();
    if !studio.hosts.iter().any(|own| own == host) {
        return Err(Refused::With(StatusCode::FORBIDDEN, "The studio answers to the name localhost alone."));
    }
    let is_socket = headers.contains_key(header::UPGRADE);
    match (one(headers, header::ORIGIN), headers.contains_key(header::ORIGIN)) {
        (Some(origin), _) if studio.hosts.iter().any(|own| origin == format!("http://{own}")) => {}
        (None, false) if !is_socket => {}
        _ => return Err(Refused::With(StatusCode::FORBIDDEN, "Another site may not ask the studio.")),
    }
    let given = request
        .uri()
        .query()
        .into_iter()
        .flat_map(|query| query.split('&'))
        .find_map(|part| part.strip_prefix("token="));
    if let Some(given) = given
        && request.uri().path() == "/"
    {
        return match equal(given, &studio.token) {
            true => Err(Refused::Enter),
            false => Err(Refused::With(StatusCode::FORBIDDEN, REOPEN)),
        };
    }
    let name = studio.cookie();
    let cookies = headers.get_all(header::COOKIE).iter().filter_map(|value| value.to_str().ok());
    let mut own = cookies.flat_map(|line| line.split(';')).filter_map(|cookie| cookie.trim().split_once('='));
    match own.any(|(key, value)| key == name && equal(value, &studio.token)) {
        true => Ok(()),
        false => Err(Refused::With(StatusCode::FORBIDDEN, REOPEN)),
    }
}

const REOPEN: &str =
    "Open the address that `groundstate studio` printed when it was started: it has the token of this start.";

fn entered(studio: &Studio) -> Response<Body> {
    let mut response = respond(StatusCode::SEE_OTHER, "text/plain; charset=utf-8", "no-store", Body::empty());
    let cookie = format!("{}={}; HttpOnly; SameSite=Strict; Path=/", studio.cookie(), studio.token);
    // It is of letters, digits and the marks above.
    if let Ok(cookie) = HeaderValue::from_str(&cookie) {
        response.headers_mut().insert(header::SET_COOKIE, cookie);
    }
    response.headers_mut().insert(header::LOCATION, HeaderValue::from_static("/"));
    response
}

/// The value of a header that is there once.
fn one(headers: &HeaderMap, name: HeaderName) -> Option<&str> {
    let mut values = headers.get_all(name).iter();
    let value = values.next()?.to_str().ok()?;
    values.next().is_none().then_some(value)
}

/// Whether two texts are equal, in a time that does not tell where they differ.
fn equal(a: &str, b: &str) -> bool {
    a.len() == b.len() && a.bytes().zip(b.bytes()).fold(0, |found, (a, b)| found | (a ^ b)) == 0
}
