//! What the checker knows of a file's text: what each name means, and the domain of each term.
//!
//! In: a checked model and a file. Out: [`Facts`], asked by places. INVARIANT: candidates come in the order of their
//! declarations, and are visible in the file.

use std::collections::{BTreeMap, BTreeSet};

use model::{DomainId, DomainKind, FunctionId, FunctionKind, Model, Referent, RuleId, RuleKind, Term};
use syntax::{FileId, Span};

use crate::footprint;
use crate::mutant::Named;
use crate::reach::Reach;

/// LIMIT: this many others of the same domains are tried for a function, a rule or a variable.
pub(crate) const OTHERS: usize = 2;

/// The facts of a file.
pub(crate) struct Facts<'m> {
    pub model: &'m Model,
    pub runs: Reach,
    names: BTreeMap<(u32, u32), Referent>,
    bound: BTreeMap<(u32, u32), DomainId>,
    domains: BTreeMap<(u32, u32), DomainId>,
    /// Places of `par` and `seq` that do the same.
    independent: BTreeSet<(u32, u32)>,
    visible_functions: BTreeSet<FunctionId>,
    visible_rules: BTreeSet<RuleId>,
}

impl<'m> Facts<'m> {
    /// The facts of a file.
    pub fn new(model: &'m Model, file: FileId) -> Facts<'m> {
        let (mut names, mut bound, mut domains) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
        for name in model.uses.in_file(file) {
            let at = (name.span.start, name.span.end);
            match name.referent {
                Referent::Variable(_, domain) if name.declares => _ = bound.insert(at, domain),
                referent => _ = names.insert(at, referent),
            }
        }
        let mut add = |term: &Term| {
            if term.span.file == file {
                // Of terms at one place the inner one comes last: it is the one that is written.
                domains.insert((term.span.start, term.span.end), term.domain);
            }
        };
        let bodies = model.functions.iter().filter_map(|function| Some(&function.definition.as_ref()?.body));
        bodies.for_each(|body| body.walk(&mut add));
        for rule in &model.rules {
            rule.body.walk(&mut |rule| rule.terms(&mut |term| term.walk(&mut add)));
        }
        let mut independent = BTreeSet::new();
        for rule in model.rules.iter().filter(|rule| rule.body.span.file == file) {
            rule.body.walk(&mut |rule| {
                if let RuleKind::Par(parts) | RuleKind::Seq(parts) = &rule.kind
                    && footprint::are_independent(model, parts)
                {
                    independent.insert((rule.span.start, rule.span.end));
                }
            });
        }
        let initial = model.inits.iter().flat_map(|init| &init.functions);
        initial.for_each(|initial| initial.definition.body.walk(&mut add));
        let is_root = file == model.root;
        let own = |span: Span| span.file == file;
        let mut visible_functions: BTreeSet<FunctionId> =
            model.functions().filter(|(_, function)| own(function.span)).map(|(id, _)| id).collect();
        let rules = model.rules.iter().enumerate().filter(|(_, rule)| own(rule.span));
        let mut visible_rules: BTreeSet<RuleId> = rules.map(|(index, _)| RuleId(index as u32)).collect();
        if is_root {
            visible_functions.extend(model.names.all_functions().map(|(_, id)| id));
            visible_rules.extend(model.names.all_rules().map(|(_, id)| id));
        }
        visible_functions.retain(|id| !model.function(*id).library);
        Facts {
            model,
            runs: Reach::of_runs(model),
            names,
            bound,
            domains,
            independent,
            visible_functions,
            visible_rules,
        }
    }

    /// What a name at a place means.
    pub fn referent(&self, at: (u32, u32)) -> Option<Referent> {
        self.names.get(&at).copied()
    }

    /// The function that a name at a place means.
    pub fn function(&self, at: (u32, u32)) -> Option<FunctionId> {
        match self.referent(at)? {
            Referent::Function(id) => Some(id),
            _ => None,
        }
    }

    /// The rule that a name at a place means.
    pub fn rule_at(&self, at: (u32, u32)) -> Option<RuleId> {
        match self.referent(at)? {
            Referent::Rule(id) => Some(id),
            _ => None,
        }
    }

    /// The domain of the variable that is bound at a place.
    pub fn bound(&self, at: (u32, u32)) -> Option<DomainId> {
        self.bound.get(&at).copied()
    }

    /// The domain of the term at a place.
    pub fn domain(&self, at: (u32, u32)) -> Option<DomainId> {
        self.domains.get(&at).copied()
    }

    /// Whether a function is derived.
    pub fn is_derived(&self, id: FunctionId) -> bool {
        self.model.function(id).kind == FunctionKind::Derived
    }

    /// Whether a function's value depends on the state.
    pub fn is_dynamic(&self, id: FunctionId) -> bool {
        self.model.function(id).kind != FunctionKind::Static
    }

    /// Whether the parts of the rule at a place do the same one after the other and at once.
    pub fn is_as_parallel(&self, at: (u32, u32)) -> bool {
        self.independent.contains(&at)
    }

    /// A function as a text names it.
    pub fn named(&self, id: FunctionId) -> Named {
        let function = self.model.function(id);
        let parameters = function.parameters.iter().map(|domain| self.model.domains.display(*domain)).collect();
        Named { name: function.name.clone(), parameters }
    }

    /// The literals of an enumeration.
    pub fn literals(&self, domain: DomainId) -> &'m [String] {
        match self.model.domains.kind(self.model.domains.type_domain(domain)) {
            DomainKind::Enum { literals } => literals,
            _ => &[],
        }
    }

    /// Other functions of the same domains that may stand in the place of one; within the definition of `inside`, those that
    /// do not lead back to it. Locations are written, other terms are read.
    pub fn siblings(&self, id: FunctionId, written: bool, inside: Option<FunctionId>) -> Vec<&'m str> {
        let of = self.model.function(id);
        let fits = |other: FunctionKind| match (of.kind, other) {
            (FunctionKind::Controlled | FunctionKind::Shared | FunctionKind::Out, FunctionKind::Controlled) => true,
            (FunctionKind::Controlled | FunctionKind::Shared | FunctionKind::Out, FunctionKind::Shared) => true,
            (FunctionKind::Controlled | FunctionKind::Shared | FunctionKind::Out, FunctionKind::Out) => written,
            (kind, other) => kind == other && !written,
        };
        if of.library || of.kind == FunctionKind::Local {
            return Vec::new();
        }
        let like = |other: &FunctionId| {
            let function = self.model.function(*other);
            *other != id
                && fits(function.kind)
                && function.parameters == of.parameters
                && function.codomain == of.codomain
                && inside.is_none_or(|inside| !Reach::of_function(self.model, *other).functions.contains(&inside))
        };
        let after = self.visible_functions.range(id..).chain(self.visible_functions.range(..id));
        after.copied().filter(like).take(OTHERS).map(|other| self.model.function(other).name.as_str()).collect()
    }

    /// Other rules with the same parameters that may be called in the place of one within `inside`.
    pub fn other_rules(&self, id: RuleId, inside: Option<RuleId>) -> Vec<&'m str> {
        let of = self.model.rule(id);
        let domains = |rule: &model::Rule| -> Vec<DomainId> {
            rule.parameters.iter().map(|parameter| rule.variables[parameter.0 as usize].domain).collect()
        };
        let like = |other: &RuleId| {
            let rule = self.model.rule(*other);
            *other != id
                && Some(*other) != self.model.main
                && rule.turbo == of.turbo
                && rule.result == of.result
                && domains(rule) == domains(of)
                && inside.is_none_or(|inside| !Reach::of_rule(self.model, *other).rules.contains(&inside))
        };
        let after = self.visible_rules.range(id..).chain(self.visible_rules.range(..id));
        after.copied().filter(like).take(OTHERS).map(|other| self.model.rule(other).name.as_str()).collect()
    }
}
