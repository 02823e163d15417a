//! The axis of time: round numbers, one set of fine lines through all lanes. SYNC(drawing)

use crate::markup::{Px, put};
use crate::svg::text_width;
use crate::svg::view::View;
use crate::time::TimeBase;

/// The least distance of two labels.
const APART: f64 = 78.0;

/// Ticks between two labels: the finest of 1, 2, 5 × 10ⁿ units that leaves room, or whole ticks.
pub(crate) fn step(view: &View, time: TimeBase) -> f64 {
    let least = APART / view.scale() * time.factor();
    let mut power = 10f64.powf(least.log10().floor());
    let mut unit_step = power;
    for factor in [1.0, 2.0, 5.0, 10.0] {
        unit_step = power * factor;
        if unit_step >= least * 0.999 {
            break;
        }
    }
    power = unit_step / time.factor();
    power.max(1.0)
}

/// Draws labels above y = 0 and lines down to `height`.
pub(crate) fn axis(out: &mut String, view: &View, time: TimeBase, height: f64) {
    let step = step(view, time);
    let mut index = (view.start as f64 / step).ceil() as u64;
    let mut lines = String::new();
    let mut labels = String::new();
    loop {
        let tick = index as f64 * step;
        if tick > view.end as f64 + 1e-6 {
            break;
        }
        let x = view.left + (tick - view.start as f64) * view.scale();
        put!(lines, "M{} -4V{}", Px(x), Px(height));
        let mut label = format!("{:.3}", tick * time.factor());
        label.truncate(label.trim_end_matches('0').trim_end_matches('.').len());
        // A long label at the end stays within the picture.
        let middle = x.min(view.width - text_width(&label, 11.0) / 2.0);
        put!(labels, "<text x=\"{}\" y=\"-9\">{label}</text>", Px(middle));
        index += 1;
    }
    put!(out, "<path class=\"grid\" d=\"{lines}\"/>\n<g class=\"ticks\">{labels}");
    put!(out, "<text class=\"unit\" x=\"{}\" y=\"-9\">{}</text></g>\n", Px(view.left - 26.0), time.unit());
}
