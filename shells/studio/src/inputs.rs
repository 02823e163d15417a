//! Files beside a model: inputs with their texts, scenarios.
//!
//! In: the path of a model, or of a file of inputs. Out: names, or a text; nothing is written. LIMIT: files of inputs that are listed.

use std::path::Path;

use groundstate::Kind;
use serde_json::{Value, json};

use crate::folder::Folder;

/// LIMIT: files of inputs that are listed.
const FILES: usize = 200;

/// YAML or CSV that is nothing else of the project.
fn is_input(name: &str) -> bool {
    let ending = Path::new(name).extension().and_then(|ending| ending.to_str());
    matches!(ending, Some("yaml" | "yml" | "csv")) && Kind::of(Path::new(name)).is_none()
}

/// The files of inputs in the folder of a model.
///
/// # Errors
/// It is no model of the folder; a sentence.
pub fn list(folder: &Folder, model: &str) -> Result<Value, String> {
    let mut files = beside(folder, model, is_input)?;
    files.truncate(FILES);
    Ok(json!({ "files": files }))
}

/// The scenarios in the folder of a model, all of them: whoever plays them says that they passed.
///
/// # Errors
/// It is no model of the folder; a sentence.
pub fn scenarios(folder: &Folder, model: &str) -> Result<Vec<String>, String> {
    beside(folder, model, |name| Kind::of(Path::new(name)) == Some(Kind::Scenario))
}

fn beside(folder: &Folder, model: &str, wanted: impl Fn(&str) -> bool) -> Result<Vec<String>, String> {
    if Kind::of(Path::new(model)) != Some(Kind::Model) {
        return Err(format!("`{}` is no model", model.escape_debug()));
    }
    folder.place(model)?;
    let home = model.rsplit_once('/').map_or("", |(home, _)| home);
    let place = if home.is_empty() { folder.root().to_path_buf() } else { folder.place(home)? };
    let entries = std::fs::read_dir(&place).into_iter().flatten().flatten();
    let names = entries.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_file()));
    let names = names.filter_map(|entry| entry.file_name().to_str().map(str::to_string));
    let path = |name: String| if home.is_empty() { name } else { format!("{home}/{name}") };
    let mut found: Vec<String> = names.filter(|name| wanted(name) && !name.starts_with('.')).map(path).collect();
    found.sort();
    Ok(found)
}

/// The text of one.
///
/// # Errors
/// It is none, or cannot be read; a sentence.
pub fn text(folder: &Folder, file: &str) -> Result<Value, String> {
    if !is_input(file) {
        return Err(format!("`{}` is no file of inputs", file.escape_debug()));
    }
    let text = folder.read(file)?.ok_or_else(|| format!("there is no {file}"))?;
    Ok(json!({ "text": text }))
}
