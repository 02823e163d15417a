//! A value over time as a line with a pale area below it. SYNC(drawing)

use crate::lanes::Graph;
use crate::markup::{Px, Text, put};
use crate::svg::view::View;
use crate::time::TimeBase;
use crate::track::Curve;

/// With more pieces in a pixel than this, their extremes are drawn.
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
    for (from, first, to, last) in pieces {
        let value = |x: f64| first + (last - first) * if to > from { (x - from) / (to - from) } else { 0.0 };
        let mut x = from.floor();
        // A long piece among short ones fills all its columns.
        while x < *to {
            let (a, b) = (value(x.max(*from)), value((x + 1.0).min(*to)));
            let (low, high) = (a.min(b), a.max(b));
            match columns.last_mut() {
                Some(column) if column.0 == x => (column.1, column.3) = (column.1.min(low), column.3.max(high)),
                _ => columns.push((x, low, x + 1.0, high)),
            }
            x += 1.0;
        }
    }
    columns
}

/// Draws a graph between `y` and `y + height`.
pub(crate) fn graph(out: &mut String, graph: &Graph, view: &View, y: f64, height: f64, time: TimeBase) {
    let bottom = y + height;
    let place = |value: f64| graph.place(value, y, height);
    let zero = place(0.0);
    let (line, area) = curve_paths(graph.curve, view, zero, &place);
    put!(out, "<path class=\"base\" d=\"M{} {}H{}\"/>\n", Px(view.left), Px(zero), Px(view.right()));
    put!(out, "<path class=\"area\" d=\"{area}\"/>\n<path class=\"curve\" d=\"{line}\"/>\n");
    if let Some(bound) = graph.bound {
        let line = place(bound as f64);
        put!(out, "<path class=\"bound\" d=\"M{} {}H{}\"/>\n", Px(view.left), Px(line), Px(view.right()));
        put!(
            out,
            "<text class=\"boundlabel\" x=\"{}\" y=\"{}\">{}</text>\n",
            Px(view.right()),
            Px(y + 10.0),
            Text(&graph.bound_label)
        );
    }
    let show = |value: i64| if graph.ticks { time.bare(value) } else { value.to_string() };
    let (top, low) = (place(graph.top as f64), if graph.low < 0 { show(graph.low) } else { "0".to_owned() });
    if height > 40.0 {
        put!(
            out,
            "<g class=\"scale\"><text x=\"{x}\" y=\"{}\">{}</text>",
            Px(top + 8.0),
            show(graph.top),
            x = Px(view.left - 6.0)
        );
        put!(out, "<text x=\"{}\" y=\"{}\">{}</text></g>\n", Px(view.left - 6.0), Px(bottom), low);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of a line; their place is the value itself.
    fn corners(line: &str) -> Vec<(f64, f64)> {
        let corner = |pair: &str| {
            let (x, y) = pair.split_once(' ').expect("two numbers");
            (x.parse().expect("a number"), y.parse().expect("a number"))
        };
        line.split(['M', 'L']).filter(|pair| !pair.is_empty()).map(corner).collect()
    }

    /// Random values: what is counted, a truth, what falls below zero; and a time, which grows and falls back.
    fn runs() -> Vec<(Vec<Option<i64>>, bool)> {
        let mut seed = 7u64;
        let mut random = move |below: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) % below
        };
        let mut runs = Vec::new();
        for kind in 0..4 {
            for length in [1, 3, 40, 900] {
                let mut value = 0i64;
                let mut values = Vec::new();
                for _ in 0..length {
                    value = match kind {
                        0 => (value + random(3) as i64 - 1).max(0),
                        1 => random(2) as i64,
                        2 => value + random(5) as i64 - 2,
                        _ if random(9) == 0 => random(4) as i64,
                        _ => value + 1,
                    };
                    values.push((random(20) > 0).then_some(value));
                }
                runs.push((values, kind == 3));
            }
        }
        runs
    }

    #[test]
    fn no_corner_is_a_value_that_the_run_did_not_have() {
        for (values, of_time) in runs() {
            let mut curve = if of_time { Curve::of_time() } else { Curve::default() };
            values.iter().enumerate().for_each(|(tick, value)| curve.push(tick as u64, *value));
            let end = values.len() as u64;
            for (from, to, width) in [(0, end, 5_000.0), (0, end, 60.0), (end / 3, end / 2 + 1, 900.0)] {
                let view = View::plain(from, to, width);
                let (line, _) = curve_paths(&curve, &view, 0.0, &|value| value);
                let crowded = width < end as f64;
                for (x, y) in corners(&line) {
                    if of_time && crowded {
                        // Between two ticks a time is between their values.
                        let known = || values.iter().flatten().map(|value| *value as f64);
                        assert!(known().fold(f64::MAX, f64::min) <= y && y <= known().fold(f64::MIN, f64::max));
                    } else {
                        assert!(values.iter().flatten().any(|value| *value as f64 == y), "{y} at {x}: {values:?}");
                    }
                }
                if crowded || of_time {
                    continue;
                }
                // Within a tick the line is level at the tick's value, or there is no line.
                let corners = corners(&line);
                for tick in from..to {
                    let x = view.x(tick) + view.scale() / 2.0;
                    let level =
                        corners.windows(2).find(|pair| pair[0].1 == pair[1].1 && pair[0].0 <= x && x <= pair[1].0);
                    let drawn = level.map(|pair| pair[0].1 as i64);
                    assert!(
                        drawn == values[tick as usize] || values[tick as usize].is_none(),
                        "tick {tick}: {values:?}"
                    );
                }
            }
        }
    }
}
