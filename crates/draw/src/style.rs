//! The style of drawings: colours in light and dark, strokes, type.
//!
//! In: a [`Theme`] and what the rules hold under. Out: CSS. It names the classes that `svg` writes.

use std::fmt::Write;

use palette::{Paper, painted};

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

const SANS: &str = "Helvetica,Arial,Arimo,'Liberation Sans',sans-serif";
const MONO: &str = "ui-monospace,Menlo,Consolas,Cousine,'Liberation Mono',monospace";

/// The rules of a drawing, all of them under a selector (which ends in a blank) or under none; those of composite states if there are
/// any.
pub fn css(theme: Theme, under: &str, nested: bool) -> String {
    css_of(under, nested, |sheet| match theme {
        Theme::Light => painted(sheet, Paper::Light),
        Theme::Dark => painted(sheet, Paper::Dark),
        Theme::Auto => {
            let (light, dark) = (painted(sheet, Paper::Light), painted(sheet, Paper::Dark));
            format!("{light}@media(prefers-color-scheme:dark){{{dark}}}")
        }
    })
}

/// The same, with colours by their names made what they are.
pub fn css_of(under: &str, nested: bool, paint: impl Fn(&str) -> String) -> String {
    let mut css = String::new();
    forms(&mut css, under);
    let mut sheet = String::new();
    colours(&mut sheet, under, nested);
    css.push_str(&paint(&sheet));
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

/// The rules about colour, with the names that the palette has for them.
fn colours(css: &mut String, under: &str, nested: bool) {
    let _ = write!(
        css,
        "{under}.paper{{fill:$paper}}{under}text{{fill:$ink}}{under}.link,{under}.faint{{fill:$soft}}\
         {under}.arrow{{stroke:$line}}{under}.tip{{fill:$line}}"
    );
    // The class, its fill, its line; where it is lit, the line fills it.
    let figures = [
        ("state", "state", "write"),
        ("composite", "paper", "write"),
        ("guard", "guard", "guard-line"),
        ("action", "action", "line"),
        ("instance", "instance", "instance-line"),
        ("component", "state", "write"),
        ("channel", "guard", "guard-line"),
        ("device", "action", "line"),
    ];
    for (class, fill, line) in figures.into_iter().filter(|(class, ..)| nested || *class != "composite") {
        let _ = write!(css, "{under}.{class}{{fill:${fill};stroke:${line}}}");
        if !under.is_empty() {
            // Only a page lights shapes.
            let _ = write!(css, "{under}.lit>.{class}{{fill:${line}}}{under}.lit>.{class}.inner{{stroke:$on-lit}}");
        }
    }
    if !under.is_empty() {
        let _ = write!(css, "{under}.lit>.row{{fill:$write}}{under}.lit>text:not(.link){{fill:$on-lit}}");
    }
}
