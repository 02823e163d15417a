//! The faces that PNG and PDF are drawn with, and the widths of their letters.
//!
//! They are part of the program, so that a picture is the same on every machine. Letters that they do not have (of scripts
//! other than Latin, Greek and Cyrillic) are left out there; in SVG the reader's own fonts fill in.

use std::sync::OnceLock;

use ttf_parser::Face as Font;

/// The files, in the order of [`Face`].
pub const FILES: [&[u8]; 4] = [
    include_bytes!("../fonts/Arimo-Regular.ttf"),
    include_bytes!("../fonts/Arimo-Bold.ttf"),
    include_bytes!("../fonts/Arimo-Italic.ttf"),
    include_bytes!("../fonts/Cousine-Regular.ttf"),
];

/// A face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    /// Upright, without serifs.
    Sans,
    /// The same, bold.
    Bold,
}

/// How wide a text is at a size.
pub fn width(face: Face, text: &str, size: f64) -> f64 {
    let font = &FONTS.get_or_init(parsed)[if face == Face::Sans { 0 } else { 1 }];
    let advance = |letter: char| font.glyph_index(letter).and_then(|glyph| font.glyph_hor_advance(glyph));
    let em = font.units_per_em();
    // What the face does not have is taken to be a full square.
    let units: f64 = text.chars().map(|letter| f64::from(advance(letter).unwrap_or(em))).sum();
    units * size / f64::from(em)
}

/// The letters of a text that the faces do not have, each once.
pub fn lacking(text: &str) -> Vec<char> {
    let font = &FONTS.get_or_init(parsed)[0];
    let mut letters: Vec<char> =
        text.chars().filter(|letter| !letter.is_control() && font.glyph_index(*letter).is_none()).collect();
    letters.sort_unstable();
    letters.dedup();
    letters
}

/// The faces that are measured.
static FONTS: OnceLock<Vec<Font<'static>>> = OnceLock::new();

fn parsed() -> Vec<Font<'static>> {
    FILES.iter().take(2).map(|file| Font::parse(file, 0).expect("a file of this crate")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_that_are_not_there_are_told() {
        assert_eq!(lacking("Grüße, привет, \u{4e2d}\u{6587}\u{4e2d}\n"), ['\u{4e2d}', '\u{6587}']);
    }

    #[test]
    fn letters_are_as_wide_as_those_of_helvetica() {
        let close = |text: &str, thousandths: f64| {
            assert!((width(Face::Sans, text, 1000.0) - thousandths).abs() < 2.0, "{text}");
        };
        close("A", 667.0);
        close("i", 222.0);
        close("\u{e9}", 556.0);
        close("\u{4e00}", 1000.0);
    }
}
