//! The pictures in docs/charts/ are those of the charts of library/ and examples/, all of them and no others:
//! `UPDATE_EXPECT=1` (`make update`) draws them anew. docs/patterns.md shows pictures that are there.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own charts")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use chart::draw::Theme;
use chart::{drawings, read};
use expect_test::expect_file;
use syntax::{FileId, parse_chart};

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for path in std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "chart") {
            files.push(path);
        }
    }
}

#[test]
fn pictures_are_fresh() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    for folder in ["library", "examples"] {
        collect(&root.join(folder), &mut files);
    }
    files.sort();
    let mut drawn = BTreeSet::new();
    for path in files {
        let text = std::fs::read_to_string(&path).expect("a chart is UTF-8");
        let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), &text));
        assert_eq!(faults, [], "{}", path.display());
        for drawing in drawings(&chart) {
            let name = format!("{}-{}.svg", chart.name, drawing.name());
            let picture = format!("../../../docs/charts/{name}");
            expect_file![picture].assert_eq(&drawing.svg(Theme::Auto).expect("it is drawn"));
            drawn.insert(name);
        }
    }
    let there = std::fs::read_dir(root.join("docs/charts")).expect("the folder is there").flatten();
    let there: BTreeSet<String> = there.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    assert_eq!(there, drawn, "pictures and charts");
    let page = std::fs::read_to_string(root.join("docs/patterns.md")).expect("the page is there");
    let shown = page.split("](charts/").skip(1).filter_map(|rest| rest.split(')').next());
    let missing: Vec<&str> = shown.filter(|name| !drawn.contains(*name)).collect();
    assert_eq!(missing, Vec::<&str>::new(), "pictures of docs/patterns.md that are not there");
}
