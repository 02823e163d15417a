//! Sets of tokens by which the grammar finds its way: what starts, ends and divides constructs.
//!
//! They serve recovery as well: where a text is faulty, tokens are skipped up to one of a set. INVARIANT: a token in
//! `FENCES` never occurs within a rule or a term, so a faulty one cannot swallow the next definition.

use crate::SyntaxKind::*;
use crate::token_set::TokenSet;

/// Tokens that a term can start with.
#[rustfmt::skip]
pub(super) const TERM_STARTS: TokenSet = TokenSet::new(&[
    INTEGER, NATURAL, REAL, COMPLEX, CHAR, STRING, TRUE_KW, FALSE_KW, UNDEF_KW, ENUM_ID, VARIABLE, FUNCTION_ID,
    DOMAIN_ID, PROD_KW, SEQ_DOMAIN_KW, POWERSET_KW, BAG_KW, MAP_KW, RULE_DOMAIN_KW, L_PAREN, L_BRACE, L_BRACKET, LT,
    PLUS, MINUS, IF_KW, SWITCH_KW, LET_KW,
]);

/// Tokens that a domain can start with.
#[rustfmt::skip]
pub(super) const DOMAIN_STARTS: TokenSet = TokenSet::new(&[
    DOMAIN_ID, ENUM_ID, PROD_KW, SEQ_DOMAIN_KW, POWERSET_KW, BAG_KW, MAP_KW, RULE_DOMAIN_KW,
]);

/// Words that a section of a file starts with.
#[rustfmt::skip]
pub(super) const SECTION_STARTS: TokenSet = TokenSet::new(&[
    IMPORT_KW, EXPORT_KW, SIGNATURE_KW, DEFINITIONS_KW, MAIN_KW, DEFAULT_KW, INIT_KW, ASM_KW, MODULE_KW, ASYNCR_KW,
    EOF,
]);
/// Words that a definition starts with.
#[rustfmt::skip]
pub(super) const DEFINITION_STARTS: TokenSet = TokenSet::new(&[
    DOMAIN_KW, FUNCTION_KW, RULE_KW, MACRO_KW, TURBO_KW, INVAR_KW, JUSTICE_KW, FAIRNESS_KW, COMPASSION_KW,
    INVARIANT_KW, CTLSPEC_KW, LTLSPEC_KW,
]);
/// Words that a declaration of the signature starts with.
#[rustfmt::skip]
pub(super) const DECLARATION_STARTS: TokenSet = TokenSet::new(&[
    ANYDOMAIN_KW, BASIC_KW, ABSTRACT_KW, ENUM_KW, DYNAMIC_KW, STATIC_KW, DERIVED_KW, MONITORED_KW, CONTROLLED_KW,
    SHARED_KW, OUT_KW, DOMAIN_KW,
]);
/// Words that no rule and no term holds: a faulty one ends there at the latest.
pub(super) const FENCES: TokenSet =
    SECTION_STARTS.union(DEFINITION_STARTS).union(DECLARATION_STARTS).union(TokenSet::new(&[AGENT_KW]));

/// Tokens that a rule starts with.
#[rustfmt::skip]
pub(super) const RULE_STARTS: TokenSet = TokenSet::new(&[
    SKIP_KW, PAR_KW, SEQ_KW, ITERATE_KW, IF_KW, SWITCH_KW, LET_KW, CHOOSE_KW, FORALL_KW, EXTEND_KW, WHILE_KW,
    WHILEREC_KW, LOCAL_KW, RULE_ID, FUNCTION_ID, VARIABLE,
]);
/// Keywords that only a rule starts with.
#[rustfmt::skip]
pub(super) const RULE_WORDS: TokenSet = TokenSet::new(&[
    SKIP_KW, PAR_KW, SEQ_KW, ITERATE_KW, CHOOSE_KW, FORALL_KW, EXTEND_KW, WHILE_KW, WHILEREC_KW,
]);
/// Words that end a construct.
pub(super) const BLOCK_ENDS: TokenSet =
    TokenSet::new(&[ENDPAR_KW, ENDSEQ_KW, ENDITERATE_KW, ENDIF_KW, ENDSWITCH_KW, ENDLET_KW]);
/// Brackets that end a construct; `>` does so only after a bag.
pub(super) const BRACKET_ENDS: TokenSet = TokenSet::new(&[R_PAREN, R_BRACKET, R_BRACE]);
/// Both.
pub(super) const ENDS: TokenSet = BLOCK_ENDS.union(BRACKET_ENDS);
/// Tokens that open a construct with an end.
pub(super) const OPENERS: TokenSet =
    TokenSet::new(&[PAR_KW, SEQ_KW, ITERATE_KW, IF_KW, SWITCH_KW, LET_KW, L_PAREN, L_BRACKET, L_BRACE]);
/// Words between the parts of a construct.
pub(super) const MIDDLES: TokenSet =
    TokenSet::new(&[THEN_KW, ELSE_KW, ELSEIF_KW, CASE_KW, OTHERWISE_KW, DO_KW, IFNONE_KW, IN_KW, WITH_KW]);
/// Tokens that are skipped where a term is missing; all others may belong to what is around.
#[rustfmt::skip]
pub(super) const TERM_JUNK: TokenSet = TokenSet::new(&[
    STAR, SLASH, CARET, EQ, NEQ, GE, LE, GT, DOT, ERROR, ASSIGN,
    FUNCTION_ID,
]);
