//! The built-in pattern library: `import patterns/ControlTask` works wherever the model lies.
//!
//! In: the path of an import that no file matches, or that stands in a module of the library. Out: the text, under the
//! name `<patterns>/ControlTask.asm`, which shows its origin. A file at the path wins: a loader asks here last.

use syntax::SourceFile;

/// The folder in the user's imports, and the prefix of the library's own file names.
const FOLDER: &str = "patterns/";
const HOME: &str = "<patterns>/";

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../../library/patterns/", $name)))),*]
    };
}

/// The name and text of each file.
const FILES: [(&str, &str); 12] = files![
    "Consumer.asm",
    "ControlTask.asm",
    "DataProducer.chart",
    "MessageQueue.asm",
    "PatternMachines.asm",
    "PatternMachines.chart",
    "Producer.asm",
    "Scheduler.asm",
    "Semaphore.asm",
    "SharedValue.asm",
    "SwingingBuffer.asm",
    "Task.asm",
];

/// Whether a file belongs to the library. Its imports are then looked up only in the library.
pub fn is_pattern(name: &str) -> bool {
    name.starts_with(HOME)
}

/// The library file that an import in `importer` names, if any.
pub fn pattern(importer: &str, path: &str) -> Option<SourceFile> {
    let path = path.strip_prefix("./").unwrap_or(path);
    let name = if is_pattern(importer) { path } else { path.strip_prefix(FOLDER)? };
    let is = |known: &str| known == name || known.strip_suffix(".asm") == Some(name);
    let (name, text) = FILES.iter().find(|(known, _)| is(known))?;
    Some(SourceFile::new(format!("{HOME}{name}"), *text))
}

/// The modules of the library, as imports name them.
pub fn modules() -> impl Iterator<Item = String> {
    FILES.iter().filter_map(|(name, _)| Some(format!("{FOLDER}{}", name.strip_suffix(".asm")?)))
}

/// The built-in module that a failed import may have meant.
pub fn meant(path: &str) -> Option<String> {
    let at = path.rfind(FOLDER)?;
    let before = path[..at].chars().next_back();
    let import = path[at..].strip_suffix(".asm").unwrap_or(&path[at..]);
    (before == Some('/') && pattern("", import).is_some()).then(|| import.to_string())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::disallowed_methods, reason = "the test compares the table with the folder")]
    use super::*;

    #[test]
    fn a_module_is_found_by_its_path() {
        let name = |importer, path| pattern(importer, path).map(|file| file.name);
        assert_eq!(name("Cell.asm", "patterns/ControlTask"), Some("<patterns>/ControlTask.asm".to_string()));
        assert_eq!(name("a/Cell.asm", "./patterns/Task.asm"), Some("<patterns>/Task.asm".to_string()));
        assert_eq!(
            name("Cell.chart", "patterns/PatternMachines.chart"),
            Some("<patterns>/PatternMachines.chart".into())
        );
        assert_eq!(name("<patterns>/ControlTask.asm", "Task"), Some("<patterns>/Task.asm".to_string()));
        for (importer, path) in [("Cell.asm", "Task"), ("Cell.asm", "patterns/Tusk"), ("Cell.asm", "../patterns/Task")]
        {
            assert_eq!(name(importer, path), None, "{path}");
        }
        assert_eq!(meant("../../library/patterns/Task.asm"), Some("patterns/Task".to_string()));
        assert_eq!((meant("mypatterns/Task"), meant("../patterns/Tusk")), (None, None));
    }

    #[test]
    fn the_whole_folder_is_built_in() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../library/patterns");
        let mut there: Vec<String> = std::fs::read_dir(folder)
            .expect("the folder")
            .map(|entry| entry.expect("an entry").file_name().into_string().expect("a name"))
            .filter(|name| name.ends_with(".asm") || name.ends_with(".chart"))
            .collect();
        there.sort();
        assert_eq!(there, FILES.map(|(name, _)| name));
    }
}
