//! Boxes and labels in the drawing keep out of each other's way.

use crate::fixture;

use report::{SvgOptions, Track, render_svg};

/// A rectangle: left, top, right, bottom.
type Frame = (f64, f64, f64, f64);

fn number(text: &str) -> f64 {
    text.parse().expect("a number")
}

/// The boxes of a path made of `Mx yhWvHh-Wz`.
fn boxes(path: &str) -> Vec<Frame> {
    path.split('z')
        .filter(|piece| piece.starts_with('M') && piece.contains('h') && piece.contains('v'))
        .map(|piece| {
            let (at, size) = piece[1..].split_once('h').unwrap();
            let (x, y) = at.split_once(' ').unwrap();
            let (width, rest) = size.split_once('v').unwrap();
            let height = rest.split_once('h').unwrap().0;
            let (x, y) = (number(x), number(y));
            (x, y, x + number(width), y + number(height))
        })
        .collect()
}

fn meet(a: &Frame, b: &Frame) -> bool {
    let spare = 0.021;
    a.0 + spare < b.2 && b.0 + spare < a.2 && a.1 + spare < b.3 && b.1 + spare < a.3
}

const TONES: [&str; 9] = ["work", "read", "write", "hold", "message", "other", "wait", "readplace", "writeplace"];

#[test]
fn spans_of_a_track_are_disjoint() {
    let report = fixture::report(10_000);
    let tracks = report.tasks.iter().map(|task| &task.track);
    let tracks = tracks.chain(report.buffers.iter().flat_map(|buffer| buffer.rows.iter().chain(&buffer.lock)));
    for track in tracks {
        let disjoint = |track: &Track| track.spans().windows(2).all(|pair| pair[0].end <= pair[1].start);
        assert!(disjoint(track) && track.spans().iter().all(|span| span.start < span.end));
    }
}

#[test]
fn boxes_do_not_overlap_and_labels_keep_out() {
    for (ticks, width) in [(40, 1120), (400, 1120), (400, 700), (2_000, 1120), (10_000, 600)] {
        let options = SvgOptions { ticks, width, heading: false, ..SvgOptions::default() };
        let picture = render_svg(&fixture::report(10_000), &options);
        let document = roxmltree::Document::parse(&picture).unwrap();
        let mut found: Vec<Frame> = Vec::new();
        for node in document.descendants().filter(|node| node.has_tag_name("path")) {
            if node.attribute("class").is_some_and(|class| TONES.contains(&class)) {
                found.extend(boxes(node.attribute("d").unwrap()));
            }
        }
        assert!(found.len() > 50);
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (index, a) in found.iter().enumerate() {
            let mut near = found[index + 1..].iter().take_while(|b| b.0 < a.2);
            assert_eq!(near.find(|b| meet(a, b)), None, "{a:?} in {ticks} ticks at {width}");
        }
        let mut labels: Vec<Frame> = Vec::new();
        for node in document.descendants().filter(|node| node.has_tag_name("text")) {
            if let Some(size) = match node.attribute("class") {
                Some("name") => Some(13.0),
                Some("caption" | "heading") => Some(11.0),
                _ => None,
            } {
                let (x, y) = (number(node.attribute("x").unwrap()), number(node.attribute("y").unwrap()));
                // A generous estimate: no face sets words wider than 0.62 em a letter on average.
                let wide = node.text().unwrap_or("").chars().count() as f64 * size * 0.62;
                labels.push((x, y - size * 0.75, x + wide, y + size * 0.2));
            }
        }
        for (index, label) in labels.iter().enumerate() {
            assert_eq!(found.iter().find(|frame| meet(frame, label)), None, "box over {label:?}");
            assert_eq!(labels[index + 1..].iter().find(|other| meet(other, label)), None, "label over {label:?}");
        }
    }
}

#[test]
fn words_fit_into_their_boxes() {
    let picture = render_svg(&fixture::report(400), &SvgOptions { heading: false, ..SvgOptions::default() });
    let document = roxmltree::Document::parse(&picture).unwrap();
    let of = |class: &str| -> Vec<Frame> {
        let paths = document.descendants().filter(|node| node.attribute("class") == Some(class));
        paths.filter_map(|node| node.attribute("d")).flat_map(boxes).collect()
    };
    let words: Vec<_> =
        document.descendants().filter(|n| n.attribute("class").is_some_and(|c| c.starts_with("word "))).collect();
    assert!(!words.is_empty());
    for word in words {
        let tone = word.attribute("class").unwrap().trim_start_matches("word on-");
        let (x, y) = (number(word.attribute("x").unwrap()), number(word.attribute("y").unwrap()));
        let right = x + word.text().unwrap().chars().count() as f64 * 10.5 * 0.5;
        let inside = |frame: &Frame| frame.0 <= x && right <= frame.2 && frame.1 <= y - 8.0 && y + 1.0 <= frame.3;
        assert!(of(tone).iter().any(inside), "{:?} at {x} {y}", word.text());
    }
}
