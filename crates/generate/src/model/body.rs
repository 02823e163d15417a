//! Generates the bodies of procedures, definitions and initial values, until no body refutes an assumption.
//!
//! In: a plan, and what the class needs. Out: [`Bodies`], the member functions of the class with their declarations, and
//! what is collected while they are printed: places and tables.

use std::collections::BTreeMap;

use program::{Expression, FunctionId, ProcedureId, Program};
use syntax::Diagnostic;

use crate::model::assumptions::Assumptions;
use crate::model::code::unwrapped;
use crate::model::form::Form;
use crate::model::generator::{Generator, Options};
use crate::model::interval::Interval;
use crate::model::plan::{FunctionPlan, Plan, Role};
use crate::model::reach::{Part, Reach};
use crate::model::text::Text;
use crate::model::types::Type;
use crate::model::writes::Writes;

/// A member function: its declaration within the class, and its definition.
#[derive(Debug, Clone)]
pub(crate) struct Member {
    pub declaration: String,
    pub definition: Text,
}

/// LIMIT: how many rounds intervals grow step by step before they are widened.
const EXACT_ROUNDS: u32 = 8;

/// LIMIT: procedures with more lines than this are not inlined.
const INLINED_LINES: usize = 200;

/// The member functions, in the order of the model.
#[derive(Debug)]
pub(crate) struct Bodies<'a> {
    pub generator: Generator<'a>,
    pub procedures: Vec<Member>,
    pub definitions: Vec<Member>,
    /// `initial_f(arguments)`, by function.
    pub initials: Vec<(FunctionId, Member)>,
    /// The statements of `start`.
    pub start: Text,
    /// Parts of `run_agent` and `run_value`.
    pub agents: Text,
}

/// Generates all bodies.
pub(crate) fn bodies<'a>(
    program: &'a Program,
    plan: &'a Plan,
    writes: &'a Writes,
    forms: &'a [Form],
    reach: &'a Reach,
    options: &'a Options,
    started: &machine::Machine,
) -> Result<Bodies<'a>, Vec<Diagnostic>> {
    let mut assumed = Assumptions::all(program, plan);
    let known = known_values(program, started);
    let mut round = 0;
    loop {
        let mut generator = Generator::new(program, plan, writes, forms, reach, options, assumed.clone());
        let bodies = once(&mut generator, started, &known);
        if generator.refuted == assumed {
            if !generator.refused.is_empty() {
                return Err(generator.refused);
            }
            let (procedures, definitions, initials, start, agents) = bodies;
            return Ok(Bodies { generator, procedures, definitions, initials, start, agents });
        }
        assumed = match round {
            0..EXACT_ROUNDS => generator.refuted,
            _ => generator.refuted.widened(&assumed),
        };
        round += 1;
    }
}

type Parts = (Vec<Member>, Vec<Member>, Vec<(FunctionId, Member)>, Text, Text);

fn once(generator: &mut Generator<'_>, started: &machine::Machine, known: &Known) -> Parts {
    let program = generator.program;
    let mut start = Text::default();
    start_state(generator, started, &mut start);
    let mut agents = Text::default();
    if !program.agents.is_empty() {
        run_agent(generator, &mut agents);
    }
    let mut procedures = Vec::new();
    let mut definitions = Vec::new();
    let mut initials = Vec::new();
    let reach = generator.reach;
    for part in &reach.parts {
        match *part {
            Part::Procedure(id) => procedures.push((id, procedure(generator, id))),
            Part::Function(id) => {
                let plan = generator.plan.function(id);
                match (plan.role, plan.initial) {
                    (Role::Definition, _) => definitions.push((id, definition(generator, id))),
                    (Role::Input, _) | (_, None) => {}
                    (_, Some(initial)) => initials.push((id, initial_value(generator, id, initial, known))),
                }
            }
        }
    }
    for id in &reach.functions {
        let plan = generator.plan.function(*id).clone();
        if matches!(plan.role, Role::Input | Role::Shared) {
            let names: Vec<String> = (0..plan.dimensions.len()).map(crate::model::members::argument_name).collect();
            let asked = format!("environment_.{}({})", plan.name, names.join(", "));
            let asked = generator.checked(*id, asked, Interval::ALL, "site");
            generator.asked.insert(*id, asked);
        }
    }
    let mut whole = Text::default();
    start_carriers(generator, &mut whole);
    start.pour(&mut whole);
    procedures.sort_by_key(|(id, _)| *id);
    for (id, member) in &mut procedures {
        inline_once(generator, *id, member);
    }
    definitions.sort_by_key(|(id, _)| *id);
    initials.sort_by_key(|(id, _)| *id);
    let members = |all: Vec<(ProcedureId, Member)>| all.into_iter().map(|(_, member)| member).collect();
    let definitions = definitions.into_iter().map(|(_, member)| member).collect();
    (members(procedures), definitions, initials, whole, agents)
}

fn procedure(generator: &mut Generator<'_>, id: ProcedureId) -> Member {
    let program = generator.program;
    let procedure = program.procedure(id);
    let defined = generator.assumed.parameters[id.0 as usize].iter().copied();
    let assumed: Vec<_> = defined.zip(generator.assumed.parameter_ranges[id.0 as usize].iter().copied()).collect();
    let parameters = generator.enter(&procedure.parameters, &assumed, procedure.frame, &procedure.names);
    let name = generator.plan.procedure(id).to_string();
    let parameters: Vec<String> = std::iter::once("Next& next".to_string()).chain(parameters).collect();
    let list = parameters.join(", ");
    let mut text = Text::default();
    text.open_marked(procedure.span, format!("void Machine::{name}({}) {{", silenced(&parameters)));
    let recursive = generator.reach.is_recursive(id);
    if recursive {
        let site = generator.sites.number(procedure.span);
        text.line(format!("gs::enter(calls_, {site});"));
    }
    generator.rule(procedure.body, &mut text);
    if recursive {
        text.line("--calls_;");
    }
    text.close("}");
    Member { declaration: format!("inline void {name}({list});"), definition: text }
}

/// Forces inlining of a procedure that is called at only one place, whatever the compiler estimates. What a step
/// updates then stays in registers.
fn inline_once(generator: &Generator<'_>, id: ProcedureId, member: &mut Member) {
    let once = generator.reach.is_called_once(id) && !generator.reach.is_recursive(id);
    if once && member.definition.plain().lines().count() <= INLINED_LINES {
        member.declaration = format!("[[gnu::always_inline]] {}", member.declaration);
    }
}

/// Silences warnings about parameters that the body does not use.
fn silenced(parameters: &[String]) -> String {
    parameters.iter().map(|parameter| format!("[[maybe_unused]] {parameter}")).collect::<Vec<_>>().join(", ")
}

fn definition(generator: &mut Generator<'_>, id: FunctionId) -> Member {
    let program = generator.program;
    let function = program.function(id);
    let Some(expression) = &function.definition else {
        return Member { declaration: String::new(), definition: Text::default() };
    };
    let plan = generator.plan.function(id).clone();
    let defined = generator.assumed.arguments[id.0 as usize].iter().copied();
    let assumed: Vec<_> = defined.zip(generator.assumed.argument_ranges[id.0 as usize].iter().copied()).collect();
    let parameters = generator.enter(&expression.parameters, &assumed, expression.frame, &expression.names);
    let site = generator.sites.number(program.term_span(expression.body));
    let code = generator.term(expression.body);
    let code = generator.cast(code, plan.ty, site);
    if !code.defined {
        generator.refuted.result[id.0 as usize] = false;
    }
    // A value of another type is converted, which may fault.
    let pure = code.pure && code.ty == plan.ty;
    let range = &mut generator.refuted.values[id.0 as usize];
    *range = range.join(code.range);
    let defined = generator.assumed.result[id.0 as usize] && plan.ty != Type::Value;
    let body = generator.convert(code, plan.ty, defined, site);
    let result = generator.plan.cpp(plan.ty, defined);
    let mut text = Text::default();
    text.open_marked(function.span, format!("{result} Machine::{}({}) {{", plan.name, silenced(&parameters)));
    let body = unwrapped(&body);
    let recursive = generator.reach.reads_itself(id);
    if recursive || !pure {
        generator.refuted.pure[id.0 as usize] = false;
    }
    if recursive {
        text.line(format!("gs::enter(calls_, {site});"));
        let value = generator.frame.scope.take("value");
        text.marked(program.term_span(expression.body), format!("auto {value} = {body};"));
        text.line("--calls_;");
        text.line(format!("return {value};"));
    } else {
        text.marked(program.term_span(expression.body), format!("return {body};"));
    }
    text.close("}");
    Member { declaration: format!("inline {result} {}({});", plan.name, parameters.join(", ")), definition: text }
}

/// The initial value of one location, as a function of its arguments.
fn initial_value(generator: &mut Generator<'_>, id: FunctionId, initial: usize, known: &Known) -> Member {
    let program = generator.program;
    let expression: &Expression = &program.initials[initial].value;
    let plan = generator.plan.function(id).clone();
    // A location may be read with an argument that is undef.
    let eager = !generator.is_lazy(id);
    let parameters = program.function(id).parameters.iter().enumerate();
    let assumed: Vec<_> = parameters
        .map(|(place, domain)| match eager {
            true => (!generator.has_undef_place(id, place), generator.domain_interval(*domain)),
            false => (false, Interval::ALL),
        })
        .collect();
    let parameters = generator.enter(&expression.parameters, &assumed, expression.frame, &expression.names);
    let site = generator.sites.number(program.term_span(expression.body));
    let code = generator.term(expression.body);
    let code = generator.cast(code, plan.ty, site);
    let (total, range) = match known.get(&id) {
        // Nothing changes them, and all of them are known.
        Some(known) if generator.is_fixed(id) && generator.is_inside(id) => {
            (known.count == generator.places(id), known.range)
        }
        _ => (code.defined, code.range),
    };
    if !total {
        generator.refuted.total[id.0 as usize] = false;
    }
    if eager && !generator.is_inside(id) && !code.pure {
        generator.refuted.eager[id.0 as usize] = false;
    }
    let values = &mut generator.refuted.values[id.0 as usize];
    *values = values.join(range);
    let defined = generator.assumed.total[id.0 as usize] && plan.ty != Type::Value;
    let body = generator.convert(code, plan.ty, defined, site);
    let result = generator.plan.cpp(plan.ty, defined);
    let mut text = Text::default();
    let list = silenced(&parameters);
    text.open_marked(program.initials[initial].span, format!("{result} Machine::initial_{}({list}) {{", plan.name));
    text.marked(program.term_span(expression.body), format!("return {};", unwrapped(&body)));
    text.close("}");
    Member { declaration: format!("{result} initial_{}({});", plan.name, parameters.join(", ")), definition: text }
}

/// The statements that set the initial state.
fn start_state(generator: &mut Generator<'_>, started: &machine::Machine, text: &mut Text) {
    let program = generator.program;
    for index in generator.reach.initials.iter().copied() {
        let initial = &program.initials[index];
        let plan = generator.plan.function(initial.function).clone();
        if matches!(plan.role, Role::Input | Role::None) {
            continue;
        }
        if generator.reach.cyclic_initials.contains(&index) {
            generator.refuted.eager[initial.function.0 as usize] = false;
            generator.refuted.values[initial.function.0 as usize] = Interval::ALL;
            set_as_computed(generator, initial.function, &plan, started, text);
        } else {
            set_initial(generator, index, &plan, text);
        }
    }
}

/// Sets the initial elements of growing domains.
fn start_carriers(generator: &Generator<'_>, text: &mut Text) {
    for domain in &generator.reach.carriers {
        let plan = generator.plan.domain(*domain);
        let Some(carrier) = &plan.carrier else { continue };
        match &generator.program.domain(*domain).kind {
            program::DomainKind::Abstract { elements, .. } => {
                text.line(format!("{carrier} = decltype({carrier}){{{}}};", elements.len()));
            }
            _ => {
                text.line(format!("{carrier} = {{}};"));
                plan.initial.iter().for_each(|element| text.line(format!("{carrier}.add({element}, 0);")));
            }
        }
    }
}

/// Sets each location, by loops over all arguments.
fn set_initial(generator: &mut Generator<'_>, index: usize, plan: &FunctionPlan, text: &mut Text) {
    let program = generator.program;
    let initial = &program.initials[index];
    let site = generator.sites.number(initial.span);
    let parameters = &program.function(initial.function).parameters;
    if plan.role == Role::Agent {
        text.marked(initial.span, format!("{} = initial_{}();", plan.member, plan.name));
        return;
    }
    let mut names = Vec::new();
    let mut scope = generator.plan.members.clone();
    let mut ranges = Vec::new();
    for (place, parameter) in parameters.iter().enumerate() {
        // Initial values over domains that cannot be enumerated are computed when they are read.
        let Some((range, _)) = generator.domain_range(*parameter) else { return };
        let undef = generator.has_undef_place(initial.function, place);
        ranges.push(if undef { format!("gs::and_undef({range})") } else { range });
        names.push(scope.take("argument"));
    }
    for (range, name) in ranges.iter().zip(&names) {
        text.open(format!("for (const auto {name} : {range}) {{"));
    }
    let list = names.join(", ");
    let comma = if list.is_empty() { "" } else { ", " };
    let place = format!("{}.number({site}{comma}{list})", plan.member);
    if plan.role == Role::Shared {
        text.marked(initial.span, format!("{}.set({site}, initial_{}({list}){comma}{list});", plan.member, plan.name));
    } else {
        text.marked(initial.span, format!("{}.put({place}, initial_{}({list}));", plan.member, plan.name));
    }
    ranges.iter().for_each(|_| text.close("}"));
}

/// Sets each location to the value that the machine computed, for functions whose initial values depend on each other.
fn set_as_computed(
    generator: &mut Generator<'_>,
    function: FunctionId,
    plan: &FunctionPlan,
    started: &machine::Machine,
    text: &mut Text,
) {
    let span = generator.program.function(function).span;
    let site = generator.sites.number(span);
    let parameters = generator.program.function(function).parameters.clone();
    for (location, value) in started.locations() {
        if location.function != function {
            continue;
        }
        let mut list = vec![site.to_string()];
        for (argument, domain) in location.arguments.iter().zip(&parameters) {
            let ty = generator.parameter_type(*domain);
            list.push(match ty {
                Type::Integer => format!("std::int64_t{{{}}}", generator.constant(argument, ty)),
                _ => generator.constant(argument, ty),
            });
        }
        let value = generator.constant(&value, plan.ty);
        text.line(format!("{}.put({}.number({}), {value});", plan.member, plan.member, list.join(", ")));
    }
}

/// Selects an agent's program: that of its most specific domain, which comes first.
fn run_agent(generator: &mut Generator<'_>, text: &mut Text) {
    let program = generator.program;
    let agents: Vec<_> = program.agents.iter().map(|agent| (agent.domain, agent.procedure)).collect();
    for (domain, procedure) in agents {
        let condition = match (generator.carrier(domain), &program.domain(domain).kind) {
            (_, program::DomainKind::Abstract { .. }) => "true".to_string(),
            (None, program::DomainKind::Concrete { base, .. }) if generator.is_all_of(domain, *base) => {
                "true".to_string()
            }
            (Some(carrier), _) => format!("{carrier}.contains(agent.value.element)"),
            (None, _) => match generator.plan.domain(domain).contents.clone() {
                Some(contents) => {
                    let table = generator.contents_table(domain, &contents);
                    format!("gs::among(agent.value, {table})")
                }
                None => continue,
            },
        };
        text.open(format!("if ({condition}) {{"));
        text.line(format!("return {};", procedure.0));
        text.close("}");
    }
}

/// By function, the values of its locations in the initial state, if they do not depend on the environment.
type Known = BTreeMap<FunctionId, KnownValues>;

#[derive(Debug)]
struct KnownValues {
    /// How many locations have a value.
    count: u64,
    /// An interval that contains the integers among them.
    range: Interval,
}

fn known_values(program: &Program, started: &machine::Machine) -> Known {
    let mut known = Known::new();
    for (location, value) in started.locations() {
        let initial = program.initials.iter().find(|initial| initial.function == location.function);
        if initial.is_none_or(|initial| program.reads(&initial.value).is_none()) {
            continue;
        }
        let found = known.entry(location.function).or_insert(KnownValues { count: 0, range: Interval::EMPTY });
        found.count += u64::from(!location.arguments.iter().any(machine::Value::is_undef));
        found.range = match value {
            machine::Value::Integer(number) => found.range.join(Interval::of(number)),
            _ => found.range,
        };
    }
    known
}
