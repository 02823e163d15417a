//! Makes the mutants of one declaration: walks over its tree and applies each operator where it fits.
//!
//! In: the tree of a rule or term, and the facts of its file. Out: mutants, in no order. INVARIANT: a mutant keeps the domains
//! of all terms, so that the checker accepts it; two operators do not make the same text.

use model::{Basic, DomainKind, FunctionId, Referent, RuleId};
use syntax::SyntaxKind::{self, *};
use syntax::SyntaxNode;
use syntax::ast::{self, AstNode, ConditionalBranch, Rule, Term, trimmed_range};

use crate::edit::Edit;
use crate::facts::{Facts, OTHERS};
use crate::mutant::Mutant;
use crate::operator::Operator;
use crate::places::{at, bytes, inside, tokens};

/// Where mutants are made.
pub(crate) struct Maker<'a, 'm> {
    facts: &'a Facts<'m>,
    text: &'a str,
    rule: Option<RuleId>,
    function: Option<FunctionId>,
    initial: bool,
    found: &'a mut Vec<Mutant>,
}

impl<'a, 'm> Maker<'a, 'm> {
    /// In a rule.
    pub fn in_rule(facts: &'a Facts<'m>, text: &'a str, rule: RuleId, found: &'a mut Vec<Mutant>) -> Maker<'a, 'm> {
        Maker { facts, text, rule: Some(rule), function: None, initial: false, found }
    }

    /// In the definition of a function.
    pub fn in_definition(
        facts: &'a Facts<'m>,
        text: &'a str,
        function: FunctionId,
        found: &'a mut Vec<Mutant>,
    ) -> Maker<'a, 'm> {
        Maker { facts, text, rule: None, function: Some(function), initial: false, found }
    }

    /// In an initial state.
    pub fn in_initial(
        facts: &'a Facts<'m>,
        text: &'a str,
        function: FunctionId,
        found: &'a mut Vec<Mutant>,
    ) -> Maker<'a, 'm> {
        Maker { facts, text, rule: None, function: Some(function), initial: true, found }
    }

    fn add(&mut self, operator: Operator, place: &SyntaxNode, edits: Vec<Edit>) {
        let operator = if self.initial { Operator::InitialReplaced } else { operator };
        if operator == Operator::OrderReplaced && self.facts.is_as_parallel(at(trimmed_range(place))) {
            return;
        }
        if !self.stays_dynamic(place, &edits) {
            return;
        }
        let function = self.function.map(|id| self.facts.named(id));
        self.found.push(Mutant { operator, place: bytes(place), edits, function });
    }

    /// Whether the definition of a derived function still depends on the state; otherwise the checker refuses it.
    fn stays_dynamic(&self, place: &SyntaxNode, edits: &[Edit]) -> bool {
        let Some(function) = self.function.filter(|id| self.facts.is_derived(*id) && !self.initial) else {
            return true;
        };
        let Some(definition) = place.ancestors().find(|node| node.kind() == FUNCTION_DEF) else { return true };
        let Some(body) = ast::FunctionDef::cast(definition).and_then(|definition| definition.body()) else {
            return true;
        };
        let names = body.syntax().descendants_with_tokens().filter_map(|element| element.into_token());
        let kept = names.filter(|name| {
            let range = std::ops::Range::<usize>::from(name.text_range());
            // Another function in its place is of the same kind.
            !edits
                .iter()
                .any(|edit| edit.range.start <= range.start && range.end <= edit.range.end && edit.range != range)
        });
        let mut functions = kept.filter_map(|name| self.facts.function(at(name.text_range())));
        // What only changes places, or is put into another term, is still there.
        let is_kept = |edit: &Edit| edits.iter().any(|other| other.text.contains(&self.text[edit.range.clone()]));
        functions.any(|other| other != function && self.facts.is_dynamic(other)) || edits.iter().all(is_kept)
    }

    fn replace(&mut self, operator: Operator, place: &SyntaxNode, by: impl Into<String>) {
        let edit = Edit::new(bytes(place), by);
        if self.text[edit.range.clone()] != edit.text {
            self.add(operator, place, vec![edit]);
        }
    }

    fn text_of(&self, node: &SyntaxNode) -> &'a str {
        &self.text[bytes(node)]
    }

    /// A rule and all inside it.
    pub fn rule(&mut self, node: &SyntaxNode) {
        if let Some(rule) = Rule::cast(node.clone()) {
            self.mutate_rule(&rule, node);
        }
        for child in node.children() {
            // The target of an update and the call of a return were looked at with their rules.
            if Term::cast(child.clone()).is_some() {
                self.term(&child);
            } else {
                self.rule(&child);
            }
        }
    }

    fn mutate_rule(&mut self, rule: &Rule, node: &SyntaxNode) {
        match rule {
            Rule::Update(update) => {
                self.replace(Operator::RuleDeleted, node, "skip");
                if let Some(target) = update.target() {
                    self.function_name(target.syntax(), Operator::LocationReplaced);
                }
                if let Some(value) = update.value() {
                    self.constants(value.syntax());
                }
            }
            Rule::MacroCall(call) => {
                self.replace(Operator::CallDeleted, node, "skip");
                self.other_rule(call.name());
            }
            Rule::TurboCall(call) => {
                if node.parent().is_none_or(|parent| parent.kind() != RETURN_RULE) {
                    self.replace(Operator::CallDeleted, node, "skip");
                }
                self.other_rule(call.name());
            }
            Rule::Return(_) | Rule::Term(_) => self.replace(Operator::CallDeleted, node, "skip"),
            Rule::Extend(_) => self.replace(Operator::RuleDeleted, node, "skip"),
            Rule::Switch(switch) => {
                self.replace(Operator::RuleDeleted, node, "skip");
                let cases = switch.cases().filter_map(|case| Some(case.rule()?.syntax().clone()));
                self.swap(node, &cases.collect::<Vec<_>>());
            }
            Rule::If(conditional) => {
                let branches: Vec<ConditionalBranch> = conditional.branches().collect();
                if branches.len() > 1 || conditional.otherwise().is_some() {
                    self.replace(Operator::RuleDeleted, node, "skip");
                }
                let bodies = branches.iter().filter_map(|branch| Some(branch.rule()?.syntax().clone()));
                self.swap(node, &bodies.collect::<Vec<_>>());
                branches.iter().filter_map(ConditionalBranch::guard).for_each(|guard| self.guard(&guard));
            }
            Rule::Choose(choose) => choose.condition().iter().for_each(|guard| self.guard(guard)),
            Rule::Forall(forall) => forall.condition().iter().for_each(|guard| self.guard(guard)),
            Rule::While(rule) => rule.condition().iter().for_each(|guard| self.guard(guard)),
            Rule::RecursiveWhile(rule) => rule.condition().iter().for_each(|guard| self.guard(guard)),
            Rule::Par(_) => self.reorder(node, [(PAR_KW, "seq"), (ENDPAR_KW, "endseq")]),
            Rule::Seq(_) => self.reorder(node, [(SEQ_KW, "par"), (ENDSEQ_KW, "endpar")]),
            Rule::Skip(_) | Rule::Let(_) | Rule::Iterate(_) | Rule::Local(_) => {}
        }
    }

    fn reorder(&mut self, node: &SyntaxNode, words: [(SyntaxKind, &str); 2]) {
        if node.children().filter_map(Rule::cast).count() < 2 {
            return;
        }
        let edit = |(kind, word): (SyntaxKind, &str)| {
            Some(Edit::new(tokens(node).find(|token| token.kind() == kind)?.text_range(), word))
        };
        if let [Some(begin), Some(end)] = words.map(edit) {
            self.add(Operator::OrderReplaced, node, vec![begin, end]);
        }
    }

    /// Neighbours change places.
    fn swap(&mut self, place: &SyntaxNode, parts: &[SyntaxNode]) {
        for pair in parts.windows(2) {
            let texts = [self.text_of(&pair[0]), self.text_of(&pair[1])];
            if texts[0] != texts[1] {
                let edits = vec![Edit::new(bytes(&pair[0]), texts[1]), Edit::new(bytes(&pair[1]), texts[0])];
                self.add(Operator::BranchesSwapped, place, edits);
            }
        }
    }

    fn guard(&mut self, guard: &Term) {
        let node = inside(guard.syntax());
        let text = self.text_of(&node);
        if text == "true" {
            return self.replace(Operator::GuardFalse, guard.syntax(), "false");
        }
        if text == "false" {
            return self.replace(Operator::GuardTrue, guard.syntax(), "true");
        }
        let negation = match negated(&node) {
            Some(operand) => self.text_of(&operand).to_string(),
            None => format!("not ({text})"),
        };
        self.replace(Operator::GuardNegated, guard.syntax(), negation);
        self.replace(Operator::GuardTrue, guard.syntax(), "true");
        self.replace(Operator::GuardFalse, guard.syntax(), "false");
    }

    /// The body of a definition.
    pub fn definition(&mut self, body: &Term) {
        self.constants(body.syntax());
        self.term(body.syntax());
    }

    /// A term that is no constant is replaced by constants of its domain.
    fn constants(&mut self, value: &SyntaxNode) {
        let node = inside(value);
        if matches!(node.kind(), LITERAL_TERM | ENUM_TERM | IF_TERM | SWITCH_TERM | LET_TERM) {
            return;
        }
        let Some(domain) = self.facts.domain(at(trimmed_range(&node))) else { return };
        if matches!(self.facts.model.domains.kind(domain), DomainKind::Basic(Basic::Boolean)) {
            self.replace(Operator::ValueReplaced, value, "true");
            self.replace(Operator::ValueReplaced, value, "false");
        }
        for literal in self.facts.literals(domain).iter().take(OTHERS + 1) {
            self.replace(Operator::ValueReplaced, value, literal.as_str());
        }
    }

    /// A term and all inside it.
    pub fn term(&mut self, node: &SyntaxNode) {
        self.mutate_term(node);
        for child in node.children() {
            self.term(&child);
        }
    }

    fn mutate_term(&mut self, node: &SyntaxNode) {
        match node.kind() {
            BINARY_TERM => self.binary(node),
            UNARY_TERM => self.unary(node),
            LITERAL_TERM if !is_case(node) => self.literal(node),
            ENUM_TERM if !is_case(node) => self.enumerated(node),
            FUNCTION_TERM if !is_target(node) => self.function_name(node, Operator::FunctionReplaced),
            VARIABLE_TERM => self.variable(node),
            QUANTIFIED_TERM => self.quantifier(node),
            IF_TERM => {
                let branches: Vec<ConditionalBranch> = node.children().filter_map(ConditionalBranch::cast).collect();
                let values = branches.iter().filter_map(|branch| Some(branch.term()?.syntax().clone()));
                self.swap(node, &values.collect::<Vec<_>>());
                branches.iter().filter_map(ConditionalBranch::guard).for_each(|guard| self.guard(&guard));
            }
            SWITCH_TERM => {
                let cases = node.children().filter_map(ast::CaseBranch::cast);
                let values = cases.filter_map(|case| Some(case.term()?.syntax().clone()));
                self.swap(node, &values.collect::<Vec<_>>());
            }
            _ => {}
        }
    }

    fn quantifier(&mut self, node: &SyntaxNode) {
        if tokens(node).any(|token| token.kind() == UNIQUE_KW) {
            return;
        }
        let word = tokens(node).find(|token| matches!(token.kind(), FORALL_KW | EXISTS_KW));
        if let Some(word) = word {
            let other = if word.kind() == FORALL_KW { "exist" } else { "forall" };
            self.add(Operator::QuantifierReplaced, node, vec![Edit::new(word.text_range(), other)]);
        }
    }

    fn unary(&mut self, node: &SyntaxNode) {
        let Some(operand) = node.children().next() else { return };
        let by = self.text_of(&operand).to_string();
        match tokens(node).next().map(|token| token.kind()) {
            Some(MINUS) => self.replace(Operator::ArithmeticReplaced, node, by),
            // As a guard it is negated already.
            Some(FUNCTION_ID) if !is_guard(node) => self.replace(Operator::LogicalReplaced, node, by),
            _ => {}
        }
    }

    fn binary(&mut self, node: &SyntaxNode) {
        let (Some(left), Some(right)) = (node.children().next(), node.children().nth(1)) else { return };
        let Some(token) = tokens(node).next() else { return };
        // The last of each list is the negation.
        let (operator, others): (Operator, &[&str]) = match token.text() {
            "and" => (Operator::LogicalReplaced, &["or"]),
            "or" => (Operator::LogicalReplaced, &["and"]),
            "implies" => (Operator::LogicalReplaced, &["and"]),
            "iff" => (Operator::LogicalReplaced, &["xor"]),
            "xor" => (Operator::LogicalReplaced, &["iff"]),
            "=" => (Operator::RelationReplaced, &["!="]),
            "!=" => (Operator::RelationReplaced, &["="]),
            "<" => (Operator::RelationReplaced, &["<=", ">="]),
            "<=" => (Operator::RelationReplaced, &["<", ">"]),
            ">" => (Operator::RelationReplaced, &[">=", "<="]),
            ">=" => (Operator::RelationReplaced, &[">", "<"]),
            "in" => (Operator::RelationReplaced, &["notin"]),
            "notin" => (Operator::RelationReplaced, &["in"]),
            "+" => (Operator::ArithmeticReplaced, &["-"]),
            "-" => (Operator::ArithmeticReplaced, &["+"]),
            "*" => (Operator::ArithmeticReplaced, &["+"]),
            "mod" => (Operator::ArithmeticReplaced, &["*"]),
            _ => return,
        };
        if operator == Operator::ArithmeticReplaced && !self.is_integer(node) {
            return;
        }
        let negates = operator == Operator::RelationReplaced || matches!(token.text(), "iff" | "xor");
        for other in others {
            if negates && Some(other) == others.last() && is_guard(node) {
                continue;
            }
            if tight(token.text()) == tight(other) {
                self.add(operator, node, vec![Edit::new(token.text_range(), *other)]);
                continue;
            }
            // Another operator may bind otherwise: the tree stays as it is.
            let wrap = |part: &SyntaxNode| {
                let text = self.text_of(part);
                if matches!(part.kind(), BINARY_TERM | UNARY_TERM) { format!("({text})") } else { text.to_string() }
            };
            let made = format!("{} {other} {}", wrap(&left), wrap(&right));
            let among = node.parent().is_some_and(|parent| matches!(parent.kind(), BINARY_TERM | UNARY_TERM));
            self.replace(operator, node, if among { format!("({made})") } else { made });
        }
    }

    fn is_integer(&self, node: &SyntaxNode) -> bool {
        let domain = self.facts.domain(at(trimmed_range(node)));
        domain.is_some_and(|domain| domain == model::Domains::INTEGER)
    }

    fn literal(&mut self, node: &SyntaxNode) {
        let text = self.text_of(node);
        match tokens(node).next().map(|token| token.kind()) {
            Some(TRUE_KW) if !is_guard(node) => self.replace(Operator::LiteralReplaced, node, "false"),
            Some(FALSE_KW) if !is_guard(node) => self.replace(Operator::LiteralReplaced, node, "true"),
            Some(INTEGER) => {
                let Ok(value) = text.parse::<i64>() else { return };
                self.replace(Operator::ConstantShifted, node, value.saturating_add(1).to_string());
                // A sign before it shifts the other way: -0 would be 0.
                if value > 0 {
                    self.replace(Operator::ConstantShifted, node, (value - 1).to_string());
                } else if node.parent().is_none_or(|parent| parent.kind() != UNARY_TERM) {
                    let among = node.parent().is_some_and(|parent| parent.kind() == BINARY_TERM);
                    self.replace(Operator::ConstantShifted, node, if among { "(-1)" } else { "-1" });
                }
            }
            Some(NATURAL) => {
                let Some(value) = text.strip_suffix('n').and_then(|digits| digits.parse::<i64>().ok()) else { return };
                self.replace(Operator::ConstantShifted, node, format!("{}n", value.saturating_add(1)));
                if value > 0 {
                    self.replace(Operator::ConstantShifted, node, format!("{}n", value - 1));
                }
            }
            _ => {}
        }
    }

    fn enumerated(&mut self, node: &SyntaxNode) {
        let text = self.text_of(node);
        let Some(Referent::Literal(domain, place)) = self.facts.referent(at(trimmed_range(node))) else {
            return;
        };
        let literals = self.facts.literals(domain);
        let place = place as usize;
        let others = literals.iter().skip(place + 1).chain(literals.iter().take(place));
        for other in others.filter(|other| *other != text).take(OTHERS) {
            self.replace(Operator::LiteralReplaced, node, other.as_str());
        }
    }

    fn function_name(&mut self, node: &SyntaxNode, operator: Operator) {
        let Some(term) = ast::FunctionTerm::cast(node.clone()) else { return };
        let (None, Some(name)) = (term.agent(), term.name()) else { return };
        let Some(function) = self.facts.function(at(name.text_range())) else { return };
        for other in self.facts.siblings(function, operator == Operator::LocationReplaced, self.function) {
            self.add(operator, node, vec![Edit::new(name.text_range(), other)]);
        }
    }

    fn other_rule(&mut self, name: Option<syntax::SyntaxToken>) {
        let Some(name) = name else { return };
        let Some(rule) = self.facts.rule_at(at(name.text_range())) else { return };
        let Some(node) = name.parent() else { return };
        for other in self.facts.other_rules(rule, self.rule) {
            self.add(Operator::CallReplaced, &node, vec![Edit::new(name.text_range(), other)]);
        }
    }

    /// Other variables that are bound here.
    fn variable(&mut self, node: &SyntaxNode) {
        let Some(Referent::Variable(_, domain)) = self.facts.referent(at(trimmed_range(node))) else {
            return;
        };
        let text = self.text_of(node);
        let mut others: Vec<String> = Vec::new();
        for binding in bound_at(node) {
            let name = binding.text().to_string();
            let fits = self.facts.bound(at(binding.text_range())) == Some(domain);
            if fits && name != text && !others.contains(&name) && others.len() < OTHERS {
                others.push(name);
            }
        }
        for other in others {
            self.replace(Operator::VariableReplaced, node, other);
        }
    }
}

/// The variables that are bound where a node stands, the innermost first.
fn bound_at(node: &SyntaxNode) -> Vec<syntax::SyntaxToken> {
    let start = node.text_range().start();
    let mut found = Vec::new();
    for around in node.ancestors().skip(1) {
        let is_after = |part: &SyntaxNode| part.text_range().end() <= start;
        match around.kind() {
            RULE_DECL | FUNCTION_DEF => {
                let lists = around.children().filter(|part| part.kind() == PARAMETER_LIST);
                let parameters = lists.flat_map(|list| list.children().collect::<Vec<_>>());
                found.extend(parameters.flat_map(|part| tokens(&part).find(|token| token.kind() == VARIABLE)));
            }
            FORALL_RULE | CHOOSE_RULE | QUANTIFIED_TERM | COMPREHENSION_TERM | LET_RULE | LET_TERM => {
                let otherwise = ast::ChooseRule::cast(around.clone()).and_then(|choose| choose.if_none());
                if otherwise.is_some_and(|rule| rule.syntax().text_range().contains_range(node.text_range())) {
                    continue;
                }
                // The body of a comprehension stands behind its binders.
                let parts = around.children().filter(|part| matches!(part.kind(), BINDER | BINDING));
                found.extend(
                    parts.filter(is_after).flat_map(|part| tokens(&part).find(|token| token.kind() == VARIABLE)),
                );
            }
            EXTEND_RULE => found.extend(tokens(&around).filter(|token| token.kind() == VARIABLE)),
            _ => {}
        }
    }
    found
}

/// The operand of `not`.
fn negated(node: &SyntaxNode) -> Option<SyntaxNode> {
    let is_not = node.kind() == UNARY_TERM && tokens(node).next()?.kind() == FUNCTION_ID;
    if is_not { node.children().next() } else { None }
}

/// Whether a term is a whole guard.
fn is_guard(node: &SyntaxNode) -> bool {
    let mut node = node.clone();
    while let Some(parent) = node.parent().filter(|parent| parent.kind() == PAREN_TERM) {
        node = parent;
    }
    let Some(parent) = node.parent() else { return false };
    match parent.kind() {
        CONDITIONAL_BRANCH => {
            parent.children().find(|child| Term::cast(child.clone()).is_some()).as_ref() == Some(&node)
        }
        CHOOSE_RULE | FORALL_RULE | WHILE_RULE | RECURSIVE_WHILE_RULE => true,
        _ => false,
    }
}

/// Whether a term is the value of a case: its neighbours are other cases.
fn is_case(node: &SyntaxNode) -> bool {
    let parent = node.parent().filter(|parent| parent.kind() == CASE_BRANCH);
    parent.is_some_and(|parent| parent.children().next().as_ref() == Some(node))
}

/// Whether a term is what an update or a return writes.
fn is_target(node: &SyntaxNode) -> bool {
    let parent = node.parent().filter(|parent| matches!(parent.kind(), UPDATE_RULE | RETURN_RULE));
    parent.is_some_and(|parent| parent.children().next().as_ref() == Some(node))
}

/// Operators with the same number bind alike.
fn tight(operator: &str) -> u8 {
    match operator {
        "implies" | "iff" => 0,
        "or" | "xor" => 1,
        "and" => 2,
        "=" | "!=" | "<" | "<=" | ">" | ">=" => 3,
        "in" | "notin" => 4,
        "+" | "-" => 5,
        "*" | "mod" => 6,
        _ => 7,
    }
}
