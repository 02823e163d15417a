//! The class of a model: its header and its source.
//!
//! In: bodies. Out: two texts. The class holds the state; `start` sets the initial one and `step` makes a step, whose
//! update set is committed or, after a fault, dropped. What it asks for comes from an `Environment`.

use program::{DomainKind, FunctionId, Program};

use crate::model::accessors::{accessors, initial_state, kept_from_start};
use crate::model::body::Bodies;
use crate::model::generator::Generator;
use crate::model::members::{carriers, counts_steps, functions, logs, parameters, stepped};
use crate::model::plan::Role;
use crate::model::reach::Need;
use crate::model::renamed::{called, literals_called};
use crate::model::text::{Text, escaped};
use crate::model::types::Type;

/// The header. It declares the types that code has named, so everything else is generated before it.
pub(crate) fn header(bodies: &Bodies<'_>, title: &str) -> Text {
    let generator = &bodies.generator;
    let (program, plan) = (generator.program, generator.plan);
    let mut body = Text::default();
    environment(generator, &mut body);
    class(bodies, &mut body);
    let mut text = Text::default();
    text.line(format!(
        "// The machine {} in C++, made by groundstate from {title}. Overwritten by each generation.",
        program.name
    ));
    text.line("//");
    text.line("// Who: one thread at a time. `start` and `step` block only where the environment does.");
    text.line("#pragma once\n");
    if generator.options.bare {
        text.line("#ifndef GROUNDSTATE_BARE\n#define GROUNDSTATE_BARE\n#endif\n");
    }
    let mut includes = vec![
        "elements",
        "inputs",
        "locations",
        "maybe",
        "membership",
        "numbers",
        "ranges",
        "units",
        "unsequenced",
        "word",
    ];
    includes.push("lists");
    if !generator.options.bare {
        includes.push("boxing");
        includes.push("text");
    }
    includes.sort_unstable();
    text.line("#include <array>\n#include <cstddef>\n#include <cstdint>\n#include <limits>\n#include <tuple>\n#include <utility>\n");
    includes.iter().for_each(|name| text.line(format!("#include <groundstate/machine/{name}.hpp>")));
    text.line(format!("\nnamespace {} {{\n\nnamespace gs = groundstate::machine;\n", plan.namespace));
    types(generator, &mut text);
    body.pour(&mut text);
    text.line(format!("\n}}  // namespace {}", plan.namespace));
    text
}

/// The enum types and element types.
fn types(generator: &Generator<'_>, text: &mut Text) {
    for (index, plan) in generator.plan.domains.iter().enumerate() {
        if !plan.is_named() {
            continue;
        }
        match &generator.program.domains[index].kind {
            DomainKind::Enum { literals } => {
                if let Some(told) = literals_called(literals, &plan.literals) {
                    text.line(told);
                }
                text.line(format!("enum class {} : std::uint32_t {{ {} }};", plan.stem(), plan.literals.join(", ")));
            }
            DomainKind::Abstract { elements, .. } => {
                let named = match elements.len() {
                    0 => String::new(),
                    _ => format!("  // {}", elements.join(", ")),
                };
                text.open(format!("struct {} {{{named}", plan.stem()));
                text.line("std::uint32_t element = 0;");
                text.line(format!("friend constexpr bool operator==(const {0}&, const {0}&) = default;", plan.stem()));
                text.close("};");
            }
            _ => continue,
        }
        text.line(format!("constexpr std::uint32_t domain_of({}) {{ return {index}; }}\n", plan.stem()));
    }
}

fn environment(generator: &Generator<'_>, text: &mut Text) {
    text.line("/// What the machine asks for. Each location and clock is asked for at most once per step.");
    text.open("class Environment {");
    text.line("public:");
    if generator.options.bare {
        // A virtual destructor would bring in `operator delete`, and with it the heap.
        text.line("Environment() = default;\n");
    } else {
        text.line("virtual ~Environment() = default;\n");
    }
    for (id, plan) in functions(generator, &[Role::Input, Role::Shared]) {
        let result = generator.plan.cpp(plan.ty, false);
        text.line(format!(
            "/// {}{}",
            signature(generator.program, id),
            called(&generator.program.function(id).name, &plan.name)
        ));
        text.line(format!("virtual {result} {}({}) = 0;", plan.name, parameters(generator, id).0));
    }
    text.line("\n/// A choice among candidates 0 … candidates - 1, by the choose rule at `site`.");
    text.line("virtual std::size_t choose(std::size_t candidates, gs::Site site) = 0;");
    text.line("/// A number for a variable that a choose rule binds over all numbers.");
    text.line("virtual std::int64_t integer(gs::Site, std::size_t) { return 0; }");
    text.line("virtual double real(gs::Site, std::size_t) { return 0.0; }");
    text.line("/// The clock.");
    text.line("virtual std::int64_t time(gs::TimeUnit) { return 0; }");
    if generator.options.bare {
        text.line("\nprotected:");
        text.line("/// Environments are never deleted through this base.");
        text.line("~Environment() = default;");
    }
    text.close("};\n");
}

/// `f: D -> R`, as the model declares it.
fn signature(program: &Program, id: FunctionId) -> String {
    let function = program.function(id);
    let names: Vec<&str> = function.parameters.iter().map(|domain| program.domain(*domain).name.as_str()).collect();
    let from = if names.is_empty() { String::new() } else { format!("{} -> ", names.join(", ")) };
    format!("{}: {from}{}", function.name, program.domain(function.codomain).name)
}

fn class(bodies: &Bodies<'_>, text: &mut Text) {
    let generator = &bodies.generator;
    let plan = generator.plan;
    text.line("/// The machine: its state and its step.");
    text.open("class Machine {");
    text.line("public:");
    text.line("/// Who: the owner. Undefined until `start`.");
    text.line("explicit Machine(Environment& environment) : environment_{environment} {}");
    text.line("Machine(const Machine&) = delete;");
    text.line("Machine& operator=(const Machine&) = delete;\n");
    text.line("/// Sets the initial state. Who: the owner, once, before any step. Returns the fault of an initial value, or none.");
    text.line("[[nodiscard]] gs::Fault start();");
    text.line("/// Makes a step. After a fault, or an exception of the environment, the state is the one before.");
    text.line("[[nodiscard]] gs::Fault step();");
    text.line("/// Whether the last step had any updates.");
    text.line("[[nodiscard]] bool changed() const noexcept { return changed_; }\n");
    for (id, function) in functions(generator, &[Role::State]) {
        let (list, names) = parameters(generator, id);
        let total = generator.assumed.total[id.0 as usize];
        let result = plan.cpp(function.ty, total);
        text.line(format!(
            "/// {}{}",
            signature(generator.program, id),
            called(&generator.program.function(id).name, &function.name)
        ));
        if generator.is_lazy(id) {
            text.line(format!("{result} {}({list});", function.name));
        } else {
            text.line(format!(
                "{result} {}({list}) const {{ return {}.read({names}); }}",
                function.name, function.member
            ));
        }
    }
    text.line("");
    text.line(
        "/// Calls visit(name, arguments, value) for each location of the state, with undef where it has no value.",
    );
    text.line(
        "/// With an undef argument, an initial value is included once it was read, or if the function has an array.",
    );
    text.line("template <class Visit>");
    text.open("void each_location([[maybe_unused]] Visit&& visit) const {");
    for (id, function) in functions(generator, &[Role::State, Role::Shared]) {
        let name = escaped(&generator.program.function(id).name);
        let dot = if function.role == Role::Shared { ".locations" } else { "" };
        text.line(format!(
            "{}{dot}.each([&](const auto& arguments, const auto& value) {{ visit(\"{name}\", arguments, value); }});",
            function.member
        ));
    }
    text.close("}");
    text.line("\nprivate:");
    text.line("struct Next;\n");
    for member in bodies.procedures.iter().chain(&bodies.definitions).chain(bodies.initials.iter().map(|(_, m)| m)) {
        text.line(&member.declaration);
    }
    for (id, function) in functions(generator, &[Role::Input, Role::Shared]) {
        let (list, _) = parameters(generator, id);
        let comma = if list.is_empty() { "" } else { ", " };
        text.line(format!("{} {}({list}{comma}gs::Site site);", plan.cpp(function.ty, false), function.name));
    }
    helpers(bodies, text);
    text.line("");
    members(generator, text);
    text.line("Environment& environment_;");
    text.line("bool changed_ = false;");
    if counts_steps(generator) {
        text.line("std::uint64_t step_ = 1;");
    }
    if generator.reach.needs(Need::Rounds) {
        text.line("std::uint32_t iterations_ = 0;");
    }
    if generator.reach.needs(Need::Depth) {
        text.line("std::uint32_t calls_ = 0;");
    }
    if generator.reach.needs(Need::Clock) {
        text.line("std::array<gs::Answer<std::int64_t>, 3> clock_{};");
    }
    initial_state(generator, text);
    text.line("\n/// Updates of the running step, for functions that no `seq` updates.");
    text.open("struct Next {");
    for function in stepped(generator) {
        text.line(format!("decltype({})::Next {};", function.member, function.name));
    }
    text.close("};");
    text.close("};");
}

/// The small functions that generated rules call.
fn helpers(bodies: &Bodies<'_>, text: &mut Text) {
    let generator = &bodies.generator;
    // Defined in the header: with the header alone, compilers warn of an inline function without a definition.
    text.open("[[gnu::always_inline]] std::size_t choose(std::size_t candidates, gs::Site site) {");
    text.line("const std::size_t chosen = environment_.choose(candidates, site);");
    text.open("if (chosen >= candidates) {");
    text.line("gs::fail(gs::FaultKind::environment, site, site);");
    text.close("}");
    text.line("return chosen;");
    text.close("}");
    if generator.reach.needs(Need::Rounds) {
        text.line("void iteration(gs::Site site);");
    }
    text.line("void roll_back();");
    if !generator.options.bare {
        text.open("gs::Value choose_one(const gs::Value& set, gs::Site site) {");
        text.line("return gs::chosen_of(set, site, [&](std::size_t candidates) { return choose(candidates, site); });");
        text.close("}");
    }
    if generator.reach.needs(Need::Clock) {
        text.line("std::int64_t clock(gs::TimeUnit unit);");
    }
    if generator.reach.needs(Need::Names) {
        text.line("static const gs::Names& names();");
    }
    if generator.reach.needs(Need::AgentProgram) || !generator.program.agents.is_empty() {
        let agent = match generator.program.agents.first() {
            Some(agent) => generator.plan.cpp(Type::Element(generator.program.base_domain(agent.domain)), false),
            None => "gs::Value".to_string(),
        };
        text.line(format!("std::int64_t program_of({agent} agent);"));
        text.line(format!("void run_agent(Next& next, {agent} agent, gs::Site site);"));
        if !generator.options.bare {
            text.line("gs::Value agent_program(const gs::Value& agent);");
        }
    }
    text.line("/// A term in the state before the step.");
    text.line("template <class Term>");
    text.open("auto before(Term&& term) {");
    for member in logs(generator) {
        text.line(format!("{member}.swap_original(false);"));
    }
    text.line("auto value = term();");
    for member in logs(generator) {
        text.line(format!("{member}.swap_original(true);"));
    }
    text.line("return value;");
    text.close("}");
}

fn members(generator: &Generator<'_>, text: &mut Text) {
    let plan = generator.plan;
    for (index, domain) in carriers(generator) {
        if let Some(carrier) = &domain.carrier {
            let capacity = generator.capacity(&generator.program.domains[index].name).unwrap_or(0);
            let class = match generator.program.domains[index].kind {
                DomainKind::Abstract { .. } => "Elements",
                _ => "Subset",
            };
            text.line(format!("gs::{class}<{capacity}> {carrier}{{}};"));
        }
    }
    for (id, function) in functions(generator, &[Role::State, Role::Local, Role::Input, Role::Shared, Role::Agent]) {
        if function.role == Role::Agent {
            text.line(format!("{} {}{{}};", plan.cpp(function.ty, generator.assumed.acting), function.member));
            continue;
        }
        text.line(format!("{} {}{{}};", generator.storage(id).class, function.member));
    }
}

/// The source.
pub(crate) fn source(bodies: &Bodies<'_>, file: &str) -> Text {
    let generator = &bodies.generator;
    let plan = generator.plan;
    let mut text = Text::default();
    text.line(format!("// The rules of the machine {}, as {file}.hpp declares it.", generator.program.name));
    text.line(format!("#include \"{file}.hpp\"\n"));
    text.line(format!("namespace {} {{\n", plan.namespace));
    if !generator.tables.is_empty() {
        text.line("namespace {\n");
        for table in &generator.tables {
            let constant = if table.dynamic { "const" } else { "constexpr" };
            text.line(format!("{constant} auto {} = {};", table.name, table.contents));
        }
        text.line("\n}  // namespace\n");
    }
    frame(bodies, &mut text);
    for member in bodies.initials.iter().map(|(_, member)| member).chain(&bodies.definitions).chain(&bodies.procedures)
    {
        text.line("");
        member.definition.clone().pour(&mut text);
    }
    text.line(format!("\n}}  // namespace {}", plan.namespace));
    text
}

/// The members that start the machine and make steps.
fn frame(bodies: &Bodies<'_>, text: &mut Text) {
    let generator = &bodies.generator;
    let (program, plan) = (generator.program, generator.plan);
    let own: Vec<String> =
        functions(generator, &[Role::Agent]).iter().map(|(_, function)| function.member.clone()).collect();
    text.open("gs::Fault Machine::start() {");
    if generator.reach.needs(Need::Depth) {
        text.line("calls_ = 0;");
    }
    text.open("return gs::attempt([&] {");
    bodies.start.clone().pour(text);
    let kept: Vec<String> = kept_from_start(generator).into_iter().map(|(member, _)| member).collect();
    if !kept.is_empty() {
        text.line(format!("at_start_ = {{{}}};", kept.join(", ")));
        text.line("started_ = true;");
    }
    text.between("}, [&] {");
    text.line("roll_back();");
    text.close("});");
    text.close("}\n");
    text.open("gs::Fault Machine::step() {");
    if generator.reach.needs(Need::Rounds) {
        text.line("iterations_ = 0;");
    }
    if generator.reach.needs(Need::Depth) {
        text.line("calls_ = 0;");
    }
    for member in &own {
        text.line(format!("const auto former = {member};"));
    }
    let main = match program.main {
        Some(main) => format!("{}(next);", plan.procedure(main)),
        None => "gs::fail(gs::FaultKind::no_main, 0, 0);".to_string(),
    };
    let begun: Vec<String> = stepped(generator).iter().map(|function| format!("{}.begin()", function.member)).collect();
    text.line(format!("[[maybe_unused]] Next next{{{}}};", begun.join(", ")));
    text.open("const gs::Fault fault = gs::attempt([&] {");
    text.line(main);
    text.between("}, [&] {");
    text.line("roll_back();");
    own.iter().for_each(|member| text.line(format!("{member} = former;")));
    if counts_steps(generator) {
        text.line("++step_;");
    }
    text.close("});");
    text.open("if (fault) {");
    text.line("return fault;");
    text.close("}");
    text.line("std::uint64_t changed = 0;");
    for function in stepped(generator) {
        text.line(format!("changed |= {}.commit(next.{});", function.member, function.name));
    }
    for member in logs(generator) {
        text.line(format!("changed |= {}.commit();", member.trim_end_matches(".locations")));
    }
    text.line("changed_ = changed != 0;");
    if counts_steps(generator) {
        // Inputs that were asked for in the initial state stay valid in the first step.
        text.line("++step_;");
    }
    text.line("return {};");
    text.close("}\n");
    text.open("void Machine::roll_back() {");
    for member in logs(generator) {
        text.line(format!("{member}.roll_back();"));
    }
    text.close("}\n");
    if generator.reach.needs(Need::Rounds) {
        text.open("void Machine::iteration(gs::Site site) {");
        text.line("// LIMIT: rounds of loops in one step, as the machine has it.");
        text.open("if (++iterations_ > 1'000'000) {");
        text.line("gs::fail(gs::FaultKind::limit, site, site);");
        text.close("}");
        text.close("}");
    }
    accessors(generator, text);
    agents(bodies, text);
    if generator.reach.needs(Need::Names) {
        names(generator, text);
    }
}

fn agents(bodies: &Bodies<'_>, text: &mut Text) {
    let generator = &bodies.generator;
    let program = generator.program;
    if program.agents.is_empty() && !generator.reach.needs(Need::AgentProgram) {
        return;
    }
    let base = program.agents.first().map(|agent| program.base_domain(agent.domain));
    let ty = base.map_or(Type::Value, Type::Element);
    let agent = generator.plan.cpp(ty, false);
    text.open(format!("\nstd::int64_t Machine::program_of([[maybe_unused]] {agent} agent) {{"));
    if base.is_some() {
        text.open("if (!agent.defined) {");
        text.line("return -1;");
        text.close("}");
        bodies.agents.clone().pour(text);
    }
    text.line("return -1;");
    text.close("}");
    text.open(format!("\nvoid Machine::run_agent([[maybe_unused]] Next& next, {agent} agent, gs::Site site) {{"));
    let own = functions(generator, &[Role::Agent]);
    // `self` may be declared over a wider type than that of the agents.
    let own = own.first().filter(|(_, function)| function.ty == ty).map(|(_, function)| function.member.clone());
    if let Some(own) = &own {
        text.line(format!("const auto outer = {own};"));
    }
    text.open("switch (program_of(agent)) {");
    let mut done = std::collections::BTreeSet::new();
    for entry in &program.agents {
        // A domain without elements has no agents that could run the program.
        if !generator.reach.procedures.contains(&entry.procedure) || !done.insert(entry.procedure) {
            continue;
        }
        text.line(format!("case {}:", entry.procedure.0));
        if let Some(own) = &own {
            let value = if generator.assumed.acting && ty != Type::Value { ".value" } else { "" };
            text.line(format!("    {own} = agent{value};"));
        }
        text.line(format!("    {}(next);", generator.plan.procedure(entry.procedure)));
        text.line("    break;");
    }
    text.line("default: gs::fail(gs::FaultKind::not_a_rule, site, site);");
    text.close("}");
    if let Some(own) = &own {
        text.line(format!("{own} = outer;"));
    }
    text.close("}");
    if !generator.options.bare {
        text.open("\ngs::Value Machine::agent_program([[maybe_unused]] const gs::Value& agent) {");
        match base {
            Some(base) => {
                let name = generator.plan.domain(base).name();
                text.line(format!("const std::int64_t rule = program_of(gs::unbox<{name}>(agent, 0));"));
                text.line("return rule < 0 ? gs::Value{} : gs::Value::rule(static_cast<std::uint32_t>(rule));");
            }
            None => text.line("return {};"),
        }
        text.close("}");
    }
}

/// The names under which values are printed.
fn names(generator: &Generator<'_>, text: &mut Text) {
    let program = generator.program;
    text.open("\nconst gs::Names& Machine::names() {");
    let list = |names: &[String]| {
        let quoted: Vec<String> = names.iter().map(|name| format!("\"{}\"", escaped(name))).collect();
        quoted.join(", ")
    };
    for (index, domain) in program.domains.iter().enumerate() {
        if let DomainKind::Enum { literals: names } | DomainKind::Abstract { elements: names, .. } = &domain.kind
            && !names.is_empty()
        {
            text.line(format!(
                "static constexpr std::array<std::string_view, {}> domain_{index}{{{}}};",
                names.len(),
                list(names)
            ));
        }
    }
    text.open(format!("static constexpr std::array<gs::Names::Domain, {}> domains{{{{", program.domains.len()));
    for (index, domain) in program.domains.iter().enumerate() {
        let (names, kind) = match &domain.kind {
            DomainKind::Enum { literals } => (!literals.is_empty(), false),
            DomainKind::Abstract { elements, .. } => (!elements.is_empty(), true),
            _ => (false, false),
        };
        let table = if names { format!("domain_{index}") } else { "{}".to_string() };
        text.line(format!("{{\"{}\", {kind}, {table}}},", escaped(&domain.name)));
    }
    text.close("}};");
    let procedures: Vec<String> = program.procedures.iter().map(|procedure| procedure.name.clone()).collect();
    text.line(format!(
        "static constexpr std::array<std::string_view, {}> procedures{{{}}};",
        procedures.len(),
        list(&procedures)
    ));
    text.line("static constexpr gs::Names all{domains, procedures};");
    text.line("return all;");
    text.close("}");
}
