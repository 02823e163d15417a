//! Colours by meaning.
//!
//! A [`Tone`] is what a span means to the eye; a report specification gives one to each value. Its colours are in the palette,
//! which people who confuse red and green can tell apart. Meaning never depends on colour
//! alone: tones also differ in height, and words stand where there is room.
//!
//! INVARIANT: every tone has one CSS class, its name, in every drawing.

use std::fmt::Write;

/// What a span means to the eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tone {
    /// Nothing is going on; drawn as the bare line.
    Idle,
    /// Own work.
    Work,
    /// Reading shared data.
    Read,
    /// Writing shared data.
    Write,
    /// Inside a critical section.
    Hold,
    /// Passing messages.
    Message,
    /// Anything else.
    Other,
    /// Waiting for another task: a reader looks for this first.
    Wait,
    /// The place where the next reading will happen.
    ReadPlace,
    /// The place where the next writing will happen.
    WritePlace,
    /// There is no value. No specification names it, and it is no part of a stack.
    Undef,
}

impl Tone {
    /// All tones of values, from the bottom of a stacked drawing to its top.
    pub const ALL: [Tone; 10] = [
        Tone::Idle,
        Tone::Work,
        Tone::Read,
        Tone::Write,
        Tone::Hold,
        Tone::Message,
        Tone::Other,
        Tone::Wait,
        Tone::ReadPlace,
        Tone::WritePlace,
    ];

    /// The tone that a report specification calls by this name.
    pub fn named(name: &str) -> Option<Tone> {
        Tone::ALL.into_iter().find(|tone| tone.name() == name)
    }

    /// Its name, which is its CSS class as well.
    pub fn name(self) -> &'static str {
        match self {
            Tone::Idle => "idle",
            Tone::Work => "work",
            Tone::Read => "read",
            Tone::Write => "write",
            Tone::Hold => "hold",
            Tone::Message => "message",
            Tone::Other => "other",
            Tone::Wait => "wait",
            Tone::ReadPlace => "readplace",
            Tone::WritePlace => "writeplace",
            Tone::Undef => "undef",
        }
    }

    /// The tone for the n-th value that no specification mentions.
    pub fn by_order(n: usize) -> Tone {
        [Tone::Work, Tone::Read, Tone::Write, Tone::Hold, Tone::Message, Tone::Other][n % 6]
    }

    /// The part of a strip's height that a span of this tone fills, from the middle.
    pub fn height(self) -> f64 {
        match self {
            Tone::Idle => 0.0,
            Tone::Undef => 0.24,
            Tone::Work => 0.72,
            Tone::Hold => 0.72,
            Tone::Wait => 1.0,
            _ => 0.86,
        }
    }

    /// What the palette calls its fill; nothing is drawn for an idle task.
    fn fill(self) -> Option<&'static str> {
        match self {
            Tone::Idle | Tone::Undef => None,
            Tone::Wait => Some("late"),
            tone => Some(tone.name()),
        }
    }
}

/// The style sheet of the tones, with names of colours: `.work` fills, `.on-work` is ink on it.
pub(crate) fn tone_css() -> String {
    // The paper hides the line of a lane: there is nothing, not even an idle task.
    let mut sheet =
        ".undef{fill:$paper;background-color:$paper;stroke:$faint;stroke-width:1;stroke-dasharray:1 3}\n".to_owned();
    for tone in Tone::ALL {
        let name = tone.name();
        let _ = match tone.fill() {
            Some(fill) => {
                writeln!(sheet, ".{name}{{fill:${fill};background-color:${fill}}}.on-{name}{{fill:$on-{fill}}}")
            }
            None => writeln!(sheet, ".{name}{{fill:none;background-color:transparent}}.on-{name}{{fill:$ink}}"),
        };
    }
    sheet
}

#[cfg(test)]
mod tests {
    use palette::Paper;

    use super::*;

    /// A colour where equal distances look equally far apart (OKLab).
    fn seen(colour: &str) -> [f64; 3] {
        let part = |at: usize| {
            let share = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).expect("two digits")) / 255.0;
            if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
        };
        let (r, g, b) = (part(1), part(3), part(5));
        let l = (0.412_221 * r + 0.536_333 * g + 0.051_446 * b).cbrt();
        let m = (0.211_903 * r + 0.680_700 * g + 0.107_397 * b).cbrt();
        let s = (0.088_302 * r + 0.281_719 * g + 0.629_979 * b).cbrt();
        [
            0.210_454 * l + 0.793_618 * m - 0.004_072 * s,
            1.977_998 * l - 2.428_592 * m + 0.450_594 * s,
            0.025_904 * l + 0.782_772 * m - 0.808_676 * s,
        ]
    }

    #[test]
    fn tones_are_told_apart_on_light_and_on_dark_paper() {
        let drawn: Vec<Tone> = Tone::ALL.into_iter().filter(|tone| *tone != Tone::Idle).collect();
        for side in [Paper::Light, Paper::Dark] {
            let named = |name: &str| palette::colour(name).expect("a colour of the palette").on(side);
            let colour = |tone: Tone| named(tone.fill().expect("it is drawn"));
            let paper = named("paper");
            let apart = |one: &str, other: &str| {
                let (one, other) = (seen(one), seen(other));
                one.iter().zip(other).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
            };
            for (index, tone) in drawn.iter().enumerate() {
                assert!(apart(colour(*tone), paper) > 0.1, "{tone:?} on {paper}: {}", apart(colour(*tone), paper));
                for other in &drawn[index + 1..] {
                    let distance = apart(colour(*tone), colour(*other));
                    assert!(distance > 0.07, "{tone:?} and {other:?} on {paper}: {distance:.3}");
                }
            }
        }
    }
}
