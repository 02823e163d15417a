//! How time divides among the tones, column by column, where single spans would be finer than the eye.
//!
//! Columns begin at multiples of their length, so moving the window does not change them. The columns of a task with a
//! short period hold whole periods, so the pattern of the task and that of the columns do not interfere. SYNC(drawing)

use crate::svg::view::View;
use crate::tone::Tone;
use crate::track::Track;

/// Width of a column in pixels, about.
const COLUMN: f64 = 3.0;
/// Periods up to this width are kept whole.
const RHYTHM: f64 = 14.0;

/// A column: where it begins and ends in ticks, and the share of each tone.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Column {
    pub from: f64,
    pub to: f64,
    pub shares: [f64; Tone::ALL.len()],
}

/// The columns of a window; `rhythm` is the period of what is drawn.
pub(crate) fn columns(track: &Track, view: &View, rhythm: Option<u64>) -> Vec<Column> {
    let fine = COLUMN / view.scale();
    let length = match rhythm.map(|ticks| ticks as f64) {
        Some(period) if period * view.scale() <= RHYTHM => period * (fine / period).ceil(),
        _ => fine,
    };
    let (start, end) = (view.start as f64, view.end as f64);
    let first = (start / length).floor();
    let count = ((end / length).ceil() - first).max(1.0) as usize;
    let column = |index: usize| Column {
        from: ((first + index as f64) * length).max(start),
        to: ((first + index as f64 + 1.0) * length).min(end),
        shares: [0.0; Tone::ALL.len()],
    };
    let mut columns: Vec<Column> = (0..count).map(column).collect();
    for span in track.within(view.start, view.end) {
        let (from, to) = (span.start.max(view.start) as f64, span.end.min(view.end) as f64);
        let tone = track.kind(*span).tone;
        let place = Tone::ALL.iter().position(|known| *known == tone).unwrap_or(0);
        let (a, b) = ((from / length).floor() - first, (to / length).ceil() - first);
        for column in columns.iter_mut().take(b as usize).skip(a as usize) {
            let shared = (to.min(column.to) - from.max(column.from)).max(0.0);
            column.shares[place] += shared / (column.to - column.from);
        }
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::Kind;

    #[test]
    fn whole_periods_give_the_same_column() {
        let kind = |tone| Kind { label: String::new(), tone };
        let mut track = Track::new(vec![kind(Tone::Idle), kind(Tone::Work)]);
        (0..1000).for_each(|tick| track.push(tick, Some(u16::from(tick % 5 < 2))));
        let view = View::plain(0, 1000, 300.0);
        let steady = columns(&track, &view, Some(5));
        assert!(steady.iter().all(|column| (column.shares[1] - 0.4).abs() < 1e-9), "{steady:?}");
        let part = columns(&track, &View::plain(3, 500, 300.0), None);
        assert!((part[0].from - 3.0).abs() < 1e-9 && (part[part.len() - 1].to - 500.0).abs() < 1e-9);
        assert!(part.iter().all(|column| (column.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9));
    }
}
