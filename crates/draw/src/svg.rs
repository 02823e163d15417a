//! Picture → SVG.
//!
//! In: a placed picture, its title and description. Out: one SVG, readable alone: the style is in it, in light and dark;
//! text is text. Coordinates are rounded to tenths, so that the bytes do not hang on the last bit of a number.

use std::fmt::Write;

use chart::xml::Text;

use crate::measure::{HEADING, INDENT, LEADING, RULE, SMALL_LEADING, TEXT};
use crate::picture::{Figure, Label, Line, Picture, Placed};
use crate::scene::corner;
use crate::style::{Theme, css};

/// A number to tenths, without needless digits.
struct N(f64);

impl std::fmt::Display for N {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let tenths = (self.0 * 10.0).round() / 10.0;
        if tenths == tenths.trunc() { write!(f, "{}", tenths as i64) } else { write!(f, "{tenths:.1}") }
    }
}

/// The SVG of a picture, as a file of its own.
pub fn svg(picture: &Picture, description: &str, theme: Theme) -> String {
    let Picture { left, top, width, height, .. } = *picture;
    let style = format!(
        "<style>{}</style>\n<rect class=\"paper\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
        css(theme, "", picture.boxes.iter().any(|shape| shape.figure == Figure::Composite)),
        N(left),
        N(top),
        N(width.ceil()),
        N(height.ceil())
    );
    element(picture, description, "", "", &style)
}

/// The SVG of a picture as a part of a page that has the style: no paper, no heading. Its identifiers begin with `prefix`.
pub fn part(picture: &Picture, description: &str, prefix: &str, class: &str) -> String {
    element(picture, description, prefix, class, "")
}

fn element(picture: &Picture, description: &str, prefix: &str, class: &str, style: &str) -> String {
    // Without its style it is a part of a page, which has the heading.
    let above = if style.is_empty() { HEADING } else { 0.0 };
    let (left, top) = (N(picture.left), N(picture.top + above));
    let (width, height) = (N(picture.width.ceil()), N((picture.height - above).ceil()));
    let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
    // Within HTML the name space goes without saying.
    let space = if style.is_empty() { "" } else { " xmlns=\"http://www.w3.org/2000/svg\"" };
    let mut out = format!(
        "<svg{space}{class} width=\"{width}\" height=\"{height}\" \
         viewBox=\"{left} {top} {width} {height}\" role=\"img\" aria-labelledby=\"{prefix}title {prefix}desc\">\n\
         <title id=\"{prefix}title\">{}</title>\n<desc id=\"{prefix}desc\">{}</desc>\n{style}",
        Text(&picture.heading.0),
        Text(description),
    );
    if !style.is_empty() {
        heading(&mut out, picture);
    }
    // What holds others lies behind them, the outermost farthest.
    let mut frames: Vec<&Placed> = picture.boxes.iter().filter(|shape| shape.figure == Figure::Composite).collect();
    frames.sort_by(|one, other| (other.width * other.height).total_cmp(&(one.width * one.height)));
    for frame in frames {
        let _ = writeln!(out, "<g data-shape=\"{}\">", Text(&frame.id));
        composite(&mut out, frame);
        out.push_str("</g>\n");
    }
    for line in &picture.lines {
        arrow(&mut out, line);
    }
    for (index, shape) in picture.boxes.iter().enumerate() {
        let labels: Vec<&Label> = picture.labels.iter().filter(|label| label.of == index).collect();
        let floating = matches!(shape.figure, Figure::Enter | Figure::Exit | Figure::Composite);
        if floating {
            answer(&mut out, shape);
            continue;
        }
        let _ = writeln!(out, "<g data-shape=\"{}\">", Text(&shape.id));
        figure(&mut out, shape);
        for label in labels {
            let (class, x) = if label.is_link { ("link", label.x) } else { ("branch", label.x + label.width / 2.0) };
            let y = label.y + label.height - 3.5;
            let _ = writeln!(out, "<text class=\"{class}\" x=\"{}\" y=\"{}\">{}</text>", N(x), N(y), Text(&label.text));
        }
        out.push_str("</g>\n");
    }
    out.push_str("</svg>\n");
    out
}

/// What stands at the end of an exit arrow that gives an answer.
fn answer(out: &mut String, shape: &Placed) {
    if let (Figure::Exit, [word]) = (shape.figure, &shape.lines[..]) {
        let (x, y) = (shape.x + shape.width / 2.0, shape.y + shape.height - 3.5);
        let _ = writeln!(out, "<text class=\"branch\" x=\"{}\" y=\"{}\">{}</text>", N(x), N(y), Text(word));
    }
}

fn heading(out: &mut String, picture: &Picture) {
    let (title, link) = &picture.heading;
    let (x, y) = (N(picture.left + INDENT), N(picture.top + HEADING - 8.0));
    let _ = write!(out, "<text class=\"heading\" x=\"{x}\" y=\"{y}\">{}", Text(title));
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
    // A rule of the style sheet would win over an attribute of its own.
    let (dashed, dashes) = match (shape.dashed, shape.named) {
        (false, _) => ("", ""),
        (true, false) => (" refine", ""),
        (true, true) => (" refine", " style=\"stroke-dasharray:14 3\""),
    };
    match shape.figure {
        Figure::Circle => {
            let _ = writeln!(
                out,
                "<circle class=\"shape state{dashed}\"{dashes} cx=\"{}\" cy=\"{}\" r=\"{}\"/>",
                N(cx),
                N(cy),
                N(width / 2.0)
            );
            if shape.initial {
                let r = N(width / 2.0 - 3.5);
                let _ =
                    writeln!(out, "<circle class=\"shape state inner\" cx=\"{}\" cy=\"{}\" r=\"{r}\"/>", N(cx), N(cy));
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
            let _ = writeln!(out, "<polygon class=\"shape guard{dashed}\"{dashes} points=\"{}\"/>", points.join(" "));
        }
        Figure::Enter | Figure::Exit | Figure::Composite => {}
        _ => {
            let (class, round) = class_of(shape.figure);
            let round = N(round.min(height / 2.0));
            let _ = writeln!(
                out,
                "<rect class=\"shape {class}{dashed}\"{dashes} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{round}\"/>",
                N(x),
                N(y),
                N(width),
                N(height)
            );
            if shape.figure == Figure::Block {
                for x in [x + 9.0, x + width - 9.0] {
                    let _ = writeln!(
                        out,
                        "<path class=\"shape instance inner\" d=\"M{} {}V{}\"/>",
                        N(x),
                        N(y),
                        N(y + height)
                    );
                }
            }
            if shape.figure == Figure::Component {
                icon(out, x + width - 9.0, y + 8.0);
            }
        }
    }
    words(out, shape);
}

/// The frame of a composite state, with its words at the top.
fn composite(out: &mut String, shape: &Placed) {
    let mut frame = |class: &str, in_by: f64, round: f64| {
        let _ = writeln!(
            out,
            "<rect class=\"shape composite{class}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\"/>",
            N(shape.x + in_by),
            N(shape.y + in_by),
            N(shape.width - 2.0 * in_by),
            N(shape.height - 2.0 * in_by),
            N(round)
        );
    };
    frame("", 0.0, 14.0);
    if shape.initial {
        frame(" inner", 3.5, 11.0);
    }
    let x = N(shape.x + 16.0);
    let mut y = shape.y + 20.0;
    for line in &shape.lines {
        let _ = writeln!(out, "<text class=\"name start\" x=\"{x}\" y=\"{}\">{}</text>", N(y), Text(line));
        y += SMALL_LEADING;
    }
    for detail in &shape.details {
        let _ =
            writeln!(out, "<text class=\"small faint start\" x=\"{x}\" y=\"{}\">{}</text>", N(y), Text(&detail.text));
        y += SMALL_LEADING;
    }
}

/// The text in a shape, and the smaller one below it.
fn words(out: &mut String, shape: &Placed) {
    let (left, right) = (shape.x + 12.0, shape.x + shape.width - 12.0);
    let (cx, cy) = (shape.x + shape.width / 2.0, shape.y + shape.height / 2.0);
    let ruled = shape.details.iter().any(|detail| detail.right.is_some());
    let rest = shape.details.len() as f64 * SMALL_LEADING + if ruled { RULE } else { 0.0 };
    let first = cy - ((shape.lines.len() as f64 - 1.0) * LEADING + rest) / 2.0 + TEXT * 0.35;
    let named = matches!(shape.figure, Figure::Component | Figure::Channel | Figure::Device);
    let class = if named { " class=\"name\"" } else { "" };
    for (index, line) in shape.lines.iter().enumerate() {
        let y = first + index as f64 * LEADING;
        let _ = writeln!(out, "<text{class} x=\"{}\" y=\"{}\">{}</text>", N(cx), N(y), Text(line));
    }
    let mut y = first + shape.lines.len() as f64 * LEADING - 2.0;
    let mut above = true;
    for detail in &shape.details {
        let text = Text(&detail.text);
        let Some(time) = &detail.right else {
            let _ = writeln!(out, "<text class=\"small faint\" x=\"{}\" y=\"{}\">{text}</text>", N(cx), N(y));
            y += SMALL_LEADING;
            continue;
        };
        if std::mem::take(&mut above) {
            let line = y - 7.0;
            let class = class_of(shape.figure).0;
            let (x, end) = (N(shape.x), N(shape.x + shape.width));
            let _ = writeln!(out, "<path class=\"shape {class} inner sign\" d=\"M{x} {}H{end}\"/>", N(line));
            y += RULE;
        }
        let id = Text(detail.id.as_deref().unwrap_or_default());
        let (x, width) = (N(left - 6.0), N(right - left + 12.0));
        let _ = writeln!(
            out,
            "<g data-shape=\"{id}\"><rect class=\"row\" x=\"{x}\" y=\"{}\" width=\"{width}\" height=\"14\" rx=\"3\"/>\
             <text class=\"small start\" x=\"{}\" y=\"{}\">{text}</text>\
             <text class=\"small end\" x=\"{}\" y=\"{}\">{}</text></g>",
            N(y - 10.5),
            N(left),
            N(y),
            N(right),
            N(y),
            Text(time)
        );
        y += SMALL_LEADING;
    }
}

/// The class of a rectangle and how round its corners are.
fn class_of(figure: Figure) -> (&'static str, f64) {
    match figure {
        Figure::Block => ("instance", 8.0),
        Figure::Component => ("component", 4.0),
        Figure::Channel => ("channel", f64::INFINITY),
        Figure::Device => ("device", 4.0),
        _ => ("action", 3.0),
    }
}

/// The sign of a component, as UML has it; its right upper corner lies there.
fn icon(out: &mut String, right: f64, top: f64) {
    let rect = |x: f64, y: f64, w: f64, h: f64| format!("M{} {}h{}v{}h{}Z", N(x), N(y), N(w), N(h), N(-w));
    let d = rect(right - 9.0, top, 9.0, 11.0)
        + &rect(right - 11.5, top + 2.0, 5.0, 2.4)
        + &rect(right - 11.5, top + 6.4, 5.0, 2.4);
    let _ = writeln!(out, "<path class=\"shape component sign\" d=\"{d}\"/>");
}
