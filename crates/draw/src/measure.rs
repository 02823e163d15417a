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
/// LIMIT: the width of a word in a shape. A longer one is broken, or one name would make a shape as large as a picture.
const WORD: f64 = 140.0;
/// From the circle of an initial state to the one in it, and from there to the text.
const RING: f64 = 4.0;
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

/// A text in lines of at most this width, as even as can be. A longer word has a line of its own, one that is much longer several.
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
            for (index, piece) in pieces(word).into_iter().enumerate() {
                let longer = if line.is_empty() { piece.clone() } else { format!("{line} {piece}") };
                if !line.is_empty() && (index > 0 || text_width(&longer, TEXT) > width) {
                    lines.push(std::mem::replace(&mut line, piece));
                } else {
                    line = longer;
                }
            }
        }
        lines.push(line);
    }
    lines
}

/// A word in pieces that are no wider than [`WORD`]: between the words that a name is made of, else within one, with a hyphen.
fn pieces(word: &str) -> Vec<String> {
    if text_width(word, TEXT) <= WORD {
        return vec![word.to_string()];
    }
    let mut pieces = vec![String::new()];
    for part in parts(word) {
        for letter in cut(&part) {
            let last = pieces.last().map_or("", String::as_str);
            let longer = format!("{last}{letter}");
            match pieces.last_mut() {
                Some(last) if text_width(&longer, TEXT) <= WORD => *last = longer,
                _ => pieces.push(letter),
            }
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// The words that a name is made of: each begins with a capital after a small letter, or after a sign.
fn parts(word: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let mut before = None;
    for letter in word.chars() {
        let begins = before.is_some_and(|before: char| {
            (before.is_lowercase() && letter.is_uppercase()) || (letter.is_alphanumeric() && !before.is_alphanumeric())
        });
        match parts.last_mut() {
            Some(last) if !begins => last.push(letter),
            _ => parts.push(letter.to_string()),
        }
        before = Some(letter);
    }
    parts
}

/// A part in pieces that have room in a line each; all but the last end with a hyphen.
fn cut(part: &str) -> Vec<String> {
    let mut pieces = vec![String::new()];
    for letter in part.chars() {
        if let Some(last) = pieces.last_mut() {
            if !last.is_empty() && text_width(&format!("{last}{letter}-"), TEXT) > WORD {
                last.push('-');
                pieces.push(letter.to_string());
            } else {
                last.push(letter);
            }
        }
    }
    pieces
}

/// The width and height of a text in lines.
pub fn extent(lines: &[String]) -> (f64, f64) {
    let width = lines.iter().map(|line| text_width(line, TEXT)).fold(0.0, f64::max);
    (width, lines.len() as f64 * LEADING)
}

/// The radius of the circle of a control state.
pub fn radius_of(text: &str, is_initial: bool) -> f64 {
    in_circle(text).1 + if is_initial { RING } else { 0.0 }
}

/// The lines of a control state, and the radius of the smallest circle around them.
pub fn in_circle(text: &str) -> (Vec<String>, f64) {
    let words = text.split_whitespace().count().max(1);
    let pieces = text.split_whitespace().flat_map(pieces);
    let longest = pieces.map(|piece| text_width(&piece, TEXT)).fold(0.0, f64::max);
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
    fn a_long_word_is_broken() {
        let check = |word: &str, lines: &[&str]| {
            assert_eq!(wrapped(word, 120.0), lines);
            assert!(lines.iter().all(|line| text_width(line, TEXT) <= WORD));
        };
        check("waitingForTheNextImageOfTheCamera", &["waitingForTheNext", "ImageOfTheCamera"]);
        check("r_configure_the_controller_of_it", &["r_configure_the_", "controller_of_it"]);
        check("Donaudampfschifffahrtsgesellschaft", &["Donaudampfschifffah-", "rtsgesellschaft"]);
        check("a waitingForTheNextImageOfTheCamera b", &["a", "waitingForTheNext", "ImageOfTheCamera", "b"]);
        let (lines, radius) = in_circle(&"x".repeat(60));
        assert!(lines.len() > 2 && radius < 90.0, "{lines:?} {radius}");
        assert_eq!(lines.concat().replace('-', ""), "x".repeat(60));
    }

    #[test]
    fn a_circle_holds_its_text() {
        let (lines, radius) = in_circle("Managing swinging buffer");
        assert_eq!(lines, ["Managing", "swinging", "buffer"]);
        assert!(radius < 45.0, "{radius}");
    }
}
