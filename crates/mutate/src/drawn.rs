//! Mutants of a chart: an arrow that leads elsewhere, phases in another order, a time that is a tick longer.
//!
//! In: the text of a chart without faults. Out: [`Mutant`]s, each an edit of that text. What bounds times and ages is not mutated: it is part
//! of the judge. Neither are links: what they stand for is mutated in the model. INVARIANT: as in [`crate::mutants`]; no mutant has the text
//! of another one.

use std::collections::BTreeSet;
use std::ops::Range;

use syntax::ast::{
    AstNode, ChannelKind, ChartFile, Component, ComponentKind, MachineChart, PathStop, Phase, PhaseKind, Quantity,
    Shape, SystemChart,
};
use syntax::{FileId, SyntaxKind, SyntaxNode, SyntaxToken};

use crate::edit::Edit;
use crate::mutant::Mutant;
use crate::operator::Operator;

/// LIMIT: so many other shapes, or other channels, are tried for each.
const TRIED: usize = 2;

/// The mutants of a chart.
pub fn chart_mutants(text: &str) -> Vec<Mutant> {
    let parse = syntax::parse_chart(FileId(0), text);
    let Some(file) = ChartFile::cast(parse.syntax()) else { return Vec::new() };
    let mut made = Made { text, mutants: Vec::new() };
    file.machines().for_each(|machine| made.machine(&machine));
    file.systems().for_each(|system| made.system(&system));
    let mut seen = BTreeSet::new();
    made.mutants.retain(|mutant| seen.insert(crate::edit::applied(text, &mutant.edits)));
    made.mutants.sort_by_key(|mutant| (mutant.place.start, mutant.place.end));
    made.mutants
}

struct Made<'t> {
    text: &'t str,
    mutants: Vec<Mutant>,
}

fn range(node: &impl AstNode) -> Range<usize> {
    let range = node.range();
    range.start().into()..range.end().into()
}

fn tokens(node: &SyntaxNode) -> impl Iterator<Item = SyntaxToken> {
    node.children_with_tokens().filter_map(|part| part.into_token())
}

fn range_of(token: &SyntaxToken) -> Range<usize> {
    token.text_range().start().into()..token.text_range().end().into()
}

fn name_of(shape: &Shape) -> Option<String> {
    shape.name().map(|name| name.text().to_string())
}

/// Those that come after an index, and then those before it.
fn around<T: Clone>(all: &[T], index: usize) -> impl Iterator<Item = T> {
    all[index + 1..].iter().chain(&all[..index]).cloned()
}

impl Made<'_> {
    fn add(&mut self, operator: Operator, place: Range<usize>, mut edits: Vec<Edit>) {
        edits.sort_by_key(|edit| edit.range.start);
        self.mutants.push(Mutant { operator, place, edits, function: None });
    }

    /// The blanks at the beginning of a line.
    fn indentation(&self, at: usize) -> &str {
        let start = self.text[..at].rfind('\n').map_or(0, |end| end + 1);
        let line = &self.text[start..];
        &line[..line.len() - line.trim_start_matches([' ', '\t']).len()]
    }

    fn machine(&mut self, machine: &MachineChart) {
        let shapes: Vec<Shape> = machine.shapes().collect();
        for path in machine.paths() {
            let stops: Vec<PathStop> = path.stops().collect();
            for (index, stop) in stops.iter().enumerate().skip(1) {
                self.redirect(&shapes, stop, index + 1 == stops.len());
            }
        }
        for guard in shapes.iter().filter(|shape| matches!(shape, Shape::Guard(_))) {
            self.swap_exits(machine, guard);
        }
        for start in &shapes {
            self.move_start(&shapes, start);
        }
    }

    /// Lets an arrow end at another shape of the same kind.
    fn redirect(&mut self, shapes: &[Shape], stop: &PathStop, is_last: bool) {
        let Some(name) = stop.name() else { return };
        let Some(index) = shapes.iter().position(|shape| name_of(shape).as_deref() == Some(name.text())) else {
            return;
        };
        let kind = std::mem::discriminant(&shapes[index]);
        let others = around(shapes, index).filter(|shape| std::mem::discriminant(shape) == kind);
        let place = range(stop);
        for other in others.filter_map(|shape| name_of(&shape)).take(TRIED) {
            let edit = match is_last {
                true => Edit::new(range_of(&name), other),
                // The arrows that leave the shape stay where they are: another path begins there.
                false => Edit::new(place.start..place.start, format!("{other}\n{}", self.indentation(place.start))),
            };
            self.add(Operator::ArrowRedirected, place.clone(), vec![edit]);
        }
    }

    /// Exchanges the exits of a guard, on all paths.
    fn swap_exits(&mut self, machine: &MachineChart, guard: &Shape) {
        let Some(name) = guard.name() else { return };
        let of_guard = |stop: &PathStop| stop.name().is_some_and(|stop| stop.text() == name.text());
        let stops = machine.paths().flat_map(|path| path.stops()).filter(of_guard);
        let edits = stops.filter_map(|stop| {
            let exit = tokens(stop.syntax()).find_map(|token| match token.kind() {
                SyntaxKind::YES_KW => Some((range_of(&token), "no")),
                SyntaxKind::NO_KW => Some((range_of(&token), "yes")),
                _ => None,
            });
            exit.map(|(range, text)| Edit::new(range, text))
        });
        let edits: Vec<Edit> = edits.collect();
        if !edits.is_empty() {
            self.add(Operator::ExitsSwapped, range(guard), edits);
        }
    }

    /// Lets a machine, or a composite state, begin in another state.
    fn move_start(&mut self, shapes: &[Shape], start: &Shape) {
        let initial = |shape: &Shape| {
            let is_state = matches!(shape, Shape::State(_) | Shape::Composite(_));
            let word = tokens(shape.syntax()).find(|token| token.kind() == SyntaxKind::INITIAL_KW);
            (is_state, word)
        };
        let (true, Some(word)) = initial(start) else { return };
        let level = |shape: &Shape| shape.around().map(|composite| composite.syntax().text_range());
        let Some(index) = shapes.iter().position(|shape| shape.syntax() == start.syntax()) else { return };
        let others = around(shapes, index).filter(|shape| initial(shape).0 && level(shape) == level(start));
        for other in others.take(TRIED) {
            let from = range_of(&word);
            let blank = self.text[from.end..].len() - self.text[from.end..].trim_start().len();
            let at = range(&other).start;
            let edits = vec![Edit::new(from.start..from.end + blank, ""), Edit::new(at..at, "initial ")];
            self.add(Operator::StartMoved, range(start), edits);
        }
    }

    fn system(&mut self, system: &SystemChart) {
        let tick_ns = system.ticks().next().and_then(|tick| tick.quantity()).and_then(|tick| nanoseconds(&tick));
        let tick_ns = tick_ns.unwrap_or(1_000_000);
        for component in system.components() {
            let phases: Vec<Phase> = component.phases().collect();
            for pair in phases.windows(2) {
                let (one, other) = (range(&pair[0]), range(&pair[1]));
                let edits = vec![
                    Edit::new(one.clone(), &self.text[other.clone()]),
                    Edit::new(other.clone(), &self.text[one.clone()]),
                ];
                self.add(Operator::PhasesSwapped, one.start..other.end, edits);
            }
            if let Some(kind) = component.kind() {
                self.periods(&kind, tick_ns);
                self.awaited(&kind);
            }
            for phase in &phases {
                self.duration(phase, tick_ns);
                self.other_channel(system, &component, phase);
            }
        }
        for channel in system.channels() {
            let ends: Vec<String> =
                channel.from().into_iter().chain(channel.readers()).map(|name| name.text().to_string()).collect();
            if let Some(kind) = channel.kind() {
                self.size(&kind);
                self.master(&kind, &ends);
            }
        }
    }

    /// Doubles and halves a period: an odd one would make the time until everything comes again far longer.
    fn periods(&mut self, kind: &ComponentKind, tick_ns: u64) {
        let Some(period) = kind.quantity(SyntaxKind::PERIOD_KW) else { return };
        let Some((number, length)) = period.number().zip(nanoseconds(&period)) else { return };
        let Ok(value) = number.text().parse::<f64>() else { return };
        let deadline = kind.quantity(SyntaxKind::DEADLINE_KW).and_then(|deadline| nanoseconds(&deadline));
        let halves = length % (2 * tick_ns) == 0 && deadline.is_none_or(|deadline| deadline <= length / 2);
        for scaled in [Some(2.0 * value), halves.then_some(value / 2.0)].into_iter().flatten() {
            self.add(Operator::PeriodScaled, range(&period), vec![Edit::new(range_of(&number), shown(scaled))]);
        }
    }

    /// Lets one of several channels be enough, or asks for all of them.
    fn awaited(&mut self, kind: &ComponentKind) {
        let Some(awaits) = kind.awaits().filter(|awaits| awaits.channels().nth(1).is_some()) else { return };
        let Some(word) = awaits.quantifier() else { return };
        let other = if word.kind() == SyntaxKind::ALL_KW { "any" } else { "all" };
        self.add(Operator::AwaitsExchanged, range(&awaits), vec![Edit::new(range_of(&word), other)]);
    }

    /// Makes a phase a tick longer, and a tick shorter.
    fn duration(&mut self, phase: &Phase, tick_ns: u64) {
        let Some(time) = phase.time() else { return };
        for (number, other) in [(time.number(), time.most()), (time.most(), time.number())] {
            let Some((number, unit_ns)) = number.zip(time.unit_ns()) else { continue };
            let Ok(value) = number.text().parse::<f64>() else { continue };
            let step = tick_ns as f64 / unit_ns as f64;
            let ticks = (value / step).round();
            for ticks in [ticks + 1.0, ticks - 1.0] {
                // An interval must stay one.
                let bound = other
                    .as_ref()
                    .and_then(|other| other.text().parse::<f64>().ok())
                    .map(|other| (other / step).round());
                let is_least = time.number().is_some_and(|first| first == number);
                let fits = bound.is_none_or(|bound| if is_least { ticks <= bound } else { ticks >= bound });
                if ticks >= 1.0 && fits {
                    let text = shown(ticks * step);
                    self.add(Operator::DurationShifted, range(&time), vec![Edit::new(range_of(&number), text)]);
                }
            }
        }
    }

    /// Lets a phase read or write another channel of its component.
    fn other_channel(&mut self, system: &SystemChart, component: &Component, phase: &Phase) {
        let (Some(subject), Some(own)) = (phase.subject(), component.name()) else { return };
        let reads = match phase.kind() {
            Some(PhaseKind::Read) => true,
            Some(PhaseKind::Write) => false,
            Some(PhaseKind::Elaborate) | None => return,
        };
        let fitting = system.channels().filter(|channel| match reads {
            true => channel.readers().any(|reader| reader.text() == own.text()),
            false => channel.from().is_some_and(|from| from.text() == own.text()),
        });
        let names: Vec<String> =
            fitting.filter_map(|channel| channel.name()).map(|name| name.text().to_string()).collect();
        let Some(index) = names.iter().position(|name| name == subject.text()) else { return };
        for other in around(&names, index).take(TRIED) {
            // Two phases exchange their channels: each channel must be read and written.
            let verb = if reads { PhaseKind::Read } else { PhaseKind::Write };
            let others = component.phases().filter(|phase| phase.kind() == Some(verb));
            let partner = others.filter_map(|phase| phase.subject()).find(|subject| subject.text() == other);
            let Some(partner) = partner else { continue };
            let edits = vec![Edit::new(range_of(&subject), other), Edit::new(range_of(&partner), subject.text())];
            self.add(Operator::ChannelsExchanged, range(phase), edits);
        }
    }

    /// One array or message more, and one less.
    fn size(&mut self, kind: &ChannelKind) {
        let Some(size) = kind.size() else { return };
        let Ok(value) = size.text().parse::<u64>() else { return };
        for other in [value.checked_add(1), value.checked_sub(1)].into_iter().flatten() {
            let fits = if kind.is_buffer() { ChannelKind::ARRAYS.contains(&other) } else { other > 0 };
            if fits {
                self.add(Operator::SizeShifted, range_of(&size), vec![Edit::new(range_of(&size), other.to_string())]);
            }
        }
    }

    /// Lets the other end be the master.
    fn master(&mut self, kind: &ChannelKind, ends: &[String]) {
        let Some(master) = kind.master() else { return };
        for other in ends.iter().filter(|end| *end != master.text()) {
            let edit = Edit::new(range_of(&master), other.as_str());
            self.add(Operator::MasterExchanged, range_of(&master), vec![edit]);
        }
    }
}

fn nanoseconds(quantity: &Quantity) -> Option<u64> {
    let value: f64 = quantity.number()?.text().parse().ok()?;
    Some((value * quantity.unit_ns()? as f64).round() as u64)
}

/// A number as a chart writes it.
fn shown(value: f64) -> String {
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, operator: Operator, expect: &[&str]) {
        let mutants = chart_mutants(text);
        let made = mutants.iter().filter(|mutant| mutant.operator == operator);
        let lines = made.map(|mutant| crate::edit::changed(text, &mutant.edits).after.join(" | "));
        let lines: Vec<String> = lines.map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
        assert_eq!(lines, expect, "{}", operator.id());
    }

    const LAMP: &str = "chart Lamp\nmachine lamp\n\tcontrol light\n\tinitial state off\n\tstate on\n\tguard pressed\n\taction count\n\t\
        off -> pressed yes -> count -> on\n\ton -> pressed\n\tpressed no -> off\nendmachine\n";

    const PAN: &str = "chart Pan\nsystem pan\n\ttick 0.1 ms\n\tcomponent sense synchronous period 0.5 ms\n\t\telaborate acquire 0.1 ms\n\t\t\
        write position 0.1 ms\n\t\twrite speed 0.2..0.3 ms\n\tendcomponent\n\tcomponent control synchronous period 1 ms\n\t\tread position\n\t\t\
        read speed\n\tendcomponent\n\tchannel position from sense to control swinging buffer 2 master sense\n\tchannel speed from sense to control \
        queue 1\nendsystem\n";

    #[test]
    fn one_of_several_channels_is_enough() {
        let awaiting = |what: &str| {
            PAN.replace(
                "component control synchronous period 1 ms",
                &format!("component control asynchronous awaits {what}"),
            )
        };
        let check = |what: &str, expect: &[&str]| check(&awaiting(what), Operator::AwaitsExchanged, expect);
        check("all position, speed", &["component control asynchronous awaits any position, speed"]);
        check("any position, speed", &["component control asynchronous awaits all position, speed"]);
        check("position", &[]);
        check("all position", &[]);
    }

    #[test]
    fn machines_lead_elsewhere() {
        check(LAMP, Operator::ArrowRedirected, &["off -> pressed yes -> count -> off", "pressed no -> on"]);
        check(LAMP, Operator::ExitsSwapped, &["off -> pressed no -> count -> on | on -> pressed | pressed yes -> off"]);
        check(LAMP, Operator::StartMoved, &["state off | initial state on"]);
    }

    #[test]
    fn systems_take_other_times_and_ways() {
        check(
            PAN,
            Operator::PhasesSwapped,
            &[
                "write position 0.1 ms | elaborate acquire 0.1 ms",
                "write speed 0.2..0.3 ms | write position 0.1 ms",
                "read speed | read position",
            ],
        );
        check(
            PAN,
            Operator::PeriodScaled,
            &[
                "component sense synchronous period 1 ms",
                "component control synchronous period 2 ms",
                "component control synchronous period 0.5 ms",
            ],
        );
        check(
            PAN,
            Operator::DurationShifted,
            &[
                "elaborate acquire 0.2 ms",
                "write position 0.2 ms",
                "write speed 0.3..0.3 ms",
                "write speed 0.1..0.3 ms",
                "write speed 0.2..0.4 ms",
                "write speed 0.2..0.2 ms",
            ],
        );
        check(
            PAN,
            Operator::SizeShifted,
            &[
                "channel position from sense to control swinging buffer 3 master sense",
                "channel speed from sense to control queue 2",
            ],
        );
        check(
            PAN,
            Operator::MasterExchanged,
            &["channel position from sense to control swinging buffer 2 master control"],
        );
        check(PAN, Operator::ChannelsExchanged, &["write speed 0.1 ms | write position 0.2..0.3 ms"]);
    }
}
