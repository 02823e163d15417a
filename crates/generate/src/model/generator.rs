//! The state shared by generating terms and rules: the plan, the places, the variables in scope, the assumptions.
//!
//! Code is generated under assumptions that make it small, such as: this function is never undef. Code that refutes an
//! assumption notes it, and everything is generated again without that assumption, until none is refuted. INVARIANT:
//! the final code refutes none of the assumptions that it was generated under.

use std::collections::{BTreeMap, BTreeSet};

use model::Basic;
use program::{DomainId, DomainKind, FunctionId, ProcedureId, Program, Slot, TermId};
use syntax::{Diagnostic, Span};

use crate::fault::no_form;
use crate::model::code::Code;
use crate::model::form::Form;
use crate::model::interval::Interval;
use crate::model::plan::{Plan, covers};
use crate::model::sites::Sites;
use crate::model::types::Type;
use crate::model::writes::Writes;
use crate::names::Scope;

/// Assumptions about a program, by index into its tables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Assumptions {
    /// A function's locations are never undef.
    pub total: Vec<bool>,
    /// By argument: no location of the function is accessed while that argument is undef.
    pub inside: Vec<Vec<bool>>,
    /// Initial values of locations with undef arguments can be computed at the start: they neither fault nor ask the
    /// environment.
    pub eager: Vec<bool>,
    /// No location of the function is accessed with an integer outside of its array.
    pub covered: Vec<bool>,
    /// `self` is defined wherever it is read.
    pub acting: bool,
    /// No list contains undef.
    pub solid: bool,
    /// A definition's value is never undef.
    pub result: Vec<bool>,
    /// Evaluating a definition neither faults nor asks the environment.
    pub pure: Vec<bool>,
    /// A definition's arguments are never undef.
    pub arguments: Vec<Vec<bool>>,
    /// A procedure's arguments are never undef.
    pub parameters: Vec<Vec<bool>>,
    /// An interval around the integers among a function's values.
    pub values: Vec<Interval>,
    /// Intervals around the integers among a definition's arguments.
    pub argument_ranges: Vec<Vec<Interval>>,
    /// Intervals around the integers among a procedure's arguments.
    pub parameter_ranges: Vec<Vec<Interval>>,
}

impl Assumptions {
    /// All assumptions that might hold.
    pub fn all(program: &Program) -> Assumptions {
        let functions = program.functions.len();
        Assumptions {
            total: vec![true; functions],
            inside: program.functions.iter().map(|f| vec![true; f.parameters.len()]).collect(),
            eager: vec![true; functions],
            covered: vec![true; functions],
            acting: false,
            solid: true,
            result: vec![true; functions],
            pure: vec![true; functions],
            arguments: program.functions.iter().map(|f| vec![true; f.parameters.len()]).collect(),
            parameters: program.procedures.iter().map(|p| vec![true; p.parameters.len()]).collect(),
            values: vec![Interval::EMPTY; functions],
            argument_ranges: program.functions.iter().map(|f| vec![Interval::EMPTY; f.parameters.len()]).collect(),
            parameter_ranges: program.procedures.iter().map(|p| vec![Interval::EMPTY; p.parameters.len()]).collect(),
        }
    }

    /// These assumptions, with each interval that grew since `before` widened, so that growth soon ends.
    pub fn widened(mut self, before: &Assumptions) -> Assumptions {
        let lists = std::iter::once(&mut self.values)
            .chain(&mut self.argument_ranges)
            .chain(&mut self.parameter_ranges)
            .zip(std::iter::once(&before.values).chain(&before.argument_ranges).chain(&before.parameter_ranges));
        for (now, before) in lists {
            for (now, before) in now.iter_mut().zip(before) {
                *now = now.widened(*before);
            }
        }
        self
    }
}

/// Options of the generated code.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// For microcontrollers: no heap, exceptions, threads or dynamic values.
    pub bare: bool,
    /// With `bare`: by name, how many locations outside of arrays a function may have, or elements or updates a domain.
    pub capacities: Vec<(String, u32)>,
}

/// The empty sequence, without a type yet.
pub(crate) const EMPTY: &str = "gs::Value::seq(gs::Values{})";

/// A variable of the model in generated code.
#[derive(Debug, Clone)]
pub(crate) struct Variable {
    pub name: String,
    pub ty: Type,
    pub defined: bool,
    /// An interval that contains it, if it is an integer.
    pub range: Interval,
}

impl Variable {
    /// Its value.
    pub fn code(&self) -> Code {
        Code { text: self.name.clone(), ty: self.ty, defined: self.defined, pure: true, range: self.range }
    }
}

/// The frame of the procedure or definition that is being generated.
#[derive(Debug, Clone, Default)]
pub(crate) struct Frame {
    pub slots: Vec<Option<Variable>>,
    pub names: Vec<String>,
    pub scope: Scope,
}

/// Generates code under assumptions.
#[derive(Debug)]
pub(crate) struct Generator<'a> {
    pub program: &'a Program,
    pub plan: &'a Plan,
    pub writes: &'a Writes,
    /// By function.
    pub forms: &'a [Form],
    pub options: &'a Options,
    pub assumed: Assumptions,
    pub refuted: Assumptions,
    pub sites: Sites,
    pub frame: Frame,
    /// Constant sets and lists.
    pub tables: Vec<Table>,
    /// What cannot be generated.
    pub refused: Vec<Diagnostic>,
    /// Functions whose code is needed.
    pub reached: BTreeSet<FunctionId>,
    /// Procedures whose code is needed.
    pub entered: BTreeSet<ProcedureId>,
    /// How often the code calls each procedure.
    pub calls: BTreeMap<ProcedureId, u32>,
    /// Parts of the class that are generated only if needed.
    pub needs: BTreeSet<Need>,
    /// Growing domains whose elements matter.
    pub carriers: BTreeSet<DomainId>,
    /// By monitored and shared function: the environment's answer, checked against the codomain.
    pub asked: BTreeMap<FunctionId, String>,
    /// Whether a set may be traversed in any order and more than once.
    pub unordered: bool,
}

/// A constant set or list, which is defined only once.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Table {
    pub name: String,
    /// Its contents in C++.
    pub contents: String,
    /// Whether it contains dynamic values, which are not constant expressions.
    pub dynamic: bool,
}

/// A part of the class that is generated only if needed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Need {
    /// The names of literals and elements.
    Names,
    /// `program(agent)`.
    AgentProgram,
    /// The clock.
    Clock,
    /// The count of loop rounds.
    Rounds,
    /// The depth of nested calls.
    Depth,
}

impl<'a> Generator<'a> {
    /// A generator with these assumptions.
    pub fn new(
        program: &'a Program,
        plan: &'a Plan,
        writes: &'a Writes,
        forms: &'a [Form],
        options: &'a Options,
        assumed: Assumptions,
    ) -> Self {
        plan.begin();
        Generator {
            program,
            plan,
            writes,
            forms,
            options,
            refuted: assumed.clone(),
            assumed,
            sites: Sites::default(),
            frame: Frame::default(),
            tables: Vec::new(),
            refused: Vec::new(),
            reached: BTreeSet::new(),
            entered: BTreeSet::new(),
            calls: BTreeMap::new(),
            needs: BTreeSet::new(),
            carriers: BTreeSet::new(),
            asked: BTreeMap::new(),
            unordered: false,
        }
    }

    /// Enters the frame of a procedure or definition; returns its parameters as C++ declares them.
    pub fn enter(
        &mut self,
        parameters: &[program::DomainId],
        assumed: &[(bool, Interval)],
        frame: u32,
        names: &[String],
    ) -> Vec<String> {
        self.frame =
            Frame { slots: vec![None; frame as usize], names: names.to_vec(), scope: self.plan.members.clone() };
        let mut declared = Vec::new();
        for (index, (domain, (defined, range))) in parameters.iter().zip(assumed).enumerate() {
            let ty = self.parameter_type(*domain);
            let variable = self.declare(Slot(index as u32), ty, *defined, *range);
            declared.push(format!("{} {}", self.parameter(ty, *defined), variable.name));
        }
        declared
    }

    /// The type of a parameter of a domain.
    pub fn parameter_type(&self, domain: program::DomainId) -> Type {
        match crate::model::types::type_of(self.program, domain) {
            Type::Undef => Type::Value,
            ty => ty,
        }
    }

    /// Whether a subset does not grow and contains all elements of its base.
    pub fn is_all_of(&self, subset: DomainId, base: DomainId) -> bool {
        let contents = &self.plan.domain(subset).contents;
        contents.as_ref().is_some_and(|contents| covers(self.program, base, contents))
    }

    /// An interval that contains the integers of a domain.
    pub fn domain_interval(&self, domain: DomainId) -> Interval {
        use machine::Value::Integer;
        match (&self.program.domain(domain).kind, &self.plan.domain(domain).contents) {
            (DomainKind::Basic(Basic::Natural), _) => Interval::NATURAL,
            (DomainKind::Concrete { .. }, Some(contents)) => match (contents.first(), contents.last()) {
                (Some(Integer(low)), Some(Integer(high))) => Interval { low: *low, high: *high },
                _ => Interval::ALL,
            },
            _ => Interval::ALL,
        }
    }

    /// An interval that contains a function's integers, once they are checked against its codomain.
    pub fn codomain_range(&self, function: FunctionId) -> Interval {
        self.domain_interval(self.program.function(function).codomain)
    }

    /// The member that holds a growing domain; requests that it be generated.
    pub fn carrier(&mut self, domain: DomainId) -> Option<String> {
        let carrier = self.plan.domain(domain).carrier.clone()?;
        self.carriers.insert(domain);
        Some(carrier)
    }

    /// The C++ type by which a parameter is passed.
    pub fn parameter(&self, ty: Type, defined: bool) -> String {
        match ty {
            Type::Value => "const gs::Value&".to_string(),
            ty => self.plan.cpp(ty, defined),
        }
    }

    /// Brings a variable into scope.
    pub fn declare(&mut self, slot: Slot, ty: Type, defined: bool, range: Interval) -> Variable {
        let ty = if ty == Type::Undef { Type::Value } else { ty };
        let name = self.frame.names.get(slot.0 as usize).map_or("x", String::as_str).to_string();
        let defined = defined && ty != Type::Value;
        let variable = Variable { name: self.frame.scope.take(&name), ty, defined, range };
        self.frame.slots[slot.0 as usize] = Some(variable.clone());
        variable
    }

    /// A fresh name for a variable of the generator.
    pub fn fresh(&mut self, name: &str) -> String {
        self.frame.scope.take(name)
    }

    /// The number of a term's place.
    pub fn site(&mut self, term: TermId) -> u32 {
        self.sites.number(self.program.term_span(term))
    }

    /// Records that something cannot be generated.
    pub fn refuse(&mut self, span: Span, message: impl Into<String>, help: &str) {
        let diagnostic = no_form(span, message, help);
        if !self.refused.contains(&diagnostic) {
            self.refused.push(diagnostic);
        }
    }

    /// In bare code: refuses a dynamic value.
    pub fn needs_values(&mut self, span: Span, what: &str) {
        if self.options.bare {
            self.refuse(
                span,
                format!("{what} takes a heap, which bare code has not"),
                "bare code knows truth values, numbers, characters, literals and elements",
            );
        }
    }

    /// The capacity given for a function or domain, in bare code.
    pub fn capacity(&self, name: &str) -> Option<u32> {
        self.options.capacities.iter().find(|(given, _)| given == name).map(|(_, capacity)| *capacity)
    }

    /// Returns statements that evaluate operands in the order of the text, and the operands without effects. C++ does
    /// not fix the order of arguments, which matters if more than one may fault or ask the environment. With `strict`,
    /// an undef operand faults only after all operands are evaluated.
    pub fn hoist(&mut self, codes: Vec<Code>, strict: bool) -> (String, Vec<Code>) {
        let effects = codes.iter().filter(|code| !code.pure).count();
        let undefined = codes.iter().any(|code| code.pure && !code.defined && code.ty != Type::Value);
        if effects == 0 || (effects == 1 && !(strict && undefined && codes.len() > 1)) {
            return (String::new(), codes);
        }
        let mut statements = String::new();
        let mut hoisted = Vec::new();
        for code in codes {
            if code.pure || code.ty == Type::Undef {
                hoisted.push(code);
                continue;
            }
            let name = self.fresh("operand");
            statements.push_str(&format!("const auto {name} = {}; ", code.text));
            hoisted.push(Code { text: name, pure: true, ..code });
        }
        (statements, hoisted)
    }

    // Conversions.

    /// The code as an expression of that type, defined or not.
    pub fn convert(&mut self, code: Code, ty: Type, defined: bool, site: u32) -> String {
        let code = self.cast(code, ty, site);
        match (code.defined, defined) {
            (false, true) if ty != Type::Value => format!("gs::need({}, {site})", code.text),
            (true, false) if ty != Type::Value => format!("{}{{{}}}", self.plan.cpp(ty, false), code.text),
            _ => code.text,
        }
    }

    /// The code as an expression of this type; it stays defined or undefined.
    pub fn cast(&mut self, code: Code, ty: Type, site: u32) -> Code {
        match (code.ty, ty) {
            (from, to) if from == to => code,
            (_, Type::Undef) => code,
            (Type::Undef, Type::Value) => Code { ty, ..Code::undef() },
            (Type::Undef, to) => Code { text: format!("{}{{}}", self.plan.cpp(to, false)), ty, ..Code::undef() },
            (Type::Value, Type::List(_)) if code.text == EMPTY => {
                Code::defined(format!("{}{{}}", self.plan.cpp(ty, true)), ty).pure()
            }
            (_, Type::Value) => Code { text: format!("gs::box({})", code.text), ty, defined: false, ..code },
            (Type::Value, to) => {
                if matches!(to, Type::List(_)) {
                    self.refuted.solid = false;
                }
                let plain = self.plan.cpp(to, true);
                Code::maybe(format!("gs::unbox<{plain}>({}, {site})", code.text), ty)
            }
            (Type::Integer, Type::Real) if code.defined => {
                Code { text: format!("gs::to_real({})", code.text), ty, ..code }
            }
            // Two scalar types that the model's checker treats as one: compare them as the machine does.
            _ => {
                let boxed = self.cast(code, Type::Value, site);
                self.cast(boxed, ty, site)
            }
        }
    }
}
