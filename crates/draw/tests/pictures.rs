//! The pictures in docs/charts/ are those of the charts of library/ and examples/, all of them and no others:
//! `UPDATE_EXPECT=1` (`make update`) draws them anew. docs/patterns.md shows pictures that are there.

use std::collections::BTreeSet;

use chart::read;
use draw::{Theme, drawings};
use expect_test::expect_file;
use syntax::{FileId, parse_chart};
use testkit::repository;

#[test]
fn pictures_are_fresh() {
    let files = ["examples", "library"].map(|folder| repository::files(folder, &["chart"])).concat();
    let mut drawn = BTreeSet::new();
    for path in files {
        let text = repository::text(&path);
        let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), &text));
        assert_eq!(faults, [], "{}", path.display());
        for drawing in drawings(&chart) {
            let name = format!("{}-{}.svg", chart.name, drawing.name());
            let picture = format!("../../../docs/charts/{name}");
            expect_file![picture].assert_eq(&drawing.svg(Theme::Auto).expect("it is drawn"));
            drawn.insert(name);
        }
    }
    let there = std::fs::read_dir(repository::root().join("docs/charts")).expect("the folder is there").flatten();
    let there: BTreeSet<String> = there.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    assert_eq!(there, drawn, "pictures and charts");
    let page = repository::text("docs/patterns.md");
    let shown = page.split("](charts/").skip(1).filter_map(|rest| rest.split(')').next());
    let missing: Vec<&str> = shown.filter(|name| !drawn.contains(*name)).collect();
    assert_eq!(missing, Vec::<&str>::new(), "pictures of docs/patterns.md that are not there");
}
