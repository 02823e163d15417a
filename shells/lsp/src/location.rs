//! Paths as the protocol writes them, and files of libraries that are built in.
//!
//! In: a `file:` URI. Out: an absolute path, and back. A library is no file: where an editor is to show one, its text is written
//! to the user's cache, and a URI there is the library again.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use groundstate::workspace::tidy;
use lsp_types::Uri;

/// The path of a `file:` URI; the library's name for a file of the cache.
pub fn path_of(uri: &Uri) -> Option<String> {
    let rest = uri.as_str().strip_prefix("file://")?;
    // A host stands between the slashes, if anything does.
    let path = &rest[rest.find('/')?..];
    let path = decoded(path)?;
    let path = match path.as_bytes() {
        // `/c:/models` is how Windows' drives are written.
        [b'/', drive, b':', ..] if drive.is_ascii_alphabetic() => path[1..].to_string(),
        _ => path,
    };
    let path = tidy(&path);
    Some(library_name(&path).unwrap_or(path))
}

/// The URI of a path or of a built-in library.
pub fn uri_of(path: &str) -> Option<Uri> {
    let path = match ide::library_text(path) {
        Some(library) => cached(&library.name, &library.text)?.to_string_lossy().into_owned(),
        None => path.to_string(),
    };
    let absolute = std::path::absolute(&path).ok()?.to_string_lossy().replace('\\', "/");
    let absolute = if absolute.starts_with('/') { absolute } else { format!("/{absolute}") };
    Uri::from_str(&format!("file://{}", encoded(&absolute))).ok()
}

fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let mut digit = || (rest.next()? as char).to_digit(16);
        bytes.push((digit()? * 16 + digit()?) as u8);
    }
    String::from_utf8(bytes).ok()
}

fn encoded(path: &str) -> String {
    let mut text = String::with_capacity(path.len());
    for byte in path.bytes() {
        if byte.is_ascii_alphanumeric() || b"/-._~:".contains(&byte) {
            text.push(byte as char);
        } else {
            text.push_str(&format!("%{byte:02X}"));
        }
    }
    text
}

/// The folder in which libraries are shown.
fn cache() -> Option<PathBuf> {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let base = set("XDG_CACHE_HOME").or_else(|| set("LOCALAPPDATA")).or_else(|| Some(set("HOME")?.join(".cache")))?;
    base.is_absolute().then(|| base.join("groundstate/library"))
}

/// Writes a library into the cache, if it is not there as it is.
fn cached(name: &str, text: &str) -> Option<PathBuf> {
    let (folder, file) = name.strip_prefix('<')?.split_once(">/")?;
    let path = cache()?.join(folder).join(file);
    if std::fs::read_to_string(&path).is_ok_and(|present| present == text) {
        return Some(path);
    }
    std::fs::create_dir_all(path.parent()?).ok()?;
    // A copy that is being read stays whole.
    let fresh = path.with_extension(format!("{}.tmp", std::process::id()));
    std::fs::write(&fresh, text).ok()?;
    std::fs::rename(&fresh, &path).ok()?;
    Some(path)
}

fn library_name(path: &str) -> Option<String> {
    let rest = Path::new(path).strip_prefix(cache()?).ok()?.to_str()?.replace('\\', "/");
    let (folder, file) = rest.split_once('/')?;
    let name = format!("<{folder}>/{file}");
    ide::library_text(&name).map(|library| library.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uris_are_paths() {
        let check = |uri: &str, path: &str| {
            let uri = Uri::from_str(uri).expect("a URI");
            assert_eq!(path_of(&uri).as_deref(), Some(path), "{uri:?}");
        };
        check("file:///a/b.asm", "/a/b.asm");
        check("file:///a%20b/%C3%A4.asm", "/a b/ä.asm");
        check("file://localhost/a/../b.asm", "/b.asm");
        check("file:///c%3A/a.asm", "c:/a.asm");
        assert_eq!(path_of(&Uri::from_str("untitled:a").expect("a URI")), None);
        let uri = uri_of("/a b/ä#?.asm").expect("a URI");
        assert_eq!(uri.as_str(), "file:///a%20b/%C3%A4%23%3F.asm");
        assert_eq!(path_of(&uri).as_deref(), Some("/a b/ä#?.asm"));
    }
}
