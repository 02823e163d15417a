//! Generates what components compute by their machines: the types of messages, and for each component with a machine a hook class that
//! steps the machine's generated class.
//!
//! In: a system whose machines' functions are fed and taken, and the machines' classes as `generate::model` makes them. Out: two headers.
//! The class of a component is a default: a user's class may override what it decides. Only what C++ needs to compile is looked up in the
//! text of a machine's class: an input that no rule asks for is no function there.

use std::fmt::Write;

use chart::system::{Action, Component, Device, System};
use chart::{ComponentMachine, Content, Feed, Take};

use super::names::{datum, hook, member, pascal, readers, type_name};
use super::plan::{Form, MachineClass, copies, numbers, places};

/// Whether the chart says what some channel or device carries.
pub(super) fn has_messages(system: &System) -> bool {
    !system.computing.contents.is_empty()
}

/// The class of the machine of a component, if it has one.
pub(super) fn class_of<'f>(system: &System, component: usize, form: &'f Form) -> Option<&'f MachineClass> {
    let machine = machine_of(system, component)?;
    form.classes.iter().find(|class| class.file == machine.source.name)
}

fn machine_of(system: &System, component: usize) -> Option<&ComponentMachine> {
    system.computing.machines.iter().find(|machine| machine.component == component)
}

/// The hook class that a component's file derives from, besides the pure one.
pub(super) fn name(component: &Component) -> String {
    format!("{}Machine", pascal(&component.name))
}

/// The type of a value.
fn type_of(content: &Content) -> String {
    match content {
        Content::Boolean => "bool".to_string(),
        Content::Integer => "std::int64_t".to_string(),
        Content::Real => "double".to_string(),
        Content::Enum { name, .. } => type_name(name),
        Content::Tuple(parts) => {
            let parts: Vec<String> = parts.iter().map(type_of).collect();
            format!("groundstate::Tuple<{}>", parts.join(", "))
        }
        Content::Other(text) => unreachable!("{text} is refused before"),
    }
}

/// The header of the messages.
pub(super) fn messages(system: &System, file: &str, space: &str) -> String {
    let has_tuples = system.computing.contents.values().any(|content| matches!(content, Content::Tuple(_)));
    let mut text = format!(
        "// Made from {file} by `groundstate generate cpp`; do not edit. What channels and devices carry.\n#pragma once\n\n\
         #include <cstdint>\n\n{}namespace {space} {{\n",
        if has_tuples { "#include <groundstate/tuple.hpp>\n\n" } else { "" }
    );
    let mut known: Vec<&str> = Vec::new();
    for (name, literals) in system.computing.contents.values().flat_map(Content::enums) {
        if !known.contains(&name) {
            known.push(name);
            let literals: Vec<String> = literals.iter().map(|literal| member(literal)).collect();
            let _ = writeln!(text, "\nenum class {} : std::uint32_t {{ {} }};", type_name(name), literals.join(", "));
        }
    }
    for channels in system.drawn_channels() {
        let channel = &channels[0];
        let Some(content) = system.computing.contents.get(&channel.drawn) else { continue };
        let from = &system.components[channel.from].name;
        let to = readers(system, channels);
        let _ = write!(
            text,
            "\n/// From {from} to {to}.\nstruct {} {{\n    {} value{{}};\n    bool known = true;  ///< false: undef, whatever the value\n}};\n",
            datum(system, &channel.drawn),
            type_of(content)
        );
    }
    let _ = writeln!(text, "\n}}  // namespace {space}");
    text
}

/// The header of the components that have machines; none if no component has one.
pub(super) fn header(system: &System, file: &str, name: &str, space: &str, form: &Form) -> Option<String> {
    let with: Vec<(usize, &MachineClass)> =
        (0..system.components.len()).filter_map(|index| Some((index, class_of(system, index, form)?))).collect();
    if with.is_empty() {
        return None;
    }
    let mut includes: Vec<String> =
        with.iter().map(|(_, class)| format!("#include \"machines/{}.hpp\"\n", class.name)).collect();
    includes.sort();
    includes.dedup();
    let mut text = format!(
        "// Made from {file} by `groundstate generate cpp`; do not edit. What components do by their machines.\n#pragma once\n\n\
         #include <utility>\n\n#include <groundstate/component.hpp>\n\n#include \"{name}.hpp\"\n{}\nnamespace {space} {{\n",
        includes.concat()
    );
    for (index, class) in with {
        if let Some(machine) = machine_of(system, index) {
            one(&mut text, system, machine, class);
        }
    }
    let _ = writeln!(text, "\n}}  // namespace {space}");
    Some(text)
}

fn one(text: &mut String, system: &System, machine: &ComponentMachine, class: &MachineClass) {
    let component = &system.components[machine.component];
    let phase = &component.phases[machine.phase];
    let (name, made) = (name(component), &class.machine);
    let _ = write!(
        text,
        "\n/// {} as {made} decides: one step of the machine in each `{}`.\nclass {name} : public {} {{\n  public:\n    \
         {name}() {{ groundstate::made(machine_.start(), \"{made}\"); }}\n",
        component.name,
        phase.subject,
        pascal(&component.name)
    );
    let _ = write!(
        text,
        "    bool {}(const Cycle&, const In& in, [[maybe_unused]] Out& out) override {{\n        \
         inputs_.in = &in;\n        groundstate::made(machine_.step(), \"{made}\");\n",
        hook(&phase.subject)
    );
    for (at, (function, take)) in machine.takes.iter().enumerate() {
        let called = class.called(function);
        match take {
            // The next reader of the same channel.
            Take::Channel(_) if at > 0 && machine.takes[at - 1].0 == *function => {}
            Take::Channel(channel) => {
                let out = member(&system.channels[*channel].drawn);
                let _ = writeln!(
                    text,
                    "        out.{out}.known = groundstate::decided(machine_.{called}(), out.{out}.value);"
                );
            }
            Take::Actuator(device) => {
                let device = &system.devices[*device];
                let content = type_of(&system.computing.contents[&device.name]);
                let _ = writeln!(
                    text,
                    "        if ({content} value{{}}; groundstate::decided(machine_.{called}(), value)) {{\n            \
                     out.{} = value;\n        }}",
                    member(&device.name)
                );
            }
        }
    }
    text.push_str("        return true;\n    }\n");
    let space = &class.name;
    let tuples = fed_tuples(system, machine);
    let domains = if tuples.is_empty() { "" } else { ", Domains" };
    let _ = write!(
        text,
        "    /// The machine, to look at.\n    const ::{space}::Machine& machine() const noexcept {{ return machine_; }}\n\n  private:\n"
    );
    if !tuples.is_empty() {
        text.push_str("    /// The machine's numbers of the domains of enums in tuples.\n    struct Domains {\n");
        let mut known: Vec<&str> = Vec::new();
        for (name, _) in tuples.iter().flat_map(|content| content.enums()) {
            if let Some((_, number)) = class.domains.iter().find(|(domain, _)| domain == name)
                && !known.contains(&name)
            {
                known.push(name);
                let _ = writeln!(
                    text,
                    "        static constexpr std::uint32_t of({}) noexcept {{ return {number}; }}",
                    type_name(name)
                );
            }
        }
        text.push_str("    };\n");
    }
    let _ = writeln!(text, "    struct Inputs final : ::{space}::Environment {{");
    for (function, feed) in &machine.feeds {
        let called = class.called(function);
        if !class.header.contains(&format!(" {called}() = 0;")) {
            continue;
        }
        let answer = format!("decltype(std::declval<::{space}::Environment&>().{called}())");
        let value = match feed {
            Feed::Channel(channel) => {
                let read = member(&system.channels[*channel].drawn);
                format!("in == nullptr ? Answer{{}} : groundstate::carried<Answer{domains}>(in->{read})")
            }
            Feed::IsNew(channel) => {
                let read = member(&system.channels[*channel].drawn);
                format!("in == nullptr ? Answer{{}} : Answer{{in->{read}.fresh}}")
            }
            Feed::Sensor(device) => {
                let device = member(&system.devices[*device].name);
                format!("in == nullptr ? Answer{{}} : groundstate::sensed<Answer{domains}>(in->{device})")
            }
        };
        let _ = writeln!(
            text,
            "        {answer} {called}() override {{\n            using Answer = {answer};\n            return {value};\n        }}"
        );
    }
    let _ = write!(
        text,
        "        /// The first candidate.\n        std::size_t choose(std::size_t, groundstate::machine::Site) override {{ return 0; }}\n\n        \
         const In* in = nullptr;\n    }};\n\n    \
         Inputs inputs_{{}};\n    ::{space}::Machine machine_{{inputs_}};\n}};\n"
    );
}

/// The tuples that feed a machine.
fn fed_tuples<'s>(system: &'s System, machine: &ComponentMachine) -> Vec<&'s Content> {
    let carried = |(_, feed): &(String, Feed)| match feed {
        Feed::Channel(channel) => system.computing.contents.get(&system.channels[*channel].drawn),
        Feed::Sensor(device) => system.computing.contents.get(&system.devices[*device].name),
        Feed::IsNew(_) => None,
    };
    machine.feeds.iter().filter_map(carried).filter(|content| matches!(content, Content::Tuple(_))).collect()
}

/// A sensor or actuator, and the type of its values.
type Typed<'s> = (&'s Device, String);

/// The sensors and actuators that the machine of a component has to do with, if its class is generated.
pub(super) fn devices<'s>(system: &'s System, component: &Component, form: &Form) -> (Vec<Typed<'s>>, Vec<Typed<'s>>) {
    let index = system.components.iter().position(|known| known.name == component.name);
    let machine =
        index.filter(|index| class_of(system, *index, form).is_some()).and_then(|index| machine_of(system, index));
    let Some(machine) = machine else { return (Vec::new(), Vec::new()) };
    let typed = |device: &usize| {
        let device = &system.devices[*device];
        (device, type_of(&system.computing.contents[&device.name]))
    };
    let sensors = machine.feeds.iter().filter_map(|(_, feed)| match feed {
        Feed::Sensor(device) => Some(typed(device)),
        Feed::Channel(_) | Feed::IsNew(_) => None,
    });
    let actuators = machine.takes.iter().filter_map(|(_, take)| match take {
        Take::Actuator(device) => Some(typed(device)),
        Take::Channel(_) => None,
    });
    (sensors.collect(), actuators.collect())
}

/// What an elaboration with a machine does: the sensors, what is got, the hook, what is decided, the actuators.
pub(super) fn elaboration(system: &System, index: usize, phase: usize, form: &Form) -> Option<String> {
    class_of(system, index, form)?;
    let machine = machine_of(system, index).filter(|machine| machine.phase == phase)?;
    let component = &system.components[index];
    let (name, class) = (&component.name, pascal(&component.name));
    let (numbers, hooks) = (numbers(system), format!("hooks_.{}", member(name)));
    let mut text = String::new();
    let mut line = |words: String| _ = writeln!(text, "                {words}");
    if machine.feeds.iter().any(|(_, feed)| matches!(feed, Feed::Sensor(_))) {
        line(format!("{hooks}.before_sensors(cycle, {name}_in_);"));
    }
    let mut places = places(system, index, form);
    let mut got = Vec::new();
    for (_, feed) in &machine.feeds {
        match feed {
            Feed::Sensor(device) => {
                let (sensor, number) = (&system.devices[*device].name, numbers.devices + device);
                let (read, called) = (member(sensor), hook(sensor));
                line(format!("{name}_in_.{read} = {hooks}.{called}(cycle);"));
                got.push(format!("phases.senses({number}, {name}_in_.{read});"));
            }
            Feed::Channel(channel) | Feed::IsNew(channel) => {
                let (read, number) = (member(&system.channels[*channel].drawn), numbers.channels + channel);
                let call = format!("phases.gets({number}, {name}_in_.{read});");
                if !got.contains(&call) {
                    got.push(call);
                }
            }
        }
    }
    let (_, actuators) = devices(system, component, form);
    for (device, value) in &actuators {
        line(format!("std::optional<{value}> set_{}{{}};", device.name));
        places = [places.as_str(), &format!("set_{}", device.name)]
            .into_iter()
            .filter(|one| !one.is_empty())
            .collect::<Vec<_>>()
            .join(", ");
    }
    line(format!("typename {class}::Out out{{{places}}};"));
    got.into_iter().for_each(&mut line);
    let subject = hook(&component.phases[phase].subject);
    line(format!("const bool done = {hooks}.{subject}(cycle, {name}_in_, out);"));
    for (_, take) in &machine.takes {
        match take {
            Take::Channel(channel) => {
                let (written, number) = (member(&system.channels[*channel].drawn), numbers.channels + channel);
                line(format!("phases.decides({number}, out.{written}.value, done && out.{written}.known);"));
            }
            Take::Actuator(device) => {
                let (set, number) = (format!("set_{}", system.devices[*device].name), numbers.devices + device);
                let called = hook(&system.devices[*device].name);
                let value = type_of(&system.computing.contents[&system.devices[*device].name]);
                line(format!("phases.decides({number}, {set}.value_or({value}{{}}), {set}.has_value());"));
                line(format!("if ({set}) {{"));
                line(format!("    {hooks}.{called}(cycle, *{set});"));
                line("}".to_string());
            }
        }
    }
    let copies = copies(system, index, form);
    if !copies.is_empty() {
        line("if (done) {".to_string());
        copies.iter().for_each(|copy| line(format!("    {copy}")));
        line("}".to_string());
    }
    line("return done;".to_string());
    Some(text)
}

/// The user's file for a component with a machine.
pub(super) fn file(
    system: &System,
    index: usize,
    class: &MachineClass,
    name: &str,
    space: &str,
    form: &Form,
) -> String {
    let component = &system.components[index];
    let machine = machine_of(system, index);
    let mut text = format!(
        "// {}. This file is yours: it is written once, and never touched again.\n#pragma once\n\n\
         #include \"generated/{name}_machines.hpp\"\n\nnamespace {space} {{\n\n\
         /// It does what {} decides. What that decides can be overridden, as each elaboration of a component without a machine is.\n\
         class {}Hooks final : public {} {{\n  public:\n",
        component.text.split_whitespace().collect::<Vec<_>>().join(" "),
        class.machine,
        pascal(&component.name),
        self::name(component)
    );
    let (sensors, actuators) = devices(system, component, form);
    for (device, value) in sensors {
        let _ =
            writeln!(text, "    {value} {}(const Cycle& /*cycle*/) override {{ return {{}}; }}", hook(&device.name));
    }
    for (device, value) in actuators {
        let called = hook(&device.name);
        let _ = writeln!(text, "    void {called}(const Cycle& /*cycle*/, {value} /*value*/) override {{}}");
    }
    for (at, phase) in component.phases.iter().enumerate() {
        if matches!(phase.action, Action::Elaborate(_)) && machine.is_none_or(|machine| machine.phase != at) {
            let _ = writeln!(
                text,
                "    bool {}(const Cycle& /*cycle*/, const In& /*in*/, Out& /*out*/) override {{ return true; }}",
                hook(&phase.subject)
            );
        }
    }
    let _ = writeln!(text, "}};\n\n}}  // namespace {space}");
    text
}
