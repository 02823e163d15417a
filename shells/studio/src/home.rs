//! Where the C++ of a chart or a model lies: a folder beside it.
//!
//! In: the path of a chart or a model. Out: the folder in which it is generated, built and shown. A chart's program may be a project of
//! the user's own: a folder beside the chart whose CMakeLists.txt names the chart. Everything else is in `STEM.generated`. INVARIANT: a
//! folder that is a link is no project; which of two is meant is not guessed. LIMIT: folders that are looked into.

use std::path::Path;

use groundstate::Kind;

use crate::folder::Folder;

/// LIMIT: folders beside a chart that are looked into.
const FOLDERS: usize = 200;

/// See the module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Home {
    /// The folder, as browsers name it.
    pub path: String,
    /// Whether the user arranged it: then `generated/` is all that is written there.
    pub is_own: bool,
}

impl Home {
    /// The folder of a chart or a model.
    ///
    /// # Errors
    /// It is neither, or there are two such folders; a sentence.
    pub fn of(folder: &Folder, path: &str) -> Result<Home, String> {
        let kind = Kind::of(Path::new(path));
        let (Some(Kind::Chart | Kind::Model), Some((stem, _))) = (kind, path.rsplit_once('.')) else {
            return Err(format!("`{}` is neither a chart nor a model", path.escape_debug()));
        };
        let own = if kind == Some(Kind::Chart) { projects(folder, path)? } else { Vec::new() };
        match own.as_slice() {
            [] => Ok(Home { path: format!("{stem}.generated"), is_own: false }),
            [only] => Ok(Home { path: only.clone(), is_own: true }),
            [one, other, ..] => Err(format!(
                "{one} and {other} have both a CMakeLists.txt that names {path}: let one of them name it, as its program"
            )),
        }
    }

    /// The words with which `generate cpp` writes there.
    pub fn words(&self) -> Vec<String> {
        let mut words = vec!["-o".to_string(), format!("./{}", self.path)];
        words.extend(self.is_own.then(|| "--only-generated".to_string()));
        words
    }
}

/// The folders beside a chart whose CMakeLists.txt names it, but for those of generated C++.
fn projects(folder: &Folder, path: &str) -> Result<Vec<String>, String> {
    let (beside, name) = path.rsplit_once('/').map_or(("", path), |(beside, name)| (beside, name));
    let place = if beside.is_empty() { folder.root().to_path_buf() } else { folder.place(beside)? };
    // A folder that cannot be read has none.
    let entries = std::fs::read_dir(place).into_iter().flatten().flatten();
    let folders = entries.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()));
    let mut folders: Vec<String> = folders.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    folders.retain(|own| !own.ends_with(".generated") && !own.starts_with('.'));
    folders.sort();
    folders.truncate(FOLDERS);
    let paths = folders.iter().map(|own| if beside.is_empty() { own.clone() } else { format!("{beside}/{own}") });
    let named = |own: &String| {
        let text = folder.read(&format!("{own}/CMakeLists.txt")).ok().flatten();
        text.is_some_and(|text| names(&text, name))
    };
    Ok(paths.filter(named).collect())
}

/// Whether a text has a file's name, and not as a part of a longer one.
fn names(text: &str, name: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    text.match_indices(name).any(|(at, _)| {
        let (before, after) = (&text[..at], &text[at + name.len()..]);
        !before.ends_with(|c: char| is_part(c) || c == '.') && !after.starts_with(is_part)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn home(files: &[(&str, &str)], path: &str) -> Result<String, String> {
        let place = tempfile::tempdir().expect("a folder");
        for (name, text) in files {
            let file = place.path().join(name);
            std::fs::create_dir_all(file.parent().expect("it has one")).expect("made");
            std::fs::write(file, text).expect("written");
        }
        let folder = Folder::at(place.path()).expect("it is there");
        Home::of(&folder, path).map(|home| home.words().join(" "))
    }

    #[test]
    fn a_program_is_the_project_beside_the_chart_that_names_it() {
        let arm = ("cell/arm/CMakeLists.txt", "# The arm of Cell.chart.\nproject(arm)\n");
        let of = |files: &[(&str, &str)]| home(files, "cell/Cell.chart");
        assert_eq!(of(&[]), Ok("-o ./cell/Cell.generated".to_string()));
        assert_eq!(of(&[arm]), Ok("-o ./cell/arm --only-generated".to_string()));
        assert_eq!(
            home(&[("arm/CMakeLists.txt", "../A.chart")], "A.chart"),
            Ok("-o ./arm --only-generated".to_string())
        );
        // A model's class is no program, and what was generated is no project of one's own.
        assert_eq!(home(&[arm], "cell/Cell.asm"), Ok("-o ./cell/Cell.generated".to_string()));
        let generated = ("cell/Cell.generated/CMakeLists.txt", "# The program of Cell.chart.");
        assert_eq!(of(&[generated]), Ok("-o ./cell/Cell.generated".to_string()));
        assert_eq!(of(&[generated, arm]), Ok("-o ./cell/arm --only-generated".to_string()));
        // Deeper, elsewhere, or of another chart.
        assert_eq!(of(&[("cell/a/b/CMakeLists.txt", "Cell.chart")]), Ok("-o ./cell/Cell.generated".to_string()));
        assert_eq!(of(&[("other/CMakeLists.txt", "Cell.chart")]), Ok("-o ./cell/Cell.generated".to_string()));
        for other in ["MyCell.chart", "My_Cell.chart", "My.Cell.chart", "Cell.charts", "Cell.chart_2", "cell.chart", ""]
        {
            assert_eq!(of(&[("cell/a/CMakeLists.txt", other)]), Ok("-o ./cell/Cell.generated".to_string()), "{other}");
        }
        let two = of(&[arm, ("cell/bench/CMakeLists.txt", "Cell.chart")]);
        assert!(two.as_ref().is_err_and(|told| told.starts_with("cell/arm and cell/bench have both")), "{two:?}");
        assert!(home(&[], "cell/Cell.avalla").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_no_project() {
        let place = tempfile::tempdir().expect("a folder");
        let (inside, outside) = (place.path().join("project"), place.path().join("outside"));
        for made in [&inside, &outside, &inside.join("bench")] {
            std::fs::create_dir_all(made).expect("made");
        }
        std::fs::write(outside.join("CMakeLists.txt"), "Cell.chart").expect("written");
        std::os::unix::fs::symlink(&outside, inside.join("arm")).expect("linked");
        std::os::unix::fs::symlink(outside.join("CMakeLists.txt"), inside.join("bench/CMakeLists.txt"))
            .expect("linked");
        let folder = Folder::at(&inside).expect("it is there");
        assert_eq!(Home::of(&folder, "Cell.chart").map(|home| home.path), Ok("Cell.generated".to_string()));
    }
}
