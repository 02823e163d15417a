//! Views of rules (spec/language.md, section 7).

use super::{
    ArgumentList, AstNode, Binder, Binding, CaseBranch, Children, ConditionalBranch, Domain, Term, child, children,
    choice, nodes, nth, token, tokens,
};
use crate::{SyntaxKind::*, SyntaxToken};

nodes! {
    /// `skip`
    SkipRule = SKIP_RULE,
    /// `f(a) := b`
    UpdateRule = UPDATE_RULE,
    /// `r_x[a, b]`
    MacroCallRule = MACRO_CALL_RULE,
    /// `r_x(a, b)`
    TurboCallRule = TURBO_CALL_RULE,
    /// `f(a) <- r_x(b)`
    ReturnRule = RETURN_RULE,
    /// A term whose value is a rule: `program($a)`, `$r[a, b]`
    TermRule = TERM_RULE,
    /// `par R S endpar`
    ParRule = PAR_RULE,
    /// `if g then R elseif h then S else T endif`
    IfRule = IF_RULE,
    /// `choose $x in D with c do R ifnone S`
    ChooseRule = CHOOSE_RULE,
    /// `forall $x in D with c do R`
    ForallRule = FORALL_RULE,
    /// `let ($x = a) in R endlet`
    LetRule = LET_RULE,
    /// `extend D with $x, $y do R`
    ExtendRule = EXTEND_RULE,
    /// `seq R S endseq`
    SeqRule = SEQ_RULE,
    /// `iterate R enditerate`
    IterateRule = ITERATE_RULE,
    /// `while c do R`
    WhileRule = WHILE_RULE,
    /// `whilerec c do R`
    RecursiveWhileRule = RECURSIVE_WHILE_RULE,
    /// `switch t case a: R otherwise S endswitch`
    SwitchRule = SWITCH_RULE,
    /// `local f: D [ init ] … body`
    LocalRule = LOCAL_RULE,
    /// `[dynamic] local f: D -> C [ init ]`
    LocalDecl = LOCAL_DECL,
}

choice! {
    /// A rule.
    Rule {
        Skip(SkipRule), Update(UpdateRule), MacroCall(MacroCallRule), TurboCall(TurboCallRule), Return(ReturnRule),
        Term(TermRule), Par(ParRule), If(IfRule), Choose(ChooseRule), Forall(ForallRule), Let(LetRule),
        Extend(ExtendRule), Seq(SeqRule), Iterate(IterateRule), While(WhileRule), RecursiveWhile(RecursiveWhileRule),
        Switch(SwitchRule), Local(LocalRule),
    }
}

impl UpdateRule {
    /// The location: a function term or a variable.
    pub fn target(&self) -> Option<Term> {
        nth(self.syntax(), 0)
    }
    /// The new value.
    pub fn value(&self) -> Option<Term> {
        nth(self.syntax(), 1)
    }
}

impl MacroCallRule {
    /// The rule's name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), RULE_ID)
    }
    /// The arguments.
    pub fn arguments(&self) -> Option<ArgumentList> {
        child(self.syntax())
    }
}

impl TurboCallRule {
    /// The rule's name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), RULE_ID)
    }
    /// The arguments.
    pub fn arguments(&self) -> Option<ArgumentList> {
        child(self.syntax())
    }
}

impl ReturnRule {
    /// The location that takes the result.
    pub fn target(&self) -> Option<Term> {
        child(self.syntax())
    }
    /// The call.
    pub fn call(&self) -> Option<TurboCallRule> {
        child(self.syntax())
    }
}

impl TermRule {
    /// The term whose value is a rule.
    pub fn term(&self) -> Option<Term> {
        child(self.syntax())
    }
    /// The arguments in brackets.
    pub fn arguments(&self) -> Option<ArgumentList> {
        child(self.syntax())
    }
}

impl ParRule {
    /// The rules in order.
    pub fn rules(&self) -> Children<Rule> {
        children(self.syntax())
    }
}

impl SeqRule {
    /// The rules in order.
    pub fn rules(&self) -> Children<Rule> {
        children(self.syntax())
    }
}

impl IfRule {
    /// `if`, then each `elseif`.
    pub fn branches(&self) -> Children<ConditionalBranch> {
        children(self.syntax())
    }
    /// The rule after `else`.
    pub fn otherwise(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

impl ChooseRule {
    /// `$x in D, $y in E`
    pub fn binders(&self) -> Children<Binder> {
        children(self.syntax())
    }
    /// The term after `with`.
    pub fn condition(&self) -> Option<Term> {
        child(self.syntax())
    }
    /// The rule after `do`.
    pub fn body(&self) -> Option<Rule> {
        nth(self.syntax(), 0)
    }
    /// The rule after `ifnone`.
    pub fn if_none(&self) -> Option<Rule> {
        nth(self.syntax(), 1)
    }
}

impl ForallRule {
    /// `$x in D, $y in E`
    pub fn binders(&self) -> Children<Binder> {
        children(self.syntax())
    }
    /// The term after `with`.
    pub fn condition(&self) -> Option<Term> {
        child(self.syntax())
    }
    /// The rule after `do`.
    pub fn body(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

impl LetRule {
    /// The bindings in order; a later one may use an earlier one.
    pub fn bindings(&self) -> Children<Binding> {
        children(self.syntax())
    }
    /// The rule after `in`.
    pub fn body(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

impl ExtendRule {
    /// The domain's name.
    pub fn domain(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).find(|token| matches!(token.kind(), DOMAIN_ID | ENUM_ID))
    }
    /// `$x, $y`
    pub fn variables(&self) -> impl Iterator<Item = SyntaxToken> {
        tokens(self.syntax()).filter(|token| token.kind() == VARIABLE)
    }
    /// The rule after `do`.
    pub fn body(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

impl IterateRule {
    /// The rule iterated.
    pub fn body(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

impl WhileRule {
    /// The condition.
    pub fn condition(&self) -> Option<Term> {
        child(self.syntax())
    }
    /// The rule after `do`.
    pub fn body(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

impl RecursiveWhileRule {
    /// The condition.
    pub fn condition(&self) -> Option<Term> {
        child(self.syntax())
    }
    /// The rule after `do`.
    pub fn body(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

impl SwitchRule {
    /// The term compared.
    pub fn subject(&self) -> Option<Term> {
        child(self.syntax())
    }
    /// The cases in order.
    pub fn cases(&self) -> Children<CaseBranch> {
        children(self.syntax())
    }
    /// The rule after `otherwise`.
    pub fn otherwise(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

impl LocalRule {
    /// The local functions in order.
    pub fn declarations(&self) -> Children<LocalDecl> {
        children(self.syntax())
    }
    /// The rule they are local to.
    pub fn body(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

impl LocalDecl {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), FUNCTION_ID)
    }
    /// The domain before `->`.
    pub fn domain(&self) -> Option<Domain> {
        token(self.syntax(), ARROW).and_then(|_| nth(self.syntax(), 0))
    }
    /// The domain after `->`, or the only one.
    pub fn codomain(&self) -> Option<Domain> {
        nth(self.syntax(), usize::from(token(self.syntax(), ARROW).is_some()))
    }
    /// The rule in brackets that initialises it.
    pub fn initialisation(&self) -> Option<Rule> {
        child(self.syntax())
    }
}
