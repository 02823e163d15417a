//! The style of drawings: colours in light and dark, strokes, type.
//!
//! In: a [`Theme`] and what the rules hold under. Out: CSS. It names the classes that `svg` writes.

use std::fmt::Write;

use crate::measure::{SMALL, TEXT, TITLE};

/// Light or dark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Theme {
    /// As the reader's screen is.
    Auto,
    /// Dark on light.
    Light,
    /// Light on dark.
    Dark,
}

/// A figure's colours: fill and line, and both where the figure is lit.
struct Ink {
    fill: &'static str,
    line: &'static str,
    lit: &'static str,
}

/// Colours: paper, ink, and those of each figure.
struct Palette {
    paper: &'static str,
    ink: &'static str,
    faint: &'static str,
    line: &'static str,
    /// Text on what is lit.
    on_lit: &'static str,
    circle: Ink,
    hexagon: Ink,
    rectangle: Ink,
    block: Ink,
}

const LIGHT: Palette = Palette {
    paper: "#ffffff",
    ink: "#1c2227",
    faint: "#566069",
    line: "#3c464f",
    on_lit: "#ffffff",
    circle: Ink { fill: "#e8f1fa", line: "#1769aa", lit: "#1769aa" },
    hexagon: Ink { fill: "#fcf4dc", line: "#96701a", lit: "#96701a" },
    rectangle: Ink { fill: "#f3f5f7", line: "#3c464f", lit: "#3c464f" },
    block: Ink { fill: "#f0eaf7", line: "#6d4c99", lit: "#6d4c99" },
};

const DARK: Palette = Palette {
    paper: "#14181c",
    ink: "#e4e7ea",
    faint: "#9aa5ae",
    line: "#b3bcc4",
    on_lit: "#0c1013",
    circle: Ink { fill: "#17293a", line: "#58aee8", lit: "#58aee8" },
    hexagon: Ink { fill: "#332a12", line: "#d2b044", lit: "#d2b044" },
    rectangle: Ink { fill: "#22282e", line: "#b3bcc4", lit: "#b3bcc4" },
    block: Ink { fill: "#2a2138", line: "#b493e0", lit: "#b493e0" },
};

const SANS: &str = "Helvetica,Arial,Arimo,'Liberation Sans',sans-serif";
const MONO: &str = "ui-monospace,Menlo,Consolas,Cousine,'Liberation Mono',monospace";

/// The rules of a drawing, all of them under a selector (which ends in a blank) or under none.
pub fn css(theme: Theme, under: &str) -> String {
    let mut css = String::new();
    forms(&mut css, under);
    match theme {
        Theme::Light => colours(&mut css, under, &LIGHT),
        Theme::Dark => colours(&mut css, under, &DARK),
        Theme::Auto => {
            colours(&mut css, under, &LIGHT);
            css.push_str("@media(prefers-color-scheme:dark){");
            colours(&mut css, under, &DARK);
            css.push('}');
        }
    }
    css
}

fn forms(css: &mut String, under: &str) {
    let branch = TEXT - 1.5;
    let rules = [
        ("text", format!("font-family:{SANS};font-size:{TEXT}px;text-anchor:middle")),
        (".branch", format!("font-size:{branch}px;font-style:italic")),
        (".heading", format!("font-size:{TITLE}px;font-weight:bold;text-anchor:start")),
        (".name", "font-weight:bold".to_string()),
        (".small", format!("font-size:{SMALL}px")),
        (".start", "text-anchor:start".to_string()),
        (".end", "text-anchor:end".to_string()),
        (".link", format!("font-family:{MONO};font-size:{SMALL}px;font-weight:normal;text-anchor:start")),
        (".shape", "stroke-width:1.5".to_string()),
        (".refine", "stroke-dasharray:6 4".to_string()),
        (".inner", "fill:none".to_string()),
        (".sign", "stroke-width:1".to_string()),
        (".row", "fill:none;stroke:none".to_string()),
        (".arrow", "fill:none;stroke-width:1.4".to_string()),
    ];
    for (selector, declarations) in rules {
        let _ = write!(css, "{under}{selector}{{{declarations}}}");
    }
}

fn colours(css: &mut String, under: &str, palette: &Palette) {
    let Palette { paper, ink, faint, line, on_lit, .. } = palette;
    let _ = write!(
        css,
        "{under}.paper{{fill:{paper}}}{under}text{{fill:{ink}}}{under}.link,{under}.faint{{fill:{faint}}}\
         {under}.arrow{{stroke:{line}}}{under}.tip{{fill:{line}}}"
    );
    let figures = [
        ("state", &palette.circle),
        ("guard", &palette.hexagon),
        ("action", &palette.rectangle),
        ("instance", &palette.block),
        ("component", &palette.circle),
        ("channel", &palette.hexagon),
        ("device", &palette.rectangle),
    ];
    for (class, ink) in figures {
        let Ink { fill, line, lit } = ink;
        let _ = write!(css, "{under}.{class}{{fill:{fill};stroke:{line}}}");
        if !under.is_empty() {
            // Only a page lights shapes.
            let _ = write!(css, "{under}.lit>.{class}{{fill:{lit}}}{under}.lit>.{class}.inner{{stroke:{on_lit}}}");
        }
    }
    if !under.is_empty() {
        let _ =
            write!(css, "{under}.lit>.row{{fill:{}}}{under}.lit>text:not(.link){{fill:{on_lit}}}", palette.circle.lit);
    }
}
