//! The pictures in docs/charts/ are those of the charts: `UPDATE_EXPECT=1` draws them anew.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own charts")]

use std::path::Path;

use chart::draw::Theme;
use chart::{drawings, read};
use expect_test::expect_file;
use syntax::{FileId, parse_chart};

fn check(path: &str) {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path));
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), &text.expect("the chart is there")));
    assert_eq!(faults, []);
    for drawing in drawings(&chart) {
        let picture = format!("../../../docs/charts/{}-{}.svg", chart.name, drawing.name());
        expect_file![picture].assert_eq(&drawing.svg(Theme::Auto).expect("it is drawn"));
    }
}

#[test]
fn the_pictures_of_the_library() {
    check("library/patterns/DataProducer.chart");
    check("library/patterns/PatternMachines.chart");
}

#[test]
fn the_pictures_of_the_case_study() {
    check("examples/visual_servoing/VisionSystem.chart");
    check("examples/visual_servoing/ControllerSystem.chart");
    check("examples/visual_servoing/VisualServoingComponent.chart");
}
