//! The colours of every picture and page: one table, each colour on light and on dark paper.
//!
//! Style sheets name colours as `$name`; [`painted`] puts in those of one paper, [`both`] writes a sheet for light paper and
//! again for screens that are dark. The hues of tones follow Okabe and Ito, so people who confuse red and green can still tell
//! them apart.

/// What is drawn on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Paper {
    /// Dark on light.
    Light,
    /// Light on dark.
    Dark,
}

/// A colour by its meaning, on both papers, as CSS writes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colour {
    /// What style sheets call it, without `$`.
    pub name: &'static str,
    /// On light paper.
    pub light: &'static str,
    /// On dark paper.
    pub dark: &'static str,
}

macro_rules! colours {
    ($($name:literal $light:literal $dark:literal)*) => {
        /// All colours.
        pub const COLOURS: &[Colour] = &[$(Colour { name: $name, light: $light, dark: $dark }),*];
    };
}

colours! {
    // Paper, and what is written and ruled on it.
    "paper" "#ffffff" "#14181b"
    "wash" "#f5f7f8" "#1b2125"
    "ink" "#22282e" "#e4e7ea"
    "line" "#3c464f" "#b3bcc4"
    "soft" "#5c656e" "#a3acb5"
    "faint" "#6a737c" "#939ca5"
    "due" "#b9bfc5" "#545c64"
    "base" "#c3c8cd" "#495159"
    "hair" "#e2e5e8" "#2a3137"
    "link" "#1460a0" "#7cc0f0"
    "good" "#0b7a5f" "#4cc9a6"
    "bad" "#b23300" "#ff8f5e"
    // What a task does.
    "work" "#b4c6da" "#40597a"
    "read" "#12967a" "#2fb796"
    "write" "#1769aa" "#58aee8"
    "hold" "#e8bb45" "#d2b044"
    "message" "#a768a4" "#c78cc4"
    "other" "#8b8f94" "#868c93"
    "late" "#d4500c" "#ff6f2e"
    "readplace" "#c8ecc0" "#285033"
    "writeplace" "#d3d3ff" "#3a3486"
    // Ink on these.
    "on-work" "#26405c" "#d6e2f0"
    "on-read" "#ffffff" "#06211a"
    "on-write" "#ffffff" "#06192a"
    "on-hold" "#3a2a00" "#1f1600"
    "on-message" "#ffffff" "#26102a"
    "on-other" "#ffffff" "#0c0e10"
    "on-late" "#ffffff" "#2b0f00"
    "on-readplace" "#0b5a49" "#9ed8c8"
    "on-writeplace" "#0f4570" "#a5cdf0"
    // Measured quantities.
    "busy" "#5f7da3" "#7f9cc2"
    "leg" "#8fa6c4" "#4a6484"
    "band" "#8db8dc" "#2f6390"
    "measured" "#e8bb45" "#8f7a33"
    "bound-text" "#a63d08" "#ff9a66"
    // The figures of charts: fill, line where it is no colour above, and ink on what is lit.
    "state" "#e8f1fa" "#17293a"
    "guard" "#fcf4dc" "#332a12"
    "guard-line" "#96701a" "#d2b044"
    "action" "#f3f5f7" "#22282e"
    "instance" "#f0eaf7" "#2a2138"
    "instance-line" "#6d4c99" "#b493e0"
    "on-lit" "#ffffff" "#0c1013"
}

impl Colour {
    /// On that paper.
    pub fn on(&self, paper: Paper) -> &'static str {
        match paper {
            Paper::Light => self.light,
            Paper::Dark => self.dark,
        }
    }
}

/// The colour of that name.
pub fn colour(name: &str) -> Option<&'static Colour> {
    COLOURS.iter().find(|colour| colour.name == name)
}

/// A style sheet with the colours of a paper in the place of their names. A name that is none stays, with its `$`.
pub fn painted(sheet: &str, paper: Paper) -> String {
    replaced(sheet, |colour| colour.on(paper).to_owned())
}

/// A style sheet with variables in the place of names: `$ink` becomes `var(--ink)`, for pages that define them.
pub fn named(sheet: &str) -> String {
    replaced(sheet, |colour| format!("var(--{})", colour.name))
}

fn replaced(sheet: &str, by: impl Fn(&Colour) -> String) -> String {
    let mut out = String::with_capacity(sheet.len());
    let mut parts = sheet.split('$');
    out.push_str(parts.next().unwrap_or_default());
    for part in parts {
        let end = part.find(|c: char| !c.is_ascii_lowercase() && c != '-').unwrap_or(part.len());
        match colour(&part[..end]) {
            Some(colour) => out.push_str(&by(colour)),
            None => {
                out.push('$');
                out.push_str(&part[..end]);
            }
        }
        out.push_str(&part[end..]);
    }
    out
}

/// A style sheet that follows the reader's screen: on light paper, and again on dark.
pub fn both(sheet: &str) -> String {
    let (light, dark) = (painted(sheet, Paper::Light), painted(sheet, Paper::Dark));
    format!("{light}@media (prefers-color-scheme: dark) {{\n{dark}}}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_replaced_whole() {
        let sheet = "a{fill:$ink;stroke:$on-work}b{c:$nothing}";
        assert_eq!(painted(sheet, Paper::Light), "a{fill:#22282e;stroke:#26405c}b{c:$nothing}");
        assert_eq!(painted("no names", Paper::Dark), "no names");
        assert_eq!(named(sheet), "a{fill:var(--ink);stroke:var(--on-work)}b{c:$nothing}");
        assert_eq!(
            both("p{fill:$paper}\n"),
            "p{fill:#ffffff}\n@media (prefers-color-scheme: dark) {\np{fill:#14181b}\n}\n"
        );
    }

    #[test]
    fn a_colour_has_one_name() {
        for (index, colour) in COLOURS.iter().enumerate() {
            assert!(COLOURS[..index].iter().all(|other| other.name != colour.name), "{}", colour.name);
            for text in [colour.light, colour.dark] {
                let digits = text.strip_prefix('#').expect("a hash");
                assert!(digits.len() == 6 && digits.chars().all(|c| c.is_ascii_hexdigit()), "{text}");
            }
        }
    }

    /// The contrast of two colours (WCAG 2.2, 1.4.3).
    fn contrast(one: &str, other: &str) -> f64 {
        let light = |colour: &str| {
            let part = |at: usize| {
                let share = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).expect("two digits")) / 255.0;
                if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
            };
            0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5) + 0.05
        };
        let (one, other) = (light(one), light(other));
        if one > other { one / other } else { other / one }
    }

    #[test]
    fn text_can_be_read() {
        let texts = ["ink", "line", "soft", "faint", "link", "good", "bad", "bound-text"];
        for paper in [Paper::Light, Paper::Dark] {
            let on = |name: &str| colour(name).expect("a colour").on(paper);
            for text in texts {
                assert!(contrast(on(text), on("paper")) >= 4.5, "{text} on {paper:?}");
            }
        }
    }
}
