//! Which shapes of a chart places of its model speak of.
//!
//! In: the syntax of a model, a chart, places in the model. Out: for each place an action, a guard and a state, as far as what is around it
//! names them: a rule that is an action's, a condition that is a guard's, a test of the control variable. INVARIANT: nothing is guessed;
//! what nothing names has no shape. A test says nothing of what lies in its `else`.

use chart::{Chart, Lights, Machine, ShapeKind, subjects};
use syntax::SyntaxKind::*;
use syntax::ast::{
    AstNode, BinaryTerm, CaseBranch, ConditionalBranch, ParenTerm, SwitchRule, SwitchTerm, Term, UnaryTerm,
};
use syntax::{Parse, SyntaxNode, SyntaxToken};

/// The shapes of a drawing that a place speaks of.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Spoken {
    /// The machine.
    pub drawing: String,
    /// A control state.
    pub state: Option<String>,
    /// A guard.
    pub guard: Option<String>,
    /// An action.
    pub action: Option<String>,
    /// The declared rule around the place.
    pub rule: Option<String>,
}

impl Spoken {
    fn weight(&self) -> usize {
        let inner = usize::from(self.guard.is_some() || self.action.is_some());
        2 * usize::from(self.state.is_some()) + inner
    }
}

/// What each of these places of a model speaks of.
pub fn spoken(model: &Parse, chart: &Chart, offsets: &[u32]) -> Vec<Option<Spoken>> {
    let machines: Vec<(&Machine, Option<Lights>)> = subjects(chart)
        .filter_map(|subject| {
            let machine = subject.machine()?;
            // A machine with parameters runs for each element: its variables stand for any.
            let elements: Vec<&str> = machine.parameters.iter().map(|one| one.variable.as_str()).collect();
            Some((machine, subject.lights(&[elements.join(", ")]).into_iter().next()))
        })
        .collect();
    let root = model.syntax();
    let at = |offset: u32| {
        let token = root.token_at_offset(offset.into()).right_biased()?;
        let mut best: Option<Spoken> = None;
        for (machine, lights) in &machines {
            let found = around(&token, machine, lights.as_ref());
            if found.weight() > best.as_ref().map_or(0, Spoken::weight) {
                best = Some(found);
            }
        }
        best
    };
    offsets.iter().map(|offset| at(*offset)).collect()
}

/// The places of a model that may speak of shapes: conditionals, cases, rules and their calls.
pub fn speaking(model: &Parse) -> Vec<u32> {
    let nodes = model.syntax().descendants().filter(|node| {
        matches!(
            node.kind(),
            IF_RULE | IF_TERM | CONDITIONAL_BRANCH | CASE_BRANCH | RULE_DECL | MACRO_CALL_RULE | TURBO_CALL_RULE
        )
    });
    let mut found: Vec<u32> = nodes.filter_map(|node| Some(start(&node)?.text_range().start().into())).collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// What the nodes around a token say of a machine, from the innermost out.
fn around(token: &SyntaxToken, machine: &Machine, lights: Option<&Lights>) -> Spoken {
    let mut found = Spoken { drawing: machine.name.clone(), ..Spoken::default() };
    let control = lights.map(|lights| function_of(&lights.term).to_string());
    let state_of = |value: &str| {
        let light = lights?.shapes.iter().find(|light| light.value == value)?;
        Some(light.shape.clone())
    };
    let mut inner: Option<SyntaxNode> = None;
    let mut value: Option<String> = None;
    for node in token.parent_ancestors() {
        match node.kind() {
            RULE_DECL | MACRO_CALL_RULE | TURBO_CALL_RULE => {
                let name = words(&node).find(|word| word.kind() == RULE_ID).map(|word| word.text().to_string());
                if let Some(name) = &name {
                    found.action = found.action.or_else(|| action_of(machine, name));
                }
                if node.kind() == RULE_DECL {
                    found.rule = name.or(found.rule);
                }
            }
            IF_RULE | IF_TERM => {
                let (guard, holds) = condition_at(&node, inner.as_ref());
                if let Some(condition) = guard {
                    found.guard = found.guard.or_else(|| guard_of(machine, &condition));
                    let tested = control.as_deref().filter(|_| holds).and_then(|control| tested(&condition, control));
                    found.state = found.state.or_else(|| tested.and_then(|value| state_of(&value)));
                }
            }
            CASE_BRANCH => {
                value = CaseBranch::cast(node.clone()).and_then(|case| case.value()).map(|one| said(one.syntax()))
            }
            SWITCH_RULE | SWITCH_TERM => {
                let subject = SwitchRule::cast(node.clone()).and_then(|switch| switch.subject());
                let subject = subject.or_else(|| SwitchTerm::cast(node.clone()).and_then(|switch| switch.subject()));
                let is_control =
                    subject.is_some_and(|term| Some(function_of(&said(term.syntax()))) == control.as_deref());
                let here = value.take().filter(|_| is_control);
                found.state = found.state.or_else(|| here.and_then(|value| state_of(&value)));
            }
            _ => {}
        }
        inner = Some(node);
    }
    found
}

/// The condition that is about a part of a conditional, and whether it holds there: that of the branch, and of what is in the `else`, the
/// last one.
fn condition_at(node: &SyntaxNode, inner: Option<&SyntaxNode>) -> (Option<Term>, bool) {
    let branches: Vec<ConditionalBranch> = node.children().filter_map(ConditionalBranch::cast).collect();
    match inner {
        // The conditional itself: what is first.
        None => (branches.first().and_then(ConditionalBranch::guard), true),
        Some(inner) => match branches.iter().find(|branch| branch.syntax() == inner) {
            Some(branch) => (branch.guard(), true),
            None if inner.parent().as_ref() == Some(node) => {
                (branches.last().and_then(ConditionalBranch::guard), false)
            }
            None => (branches.first().and_then(ConditionalBranch::guard), true),
        },
    }
}

/// The value that one of the conjuncts of a condition gives the control variable.
fn tested(condition: &Term, control: &str) -> Option<String> {
    let node = condition.syntax();
    if let Some(paren) = ParenTerm::cast(node.clone()) {
        return tested(&paren.term()?, control);
    }
    let binary = BinaryTerm::cast(node.clone())?;
    let (left, right) = (binary.left()?, binary.right()?);
    match binary.operator()?.text() {
        "and" => tested(&left, control).or_else(|| tested(&right, control)),
        "=" => {
            let (left, right) = (said(bare(left).syntax()), said(bare(right).syntax()));
            let is_name = |text: &str| text.chars().all(|c| c.is_alphanumeric() || c == '_');
            match (function_of(&left) == control, function_of(&right) == control) {
                (true, _) if is_name(&right) => Some(right),
                (_, true) if is_name(&left) => Some(left),
                _ => None,
            }
        }
        _ => None,
    }
}

/// A term without the parentheses around it.
fn bare(term: Term) -> Term {
    match ParenTerm::cast(term.syntax().clone()).and_then(|paren| paren.term()) {
        Some(inner) => bare(inner),
        None => term,
    }
}

/// The guard whose condition it is, or the opposite of which.
fn guard_of(machine: &Machine, condition: &Term) -> Option<String> {
    let whole = bare(condition.clone());
    let opposite = UnaryTerm::cast(whole.syntax().clone())
        .filter(|unary| unary.operator().is_some_and(|word| word.text() == "not"))
        .and_then(|unary| unary.operand());
    let mut all = vec![said(whole.syntax())];
    all.extend(opposite.map(|inner| said(bare(inner).syntax())));
    let is_it = |shape: &&chart::Shape| {
        let link = shape.link.as_ref().map_or(shape.name.as_str(), |link| link.text.as_str());
        shape.kind == ShapeKind::Guard && all.contains(&without_blanks(link))
    };
    machine.shapes.iter().find(is_it).map(|shape| shape.name.clone())
}

/// The action that a rule is, by its link or its name.
fn action_of(machine: &Machine, rule: &str) -> Option<String> {
    let is_it = |shape: &&chart::Shape| {
        shape.kind == ShapeKind::Action
            && match &shape.link {
                Some(link) => function_of(&link.text) == rule,
                None => rule.strip_prefix("r_") == Some(shape.name.as_str()),
            }
    };
    machine.shapes.iter().find(is_it).map(|shape| shape.name.clone())
}

/// The name that a term begins with: `arm` of `arm($c)`.
fn function_of(term: &str) -> &str {
    let term = term.trim_start();
    &term[..term.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(term.len())]
}

/// What a node says, without blanks and comments.
fn said(node: &SyntaxNode) -> String {
    words(node).map(|word| word.text().to_string()).collect()
}

fn without_blanks(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace()).collect()
}

fn words(node: &SyntaxNode) -> impl Iterator<Item = SyntaxToken> {
    let tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
    tokens.filter(|token| !token.kind().is_trivia())
}

fn start(node: &SyntaxNode) -> Option<SyntaxToken> {
    words(node).next()
}

#[cfg(test)]
mod tests {
    use super::*;
    use syntax::{FileId, parse_asmetal, parse_chart};

    const LAMP: &str =
        "chart Lamp machine lamp control light initial state off state on guard pressed guard late {timer > 5}
        action count off -> pressed yes -> count -> on on -> late yes -> off endmachine";

    /// A rule, with `^` before the place that is asked about.
    fn at(rule: &str) -> Option<Spoken> {
        let begun = "asm A\nsignature:\ndefinitions:\n";
        let offset = (begun.len() + rule.find('^').expect("a place")) as u32;
        let parse = parse_asmetal(FileId(0), &format!("{begun}{}", rule.replace('^', "")));
        let (chart, _) = chart::read(FileId(0), &parse_chart(FileId(0), LAMP));
        spoken(&parse, &chart, &[offset]).remove(0)
    }

    #[track_caller]
    fn check(rule: &str, expect: [&str; 3]) {
        let found = at(rule).unwrap_or_default();
        let own = [found.state, found.guard, found.action].map(Option::unwrap_or_default);
        assert_eq!(own, expect.map(str::to_string), "{rule}");
    }

    #[test]
    fn tests_of_the_control_variable_name_states_conditions_guards_and_rules_actions() {
        check(
            "main rule r_Main = if light = OFF then if pressed then ^r_count[] endif endif",
            ["off", "pressed", "count"],
        );
        check("main rule r_Main = if light = OFF then ^if pressed then r_count[] endif endif", ["off", "pressed", ""]);
        check("main rule r_Main = ^if (ON = light) and x > 1 then skip endif", ["on", "", ""]);
        check("main rule r_Main = switch light case OFF: r_count[] case ON: ^skip endswitch", ["on", "", ""]);
        check("rule r_count = ^skip", ["", "", "count"]);
        check("main rule r_Main = if timer>5 then ^skip endif", ["", "late", ""]);
        check("main rule r_Main = if not (timer > /* s */ 5) then ^skip endif", ["", "late", ""]);
        check("main rule r_Main = if (light = ON and timer > 5) then ^skip endif", ["on", "", ""]);
        check("main rule r_Main = x := if light = ON then ^1 else 2 endif", ["on", "", ""]);
    }

    #[test]
    fn what_lies_in_an_else_is_not_in_the_state_that_was_tested() {
        check("main rule r_Main = if light = OFF then skip else ^skip endif", ["", "", ""]);
        check(
            "main rule r_Main = if light = OFF then if pressed then skip else ^x := 1 endif endif",
            ["off", "pressed", ""],
        );
        check("main rule r_Main = if light = OFF then skip elseif light = ON then ^skip endif", ["on", "", ""]);
        check("main rule r_Main = if light = OFF then /* else */ ^skip endif", ["off", "", ""]);
    }

    #[test]
    fn what_nothing_names_has_no_shape() {
        check("main rule r_Main = if other = OFF then ^skip endif", ["", "", ""]);
        check("main rule r_Main = if light != OFF then ^skip endif", ["", "", ""]);
        check("main rule r_Main = if light = OFF or x then ^skip endif", ["", "", ""]);
        check("main rule r_Main = if not (light = OFF) then ^skip endif", ["", "", ""]);
        check("rule r_counter = if light = BROKEN then ^skip endif", ["", "", ""]);
        check("main rule r_Main = switch other case ON: ^skip endswitch", ["", "", ""]);
        assert_eq!(at("main rule r_Main = ^skip"), None);
        assert_eq!(
            at("main rule r_Main = if light = OFF then ^skip endif").and_then(|found| found.rule).as_deref(),
            Some("r_Main")
        );
    }
}
