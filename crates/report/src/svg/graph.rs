//! A value over time as a line with a pale area below it. SYNC(drawing)

use crate::lanes::Graph;
use crate::markup::{Px, Text, put};
use crate::svg::view::View;
use crate::time::TimeBase;

/// Draws a graph between `y` and `y + height`.
pub(crate) fn graph(out: &mut String, graph: &Graph, view: &View, y: f64, height: f64, time: TimeBase) {
    let bottom = y + height;
    let place = |value: f64| bottom - (value / graph.top as f64).clamp(0.0, 1.0) * height;
    let mut line = String::new();
    let mut area = String::new();
    let mut at = None;
    for (start, from, end, to) in graph.curve.pieces() {
        if end <= view.start || start >= view.end {
            continue;
        }
        let value = |tick: u64| from as f64 + (to - from) as f64 * (tick - start) as f64 / (end - start) as f64;
        let (first, last) = (start.max(view.start), end.min(view.end));
        let (x1, y1, x2, y2) = (view.x(first), place(value(first)), view.x(last), place(value(last)));
        let joined = at == Some(first);
        put!(line, "{}{} {}L{} {}", if joined { 'L' } else { 'M' }, Px(x1), Px(y1), Px(x2), Px(y2));
        put!(area, "M{} {b}L{} {}L{} {}V{b}z", Px(x1), Px(x1), Px(y1), Px(x2), Px(y2), b = Px(bottom));
        at = Some(last);
    }
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
