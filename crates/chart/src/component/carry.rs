//! The values of data on their way through channels, in the model that verifies a system: where the patterns' data lie, not by number.
//!
//! In: a system whose channels say what they carry. Out: declarations for each of these channels, and the rule that moves the values in
//! each tick. The patterns number their data; the model that is verified forgets the numbers ([`Quotient`]), so values cannot hang on
//! them. INVARIANT: after `moved`, a value lies in the place to which `Quotient` then turns its datum, and places whose data nobody will
//! read hold nothing.
//!
//! [`Quotient`]: ../../../../library/verification/Quotient.asm

use crate::computing::{Computing, Made};
use crate::system::{Channel, ChannelKind, System};

/// What is written next.
pub(super) fn staged(channel: &str) -> String {
    format!("{channel}_atWriter")
}

/// What was read last.
pub(super) fn received(channel: &str) -> String {
    format!("{channel}_atReader")
}

/// What lies in a place of the channel.
fn slot(channel: &str) -> String {
    format!("{channel}_within")
}

/// Of a queue: a message has come since the reader's elaboration before.
pub(super) fn is_new(channel: &str) -> String {
    format!("{channel}_hasCome")
}

/// The channels of which the chart says what they carry.
fn carried(system: &System) -> impl Iterator<Item = (&Channel, &str)> {
    system.channels.iter().filter_map(|channel| Some((channel, channel.message.as_ref()?.text.as_str())))
}

/// Declares where the values lie.
pub(super) fn channels(system: &System, computing: &mut Computing) {
    for (channel, domain) in carried(system) {
        let name = &channel.name;
        let within = match channel.kind {
            ChannelKind::Buffer { .. } => format!("ArrayIndex -> {domain}"),
            ChannelKind::Queue { .. } => format!("QueueSlot -> {domain}"),
            ChannelKind::Shared => domain.to_string(),
        };
        let mut declare = |name: String, of: &str| {
            let text = format!("controlled {name}: {of}\n");
            computing.declarations.push(Made { name, text, span: channel.span });
        };
        declare(staged(name), domain);
        declare(slot(name), &within);
        declare(received(name), domain);
        if let ChannelKind::Queue { .. } = channel.kind {
            declare(is_new(name), "Boolean");
            computing.initial.push(format!("function {} = false\n", is_new(name)));
        }
    }
}

/// A rule around that of a tick, which moves the values as the tick moves the data.
pub(crate) fn moved(system: &System, tick: &str) -> String {
    let (mut numbers, mut arrive, mut leave, mut turn) = (Vec::new(), String::new(), String::new(), String::new());
    for (index, (channel, _)) in carried(system).enumerate() {
        let name = &channel.name;
        let (staged, slot, received) = (staged(name), slot(name), received(name));
        // The numbers of what was written and read last; where that lies; what a turn makes of the places.
        let (written, read, to, from) = match channel.kind {
            ChannelKind::Buffer { .. } => (
                format!("sb_written({name})"),
                format!("sb_receivedSequence({name})"),
                format!("{slot}(sb_writingArray({name}))"),
                format!("{slot}(sb_readingArray({name}))"),
            ),
            ChannelKind::Queue { capacity } => (
                format!("mq_sent({name})"),
                format!("mq_taken({name})"),
                format!("{slot}((mq_sent({name}) - 1) mod {capacity})"),
                format!("{slot}((mq_taken({name}) - 1) mod {capacity})"),
            ),
            ChannelKind::Shared => {
                (format!("sv_sequence({name})"), format!("sv_receivedSequence({name})"), slot.clone(), slot.clone())
            }
        };
        let (w, r) = (format!("$written{index}"), format!("$read{index}"));
        numbers.push(format!("{w} = {written}, {r} = {read}"));
        let new = match channel.kind {
            ChannelKind::Queue { .. } => format!("{} := true\n", is_new(name)),
            ChannelKind::Buffer { .. } | ChannelKind::Shared => String::new(),
        };
        arrive += &format!("if {read} != {r} then\npar\n{received} := {from}\n{new}endpar\nendif\n");
        leave += &format!("if {written} != {w} then\npar\n{to} := {staged}\n{staged} := undef\nendpar\nendif\n");
        turn += &match channel.kind {
            ChannelKind::Buffer { arrays, .. } => format!(
                "forall $n{index} in {{0 : {last}}} with true do\n\
                 let ($m{index} = ($n{index} + indexWrite({name})) mod {arrays}) in\n\
                 {slot}($n{index}) := if isAlive({name}, $m{index}) then {slot}($m{index}) else undef endif\nendlet\n",
                last = arrays - 1
            ),
            ChannelKind::Queue { capacity } => format!(
                "forall $n{index} in {{0 : {last}}} with true do\n\
                 {slot}($n{index}) := if $n{index} < mq_length({name}) then {slot}((mq_taken({name}) + $n{index}) mod {capacity}) \
                 else undef endif\n",
                last = capacity - 1
            ),
            ChannelKind::Shared => {
                format!("{slot} := if sv_isNew({name}) then {slot} else undef endif\n")
            }
        };
    }
    if numbers.is_empty() {
        return tick.to_string();
    }
    format!(
        "let ({}) in\nseq\n{tick}par\n{arrive}endpar\npar\n{leave}endpar\npar\n{turn}endpar\nendseq\nendlet\n",
        numbers.join(", ")
    )
}
