//! Members that answer what is not simply read: inputs, initial values that are due late, the clock.
//!
//! In: what the generated code reaches. Out: the definitions of those members. An input is asked for once a step and then
//! kept; so is the clock. A location whose initial value was not due at the start gets it when it is first read.

use crate::class::{functions, parameters};
use crate::generator::{Generator, Need};
use crate::plan::Role;
use crate::text::Text;

/// All of them.
pub(crate) fn accessors(generator: &Generator<'_>, text: &mut Text) {
    inputs(generator, text);
    lazy(generator, text);
    clock(generator, text);
}

fn inputs(generator: &Generator<'_>, text: &mut Text) {
    let plan = generator.plan;
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
            _ => text.line(format!(
                "return {}.read(step_, site, [&]() -> {result} {{ return {checked}; }}{comma}{names});",
                function.member
            )),
        }
        text.close("}");
    }
}

/// Accessors of functions whose initial values may be due only when they are read.
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
        let site = 0;
        text.open(format!("\n{result} Machine::{}({list}) {{", function.name));
        text.line(format!("const std::uint32_t found = {}.find({names});", function.member));
        text.open(format!("if (found != decltype({})::none) {{", function.member));
        text.line(format!("return {}.at(found);", function.member));
        text.close("}");
        if fixed {
            // It depends on its arguments alone, so that it does not matter that the initial state is gone.
            text.line(format!("const auto value = initial_{}({names});", function.name));
            text.line(format!("{0}.put({0}.number({site}, {names}), value);", function.member));
            text.line("return value;");
        } else {
            // LIMIT: an initial value that reads the state is known for the elements that there were at the start.
            text.line(format!("gs::fail(gs::FaultKind::no_definition, {site}, {site});"));
        }
        text.close("}");
    }
}

fn clock(generator: &Generator<'_>, text: &mut Text) {
    if !generator.needs.contains(&Need::Clock) {
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
