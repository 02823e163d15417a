//! Picture → SVG.
//!
//! In: a placed picture, its title and description. Out: one SVG, readable alone: the style is in it, in light and dark;
//! text is text. Coordinates are rounded to tenths, so that the bytes do not hang on the last bit of a number.

use std::fmt::Write;

use super::components::SMALL_LEADING;
use super::notation::{HEADING, INDENT, LEADING, SMALL, TEXT};
use super::picture::{Figure, Line, Picture, Placed};
use super::scene::corner;

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

/// Colours: paper, ink, and fill and line of each figure.
struct Palette {
    paper: &'static str,
    ink: &'static str,
    faint: &'static str,
    line: &'static str,
    circle: (&'static str, &'static str),
    hexagon: (&'static str, &'static str),
    rectangle: (&'static str, &'static str),
    block: (&'static str, &'static str),
}

const LIGHT: Palette = Palette {
    paper: "#ffffff",
    ink: "#1c2227",
    faint: "#5b6670",
    line: "#3c464f",
    circle: ("#e8f1fa", "#1769aa"),
    hexagon: ("#fcf4dc", "#96701a"),
    rectangle: ("#f3f5f7", "#3c464f"),
    block: ("#f0eaf7", "#6d4c99"),
};

const DARK: Palette = Palette {
    paper: "#14181c",
    ink: "#e4e7ea",
    faint: "#9aa5ae",
    line: "#b3bcc4",
    circle: ("#17293a", "#58aee8"),
    hexagon: ("#332a12", "#d2b044"),
    rectangle: ("#22282e", "#b3bcc4"),
    block: ("#2a2138", "#b493e0"),
};

fn colours(palette: &Palette) -> String {
    let mut css = format!(
        ".paper{{fill:{}}}text{{fill:{}}}.link{{fill:{}}}.arrow{{stroke:{}}}.tip{{fill:{}}}",
        palette.paper, palette.ink, palette.faint, palette.line, palette.line
    );
    let figures = [
        ("state", palette.circle),
        ("guard", palette.hexagon),
        ("action", palette.rectangle),
        ("instance", palette.block),
        ("component", palette.circle),
        ("channel", palette.hexagon),
        ("device", palette.rectangle),
    ];
    for (class, (fill, stroke)) in figures {
        let _ = write!(css, ".{class}{{fill:{fill};stroke:{stroke}}}");
    }
    css
}

fn style(theme: Theme) -> String {
    let (sans, mono) =
        ("Helvetica,Arial,'Liberation Sans',sans-serif", "ui-monospace,Menlo,Consolas,'Liberation Mono',monospace");
    let forms = format!(
        "text{{font:{TEXT}px {sans};text-anchor:middle}}.exit{{font-size:{}px;font-style:italic}}\
         .heading{{font-weight:bold;text-anchor:start}}.link{{font:{SMALL}px {mono};text-anchor:start}}\
         .small{{font-size:{SMALL}px}}\
         .state,.guard,.action,.instance,.component,.channel,.device{{stroke-width:1.5}}.refine{{stroke-dasharray:6 4}}\
         .inner{{fill:none}}.sign{{stroke-width:1}}.arrow{{fill:none;stroke-width:1.4}}",
        TEXT - 1.5
    );
    let colours = match theme {
        Theme::Light => colours(&LIGHT),
        Theme::Dark => colours(&DARK),
        Theme::Auto => format!("{}@media(prefers-color-scheme:dark){{{}}}", colours(&LIGHT), colours(&DARK)),
    };
    forms + &colours
}

/// A number to tenths, without needless digits.
struct N(f64);

impl std::fmt::Display for N {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let tenths = (self.0 * 10.0).round() / 10.0;
        if tenths == tenths.trunc() { write!(f, "{}", tenths as i64) } else { write!(f, "{tenths:.1}") }
    }
}

/// Text between tags.
pub(crate) struct Text<'t>(pub(crate) &'t str);

impl std::fmt::Display for Text<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for letter in self.0.chars() {
            match letter {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                letter if letter.is_control() => f.write_char(' ')?,
                letter => f.write_char(letter)?,
            }
        }
        Ok(())
    }
}

/// The SVG of a picture.
pub(super) fn svg(picture: &Picture, description: &str, theme: Theme) -> String {
    let (width, height) = (N(picture.width.ceil()), N(picture.height.ceil()));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\" aria-labelledby=\"title desc\">\n\
         <title id=\"title\">{}</title>\n<desc id=\"desc\">{}</desc>\n<style>{}</style>\n\
         <rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n",
        Text(&picture.heading.0),
        Text(description),
        style(theme)
    );
    heading(&mut out, picture);
    for line in &picture.lines {
        arrow(&mut out, line);
    }
    for shape in &picture.boxes {
        figure(&mut out, shape);
    }
    for label in &picture.labels {
        let (class, x) = if label.is_link { ("link", label.x) } else { ("exit", label.x + label.width / 2.0) };
        let y = label.y + label.height - 3.5;
        let _ = writeln!(out, "<text class=\"{class}\" x=\"{}\" y=\"{}\">{}</text>", N(x), N(y), Text(&label.text));
    }
    out.push_str("</svg>\n");
    out
}

fn heading(out: &mut String, picture: &Picture) {
    let (title, link) = &picture.heading;
    let y = N(HEADING - 8.0);
    let _ = write!(out, "<text class=\"heading\" x=\"{}\" y=\"{y}\">{}", N(INDENT), Text(title));
    if let Some(link) = link {
        let _ = write!(out, "<tspan class=\"link\" dx=\"10\">{}</tspan>", Text(link));
    }
    out.push_str("</text>\n");
}

/// Corners of arrows are rounded with this radius.
const RADIUS: f64 = 7.0;
/// The length and half the width of a tip.
const TIP: (f64, f64) = (9.0, 3.8);

fn arrow(out: &mut String, line: &Line) {
    let [.., before, end] = line.points[..] else { return };
    let length = (end.0 - before.0).hypot(end.1 - before.1).max(0.001);
    let (dx, dy) = ((end.0 - before.0) / length, (end.1 - before.1) / length);
    let back = (end.0 - dx * TIP.0, end.1 - dy * TIP.0);
    let mut path = String::new();
    for (index, point) in line.points.iter().enumerate() {
        match (index, line.points.get(index + 1)) {
            (0, _) => _ = write!(path, "M{} {}", N(point.0), N(point.1)),
            (_, None) => _ = write!(path, "L{} {}", N(back.0), N(back.1)),
            (_, Some(next)) => rounded(&mut path, line.points[index - 1], *point, *next),
        }
    }
    let _ = writeln!(out, "<path class=\"arrow\" d=\"{path}\"/>");
    let (sx, sy) = (-dy * TIP.1, dx * TIP.1);
    let _ = writeln!(
        out,
        "<path class=\"tip\" d=\"M{} {}L{} {}L{} {}Z\"/>",
        N(end.0),
        N(end.1),
        N(back.0 + sx),
        N(back.1 + sy),
        N(back.0 - sx),
        N(back.1 - sy)
    );
}

fn rounded(path: &mut String, before: (f64, f64), corner: (f64, f64), next: (f64, f64)) {
    let towards = |to: (f64, f64)| {
        let length = (to.0 - corner.0).hypot(to.1 - corner.1).max(0.001);
        let part = RADIUS.min(length / 2.0) / length;
        (corner.0 + (to.0 - corner.0) * part, corner.1 + (to.1 - corner.1) * part)
    };
    let (a, b) = (towards(before), towards(next));
    let _ = write!(path, "L{} {}Q{} {} {} {}", N(a.0), N(a.1), N(corner.0), N(corner.1), N(b.0), N(b.1));
}

fn figure(out: &mut String, shape: &Placed) {
    let Placed { x, y, width, height, .. } = *shape;
    let (cx, cy) = (x + width / 2.0, y + height / 2.0);
    let dashed = if shape.dashed { " refine" } else { "" };
    match shape.figure {
        Figure::Circle => {
            let _ = writeln!(
                out,
                "<circle class=\"state{dashed}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>",
                N(cx),
                N(cy),
                N(width / 2.0)
            );
            if shape.initial {
                let r = N(width / 2.0 - 3.5);
                let _ = writeln!(out, "<circle class=\"state inner\" cx=\"{}\" cy=\"{}\" r=\"{r}\"/>", N(cx), N(cy));
            }
        }
        Figure::Hexagon => {
            let c = corner(height);
            let points = [
                (x, cy),
                (x + c, y),
                (x + width - c, y),
                (x + width, cy),
                (x + width - c, y + height),
                (x + c, y + height),
            ];
            let points: Vec<String> = points.iter().map(|(x, y)| format!("{},{}", N(*x), N(*y))).collect();
            let _ = writeln!(out, "<polygon class=\"guard{dashed}\" points=\"{}\"/>", points.join(" "));
        }
        Figure::Enter | Figure::Exit => {}
        _ => {
            let (class, round) = match shape.figure {
                Figure::Block => ("instance", 8.0),
                Figure::Component => ("component", 3.0),
                Figure::Channel => ("channel", height / 2.0),
                Figure::Device => ("device", 3.0),
                _ => ("action", 2.0),
            };
            let _ = writeln!(
                out,
                "<rect class=\"{class}{dashed}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{round}\"/>",
                N(x),
                N(y),
                N(width),
                N(height)
            );
            if shape.figure == Figure::Block {
                for x in [x + 9.0, x + width - 9.0] {
                    let _ =
                        writeln!(out, "<path class=\"instance inner\" d=\"M{} {}V{}\"/>", N(x), N(y), N(y + height));
                }
            }
            if shape.figure == Figure::Component {
                icon(out, x + width - 9.0, y + 8.0);
            }
        }
    }
    let rest = shape.small.len() as f64 * SMALL_LEADING;
    let first = cy - ((shape.lines.len() as f64 - 1.0) * LEADING + rest) / 2.0 + TEXT * 0.35;
    for (index, line) in shape.lines.iter().enumerate() {
        let y = first + index as f64 * LEADING;
        let _ = writeln!(out, "<text x=\"{}\" y=\"{}\">{}</text>", N(cx), N(y), Text(line));
    }
    for (index, line) in shape.small.iter().enumerate() {
        let y = first + shape.lines.len() as f64 * LEADING + index as f64 * SMALL_LEADING - 2.0;
        let _ = writeln!(out, "<text class=\"small\" x=\"{}\" y=\"{}\">{}</text>", N(cx), N(y), Text(line));
    }
}

/// The sign of a component, as UML has it; its right upper corner lies there.
fn icon(out: &mut String, right: f64, top: f64) {
    let rect = |x: f64, y: f64, w: f64, h: f64| format!("M{} {}h{}v{}h{}Z", N(x), N(y), N(w), N(h), N(-w));
    let d = rect(right - 9.0, top, 9.0, 11.0)
        + &rect(right - 11.5, top + 2.0, 5.0, 2.4)
        + &rect(right - 11.5, top + 6.4, 5.0, 2.4);
    let _ = writeln!(out, "<path class=\"component sign\" d=\"{d}\"/>");
}
