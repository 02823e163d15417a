/**
 * The grammar of AsmetaL, Avalla and charts for tree-sitter: what Helix, Zed and Neovim colour and fold by.
 *
 * In: a text of one of the three languages; its first word tells which. Out: a tree with the names of the constructs
 * as crates/syntax has them. It reads what `groundstate check` accepts; faults are found there alone.
 * `tree-sitter generate --abi 14` writes src/ from this file; tests/ holds both to the examples and to the lexer's words.
 *
 * All names are one token, `name`: their classes (rule, domain, literal, function) are told by spelling, which queries can do,
 * and a token for each class would make the parser four times as large. A name that is spelled like a keyword is a name wherever
 * the keyword cannot stand. `identifier` is a name that has no class: of a machine, a scenario, a state of a chart.
 */

const POWER = { implies: 1, or: 2, and: 3, relation: 4, not: 5, sum: 6, product: 7, power: 8, sign: 9 };

const OPERATORS = [
  [POWER.implies, ["implies", "iff"]],
  [POWER.or, ["or", "xor"]],
  [POWER.and, ["and"]],
  [POWER.relation, ["=", "!=", "<", "<=", ">=", "in", "notin"]],
  [POWER.sum, ["+", "-"]],
  [POWER.product, ["*", "/", "mod"]],
  [POWER.power, ["^"]],
];

/** Operations on terms of this rule. `>` is one except in a bag, which it ends. */
function operations($, term, more) {
  const operators = OPERATORS.concat(more);
  return operators.map(([power, words]) =>
    prec.left(
      power,
      seq(field("left", term), field("operator", words.length > 1 ? choice(...words) : words[0]), field("right", term)),
    ),
  );
}

const several = (item, separator = ",") => seq(item, repeat(seq(separator, item)));
const list = (open, items, close) => seq(open, optional(items), close);

/** `if`, `switch` and `let` with branches that are terms or rules: if_SUFFIX and so on, and the parts of each. */
const conditionals = (suffix, body) => ({
  [`if_${suffix}`]: ($) =>
    seq(
      "if",
      field("condition", $._term),
      "then",
      field("consequence", body($)),
      repeat($[`_${suffix}_elseif`]),
      optional($[`_${suffix}_else`]),
      "endif",
    ),
  [`_${suffix}_elseif`]: ($) =>
    seq("elseif", field("condition", $._term), "then", field("consequence", body($))),
  [`_${suffix}_else`]: ($) => seq("else", field("alternative", body($))),
  [`switch_${suffix}`]: ($) => 
    seq(
      "switch",
      field("value", $._term),
      repeat1(alias($[`_${suffix}_case`], $.case)),
      optional($[`_${suffix}_otherwise`]),
      "endswitch",
    ),
  [`_${suffix}_case`]: ($) => seq("case", field("value", $._term), ":", field("consequence", body($))),
  [`_${suffix}_otherwise`]: ($) => seq("otherwise", field("alternative", body($))),
  [`let_${suffix}`]: ($) => seq("let", "(", $._bindings, ")", "in", field("body", body($)), "endlet"),
});

// Words that start an item of a chart, and may be the name of a shape all the same: `state -> done`.
const MACHINE_WORDS = ["to", "initial", "composite", "state", "guard", "action", "instance", "sequence", "history", "entry", "abort", "control"];
const SYSTEM_WORDS = ["tick", "processors", "component", "channel", "sensor", "actuator", "within"];

module.exports = grammar({
  name: "asmetal",

  extras: ($) => [/[\s\uFEFF]/, $.line_comment, $.block_comment],

  word: ($) => $.name,

  // `to` behind a shape begins `to refine`, or a path from a shape of that name.
  conflicts: ($) => [[$._term_shape], [$._rule_shape]],

  supertypes: ($) => [$._rule, $._term, $._domain],

  inline: ($) => [$._declaration, $._definition],

  rules: {
    source_file: ($) => optional(choice($._machine, $._scenario, $._chart)),

    // The file

    _machine: ($) => seq(optional("asyncr"), $.machine_name, repeat($._section)),
    machine_name: ($) => seq(choice("asm", "module"), field("name", $._identifier)),
    _section: ($) => choice($.import, $.export, $.signature, $.definitions, $.main_rule, $.initial_state),

    import: ($) => seq("import", field("path", choice($.path, $.string)), optional($.import_selection)),
    import_selection: ($) => seq("(", several($.name), ")"),
    export: ($) => seq("export", choice("*", several($.name))),

    signature: ($) => seq("signature", ":", repeat($._declaration)),
    definitions: ($) => seq("definitions", ":", repeat($._definition)),

    // Domains

    _declaration: ($) =>
      choice(
        $.any_domain_declaration,
        $.basic_domain_declaration,
        $.abstract_domain_declaration,
        $.enum_domain_declaration,
        $.concrete_domain_declaration,
        $.structured_domain,
        $.function_declaration,
      ),
    any_domain_declaration: ($) => seq(optional("dynamic"), "anydomain", field("name", $.name)),
    basic_domain_declaration: ($) => seq(optional("dynamic"), "basic", "domain", field("name", $.name)),
    abstract_domain_declaration: ($) => seq(optional("dynamic"), "abstract", "domain", field("name", $.name)),
    enum_domain_declaration: ($) =>
      seq(
        optional("dynamic"),
        "enum",
        "domain",
        field("name", $.name),
        "=",
        "{",
        several($.name, choice("|", ",")),
        "}",
      ),
    concrete_domain_declaration: ($) =>
      seq(optional("dynamic"), "domain", field("name", $.name), "subsetof", $._domain),

    _domain: ($) => choice($.name, $.structured_domain),
    structured_domain: ($) =>
      choice(
        seq($._constructor, "(", optional($._domains), ")"),
        "Rule",
      ),

    _constructor: (_) => choice("Prod", "Seq", "Powerset", "Bag", "Map", "Rule"),

    // Functions

    function_declaration: ($) =>
      seq(
        optional("dynamic"),
        field("kind", choice("static", "derived", "monitored", "controlled", "shared", "out")),
        $._typed_name,
      ),
    _typed_name: ($) =>
      seq(
        field("name", $.name),
        ":",
        field("domain", $._domain),
        optional(seq("->", field("codomain", $._domain))),
      ),

    // Definitions

    _definition: ($) =>
      choice(
        $.domain_definition,
        $.function_definition,
        $.rule_declaration,
        $.invar,
        $.justice,
        $.compassion,
        $.invariant,
        $.ctl_specification,
        $.ltl_specification,
      ),
    domain_definition: ($) => seq("domain", field("name", $.name), "=", $._term),
    function_definition: ($) =>
      seq("function", field("name", $.name), optional($.parameter_list), "=", field("body", $._term)),
    parameter_list: ($) => list("(", several($.parameter), ")"),
    parameter: ($) => seq(field("name", $.variable), "in", $._domain),
    rule_declaration: ($) =>
      seq(
        optional($._rule_kind),
        "rule",
        field("name", $.name),
        optional($.parameter_list),
        optional($._codomain),
        "=",
        field("body", $._rule),
      ),
    _rule_kind: (_) => choice("macro", "turbo"),
    _codomain: ($) => seq("in", field("codomain", $._domain)),
    main_rule: ($) => seq("main", $.rule_declaration),
    initial_state: ($) =>
      seq(
        optional("default"),
        "init",
        field("name", $._identifier),
        ":",
        repeat(choice($.domain_definition, $.function_definition, $.agent_initialization)),
      ),
    agent_initialization: ($) => seq("agent", field("domain", $.name), ":", $._call),

    // Properties

    invar: ($) => seq(choice("INVAR", "invar"), $._term),
    justice: ($) => seq(choice("JUSTICE", "justice", "FAIRNESS", "fairness"), $._term),
    compassion: ($) =>
      prec.right(seq(choice("COMPASSION", "compassion"), "(", $._term, ",", $._term, optional(")"))),
    invariant: ($) =>
      seq("invariant", optional(field("name", $._identifier)), "over", several($._over), ":", $._term),
    _over: ($) =>
      choice(
        $.name,
        seq($.name, "(", optional($._domain), ")"),
      ),
    ctl_specification: ($) =>
      seq(choice("CTLSPEC", "ctlspec"), optional(seq(field("name", $._identifier), ":")), $._term),
    ltl_specification: ($) =>
      seq(choice("LTLSPEC", "ltlspec"), optional(seq(field("name", $._identifier), ":")), $._term),

    // Rules

    _rule: ($) =>
      choice(
        $.skip_rule,
        $.update_rule,
        $.return_rule,
        $.term_rule,
        $.macro_call,
        $.par_rule,
        $.seq_rule,
        $.iterate_rule,
        $.if_rule,
        $.switch_rule,
        $.let_rule,
        $.choose_rule,
        $.forall_rule,
        $.extend_rule,
        $.while_rule,
        $.whilerec_rule,
        $.local_rule,
      ),
    skip_rule: (_) => "skip",
    _location: ($) => choice($.variable, $.function_term),
    update_rule: ($) => seq(field("location", $._location), ":=", field("value", $._term)),
    return_rule: ($) => seq(field("location", $._location), "<-", $.turbo_call),
    term_rule: ($) => seq($._location, optional(alias($._bracketed, $.argument_list))),
    _bracketed: ($) => list("[", $._terms, "]"),
    _call: ($) => choice($.macro_call, $.turbo_call),
    macro_call: ($) => prec(1, seq(field("name", $.name), alias($._bracketed, $.argument_list))),
    turbo_call: ($) => seq(field("name", $.name), alias($._parenthesised, $.argument_list)),
    _parenthesised: ($) => list("(", $._terms, ")"),
    par_rule: ($) => seq("par", repeat1($._rule), "endpar"),
    seq_rule: ($) => seq("seq", repeat1($._rule), "endseq"),
    iterate_rule: ($) => seq("iterate", field("body", $._rule), "enditerate"),
    ...conditionals("rule", ($) => $._rule),
    choose_rule: ($) =>
      prec.right(
        seq(
          "choose",
          $._binders,
          optional($._with),
          "do",
          field("body", $._rule),
          optional($._ifnone),
        ),
      ),
    _ifnone: ($) => seq("ifnone", field("alternative", $._rule)),
    forall_rule: ($) =>
      seq("forall", $._binders, optional($._with), "do", field("body", $._rule)),
    extend_rule: ($) =>
      seq("extend", field("domain", $.name), "with", $._variables, "do", field("body", $._rule)),
    while_rule: ($) => seq("while", field("condition", $._term), "do", field("body", $._rule)),
    whilerec_rule: ($) => seq("whilerec", field("condition", $._term), "do", field("body", $._rule)),
    local_rule: ($) => seq($.local_declaration, field("body", $._rule)),
    local_declaration: ($) => seq(optional("dynamic"), "local", $._typed_name, "[", $._rule, "]"),

    // Parts that several constructs share, each a rule of its own: written out, every combination would be states of the parser.
    _binders: ($) => several($.binder),
    _bindings: ($) => several($.binding),
    _with: ($) => seq("with", field("condition", $._term)),
    _terms: ($) => several($._term),
    _domains: ($) => several($._domain),
    _variables: ($) => several($.variable),

    binder: ($) => prec(POWER.relation + 1, seq(field("name", $.variable), "in", field("range", $._term))),
    binding: ($) => seq(field("name", $.variable), "=", field("value", $._term)),

    // Terms

    _term: ($) => choice($._operand, $.unary_term, $.binary_term),
    unary_term: ($) => choice(...unary($, $._term)),
    binary_term: ($) => choice(...operations($, $._term, [[POWER.relation, [">"]]])),

    _bag_element: ($) =>
      choice($._operand, alias($._bag_unary, $.unary_term), alias($._bag_binary, $.binary_term)),
    _bag_unary: ($) => choice(...unary($, $._bag_element)),
    _bag_binary: ($) => choice(...operations($, $._bag_element, [])),

    _operand: ($) =>
      choice(
        $.number,
        $.character,
        $.string,
        $.boolean,
        $.undef,
        $.variable,
        $.function_term,
        $.structured_domain,
        $.parenthesised_term,
        $.tuple,
        $.quantified_term,
        $.if_term,
        $.switch_term,
        $.let_term,
        $.collection,
        $.range,
        $.map,
        $.comprehension,
        $.rule_term,
      ),
    boolean: (_) => choice("true", "false"),
    undef: (_) => "undef",
    function_term: ($) =>
      prec.right(
        seq(
          choice(seq(field("agent", $.name), ".", field("name", $.name)), field("name", $.name)),
          optional(alias($._parenthesised, $.argument_list)),
        ),
      ),
    parenthesised_term: ($) => seq("(", $._term, ")"),
    tuple: ($) => seq("(", $._term, repeat1(seq(",", $._term)), ")"),
    quantified_term: ($) =>
      seq(
        "(",
        $._quantifier,
        $._binders,
        optional($._with),
        ")",
      ),
    _quantifier: (_) => choice("forall", seq(choice("exists", "exist"), optional("unique"))),
    ...conditionals("term", ($) => $._term),
    rule_term: ($) => seq("<", "<", alias($._rule_name, $.name), optional(list("(", $._domains, ")")), ">", ">"),

    collection: ($) => choice(list("{", $._terms, "}"), list("[", $._terms, "]"), list("<", $._bag_elements, ">")),
    range: ($) =>
      choice(
        seq("{", $._bounds, "}"),
        seq("[", $._bounds, "]"),
        seq("<", $._bag_bounds, ">"),
      ),
    _bounds: ($) => seq($._term, ":", $._term, optional(seq(",", $._term))),
    _bag_bounds: ($) => seq($._bag_element, ":", $._bag_element, optional(seq(",", $._bag_element))),
    _bag_elements: ($) => several($._bag_element),
    map: ($) => seq("{", choice("->", several($.map_entry)), "}"),
    map_entry: ($) => seq(field("key", $._term), "->", field("value", $._term)),
    comprehension: ($) =>
      choice(
        seq("{", $._comprised, ":", choice($._term, seq($.map_entry, optional("|"))), "}"),
        seq("[", $._comprised, ":", $._term, "]"),
        seq("<", $._bag_comprised, ":", $._bag_element, ">"),
      ),
    _such_that: ($) => seq("|", field("condition", $._term)),
    _comprised: ($) => seq($._binders, optional($._such_that)),
    _bag_comprised: ($) => seq($._bag_binders, optional($._such_that)),
    _bag_binders: ($) => several(alias($._bag_binder, $.binder)),
    _bag_binder: ($) => prec(POWER.relation + 1, seq(field("name", $.variable), "in", field("range", $._bag_element))),

    // Scenarios

    _scenario: ($) => seq($.scenario_head, repeat($._command)),
    scenario_head: ($) =>
      seq(
        "scenario",
        field("name", alias($.dotted_name, $.identifier)),
        "load",
        field("path", choice($.path, $.string)),
        optional(";"),
      ),
    _command: ($) =>
      choice(
        $.scenario_invariant,
        $.check_command,
        $.set_command,
        $.step_command,
        $.step_until_command,
        $.exec_command,
        $.pick_command,
        $.block,
        $.execblock_command,
        $.expect_command,
      ),
    scenario_invariant: ($) => seq("invariant", field("name", $._identifier), ":", $._term, ";"),
    check_command: ($) => seq(optional("strict"), "check", $._term, ";"),
    set_command: ($) => seq("set", field("location", $._location), ":=", field("value", $._term), ";"),
    step_command: ($) => seq("step", optional($.integer), optional(";")),
    step_until_command: ($) => seq("step", "until", $._term, optional(seq("within", $.integer)), ";"),
    exec_command: ($) => seq("exec", $._rule, ";"),
    pick_command: ($) =>
      seq(
        "pick",
        $.variable,
        optional(seq("in", $.name, optional(list("(", $._domains, ")")))),
        ":=",
        $._term,
        ";",
      ),
    block: ($) => seq("begin", field("name", $._identifier), repeat($._command), "end", optional(";")),
    execblock_command: ($) => seq("execblock", $._identifier, optional(seq(":", $._identifier)), ";"),
    expect_command: ($) =>
      seq(
        "expect",
        choice(
          seq("failure", optional(seq("by", choice("check", seq("invariant", optional($._identifier)), $._trouble)))),
          $._trouble,
        ),
        ";",
      ),
    _trouble: (_) => choice(seq("inconsistent", "update"), "error"),

    // Charts

    _chart: ($) => seq($.chart_head, repeat($._chart_section)),
    chart_head: ($) => seq("chart", field("name", $._identifier)),
    _chart_section: ($) =>
      choice(alias($.chart_import, $.import), $.machine, $.pattern, $.system, $.layout),
    chart_import: ($) => seq("import", field("path", choice($.path, $.string))),
    machine: ($) => seq("machine", $._machine_body, "endmachine"),
    pattern: ($) => seq("pattern", $._machine_body, "endpattern"),
    _machine_body: ($) =>
      seq(
        field("name", $._identifier),
        optional($.parameter_list),
        optional($.string),
        optional(alias($._name_link, $.link)),
        repeat($._item),
      ),
    _item: ($) =>
      choice(
        $.control_variable,
        $.control_state,
        $.composite_state,
        $.history,
        $.entry_action,
        $.exit_action,
        $.abort_action,
        $.guard,
        $.action,
        $.instance,
        $.sequence,
        $.chart_path,
      ),
    control_variable: ($) => seq("control", choice(field("name", $._identifier), alias($._term_link, $.link))),
    control_state: ($) => seq(optional("initial"), "state", $._term_shape),
    composite_state: ($) =>
      seq(optional("initial"), "composite", "state", field("name", $._identifier), optional($.string), repeat($._item), "endstate"),
    history: ($) => seq("history", optional(alias($._term_link, $.link))),
    entry_action: ($) => seq("entry", $._rule_shape),
    exit_action: ($) => seq("exit", $._rule_shape),
    abort_action: ($) => seq("abort", $._rule_shape),
    guard: ($) => seq("guard", $._term_shape),
    action: ($) => seq("action", $._rule_shape),
    _term_shape: ($) =>
      seq(field("name", $._identifier), optional($.string), optional(alias($._term_link, $.link)), optional($.refinement)),
    _rule_shape: ($) =>
      seq(field("name", $._identifier), optional($.string), optional(alias($._rule_link, $.link)), optional($.refinement)),
    refinement: ($) => seq("to", "refine", optional(seq("by", $._identifier))),
    instance: ($) =>
      seq(
        "instance",
        field("name", $._identifier),
        "of",
        field("of", $._identifier),
        optional(alias($._parenthesised, $.argument_list)),
        optional($.string),
        optional(alias($._name_link, $.link)),
      ),
    sequence: ($) => seq("sequence", several($._identifier)),
    chart_path: ($) => seq(alias($._first_stop, $.path_stop), repeat1(seq("->", $.path_stop))),
    _first_stop: ($) =>
      choice(
        "enter",
        "exit",
        seq(choice($._identifier, ...MACHINE_WORDS.map((word) => alias(word, $.identifier))), optional(choice("yes", "no"))),
      ),
    path_stop: ($) => choice("enter", seq("exit", optional(choice("yes", "no"))), seq($._identifier, optional(choice("yes", "no")))),
    _term_link: ($) => seq("{", $._term, "}"),
    _rule_link: ($) => seq("{", $._rule, "}"),
    _name_link: ($) => seq("{", $.name, "}"),

    layout: ($) => seq("layout", field("name", $._identifier), repeat($.placement), "endlayout"),
    placement: ($) => seq($._identifier, "at", $.coordinate, ",", $.coordinate),
    coordinate: ($) => seq(optional("-"), $.number),

    system: ($) => seq("system", field("name", $._identifier), optional($.string), repeat($._system_item), "endsystem"),
    _system_item: ($) =>
      choice($.tick, $.processors, $.component, $.channel, $.device, $.age_bound, $.connection),
    tick: ($) => seq("tick", $.quantity),
    processors: ($) => seq("processors", $.number),
    age_bound: ($) => seq("within", $.quantity, "from", $._identifier, "to", $._identifier),
    connection: ($) =>
      seq(choice($._identifier, ...SYSTEM_WORDS.map((word) => alias(word, $.identifier))), "->", $._identifier),
    device: ($) =>
      seq(choice("sensor", "actuator"), field("name", $._identifier), optional(seq(":", $._domain)), optional($.string)),
    component: ($) =>
      seq(
        "component",
        field("name", $._identifier),
        optional($.string),
        $.component_kind,
        repeat($.phase),
        "endcomponent",
      ),
    component_kind: ($) =>
      choice(
        seq("asynchronous", optional($.awaits)),
        seq(
          "synchronous",
          "period",
          $.quantity,
          optional(seq("jitter", $.quantity)),
          optional(seq("offset", $.quantity)),
          optional(seq("deadline", $.quantity)),
          optional($.tolerance),
        ),
      ),
    awaits: ($) => seq("awaits", choice($._identifier, seq(choice("all", "any"), several($._identifier)))),
    phase: ($) =>
      seq(
        choice("read", "elaborate", "write"),
        field("name", $._identifier),
        optional(seq("as", $._identifier)),
        optional($.quantity),
        optional($.fresh_bound),
        optional(seq("by", $._identifier)),
        optional(alias($._rule_link, $.link)),
      ),
    tolerance: ($) => seq("misses", $.number, "of", $.number),
    fresh_bound: ($) => seq("every", $.quantity, "fresh"),
    quantity: ($) => seq($.number, optional(seq(".", ".", $.number)), field("unit", $._identifier)),
    channel: ($) =>
      seq(
        "channel",
        field("name", $._identifier),
        optional(seq(":", $._domain)),
        "from",
        $._identifier,
        "to",
        several($._identifier),
        $.channel_kind,
      ),
    channel_kind: ($) =>
      choice(
        seq("swinging", "buffer", $.number, optional(seq("master", $._identifier))),
        seq("queue", $.number),
        seq("shared", "value"),
      ),

    // Words. Of two that are equally long the first counts, and a keyword before both.

    line_comment: (_) => token(seq("//", /[^\r\n]*/)),
    block_comment: (_) => token(seq("/*", /[^*]*\*+([^/*][^*]*\*+)*/, "/")),
    path: (_) => /([A-Za-z]:[\\/])?(\/?[\p{L}\p{N}\\._+~@#-])+\/?/,
    variable: (_) => /\$[_A-Za-z][_A-Za-z0-9]*/,
    number: ($) => choice($.integer, $.natural, $.real, $.complex),
    integer: (_) => /[0-9]+/,
    natural: (_) => /[0-9]+n/,
    real: (_) => /[0-9]+\.[0-9]+/,
    complex: (_) => /([0-9]+(\.[0-9]+)?)?i([0-9]+(\.[0-9]+)?)?/,
    character: (_) => /'([^'\\\r\n]|\\[^\r\n])*'/,
    string: ($) => seq('"', repeat(choice($.string_content, $.escape)), token.immediate('"')),
    string_content: (_) => token.immediate(prec(1, /[^"\\\r\n]+/)),
    escape: (_) => token.immediate(/\\[^\r\n]/),
    _identifier: ($) => alias($.name, $.identifier),
    // Told apart only where `<<r_a(D)>>` and the bag `<<a(1)>>` begin alike.
    _rule_name: (_) => token(prec(1, /r_[A-Za-z0-9_]+/)),
    name: (_) => /[A-Za-z_][A-Za-z0-9_]*/,
    dotted_name: (_) => /[A-Za-z_][A-Za-z0-9_.]*/,
  },
});

/** `not` and the signs. */
function unary($, term) {
  return [
    prec(POWER.not, seq(field("operator", "not"), field("operand", term))),
    prec(POWER.sign, seq(field("operator", choice("+", "-")), field("operand", term))),
  ];
}
