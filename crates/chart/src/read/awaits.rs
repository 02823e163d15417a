//! What asynchronous components await: which channels, and whether something ever comes on them.
//!
//! In: the parts of a chart that say it, and the system so far. Out: [`Awaited`]s, and faults.

use syntax::ast::{self, AstNode};
use syntax::{Span, SyntaxKind};

use super::Reader;
use crate::fault;
use crate::system::{Awaited, Needs, System, Timing};

impl Reader {
    /// What a component awaits.
    pub(super) fn awaited(&mut self, node: &ast::Awaits, reader: usize, system: &System) -> Awaited {
        let mut channels: Vec<usize> = Vec::new();
        for name in node.channels() {
            let Some(channel) = self.channel_read(&name, reader, system) else { continue };
            if system.channels[channel].to != reader {
                self.faults.push(fault::channel_ends(self.span(&name), name.text(), "the component does not read it"));
            }
            match channels.contains(&channel) {
                true => self.faults.push(fault::awaited_twice(self.span(&name), name.text())),
                false => channels.push(channel),
            }
        }
        let quantifier = node.quantifier().map(|word| word.kind());
        if channels.len() > 1 && quantifier.is_none() {
            self.faults.push(fault::awaited_unclear(Span::new(self.file, node.range())));
        }
        let needs = if channels.len() > 1 && quantifier == Some(SyntaxKind::ANY_KW) { Needs::Any } else { Needs::All };
        Awaited { channels, needs }
    }

    /// Tells of components that await each other, so that none of them ever starts.
    pub(super) fn circular_waits(&mut self, system: &System) {
        let starts = starting(system);
        let mut seen = vec![false; system.components.len()];
        for first in 0..system.components.len() {
            let mut way: Vec<usize> = Vec::new();
            let mut at = first;
            // A component that never starts awaits data of another one that never does.
            while !starts[at] && !std::mem::replace(&mut seen[at], true) {
                way.push(at);
                let writers =
                    system.components[at].timing.awaited().iter().map(|channel| system.channels[*channel].from);
                at = writers.into_iter().find(|writer| !starts[*writer]).unwrap_or(at);
            }
            let Some(begin) = way.iter().position(|one| *one == at) else { continue };
            let circle = way[begin..].iter().chain([&at]).map(|one| system.components[*one].name.as_str());
            let circle: Vec<&str> = circle.collect();
            self.faults.push(fault::circular_wait(system.components[at].span, &circle));
        }
    }
}

/// Which components start at some time, if every writer that starts writes.
fn starting(system: &System) -> Vec<bool> {
    let mut starts = vec![false; system.components.len()];
    for _ in 0..system.components.len() {
        let comes = |channel: &usize| starts[system.channels[*channel].from];
        let of = |component: &crate::system::Component| match &component.timing {
            Timing::Synchronous { .. } => true,
            Timing::Asynchronous { awaits } => match awaits.needs {
                Needs::All => awaits.channels.iter().all(comes),
                Needs::Any => awaits.channels.iter().any(comes),
            },
        };
        starts = system.components.iter().map(of).collect();
    }
    starts
}
