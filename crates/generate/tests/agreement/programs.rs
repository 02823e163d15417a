//! The example programs match their charts: the headers in the examples' `generated/` folders are the output of
//! `groundstate generate cpp`. `UPDATE_EXPECT=1` (`make update`) rewrites them.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own charts")]

use std::path::Path;

use chart::read;
use expect_test::expect_file;
use generate::system::{Form, generate, ungenerated};
use syntax::{FileId, parse_chart};

fn check(chart: &str, program: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(chart);
    let text = std::fs::read_to_string(&path).expect("a chart is UTF-8");
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), &text));
    assert_eq!(faults, [], "{}", path.display());
    let system = chart.system.as_ref().expect("it has a system");
    assert_eq!(ungenerated(system), []);
    let name = path.file_name().expect("it is a file").to_string_lossy();
    for (header, text) in generate(system, &name, &Form::default()).decided {
        expect_file![format!("../../../../examples/{program}/{header}")].assert_eq(&text);
    }
}

#[test]
fn the_fault_has_a_page_whose_example_shows_it() {
    for id in generate::FAULT_IDS {
        let page = testkit::Page::fault(id);
        let example = page.texts("chart fault").first().copied().expect("an example");
        let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), example));
        assert_eq!(faults, []);
        let found = ungenerated(chart.system.as_ref().expect("it has a system"));
        assert_eq!(found.iter().map(|fault| fault.id).collect::<Vec<_>>(), [*id]);
    }
}

#[test]
fn headers_are_fresh() {
    check("visual_servoing/ControllerSystem.chart", "visual_servoing/robot");
}
