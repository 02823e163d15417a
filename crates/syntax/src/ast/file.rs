//! Views of the file, its sections, domains, functions, definitions, properties and initial states
//! (spec/language.md, sections 2–5).

use super::{AstNode, Children, Rule, Term, child, children, choice, nodes, nth, token, tokens};
use crate::{SyntaxKind, SyntaxKind::*, SyntaxToken};

nodes! {
    /// `[asyncr] (asm|module) NAME imports export signature definitions main init`
    SourceFile = SOURCE_FILE,
    /// `NAME` after `asm` or `module`, with the word before it.
    MachineName = MACHINE_NAME,
    /// `import PATH (a, B, r_c)`
    Import = IMPORT,
    /// `(a, B, r_c)` of an import.
    ImportSelection = IMPORT_SELECTION,
    /// A bare name of a domain, function or rule, in import and export lists.
    NameRef = NAME_REF,
    /// `export *` or `export a, B, r_c`
    Export = EXPORT,
    /// `signature: …`
    Signature = SIGNATURE,
    /// `definitions: …`
    Definitions = DEFINITIONS,
    /// `anydomain D`
    AnyDomainDecl = ANY_DOMAIN_DECL,
    /// `basic domain Integer`
    BasicDomainDecl = BASIC_DOMAIN_DECL,
    /// `[dynamic] abstract domain D`
    AbstractDomainDecl = ABSTRACT_DOMAIN_DECL,
    /// `enum domain D = {AA | BB}`
    EnumDomainDecl = ENUM_DOMAIN_DECL,
    /// `AA` in an enum domain.
    EnumLiteralDecl = ENUM_LITERAL_DECL,
    /// `[dynamic] domain D subsetof E`
    ConcreteDomainDecl = CONCRETE_DOMAIN_DECL,
    /// A structured domain as a declaration of its own.
    StructuredDomainDecl = STRUCTURED_DOMAIN_DECL,
    /// `D`
    NamedDomain = NAMED_DOMAIN,
    /// `Prod(D,E)`, `Seq(D)`, `Powerset(D)`, `Bag(D)`, `Map(D,E)`, `Rule`, `Rule(D)`
    StructuredDomain = STRUCTURED_DOMAIN,
    /// `[dynamic] controlled f: D -> C`
    FunctionDecl = FUNCTION_DECL,
    /// `domain D = term`, in definitions and in init sections.
    DomainDef = DOMAIN_DEF,
    /// `function f($x in D) = term`, in definitions and in init sections.
    FunctionDef = FUNCTION_DEF,
    /// `($x in D, $y in E)`
    ParameterList = PARAMETER_LIST,
    /// `$x in D`
    Parameter = PARAMETER,
    /// `[macro|turbo] rule r_x($p in D) [in C] = rule`
    RuleDecl = RULE_DECL,
    /// `INVAR term`
    Invar = INVAR,
    /// `JUSTICE term`
    Justice = JUSTICE,
    /// `COMPASSION (p, q)`
    Compassion = COMPASSION,
    /// `invariant [inv_x] over a, B: term`
    Invariant = INVARIANT,
    /// `a, f(D), r_x` of an invariant.
    OverList = OVER_LIST,
    /// One item of an over list.
    OverItem = OVER_ITEM,
    /// `CTLSPEC [ctlSpec_x:] term`
    CtlSpec = CTL_SPEC,
    /// `LTLSPEC [ltlSpec_x:] term`
    LtlSpec = LTL_SPEC,
    /// `main rule r_Main = rule`; holds one [`RuleDecl`].
    MainRule = MAIN_RULE,
    /// `[default] init NAME: …`
    Init = INIT,
    /// `agent D: r_x[]`
    AgentInit = AGENT_INIT,
}

choice! {
    /// A domain as written where a domain is expected.
    Domain { Named(NamedDomain), Structured(StructuredDomain) }
}

choice! {
    /// A declaration of a domain.
    DomainDecl {
        Any(AnyDomainDecl), Basic(BasicDomainDecl), Abstract(AbstractDomainDecl), Enum(EnumDomainDecl),
        Concrete(ConcreteDomainDecl), Structured(StructuredDomainDecl),
    }
}

choice! {
    /// A property or assumption of the definitions section.
    Property {
        Invar(Invar), Justice(Justice), Compassion(Compassion), Invariant(Invariant), Ctl(CtlSpec), Ltl(LtlSpec),
    }
}

impl SourceFile {
    /// `asyncr` stands before `asm`.
    pub fn is_asynchronous(&self) -> bool {
        token(self.syntax(), ASYNCR_KW).is_some()
    }
    /// `asm NAME` or `module NAME`; a file of comments alone has none.
    pub fn machine_name(&self) -> Option<MachineName> {
        child(self.syntax())
    }
    /// All imports in order.
    pub fn imports(&self) -> Children<Import> {
        children(self.syntax())
    }
    /// The export clause.
    pub fn export(&self) -> Option<Export> {
        child(self.syntax())
    }
    /// The signature.
    pub fn signature(&self) -> Option<Signature> {
        child(self.syntax())
    }
    /// The definitions.
    pub fn definitions(&self) -> Option<Definitions> {
        child(self.syntax())
    }
    /// The main rule.
    pub fn main_rule(&self) -> Option<MainRule> {
        child(self.syntax())
    }
    /// All initial states.
    pub fn inits(&self) -> Children<Init> {
        children(self.syntax())
    }
}

impl MachineName {
    /// `asm` or `module`.
    pub fn is_module(&self) -> bool {
        token(self.syntax(), MODULE_KW).is_some()
    }
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
}

impl Import {
    /// The path token: bare ([`MODULE_REF`]) or in quotes ([`STRING`]).
    pub fn path_token(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).find(|token| matches!(token.kind(), MODULE_REF | STRING))
    }
    /// The path as text, without quotes.
    pub fn path(&self) -> Option<String> {
        self.path_token().map(|token| token.text().trim_matches('"').to_string())
    }
    /// The selection; none means everything exported.
    pub fn selection(&self) -> Option<ImportSelection> {
        child(self.syntax())
    }
}

impl ImportSelection {
    /// The names selected.
    pub fn names(&self) -> Children<NameRef> {
        children(self.syntax())
    }
}

impl NameRef {
    /// The name.
    pub fn token(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).next()
    }
}

impl Export {
    /// `export *`
    pub fn is_all(&self) -> bool {
        token(self.syntax(), STAR).is_some()
    }
    /// The names exported.
    pub fn names(&self) -> Children<NameRef> {
        children(self.syntax())
    }
}

impl Signature {
    /// Domain declarations in order.
    pub fn domains(&self) -> Children<DomainDecl> {
        children(self.syntax())
    }
    /// Function declarations in order.
    pub fn functions(&self) -> Children<FunctionDecl> {
        children(self.syntax())
    }
}

impl Definitions {
    /// `domain D = term`
    pub fn domain_defs(&self) -> Children<DomainDef> {
        children(self.syntax())
    }
    /// `function f(…) = term`
    pub fn function_defs(&self) -> Children<FunctionDef> {
        children(self.syntax())
    }
    /// Rule declarations in order.
    pub fn rules(&self) -> Children<RuleDecl> {
        children(self.syntax())
    }
    /// Invariants, temporal properties, assumptions, in order.
    pub fn properties(&self) -> Children<Property> {
        children(self.syntax())
    }
}

impl DomainDecl {
    /// The name declared (a structured domain has none).
    pub fn name(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).find(|token| matches!(token.kind(), DOMAIN_ID | ENUM_ID))
    }
    /// `dynamic` stands before it.
    pub fn is_dynamic(&self) -> bool {
        token(self.syntax(), DYNAMIC_KW).is_some()
    }
}

impl EnumDomainDecl {
    /// The literals in order.
    pub fn literals(&self) -> Children<EnumLiteralDecl> {
        children(self.syntax())
    }
}

impl EnumLiteralDecl {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).next()
    }
}

impl ConcreteDomainDecl {
    /// The domain after `subsetof`.
    pub fn base(&self) -> Option<Domain> {
        child(self.syntax())
    }
}

impl StructuredDomainDecl {
    /// The domain.
    pub fn domain(&self) -> Option<Domain> {
        child(self.syntax())
    }
}

impl NamedDomain {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).next()
    }
}

impl StructuredDomain {
    /// [`PROD_KW`], [`SEQ_DOMAIN_KW`], [`POWERSET_KW`], [`BAG_KW`], [`MAP_KW`] or [`RULE_DOMAIN_KW`].
    pub fn constructor(&self) -> Option<SyntaxKind> {
        tokens(self.syntax()).next().map(|token| token.kind())
    }
    /// The domains in the parentheses.
    pub fn arguments(&self) -> Children<Domain> {
        children(self.syntax())
    }
}

impl FunctionDecl {
    /// [`STATIC_KW`], [`DERIVED_KW`], [`MONITORED_KW`], [`CONTROLLED_KW`], [`SHARED_KW`] or [`OUT_KW`].
    pub fn kind(&self) -> Option<SyntaxKind> {
        tokens(self.syntax())
            .map(|token| token.kind())
            .find(|kind| matches!(kind, STATIC_KW | DERIVED_KW | MONITORED_KW | CONTROLLED_KW | SHARED_KW | OUT_KW))
    }
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
}

impl DomainDef {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).find(|token| matches!(token.kind(), DOMAIN_ID | ENUM_ID))
    }
    /// The contents.
    pub fn body(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl FunctionDef {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), FUNCTION_ID)
    }
    /// The parameters; none for a function without arguments.
    pub fn parameters(&self) -> Option<ParameterList> {
        child(self.syntax())
    }
    /// The defining term.
    pub fn body(&self) -> Option<Term> {
        child(self.syntax())
    }
}

impl ParameterList {
    /// The parameters in order.
    pub fn parameters(&self) -> Children<Parameter> {
        children(self.syntax())
    }
}

impl Parameter {
    /// `$x`
    pub fn variable(&self) -> Option<SyntaxToken> {
        token(self.syntax(), VARIABLE)
    }
    /// The domain.
    pub fn domain(&self) -> Option<Domain> {
        child(self.syntax())
    }
}

impl RuleDecl {
    /// `turbo` stands before it.
    pub fn is_turbo(&self) -> bool {
        token(self.syntax(), TURBO_KW).is_some()
    }
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), RULE_ID)
    }
    /// The parameters.
    pub fn parameters(&self) -> Option<ParameterList> {
        child(self.syntax())
    }
    /// The domain of the result, of a turbo rule.
    pub fn result(&self) -> Option<Domain> {
        child(self.syntax())
    }
    /// The body.
    pub fn body(&self) -> Option<Rule> {
        child(self.syntax())
    }
}

macro_rules! one_term {
    ($($view:ident),*) => {$(
        impl $view {
            /// The formula.
            pub fn term(&self) -> Option<Term> {
                child(self.syntax())
            }
        }
    )*};
}
one_term!(Invar, Justice, Invariant, CtlSpec, LtlSpec);

impl Compassion {
    /// `p`
    pub fn premise(&self) -> Option<Term> {
        nth(self.syntax(), 0)
    }
    /// `q`
    pub fn conclusion(&self) -> Option<Term> {
        nth(self.syntax(), 1)
    }
}

impl Property {
    /// The name, if one is given.
    pub fn name(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).find(|token| matches!(token.kind(), INVARIANT_ID | CTL_ID | LTL_ID))
    }
}

impl Invariant {
    /// The `over` list.
    pub fn over(&self) -> Option<OverList> {
        child(self.syntax())
    }
}

impl OverList {
    /// The items in order.
    pub fn items(&self) -> Children<OverItem> {
        children(self.syntax())
    }
}

impl OverItem {
    /// The name of a domain, function or rule.
    pub fn name(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).next()
    }
    /// The domain that picks an overloaded function.
    pub fn domain(&self) -> Option<Domain> {
        child(self.syntax())
    }
}

impl MainRule {
    /// The rule.
    pub fn rule(&self) -> Option<RuleDecl> {
        child(self.syntax())
    }
}

impl Init {
    /// `default` stands before it.
    pub fn is_default(&self) -> bool {
        token(self.syntax(), DEFAULT_KW).is_some()
    }
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// Contents of dynamic domains.
    pub fn domain_defs(&self) -> Children<DomainDef> {
        children(self.syntax())
    }
    /// Initial values.
    pub fn function_defs(&self) -> Children<FunctionDef> {
        children(self.syntax())
    }
    /// Programs of agents.
    pub fn agents(&self) -> Children<AgentInit> {
        children(self.syntax())
    }
}

impl AgentInit {
    /// The domain of the agents.
    pub fn domain(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).find(|token| matches!(token.kind(), DOMAIN_ID | ENUM_ID))
    }
    /// The program, a macro call.
    pub fn program(&self) -> Option<Rule> {
        child(self.syntax())
    }
}
