//! Reads a system: resolves names, converts times to ticks, chooses the master of each buffer.
//!
//! The master of a swinging buffer is chosen as in the paper's section V-B: of two synchronous components the slower
//! one, of a mixed pair the asynchronous one. If the two do not differ in this, the chart must name the master.

use syntax::ast::{self, AstNode, PhaseKind};
use syntax::{Diagnostic, Severity, Span, SyntaxKind, SyntaxToken};

use super::Reader;
use super::link::{flat, link, names_function};
use super::machine::spoken;
use crate::build::system::{busy, taken};
use crate::system::{
    Action, AgeBound, Awaited, Channel, ChannelKind, Component, Device, FreshBound, Named, Phase, System, Timing,
    Tolerance, length,
};
use crate::{fault, times, ways};

/// The default length of a step: a millisecond.
const TICK_NS: u64 = 1_000_000;

/// LIMIT: the longest time of a chart, in nanoseconds.
const DAY_NS: f64 = 86_400e9;

/// LIMIT: the most cycles among which missed deadlines are counted.
const WINDOW: u64 = 1_000;

impl Reader {
    pub(super) fn system(&mut self, node: &ast::SystemChart) -> Option<System> {
        let name = node.name()?;
        let mut ticks = node.ticks();
        let first = ticks.next();
        let tick = first.as_ref().and_then(ast::Tick::quantity);
        let tick_ns = match tick.as_ref().map(|quantity| (quantity, self.nanoseconds(quantity))) {
            Some((quantity, Some(0))) => {
                self.faults.push(fault::no_tick(Span::new(self.file, quantity.range())));
                TICK_NS
            }
            Some((_, Some(tick_ns))) => tick_ns,
            Some((_, None)) | None => TICK_NS,
        };
        for second in ticks {
            let place = |tick: &ast::Tick| Span::new(self.file, tick.range());
            let first = first.as_ref().map_or_else(|| self.span(&name), place);
            self.faults.push(fault::stated_twice(place(&second), "tick", first));
        }
        let mut system = System {
            name: name.text().to_string(),
            text: node.text().unwrap_or_else(|| spoken(name.text())),
            tick_ns,
            processors: None,
            bounds: Vec::new(),
            components: Vec::new(),
            channels: Vec::new(),
            devices: Vec::new(),
            connections: Vec::new(),
            computing: Default::default(),
            span: self.span(&name),
        };
        let components: Vec<ast::Component> =
            node.components().filter(|component| component.name().is_some()).collect();
        for component in &components {
            self.component(component, &mut system);
        }
        for channel in node.channels() {
            self.channel(&channel, &mut system);
        }
        for (index, component) in components.iter().enumerate() {
            self.phases(index, component, &mut system);
        }
        for index in 0..system.channels.len() {
            self.ends(index, &system);
        }
        if self.faults.iter().all(|fault| fault.severity != Severity::Error) {
            self.circular_waits(&system);
        }
        let components = system.components.iter().map(|component| (&component.name, component.span));
        let channels = system.channels.iter().map(|channel| (&channel.name, channel.span));
        let phases = system.components.iter().flat_map(|component| &component.phases);
        for (name, span) in components.chain(channels).chain(phases.map(|phase| (&phase.name, phase.span))) {
            self.function_name(name, span);
        }
        // A channel called `r` would have the lock `r_lock`, which is the name of a rule.
        let buffers = system.channels.iter().filter(|channel| matches!(channel.kind, ChannelKind::Buffer { .. }));
        let locks = buffers.map(|channel| (&channel.name, "lock", channel.span));
        let tasks = system.components.iter().map(|component| (&component.name, "task", component.span));
        for (name, part, span) in locks.chain(tasks).filter(|(name, ..)| names_function(name)) {
            self.function_name(&format!("{name}_{part}"), span);
        }
        for device in node.devices() {
            let Some(name) = device.name() else { continue };
            system.devices.push(Device {
                text: device.text().unwrap_or_else(|| spoken(name.text())),
                is_sensor: device.is_sensor(),
                message: self.message(device.message()),
                span: self.span(&name),
                name: name.text().to_string(),
            });
        }
        for connection in node.connections() {
            let (Some(from), Some(to)) = (connection.from(), connection.to()) else { continue };
            for end in [&from, &to] {
                let component = system.components.iter().any(|component| component.name == end.text());
                if !component && !system.devices.iter().any(|device| device.name == end.text()) {
                    self.faults.push(fault::unknown(self.span(end), "component or device", end.text(), &[]));
                }
            }
            system.connections.push((from.text().to_string(), to.text().to_string()));
        }
        self.processors(node, &mut system);
        for bound in node.age_bounds() {
            self.age_bound(&bound, &mut system);
        }
        if self.faults.is_empty() {
            self.long_cycles(&system);
        }
        if !self.faults.iter().any(|fault| fault.severity == Severity::Error) {
            self.faults.extend(times::faults(&system));
        }
        Some(system)
    }

    fn processors(&mut self, node: &ast::SystemChart, system: &mut System) {
        for stated in node.processors() {
            let span = Span::new(self.file, stated.range());
            let number = stated.number().and_then(|number| number.text().parse::<u64>().ok());
            match (system.processors, number) {
                (Some((_, first)), _) => self.faults.push(fault::stated_twice(span, "processors", first)),
                (None, Some(0)) => self.faults.push(fault::times::no_processor(span)),
                (None, Some(number)) => system.processors = Some((number, span)),
                (None, None) => {}
            }
        }
    }

    fn age_bound(&mut self, node: &ast::AgeBound, system: &mut System) {
        let (Some(quantity), Some(from), Some(to)) = (node.quantity(), node.from(), node.to()) else { return };
        let span = Span::new(self.file, node.range());
        let limit = self.ticks(&quantity, system.tick_ns);
        let mut known: Vec<&str> = system.components.iter().map(|component| component.name.as_str()).collect();
        known.extend(system.devices.iter().map(|device| device.name.as_str()));
        let mut strangers = false;
        for end in [&from, &to] {
            if !known.contains(&end.text()) {
                strangers = true;
                self.faults.push(fault::unknown(self.span(end), "component or device", end.text(), &known));
            }
        }
        let named = |token: &SyntaxToken, span| Named { text: token.text().to_string(), span };
        let end = |token: &SyntaxToken| named(token, self.span(token));
        let number = system.bounds.len();
        let bound = AgeBound { number, limit, from: end(&from), to: end(&to), way: None, span };
        let device = |name: &str| system.devices.iter().find(|device| device.name == name);
        let reason = match (device(from.text()), device(to.text())) {
            _ if strangers => None,
            (Some(device), _) if !device.is_sensor => Some(format!("`{}` is an actuator", device.name)),
            (_, Some(device)) if device.is_sensor => Some(format!("`{}` is a sensor", device.name)),
            _ => match ways::ways(system, &bound).len() {
                0 => Some("no channels connect them".to_string()),
                count if count > ways::WAYS => {
                    self.faults.push(fault::times::many_ways(span, ways::WAYS));
                    None
                }
                _ => None,
            },
        };
        if let Some(reason) = reason {
            self.faults.push(fault::times::no_way(span, from.text(), to.text(), &reason));
        }
        system.bounds.push(bound);
    }

    /// Reports cycles that take too long even without waiting.
    fn long_cycles(&mut self, system: &System) {
        for component in &system.components {
            let Timing::Synchronous { period, deadline, .. } = component.timing else { continue };
            let Some(available) = component.available() else { continue };
            let (time_until, word) = if deadline < period { (deadline, "deadline") } else { (period, "period") };
            let jitter = component.timing.jitter();
            let whole = busy(system, component) + jitter;
            if whole <= available {
                continue;
            }
            let shown = |ticks: u64| length(ticks as i64, system.tick_ns);
            let parts = component.phases.iter().map(|phase| {
                let time = taken(system, component, phase);
                let lock = if time > phase.time { " with its lock" } else { "" };
                format!("{} ({}{lock})", shown(time), phase.subject)
            });
            let parts = parts.chain((jitter > 0).then(|| format!("{} (jitter)", shown(jitter))));
            let sum = match &parts.collect::<Vec<_>>()[..] {
                [one] => one.clone(),
                several => format!("{} = {}", several.join(" + "), shown(whole)),
            };
            let sum = match whole == time_until {
                true => format!("{sum}, and the next one begins a tick after it"),
                false => sum,
            };
            let until = format!("its {word} of {}", shown(time_until));
            let spared: u64 = component.phases.iter().map(|phase| phase.time - phase.least).sum();
            let always = whole - jitter - spared > available;
            // How many cycles take too long is for the verification.
            if component.tolerance.is_some() && !always {
                continue;
            }
            self.faults.push(fault::long_cycle(component.span, &component.name, always, &sum, &until));
        }
    }

    /// A length of time in nanoseconds.
    fn nanoseconds(&mut self, quantity: &ast::Quantity) -> Option<u64> {
        let number = quantity.number()?;
        self.measure(quantity, &number)
    }

    /// A number of a length of time, in nanoseconds.
    fn measure(&mut self, quantity: &ast::Quantity, number: &SyntaxToken) -> Option<u64> {
        let unit = quantity.unit()?;
        let Some(scale) = quantity.unit_ns() else {
            self.faults.push(fault::times::unknown_unit(self.span(&unit), number.text(), unit.text()));
            return None;
        };
        let exact = number.text().parse::<f64>().ok()? * scale as f64;
        let nanoseconds = exact.round();
        let place = Span::new(self.file, quantity.range());
        if nanoseconds > DAY_NS {
            self.faults.push(fault::long_time(place));
            return None;
        }
        // Numbers such as 0.3 have no exact binary form.
        if (exact - nanoseconds).abs() > 1e-9 + exact * 2.0 * f64::EPSILON {
            self.faults.push(fault::fine_time(place));
            return None;
        }
        Some(nanoseconds as u64)
    }

    /// A length of time in ticks.
    fn ticks(&mut self, quantity: &ast::Quantity, tick_ns: u64) -> u64 {
        quantity.number().map_or(1, |number| self.ticks_of(quantity, &number, tick_ns))
    }

    fn ticks_of(&mut self, quantity: &ast::Quantity, number: &SyntaxToken, tick_ns: u64) -> u64 {
        let Some(length) = self.measure(quantity, number) else { return 1 };
        if length % tick_ns != 0 {
            self.faults.push(fault::no_whole_ticks(Span::new(self.file, quantity.range())));
        }
        length / tick_ns
    }

    fn fresh(&mut self, node: &ast::FreshBound, tick_ns: u64) -> Option<FreshBound> {
        let limit = self.ticks(&node.quantity()?, tick_ns);
        Some(FreshBound { limit, span: Span::new(self.file, node.range()) })
    }

    /// The shortest and the longest duration of a phase.
    fn durations(&mut self, phase: &ast::Phase, tick_ns: u64) -> (u64, u64) {
        let Some(quantity) = phase.time() else { return (1, 1) };
        let faults = self.faults.len();
        let least = self.ticks(&quantity, tick_ns);
        let Some(most) = quantity.most() else { return (least, least) };
        let most = self.ticks_of(&quantity, &most, tick_ns);
        let span = Span::new(self.file, quantity.range());
        if phase.kind() != Some(PhaseKind::Elaborate) {
            self.faults.push(fault::fixed_access(span));
        } else if most < least && self.faults.len() == faults {
            self.faults.push(fault::empty_interval(span));
        }
        (least, most)
    }

    fn component(&mut self, node: &ast::Component, system: &mut System) {
        let Some(name) = node.name() else { return };
        let span = self.span(&name);
        if let Some(first) = system.components.iter().find(|first| first.name == name.text()) {
            self.faults.push(fault::duplicate(span, "component", name.text(), first.span));
        }
        let kind = node.kind();
        let tolerance = kind.as_ref().and_then(ast::ComponentKind::tolerance).and_then(|one| self.tolerance(&one));
        let timing = match kind.filter(ast::ComponentKind::is_synchronous) {
            Some(kind) => {
                let mut length =
                    |word: SyntaxKind| kind.quantity(word).map(|quantity| self.ticks(&quantity, system.tick_ns));
                let stated = length(SyntaxKind::PERIOD_KW);
                let period = stated.unwrap_or(1).max(1);
                let jitter = length(SyntaxKind::JITTER_KW);
                let offset = length(SyntaxKind::OFFSET_KW).unwrap_or(0);
                let deadline = length(SyntaxKind::DEADLINE_KW).unwrap_or(period);
                let place = |word: SyntaxKind| {
                    let quantity = kind.quantity(word)?;
                    Some(Span::new(self.file, quantity.range()))
                };
                // Less than a tick is a fault of its own.
                let is_told =
                    |place: Span, faults: &[Diagnostic]| faults.iter().any(|fault| fault.primary.span == place);
                if let (Some(jitter), Some(place)) = (jitter, place(SyntaxKind::JITTER_KW)) {
                    let fault = match jitter {
                        0 => Some(fault::times::no_jitter(place)),
                        _ if jitter > period => Some(fault::times::long_jitter(place)),
                        _ => None,
                    };
                    self.faults.extend(fault.filter(|_| !is_told(place, &self.faults)));
                }
                if let (Some(0), Some(place)) = (stated, place(SyntaxKind::PERIOD_KW)) {
                    if !is_told(place, &self.faults) {
                        self.faults.push(fault::times::no_period(place));
                    }
                } else if offset > period {
                    self.faults.extend(place(SyntaxKind::OFFSET_KW).map(fault::times::late_offset));
                }
                Timing::Synchronous { period, jitter: jitter.unwrap_or(0).min(period), offset, deadline }
            }
            None => {
                let jitter = node.kind().and_then(|kind| kind.quantity(SyntaxKind::JITTER_KW));
                if let Some(quantity) = jitter {
                    let place = Span::new(self.file, quantity.range());
                    self.faults.push(fault::times::no_period_of_jitter(place, name.text()));
                }
                Timing::Asynchronous { awaits: Awaited::default() }
            }
        };
        system.components.push(Component {
            text: node.text().unwrap_or_else(|| spoken(name.text())),
            name: name.text().to_string(),
            timing,
            tolerance,
            phases: Vec::new(),
            span,
        });
    }

    fn tolerance(&mut self, node: &ast::Tolerance) -> Option<Tolerance> {
        let number = |token: Option<SyntaxToken>| token.and_then(|token| token.text().parse::<u64>().ok());
        let (missed, cycles) = (number(node.missed())?, number(node.cycles())?);
        let span = Span::new(self.file, node.range());
        if missed >= cycles {
            self.faults.push(fault::times::all_missed(span, missed, cycles));
        } else if cycles > WINDOW {
            self.faults.push(fault::times::long_window(span, WINDOW));
        }
        Some(Tolerance { missed, cycles, span })
    }

    fn component_named(&mut self, name: Option<SyntaxToken>, system: &System) -> Option<usize> {
        let name = name?;
        let found = system.components.iter().position(|component| component.name == name.text());
        if found.is_none() {
            let known: Vec<&str> = system.components.iter().map(|component| component.name.as_str()).collect();
            self.faults.push(fault::unknown(self.span(&name), "component", name.text(), &known));
        }
        found
    }

    /// The channels that are drawn as one of that name; one for each reader.
    fn channels_named(&mut self, name: &SyntaxToken, system: &System) -> Vec<usize> {
        let is_drawn = |index: &usize| system.channels[*index].drawn == name.text();
        let found: Vec<usize> = (0..system.channels.len()).filter(is_drawn).collect();
        if found.is_empty() && !self.broken.iter().any(|broken| broken == name.text()) {
            let known: Vec<&str> = system.channels.iter().map(|channel| channel.drawn.as_str()).collect();
            self.faults.push(fault::unknown(self.span(name), "channel", name.text(), &known));
        }
        found
    }

    /// The channel of that name that this component reads; a channel of it that others read, if there is none.
    pub(super) fn channel_read(&mut self, name: &SyntaxToken, reader: usize, system: &System) -> Option<usize> {
        let found = self.channels_named(name, system);
        found.iter().find(|channel| system.channels[**channel].to == reader).or(found.first()).copied()
    }

    fn channel(&mut self, node: &ast::Channel, system: &mut System) {
        let Some(name) = node.name() else { return };
        let span = self.span(&name);
        if let Some(first) = system.channels.iter().find(|first| first.drawn == name.text()) {
            self.faults.push(fault::duplicate(span, "channel", name.text(), first.span));
        }
        let from = self.component_named(node.from(), system);
        let mut readers: Vec<(usize, Span)> = Vec::new();
        for reader in node.readers() {
            let place = self.span(&reader);
            let Some(to) = self.component_named(Some(reader), system) else { continue };
            match readers.iter().find(|(first, _)| *first == to) {
                Some(_) => {
                    let reason = format!("`{}` is named twice as its reader", system.components[to].name);
                    self.faults.push(fault::channel_ends(place, name.text(), &reason));
                }
                None => readers.push((to, place)),
            }
        }
        let kind = node.kind().filter(|kind| kind.is_buffer() || kind.is_queue() || kind.is_shared());
        let (Some(from), Some(kind)) = (from, kind) else {
            self.broken.push(name.text().to_string());
            return;
        };
        let message = self.message(node.message());
        let ends: Vec<usize> = readers.iter().map(|(to, _)| *to).chain([from]).collect();
        let said = kind.master().and_then(|master| self.component_named(Some(master), system));
        if let Some(said) = said.filter(|said| kind.is_buffer() && !ends.contains(said)) {
            let reason = format!("`{}`, its master, neither writes nor reads it", system.components[said].name);
            self.faults.push(fault::channel_ends(span, name.text(), &reason));
        }
        // A number that does not fit is no number of places either.
        let size = kind.size().map_or(2, |size| size.text().parse().unwrap_or(0));
        let place = kind.size().map_or(span, |size| self.span(&size));
        if kind.is_queue() && size == 0 {
            self.faults.push(fault::channel_size(place, name.text(), "a queue has one place at least", "queue 1"));
        }
        if kind.is_buffer() && !ast::ChannelKind::ARRAYS.contains(&size) {
            let reason = "a swinging buffer has two to eight arrays";
            self.faults.push(fault::channel_size(place, name.text(), reason, "swinging buffer 2"));
        }
        let several = readers.len() > 1;
        for (to, _) in readers {
            let kind = if kind.is_queue() {
                ChannelKind::Queue { capacity: size }
            } else if kind.is_buffer() {
                // One reader that is the master says nothing about the buffers of the others.
                let said = said.filter(|said| !several || *said == from || *said == to);
                let master = said.or_else(|| master(from, to, system));
                if master.is_none() {
                    let reader = several.then(|| system.components[to].name.as_str());
                    self.faults.push(fault::channel_master(span, name.text(), reader));
                }
                ChannelKind::Buffer { arrays: size, master: master.unwrap_or(to) }
            } else {
                ChannelKind::Shared
            };
            let (drawn, message) = (name.text().to_string(), message.clone());
            let name = if several { format!("{drawn}_{}", system.components[to].name) } else { drawn.clone() };
            let same = system.channels.iter().find(|first| first.name == name && first.drawn != drawn);
            if let Some(first) = same {
                self.faults.push(fault::second_channel(span, &name, first.span));
            }
            system.channels.push(Channel { name, drawn, from, to, kind, message, span });
        }
    }

    fn phases(&mut self, index: usize, node: &ast::Component, system: &mut System) {
        if let (Timing::Asynchronous { .. }, Some(awaited)) =
            (&system.components[index].timing, node.kind().and_then(|kind| kind.awaits()))
        {
            let awaits = self.awaited(&awaited, index, system);
            system.components[index].timing = Timing::Asynchronous { awaits };
        }
        for phase in node.phases() {
            let (Some(kind), Some(subject)) = (phase.kind(), phase.subject()) else { continue };
            let span = self.span(&subject);
            let owner = system.components[index].name.clone();
            let (actions, word) = match kind {
                PhaseKind::Elaborate => {
                    (vec![Action::Elaborate(phase.link().and_then(|node| link(self.file, &node)))], "")
                }
                PhaseKind::Read => {
                    (self.channel_read(&subject, index, system).into_iter().map(Action::Read).collect(), "read_")
                }
                PhaseKind::Write => {
                    (self.channels_named(&subject, system).into_iter().map(Action::Write).collect(), "write_")
                }
            };
            let end = match actions.first() {
                Some(Action::Read(channel)) => Some(system.channels[*channel].to),
                Some(Action::Write(channel)) => Some(system.channels[*channel].from),
                Some(Action::Elaborate(_)) => None,
                None => continue,
            };
            if end.is_some_and(|end| end != index) {
                let reason = format!("the component `{owner}` is not at this end of it");
                self.faults.push(fault::channel_ends(span, subject.text(), &reason));
            }
            let drawn = match phase.name() {
                Some(name) => name.text().to_string(),
                None => format!("{owner}_{word}{}", subject.text()),
            };
            let (least, time) = self.durations(&phase, system.tick_ns);
            let fresh = phase.fresh().and_then(|bound| self.fresh(&bound, system.tick_ns));
            let machine = phase.machine().map(|name| Named { text: name.text().to_string(), span: self.span(&name) });
            let several = actions.len() > 1;
            for action in actions {
                let name = match &action {
                    Action::Write(channel) if several => {
                        format!("{drawn}_{}", system.components[system.channels[*channel].to].name)
                    }
                    Action::Write(_) | Action::Read(_) | Action::Elaborate(_) => drawn.clone(),
                };
                let all = system.components.iter().flat_map(|component| &component.phases);
                if let Some(first) = all.into_iter().find(|first| first.name == name) {
                    self.faults.push(fault::duplicate(span, "phase", &name, first.span));
                }
                let (drawn, subject, machine) = (drawn.clone(), subject.text().to_string(), machine.clone());
                let phase = Phase { name, drawn, subject, action, time, least, fresh, machine, span };
                system.components[index].phases.push(phase);
            }
        }
    }

    fn message(&self, domain: Option<ast::Domain>) -> Option<Named> {
        let domain = domain?;
        Some(Named { text: flat(domain.syntax()), span: Span::new(self.file, domain.range()) })
    }

    /// Checks that a channel is written and read.
    fn ends(&mut self, index: usize, system: &System) {
        let channel = &system.channels[index];
        let does = |component: usize, wanted: &Action| {
            system.components[component].phases.iter().filter(|phase| phase.action == *wanted).count()
        };
        // What several readers get is written by one phase of the text.
        let is_first = system.channels[..index].iter().all(|other| other.drawn != channel.drawn);
        if is_first && does(channel.from, &Action::Write(index)) != 1 {
            let reason = "its sender does not write it once a cycle";
            self.faults.push(fault::channel_ends(channel.span, &channel.drawn, reason));
        }
        if does(channel.to, &Action::Read(index)) != 1 {
            let reason = match channel.name == channel.drawn {
                true => "its receiver does not read it once a cycle".to_string(),
                false => format!("`{}` does not read it once a cycle", system.components[channel.to].name),
            };
            self.faults.push(fault::channel_ends(channel.span, &channel.drawn, &reason));
        }
    }
}

/// The master of a swinging buffer; `None` if the chart must name it.
fn master(from: usize, to: usize, system: &System) -> Option<usize> {
    match (system.components[from].timing.period(), system.components[to].timing.period()) {
        (Some(sender), Some(receiver)) if sender > receiver => Some(from),
        (Some(sender), Some(receiver)) if sender < receiver => Some(to),
        (None, Some(_)) => Some(from),
        (Some(_), None) => Some(to),
        _ => None,
    }
}
