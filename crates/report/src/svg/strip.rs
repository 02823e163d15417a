//! A strip: boxes for the spans of a track, or, when they would be finer than the eye, how the time divides among
//! the kinds, stacked column by column. SYNC(drawing)

use crate::lanes::Strip;
use crate::markup::{Px, Text, put};
use crate::svg::columns::columns;
use crate::svg::text_width;
use crate::svg::view::{View, box_path};
use crate::time::TimeBase;
use crate::tone::Tone;
use crate::track::Span;

/// Spans narrower than this on average are stacked.
const FINE: f64 = 2.2;
/// Size of the words in boxes.
const WORDS: f64 = 10.5;

/// Draws a strip; with `told`, each box has a title in words.
pub(crate) fn strip(out: &mut String, strip: &Strip, view: &View, told: Option<(&str, TimeBase)>) {
    let spans = strip.track.within(view.start, view.end);
    let Some((first, last)) = spans.first().zip(spans.last()) else { return };
    let drawn = view.clamped(last.end) - view.clamped(first.start);
    if drawn / (spans.len() as f64) < FINE {
        stacked(out, strip, view);
    } else if let Some((lane, time)) = told {
        titled(out, strip, spans, view, lane, time);
    } else {
        merged(out, strip, spans, view);
    }
    if !strip.full && drawn / (spans.len() as f64) >= FINE {
        words(out, strip, spans, view);
    }
}

/// Where a span's box lies: x, y, width, height.
pub(crate) fn span_box(strip: &Strip, span: Span, view: &View) -> (f64, f64, f64, f64) {
    let (from, to) = (view.clamped(span.start), view.clamped(span.end));
    let tone = strip.track.kind(span).tone;
    let height = if strip.full { strip.height } else { strip.height * tone.height() };
    // A hair of paper between boxes that are wide enough to spare it.
    let hair = if to - from > 4.0 { 0.6 } else { 0.0 };
    (from, strip.y + (strip.height - height) / 2.0, to - from - hair, height)
}

fn drawn<'a>(strip: &'a Strip, spans: &'a [Span]) -> impl Iterator<Item = (Span, Tone)> + 'a {
    spans.iter().map(|span| (*span, strip.track.kind(*span).tone)).filter(|(_, tone)| *tone != Tone::Idle)
}

fn titled(out: &mut String, strip: &Strip, spans: &[Span], view: &View, lane: &str, time: TimeBase) {
    for (span, tone) in drawn(strip, spans) {
        let (x, y, width, height) = span_box(strip, span, view);
        put!(
            out,
            "<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">",
            tone.name(),
            Px(x),
            Px(y),
            Px(width),
            Px(height)
        );
        put!(
            out,
            "<title>{}: {}, {}\u{2013}{}</title></rect>\n",
            Text(lane),
            Text(&strip.track.kind(span).label),
            time.bare(span.start as i64),
            time.show(span.end)
        );
    }
}

fn merged(out: &mut String, strip: &Strip, spans: &[Span], view: &View) {
    for tone in Tone::ALL.into_iter().chain([Tone::Undef]) {
        let mut path = String::new();
        for (span, _) in drawn(strip, spans).filter(|(_, found)| *found == tone) {
            let (x, y, width, height) = span_box(strip, span, view);
            box_path(&mut path, x, y, width, height);
        }
        put_path(out, tone, &path);
    }
}

fn put_path(out: &mut String, tone: Tone, path: &str) {
    if !path.is_empty() {
        put!(out, "<path class=\"{}\" d=\"{path}\"/>\n", tone.name());
    }
}

fn stacked(out: &mut String, strip: &Strip, view: &View) {
    let columns = columns(strip.track, view, strip.rhythm);
    let mut base = vec![strip.y + strip.height; columns.len()];
    for (place, tone) in Tone::ALL.into_iter().enumerate().filter(|(_, tone)| *tone != Tone::Idle) {
        let mut path = String::new();
        for (column, base) in columns.iter().zip(&mut base).filter(|(column, _)| column.shares[place] > 0.001) {
            let height = column.shares[place].min(1.0) * strip.height;
            *base -= height;
            let place = |tick: f64| view.left + (tick - view.start as f64) * view.scale();
            box_path(&mut path, place(column.from), *base, place(column.to) - place(column.from), height);
        }
        put_path(out, tone, &path);
    }
}

/// The words of those boxes that have room for them.
fn words(out: &mut String, strip: &Strip, spans: &[Span], view: &View) {
    for (span, tone) in drawn(strip, spans) {
        let label = &strip.track.kind(span).label;
        let (x, _, width, _) = span_box(strip, span, view);
        // Its box is too low for words.
        if tone != Tone::Undef && width >= text_width(label, WORDS) + 10.0 {
            let y = strip.y + strip.height / 2.0 + 3.6;
            put!(
                out,
                "<text class=\"word on-{}\" x=\"{}\" y=\"{}\">{}</text>\n",
                tone.name(),
                Px(x + 5.0),
                Px(y),
                Text(label)
            );
        }
    }
}
