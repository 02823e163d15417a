//! The generated parser reads what `crates/syntax` reads, and divides it alike.
//!
//! A text without a fault has no error in the generated tree, and the constructs of both trees, with their places, are
//! the same: rules, terms with their operators, declarations, commands, shapes. A text with a fault has an error in it as
//! well, or the fault is one of those that the generated parser does not look for.

use std::collections::BTreeMap;

use syntax::Severity;
use syntax::SyntaxKind::{self, *};

use crate::support::{Source, first_error, nodes, sources, tree};

/// Faults of `crates/syntax` in texts that the generated parser takes: it knows no class of a name, no number of parameters, no
/// second section and no depth.
const NOT_LOOKED_FOR: [&str; 8] = [
    "domain-arity",
    "duplicate-section",
    "keyword-as-name",
    "missing-brackets",
    "name-class",
    "nested-too-deeply",
    "rule-in-term",
    "unknown-escape",
];

/// The constructs of both trees: the node of `crates/syntax`, that of the grammar.
const CONSTRUCTS: &[(SyntaxKind, &str)] = &[
    (MACHINE_NAME, "machine_name"),
    (IMPORT, "import"),
    (IMPORT_SELECTION, "import_selection"),
    (EXPORT, "export"),
    (SIGNATURE, "signature"),
    (DEFINITIONS, "definitions"),
    (ANY_DOMAIN_DECL, "any_domain_declaration"),
    (BASIC_DOMAIN_DECL, "basic_domain_declaration"),
    (ABSTRACT_DOMAIN_DECL, "abstract_domain_declaration"),
    (ENUM_DOMAIN_DECL, "enum_domain_declaration"),
    (CONCRETE_DOMAIN_DECL, "concrete_domain_declaration"),
    (FUNCTION_DECL, "function_declaration"),
    (DOMAIN_DEF, "domain_definition"),
    (FUNCTION_DEF, "function_definition"),
    (PARAMETER, "parameter"),
    (RULE_DECL, "rule_declaration"),
    (INVAR, "invar"),
    (JUSTICE, "justice"),
    (COMPASSION, "compassion"),
    (INVARIANT, "invariant"),
    (CTL_SPEC, "ctl_specification"),
    (LTL_SPEC, "ltl_specification"),
    (MAIN_RULE, "main_rule"),
    (INIT, "initial_state"),
    (AGENT_INIT, "agent_initialization"),
    (UNARY_TERM, "unary_term"),
    (BINARY_TERM, "binary_term"),
    (PAREN_TERM, "parenthesised_term"),
    (TUPLE_TERM, "tuple"),
    (QUANTIFIED_TERM, "quantified_term"),
    (BINDER, "binder"),
    (BINDING, "binding"),
    (IF_TERM, "if_term"),
    (SWITCH_TERM, "switch_term"),
    (LET_TERM, "let_term"),
    (CASE_BRANCH, "case"),
    (COLLECTION_TERM, "collection"),
    (RANGE_TERM, "range"),
    (MAP_TERM, "map"),
    (MAP_ENTRY, "map_entry"),
    (COMPREHENSION_TERM, "comprehension"),
    (RULE_TERM, "rule_term"),
    (SKIP_RULE, "skip_rule"),
    (UPDATE_RULE, "update_rule"),
    (RETURN_RULE, "return_rule"),
    (PAR_RULE, "par_rule"),
    (SEQ_RULE, "seq_rule"),
    (ITERATE_RULE, "iterate_rule"),
    (IF_RULE, "if_rule"),
    (SWITCH_RULE, "switch_rule"),
    (LET_RULE, "let_rule"),
    (CHOOSE_RULE, "choose_rule"),
    (FORALL_RULE, "forall_rule"),
    (EXTEND_RULE, "extend_rule"),
    (WHILE_RULE, "while_rule"),
    (RECURSIVE_WHILE_RULE, "whilerec_rule"),
    (LOCAL_DECL, "local_declaration"),
    (SCENARIO_INVARIANT, "scenario_invariant"),
    (CHECK_COMMAND, "check_command"),
    (SET_COMMAND, "set_command"),
    (STEP_COMMAND, "step_command"),
    (STEP_UNTIL_COMMAND, "step_until_command"),
    (EXEC_COMMAND, "exec_command"),
    (PICK_COMMAND, "pick_command"),
    (BLOCK, "block"),
    (EXECBLOCK_COMMAND, "execblock_command"),
    (CONTROL_VARIABLE, "control_variable"),
    (CONTROL_STATE, "control_state"),
    (COMPOSITE_STATE, "composite_state"),
    (HISTORY, "history"),
    (ENTRY_ACTION, "entry_action"),
    (EXIT_ACTION, "exit_action"),
    (ABORT_ACTION, "abort_action"),
    (GUARD_SHAPE, "guard"),
    (ACTION_SHAPE, "action"),
    (PATTERN_INSTANCE, "instance"),
    (LINK, "link"),
    (REFINEMENT, "refinement"),
    (CHART_PATH, "chart_path"),
    (PATH_STOP, "path_stop"),
    (SEQUENCE, "sequence"),
    (LAYOUT, "layout"),
    (PLACEMENT, "placement"),
    (COORDINATE, "coordinate"),
    (SYSTEM_CHART, "system"),
    (TICK, "tick"),
    (PROCESSORS, "processors"),
    (COMPONENT, "component"),
    (COMPONENT_KIND, "component_kind"),
    (PHASE, "phase"),
    (CHANNEL, "channel"),
    (CHANNEL_KIND, "channel_kind"),
    (DEVICE, "device"),
    (AGE_BOUND, "age_bound"),
    (CONNECTION, "connection"),
    (QUANTITY, "quantity"),
    (TOLERANCE, "tolerance"),
    (FRESH_BOUND, "fresh_bound"),
];

/// The constructs of a text: name, first byte, end.
type Constructs = Vec<(&'static str, usize, usize)>;

fn ours(source: &Source) -> Constructs {
    let mut found = Vec::new();
    for node in source.parse().syntax().descendants() {
        let Some((_, name)) = CONSTRUCTS.iter().find(|(kind, _)| *kind == node.kind()) else { continue };
        let tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
        let words: Vec<_> = tokens.filter(|token| !token.kind().is_trivia()).map(|token| token.text_range()).collect();
        if let (Some(first), Some(last)) = (words.first(), words.last()) {
            found.push((*name, first.start().into(), last.end().into()));
        }
    }
    found.sort();
    found
}

fn generated(source: &Source) -> Constructs {
    let tree = tree(&source.text);
    let mut found = Vec::new();
    for node in nodes(&tree).into_iter().filter(|node| node.is_named()) {
        if let Some((_, name)) = CONSTRUCTS.iter().find(|(_, name)| *name == node.kind()) {
            found.push((*name, node.start_byte(), node.end_byte()));
        }
    }
    found.sort();
    found
}

#[test]
fn texts_without_a_fault_have_no_error() {
    let clean: Vec<Source> = sources().into_iter().filter(Source::is_clean).collect();
    assert!(clean.len() > 400, "{} texts", clean.len());
    for source in &clean {
        assert_eq!(first_error(&tree(&source.text)), None, "{}", source.name);
        // As an editor on Windows saves them, and after a mark of the byte order.
        let windows = source.text.replace("\r\n", "\n").replace('\n', "\r\n");
        assert_eq!(first_error(&tree(&windows)), None, "{} with CRLF", source.name);
        assert_eq!(first_error(&tree(&format!("\u{FEFF}{}", source.text))), None, "{} with a BOM", source.name);
    }
}

#[test]
fn both_parsers_divide_a_text_alike() {
    let mut met: BTreeMap<&str, usize> = BTreeMap::new();
    for source in sources().iter().filter(|source| source.is_clean()) {
        let (ours, generated) = (ours(source), generated(source));
        if ours != generated {
            let only = |these: &Constructs, those: &Constructs| {
                let lost = these.iter().filter(|construct| !those.contains(construct));
                lost.take(3)
                    .map(|(name, from, to)| format!("{name} {:?}", &source.text[*from..*to]))
                    .collect::<Vec<_>>()
            };
            let (lost, added) = (only(&ours, &generated), only(&generated, &ours));
            panic!("{}: ours alone {lost:#?}, generated alone {added:#?}", source.name);
        }
        for (name, ..) in ours {
            *met.entry(name).or_default() += 1;
        }
    }
    let never: Vec<_> = CONSTRUCTS.iter().filter(|(_, name)| !met.contains_key(name)).collect();
    assert!(never.is_empty(), "no text of the repository has {never:?}");
}

#[test]
fn texts_with_a_fault_have_an_error() {
    let broken: Vec<Source> = sources().into_iter().filter(|source| !source.is_clean()).collect();
    assert!(broken.len() > 40, "{} texts", broken.len());
    let mut taken = BTreeMap::new();
    for source in broken.iter().filter(|source| first_error(&tree(&source.text)).is_none()) {
        for fault in source.parse().diagnostics.iter().filter(|fault| fault.severity == Severity::Error) {
            taken.insert(fault.id, source.name.clone());
        }
    }
    let ids: Vec<&str> = taken.keys().copied().collect();
    assert_eq!(ids, NOT_LOOKED_FOR, "{taken:#?}");
}
