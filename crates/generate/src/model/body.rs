//! Generates the bodies of procedures, definitions and initial values, until no body refutes an assumption.
//!
//! In: a plan. Out: [`Bodies`], the member functions of the class with their declarations, and everything that they ask
//! for: places, tables, needs.

use std::collections::{BTreeMap, BTreeSet};

use program::{Expression, FunctionId, FunctionKind, ProcedureId, Program, Runs};
use syntax::Diagnostic;

use crate::model::code::unwrapped;
use crate::model::form::Form;
use crate::model::generator::{Assumptions, Generator, Need, Options};
use crate::model::interval::Interval;
use crate::model::plan::{FunctionPlan, Plan, Role};
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
    options: &'a Options,
    started: &machine::Machine,
) -> Result<Bodies<'a>, Vec<Diagnostic>> {
    let mut assumed = Assumptions::all(program);
    assumed.acting = acting(program);
    let known = known_values(program, started);
    // Only functions that no one but the model's rules writes can be assumed to be never undef.
    for (index, function) in plan.functions.iter().enumerate() {
        let fitting = function.role == Role::State
            && function.initial.is_some()
            && matches!(program.functions[index].kind, FunctionKind::Controlled | FunctionKind::Out);
        assumed.total[index] &= fitting;
    }
    let mut round = 0;
    loop {
        let mut generator = Generator::new(program, plan, writes, forms, options, assumed.clone());
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
    for procedure in program.main.into_iter().chain(program.agents.iter().map(|agent| agent.procedure)) {
        *generator.calls.entry(procedure).or_default() += 1;
    }
    generator.entered.extend(program.main);
    let mut procedures = Vec::new();
    let mut definitions = Vec::new();
    let mut initials = Vec::new();
    let mut done_procedures = BTreeSet::new();
    let mut done_functions = BTreeSet::new();
    // Generating a body may enter further procedures.
    loop {
        let next_procedure = generator.entered.iter().find(|id| !done_procedures.contains(*id)).copied();
        if let Some(id) = next_procedure {
            done_procedures.insert(id);
            procedures.push((id, procedure(generator, id)));
            continue;
        }
        let next_function = generator.reached.iter().find(|id| !done_functions.contains(*id)).copied();
        let Some(id) = next_function else { break };
        done_functions.insert(id);
        let role = generator.plan.function(id).role;
        if role == Role::Definition {
            definitions.push((id, definition(generator, id)));
        } else if let Some(initial) = generator.plan.function(id).initial
            && role != Role::Input
        {
            initials.push((id, initial_value(generator, id, initial, known)));
        }
    }
    for id in generator.reached.clone() {
        let plan = generator.plan.function(id).clone();
        if matches!(plan.role, Role::Input | Role::Shared) {
            let names: Vec<String> = (0..plan.dimensions.len()).map(crate::model::members::argument_name).collect();
            let asked = format!("environment_.{}({})", plan.name, names.join(", "));
            let asked = generator.checked(id, asked, Interval::ALL, "site");
            generator.asked.insert(id, asked);
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
    let recursive = is_recursive(program, id);
    if recursive {
        let site = generator.sites.number(procedure.span);
        generator.needs.insert(Need::Depth);
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
    let once = generator.calls.get(&id) == Some(&1) && !is_recursive(generator.program, id);
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
    let recursive = reads_itself(program, id);
    if recursive || !pure {
        generator.refuted.pure[id.0 as usize] = false;
    }
    if recursive {
        generator.needs.insert(Need::Depth);
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
    let (order, cyclic) = initial_order(program);
    for index in order {
        let initial = &program.initials[index];
        let plan = generator.plan.function(initial.function).clone();
        if matches!(plan.role, Role::Input | Role::None) {
            continue;
        }
        generator.reached.insert(initial.function);
        if cyclic.contains(&index) {
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
    for domain in &generator.carriers {
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

/// The initial values in an order in which none reads a later one, and those for which there is no such order.
fn initial_order(program: &Program) -> (Vec<usize>, BTreeSet<usize>) {
    let mut order = Vec::new();
    let mut cyclic = BTreeSet::new();
    let mut state = vec![0u8; program.initials.len()];
    let of: BTreeMap<FunctionId, usize> =
        program.initials.iter().enumerate().map(|(index, initial)| (initial.function, index)).collect();
    fn visit(
        program: &Program,
        of: &BTreeMap<FunctionId, usize>,
        index: usize,
        state: &mut [u8],
        order: &mut Vec<usize>,
        cyclic: &mut BTreeSet<usize>,
    ) {
        state[index] = 1;
        for read in program.all_reads(&program.initials[index].value).0 {
            let Some(next) = of.get(&read) else { continue };
            match state[*next] {
                0 => visit(program, of, *next, state, order, cyclic),
                1 => {
                    cyclic.insert(*next);
                }
                _ => {}
            }
        }
        state[index] = 2;
        order.push(index);
    }
    for index in 0..program.initials.len() {
        if state[index] == 0 && of.get(&program.initials[index].function) == Some(&index) {
            visit(program, &of, index, &mut state, &mut order, &mut cyclic);
        }
    }
    (order, cyclic)
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
        generator.entered.insert(procedure);
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

/// Whether `self` is read only in agents' programs, so that it is always defined.
fn acting(program: &Program) -> bool {
    let Some(own) = program.self_function else { return false };
    let mut procedures: Vec<ProcedureId> = program.main.into_iter().collect();
    let mut terms: Vec<_> = program.initials.iter().map(|initial| initial.value.body).collect();
    let mut entered: BTreeSet<ProcedureId> = procedures.iter().copied().collect();
    while let Some(procedure) = procedures.pop() {
        let mut rules = vec![program.procedure(procedure).body];
        while let Some(rule) = rules.pop() {
            let called: Vec<ProcedureId> = match program.rule(rule).runs() {
                Runs::Procedure(procedure) => vec![procedure],
                Runs::Value { .. } => crate::model::nesting::runnable(program).collect(),
                // The agent runs its program, so there is a `self`.
                Runs::Agent | Runs::Nothing => Vec::new(),
            };
            procedures.extend(called.into_iter().filter(|called| entered.insert(*called)));
            program.each_term_of_rule(rule, &mut |term| terms.push(term));
            program.each_child_of_rule(rule, &mut |child| rules.push(child));
        }
    }
    let mut defined = BTreeSet::new();
    while let Some(term) = terms.pop() {
        match program.term(term) {
            program::Term::Read { function, .. } if *function == own => return false,
            program::Term::Define { function, .. } if defined.insert(*function) => {
                terms.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
            }
            _ => {}
        }
        program.each_child_of_term(term, &mut |child| terms.push(child));
    }
    program.initials.iter().all(|initial| initial.function != own)
}

/// Whether a procedure calls itself, directly or through others.
fn is_recursive(program: &Program, id: ProcedureId) -> bool {
    let mut entered = vec![false; program.procedures.len()];
    let mut open = vec![id];
    while let Some(next) = open.pop() {
        let mut rules = vec![program.procedure(next).body];
        while let Some(rule) = rules.pop() {
            let called = match program.rule(rule).runs() {
                Runs::Procedure(procedure) => vec![procedure],
                Runs::Value { arguments } => {
                    let fits = |id: &ProcedureId| program.procedure(*id).parameters.len() == arguments.len as usize;
                    crate::model::nesting::runnable(program).filter(fits).collect()
                }
                Runs::Agent => program.agents.iter().map(|agent| agent.procedure).collect(),
                Runs::Nothing => Vec::new(),
            };
            for procedure in called {
                if procedure == id {
                    return true;
                }
                if !std::mem::replace(&mut entered[procedure.0 as usize], true) {
                    open.push(procedure);
                }
            }
            program.each_child_of_rule(rule, &mut |child| rules.push(child));
        }
    }
    false
}

/// Whether a definition reads itself, directly or through others.
fn reads_itself(program: &Program, id: FunctionId) -> bool {
    let mut entered = vec![false; program.functions.len()];
    let mut open: Vec<_> = program.function(id).definition.iter().map(|definition| definition.body).collect();
    while let Some(term) = open.pop() {
        if let program::Term::Define { function, .. } = program.term(term) {
            if *function == id {
                return true;
            }
            if !std::mem::replace(&mut entered[function.0 as usize], true) {
                open.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
            }
        }
        program.each_child_of_term(term, &mut |child| open.push(child));
    }
    false
}
