//! Prints terms and rules as AsmetaL on one line, with arguments substituted for variables.
//!
//! INVARIANT: the text parses as the same term or rule, so it can stand in a link; equal terms have equal texts. LIMIT:
//! a bound variable keeps its name even if a substituted text contains the same name.

use std::rc::Rc;

use model::{
    Binder, CollectionKind, FunctionId, FunctionKind, Literal, Quantifier, RuleKind, RuleNode, Target, Term, TermKind,
    VariableId,
};

use super::{Explorer, Frame};

/// The operator of a library function that is written between its operands.
fn infix(name: &str) -> Option<&str> {
    Some(match name {
        "eq" => "=",
        "neq" => "!=",
        "lt" => "<",
        "le" => "<=",
        "gt" => ">",
        "ge" => ">=",
        "plus" => "+",
        "minus" => "-",
        "mult" => "*",
        "div" => "/",
        "pwr" => "^",
        "and" | "or" | "xor" | "implies" | "iff" | "mod" => name,
        _ => return None,
    })
}

impl<'m> Explorer<'m> {
    /// A term.
    pub(crate) fn print(&self, term: &Term, frame: &Rc<Frame<'m>>) -> String {
        stacker::maybe_grow(128 << 10, 2 << 20, || self.print_here(term, frame))
    }

    fn list(&self, terms: &[Term], frame: &Rc<Frame<'m>>) -> String {
        terms.iter().map(|term| self.print(term, frame)).collect::<Vec<_>>().join(", ")
    }

    fn name_of(&self, id: VariableId, frame: &Rc<Frame<'m>>) -> String {
        match &frame.bound[id.0 as usize] {
            Some(bound) => bound.text.clone(),
            None => frame.variables[id.0 as usize].name.replace("$$", "$"),
        }
    }

    /// A function applied to arguments.
    pub(super) fn applied(&self, function: FunctionId, arguments: &[Term], frame: &Rc<Frame<'m>>) -> String {
        let declared = self.model.function(function);
        match arguments {
            [] => declared.name.clone(),
            [a, b] if declared.library && infix(&declared.name).is_some() => {
                let sign = infix(&declared.name).unwrap_or_default();
                format!("{} {sign} {}", self.operand(a, frame), self.operand(b, frame))
            }
            [a] if declared.library && declared.name == "not" => format!("not {}", self.operand(a, frame)),
            [a] if declared.library && declared.name == "minus" => format!("-{}", self.operand(a, frame)),
            arguments => format!("{}({})", declared.name, self.list(arguments, frame)),
        }
    }

    /// A term as an operand.
    pub(super) fn operand(&self, term: &Term, frame: &Rc<Frame<'m>>) -> String {
        let text = self.print(term, frame);
        let compound = match &term.kind {
            TermKind::Apply { function, arguments } => {
                let declared = self.model.function(*function);
                declared.library && (infix(&declared.name).is_some() || declared.name == "not") && !arguments.is_empty()
            }
            // The substituted text may be compound.
            TermKind::Variable(_) => text.contains(' ') && !text.ends_with(')'),
            _ => false,
        };
        if compound { format!("({text})") } else { text }
    }

    fn binders(&self, binders: &[Binder], frame: &Rc<Frame<'m>>) -> String {
        let one = |binder: &Binder| {
            format!("{} in {}", self.name_of(binder.variable, frame), self.print(&binder.range, frame))
        };
        binders.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    fn bindings(&self, bindings: &[(VariableId, Term)], frame: &Rc<Frame<'m>>) -> String {
        let one =
            |(id, term): &(VariableId, Term)| format!("{} = {}", self.name_of(*id, frame), self.print(term, frame));
        bindings.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    fn print_here(&self, term: &Term, frame: &Rc<Frame<'m>>) -> String {
        let inner = |term: &Term| self.print(term, frame);
        match &term.kind {
            TermKind::Literal(literal) => self.literal(literal),
            TermKind::Variable(id) => self.name_of(*id, frame),
            TermKind::Apply { function, arguments } => self.applied(*function, arguments, frame),
            TermKind::Domain(domain) => self.model.domains.display(*domain),
            TermKind::Tuple(parts) => format!("({})", self.list(parts, frame)),
            TermKind::Project { tuple, index } => format!("component{}({})", index + 1, inner(tuple)),
            TermKind::Coerce(term) => inner(term),
            TermKind::Collection { kind, elements } => {
                let (open, close) = brackets(*kind);
                let pair = |element: &Term| match (&element.kind, kind) {
                    (TermKind::Tuple(parts), CollectionKind::Map) => {
                        parts.iter().map(&inner).collect::<Vec<_>>().join(" -> ")
                    }
                    _ => inner(element),
                };
                format!("{open}{}{close}", elements.iter().map(pair).collect::<Vec<_>>().join(", "))
            }
            TermKind::Range { kind, low, high, step } => {
                let (open, close) = brackets(*kind);
                let step = step.as_ref().map(|step| format!(", {}", inner(step))).unwrap_or_default();
                format!("{open}{} : {}{step}{close}", inner(low), inner(high))
            }
            TermKind::Comprehension { kind, binders, condition, body } => {
                let (open, close) = brackets(*kind);
                let condition = condition.as_ref().map_or_else(|| "true".to_string(), |condition| inner(condition));
                format!("{open}{} | {condition} : {}{close}", self.binders(binders, frame), inner(body))
            }
            TermKind::Quantified { quantifier, binders, condition } => {
                let word = match quantifier {
                    Quantifier::Forall => "forall",
                    Quantifier::Exists => "exists",
                    Quantifier::ExistsUnique => "exists unique",
                };
                let condition = condition.as_ref().map_or_else(|| "true".to_string(), |condition| inner(condition));
                format!("({word} {} with {condition})", self.binders(binders, frame))
            }
            TermKind::If { branches, otherwise } => {
                let mut text = String::new();
                for (index, (guard, value)) in branches.iter().enumerate() {
                    let word = if index == 0 { "if" } else { "elseif" };
                    text += &format!("{word} {} then {} ", inner(guard), inner(value));
                }
                text + &otherwise.as_ref().map(|term| format!("else {} ", inner(term))).unwrap_or_default() + "endif"
            }
            TermKind::Switch { subject, cases, otherwise } => {
                let cases: String = cases.iter().map(|(v, t)| format!("case {}: {} ", inner(v), inner(t))).collect();
                let rest = otherwise.as_ref().map(|term| format!("otherwise {} ", inner(term))).unwrap_or_default();
                format!("switch {} {cases}{rest}endswitch", inner(subject))
            }
            TermKind::Let { bindings, body } => {
                format!("let ({}) in {} endlet", self.bindings(bindings, frame), inner(body))
            }
            TermKind::Rule(rule) => format!("<<{}>>", self.model.rule(*rule).name),
            TermKind::Unbound(id) => self.name_of(*id, frame),
            TermKind::Error => "undef".to_string(),
        }
    }

    fn literal(&self, literal: &Literal) -> String {
        match literal {
            Literal::Undef => "undef".to_string(),
            Literal::Boolean(value) => value.to_string(),
            Literal::Integer(value) => value.to_string(),
            Literal::Real(value) => format!("{value:?}"),
            Literal::Complex(real, imaginary) => format!("{real:?} + i{imaginary:?}"),
            Literal::Char(letter) => format!("'{letter}'"),
            Literal::String(text) => format!("{text:?}"),
            Literal::Enum(domain, index) => match self.model.domains.kind(*domain) {
                model::DomainKind::Enum { literals } => literals[*index as usize].clone(),
                _ => "undef".to_string(),
            },
        }
    }

    fn target(&self, target: &Target, frame: &Rc<Frame<'m>>) -> String {
        match target {
            Target::Location { function, arguments, .. } => self.applied(*function, arguments, frame),
            Target::Parameter(id, _) => self.name_of(*id, frame),
        }
    }

    /// A rule.
    pub(crate) fn print_rule(&self, rule: &RuleNode, frame: &Rc<Frame<'m>>) -> String {
        stacker::maybe_grow(128 << 10, 2 << 20, || self.print_rule_here(rule, frame))
    }

    fn print_rule_here(&self, rule: &RuleNode, frame: &Rc<Frame<'m>>) -> String {
        let term = |term: &Term| self.print(term, frame);
        let inner = |rule: &RuleNode| self.print_rule(rule, frame);
        let all = |rules: &[RuleNode]| rules.iter().map(&inner).collect::<Vec<_>>().join(" ");
        let call = |call: &model::Call, open: char, close: char| {
            format!("{}{open}{}{close}", self.model.rule(call.rule).name, self.list(&call.arguments, frame))
        };
        let with = |condition: &Option<Term>| condition.as_ref().map_or_else(|| "true".to_string(), &term);
        match &rule.kind {
            RuleKind::Skip | RuleKind::Error => "skip".to_string(),
            RuleKind::Update { target, value } => format!("{} := {}", self.target(target, frame), term(value)),
            RuleKind::MacroCall(given) => call(given, '[', ']'),
            RuleKind::TurboCall(given) => call(given, '(', ')'),
            RuleKind::Return { target, call: given } => {
                format!("{} <- {}", self.target(target, frame), call(given, '(', ')'))
            }
            RuleKind::RunValue { rule, arguments } => format!("{}[{}]", term(rule), self.list(arguments, frame)),
            RuleKind::RunAgent { agent } => format!("program({})", term(agent)),
            RuleKind::Par(rules) => format!("par {} endpar", all(rules)),
            RuleKind::Seq(rules) => format!("seq {} endseq", all(rules)),
            RuleKind::If { branches, otherwise } => {
                let mut text = String::new();
                for (index, (guard, rule)) in branches.iter().enumerate() {
                    let word = if index == 0 { "if" } else { "elseif" };
                    text += &format!("{word} {} then {} ", term(guard), inner(rule));
                }
                text + &otherwise.as_ref().map(|rule| format!("else {} ", inner(rule))).unwrap_or_default() + "endif"
            }
            RuleKind::Switch { subject, cases, otherwise } => {
                let cases: String = cases.iter().map(|(v, r)| format!("case {}: {} ", term(v), inner(r))).collect();
                let rest = otherwise.as_ref().map(|rule| format!("otherwise {} ", inner(rule))).unwrap_or_default();
                format!("switch {} {cases}{rest}endswitch", term(subject))
            }
            RuleKind::Let { bindings, body } => {
                format!("let ({}) in {} endlet", self.bindings(bindings, frame), inner(body))
            }
            RuleKind::Choose { binders, condition, body, if_none } => {
                let rest = if_none.as_ref().map(|rule| format!(" ifnone {}", inner(rule))).unwrap_or_default();
                format!("choose {} with {} do {}{rest}", self.binders(binders, frame), with(condition), inner(body))
            }
            RuleKind::Forall { binders, condition, body } => {
                format!("forall {} with {} do {}", self.binders(binders, frame), with(condition), inner(body))
            }
            RuleKind::Extend { domain, variables, body } => {
                let names: Vec<String> = variables.iter().map(|id| self.name_of(*id, frame)).collect();
                format!("extend {} with {} do {}", self.model.domains.display(*domain), names.join(", "), inner(body))
            }
            RuleKind::Iterate(rule) => format!("iterate {} enditerate", inner(rule)),
            RuleKind::While { condition, body } => format!("while {} do {}", term(condition), inner(body)),
            RuleKind::RecursiveWhile { condition, body } => format!("whilerec {} do {}", term(condition), inner(body)),
            RuleKind::Local { body, locals } => {
                let names: Vec<&str> = locals
                    .iter()
                    .filter(|(id, _)| self.model.function(*id).kind == FunctionKind::Local)
                    .map(|(id, _)| self.model.function(*id).name.as_str())
                    .collect();
                format!("/* local {} */ {}", names.join(", "), inner(body))
            }
        }
    }
}

fn brackets(kind: CollectionKind) -> (&'static str, &'static str) {
    match kind {
        CollectionKind::Set | CollectionKind::Map => ("{", "}"),
        CollectionKind::Seq => ("[", "]"),
        CollectionKind::Bag => ("<", ">"),
    }
}
