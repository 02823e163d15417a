//! P[t₁/x₁,…,tₙ/xₙ]: a macro rule's body with terms in the place of its parameters (Börger & Stärk 2003, section 2.4,
//! "rule declarations": the call of a declared rule by name).
//!
//! In: the parameters, the arguments, and a number above all variables in use. The body's own variables are renamed
//! to numbers from there on, so that none of them captures a variable of an argument.

use model::{Binder, Call, RuleKind, RuleNode, Target, Term, TermKind, VariableId};

/// A substitution of terms for parameters that also renames all other variables.
pub struct Substitution<'a> {
    parameters: &'a [VariableId],
    arguments: &'a [Term],
    first_fresh: u32,
}

impl<'a> Substitution<'a> {
    /// [t₁/x₁,…,tₙ/xₙ]
    pub fn new(parameters: &'a [VariableId], arguments: &'a [Term], first_fresh: u32) -> Self {
        Substitution { parameters, arguments, first_fresh }
    }

    /// P[t₁/x₁,…,tₙ/xₙ]
    pub fn rule(&self, rule: &RuleNode) -> RuleNode {
        let node = |rule: &RuleNode| self.rule(rule);
        let boxed = |rule: &RuleNode| Box::new(self.rule(rule));
        let optional = |rule: &Option<Box<RuleNode>>| rule.as_ref().map(|rule| Box::new(self.rule(rule)));
        let guarded =
            |pairs: &[(Term, RuleNode)]| pairs.iter().map(|(term, rule)| (self.term(term), self.rule(rule))).collect();
        let kind = match &rule.kind {
            RuleKind::Skip => RuleKind::Skip,
            RuleKind::Error => RuleKind::Error,
            RuleKind::Update { target, value } => {
                RuleKind::Update { target: self.target(target), value: self.term(value) }
            }
            RuleKind::MacroCall(call) => RuleKind::MacroCall(self.call(call)),
            RuleKind::TurboCall(call) => RuleKind::TurboCall(self.call(call)),
            RuleKind::Return { target, call } => {
                RuleKind::Return { target: self.target(target), call: self.call(call) }
            }
            RuleKind::RunValue { rule, arguments } => {
                RuleKind::RunValue { rule: self.term(rule), arguments: self.terms(arguments) }
            }
            RuleKind::RunAgent { agent } => RuleKind::RunAgent { agent: self.term(agent) },
            RuleKind::Par(rules) => RuleKind::Par(rules.iter().map(node).collect()),
            RuleKind::Seq(rules) => RuleKind::Seq(rules.iter().map(node).collect()),
            RuleKind::If { branches, otherwise } => {
                RuleKind::If { branches: guarded(branches), otherwise: optional(otherwise) }
            }
            RuleKind::Switch { subject, cases, otherwise } => {
                RuleKind::Switch { subject: self.term(subject), cases: guarded(cases), otherwise: optional(otherwise) }
            }
            RuleKind::Let { bindings, body } => RuleKind::Let { bindings: self.bindings(bindings), body: boxed(body) },
            RuleKind::Choose { binders, condition, body, if_none } => RuleKind::Choose {
                binders: self.binders(binders),
                condition: condition.as_ref().map(|condition| self.term(condition)),
                body: boxed(body),
                if_none: optional(if_none),
            },
            RuleKind::Forall { binders, condition, body } => RuleKind::Forall {
                binders: self.binders(binders),
                condition: condition.as_ref().map(|condition| self.term(condition)),
                body: boxed(body),
            },
            RuleKind::Extend { domain, variables, body } => RuleKind::Extend {
                domain: *domain,
                variables: variables.iter().map(|variable| self.renamed(*variable)).collect(),
                body: boxed(body),
            },
            RuleKind::Iterate(body) => RuleKind::Iterate(boxed(body)),
            RuleKind::While { condition, body } => {
                RuleKind::While { condition: self.term(condition), body: boxed(body) }
            }
            RuleKind::RecursiveWhile { condition, body } => {
                RuleKind::RecursiveWhile { condition: self.term(condition), body: boxed(body) }
            }
            RuleKind::Local { locals, body } => RuleKind::Local {
                locals: locals.iter().map(|(function, rule)| (*function, self.rule(rule))).collect(),
                body: boxed(body),
            },
        };
        RuleNode { kind, span: rule.span }
    }

    /// t[t₁/x₁,…,tₙ/xₙ]
    pub fn term(&self, term: &Term) -> Term {
        let boxed = |term: &Term| Box::new(self.term(term));
        let optional = |term: &Option<Box<Term>>| term.as_ref().map(|term| Box::new(self.term(term)));
        let pairs = |pairs: &[(Term, Term)]| pairs.iter().map(|(a, b)| (self.term(a), self.term(b))).collect();
        let kind = match &term.kind {
            TermKind::Variable(variable) => match self.argument(*variable) {
                Some(argument) => return argument.clone(),
                None => TermKind::Variable(self.renamed(*variable)),
            },
            TermKind::Literal(literal) => TermKind::Literal(literal.clone()),
            TermKind::Domain(domain) => TermKind::Domain(*domain),
            TermKind::Rule(rule) => TermKind::Rule(*rule),
            TermKind::Unbound(variable) => TermKind::Unbound(*variable),
            TermKind::Error => TermKind::Error,
            TermKind::Apply { function, arguments } => {
                TermKind::Apply { function: *function, arguments: self.terms(arguments) }
            }
            TermKind::Tuple(parts) => TermKind::Tuple(self.terms(parts)),
            TermKind::Project { tuple, index } => TermKind::Project { tuple: boxed(tuple), index: *index },
            TermKind::Collection { kind, elements } => {
                TermKind::Collection { kind: *kind, elements: self.terms(elements) }
            }
            TermKind::Range { kind, low, high, step } => {
                TermKind::Range { kind: *kind, low: boxed(low), high: boxed(high), step: optional(step) }
            }
            TermKind::Comprehension { kind, binders, condition, body } => TermKind::Comprehension {
                kind: *kind,
                binders: self.binders(binders),
                condition: optional(condition),
                body: boxed(body),
            },
            TermKind::Quantified { quantifier, binders, condition } => TermKind::Quantified {
                quantifier: *quantifier,
                binders: self.binders(binders),
                condition: optional(condition),
            },
            TermKind::If { branches, otherwise } => {
                TermKind::If { branches: pairs(branches), otherwise: optional(otherwise) }
            }
            TermKind::Switch { subject, cases, otherwise } => {
                TermKind::Switch { subject: boxed(subject), cases: pairs(cases), otherwise: optional(otherwise) }
            }
            TermKind::Let { bindings, body } => TermKind::Let { bindings: self.bindings(bindings), body: boxed(body) },
            TermKind::Coerce(inner) => TermKind::Coerce(boxed(inner)),
        };
        Term { kind, domain: term.domain, span: term.span }
    }

    fn argument(&self, variable: VariableId) -> Option<&Term> {
        let place = self.parameters.iter().position(|parameter| *parameter == variable)?;
        Some(&self.arguments[place])
    }

    fn renamed(&self, variable: VariableId) -> VariableId {
        VariableId(self.first_fresh + variable.0)
    }

    fn terms(&self, terms: &[Term]) -> Vec<Term> {
        terms.iter().map(|term| self.term(term)).collect()
    }

    fn bindings(&self, bindings: &[(VariableId, Term)]) -> Vec<(VariableId, Term)> {
        bindings.iter().map(|(variable, term)| (self.renamed(*variable), self.term(term))).collect()
    }

    fn binders(&self, binders: &[Binder]) -> Vec<Binder> {
        let renamed =
            |binder: &Binder| Binder { variable: self.renamed(binder.variable), range: self.term(&binder.range) };
        binders.iter().map(renamed).collect()
    }

    fn call(&self, call: &Call) -> Call {
        Call { rule: call.rule, arguments: self.terms(&call.arguments) }
    }

    /// A location parameter becomes the location that the argument names.
    fn target(&self, target: &Target) -> Target {
        match target {
            Target::Location { function, arguments, span } => {
                Target::Location { function: *function, arguments: self.terms(arguments), span: *span }
            }
            Target::Parameter(variable, span) => match self.argument(*variable).map(|argument| &argument.kind) {
                Some(TermKind::Apply { function, arguments }) => {
                    Target::Location { function: *function, arguments: arguments.clone(), span: *span }
                }
                // The parameter of a rule that was itself called by value does not name a location.
                _ => Target::Parameter(*variable, *span),
            },
        }
    }
}
