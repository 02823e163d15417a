//! Generates the cycle of a task: its phases in order, each a call into the runtime.

use std::fmt::Write;

use chart::system::{Action, System, Timing};

use super::machines::elaboration;
use super::names::{hook, member, pascal};
use super::plan::{Access, Form, access, copies, numbers, places};

/// The function for the cycle of the component with this index.
pub(super) fn cycle(text: &mut String, system: &System, index: usize, form: &Form) {
    let component = &system.components[index];
    let name = &component.name;
    let numbers = numbers(system);
    let _ = write!(
        text,
        "    void {name}_cycle(const Cycle& cycle) {{\n        this->cycle({index}, cycle, [&](Phases& phases) {{\n"
    );
    if component.phases.iter().any(|phase| matches!(phase.action, Action::Write(_))) {
        text.push_str("            bool ready = false;\n");
    }
    let writes = |from: usize| component.phases[from..].iter().any(|phase| matches!(phase.action, Action::Write(_)));
    for (at, phase) in component.phases.iter().enumerate() {
        let least = if phase.least < phase.time { format!(", {}", phase.least) } else { String::new() };
        let number = format!("{{{}, {}{least}}}", numbers.phases[index] + at, phase.time);
        match phase.action {
            Action::Elaborate(_) => {
                let assigned = if writes(at) { "ready = " } else { "" };
                if let Some(body) = elaboration(system, index, at, form) {
                    let _ =
                        write!(text, "            {assigned}phases.decide({number}, [&] {{\n{body}            }});\n");
                    continue;
                }
                let copies = copies(system, index, form);
                let call = format!("hooks_.{}.{}(cycle, {name}_in_, out);", member(name), hook(&phase.subject));
                let call = match &copies[..] {
                    [] => format!("return {call}"),
                    copies => format!(
                        "const bool done = {call}\n                if (done) {{\n                    {}\n                }}\n                \
                         return done;",
                        copies.join("\n                    ")
                    ),
                };
                let _ = write!(
                    text,
                    "            {assigned}phases.elaborate({number}, [&] {{\n                typename {}::Out out{{{}}};\n                \
                     {call}\n            }});\n",
                    pascal(name),
                    places(system, index, form),
                );
            }
            Action::Read(channel) => {
                let channel = &system.channels[channel];
                let seen = format!("{name}_in_.{}", member(&channel.drawn));
                let call = match access(channel, index, form) {
                    Access::InPlace | Access::Cell => {
                        format!("read_in_place({number}, {0}_channel_, {seen})", channel.name)
                    }
                    Access::Copy => format!("read_copy({number}, {0}_channel_, {0}_copy_, {seen})", channel.name),
                    Access::Message => format!("receive({number}, {0}_channel_, {0}_last_, {seen})", channel.name),
                };
                let _ = writeln!(text, "            phases.{call};");
            }
            Action::Write(channel) => {
                let called = numbers.channels + channel;
                let channel = &system.channels[channel].name;
                let call = match access(&system.channels[called - numbers.channels], index, form) {
                    Access::InPlace => format!("write_in_place({number}, {channel}_channel_, {called}, ready)"),
                    Access::Cell => format!("store({number}, {channel}_channel_, {called}, ready)"),
                    Access::Copy => {
                        format!("write_copy({number}, {channel}_channel_, {channel}_staged_, {called}, ready)")
                    }
                    Access::Message => {
                        format!("send({number}, {channel}_channel_, {channel}_staged_, {called}, ready)")
                    }
                };
                let _ = writeln!(text, "            phases.{call};");
            }
        }
    }
    if let Timing::Synchronous { .. } = component.timing {
        let _ =
            writeln!(text, "            phases.complete({}, this->instant_ns({index}));", numbers.components + index);
    }
    text.push_str("        });\n");
    let is_periodic = component.timing.period().is_some();
    if !is_periodic && component.timing.awaited().is_empty() {
        let _ = writeln!(text, "        this->rest_for_a_cycle({index}, cycle);");
    }
    text.push_str("    }\n\n");
}
