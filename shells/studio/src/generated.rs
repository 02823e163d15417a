//! The C++ beside a chart or a model: its files, which lines stand for which places, and whether it was made from the texts as they are.
//!
//! In: the path of a chart or a model; the name of a file in the folder of its C++. Out: a list with the source map, or a text; nothing is
//! written. INVARIANT: nothing outside that folder is read, also through links; C++ is only called current if every text that it was
//! made from is known and the same. LIMIT: files, and folders in folders.

use std::path::{Path, PathBuf};

use groundstate::{Kind, text_fingerprint};
use serde_json::{Value, json};

use crate::folder::Folder;
use crate::home::Home;

/// LIMIT: files that are listed.
const FILES: usize = 400;
/// LIMIT: folders in folders.
const DEEP: usize = 4;
/// What CMake builds, and what every program includes.
const NOT_SHOWN: [&str; 3] = ["build", "runtime", "generated/include"];

fn is_shown(name: &str) -> bool {
    let inside = |folder: &str| name == folder || name.starts_with(&format!("{folder}/"));
    let last = name.rsplit('/').next().unwrap_or(name);
    let is_code = [".hpp", ".cpp", ".h"].iter().any(|ending| last.ends_with(ending)) || last == "CMakeLists.txt";
    is_code && !NOT_SHOWN.iter().any(|folder| inside(folder))
}

/// Whether C++ and what is built of it may be written: no link of its folder leads out of the project.
///
/// # Errors
/// One does; a sentence.
pub fn may_be_written(folder: &Folder, home: &Home) -> Result<(), String> {
    let home = &home.path;
    let parts = ["", "/generated", "/generated/machines", "/generated/include", "/runtime", "/build"];
    parts.iter().try_for_each(|part| folder.place(&format!("{home}{part}")).map(|_| ()))
}

/// The text of one of its files.
///
/// # Errors
/// There is no such file; a sentence.
pub fn text(folder: &Folder, path: &str, file: &str) -> Result<Value, String> {
    let home = Home::of(folder, path)?.path;
    let refused = || format!("`{}` is no generated file of {path}", file.escape_debug());
    if !is_shown(file) {
        return Err(refused());
    }
    let name = format!("{home}/{file}");
    let (place, home) = (folder.place(&name).map_err(|_| refused())?, folder.place(&home)?);
    // A link in it may lead elsewhere in the project.
    let real = |path: &Path| std::fs::canonicalize(path).map_err(|_| refused());
    let is_real = std::fs::symlink_metadata(&home).is_ok_and(|home| home.is_dir());
    if !is_real || !real(&place)?.starts_with(real(&home)?) {
        return Err(refused());
    }
    let text = folder.read(&name)?.ok_or_else(refused)?;
    Ok(json!({ "text": text }))
}

/// Its files, their lines and whether they are current.
///
/// # Errors
/// The path is none of a chart or a model in the folder; a sentence.
pub fn list(folder: &Folder, path: &str) -> Result<Value, String> {
    let home = Home::of(folder, path)?.path;
    let place = folder.place(&home)?;
    let mut found = Vec::new();
    // What a link leads to is not this folder.
    if std::fs::symlink_metadata(&place).is_ok_and(|home| home.is_dir()) {
        walk(&place, "", DEEP, &mut found);
    }
    found.sort();
    let (maps, files): (Vec<String>, Vec<String>) = found.into_iter().partition(|name| name.ends_with("-map.json"));
    let mut lines = Vec::new();
    let mut texts = Texts::default();
    for map in &maps {
        let base = map.rsplit_once('/').map_or("", |(base, _)| base);
        let Ok(Some(text)) = folder.read(&format!("{home}/{map}")) else {
            texts.unknown = true;
            continue;
        };
        let Ok(map) = serde_json::from_str::<Value>(&text) else {
            texts.unknown = true;
            continue;
        };
        let own = |name: &str| if base.is_empty() { name.to_string() } else { format!("{base}/{name}") };
        let models = |value: &Value| within(&own_path(&home, base), value.as_str()?);
        for line in map["lines"].as_array().into_iter().flatten() {
            let (Some(file), Some(model)) = (line["generated"]["file"].as_str(), models(&line["model"]["file"])) else {
                continue;
            };
            let number = |key: &str| line["model"][key].as_u64().unwrap_or(1);
            lines.push(json!({
                "file": own(file),
                "line": line["generated"]["line"],
                "model": model,
                "at": [number("line"), number("column"), number("end_line"), number("end_column")],
            }));
        }
        texts.compare(folder, &map["texts"], models);
    }
    let files: Vec<String> = files.into_iter().filter(|name| is_shown(name)).collect();
    let state = match (files.is_empty(), texts.changed.is_empty(), texts.unknown || maps.is_empty()) {
        (true, _, _) => "none",
        (false, false, _) => "older",
        (false, true, true) => "unknown",
        (false, true, false) => "current",
    };
    texts.changed.sort();
    texts.changed.dedup();
    Ok(json!({ "folder": home, "files": files, "lines": lines, "state": state, "changed": texts.changed }))
}

fn own_path(home: &str, base: &str) -> String {
    if base.is_empty() { home.to_string() } else { format!("{home}/{base}") }
}

/// A path relative to a folder of the project, as browsers name it; none if it leads out of the project.
fn within(base: &str, name: &str) -> Option<String> {
    let mut parts: Vec<&str> = base.split('/').collect();
    if name.starts_with(['/', '<']) || name.contains('\\') {
        return None;
    }
    for part in name.split('/') {
        match part {
            ".." => _ = parts.pop()?,
            "." | "" => {}
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

/// What became of the texts that C++ was made from.
#[derive(Debug, Default)]
struct Texts {
    changed: Vec<String>,
    /// Not all of them are known.
    unknown: bool,
}

impl Texts {
    fn compare(&mut self, folder: &Folder, texts: &Value, path: impl Fn(&Value) -> Option<String>) {
        let Some(texts) = texts.as_array().filter(|texts| !texts.is_empty()) else {
            self.unknown = true;
            return;
        };
        for text in texts {
            let (Some(path), Some(known)) = (path(&text["file"]), text["fingerprint"].as_str()) else {
                self.unknown = true;
                continue;
            };
            match Kind::of(Path::new(&path)).map(|_| folder.read(&path)) {
                Some(Ok(Some(now))) if text_fingerprint(&now) == known => {}
                Some(Ok(_)) => self.changed.push(path),
                None | Some(Err(_)) => self.unknown = true,
            }
        }
    }
}

/// The files of a folder, without following links.
fn walk(place: &PathBuf, name: &str, deep: usize, found: &mut Vec<String>) {
    let Ok(entries) = std::fs::read_dir(place) else { return };
    for entry in entries.flatten() {
        let Ok(kind) = entry.file_type() else { continue };
        let Some(own) = entry.file_name().to_str().map(str::to_string) else { continue };
        let whole = if name.is_empty() { own } else { format!("{name}/{own}") };
        if found.len() >= FILES || NOT_SHOWN.contains(&whole.as_str()) {
            continue;
        }
        if kind.is_dir() && deep > 0 {
            walk(&entry.path(), &whole, deep - 1, found);
        } else if kind.is_file() && (is_shown(&whole) || whole.ends_with("-map.json")) {
            found.push(whole);
        }
    }
}
