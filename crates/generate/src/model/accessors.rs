//! Members that compute what they return: inputs, late initial values, the clock.
//!
//! In: what the generated code reaches. Out: the definitions of those members. An input is asked for once per step and
//! then kept; so is the clock. A location that got no initial value at the start gets it when it is first read, with
//! the value that it would have had at the start. For this, the parts of the initial state and the inputs that such
//! values read are kept.

use std::collections::BTreeSet;

use program::FunctionId;

use crate::model::generator::Generator;
use crate::model::members::{carriers, functions, parameters};
use crate::model::plan::Role;
use crate::model::reach::Need;
use crate::model::text::Text;

/// All of them.
pub(crate) fn accessors(generator: &Generator<'_>, text: &mut Text) {
    inputs(generator, text);
    lazy(generator, text);
    clock(generator, text);
}

fn inputs(generator: &Generator<'_>, text: &mut Text) {
    let plan = generator.plan;
    let kept = inputs_from_start(generator);
    for (id, function) in functions(generator, &[Role::Input, Role::Shared]) {
        let (list, names) = parameters(generator, id);
        let comma = if list.is_empty() { "" } else { ", " };
        let result = plan.cpp(function.ty, false);
        text.open(format!("\n{result} Machine::{}({list}{comma}gs::Site site) {{", function.name));
        let checked = generator.asked.get(&id).cloned().unwrap_or_default();
        match function.role {
            Role::Shared => {
                let first = match function.initial {
                    Some(_) => format!("{result}{{initial_{}({names})}}", function.name),
                    None => checked,
                };
                text.line(format!(
                    "return {}.read(site, [&]() -> {result} {{ return {first}; }}{comma}{names});",
                    function.member
                ));
            }
            _ => {
                // Late initial values see the input that was asked for at the start.
                if let Some((_, copy)) = kept.iter().find(|(member, _)| *member == function.member) {
                    text.open(format!(
                        "if (const auto* known = started_ ? nullptr : at_start_.{copy}.answer(1{comma}{names})) {{"
                    ));
                    text.line("return *known;");
                    text.close("}");
                }
                text.line(format!(
                    "return {}.read(step_, site, [&]() -> {result} {{ return {checked}; }}{comma}{names});",
                    function.member
                ));
            }
        }
        text.close("}");
    }
}

/// Accessors of functions whose initial values may be computed when they are first read.
fn lazy(generator: &Generator<'_>, text: &mut Text) {
    for (id, function) in functions(generator, &[Role::State]) {
        if !generator.is_lazy(id) {
            continue;
        }
        let (list, names) = parameters(generator, id);
        let total = generator.assumed.total[id.0 as usize];
        let result = generator.plan.cpp(function.ty, total);
        let initial = &generator.program.initials[function.initial.unwrap_or_default()];
        let fixed = generator.program.reads(&initial.value).is_some_and(|read| read.is_empty());
        let late = read_late(generator, id).is_some();
        let site = 0;
        text.open(format!("\n{result} Machine::{}({list}) {{", function.name));
        text.line(format!("const std::uint32_t found = {}.find({names});", function.member));
        text.open(format!("if (found != decltype({})::none) {{", function.member));
        text.line(format!("return {}.at(found);", function.member));
        text.close("}");
        if fixed {
            // The value depends only on its arguments, so the initial state is not needed.
            text.line(format!("const auto value = initial_{}({names});", function.name));
            text.line(format!("{0}.put({0}.number({site}, {names}), value);", function.member));
            text.line("return value;");
        } else if late {
            text.line(format!(
                "const auto value = in_initial_state([&] {{ return initial_{}({names}); }});",
                function.name
            ));
            text.line(format!("{0}.put({0}.number({site}, {names}), value);", function.member));
            text.line("return value;");
        } else {
            // LIMIT: bare code keeps no initial state, choices are not repeated, and the clock is not read again. Such
            // initial values exist only for locations that existed at the start.
            text.line(format!("gs::fail(gs::FaultKind::no_definition, {site}, {site});"));
        }
        text.close("}");
    }
}

/// What the initial values of a lazy function read in the initial state, directly or through those of others; `None` if
/// that cannot be kept.
fn read_late(generator: &Generator<'_>, id: FunctionId) -> Option<BTreeSet<FunctionId>> {
    if generator.options.bare {
        return None;
    }
    let mut found = BTreeSet::new();
    let mut open = vec![id];
    while let Some(next) = open.pop() {
        let Some(initial) = generator.plan.function(next).initial else { continue };
        let (read, depends_on_more) = generator.program.reads_and_more(&generator.program.initials[initial].value);
        if depends_on_more {
            return None;
        }
        for read in read {
            if read == id {
                return None;
            }
            if found.insert(read) && generator.is_lazy(read) {
                open.push(read);
            }
        }
    }
    Some(found)
}

/// What all late initial values read.
fn all_read_late(generator: &Generator<'_>) -> BTreeSet<FunctionId> {
    let lazy = functions(generator, &[Role::State]).into_iter().filter(|(id, _)| generator.is_lazy(*id));
    lazy.filter_map(|(id, _)| read_late(generator, id)).flatten().collect()
}

/// The members of the state whose initial contents are kept, each with the name of its copy.
fn state_from_start(generator: &Generator<'_>) -> Vec<(String, String)> {
    let read = all_read_late(generator);
    if read.is_empty() {
        return Vec::new();
    }
    let states = functions(generator, &[Role::State, Role::Local]).into_iter();
    let states = states.filter(|(id, _)| read.contains(id)).map(|(_, function)| function.member.clone());
    let domains = carriers(generator).into_iter().filter_map(|(_, domain)| domain.carrier.clone());
    states.chain(domains).map(with_copy).collect()
}

/// The inputs whose answers from the start are kept, each with the name of its copy.
fn inputs_from_start(generator: &Generator<'_>) -> Vec<(String, String)> {
    let read = all_read_late(generator);
    let inputs = functions(generator, &[Role::Input]).into_iter().filter(|(id, _)| read.contains(id));
    inputs.map(|(_, function)| with_copy(function.member.clone())).collect()
}

fn with_copy(member: String) -> (String, String) {
    let copy = member.trim_end_matches('_').to_string();
    (member, copy)
}

/// All members of which a copy from the start is kept.
pub(crate) fn kept_from_start(generator: &Generator<'_>) -> Vec<(String, String)> {
    state_from_start(generator).into_iter().chain(inputs_from_start(generator)).collect()
}

/// Writes the members that evaluate a term in the initial state.
pub(crate) fn initial_state(generator: &Generator<'_>, text: &mut Text) {
    let kept = kept_from_start(generator);
    if kept.is_empty() {
        return;
    }
    text.line("/// What late initial values read.");
    text.open("struct Start {");
    kept.iter().for_each(|(member, copy)| text.line(format!("decltype({member}) {copy}{{}};")));
    text.close("};");
    text.line("Start at_start_{};");
    text.line("bool started_ = false;");
    text.open("void swap_start() {");
    let state = state_from_start(generator);
    state.iter().for_each(|(member, copy)| text.line(format!("std::swap({member}, at_start_.{copy});")));
    text.line("started_ = !started_;");
    text.close("}");
    text.line("template <class Term>");
    text.open("auto in_initial_state(Term&& term) {");
    text.line("const bool swaps = started_;");
    text.open("struct Swapped {");
    text.line("Machine& machine;");
    text.line("bool swaps;");
    text.line("~Swapped() { if (swaps) machine.swap_start(); }");
    text.close("} swapped{*this, swaps};");
    text.open("if (swaps) {");
    text.line("swap_start();");
    text.close("}");
    text.line("return term();");
    text.close("}");
}

fn clock(generator: &Generator<'_>, text: &mut Text) {
    if !generator.reach.needs(Need::Clock) {
        return;
    }
    text.open("\nstd::int64_t Machine::clock(gs::TimeUnit unit) {");
    text.line("auto& reading = clock_[static_cast<std::size_t>(unit)];");
    text.open("if (reading.step != step_) {");
    text.line("reading = {environment_.time(unit), step_};");
    text.close("}");
    text.line("return reading.value;");
    text.close("}");
}
