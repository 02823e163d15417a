//! The run as the script of the page reads it: compact JSON.
//!
//! Spans of a strip are one string: a kind in capitals (A, B, … Z, BA, …) and a length in base 36, `_` standing for a
//! stretch without a span: `A1oB1_5`. Ticks in order are the base-36 differences, separated by blanks. SYNC(run data)
//! with `draw.js`.

use crate::lanes::{Graph, Lane, LineKind, Strip, lanes};
use crate::markup::{Json, Px, put};
use crate::report::{Lights, Report};
use crate::svg::flow_indices;
use crate::track::{Kind, Track};

/// The data of a report.
pub(super) fn run_data(report: &Report) -> String {
    let (lanes, height) = lanes(report);
    let mut kinds: Vec<&Kind> = Vec::new();
    let mut body = String::new();
    for (index, lane) in lanes.iter().enumerate() {
        body.push_str(if index == 0 { "\n" } else { ",\n" });
        put_lane(&mut body, lane, &mut kinds);
    }
    let mut out = String::new();
    let time = report.time;
    put!(out, "{{\"unit\":{},\"factor\":{},\"decimals\":{},", Json(time.unit()), time.factor(), time.decimals());
    // After so many steps is the state that the first tick shows.
    let first = u8::from(!report.from_initial);
    put!(out, "\"first\":{first},\"shown\":{},\"window\":{},", report.shown, report.window);
    put!(out, "\"height\":{},\n\"kinds\":[", Px(height));
    for (index, kind) in kinds.iter().enumerate() {
        put!(out, "{}[{},\"{}\"]", comma(index), Json(&kind.label), kind.tone.name());
    }
    put!(out, "],\n\"lanes\":[{body}]");
    if let Some(flow) = &report.flow {
        put!(out, ",\n\"flow\":{{\"noun\":{},\"lanes\":{:?},\"hops\":[", Json(&flow.noun.0), flow_indices(report));
        for (index, (task, event)) in flow.hops.iter().enumerate() {
            put!(out, "{}{}", comma(index), Json(&format!("{event} by {task}")));
        }
        out.push_str("],\"ways\":[");
        for (index, journey) in flow.journeys.iter().enumerate() {
            put!(out, "{}\"{}\"", comma(index), differences(&journey.times));
        }
        out.push_str("]}");
    }
    if !report.charts.is_empty() {
        out.push_str(",\n\"charts\":[");
        for (index, chart) in report.charts.iter().enumerate() {
            put!(out, "{}{{\"named\":{},\"lights\":[", comma(index), chart.named);
            for (index, lights) in chart.lights.iter().enumerate() {
                put_lights(&mut out, lights, index);
            }
            out.push_str("]}");
        }
        out.push(']');
    }
    out.push_str("}\n");
    out
}

/// Where something was in a picture: its parts, and its spans, whose letters name these parts.
fn put_lights(out: &mut String, lights: &Lights, index: usize) {
    put!(out, "{}{{\"n\":{},\"parts\":[", comma(index), Json(&lights.name));
    for (index, (part, kind)) in lights.parts.iter().zip(&lights.track.kinds).enumerate() {
        put!(out, "{}[{},{}]", comma(index), Json(part), Json(&kind.label));
    }
    out.push_str("],\"d\":\"");
    let names: Vec<String> = (0..lights.parts.len()).map(letters).collect();
    put_spans(out, &lights.track, &names);
    out.push_str("\"}");
}

fn comma(index: usize) -> &'static str {
    if index == 0 { "" } else { "," }
}

fn put_lane<'a>(out: &mut String, lane: &Lane<'a>, kinds: &mut Vec<&'a Kind>) {
    put!(
        out,
        "{{\"n\":{},\"c\":{},\"y\":{},\"h\":{}",
        Json(&lane.name),
        Json(&lane.caption),
        Px(lane.y),
        Px(lane.height)
    );
    if let Some((heading, y)) = lane.heading {
        put!(out, ",\"hd\":[{},{}]", Json(heading), Px(y));
    }
    out.push_str(",\"s\":[");
    for (index, strip) in lane.strips.iter().enumerate() {
        put_strip(out, strip, kinds, index);
    }
    put!(
        out,
        "],\"lk\":\"{}\",\"l\":\"{}\"",
        if lane.line == LineKind::Due { "due" } else { "swap" },
        differences(lane.lines)
    );
    if let Some(deadline) = lane.deadline {
        put!(out, ",\"dl\":{deadline}");
    }
    if !lane.crosses.is_empty() {
        put!(out, ",\"x\":\"{}\"", differences(lane.crosses));
    }
    if let Some(graph) = &lane.graph {
        put_graph(out, graph);
    }
    out.push('}');
}

fn put_strip<'a>(out: &mut String, strip: &Strip<'a>, kinds: &mut Vec<&'a Kind>, index: usize) {
    let track: &'a Track = strip.track;
    let place = |kind: &'a Kind, kinds: &mut Vec<&'a Kind>| {
        kinds.iter().position(|known| *known == kind).unwrap_or_else(|| {
            kinds.push(kind);
            kinds.len() - 1
        })
    };
    let letters: Vec<String> = track.kinds.iter().map(|kind| letters(place(kind, kinds))).collect();
    put!(out, "{}{{\"y\":{},\"h\":{},\"f\":{}", comma(index), Px(strip.y), Px(strip.height), u8::from(strip.full));
    if let Some(rhythm) = strip.rhythm {
        put!(out, ",\"r\":{rhythm}");
    }
    out.push_str(",\"d\":\"");
    put_spans(out, track, &letters);
    out.push_str("\"}");
}

fn put_spans(out: &mut String, track: &Track, letters: &[String]) {
    let mut at = 0;
    for span in track.spans() {
        if span.start > at {
            put!(out, "_{}", base36(span.start - at));
        }
        put!(out, "{}{}", letters[span.kind as usize], base36(span.end - span.start));
        at = span.end;
    }
}

fn put_graph(out: &mut String, graph: &Graph) {
    put!(
        out,
        ",\"g\":{{\"top\":{},\"low\":{},\"head\":{},\"ticks\":{}",
        graph.top,
        graph.low,
        Px(graph.head),
        graph.ticks
    );
    if let Some(bound) = graph.bound {
        put!(out, ",\"bound\":{bound},\"label\":{}", Json(&graph.bound_label));
    }
    out.push_str(",\"p\":[");
    for (index, (start, from, end, to)) in graph.curve.pieces().enumerate() {
        put!(out, "{}{start},{from},{end},{to}", comma(index));
    }
    out.push_str("]}");
}

fn differences(ticks: &[u64]) -> String {
    let mut before = 0;
    let texts: Vec<String> =
        ticks.iter().map(|tick| base36(tick.saturating_sub(std::mem::replace(&mut before, *tick)))).collect();
    texts.join(" ")
}

fn base36(mut n: u64) -> String {
    let mut digits = Vec::new();
    loop {
        digits.push(b"0123456789abcdefghijklmnopqrstuvwxyz"[(n % 36) as usize] as char);
        n /= 36;
        if n == 0 {
            return digits.iter().rev().collect();
        }
    }
}

/// A number in capitals, A for 0.
fn letters(mut n: usize) -> String {
    let mut digits = Vec::new();
    loop {
        digits.push((b'A' + (n % 26) as u8) as char);
        n /= 26;
        if n == 0 {
            return digits.iter().rev().collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(
            (base36(0), base36(35), base36(36), base36(9_999)),
            ("0".into(), "z".into(), "10".into(), "7pr".into())
        );
        assert_eq!((letters(0), letters(25), letters(26)), ("A".into(), "Z".into(), "BA".into()));
        assert_eq!(differences(&[3, 3, 40]), "3 0 11");
    }
}
