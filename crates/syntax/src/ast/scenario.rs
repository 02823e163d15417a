//! Views of scenarios, the language Avalla (spec/avalla.md).

use super::{AstNode, Children, Rule, Term, child, children, choice, nodes, nth, token, tokens};
use crate::{SyntaxKind::*, SyntaxToken};

nodes! {
    /// `scenario NAME load PATH expect… invariants commands`
    ScenarioFile = SCENARIO_FILE,
    /// `invariant NAME: term;`
    ScenarioInvariant = SCENARIO_INVARIANT,
    /// `expect failure [by check | by invariant NAME | by inconsistent update | by error];` after `load`.
    ScenarioExpect = SCENARIO_EXPECT,
    /// `[strict] check term;`
    CheckCommand = CHECK_COMMAND,
    /// `set location := term;`
    SetCommand = SET_COMMAND,
    /// `step [N]`
    StepCommand = STEP_COMMAND,
    /// `step until term [within N];`
    StepUntilCommand = STEP_UNTIL_COMMAND,
    /// `exec rule;`
    ExecCommand = EXEC_COMMAND,
    /// `pick $x [in r_R] := term;`
    PickCommand = PICK_COMMAND,
    /// `begin NAME … end`
    Block = BLOCK,
    /// `execblock [FILE:]NAME;`
    ExecBlockCommand = EXECBLOCK_COMMAND,
    /// `expect inconsistent update;` or `expect error;` as a command: one step that must end so.
    ExpectStepCommand = EXPECT_STEP_COMMAND,
    /// A single term.
    TermFile = TERM_FILE,
}

choice! {
    /// One element of a scenario or block.
    Command {
        Check(CheckCommand), Set(SetCommand), Step(StepCommand), StepUntil(StepUntilCommand), Exec(ExecCommand),
        Pick(PickCommand), Block(Block), ExecBlock(ExecBlockCommand), ExpectStep(ExpectStepCommand),
    }
}

impl ScenarioFile {
    /// The scenario's name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The path after `load`, bare ([`MODULE_REF`]) or in quotes ([`STRING`]).
    pub fn model_token(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).find(|token| matches!(token.kind(), MODULE_REF | STRING))
    }
    /// The path after `load` as text, without quotes.
    pub fn model_path(&self) -> Option<String> {
        self.model_token().map(|token| token.text().trim_matches('"').to_string())
    }
    /// How the whole scenario is expected to fail.
    pub fn expectation(&self) -> Option<ScenarioExpect> {
        child(self.syntax())
    }
    /// The scenario's own invariants.
    pub fn invariants(&self) -> Children<ScenarioInvariant> {
        children(self.syntax())
    }
    /// The commands in order.
    pub fn commands(&self) -> Children<Command> {
        children(self.syntax())
    }
}

impl ScenarioInvariant {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The formula.
    pub fn term(&self) -> Option<Term> {
        child(self.syntax())
    }
}

/// The words of an `expect`: the expected kind of failure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Expected {
    /// Any failure.
    Failure,
    /// A failed check.
    Check,
    /// A violated invariant.
    Invariant,
    /// An inconsistent update.
    InconsistentUpdate,
    /// A run-time error.
    Error,
}

fn expected(node: &crate::SyntaxNode) -> Expected {
    // The name of an invariant is not one of the words.
    let has = |word: &str| tokens(node).any(|token| token.kind() != GENERIC_ID && token.text() == word);
    if has("inconsistent") {
        Expected::InconsistentUpdate
    } else if has("error") {
        Expected::Error
    } else if has("check") {
        Expected::Check
    } else if has("invariant") {
        Expected::Invariant
    } else {
        Expected::Failure
    }
}

impl ScenarioExpect {
    /// The expected failure.
    pub fn expected(&self) -> Expected {
        expected(self.syntax())
    }
    /// The invariant named.
    pub fn invariant(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
}

impl ExpectStepCommand {
    /// The expected failure: [`Expected::InconsistentUpdate`] or [`Expected::Error`].
    pub fn expected(&self) -> Expected {
        expected(self.syntax())
    }
}

impl CheckCommand {
    /// `strict` stands before it.
    pub fn is_strict(&self) -> bool {
        token(self.syntax(), STRICT_KW).is_some()
    }
    /// The formula.
    pub fn term(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl SetCommand {
    /// The location.
    pub fn target(&self) -> Option<Term> {
        nth(self.syntax(), 0)
    }
    /// The value.
    pub fn value(&self) -> Option<Term> {
        nth(self.syntax(), 1)
    }
}

impl StepCommand {
    /// How many steps, if said.
    pub fn count(&self) -> Option<SyntaxToken> {
        token(self.syntax(), INTEGER)
    }
}

impl StepUntilCommand {
    /// The condition.
    pub fn term(&self) -> Option<Term> {
        child(self.syntax())
    }
    /// The bound after `within`.
    pub fn bound(&self) -> Option<SyntaxToken> {
        token(self.syntax(), INTEGER)
    }
}

impl ExecCommand {
    /// The rule.
    pub fn rule(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

impl PickCommand {
    /// `$x`
    pub fn variable(&self) -> Option<SyntaxToken> {
        token(self.syntax(), VARIABLE)
    }
    /// The rule whose choose is meant.
    pub fn rule(&self) -> Option<SyntaxToken> {
        token(self.syntax(), RULE_ID)
    }
    /// The domains in parentheses that pick an overload of the rule.
    pub fn domains(&self) -> Children<super::Domain> {
        children(self.syntax())
    }
    /// The value picked.
    pub fn value(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl Block {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The commands in order.
    pub fn commands(&self) -> Children<Command> {
        children(self.syntax())
    }
}

impl ExecBlockCommand {
    /// The scenario file's name before the colon.
    pub fn file(&self) -> Option<SyntaxToken> {
        token(self.syntax(), COLON).and_then(|_| token(self.syntax(), GENERIC_ID))
    }
    /// The block's name.
    pub fn block(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).filter(|token| token.kind() == GENERIC_ID).last()
    }
}

impl TermFile {
    /// The term.
    pub fn term(&self) -> Option<Term> {
        child(self.syntax())
    }
}
