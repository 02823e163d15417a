//! A value over time as a line with a pale area below it. SYNC(drawing)

use crate::lanes::Graph;
use crate::markup::{Px, Text, put};
use crate::svg::view::View;
use crate::time::TimeBase;
use crate::track::Curve;

/// More pieces a pixel than this are drawn by their extremes.
const FINE: f64 = 2.0;

/// A straight piece within a view: x and value of both ends.
type Piece = (f64, f64, f64, f64);

/// The line of a curve, and the area below it. Where pieces are finer than pixels, each column shows their extremes.
pub(crate) fn curve_paths(curve: &Curve, view: &View, bottom: f64, place: &dyn Fn(f64) -> f64) -> (String, String) {
    let seen = curve.pieces().filter(|(start, _, end, _)| *end > view.start && *start < view.end);
    let pieces: Vec<Piece> = seen
        .map(|(start, from, end, to)| {
            let value = |tick: u64| from as f64 + (to - from) as f64 * (tick - start) as f64 / (end - start) as f64;
            let (first, last) = (start.max(view.start), end.min(view.end));
            (view.x(first), value(first), view.x(last), value(last))
        })
        .collect();
    let pieces = if pieces.len() as f64 > FINE * (view.right() - view.left) { extremes(&pieces) } else { pieces };
    let mut line = String::new();
    let mut area = String::new();
    let mut at = f64::MIN;
    for (x1, from, x2, to) in pieces {
        let (y1, y2) = (place(from), place(to));
        put!(line, "{}{} {}L{} {}", if x1 - at < 1e-6 { 'L' } else { 'M' }, Px(x1), Px(y1), Px(x2), Px(y2));
        put!(area, "M{} {b}L{} {}L{} {}V{b}z", Px(x1), Px(x1), Px(y1), Px(x2), Px(y2), b = Px(bottom));
        at = x2;
    }
    (line, area)
}

/// For each pixel column with something in it: from the least to the greatest value.
fn extremes(pieces: &[Piece]) -> Vec<Piece> {
    let mut columns: Vec<Piece> = Vec::new();
    for (x, from, _, to) in pieces {
        let (x, low, high) = (x.floor(), from.min(*to), from.max(*to));
        match columns.last_mut() {
            Some(last) if last.0 == x => (last.1, last.3) = (last.1.min(low), last.3.max(high)),
            _ => columns.push((x, low, x + 1.0, high)),
        }
    }
    columns
}

/// Draws a graph between `y` and `y + height`.
pub(crate) fn graph(out: &mut String, graph: &Graph, view: &View, y: f64, height: f64, time: TimeBase) {
    let bottom = y + height;
    let place = |value: f64| bottom - (value / graph.top as f64).clamp(0.0, 1.0) * height;
    let (line, area) = curve_paths(graph.curve, view, bottom, &place);
    put!(out, "<path class=\"base\" d=\"M{} {}H{}\"/>\n", Px(view.left), Px(bottom), Px(view.right()));
    put!(out, "<path class=\"area\" d=\"{area}\"/>\n<path class=\"curve\" d=\"{line}\"/>\n");
    if let Some(bound) = graph.bound {
        let y = place(bound as f64);
        put!(out, "<path class=\"bound\" d=\"M{} {}H{}\"/>\n", Px(view.left), Px(y), Px(view.right()));
        put!(
            out,
            "<text class=\"boundlabel\" x=\"{}\" y=\"{}\">{}</text>\n",
            Px(view.right()),
            Px(y + 12.0),
            Text(&graph.bound_label)
        );
    }
    let show = |value: i64| if graph.ticks { time.bare(value) } else { value.to_string() };
    let top = place(graph.top as f64);
    if height > 40.0 {
        put!(
            out,
            "<g class=\"scale\"><text x=\"{x}\" y=\"{}\">{}</text>",
            Px(top + 8.0),
            show(graph.top),
            x = Px(view.left - 6.0)
        );
        put!(out, "<text x=\"{}\" y=\"{}\">0</text></g>\n", Px(view.left - 6.0), Px(bottom));
    }
}
