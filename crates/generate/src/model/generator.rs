//! The state shared by generating terms and rules: the plan, the places, the variables in scope, the assumptions.
//!
//! What the class needs is known before ([`crate::model::reach`]). Code is generated under assumptions that make it
//! small, such as: this function is never undef. Code that refutes an assumption notes it, and everything is generated
//! again without that assumption, until none is refuted. INVARIANT: the final code refutes none of the assumptions that
//! it was generated under.

use std::collections::BTreeMap;

use model::Basic;
use program::{DomainId, DomainKind, FunctionId, Program, Slot, TermId};
use syntax::{Diagnostic, Span};

use crate::fault::no_form;
use crate::model::assumptions::Assumptions;
use crate::model::code::Code;
use crate::model::form::Form;
use crate::model::interval::Interval;
use crate::model::plan::{Plan, covers};
use crate::model::reach::Reach;
use crate::model::sites::Sites;
use crate::model::types::Type;
use crate::model::writes::Writes;
use crate::names::Scope;

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
    pub reach: &'a Reach,
    pub options: &'a Options,
    pub assumed: Assumptions,
    pub refuted: Assumptions,
    pub sites: Sites,
    pub frame: Frame,
    /// Constant sets and lists.
    pub tables: Vec<Table>,
    /// What cannot be generated.
    pub refused: Vec<Diagnostic>,
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

impl<'a> Generator<'a> {
    /// A generator with these assumptions.
    pub fn new(
        program: &'a Program,
        plan: &'a Plan,
        writes: &'a Writes,
        forms: &'a [Form],
        reach: &'a Reach,
        options: &'a Options,
        assumed: Assumptions,
    ) -> Self {
        plan.begin();
        Generator {
            program,
            plan,
            writes,
            forms,
            reach,
            options,
            refuted: assumed.clone(),
            assumed,
            sites: Sites::default(),
            frame: Frame::default(),
            tables: Vec::new(),
            refused: Vec::new(),
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

    /// The member that holds a growing domain.
    pub fn carrier(&self, domain: DomainId) -> Option<String> {
        let carrier = self.plan.domain(domain).carrier.clone()?;
        assert!(self.reach.carriers.contains(&domain), "the class declares what the code names");
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
