//! Generates terms as C++ expressions (Börger & Stärk 2003, section 2.4.2).
//!
//! In: a term and the variables in scope. Out: [`Code`]. What needs statements (bindings, comprehensions, quantifiers)
//! is a lambda called on the spot, which compilers inline. Library functions are in [`crate::model::operation`].

use program::{CollectionKind, DomainKind, FunctionId, Literal, Term, TermId, TermList};

use crate::model::code::{CALLED, Code, beside, between, listed, unwrapped, within};
use crate::model::form::Form;
use crate::model::generator::Generator;
use crate::model::interval::Interval;
use crate::model::plan::{Dimension, Role, integer};
use crate::model::reach::Part;
use crate::model::text::escaped;
use crate::model::types::{Type, result_type};

impl Generator<'_> {
    /// The type of a term, by its domain.
    pub fn term_type(&self, id: TermId) -> Type {
        result_type(self.program, self.program.term_domain(id))
    }

    /// A term as an expression.
    pub fn term(&mut self, id: TermId) -> Code {
        let program = self.program;
        let span = program.term_span(id);
        match program.term(id) {
            Term::Constant(index) => self.literal(&program.constants[*index as usize], id),
            Term::Slot(slot) => match self.frame.slots[slot.0 as usize].clone() {
                Some(variable) => variable.code(),
                // A variable that no binder has bound on this path is undef, as in the machine's frames.
                None => Code::undef(),
            },
            Term::Read { function, arguments } => self.read(*function, *arguments, id),
            Term::Define { function, arguments } => self.definition(*function, *arguments, id),
            Term::Builtin { builtin, arguments } => self.operation(*builtin, *arguments, id),
            Term::Domain(domain) => {
                self.needs_values(span, "the set of a domain's elements");
                let items = self.domain_values(*domain, span);
                Code::value(format!("gs::Value::set({items})"))
            }
            Term::Tuple(items) => {
                self.needs_values(span, "a tuple");
                let items = self.values(*items);
                Code::value(format!("gs::Value::tuple(gs::Values{{{}}})", items.join(", ")))
            }
            Term::Project { tuple, index } => {
                let tuple = self.value(*tuple);
                let site = self.site(id);
                let code = Code::value(format!("gs::project({tuple}, {index}, {site})"));
                self.typed(code, id)
            }
            Term::Collection { kind: CollectionKind::Seq, elements }
                if matches!(self.term_type(id), Type::List(_)) && !program.term_list(*elements).is_empty() =>
            {
                self.list(*elements, id)
            }
            Term::Collection { kind, elements } => {
                self.needs_values(span, "a collection");
                let items = self.values(*elements);
                Code::value(collection(*kind, &format!("gs::Values{{{}}}", items.join(", "))))
            }
            Term::Range { kind, low, high, step } => {
                self.needs_values(span, "a collection");
                let (low, high) = (self.value(*low), self.value(*high));
                let step = step.map_or("gs::Value::integer(1)".to_string(), |step| self.value(step));
                let site = self.site(id);
                Code::value(format!("gs::range_by({low}, {high}, {step}, {}, {site})", kind_of(*kind)))
            }
            Term::Comprehension { kind, binders, condition, body } => {
                self.comprehension(*kind, (*binders, *condition, *body), id)
            }
            Term::Quantified { quantifier, binders, condition } => self.quantified(*quantifier, *binders, *condition),
            Term::If { branches, otherwise } => {
                let branches = program.term_list(*branches).to_vec();
                let arms: Vec<(Code, TermId)> =
                    branches.chunks_exact(2).map(|branch| (self.guard_code(branch[0]), branch[1])).collect();
                self.cases(arms, *otherwise, id)
            }
            Term::Switch { subject, cases, otherwise } => self.switch(*subject, *cases, *otherwise, id),
            Term::Let { slot, value, body } => {
                let value = self.term(*value);
                let pure = value.pure;
                let variable = self.declare(*slot, value.ty, value.defined, value.range);
                let value = self.convert(value, variable.ty, variable.defined, 0);
                let body = self.term(*body);
                let result = self.plan.cpp(body.ty, body.defined);
                let text = format!(
                    "{CALLED} -> {result} {{ [[maybe_unused]] const auto {} = {value}; return {}; }}()",
                    variable.name, body.text
                );
                Code { text, pure: body.pure && pure, ..body }
            }
            Term::Rule(procedure) => {
                self.needs_values(span, "a rule as a value");
                self.reach.expect(Part::Procedure(*procedure));
                Code::value(format!("gs::Value::rule({})", procedure.0)).pure()
            }
            Term::Unbound => self.failing("unbound", id),
            Term::Missing(_) => self.failing("no_definition", id),
            Term::Coerce(operand) => {
                let operand = self.term(*operand);
                let site = self.site(id);
                match self.term_type(id) {
                    Type::Real if operand.ty == Type::Integer && operand.defined => {
                        Code::defined(format!("gs::to_real({})", operand.text), Type::Real)
                    }
                    Type::Real if operand.ty == Type::Real => operand,
                    Type::Real if operand.ty == Type::Integer => {
                        Code::maybe(format!("gs::to_real({})", operand.text), Type::Real)
                    }
                    ty => {
                        self.needs_values(span, "a Complex");
                        let to = if ty == Type::Real { "real" } else { "complex" };
                        let operand = self.convert(operand, Type::Value, false, site);
                        let code = Code::value(format!("gs::coerce_{to}({operand})"));
                        self.cast(code, ty, site)
                    }
                }
            }
        }
    }

    /// A term as a dynamic value.
    pub fn value(&mut self, id: TermId) -> String {
        let code = self.term(id);
        let site = self.site(id);
        self.needs_values(self.program.term_span(id), "a dynamic value");
        self.convert(code, Type::Value, false, site)
    }

    fn values(&mut self, list: TermList) -> Vec<String> {
        self.program.term_list(list).to_vec().into_iter().map(|item| self.value(item)).collect()
    }

    /// A term as the condition of a C++ `if`.
    pub fn guard(&mut self, id: TermId) -> String {
        self.guard_code(id).text
    }

    pub fn guard_code(&mut self, id: TermId) -> Code {
        let code = self.term(id);
        let site = self.site(id);
        let code = self.cast(code, Type::Boolean, site);
        let text = match code.ty {
            // The condition is always undef, so this always faults.
            Type::Undef => format!("gs::holds(gs::Maybe<bool>{{}}, {site})"),
            _ if code.defined => return code,
            _ => format!("gs::holds({}, {site})", code.text),
        };
        Code::defined(text, Type::Boolean)
    }

    /// Converts a dynamic value whose type is known, as the machine would.
    pub fn typed(&mut self, code: Code, id: TermId) -> Code {
        let site = self.site(id);
        match self.term_type(id) {
            Type::Undef => code,
            ty => self.cast(code, ty, site),
        }
    }

    pub fn failing(&mut self, kind: &str, id: TermId) -> Code {
        let site = self.site(id);
        let ty = match self.term_type(id) {
            Type::Undef => Type::Value,
            ty => ty,
        };
        let result = self.plan.cpp(ty, true);
        Code::defined(format!("gs::failed<{result}>(gs::FaultKind::{kind}, {site})"), ty)
    }

    fn literal(&mut self, literal: &Literal, id: TermId) -> Code {
        match literal {
            Literal::Undef => Code::undef(),
            Literal::Boolean(truth) => Code::defined(truth.to_string(), Type::Boolean).pure(),
            Literal::Integer(number) => {
                let text = format!("std::int64_t{{{}}}", integer(*number));
                Code::defined(text, Type::Integer).pure().within(Interval::of(*number))
            }
            Literal::Real(number) => Code::defined(real(*number), Type::Real).pure(),
            Literal::Char(letter) => Code::defined(format!("char32_t{{{}}}", *letter as u32), Type::Char).pure(),
            Literal::Enum(domain, index) => {
                let plan = self.plan.domain(*domain);
                let text = format!("{}::{}", plan.name(), plan.literals[*index as usize]);
                Code::defined(text, Type::Enum(*domain)).pure()
            }
            Literal::Complex(re, im) => {
                self.needs_values(self.program.term_span(id), "a Complex");
                Code::value(format!("gs::Value::complex({}, {})", real(*re), real(*im))).pure()
            }
            Literal::String(text) => {
                self.needs_values(self.program.term_span(id), "a string");
                Code::value(string(text)).pure()
            }
        }
    }

    fn read(&mut self, function: FunctionId, arguments: TermList, id: TermId) -> Code {
        let plan = self.plan.function(function).clone();
        let index = function.0 as usize;
        if let Role::Element(number) = plan.role {
            let Type::Element(domain) = plan.ty else { return Code::value("gs::Value{}").pure() };
            let name = self.plan.domain(domain).name();
            return Code::defined(format!("{name}{{{number}}}"), plan.ty).pure();
        }
        self.reach.expect(Part::Function(function));
        let site = self.site(id);
        let codes = self.arguments(function, arguments);
        let pure = codes.iter().all(|code| code.pure);
        let (statements, codes) = self.hoist(codes, false);
        let list = listed(&codes);
        let code = match plan.role {
            Role::State | Role::Local => {
                let total = self.assumed.total[index];
                let text = if self.is_lazy(function) {
                    format!("{}({list})", plan.name)
                } else {
                    let how = if self.is_whole(function) && !list.is_empty() { "get" } else { "read" };
                    format!("{}.{how}({list})", plan.member)
                };
                let pure = pure && !self.is_lazy(function);
                let range = self.assumed.values[index];
                Code { text, ty: plan.ty, defined: total && plan.ty != Type::Value, pure, range }
            }
            Role::Agent if self.assumed.acting && plan.ty != Type::Value => {
                Code::defined(plan.member.clone(), plan.ty).pure()
            }
            Role::Agent => Code::maybe(plan.member.clone(), plan.ty).pure(),
            Role::Input | Role::Shared => {
                let comma = if list.is_empty() { "" } else { ", " };
                Code::maybe(format!("{}({list}{comma}{site})", plan.name), plan.ty)
                    .within(self.codomain_range(function))
            }
            Role::None | Role::Element(_) | Role::Definition => Code::value("gs::Value{}").pure(),
        };
        within(&statements, code)
    }

    /// The arguments that select a location of the function.
    pub fn arguments(&mut self, function: FunctionId, arguments: TermList) -> Vec<Code> {
        let program = self.program;
        let parameters = &program.function(function).parameters;
        let mut codes = Vec::new();
        for (argument, domain) in program.term_list(arguments).to_vec().into_iter().zip(parameters) {
            let ty = self.parameter_type(*domain);
            let code = self.term(argument);
            let site = self.site(argument);
            let code = self.cast(code, ty, site);
            if !code.defined {
                self.refuted.inside[function.0 as usize][codes.len()] = false;
            }
            let bounds = self.plan.function(function).dimensions[codes.len()].bounds;
            if bounds.is_some_and(|bounds| !code.range.within(bounds)) {
                self.refuted.covered[function.0 as usize] = false;
            }
            codes.push(match code.ty {
                Type::Undef => Code { text: format!("{}{{}}", self.plan.cpp(ty, false)), ty, ..code },
                _ => code,
            });
        }
        codes
    }

    /// Whether an initial value of the function may be computed only when it is read.
    pub fn is_lazy(&self, function: FunctionId) -> bool {
        self.plan.function(function).initial.is_some() && !self.is_whole(function)
    }

    /// The form of a function's locations.
    pub fn form(&self, function: FunctionId) -> Form {
        let form = match self.forms[function.0 as usize] {
            // The second array has no places for undef arguments, and must have a place for each accessed location.
            Form::Whole if !self.is_whole(function) || !self.is_inside(function) => Form::Disjoint,
            form => form,
        };
        match form {
            // In bare code the log has a fixed length, but without clash checks a location may be logged many times.
            Form::Disjoint if self.options.bare && !self.plan.function(function).dimensions.is_empty() => Form::General,
            form => form,
        }
    }

    /// Whether the function's array has a place for every location that is accessed.
    pub fn is_whole(&self, function: FunctionId) -> bool {
        let plan = self.plan.function(function);
        let covered = self.assumed.covered[function.0 as usize] && plan.role != Role::Shared;
        let holds = |dimension: &Dimension| dimension.whole || (covered && dimension.bounds.is_some());
        let placed = match plan.role {
            Role::State | Role::Local => self.assumed.eager[function.0 as usize],
            _ => false,
        };
        (placed || self.is_inside(function)) && plan.dimensions.iter().all(holds)
    }

    /// Whether no location of the function is accessed with an undef argument.
    pub fn is_inside(&self, function: FunctionId) -> bool {
        self.assumed.inside[function.0 as usize].iter().all(|inside| *inside)
    }

    /// Whether the function's array has a place for this argument being undef.
    pub fn has_undef_place(&self, function: FunctionId, argument: usize) -> bool {
        !self.assumed.inside[function.0 as usize][argument] && self.is_whole(function)
    }

    fn definition(&mut self, function: FunctionId, arguments: TermList, id: TermId) -> Code {
        let plan = self.plan.function(function).clone();
        if plan.role != Role::Definition {
            return self.failing("no_definition", id);
        }
        self.reach.expect(Part::Function(function));
        let parameters = self.program.function(function).parameters.clone();
        let assumed = self.assumed.arguments[function.0 as usize].clone();
        let terms = self.program.term_list(arguments).to_vec();
        let mut codes = Vec::new();
        for (index, (argument, domain)) in terms.iter().zip(&parameters).enumerate() {
            let ty = self.parameter_type(*domain);
            let code = self.term(*argument);
            let site = self.site(*argument);
            let code = self.cast(code, ty, site);
            if !code.defined {
                self.refuted.arguments[function.0 as usize][index] = false;
            }
            let range = &mut self.refuted.argument_ranges[function.0 as usize][index];
            *range = range.join(code.range);
            codes.push(code);
        }
        // If an argument may be undef although assumed otherwise, the assumption was refuted above and this code is
        // discarded.
        let arguments_pure = codes.iter().all(|code| code.pure);
        let (statements, codes) = self.hoist(codes, false);
        let mut list = Vec::new();
        for (index, (code, domain)) in codes.into_iter().zip(&parameters).enumerate() {
            let ty = self.parameter_type(*domain);
            let site = self.site(terms[index]);
            let text = self.convert(code, ty, assumed[index], site);
            list.push(unwrapped(&text).to_string());
        }
        let defined = self.assumed.result[function.0 as usize] && plan.ty != Type::Value;
        let text = format!("{}({})", plan.name, list.join(", "));
        let range = self.assumed.values[function.0 as usize];
        let pure = self.assumed.pure[function.0 as usize] && statements.is_empty();
        let code = Code { text, ty: plan.ty, defined, pure: pure && arguments_pure, range };
        let code = within(&statements, code);
        // The use of a polymorphic definition may determine its type more exactly.
        match self.term_type(id) {
            Type::Value | Type::Undef => code,
            ty => {
                let site = self.site(id);
                self.cast(code, ty, site)
            }
        }
    }

    /// `guard ? term : …`; undef if no guard holds.
    fn cases(&mut self, arms: Vec<(Code, TermId)>, otherwise: Option<TermId>, id: TermId) -> Code {
        let mut codes: Vec<(Code, Code, u32)> = Vec::new();
        for (guard, term) in arms {
            let code = self.term(term);
            let site = self.site(term);
            codes.push((guard, code, site));
        }
        let last = otherwise.map_or(Code::undef(), |otherwise| self.term(otherwise));
        let site = self.site(id);
        let mut types = codes.iter().map(|(_, code, _)| code.ty).chain([last.ty]).filter(|ty| *ty != Type::Undef);
        let first = types.next().unwrap_or(Type::Undef);
        let ty = match first {
            // All arms are undef.
            Type::Undef => return Code { pure: false, ..Code::undef() },
            first if types.all(|ty| ty == first) => first,
            _ => match self.term_type(id) {
                Type::Undef => Type::Value,
                ty => ty,
            },
        };
        let defined = codes.iter().all(|(_, code, _)| code.defined && code.ty == ty) && last.defined && last.ty == ty;
        // An undef arm contributes no integer.
        let arms = codes.iter().map(|(_, code, _)| code).chain([&last]);
        let range = arms.filter(|code| code.ty != Type::Undef).fold(Interval::EMPTY, |all, code| all.join(code.range));
        // Boxing a value, or passing it on as it is, cannot fault.
        let arm = |code: &Code| code.pure && (code.ty == ty || code.ty == Type::Undef || ty == Type::Value);
        let pure = arm(&last) && codes.iter().all(|(guard, code, _)| guard.pure && arm(code));
        let mut text = String::from("(");
        for (guard, code, site) in codes {
            text.push_str(&format!("{} ? {} : ", guard.text, self.convert(code, ty, defined, site)));
        }
        text.push_str(&self.convert(last, ty, defined, site));
        text.push(')');
        Code { text, ty, defined, pure, range }
    }

    fn switch(&mut self, subject: TermId, cases: TermList, otherwise: Option<TermId>, id: TermId) -> Code {
        let subject_code = self.term(subject);
        let site = self.site(subject);
        let ty = if subject_code.ty == Type::Undef { Type::Value } else { subject_code.ty };
        let name = self.fresh("subject");
        let variable = Code { text: name.clone(), ty, pure: true, ..subject_code.clone() };
        let pure = subject_code.pure;
        let subject_text = match subject_code.ty {
            Type::Undef => "gs::Value{}".to_string(),
            _ => subject_code.text,
        };
        let mut arms = Vec::new();
        for case in self.program.term_list(cases).to_vec().chunks_exact(2) {
            let value = self.term(case[0]);
            let pure = value.pure;
            let guard = self.equality(variable.clone(), value, site);
            arms.push((Code { pure, ..Code::defined(guard, Type::Boolean) }, case[1]));
        }
        let code = self.cases(arms, otherwise, id);
        let result = match code.ty {
            Type::Undef => "gs::Value".to_string(),
            _ => self.plan.cpp(code.ty, code.defined),
        };
        let text = format!(
            "{CALLED} -> {result} {{ [[maybe_unused]] const auto {name} = {subject_text}; return {}; }}()",
            code.text
        );
        Code { text, pure: code.pure && pure, ..code }
    }

    /// Whether two values are equal; undef equals undef.
    pub fn equality(&mut self, left: Code, right: Code, site: u32) -> String {
        match (left.ty, right.ty) {
            (Type::Undef, Type::Undef) => "true".to_string(),
            (Type::Undef, _) | (_, Type::Undef) => {
                let known = if left.ty == Type::Undef { right } else { left };
                if known.defined {
                    format!("((void)({}), false)", known.text)
                } else {
                    format!("!gs::is_defined({})", known.text)
                }
            }
            (Type::Integer, Type::Integer) if left.defined && right.defined => beside(&left, "==", &right),
            (a, b) if a == b => between(&left.text, "==", &right.text),
            _ => {
                let left = self.convert(left, Type::Value, false, site);
                let right = self.convert(right, Type::Value, false, site);
                between(&left, "==", &right)
            }
        }
    }

    /// The elements of a domain, as a list of dynamic values.
    pub fn domain_values(&mut self, domain: program::DomainId, span: syntax::Span) -> String {
        let program = self.program;
        let site = self.sites.number(span);
        match &program.domain(domain).kind {
            DomainKind::Prod(parts) => {
                let parts: Vec<String> = parts.clone().iter().map(|part| self.domain_values(*part, span)).collect();
                format!("gs::tuples(std::vector<gs::Values>{{{}}}, {site})", parts.join(", "))
            }
            DomainKind::Powerset(of) => {
                let of = self.domain_values(*of, span);
                format!("gs::subsets({of}, {site})")
            }
            _ => match self.domain_range(domain) {
                Some((range, _)) => format!("gs::boxed({range})"),
                None => format!("gs::failed<gs::Values>(gs::FaultKind::not_enumerable, {site})"),
            },
        }
    }
}

/// A collection of this kind, from a list of elements.
pub(crate) fn collection(kind: CollectionKind, items: &str) -> String {
    match kind {
        CollectionKind::Set => format!("gs::Value::set({items})"),
        CollectionKind::Seq => format!("gs::Value::seq({items})"),
        CollectionKind::Bag => format!("gs::Value::bag({items})"),
        CollectionKind::Map => format!("gs::collection(gs::CollectionKind::map, {items})"),
    }
}

fn kind_of(kind: CollectionKind) -> &'static str {
    match kind {
        CollectionKind::Set => "gs::CollectionKind::set",
        CollectionKind::Seq => "gs::CollectionKind::seq",
        CollectionKind::Bag => "gs::CollectionKind::bag",
        CollectionKind::Map => "gs::CollectionKind::map",
    }
}

/// A literal of a double that reads back as the same number.
pub(crate) fn real(number: f64) -> String {
    if number.is_infinite() {
        let sign = if number < 0.0 { "-" } else { "" };
        return format!("{sign}std::numeric_limits<double>::infinity()");
    }
    format!("{:?}", number + 0.0)
}

/// A string as a dynamic value.
pub(crate) fn string(text: &str) -> String {
    format!("gs::Value::string(std::string{{\"{}\", {}}})", escaped(text), text.len())
}
