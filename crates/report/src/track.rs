//! What a lane shows over time: spans of something going on, or a value that rises and falls.
//!
//! INVARIANT: the spans of a track are in order, not empty and do not overlap; neighbours differ in kind.
//! INVARIANT: the segments of a curve are in order; each holds from its start to the start of the next one.

use crate::tone::Tone;

/// What a span can be: its words and its tone.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Kind {
    /// In words.
    pub label: String,
    /// For the eye.
    pub tone: Tone,
}

/// The ticks `start..end` in which something of this kind goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Span {
    /// The first tick.
    pub start: u64,
    /// The first tick after it.
    pub end: u64,
    /// Index in [`Track::kinds`].
    pub kind: u16,
}

/// A sequence of spans.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Track {
    /// The kinds of its spans.
    pub kinds: Vec<Kind>,
    spans: Vec<Span>,
}

impl Track {
    /// A track without spans.
    pub fn new(kinds: Vec<Kind>) -> Track {
        Track { kinds, spans: Vec::new() }
    }

    /// The spans in order.
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }

    /// What kind a span is of.
    pub fn kind(&self, span: Span) -> &Kind {
        &self.kinds[span.kind as usize]
    }

    /// In this tick, which follows the last one given, this kind goes on; `None`: nothing to show.
    pub fn push(&mut self, tick: u64, kind: Option<u16>) {
        let Some(kind) = kind else { return };
        match self.spans.last_mut() {
            Some(last) if last.end == tick && last.kind == kind => last.end = tick + 1,
            Some(last) if last.end > tick => {}
            _ => self.spans.push(Span { start: tick, end: tick + 1, kind }),
        }
    }

    /// In these ticks, which follow those given before, this kind goes on; what was given before is kept.
    pub(crate) fn extend(&mut self, start: u64, end: u64, kind: u16) {
        let start = start.max(self.spans.last().map_or(0, |last| last.end));
        if start >= end {
            return;
        }
        match self.spans.last_mut() {
            Some(last) if last.end == start && last.kind == kind => last.end = end,
            _ => self.spans.push(Span { start, end, kind }),
        }
    }

    /// The spans that reach into a window.
    pub fn within(&self, start: u64, end: u64) -> &[Span] {
        let from = self.spans.partition_point(|span| span.end <= start);
        let to = self.spans.partition_point(|span| span.start < end);
        &self.spans[from..to.max(from)]
    }
}

/// A piece of a curve: from `start` on the value is `value`, and changes by `slope` with each further tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Segment {
    /// The first tick.
    pub start: u64,
    /// The value in it; `None` where there is none.
    pub value: Option<i64>,
    /// The change a tick.
    pub slope: i64,
}

/// A value over time, kept without loss in as few segments as it allows.
///
/// A number stands still until it changes: each segment is level. Only a time runs on between two ticks: a curve made
/// by [`Curve::of_time`] takes ±1 in a tick as a slope.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Curve {
    segments: Vec<Segment>,
    end: u64,
    sloped: bool,
}

impl Curve {
    /// The curve of a time: an age, a latency.
    pub fn of_time() -> Curve {
        Curve { sloped: true, ..Curve::default() }
    }

    /// The segments in order.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The first tick after the last one.
    pub fn end(&self) -> u64 {
        self.end
    }

    /// The value in this tick, which follows the last one given.
    pub fn push(&mut self, tick: u64, value: Option<i64>) {
        self.end = tick + 1;
        if let Some(last) = self.segments.last_mut() {
            let ticks = (tick - last.start) as i64;
            match (last.value, value) {
                (None, None) => return,
                (Some(from), Some(to)) if ticks == 1 && self.sloped => {
                    last.slope = to.saturating_sub(from);
                    // A jump is no slope: it begins a segment of its own.
                    if last.slope.abs() <= 1 {
                        return;
                    }
                    last.slope = 0;
                }
                (Some(from), Some(to)) if from.saturating_add(last.slope.saturating_mul(ticks)) == to => return,
                _ => {}
            }
        }
        self.segments.push(Segment { start: tick, value, slope: 0 });
    }

    /// The straight pieces as `(start, value at the start, end, value at the end)`.
    ///
    /// The value of a tick is the one at its end, when its step is done. A ramp is therefore level in its first tick,
    /// because it says nothing about that tick's beginning, and rises from the tick's end on. INVARIANT: both ends of a
    /// piece are values that the curve was given.
    pub fn pieces(&self) -> impl Iterator<Item = (u64, i64, u64, i64)> + '_ {
        self.segments.iter().enumerate().flat_map(|(index, segment)| {
            let end = self.segments.get(index + 1).map_or(self.end, |next| next.start);
            let level = if segment.slope == 0 { end } else { segment.start + 1 };
            let ramp = |value: i64| {
                let ticks = (end - level) as i64;
                (level, value, end, value.saturating_add(segment.slope.saturating_mul(ticks)))
            };
            let first = segment.value.map(|value| (segment.start, value, level, value));
            first.into_iter().chain(segment.value.filter(|_| level < end).map(ramp))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_neighbours_are_one_span() {
        let mut track = Track::new(Vec::new());
        for (tick, kind) in [(0, Some(1)), (1, Some(1)), (2, None), (3, Some(1)), (4, Some(0))] {
            track.push(tick, kind);
        }
        let spans: Vec<_> = track.spans().iter().map(|s| (s.start, s.end, s.kind)).collect();
        assert_eq!(spans, [(0, 2, 1), (3, 4, 1), (4, 5, 0)]);
        assert_eq!(track.within(2, 4).len(), 1);
        assert_eq!(track.within(1, 9).len(), 3);
        assert!(track.within(9, 12).is_empty());
    }

    #[test]
    fn a_sawtooth_takes_one_segment_a_tooth() {
        let mut curve = Curve::of_time();
        for (tick, value) in
            [None, Some(4), Some(5), Some(6), Some(2), Some(3), Some(3), Some(3)].into_iter().enumerate()
        {
            curve.push(tick as u64, value);
        }
        let pieces: Vec<_> = curve.pieces().collect();
        assert_eq!(pieces, [(1, 4, 2, 4), (2, 4, 4, 6), (4, 2, 5, 2), (5, 2, 6, 3), (6, 3, 8, 3)]);
    }

    #[test]
    fn a_number_stands_still_until_it_changes() {
        let mut curve = Curve::default();
        for (tick, value) in [0, 1, 2, 2, 1, 0, 1].into_iter().enumerate() {
            curve.push(tick as u64, Some(value));
        }
        let pieces: Vec<_> = curve.pieces().collect();
        assert_eq!(pieces, [(0, 0, 1, 0), (1, 1, 2, 1), (2, 2, 4, 2), (4, 1, 5, 1), (5, 0, 6, 0), (6, 1, 7, 1)]);
    }
}
