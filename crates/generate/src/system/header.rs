//! Generates the header: hook classes, the plan, and the class of the system with its channels and tasks.

use std::fmt::Write;

use chart::build::busy;
use chart::system::{Action, Channel, ChannelKind, Component, Needs, System, Timing};

use super::bounds::bounds;
use super::cycle::cycle;
use super::machines::{devices, has_messages};
use super::names::{datum, hook, member, pascal};
use super::plan::{Access, Form, access, ends, numbers, ranks, stopping};

/// The text of the header.
pub(super) fn header(system: &System, file: &str, name: &str, form: &Form) -> String {
    let mut text = format!(
        "// Made from {file} by `groundstate generate cpp`; do not edit. Your code is in data.hpp and one file a component.\n\
         //\n// Where the data lie while a component elaborates:\n"
    );
    for channel in &system.channels {
        let _ = writeln!(text, "//   {}", placement(system, channel, form));
    }
    let messages = if has_messages(system) { "#include \"messages.hpp\"\n" } else { "" };
    let _ = write!(
        text,
        "#pragma once\n\n#include <groundstate/program.hpp>\n\n{messages}#include \"../data.hpp\"\n\nnamespace {name} {{\n\n\
         using groundstate::Cycle;\nusing groundstate::Seen;\n"
    );
    for component in &system.components {
        hook_class(&mut text, system, component, form);
    }
    text.push_str("\n/// The user's code. It must outlive the system.\nstruct Hooks {\n");
    for component in &system.components {
        let _ = writeln!(text, "    {}& {};", pascal(&component.name), member(&component.name));
    }
    text.push_str("};\n");
    plan(&mut text, system, form);
    class(&mut text, system, form);
    let _ = writeln!(text, "\n}}  // namespace {name}");
    text
}

fn placement(system: &System, channel: &Channel, form: &Form) -> String {
    let (from, to) = (&system.components[channel.from].name, &system.components[channel.to].name);
    let how = match access(channel, channel.from, form) {
        Access::Message => "messages, copied in and out".to_string(),
        Access::Cell => format!("in the channel's own arrays, of {from} and of {to}; nobody waits"),
        Access::InPlace => {
            format!("in the array of {from}, the master; {to}, who holds the lock to read, reads a copy")
        }
        Access::Copy => format!("in the array of {to}, the master; {from}, who holds the lock to write, brings a copy"),
    };
    format!("{}: {how}", channel.name)
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn hook_class(text: &mut String, system: &System, component: &Component, form: &Form) {
    let when = match &component.timing {
        Timing::Synchronous { period, .. } => format!("every {}", duration(period * system.tick_ns)),
        Timing::Asynchronous { awaits } => {
            let names: Vec<&str> = awaits.channels.iter().map(|channel| &*system.channels[*channel].drawn).collect();
            match (&names[..], awaits.needs) {
                ([], _) => "again and again".to_string(),
                (_, Needs::All) => format!("when there is something new in {}", names.join(" and in ")),
                (_, Needs::Any) => format!("when there is something new in {}", names.join(" or in ")),
            }
        }
    };
    let _ = write!(text, "\n/// {}: {when}.\nstruct {} {{\n", one_line(&component.text), pascal(&component.name));
    let (read, written) = ends(component);
    text.push_str("    struct In {\n");
    for channel in read {
        let name = &system.channels[channel].drawn;
        let _ = writeln!(text, "        Seen<{}> {}{{}};", datum(system, name), member(name));
    }
    let (sensors, actuators) = devices(system, component, form);
    for (device, value) in &sensors {
        let _ = writeln!(text, "        {value} {}{{}};", member(&device.name));
    }
    text.push_str("    };\n    struct Out {\n");
    for channel in system.one_of_each_drawn(written) {
        let name = &system.channels[channel].drawn;
        let _ = writeln!(text, "        {}& {};", datum(system, name), member(name));
    }
    for (device, value) in &actuators {
        let _ = writeln!(text, "        std::optional<{value}>& {};", member(&device.name));
    }
    let _ = write!(text, "    }};\n    virtual ~{}() = default;\n", pascal(&component.name));
    if !sensors.is_empty() {
        text.push_str(
            "    /// Before the sensors are asked, for those that are computed of what was read.\n    \
             virtual void before_sensors(const Cycle& /*cycle*/, const In& /*in*/) {}\n",
        );
    }
    for (device, value) in &sensors {
        let called = hook(&device.name);
        let _ = write!(
            text,
            "    /// What the sensor {} says.\n    virtual {value} {called}(const Cycle& cycle) = 0;\n",
            device.name
        );
    }
    for (device, value) in &actuators {
        let called = hook(&device.name);
        let _ = write!(
            text,
            "    /// Sets the actuator {}.\n    virtual void {called}(const Cycle& cycle, {value} value) = 0;\n",
            device.name
        );
    }
    for phase in component.phases.iter().filter(|phase| matches!(phase.action, Action::Elaborate(_))) {
        let _ = write!(
            text,
            "    /// Returns false if there is nothing to hand over in this cycle. Should end within {}.\n    \
             virtual bool {}(const Cycle& cycle, const In& in, Out& out) = 0;\n",
            duration(phase.time * system.tick_ns),
            hook(&phase.subject)
        );
    }
    text.push_str(
        "    /// Before the tasks start; may allocate.\n    virtual void start() {}\n    \
         /// After all tasks have ended, for whatever reason.\n    virtual void safe_stop() noexcept {}\n};\n",
    );
}

/// A duration, in the unit in which it is shortest.
fn duration(ns: u64) -> String {
    let (scale, unit) = match ns {
        1_000_000_000.. => (1_000_000_000, "s"),
        100_000.. => (1_000_000, "ms"),
        1_000.. => (1_000, "us"),
        _ => (1, "ns"),
    };
    format!("{} {unit}", ns as f64 / scale as f64)
}

fn plan(text: &mut String, system: &System, form: &Form) {
    let _ = write!(
        text,
        "\ninline groundstate::SystemPlan plan() {{\n    return {{\n        .name = \"{}\",\n        .tick_ns = {},\n        \
         .tasks = {{\n",
        system.name, system.tick_ns
    );
    for (component, rank) in system.components.iter().zip(ranks(system)) {
        let (period, offset, deadline) = match component.timing {
            Timing::Synchronous { period, offset, deadline, .. } => (period, offset, deadline),
            Timing::Asynchronous { .. } => (0, 0, 0),
        };
        let jitter = match component.timing.jitter() {
            0 => String::new(),
            jitter => format!(".jitter_ticks = {jitter}, "),
        };
        let awaits = match &component.timing {
            Timing::Asynchronous { awaits } => {
                let said = awaits.said(|channel| &system.channels[channel].name);
                said.map_or(String::new(), |said| format!(", .awaits = \"{}\"", said.trim_start_matches("awaits ")))
            }
            Timing::Synchronous { .. } => String::new(),
        };
        let _ = writeln!(
            text,
            "            {{.name = \"{}\", .period_ticks = {period}, {jitter}.offset_ticks = {offset}, .deadline_ticks = {deadline}, \
             .busy_ticks = {}, .rank = {rank}, .single_phase = {}{awaits}}},",
            component.name,
            busy(system, component),
            component.phases.len() == 1
        );
    }
    let quoted = |names: Vec<&str>| names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let phases = system.components.iter().flat_map(|c| &c.phases).map(|phase| phase.name.as_str());
    let channels = system.channels.iter().map(|channel| channel.name.as_str());
    let components = system.components.iter().map(|component| component.name.as_str());
    // Devices are named in the log only where a machine has to do with them.
    let devices = system.devices.iter().filter(|_| !form.classes.is_empty()).map(|device| device.name.as_str());
    let names = quoted(phases.chain(channels).chain(components).chain(devices).collect());
    let wait_free = system.channels.iter().filter(|c| form.wait_free && matches!(c.kind, ChannelKind::Buffer { .. }));
    let wait_free = quoted(wait_free.map(|channel| channel.name.as_str()).collect());
    let order = stopping(system).iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
    let _ = write!(
        text,
        "        }},\n        .names = {{{names}}},\n        .wait_free = {{{wait_free}}},\n        \
         .safe_stop = {{{order}}},\n{}    }};\n}}\n",
        bounds(system)
    );
}

fn class(text: &mut String, system: &System, form: &Form) {
    let _ = write!(
        text,
        "\n/// {}. Built before its tasks start; see `run` of the base class.\n\
         template <groundstate::Clock C>\nclass System final : public groundstate::SystemBase<C> {{\n    \
         using Base = groundstate::SystemBase<C>;\n    using Side = groundstate::Side;\n    \
         using Phases = groundstate::Phases<C>;\n    using Observer = groundstate::Observation<C>;\n\n  public:\n    \
         /// The number of threads that use its clock: the tasks, and the one that runs the system.\n    \
         static constexpr std::size_t threads = {};\n\n    \
         System(C& clock, const Hooks& hooks, const groundstate::Options& options)\n        \
         : Base{{clock, plan(), options}}, hooks_{{hooks}} {{\n",
        one_line(&system.text),
        system.components.len() + 1
    );
    for component in &system.components {
        for channel in component.timing.awaited() {
            let channel = &system.channels[*channel].name;
            let _ = writeln!(text, "        {channel}_channel_.wakes({}_task_.trigger());", component.name);
        }
    }
    for component in &system.components {
        let _ = writeln!(text, "        this->add({}_task_);", component.name);
    }
    text.push_str(
        "    }\n\n    // Who: everybody, for what may be asked at any time; before the tasks start, to prepare them.\n",
    );
    for channel in &system.channels {
        let _ = writeln!(text, "    auto& {0}_channel() noexcept {{ return {0}_channel_; }}", channel.name);
    }
    text.push_str("\n  private:\n");
    starting(text, system);
    for index in 0..system.components.len() {
        cycle(text, system, index, form);
    }
    members(text, system, form);
    text.push_str("};\n");
}

fn starting(text: &mut String, system: &System) {
    for (name, call, qualifier) in [("start_component", "start", ""), ("safe_stop_component", "safe_stop", " noexcept")]
    {
        let _ =
            writeln!(text, "    void {name}(std::size_t number){qualifier} override {{\n        switch (number) {{");
        for (index, component) in system.components.iter().enumerate() {
            let _ = writeln!(text, "            case {index}: hooks_.{}.{call}(); break;", member(&component.name));
        }
        text.push_str("            default: break;\n        }\n    }\n\n");
    }
}

fn members(text: &mut String, system: &System, form: &Form) {
    let numbers = numbers(system);
    text.push_str("    Hooks hooks_;\n");
    for (index, channel) in system.channels.iter().enumerate() {
        let datum = datum(system, &channel.drawn);
        let period = |component: usize| system.components[component].timing.period().unwrap_or(u64::MAX);
        let side = |is_consumer: bool| if is_consumer { "Side::consumer" } else { "Side::producer" };
        let (kind, master) = match channel.kind {
            ChannelKind::Buffer { arrays, .. } if form.wait_free => {
                (format!("WaitFreeBuffer<{datum}, {}, C, Observer>", arrays.max(3)), channel.from)
            }
            ChannelKind::Buffer { arrays, master } => {
                let role = if master == channel.from { "writer" } else { "reader" };
                (format!("LockedBuffer<{datum}, {arrays}, groundstate::Master::{role}, C, Observer>"), master)
            }
            ChannelKind::Queue { capacity } => {
                (format!("MessageQueue<groundstate::Message<{datum}>, {capacity}, C, Observer>"), channel.from)
            }
            ChannelKind::Shared => (format!("WaitFreeBuffer<{datum}, 3, C, Observer>"), channel.from),
        };
        let _ = writeln!(
            text,
            "    groundstate::{kind} {}_channel_{{\n        this->clock(), this->observe({}, {}, {}, {}, {})}};",
            channel.name,
            numbers.channels + index,
            channel.from,
            channel.to,
            side(master != channel.from),
            side(period(channel.to) < period(channel.from))
        );
    }
    for (index, component) in system.components.iter().enumerate() {
        let (read, written) = ends(component);
        let _ = writeln!(text, "    typename {0}::In {1}_in_{{}};", pascal(&component.name), component.name);
        for channel in read.iter().map(|channel| &system.channels[*channel]) {
            match access(channel, index, form) {
                Access::Copy => _ = writeln!(text, "    {} {}_copy_{{}};", datum(system, &channel.drawn), channel.name),
                Access::Message => {
                    let message = format!("std::optional<groundstate::Message<{}>>", datum(system, &channel.drawn));
                    let _ = writeln!(text, "    {message} {}_last_{{}};", channel.name);
                }
                Access::InPlace | Access::Cell => {}
            }
        }
        for channel in written.iter().map(|channel| &system.channels[*channel]) {
            match access(channel, index, form) {
                Access::Copy => {
                    _ = writeln!(text, "    {} {}_staged_{{}};", datum(system, &channel.drawn), channel.name)
                }
                Access::Message => {
                    let message = format!("groundstate::Message<{}>", datum(system, &channel.drawn));
                    let _ = writeln!(text, "    {message} {}_staged_{{}};", channel.name);
                }
                Access::InPlace | Access::Cell => {}
            }
        }
    }
    for (index, component) in system.components.iter().enumerate() {
        task(text, system, index, component);
    }
}

fn task(text: &mut String, system: &System, index: usize, component: &Component) {
    let name = &component.name;
    let step = format!("[this](const Cycle& cycle) {{ {name}_cycle(cycle); }}");
    let Timing::Asynchronous { awaits } = &component.timing else {
        let _ = writeln!(
            text,
            "    groundstate::PeriodicTask<C> {name}_task_{{this->clock(), \"{name}\", this->period({index}),\n        \
             {step}, this->schedule({index})}};"
        );
        return;
    };
    let has_new = |channel: &usize| match &system.channels[*channel] {
        Channel { name, kind: ChannelKind::Queue { .. }, .. } => format!("!{name}_channel_.empty()"),
        Channel { name, .. } => format!("{name}_channel_.available()"),
    };
    let new: Vec<String> = awaits.channels.iter().map(has_new).collect();
    let available = match (&new[..], awaits.needs) {
        ([], _) => "true".to_string(),
        (_, Needs::All) => new.join(" && "),
        (_, Needs::Any) => new.join(" || "),
    };
    let _ = writeln!(
        text,
        "    groundstate::AsynchronousTask<C> {name}_task_{{this->clock(), \"{name}\", this->lock_patience_ns(),\n        \
         [this] {{\n            this->task({index}).pace.rest();\n            return {available};\n        }},\n        \
         {step}, this->schedule({index})}};"
    );
}
