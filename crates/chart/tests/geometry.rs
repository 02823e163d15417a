//! Every chart of the repository is drawn: no two shapes overlap, no label lies on a shape, a line or another label, no
//! line runs through a shape, every line starts and ends on the edge of its shape; the SVG is well-formed and says in
//! words what it shows. A chart of 500 shapes is drawn too.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own charts")]

use std::path::{Path, PathBuf};

use chart::draw::{Figure, Picture, Theme};
use chart::export::{Notation, export};
use chart::{Chart, drawings, read};
use syntax::{FileId, parse_chart};

fn read_chart(text: &str) -> Chart {
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), text));
    assert_eq!(faults, [], "{text}");
    chart
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for path in std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "chart") {
            files.push(path);
        }
    }
}

fn texts() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    for folder in ["library", "examples"] {
        collect(&root.join(folder), &mut files);
    }
    files.sort();
    let page = std::fs::read_to_string(root.join("spec/charts.md")).expect("the page is there");
    let blocks = page.split("```chart\n").skip(1).filter_map(|rest| rest.split("```").next().map(str::to_string));
    let of_files = files.iter().map(|path| std::fs::read_to_string(path).expect("a chart is UTF-8"));
    of_files.chain(blocks.collect::<Vec<_>>()).collect()
}

/// Left, upper, right and lower end.
type Area = (f64, f64, f64, f64);

fn area(x: f64, y: f64, width: f64, height: f64) -> Area {
    (x, y, x + width, y + height)
}

fn overlap(a: Area, b: Area) -> bool {
    let slack = 0.5;
    a.0 + slack < b.2 && b.0 + slack < a.2 && a.1 + slack < b.3 && b.1 + slack < a.3
}

/// The area that a stretch of a line covers.
fn stretch(from: (f64, f64), to: (f64, f64)) -> Area {
    (from.0.min(to.0) - 0.8, from.1.min(to.1) - 0.8, from.0.max(to.0) + 0.8, from.1.max(to.1) + 0.8)
}

fn assert_readable(picture: &Picture, name: &str) {
    let shapes: Vec<(Area, &str, Figure)> = picture
        .boxes
        .iter()
        .map(|shape| (area(shape.x, shape.y, shape.width, shape.height), shape.id.as_str(), shape.figure))
        .collect();
    for (index, (a, first, _)) in shapes.iter().enumerate() {
        assert!(
            a.0 >= 0.0 && a.1 >= 0.0 && a.2 <= picture.width && a.3 <= picture.height,
            "{name}: {first} is outside"
        );
        for (b, second, _) in &shapes[index + 1..] {
            assert!(!overlap(*a, *b), "{name}: {first} overlaps {second}");
        }
    }
    let labels: Vec<(Area, &str)> = picture
        .labels
        .iter()
        .map(|label| (area(label.x, label.y, label.width, label.height), label.text.as_str()))
        .collect();
    for (index, (a, text)) in labels.iter().enumerate() {
        assert!(a.0 >= 0.0 && a.2 <= picture.width && a.3 <= picture.height, "{name}: {text} is outside");
        for (b, id, figure) in &shapes {
            // The corner of a hexagon's box beside its slanted edge is free.
            let free = *figure == Figure::Hexagon && (a.1 > (b.1 + b.3) / 2.0 || a.3 < (b.1 + b.3) / 2.0);
            assert!(free || !overlap(*a, *b), "{name}: the label {text} lies on {id}");
        }
        for (b, other) in &labels[index + 1..] {
            assert!(!overlap(*a, *b), "{name}: the label {text} lies on {other}");
        }
        for line in &picture.lines {
            for pair in line.points.windows(2) {
                assert!(!overlap(*a, stretch(pair[0], pair[1])), "{name}: a line runs through the label {text}");
            }
        }
    }
    for line in &picture.lines {
        assert!(line.points.len() >= 2, "{name}: an arrow without points");
        for pair in line.points.windows(2) {
            assert!(pair[0].0 == pair[1].0 || pair[0].1 == pair[1].1, "{name}: a line is neither level nor upright");
            for (index, (b, id, _)) in shapes.iter().enumerate() {
                let own = index == line.from || index == line.to;
                assert!(own || !overlap(*b, stretch(pair[0], pair[1])), "{name}: a line runs through {id}");
            }
        }
        for (end, shape) in [(line.points[0], line.from), (line.points[line.points.len() - 1], line.to)] {
            let (left, upper, right, lower) = shapes[shape].0;
            let (x, y) = end;
            let inside = x >= left - 0.5 && x <= right + 0.5 && y >= upper - 0.5 && y <= lower + 0.5;
            let edge = [x - left, right - x, y - upper, lower - y].iter().any(|distance| distance.abs() < 0.5);
            assert!(inside && edge, "{name}: an arrow does not meet {}", shapes[shape].1);
        }
    }
}

#[test]
fn every_chart_is_readable() {
    let mut count = 0;
    for text in texts() {
        let chart = read_chart(&text);
        for drawing in drawings(&chart) {
            let picture = drawing.picture().expect("it is laid out");
            assert_readable(&picture, &format!("{}/{}", chart.name, drawing.name()));
            let svg = drawing.svg(Theme::Auto).expect("it is drawn");
            let tree = roxmltree::Document::parse(&svg).expect("the SVG is well-formed");
            let titled = |tag: &str| tree.descendants().any(|node| node.has_tag_name(tag) && node.text().is_some());
            assert!(titled("title") && titled("desc"), "{svg}");
            assert_eq!(svg, drawing.svg(Theme::Auto).expect("it is drawn again"));
            if let Some(scxml) = export(&drawing, Notation::Scxml) {
                roxmltree::Document::parse(&scxml).expect("the SCXML is well-formed");
            }
            count += 1;
        }
    }
    assert!(count >= 5, "hardly a chart was found");
}

#[test]
fn a_large_chart_is_readable() {
    // A ladder of 125 states, each with two guards and an action: 500 shapes.
    let mut text = "chart Large machine m control c\n".to_string();
    for n in 0..125 {
        let initial = if n == 0 { "initial " } else { "" };
        text += &format!("{initial}state s{n} guard a{n} guard b{n} action d{n}\n");
    }
    for n in 0..125 {
        let next = (n + 1) % 125;
        text +=
            &format!("s{n} -> a{n} yes -> d{n} -> s{next} a{n} no -> b{n} b{n} yes -> s{} b{n} no -> s{n}\n", n / 2);
    }
    let chart = read_chart(&(text + "endmachine"));
    let picture = drawings(&chart)[0].picture().expect("it is laid out");
    assert_eq!(picture.boxes.len(), 500);
    for (index, a) in picture.boxes.iter().enumerate() {
        for b in &picture.boxes[index + 1..] {
            assert!(!overlap(area(a.x, a.y, a.width, a.height), area(b.x, b.y, b.width, b.height)));
        }
    }
}
