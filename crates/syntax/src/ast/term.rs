//! Views of terms (spec/language.md, section 6).

use super::{AstNode, Children, Domain, child, children, choice, nodes, nth, token, tokens};
use crate::{SyntaxKind, SyntaxKind::*, SyntaxToken};

nodes! {
    /// A number, character, string, truth value or `undef`.
    LiteralTerm = LITERAL_TERM,
    /// An enum literal.
    EnumTerm = ENUM_TERM,
    /// `$x`
    VariableTerm = VARIABLE_TERM,
    /// `f`, `f(a,b)`, `self.f(a)`
    FunctionTerm = FUNCTION_TERM,
    /// `(a, b)` after a function's name, `[a, b]` or `(a, b)` after a rule's.
    ArgumentList = ARGUMENT_LIST,
    /// A domain as the set of its elements.
    DomainTerm = DOMAIN_TERM,
    /// `-a`, `+a`, `not a`
    UnaryTerm = UNARY_TERM,
    /// `a + b`, `a and b`, `a in b` …
    BinaryTerm = BINARY_TERM,
    /// `(a)`
    ParenTerm = PAREN_TERM,
    /// `(a, b)` with at least two components.
    TupleTerm = TUPLE_TERM,
    /// `(forall $x in D with c)`, `(exists …)`, `(exists unique …)`
    QuantifiedTerm = QUANTIFIED_TERM,
    /// `$x in D`
    Binder = BINDER,
    /// `if g then a elseif h then b else c endif`
    IfTerm = IF_TERM,
    /// `g then a` of an if term or rule: the first, and one for each `elseif`.
    ConditionalBranch = CONDITIONAL_BRANCH,
    /// `switch t case a: b otherwise c endswitch`
    SwitchTerm = SWITCH_TERM,
    /// `case a: b` of a switch term or rule.
    CaseBranch = CASE_BRANCH,
    /// `let ($x = a, $y = b) in t endlet`
    LetTerm = LET_TERM,
    /// `$x = a`
    Binding = BINDING,
    /// `{a, b}`, `[a, b]`, `<a, b>`
    CollectionTerm = COLLECTION_TERM,
    /// `{lo : hi, step}` in any of the three brackets.
    RangeTerm = RANGE_TERM,
    /// `{a -> b, c -> d}`, `{->}`
    MapTerm = MAP_TERM,
    /// `a -> b`
    MapEntry = MAP_ENTRY,
    /// `{$x in D | c : t}` in any of the three brackets; with `t -> u` the body is a [`MapEntry`].
    ComprehensionTerm = COMPREHENSION_TERM,
    /// `<<r_x(D)>>`
    RuleTerm = RULE_TERM,
}

choice! {
    /// A term.
    Term {
        Literal(LiteralTerm), Enum(EnumTerm), Variable(VariableTerm), Function(FunctionTerm), Domain(DomainTerm),
        Unary(UnaryTerm), Binary(BinaryTerm), Paren(ParenTerm), Tuple(TupleTerm), Quantified(QuantifiedTerm),
        If(IfTerm), Switch(SwitchTerm), Let(LetTerm), Collection(CollectionTerm), Range(RangeTerm), Map(MapTerm),
        Comprehension(ComprehensionTerm), Rule(RuleTerm),
    }
}

/// Which of the three brackets encloses a collection.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Bracket {
    /// `{ }`: a set.
    Set,
    /// `[ ]`: a sequence.
    Seq,
    /// `< >`: a bag.
    Bag,
}

fn bracket(node: &crate::SyntaxNode) -> Bracket {
    match tokens(node).next().map(|token| token.kind()) {
        Some(L_BRACKET) => Bracket::Seq,
        Some(LT) => Bracket::Bag,
        _ => Bracket::Set,
    }
}

impl LiteralTerm {
    /// The token: [`INTEGER`], [`NATURAL`], [`REAL`], [`COMPLEX`], [`CHAR`], [`STRING`], [`TRUE_KW`], [`FALSE_KW`]
    /// or [`UNDEF_KW`].
    pub fn token(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).next()
    }
}

impl EnumTerm {
    /// The literal's name.
    pub fn token(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).next()
    }
}

impl VariableTerm {
    /// `$x`
    pub fn token(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).next()
    }
}

impl FunctionTerm {
    /// The name before the dot of `self.f`.
    pub fn agent(&self) -> Option<SyntaxToken> {
        token(self.syntax(), DOT).and_then(|_| token(self.syntax(), FUNCTION_ID))
    }
    /// The function's name.
    pub fn name(&self) -> Option<SyntaxToken> {
        let behind_dot = usize::from(token(self.syntax(), DOT).is_some());
        tokens(self.syntax()).filter(|token| token.kind() == FUNCTION_ID).nth(behind_dot)
    }
    /// The arguments, if there are parentheses.
    pub fn arguments(&self) -> Option<ArgumentList> {
        child(self.syntax())
    }
}

impl ArgumentList {
    /// The arguments in order.
    pub fn terms(&self) -> Children<Term> {
        children(self.syntax())
    }
}

impl DomainTerm {
    /// The domain.
    pub fn domain(&self) -> Option<Domain> {
        child(self.syntax())
    }
}

impl UnaryTerm {
    /// [`PLUS`], [`MINUS`] or the name `not` ([`FUNCTION_ID`]).
    pub fn operator(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).next()
    }
    /// The operand.
    pub fn operand(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl BinaryTerm {
    /// A mark, [`IN_KW`], [`NOTIN_KW`] or one of the names `and or xor implies iff mod` ([`FUNCTION_ID`]).
    pub fn operator(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).next()
    }
    /// The left operand.
    pub fn left(&self) -> Option<Term> {
        nth(self.syntax(), 0)
    }
    /// The right operand.
    pub fn right(&self) -> Option<Term> {
        nth(self.syntax(), 1)
    }
}

impl ParenTerm {
    /// The term inside.
    pub fn term(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl TupleTerm {
    /// The components.
    pub fn components(&self) -> Children<Term> {
        children(self.syntax())
    }
}

impl QuantifiedTerm {
    /// [`FORALL_KW`] or [`EXISTS_KW`].
    pub fn quantifier(&self) -> Option<SyntaxKind> {
        tokens(self.syntax()).map(|token| token.kind()).find(|kind| matches!(kind, FORALL_KW | EXISTS_KW))
    }
    /// `exists unique`
    pub fn is_unique(&self) -> bool {
        token(self.syntax(), UNIQUE_KW).is_some()
    }
    /// `$x in D, $y in E`
    pub fn binders(&self) -> Children<Binder> {
        children(self.syntax())
    }
    /// The term after `with`.
    pub fn condition(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl Binder {
    /// `$x`
    pub fn variable(&self) -> Option<SyntaxToken> {
        token(self.syntax(), VARIABLE)
    }
    /// The range: a domain or a collection.
    pub fn range_term(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl IfTerm {
    /// `if`, then each `elseif`.
    pub fn branches(&self) -> Children<ConditionalBranch> {
        children(self.syntax())
    }
    /// The term after `else`.
    pub fn otherwise(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl ConditionalBranch {
    /// The guard.
    pub fn guard(&self) -> Option<Term> {
        nth(self.syntax(), 0)
    }
    /// The term after `then`, in an if term.
    pub fn term(&self) -> Option<Term> {
        nth(self.syntax(), 1)
    }
    /// The rule after `then`, in an if rule.
    pub fn rule(&self) -> Option<super::Rule> {
        child(self.syntax())
    }
}

impl SwitchTerm {
    /// The term compared.
    pub fn subject(&self) -> Option<Term> {
        nth(self.syntax(), 0)
    }
    /// The cases in order.
    pub fn cases(&self) -> Children<CaseBranch> {
        children(self.syntax())
    }
    /// The term after `otherwise`.
    pub fn otherwise(&self) -> Option<Term> {
        nth(self.syntax(), 1)
    }
}

impl CaseBranch {
    /// The value compared with.
    pub fn value(&self) -> Option<Term> {
        nth(self.syntax(), 0)
    }
    /// The term after the colon, in a switch term.
    pub fn term(&self) -> Option<Term> {
        nth(self.syntax(), 1)
    }
    /// The rule after the colon, in a switch rule.
    pub fn rule(&self) -> Option<super::Rule> {
        child(self.syntax())
    }
}

impl LetTerm {
    /// The bindings in order; a later one may use an earlier one.
    pub fn bindings(&self) -> Children<Binding> {
        children(self.syntax())
    }
    /// The term after `in`.
    pub fn body(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl Binding {
    /// `$x`
    pub fn variable(&self) -> Option<SyntaxToken> {
        token(self.syntax(), VARIABLE)
    }
    /// The term bound.
    pub fn term(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl CollectionTerm {
    /// Set, sequence or bag.
    pub fn bracket(&self) -> Bracket {
        bracket(self.syntax())
    }
    /// The elements in order.
    pub fn elements(&self) -> Children<Term> {
        children(self.syntax())
    }
}

impl RangeTerm {
    /// Set, sequence or bag.
    pub fn bracket(&self) -> Bracket {
        bracket(self.syntax())
    }
    /// The lower bound.
    pub fn low(&self) -> Option<Term> {
        nth(self.syntax(), 0)
    }
    /// The upper bound, included.
    pub fn high(&self) -> Option<Term> {
        nth(self.syntax(), 1)
    }
    /// The step.
    pub fn step(&self) -> Option<Term> {
        nth(self.syntax(), 2)
    }
}

impl MapTerm {
    /// The entries in order.
    pub fn entries(&self) -> Children<MapEntry> {
        children(self.syntax())
    }
}

impl MapEntry {
    /// The key.
    pub fn key(&self) -> Option<Term> {
        nth(self.syntax(), 0)
    }
    /// The value.
    pub fn value(&self) -> Option<Term> {
        nth(self.syntax(), 1)
    }
}

impl ComprehensionTerm {
    /// Set, sequence or bag (a map comprehension stands in set brackets).
    pub fn bracket(&self) -> Bracket {
        bracket(self.syntax())
    }
    /// `$x in D, $y in E`
    pub fn binders(&self) -> Children<Binder> {
        children(self.syntax())
    }
    /// The term between `|` and `:`.
    pub fn condition(&self) -> Option<Term> {
        let bar = tokens(self.syntax()).find(|token| matches!(token.kind(), BAR | COLON))?;
        (bar.kind() == BAR).then(|| nth(self.syntax(), 0)).flatten()
    }
    /// The term after `:`; absent in a map comprehension, see [`ComprehensionTerm::entry`].
    pub fn body(&self) -> Option<Term> {
        nth(self.syntax(), usize::from(self.condition().is_some()))
    }
    /// The entry after `:` of a map comprehension.
    pub fn entry(&self) -> Option<MapEntry> {
        child(self.syntax())
    }
}

impl RuleTerm {
    /// The rule's name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), RULE_ID)
    }
    /// The parameter domains that pick an overload.
    pub fn domains(&self) -> Children<Domain> {
        children(self.syntax())
    }
}
