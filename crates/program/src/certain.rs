//! What is certain of values, whatever state a machine reaches: that they are not undef, and the bounds of integers.
//!
//! In: a program, and what is known of its locations before the first step ([`Locations`]). Out: what is [`Certain`] of each function's
//! values, of the parameters and results of procedures and definitions, and of any term. All is assumed at first, and then refuted by what
//! the program writes and passes until nothing more is: the greatest solution (Nielson, Nielson & Hankin 1999, chapter 2). INVARIANT: an
//! answer that claims too little is always right; a term that has no value at all, for a fault, may be claimed of anything.

use crate::builtin::Builtin;
use crate::ir::{
    BinderList, DomainKind, Expression, ProcedureId, Program, Rule, RuleId, RuleList, Runs, Slot, Term, TermId,
    TermList,
};
use model::{CollectionKind, DomainId, FunctionId, Literal, Quantifier};

/// What is certain of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Certain {
    /// It is not undef.
    pub defined: bool,
    /// No element is undef, if it is a sequence, a set or a bag.
    pub solid: bool,
    /// It lies within these bounds, if it is an integer; both are included.
    pub bounds: Option<(i64, i64)>,
}

impl Certain {
    /// Nothing is.
    pub const NOTHING: Certain = Certain { defined: false, solid: false, bounds: None };
    /// Of undef: it has no elements.
    const UNDEF: Certain = Certain { solid: true, ..Certain::NOTHING };
    /// A value that is neither undef nor a collection.
    pub const DEFINED: Certain = Certain { defined: true, solid: true, bounds: None };

    /// A collection whose elements are defined if that is known.
    fn collection(solid: bool) -> Certain {
        Certain { defined: true, solid, bounds: None }
    }

    /// What is certain of a value that is one of two.
    #[must_use]
    pub fn or(self, other: Certain) -> Certain {
        Certain {
            defined: self.defined && other.defined,
            solid: self.solid && other.solid,
            bounds: self.bounds.zip(other.bounds).map(|((a, b), (c, d))| (a.min(c), b.max(d))),
        }
    }
}

/// What is known of locations whatever rules do.
pub trait Locations {
    /// What is certain of the values that a function has before the first step, in all initial states that the steps may begin from; nothing
    /// of a function that anybody but rules and initial values gives values to, or that has no initial value everywhere.
    fn before_steps(&self, function: FunctionId) -> Certain;

    /// What is certain of the values of a function at the locations that have a place, if these values stay as they are.
    fn at_places(&self, function: FunctionId) -> Option<Certain>;

    /// The bounds that every value has that a rule writes to a function: no other one can be written.
    fn bounds_of_updates(&self, function: FunctionId) -> Option<(i64, i64)>;

    /// Whether an argument surely leads to a place, at that position among a function's parameters: a defined value of this domain, within
    /// these bounds if it is an integer.
    fn has_place(&self, function: FunctionId, position: usize, domain: DomainId, bounds: Option<(i64, i64)>) -> bool;

    /// The least and the greatest element of a domain of integers that has the same elements in all states.
    fn bounds_of_elements(&self, domain: DomainId) -> Option<(i64, i64)>;
}

/// Who may run the procedures of a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Entered {
    /// Nothing but the main rule is run from outside, and no agent runs that.
    MainAlone,
    /// Any procedure may be.
    Any,
}

/// What is known of a procedure or a definition.
#[derive(Debug, Clone, PartialEq)]
struct Body {
    /// Agents alone run it: within it, `self` is defined.
    of_agents: bool,
    parameters: Vec<Certain>,
}

impl Body {
    fn assumed(parameters: usize, of_agents: bool) -> Body {
        Body { of_agents, parameters: vec![Certain::DEFINED; parameters] }
    }

    /// It is run with these arguments, and maybe not by an agent.
    fn run(&mut self, arguments: &[Certain], by_agent: bool) {
        self.of_agents &= by_agent;
        for (parameter, argument) in self.parameters.iter_mut().zip(arguments) {
            *parameter = parameter.or(*argument);
        }
    }
}

/// See the module.
#[derive(Debug, Clone, PartialEq)]
pub struct Certainty {
    /// By function: of the values at all its locations; of a definition, the value that it gives.
    functions: Vec<Certain>,
    /// The same at the locations that have a place, where the values there stay as they are.
    at_places: Vec<Option<Certain>>,
    procedures: Vec<Body>,
    /// By function; of use where it has a definition.
    definitions: Vec<Body>,
}

impl Certainty {
    /// Finds what is certain in a program.
    pub fn of(program: &Program, locations: &dyn Locations, entered: Entered) -> Certainty {
        let before = |index: usize| match program.functions[index].definition {
            Some(_) => Certain::DEFINED,
            None => locations.before_steps(FunctionId(index as u32)),
        };
        let of_agents = |index: usize| entered == Entered::MainAlone && program.main != Some(ProcedureId(index as u32));
        let procedures = program.procedures.iter().enumerate();
        let mut certainty = Certainty {
            functions: (0..program.functions.len()).map(before).collect(),
            at_places: (0..program.functions.len() as u32).map(|id| locations.at_places(FunctionId(id))).collect(),
            procedures: procedures.map(|(index, it)| Body::assumed(it.parameters.len(), of_agents(index))).collect(),
            definitions: program.functions.iter().map(|it| Body::assumed(it.parameters.len(), true)).collect(),
        };
        loop {
            let mut refuted = certainty.clone();
            Walk::new(program, locations, &certainty, Some(&mut refuted)).everything();
            if refuted == certainty {
                return certainty;
            }
            certainty = refuted;
        }
    }

    /// What is certain of a function's value at a location that has a place.
    pub fn at_place(&self, function: FunctionId) -> Certain {
        self.at_places[function.0 as usize].unwrap_or(self.functions[function.0 as usize])
    }

    /// What is certain of a function's value at any location; of one with a definition, of the value that it gives.
    pub fn function(&self, function: FunctionId) -> Certain {
        self.functions[function.0 as usize]
    }

    /// Whether agents alone run a procedure: within it, `self` is one.
    pub fn procedure_is_of_agents(&self, procedure: ProcedureId) -> bool {
        self.procedures[procedure.0 as usize].of_agents
    }

    /// Whether agents alone evaluate a definition.
    pub fn definition_is_of_agents(&self, function: FunctionId) -> bool {
        self.definitions[function.0 as usize].of_agents
    }

    /// What is certain of the arguments that a procedure is run with.
    pub fn parameters_of_procedure(&self, procedure: ProcedureId) -> &[Certain] {
        &self.procedures[procedure.0 as usize].parameters
    }

    /// What is certain of the arguments that a definition is applied to.
    pub fn parameters_of_definition(&self, function: FunctionId) -> &[Certain] {
        &self.definitions[function.0 as usize].parameters
    }

    /// What is certain of a term's value, given what is of the variables that occur free in it.
    pub fn term(
        &self,
        program: &Program,
        locations: &dyn Locations,
        term: TermId,
        free: &dyn Fn(Slot) -> Certain,
    ) -> Certain {
        let mut walk = Walk::new(program, locations, self, None);
        let mut open = vec![term];
        while let Some(id) = open.pop() {
            if let Term::Slot(slot) = program.term(id) {
                walk.bind(*slot, free(*slot));
            }
            program.each_child_of_term(id, &mut |child| open.push(child));
        }
        walk.term(term)
    }
}

/// One round through a program or a term: what is known, and what is left of it.
struct Walk<'a> {
    program: &'a Program,
    locations: &'a dyn Locations,
    known: &'a Certainty,
    /// None where nothing is to be refuted: what the whole program writes and passes was looked at before.
    left: Option<&'a mut Certainty>,
    /// By slot of the running frame. Only one place binds a slot, and nothing reads it before.
    frame: Vec<Certain>,
    by_agent: bool,
    seen_terms: Vec<bool>,
    seen_rules: Vec<bool>,
}

impl<'a> Walk<'a> {
    fn new(
        program: &'a Program,
        locations: &'a dyn Locations,
        known: &'a Certainty,
        left: Option<&'a mut Certainty>,
    ) -> Walk<'a> {
        let (seen_terms, seen_rules) = (vec![false; program.terms.len()], vec![false; program.rules.len()]);
        Walk { program, locations, known, left, frame: Vec::new(), by_agent: false, seen_terms, seen_rules }
    }

    fn everything(&mut self) {
        let program = self.program;
        for (procedure, body) in program.procedures.iter().zip(&self.known.procedures) {
            self.enter(body);
            self.rule(procedure.body);
        }
        for ((index, function), body) in program.functions.iter().enumerate().zip(&self.known.definitions) {
            if let Some(definition) = &function.definition {
                self.enter(body);
                // The bounds of what a recursion gives might grow for ever.
                let value = Certain { bounds: None, ..self.term(definition.body) };
                self.meet(FunctionId(index as u32), value);
            }
        }
        for initial in &program.initials {
            // It is evaluated at arguments of any kind.
            let value = self.expression(&initial.value);
            self.meet(initial.function, value);
        }
        // What nothing above leads to may be run and evaluated by anybody, for anything.
        for id in (0..program.rules.len() as u32).rev().map(RuleId) {
            if !self.seen_rules[id.0 as usize] {
                self.enter(&Body { of_agents: false, parameters: Vec::new() });
                self.rule(id);
            }
        }
        for id in (0..program.terms.len() as u32).rev().map(TermId) {
            if !self.seen_terms[id.0 as usize] {
                self.enter(&Body { of_agents: false, parameters: Vec::new() });
                self.term(id);
            }
        }
    }

    fn enter(&mut self, body: &Body) {
        self.frame.clear();
        self.frame.extend_from_slice(&body.parameters);
        self.by_agent = body.of_agents;
    }

    fn expression(&mut self, expression: &Expression) -> Certain {
        self.enter(&Body { of_agents: false, parameters: Vec::new() });
        self.term(expression.body)
    }

    fn meet(&mut self, function: FunctionId, value: Certain) {
        if let Some(left) = &mut self.left {
            let left = &mut left.functions[function.0 as usize];
            *left = left.or(value);
        }
    }

    fn bind(&mut self, slot: Slot, certain: Certain) {
        let index = slot.0 as usize;
        if self.frame.len() <= index {
            self.frame.resize(index + 1, Certain::NOTHING);
        }
        self.frame[index] = certain;
    }

    fn bind_all(&mut self, binders: BinderList) {
        for binder in self.program.binder_list(binders) {
            let element = match self.program.term(binder.range) {
                Term::Domain(domain) => Certain {
                    // The elements of a domain of collections hold whatever their parts do.
                    solid: self.is_scalar(*domain),
                    bounds: self.locations.bounds_of_elements(*domain),
                    ..Certain::DEFINED
                },
                _ => Certain { defined: self.term(binder.range).solid, ..Certain::NOTHING },
            };
            self.bind(binder.slot, element);
        }
    }

    fn is_scalar(&self, domain: DomainId) -> bool {
        match &self.program.domain(domain).kind {
            DomainKind::Basic(_) | DomainKind::Enum { .. } | DomainKind::Abstract { .. } | DomainKind::Rule(_) => true,
            DomainKind::Concrete { base, .. } => self.is_scalar(*base),
            DomainKind::Error
            | DomainKind::Any
            | DomainKind::Prod(_)
            | DomainKind::Seq(_)
            | DomainKind::Powerset(_)
            | DomainKind::Bag(_)
            | DomainKind::Map(..) => false,
        }
    }

    // ---- terms

    fn terms(&mut self, list: TermList) -> Vec<Certain> {
        self.program.term_list(list).iter().map(|term| self.term(*term)).collect()
    }

    fn term(&mut self, id: TermId) -> Certain {
        stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.term_here(id))
    }

    fn term_here(&mut self, id: TermId) -> Certain {
        self.seen_terms[id.0 as usize] = true;
        let program = self.program;
        match program.term(id) {
            Term::Constant(index) => constant(&program.constants[*index as usize]),
            Term::Slot(slot) => self.frame.get(slot.0 as usize).copied().unwrap_or(Certain::NOTHING),
            Term::Read { function, arguments } => self.read(*function, *arguments),
            Term::Define { function, arguments } => {
                let arguments = self.terms(*arguments);
                if let Some(left) = &mut self.left {
                    left.definitions[function.0 as usize].run(&arguments, self.by_agent);
                }
                match program.function(*function).definition {
                    Some(_) => self.known.functions[function.0 as usize],
                    None => Certain::UNDEF,
                }
            }
            Term::Builtin { builtin, arguments } => {
                let arguments = self.terms(*arguments);
                of_builtin(*builtin, &arguments)
            }
            Term::Domain(_) => Certain { solid: false, ..Certain::DEFINED },
            Term::Tuple(list) => {
                self.terms(*list);
                Certain { solid: false, ..Certain::DEFINED }
            }
            Term::Collection { kind, elements } => {
                let solid = self.terms(*elements).iter().all(|element| element.defined);
                Certain::collection(solid && *kind != CollectionKind::Map)
            }
            Term::Range { low, high, step, .. } => {
                [Some(*low), Some(*high), *step].into_iter().flatten().for_each(|bound| _ = self.term(bound));
                Certain::collection(true)
            }
            Term::Comprehension { kind, binders, condition, body } => {
                self.bind_all(*binders);
                condition.iter().for_each(|condition| _ = self.term(*condition));
                let element = self.term(*body);
                Certain::collection(element.defined && *kind != CollectionKind::Map)
            }
            Term::Quantified {
                quantifier: Quantifier::Exists | Quantifier::Forall | Quantifier::ExistsUnique,
                binders,
                condition,
            } => {
                self.bind_all(*binders);
                condition.iter().for_each(|condition| _ = self.term(*condition));
                Certain::DEFINED
            }
            Term::If { branches: pairs, otherwise } => self.one_of(*pairs, *otherwise),
            Term::Switch { subject, cases: pairs, otherwise } => {
                self.term(*subject);
                self.one_of(*pairs, *otherwise)
            }
            Term::Let { slot, value, body } => {
                let value = self.term(*value);
                self.bind(*slot, value);
                self.term(*body)
            }
            Term::Rule(_) => Certain::DEFINED,
            Term::Project { tuple: part, .. } | Term::Coerce(part) => {
                self.term(*part);
                Certain::NOTHING
            }
            Term::Unbound | Term::Missing(_) => Certain::NOTHING,
        }
    }

    /// The value of one of several branches, each behind its guard or its case; without another one it may be undef.
    fn one_of(&mut self, pairs: TermList, otherwise: Option<TermId>) -> Certain {
        let values: Vec<Certain> = self.terms(pairs).into_iter().skip(1).step_by(2).collect();
        let otherwise = otherwise.map_or(Certain::UNDEF, |otherwise| self.term(otherwise));
        values.into_iter().fold(otherwise, Certain::or)
    }

    fn read(&mut self, function: FunctionId, arguments: TermList) -> Certain {
        let program = self.program;
        let certain = self.terms(arguments);
        let element = program.function(function).element.is_some();
        if element || (Some(function) == program.self_function && self.by_agent) {
            return Certain::DEFINED;
        }
        let has_place = |(position, (term, argument)): (usize, (&TermId, &Certain))| {
            let domain = program.term_domain(*term);
            argument.defined && self.locations.has_place(function, position, domain, argument.bounds)
        };
        match program.term_list(arguments).iter().zip(&certain).enumerate().all(has_place) {
            true => self.known.at_place(function),
            false => self.known.function(function),
        }
    }

    // ---- rules

    fn rules(&mut self, list: RuleList) {
        self.program.rule_list(list).iter().for_each(|rule| self.rule(*rule));
    }

    fn rule(&mut self, id: RuleId) {
        stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.rule_here(id));
    }

    fn rule_here(&mut self, id: RuleId) {
        self.seen_rules[id.0 as usize] = true;
        let program = self.program;
        match program.rule(id) {
            Rule::Skip => {}
            Rule::Update { function, arguments, value } => {
                self.terms(*arguments);
                // What lies outside of the bounds cannot be written.
                let bounds = self.locations.bounds_of_updates(*function);
                let value = Certain { bounds, ..self.term(*value) };
                self.meet(*function, value);
            }
            Rule::Call { arguments, .. } | Rule::TurboCall { arguments, .. } => {
                let arguments = self.terms(*arguments);
                self.runs(id, &arguments);
            }
            Rule::Return { function, target, arguments, .. } => {
                self.terms(*target);
                self.meet(*function, Certain::NOTHING);
                let arguments = self.terms(*arguments);
                self.runs(id, &arguments);
            }
            Rule::RunValue { rule, arguments } => {
                self.term(*rule);
                let arguments = self.terms(*arguments);
                self.runs(id, &arguments);
            }
            Rule::RunAgent { agent } => _ = self.term(*agent),
            Rule::Par(list) | Rule::Seq(list) => self.rules(*list),
            Rule::If { guards: terms, rules } => {
                self.terms(*terms);
                self.rules(*rules);
            }
            Rule::Switch { subject, values, rules } => {
                self.term(*subject);
                self.terms(*values);
                self.rules(*rules);
            }
            Rule::Let { slot, value, body } => {
                let value = self.term(*value);
                self.bind(*slot, value);
                self.rule(*body);
            }
            Rule::Choose { binders, condition, body, if_none } => {
                self.bind_all(*binders);
                condition.iter().for_each(|condition| _ = self.term(*condition));
                self.rule(*body);
                if_none.iter().for_each(|rule| self.rule(*rule));
            }
            Rule::Forall { binders, condition, body } => {
                self.bind_all(*binders);
                condition.iter().for_each(|condition| _ = self.term(*condition));
                self.rule(*body);
            }
            Rule::Extend { first, count, body, .. } => {
                (0..*count).for_each(|offset| self.bind(Slot(first.0 + offset), Certain::DEFINED));
                self.rule(*body);
            }
            Rule::Iterate(body) => self.rule(*body),
            Rule::While { condition, body } | Rule::RecursiveWhile { condition, body } => {
                self.term(*condition);
                self.rule(*body);
            }
            Rule::Local { initialisations, body, .. } => {
                self.rules(*initialisations);
                self.rule(*body);
            }
        }
    }

    /// A rule runs procedures with these arguments.
    fn runs(&mut self, id: RuleId, arguments: &[Certain]) {
        let by_agent = self.by_agent;
        let Some(left) = &mut self.left else { return };
        match self.program.rule(id).runs() {
            Runs::Procedure(procedure) => left.procedures[procedure.0 as usize].run(arguments, by_agent),
            Runs::Value { .. } => {
                let fitting = |body: &&mut Body| body.parameters.len() == arguments.len();
                left.procedures.iter_mut().filter(fitting).for_each(|body| body.run(arguments, by_agent));
            }
            Runs::Nothing | Runs::Agent => {}
        }
    }
}

fn constant(literal: &Literal) -> Certain {
    match literal {
        Literal::Undef => Certain::UNDEF,
        Literal::Integer(n) => Certain { bounds: Some((*n, *n)), ..Certain::DEFINED },
        Literal::Boolean(_) | Literal::Real(_) | Literal::Char(_) | Literal::String(_) | Literal::Enum(..) => {
            Certain::DEFINED
        }
        Literal::Complex(..) => Certain::DEFINED,
    }
}

/// What is certain of a library function's value. Where nothing is said, nothing is.
fn of_builtin(builtin: Builtin, arguments: &[Certain]) -> Certain {
    let defined = arguments.iter().all(|argument| argument.defined);
    let solid = arguments.iter().all(|argument| argument.solid);
    match builtin {
        Builtin::Eq | Builtin::Neq | Builtin::IsDef | Builtin::IsUndef => Certain::DEFINED,
        Builtin::And | Builtin::Or | Builtin::Not | Builtin::Implies => Certain { defined, ..Certain::DEFINED },
        Builtin::Lt | Builtin::Le | Builtin::Gt | Builtin::Ge => Certain { defined, ..Certain::DEFINED },
        Builtin::IntNeg
        | Builtin::IntAdd
        | Builtin::IntSub
        | Builtin::IntMul
        | Builtin::IntMod
        | Builtin::IntMin
        | Builtin::IntMax => Certain { defined, ..Certain::DEFINED },
        Builtin::SeqLength | Builtin::SeqIsEmpty | Builtin::SetSize | Builtin::SetIsEmpty | Builtin::SetNotEmpty => {
            Certain { defined, ..Certain::DEFINED }
        }
        Builtin::SeqConcat | Builtin::SetUnion | Builtin::AsSet => Certain { defined, solid, bounds: None },
        Builtin::Append => match arguments {
            [items, element] => Certain { solid: items.solid && element.defined, bounds: None, ..*items },
            _ => Certain::NOTHING,
        },
        _ => Certain::NOTHING,
    }
}
