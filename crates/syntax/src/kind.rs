//! The kinds of tokens and nodes of the lossless tree.
//!
//! One enum serves AsmetaL, Avalla and charts. Keywords are tokens of their own; `and or xor not mod implies iff` are
//! ordinary [`SyntaxKind::FUNCTION_ID`] tokens, because they may be called as functions (spec/language.md, 1.1).

#![allow(non_camel_case_types, missing_docs, reason = "rowan's convention: kinds are written as in the grammar")]

/// The language tag that rowan's generic tree is instantiated with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum AsmetaL {}

impl rowan::Language for AsmetaL {
    type Kind = SyntaxKind;

    fn kind_from_raw(raw: rowan::SyntaxKind) -> SyntaxKind {
        SyntaxKind::ALL[raw.0 as usize]
    }

    fn kind_to_raw(kind: SyntaxKind) -> rowan::SyntaxKind {
        rowan::SyntaxKind(kind as u16)
    }
}

macro_rules! kinds {
    ($($kind:ident $(= $text:literal)?),* $(,)?) => {
        /// The kind of a token or node.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u16)]
        pub enum SyntaxKind { $($kind),* }

        impl SyntaxKind {
            /// Every kind, by its number.
            pub const ALL: &'static [SyntaxKind] = &[$(SyntaxKind::$kind),*];

            /// The fixed text of a keyword or a mark.
            pub fn text(self) -> Option<&'static str> {
                match self {
                    $($(SyntaxKind::$kind => Some($text),)?)*
                    _ => None,
                }
            }
        }
    };
}

kinds! {
    // Trivia and trouble
    WHITESPACE, LINE_COMMENT, BLOCK_COMMENT,
    ERROR, // as token: text that is no token; as node: tokens that fit nowhere
    EOF,

    // Names and literals
    VARIABLE, // $x
    ENUM_ID, DOMAIN_ID, RULE_ID, INVARIANT_ID, CTL_ID, LTL_ID, FUNCTION_ID,
    GENERIC_ID, // after asm, module, init: any shape
    MODULE_REF, // after import; a path after load
    INTEGER, NATURAL, REAL, COMPLEX, CHAR, STRING,

    // Marks
    L_PAREN = "(", R_PAREN = ")", L_BRACKET = "[", R_BRACKET = "]", L_BRACE = "{", R_BRACE = "}",
    COMMA = ",", COLON = ":", SEMICOLON = ";", DOT = ".", BAR = "|",
    ASSIGN = ":=", ARROW = "->", RETURN_ARROW = "<-",
    EQ = "=", NEQ = "!=", LT = "<", LE = "<=", GT = ">", GE = ">=",
    PLUS = "+", MINUS = "-", STAR = "*", SLASH = "/", CARET = "^",

    // Keywords of AsmetaL
    ASM_KW = "asm", MODULE_KW = "module", ASYNCR_KW = "asyncr", IMPORT_KW = "import", EXPORT_KW = "export",
    SIGNATURE_KW = "signature", INIT_KW = "init", DEFAULT_KW = "default", AGENT_KW = "agent",
    INVARIANT_KW = "invariant", OVER_KW = "over", DEFINITIONS_KW = "definitions",
    CTLSPEC_KW = "CTLSPEC", LTLSPEC_KW = "LTLSPEC", JUSTICE_KW = "JUSTICE", FAIRNESS_KW = "FAIRNESS",
    COMPASSION_KW = "COMPASSION", INVAR_KW = "INVAR",
    FUNCTION_KW = "function", STATIC_KW = "static", DYNAMIC_KW = "dynamic", DERIVED_KW = "derived",
    MONITORED_KW = "monitored", CONTROLLED_KW = "controlled", SHARED_KW = "shared", OUT_KW = "out", LOCAL_KW = "local",
    DOMAIN_KW = "domain", ANYDOMAIN_KW = "anydomain", BASIC_KW = "basic", ABSTRACT_KW = "abstract", ENUM_KW = "enum",
    SUBSETOF_KW = "subsetof", PROD_KW = "Prod", SEQ_DOMAIN_KW = "Seq", POWERSET_KW = "Powerset", BAG_KW = "Bag",
    MAP_KW = "Map", RULE_DOMAIN_KW = "Rule",
    TRUE_KW = "true", FALSE_KW = "false", UNDEF_KW = "undef",
    IF_KW = "if", THEN_KW = "then", ELSE_KW = "else", ELSEIF_KW = "elseif", ENDIF_KW = "endif",
    SWITCH_KW = "switch", CASE_KW = "case", OTHERWISE_KW = "otherwise", ENDSWITCH_KW = "endswitch",
    LET_KW = "let", ENDLET_KW = "endlet", IN_KW = "in", NOTIN_KW = "notin",
    EXISTS_KW = "exists", // also `exist`
    UNIQUE_KW = "unique", WITH_KW = "with", FORALL_KW = "forall",
    SKIP_KW = "skip", RULE_KW = "rule", MACRO_KW = "macro", TURBO_KW = "turbo", MAIN_KW = "main",
    PAR_KW = "par", ENDPAR_KW = "endpar", CHOOSE_KW = "choose", DO_KW = "do", IFNONE_KW = "ifnone",
    EXTEND_KW = "extend", SEQ_KW = "seq", ENDSEQ_KW = "endseq", ITERATE_KW = "iterate", ENDITERATE_KW = "enditerate",
    WHILE_KW = "while", WHILEREC_KW = "whilerec",

    // Keywords of Avalla (only there; `check`, `set` … are ordinary names in AsmetaL)
    SCENARIO_KW = "scenario", LOAD_KW = "load", CHECK_KW = "check", STRICT_KW = "strict", SET_KW = "set", STEP_KW = "step",
    UNTIL_KW = "until", WITHIN_KW = "within", EXEC_KW = "exec", PICK_KW = "pick", BEGIN_KW = "begin", END_KW = "end",
    EXECBLOCK_KW = "execblock", EXPECT_KW = "expect",

    // Keywords of charts (only there)
    CHART_KW = "chart", MACHINE_KW = "machine", ENDMACHINE_KW = "endmachine", PATTERN_KW = "pattern",
    ENDPATTERN_KW = "endpattern", CONTROL_KW = "control", INITIAL_KW = "initial", STATE_KW = "state", GUARD_KW = "guard",
    ACTION_KW = "action", INSTANCE_KW = "instance", OF_KW = "of", TO_KW = "to", REFINE_KW = "refine", BY_KW = "by",
    ENTER_KW = "enter", EXIT_KW = "exit", YES_KW = "yes", NO_KW = "no", SEQUENCE_KW = "sequence", LAYOUT_KW = "layout",
    ENDLAYOUT_KW = "endlayout", AT_KW = "at", COMPOSITE_KW = "composite", ENDSTATE_KW = "endstate",
    HISTORY_KW = "history", ENTRY_KW = "entry", ABORT_KW = "abort",
    SYSTEM_KW = "system", ENDSYSTEM_KW = "endsystem", TICK_KW = "tick", COMPONENT_KW = "component",
    ENDCOMPONENT_KW = "endcomponent", SYNCHRONOUS_KW = "synchronous", ASYNCHRONOUS_KW = "asynchronous",
    PERIOD_KW = "period", OFFSET_KW = "offset", DEADLINE_KW = "deadline", AWAITS_KW = "awaits", READ_KW = "read",
    ELABORATE_KW = "elaborate", WRITE_KW = "write", AS_KW = "as", CHANNEL_KW = "channel", FROM_KW = "from",
    SWINGING_KW = "swinging", BUFFER_KW = "buffer", QUEUE_KW = "queue", VALUE_KW = "value", MASTER_KW = "master",
    SENSOR_KW = "sensor", ACTUATOR_KW = "actuator", PROCESSORS_KW = "processors", MISSES_KW = "misses", JITTER_KW = "jitter", EVERY_KW = "every",
    FRESH_KW = "fresh", ALL_KW = "all", ANY_KW = "any",

    // Nodes: the file
    SOURCE_FILE, MACHINE_NAME, IMPORT, IMPORT_SELECTION, NAME_REF, EXPORT, SIGNATURE, DEFINITIONS,

    // Nodes: domains
    ANY_DOMAIN_DECL, BASIC_DOMAIN_DECL, ABSTRACT_DOMAIN_DECL, ENUM_DOMAIN_DECL, ENUM_LITERAL_DECL, CONCRETE_DOMAIN_DECL,
    STRUCTURED_DOMAIN_DECL, NAMED_DOMAIN, STRUCTURED_DOMAIN,

    // Nodes: functions, definitions, rules, properties, initial states
    FUNCTION_DECL, DOMAIN_DEF, FUNCTION_DEF, PARAMETER_LIST, PARAMETER, RULE_DECL, INVAR, JUSTICE, COMPASSION, INVARIANT,
    OVER_LIST, OVER_ITEM, CTL_SPEC, LTL_SPEC, MAIN_RULE, INIT, AGENT_INIT,

    // Nodes: terms
    LITERAL_TERM, ENUM_TERM, VARIABLE_TERM, FUNCTION_TERM, ARGUMENT_LIST, DOMAIN_TERM, UNARY_TERM, BINARY_TERM,
    PAREN_TERM, TUPLE_TERM, QUANTIFIED_TERM, BINDER, IF_TERM, CONDITIONAL_BRANCH, SWITCH_TERM, CASE_BRANCH, LET_TERM, BINDING,
    COLLECTION_TERM, RANGE_TERM, MAP_TERM, MAP_ENTRY, COMPREHENSION_TERM, RULE_TERM,

    // Nodes: rules
    SKIP_RULE, UPDATE_RULE, MACRO_CALL_RULE, TURBO_CALL_RULE, RETURN_RULE, TERM_RULE, PAR_RULE, IF_RULE, CHOOSE_RULE,
    FORALL_RULE, LET_RULE, EXTEND_RULE, SEQ_RULE, ITERATE_RULE, WHILE_RULE, RECURSIVE_WHILE_RULE, SWITCH_RULE, LOCAL_RULE,
    LOCAL_DECL,

    // Nodes: scenarios
    SCENARIO_FILE, SCENARIO_INVARIANT, SCENARIO_EXPECT, CHECK_COMMAND, SET_COMMAND, STEP_COMMAND, STEP_UNTIL_COMMAND,
    EXEC_COMMAND, PICK_COMMAND, BLOCK, EXECBLOCK_COMMAND, EXPECT_STEP_COMMAND,

    // Node: a single term (`--until TERM`)
    TERM_FILE,

    // Nodes: charts
    CHART_FILE, MACHINE_CHART, CONTROL_VARIABLE, CONTROL_STATE, COMPOSITE_STATE,
    HISTORY, ENTRY_ACTION, EXIT_ACTION, ABORT_ACTION, GUARD_SHAPE, ACTION_SHAPE, PATTERN_INSTANCE, LINK,
    REFINEMENT, CHART_PATH, PATH_STOP, SEQUENCE, LAYOUT, PLACEMENT, COORDINATE,
    SYSTEM_CHART, TICK, PROCESSORS, COMPONENT, COMPONENT_KIND, PHASE, CHANNEL, CHANNEL_KIND, DEVICE, AGE_BOUND, CONNECTION,
    QUANTITY, TOLERANCE, FRESH_BOUND, AWAITS,
}

impl SyntaxKind {
    /// White space or a comment.
    pub fn is_trivia(self) -> bool {
        matches!(self, SyntaxKind::WHITESPACE | SyntaxKind::LINE_COMMENT | SyntaxKind::BLOCK_COMMENT)
    }
}
