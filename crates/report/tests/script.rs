//! The page's script draws a window as the still drawing shows it: SYNC(drawing), SYNC(run data).
//!
//! Runs the script's drawing part in Node, without a browser, and compares every path of both.

use crate::fixture;

use std::io::Write;
use std::process::{Command, Stdio};

use report::{SvgOptions, render_html, render_svg};

/// Class and data of every path, words and labels apart.
fn paths(markup: &str) -> Vec<(String, String)> {
    let document = roxmltree::Document::parse(markup).expect("well-formed");
    let paths = document.descendants().filter(|node| node.has_tag_name("path"));
    let pair = |node: roxmltree::Node| {
        let attribute = |name| node.attribute(name).unwrap_or("").to_owned();
        (attribute("class"), attribute("d"))
    };
    // The cursor belongs to the page alone, empty paths to nobody.
    let mut found: Vec<_> = paths.map(pair).filter(|(class, d)| !class.is_empty() && !d.is_empty()).collect();
    found.sort();
    found
}

/// What the script draws.
fn drawn(page: &str, start: u64, end: u64, width: f64) -> String {
    let (_, rest) = page.split_once("id=\"run\">").expect("the data");
    let (data, rest) = rest.split_once("</script>").expect("its end");
    let (_, script) = rest.split_once("<script>").expect("the script");
    let (draw, _) = script.split_once("// Moves the window over a run").expect("the part that draws");
    let program = format!(
        "const data = {data};
         globalThis.document = {{
           createElement: () => ({{ getContext: () => ({{ measureText: (text) => ({{ width: text.length * 6 }}) }}) }}),
         }};
         {draw}
         const drawing = drawingOf(data);
         process.stdout.write(drawing.drawTimeline(drawing.viewOf({start}, {end}, {width})));"
    );
    let node = Command::new("node").arg("-").stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let mut node = node.expect("Node is needed to test the script");
    node.stdin.take().unwrap().write_all(program.as_bytes()).unwrap();
    let output = node.wait_with_output().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}

/// A path as numbers and what stands between them.
fn parts(path: &str) -> (Vec<f64>, String) {
    let number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-');
    let numbers = path.split(|c| !number(c)).filter_map(|text| text.parse().ok()).collect();
    (numbers, path.chars().filter(|c| !number(*c)).collect())
}

/// Numbers may differ in the last of two decimals, where the two languages round differently.
fn alike(one: &str, other: &str) -> bool {
    let ((one, shape), (other, other_shape)) = (parts(one), parts(other));
    shape == other_shape && one.len() == other.len() && one.iter().zip(&other).all(|(a, b)| (a - b).abs() < 0.0151)
}

#[test]
fn script_and_still_drawing_agree() {
    let mut spec = fixture::spec();
    // A value that jumps from tick to tick: finer than pixels.
    let restless = report::SeriesSpec { name: "Restless".into(), value: "restless".into(), ..Default::default() };
    spec.series.push(restless);
    let mut report = fixture::report_of(spec, 10_000);
    report.tasks[3].misses = vec![7, 130, 2_000];
    let page = render_html(&report);
    for (start, end, width) in [(0, 400, 1120), (294, 334, 900), (1_003, 2_777, 1120), (0, 10_000, 700)] {
        let options = SvgOptions { start, ticks: end - start, width, heading: false };
        let still = paths(&render_svg(&report, &options));
        let script = format!("<svg>{}</svg>", drawn(&page, start, end, f64::from(width) - 40.0));
        let script = paths(&script);
        let classes = |paths: &[(String, String)]| paths.iter().map(|(class, _)| class.clone()).collect::<Vec<_>>();
        assert_eq!(classes(&still), classes(&script), "{start}..{end}");
        for ((class, still), (_, script)) in still.iter().zip(&script) {
            assert!(alike(still, script), "{class} in {start}..{end}:\n{still}\n{script}");
        }
    }
}
