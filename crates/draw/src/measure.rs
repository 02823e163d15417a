//! The measures of the notation: how wide a text is, how it is broken into lines, how large its shape must be.
//!
//! Lengths are CSS pixels. Text is measured in the faces that PNG and PDF are drawn with, whose letters are as wide as
//! Helvetica's and Arial's; a margin is added for faces that run wider.

use crate::font;

/// Size of the text in shapes.
pub const TEXT: f64 = 13.0;
/// Size of links and of `yes` and `no`.
pub const SMALL: f64 = 10.5;
/// From one line of text in a shape to the next.
pub const LEADING: f64 = 16.0;
/// Size of the heading.
pub const TITLE: f64 = 15.0;
/// How high the heading is.
pub const HEADING: f64 = 34.0;
/// From the left end of the picture to the heading.
pub const INDENT: f64 = 20.0;
/// From one small line to the next.
pub const SMALL_LEADING: f64 = 14.0;
/// The room of the rule between what a component is and its phases.
pub const RULE: f64 = 8.0;
/// Faces that stand in for Helvetica run up to so much wider.
const MARGIN: f64 = 1.08;

/// How wide a text is at a size.
pub fn text_width(text: &str, size: f64) -> f64 {
    font::width(font::Face::Sans, text, size) * MARGIN
}

/// How wide a text is at a size in bold.
pub fn bold_width(text: &str, size: f64) -> f64 {
    font::width(font::Face::Bold, text, size) * MARGIN
}

/// How wide a text of a link is: these are set in a face whose letters are equally wide.
pub fn link_width(text: &str) -> f64 {
    text.chars().count() as f64 * SMALL * 0.61
}

/// How wide a picture must be for its heading.
pub fn heading_width(title: &str, link: Option<&str>) -> f64 {
    let link = link.map_or(0.0, |link| link_width(link) + 10.0);
    2.0 * INDENT + bold_width(title, TITLE) + link
}

/// A text in lines of at most this width, as even as can be; a longer word has a line of its own.
pub fn wrapped(text: &str, width: f64) -> Vec<String> {
    let count = broken(text, width).len();
    // The narrowest width that needs no more lines makes them even.
    let (mut low, mut high) = (0.0, width);
    for _ in 0..12 {
        let middle = (low + high) / 2.0;
        if broken(text, middle).len() <= count {
            high = middle;
        } else {
            low = middle;
        }
    }
    broken(text, high)
}

fn broken(text: &str, width: f64) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            let longer = if line.is_empty() { word.to_string() } else { format!("{line} {word}") };
            if !line.is_empty() && text_width(&longer, TEXT) > width {
                lines.push(std::mem::replace(&mut line, word.to_string()));
            } else {
                line = longer;
            }
        }
        lines.push(line);
    }
    lines
}

/// The width and height of a text in lines.
pub fn extent(lines: &[String]) -> (f64, f64) {
    let width = lines.iter().map(|line| text_width(line, TEXT)).fold(0.0, f64::max);
    (width, lines.len() as f64 * LEADING)
}

/// The lines of a control state, and the radius of the smallest circle around them.
pub fn in_circle(text: &str) -> (Vec<String>, f64) {
    let words = text.split_whitespace().count().max(1);
    let longest = text.split_whitespace().map(|word| text_width(word, TEXT)).fold(0.0, f64::max);
    let whole = text_width(text, TEXT);
    let candidates = (0..=words).map(|step| longest + (whole - longest) * step as f64 / words as f64);
    let sized = candidates.map(|width| {
        let lines = broken(text, width);
        let half = lines.len() as f64 * LEADING / 2.0;
        let reach = |(index, line): (usize, &String)| {
            let top = (index as f64 * LEADING - half).abs();
            let bottom = ((index + 1) as f64 * LEADING - half).abs();
            (text_width(line, TEXT) / 2.0).hypot(top.max(bottom) - 3.0)
        };
        let radius = lines.iter().enumerate().map(reach).fold(0.0, f64::max);
        (lines, radius + 5.0)
    });
    sized.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_even() {
        assert_eq!(wrapped("Swinging buffer managed", 120.0), ["Swinging buffer", "managed"]);
        assert_eq!(wrapped("Idle", 120.0), ["Idle"]);
        assert_eq!(wrapped("", 120.0), Vec::<String>::new());
    }

    #[test]
    fn a_circle_holds_its_text() {
        let (lines, radius) = in_circle("Managing swinging buffer");
        assert_eq!(lines, ["Managing", "swinging", "buffer"]);
        assert!(radius < 45.0, "{radius}");
    }
}
