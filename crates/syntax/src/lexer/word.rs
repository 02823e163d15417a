//! The class of a word: a keyword, or one of the identifier classes (spec/language.md, 1.1 and 1.2).
//!
//! In: a word of letters, digits and underscores. Out: its kind. A word that belongs to no class (it starts with an
//! underscore) is a [`GENERIC_ID`]. Keywords of Avalla are ordinary names here: the parser knows where they are meant.

use crate::SyntaxKind::{self, *};

/// The kind of a word.
pub(crate) fn classify(word: &str) -> SyntaxKind {
    keyword(word).unwrap_or_else(|| class(word))
}

fn keyword(word: &str) -> Option<SyntaxKind> {
    Some(match word {
        "asm" => ASM_KW,
        "module" => MODULE_KW,
        "asyncr" => ASYNCR_KW,
        "import" => IMPORT_KW,
        "export" => EXPORT_KW,
        "signature" => SIGNATURE_KW,
        "init" => INIT_KW,
        "default" => DEFAULT_KW,
        "agent" => AGENT_KW,
        "invariant" => INVARIANT_KW,
        "over" => OVER_KW,
        "definitions" => DEFINITIONS_KW,
        "CTLSPEC" | "ctlspec" => CTLSPEC_KW,
        "LTLSPEC" | "ltlspec" => LTLSPEC_KW,
        "JUSTICE" | "justice" => JUSTICE_KW,
        "FAIRNESS" | "fairness" => FAIRNESS_KW,
        "COMPASSION" | "compassion" => COMPASSION_KW,
        "INVAR" | "invar" => INVAR_KW,
        "function" => FUNCTION_KW,
        "static" => STATIC_KW,
        "dynamic" => DYNAMIC_KW,
        "derived" => DERIVED_KW,
        "monitored" => MONITORED_KW,
        "controlled" => CONTROLLED_KW,
        "shared" => SHARED_KW,
        "out" => OUT_KW,
        "local" => LOCAL_KW,
        "domain" => DOMAIN_KW,
        "anydomain" => ANYDOMAIN_KW,
        "basic" => BASIC_KW,
        "abstract" => ABSTRACT_KW,
        "enum" => ENUM_KW,
        "subsetof" => SUBSETOF_KW,
        "Prod" => PROD_KW,
        "Seq" => SEQ_DOMAIN_KW,
        "Powerset" => POWERSET_KW,
        "Bag" => BAG_KW,
        "Map" => MAP_KW,
        "Rule" => RULE_DOMAIN_KW,
        "true" => TRUE_KW,
        "false" => FALSE_KW,
        "undef" => UNDEF_KW,
        "if" => IF_KW,
        "then" => THEN_KW,
        "else" => ELSE_KW,
        "elseif" => ELSEIF_KW,
        "endif" => ENDIF_KW,
        "switch" => SWITCH_KW,
        "case" => CASE_KW,
        "otherwise" => OTHERWISE_KW,
        "endswitch" => ENDSWITCH_KW,
        "let" => LET_KW,
        "endlet" => ENDLET_KW,
        "in" => IN_KW,
        "exists" | "exist" => EXISTS_KW,
        "unique" => UNIQUE_KW,
        "with" => WITH_KW,
        "forall" => FORALL_KW,
        "skip" => SKIP_KW,
        "rule" => RULE_KW,
        "macro" => MACRO_KW,
        "turbo" => TURBO_KW,
        "main" => MAIN_KW,
        "par" => PAR_KW,
        "endpar" => ENDPAR_KW,
        "choose" => CHOOSE_KW,
        "do" => DO_KW,
        "ifnone" => IFNONE_KW,
        "extend" => EXTEND_KW,
        "seq" => SEQ_KW,
        "endseq" => ENDSEQ_KW,
        "iterate" => ITERATE_KW,
        "enditerate" => ENDITERATE_KW,
        "while" => WHILE_KW,
        "whilerec" => WHILEREC_KW,
        _ => return None,
    })
}

fn class(word: &str) -> SyntaxKind {
    let long = |prefix: &str| word.len() > prefix.len() && word.starts_with(prefix);
    let capital = |byte: &u8| byte.is_ascii_uppercase();
    let bytes = word.as_bytes();
    match bytes[0] {
        b'_' => GENERIC_ID,
        first if !first.is_ascii_uppercase() => match () {
            () if long("r_") => RULE_ID,
            () if long("inv_") => INVARIANT_ID,
            () if long("ctlSpec_") => CTL_ID,
            () if long("ltlSpec_") => LTL_ID,
            () => FUNCTION_ID,
        },
        _ if bytes.get(1).is_some_and(capital) && !bytes.iter().any(u8::is_ascii_lowercase) => ENUM_ID,
        _ => DOMAIN_ID,
    }
}
