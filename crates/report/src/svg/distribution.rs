//! How often a length of time occurs, for several runs in one picture: the first one as bars, the others as outlines.
//!
//! The scale is linear, or by decades if the greatest value lies far above the usual ones; unit and bins are the same
//! for all runs, heights are shares of each run's own count.

use crate::markup::{Px, Text, put};
use crate::svg::scale::{Scale, label};
use crate::svg::text_width;
use crate::svg::view::box_path;
use crate::tally::Tally;

const WIDTH: f64 = 340.0;
const HEIGHT: f64 = 150.0;
const LEFT: f64 = 40.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 10.0;
const BASE: f64 = 112.0;
/// Bins of a linear scale, at most.
const BINS: u64 = 32;
/// Bins of a linear scale, at least.
const FEWEST: u64 = 8;
/// A bin is no narrower than the greatest value divided by this.
const FINEST: u64 = 2_000;
/// Bins of a decade.
const PER_DECADE: u32 = 6;
/// The scale is by decades if the greatest value is this many times the median.
const FAR: u64 = 10;

/// The unit for lengths up to this one, and its nanoseconds.
pub(crate) fn unit(most_ns: u64) -> (&'static str, f64) {
    match most_ns {
        0..2_000 => ("ns", 1.0),
        2_000..2_000_000 => ("µs", 1e3),
        2_000_000..5_000_000_000 => ("ms", 1e6),
        _ => ("s", 1e9),
    }
}

/// A length of time in three digits and its own unit.
pub(crate) fn show_ns(ns: u64) -> String {
    let (sign, size) = match ns {
        0 => return "0".to_owned(),
        1..1_000 => ("ns", 1.0),
        1_000..1_000_000 => ("µs", 1e3),
        1_000_000..1_000_000_000 => ("ms", 1e6),
        _ => ("s", 1e9),
    };
    let value = ns as f64 / size;
    let decimals = if value >= 99.95 {
        0
    } else if value >= 9.995 {
        1
    } else {
        2
    };
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{text}\u{202f}{sign}")
}

/// The edges of the bins in nanoseconds, and whether they are by decades.
fn edges(tallies: &[&Tally]) -> (Vec<f64>, bool) {
    let most = tallies.iter().filter_map(|tally| tally.greatest()).map(|(most, _)| most).max().unwrap_or(1).max(1);
    let usual = tallies.iter().filter_map(|tally| tally.percentile(50)).max().unwrap_or(1).max(1);
    if most / usual >= FAR {
        let least = tallies.iter().filter_map(|tally| tally.percentile(1)).min().unwrap_or(1).max(1_000) as f64;
        let (first, last) = (least.min(usual as f64).log10().floor() as i32, (most as f64).log10());
        let count = ((last - f64::from(first)) * f64::from(PER_DECADE)).floor() as u32 + 1;
        let edge = |index: u32| 10f64.powf(f64::from(first) + f64::from(index) / f64::from(PER_DECADE));
        return ((0..=count).map(edge).collect(), true);
    }
    // From zero if that is not far, so lengths can be compared by eye.
    let least = tallies.iter().filter_map(|tally| tally.least()).min().unwrap_or(0);
    let from = if least < most / 2 { 0 } else { least };
    // No finer than its labels: lengths that hardly differ have few bins in the middle of the scale.
    let width = nice((most - from + 1).div_ceil(BINS).max(most / FINEST));
    let (first, count) = (from / width, most / width + 1 - from / width);
    let room = FEWEST.saturating_sub(count);
    let first = if from == 0 { 0 } else { first.saturating_sub(room / 2) };
    ((0..=count.max(FEWEST)).map(|index| ((first + index) * width) as f64).collect(), false)
}

/// The next of 1, 2, 5, 10, 20, …
fn nice(least: u64) -> u64 {
    let powers = std::iter::successors(Some(1u64), |power| power.checked_mul(10));
    powers.flat_map(|power| [1, 2, 5].map(|factor| power.saturating_mul(factor))).find(|w| *w >= least).unwrap_or(least)
}

/// The share of the values in each bin; values below the first edge go into the first bin.
fn shares(tally: &Tally, edges: &[f64]) -> Vec<f64> {
    let mut shares = vec![0.0; edges.len().saturating_sub(1)];
    let all = tally.count().max(1) as f64;
    for (value, count) in tally.counts() {
        let at = edges.partition_point(|edge| *edge <= *value as f64).saturating_sub(1);
        if let Some(share) = shares.get_mut(at) {
            *share += *count as f64 / all;
        }
    }
    shares
}

/// Draws the distributions of several runs; those without a value are left out.
pub(crate) fn distribution(tallies: &[&Tally], title: &str, axis: &str) -> String {
    let (edges, log) = edges(tallies);
    let ends = (edges[0], edges[edges.len() - 1]);
    // By decades the middle is what is usual.
    let usual = tallies.iter().filter_map(|tally| tally.percentile(50)).max().unwrap_or(0);
    let (sign, size) = unit(if log { usual } else { ends.1 as u64 });
    let ends = (ends.0 / size, ends.1 / size);
    let pixels = (LEFT, WIDTH - RIGHT);
    let x = if log { Scale::log(ends, pixels) } else { Scale::linear(ends, pixels) };
    let all: Vec<Vec<f64>> = tallies.iter().map(|tally| shares(tally, &edges)).collect();
    let most = all.iter().flatten().copied().fold(0.0, f64::max).max(1e-6);
    let y = Scale::linear((0.0, most), (BASE, TOP));
    let mut out = String::new();
    put!(
        out,
        "<svg class=\"distribution\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" role=\"img\"><title>{}</title>\n",
        Text(title)
    );
    let (mut lines, mut labels) = (String::new(), String::new());
    for share in y.ticks(34.0) {
        put!(lines, "M{} {}H{}", Px(LEFT), Px(y.place(share)), Px(pixels.1));
        put!(
            labels,
            "<text x=\"{}\" y=\"{}\">{}{}</text>",
            Px(LEFT - 6.0),
            Px(y.place(share) + 3.6),
            label(share * 100.0),
            if share > 0.0 { "\u{202f}%" } else { "" }
        );
    }
    put!(out, "<path class=\"grid\" d=\"{lines}\"/>\n<g class=\"scale\">{labels}</g>\n");
    for (index, shares) in all.iter().enumerate().filter(|(_, shares)| shares.iter().any(|share| *share > 0.0)) {
        let mut path = String::new();
        let mut at = BASE;
        for (bin, share) in shares.iter().enumerate() {
            let (from, to) = (x.place(edges[bin] / size), x.place(edges[bin + 1] / size));
            // Seldom is not never.
            let top = if *share > 0.0 { y.place(*share).min(BASE - 1.2) } else { BASE };
            if index == 0 {
                if *share > 0.0 {
                    box_path(&mut path, from + 0.4, top, (to - from - 0.8).max(0.8), BASE - top);
                }
            } else {
                if bin == 0 {
                    put!(path, "M{} {BASE}V{}", Px(from), Px(top));
                } else if (top - at).abs() > 1e-9 {
                    put!(path, "H{}V{}", Px(from), Px(top));
                }
                at = top;
            }
        }
        if index > 0 {
            put!(path, "H{}V{}", Px(pixels.1), Px(BASE));
        }
        put!(out, "<path class=\"run{index}\" d=\"{path}\"/>\n");
    }
    put!(out, "<path class=\"base\" d=\"M{} {BASE}H{}\"/>\n<g class=\"ticks\">", Px(LEFT), Px(pixels.1));
    // Values below the first edge are in the first bin.
    let below = tallies.iter().any(|tally| tally.least().is_some_and(|least| (least as f64) < edges[0]));
    for (index, value) in x.ticks(46.0).into_iter().enumerate() {
        let text = format!("{}{}", if below && index == 0 { "\u{2264}\u{202f}" } else { "" }, label(value));
        // Within the picture, also at its end.
        let middle = x.place(value).min(WIDTH - text_width(&text, 11.0) / 2.0 - 1.0);
        put!(out, "<text x=\"{}\" y=\"{}\">{text}</text>", Px(middle), Px(BASE + 15.0));
    }
    put!(
        out,
        "<text class=\"unit\" x=\"{}\" y=\"{}\">{} in {sign}</text></g></svg>\n",
        Px(pixels.1),
        Px(BASE + 31.0),
        Text(axis)
    );
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tally(values: &[u64]) -> Tally {
        let mut tally = Tally::default();
        values.iter().for_each(|value| tally.add(*value, 0));
        tally
    }

    #[test]
    fn shares_add_up_in_linear_bins() {
        let tally = tally(&[12_000, 12_500, 13_000, 31_900]);
        let (edges, log) = edges(&[&tally]);
        assert!(!log);
        assert_eq!((edges[0], edges[1], *edges.last().expect("edges")), (0.0, 1_000.0, 32_000.0));
        assert_eq!(edges.len(), 33);
        let shares = shares(&tally, &edges);
        assert_eq!((shares[12], shares[13], shares[31]), (0.5, 0.25, 0.25));
    }

    #[test]
    fn far_values_make_decades() {
        let tally = tally(&[50_000, 60_000, 70_000, 9_000_000]);
        let (edges, log) = edges(&[&tally]);
        assert!(log);
        assert!((edges[0] - 10_000.0).abs() < 1e-6 && *edges.last().expect("edges") > 9_000_000.0, "{edges:?}");
        assert!((shares(&tally, &edges).iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn lengths_that_hardly_differ_have_a_scale_that_can_be_read() {
        for values in [&[300_000_200, 300_000_400][..], &[300_000_000, 300_000_000, 300_000_001], &[7, 7], &[5_000_000]]
        {
            let tally = tally(values);
            let (edges, _) = edges(&[&tally]);
            let shares = shares(&tally, &edges);
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12 && edges.len() > 8, "{values:?}: {edges:?}");
            assert!(values.iter().all(|value| edges[0] <= *value as f64 && (*value as f64) < edges[edges.len() - 1]));
            let drawn = distribution(&[&tally], "", "age");
            let document = roxmltree::Document::parse(&drawn).expect("well-formed");
            let ticks = document.descendants().find(|node| node.attribute("class") == Some("ticks")).expect("ticks");
            let labels: Vec<&str> = ticks.children().filter_map(|node| node.text()).collect();
            let different: std::collections::BTreeSet<&&str> = labels.iter().collect();
            assert!(labels.len() > 1 && different.len() == labels.len(), "{labels:?}");
            assert!(labels[..labels.len() - 1].iter().all(|label| label.len() <= 5), "{labels:?}");
        }
    }

    #[test]
    fn times_have_three_digits() {
        let shown: Vec<String> = [0, 850, 1_500, 58_230, 2_100_000, 1_230_000_000].into_iter().map(show_ns).collect();
        assert_eq!(shown, ["0", "850\u{202f}ns", "1.5\u{202f}µs", "58.2\u{202f}µs", "2.1\u{202f}ms", "1.23\u{202f}s"]);
    }
}
