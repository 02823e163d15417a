//! The built-in libraries: `import patterns/ControlTask` works wherever the model lies, and so does
//! `import verification/SystemInTicks`.
//!
//! In: the path of an import that no file matches, or that stands in a module of a library. Out: the text, under a name such as
//! `<patterns>/ControlTask.asm`, which shows its origin. A file at the path wins: a loader asks here last.

use syntax::SourceFile;

/// A folder of modules.
struct Library {
    /// In the user's imports.
    folder: &'static str,
    /// The prefix of its own files' names.
    home: &'static str,
    /// The name and text of each file.
    files: &'static [(&'static str, &'static str)],
}

macro_rules! files {
    ($folder:literal: $($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../../library/", $folder, "/", $name)))),*]
    };
}

/// The machines of the paper.
const PATTERNS: Library = Library {
    folder: "patterns/",
    home: "<patterns>/",
    files: files![
        "patterns":
        "Consumer.asm",
        "ControlTask.asm",
        "DataAges.asm",
        "DataProducer.chart",
        "FreshReadings.asm",
        "MessageQueue.asm",
        "MissedDeadlines.asm",
        "PatternMachines.asm",
        "PatternMachines.chart",
        "Producer.asm",
        "ReleaseJitter.asm",
        "Scheduler.asm",
        "Semaphore.asm",
        "SharedValue.asm",
        "SwingingBuffer.asm",
        "Task.asm",
        "VaryingTimes.asm",
    ],
};

/// What systems of these machines have to keep, and how their states become finitely many.
const VERIFICATION: Library = Library {
    folder: "verification/",
    home: "<verification>/",
    files: files![
        "verification":
        "AgesInTicks.asm",
        "FreshInTicks.asm",
        "MissedInTicks.asm",
        "Quotient.asm",
        "SystemInTicks.asm",
        "SystemProperties.asm",
    ],
};

const LIBRARIES: [Library; 2] = [PATTERNS, VERIFICATION];

fn home_of(name: &str) -> Option<&'static Library> {
    const ALL: &[Library] = &LIBRARIES;
    ALL.iter().find(|library| name.starts_with(library.home))
}

/// Whether a file belongs to a built-in library. Its imports are then looked up only there.
pub fn is_pattern(name: &str) -> bool {
    home_of(name).is_some()
}

/// The library file that an import in `importer` names, if any.
pub fn pattern(importer: &str, path: &str) -> Option<SourceFile> {
    let path = path.strip_prefix("./").unwrap_or(path);
    let in_folder = |path: &str| {
        LIBRARIES
            .iter()
            .find_map(|library| Some((library.home, library.files, path.strip_prefix(library.folder)?.to_string())))
    };
    let (home, files, name) = match home_of(importer) {
        Some(library) => match path.strip_prefix("../") {
            Some(path) => in_folder(path)?,
            None => (library.home, library.files, path.to_string()),
        },
        None => in_folder(path)?,
    };
    let is = |known: &str| known == name || known.strip_suffix(".asm") == Some(name.as_str());
    let (name, text) = files.iter().find(|(known, _)| is(known))?;
    Some(SourceFile::new(format!("{home}{name}"), *text))
}

/// The modules of the pattern library, as imports name them.
pub fn modules() -> impl Iterator<Item = String> {
    PATTERNS.files.iter().filter_map(|(name, _)| Some(format!("{}{}", PATTERNS.folder, name.strip_suffix(".asm")?)))
}

/// The names of all files, as faults and places give them.
pub fn names() -> impl Iterator<Item = String> {
    LIBRARIES.iter().flat_map(|library| library.files.iter().map(|(name, _)| format!("{}{name}", library.home)))
}

/// The built-in module that a failed import may have meant.
pub fn meant(path: &str) -> Option<String> {
    LIBRARIES.iter().find_map(|library| {
        let at = path.rfind(library.folder)?;
        let before = path[..at].chars().next_back();
        let import = path[at..].strip_suffix(".asm").unwrap_or(&path[at..]);
        (before == Some('/') && pattern("", import).is_some()).then(|| import.to_string())
    })
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
        assert_eq!(
            name("<verification>/Quotient.asm", "../patterns/ControlTask"),
            Some("<patterns>/ControlTask.asm".into())
        );
        assert_eq!(name("Cell.asm", "verification/Quotient"), Some("<verification>/Quotient.asm".into()));
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
        assert_eq!(there, PATTERNS.files.iter().map(|(name, _)| (*name).to_string()).collect::<Vec<_>>());
    }
}
