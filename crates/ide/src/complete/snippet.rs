//! Keywords and whole constructs, by the place where they may stand.
//!
//! Out: [`Item`]s with `${1:…}` where something is to be filled in. Their layout is that of the formatter.

use super::item::{Item, ItemKind};

fn all(rank: u8, table: &[(&str, &str, &str)]) -> Vec<Item> {
    table.iter().map(|(label, detail, insert)| Item::snippet(label, detail, insert, rank)).collect()
}

fn words(rank: u8, words: &[&str]) -> Vec<Item> {
    words.iter().map(|word| Item::new(word, ItemKind::Keyword, "", rank)).collect()
}

/// Before the signature.
pub(super) fn header() -> Vec<Item> {
    let mut items = all(
        0,
        &[
            ("import", "what another file exports", "import ${1:StandardLibrary}"),
            ("signature", "domains and functions", "signature:\n\t$0"),
            ("definitions", "functions, rules, properties", "definitions:\n\t$0"),
            (
                "asm",
                "a model with all its sections",
                "asm ${1:Name}\n\nimport StandardLibrary\n\nsignature:\n\tcontrolled ${2:count}: Integer\n\ndefinitions:\n\tmain rule r_Main =\n\t\t${2:count} := ${2:count} + 1\n\ndefault init s0:\n\tfunction ${2:count} = 0\n",
            ),
        ],
    );
    items.extend(words(1, &["module", "asyncr", "export", "export *"]));
    items
}

/// In the signature.
pub(super) fn declarations() -> Vec<Item> {
    let mut items = all(
        0,
        &[
            ("controlled", "the machine writes it", "controlled ${1:f}: ${2:Integer}"),
            ("monitored", "the environment writes it", "monitored ${1:f}: ${2:Boolean}"),
            ("shared", "both write it", "shared ${1:f}: ${2:Boolean}"),
            ("static", "it never changes", "static ${1:f}: ${2:Integer}"),
            ("derived", "its definition gives its value", "derived ${1:f}: ${2:Boolean}"),
            ("out", "the machine writes it and does not read it", "out ${1:f}: ${2:String}"),
            ("enum domain", "an enumeration", "enum domain ${1:D} = {${2:AA} | ${3:BB}}"),
            ("abstract domain", "elements without structure", "abstract domain ${1:D}"),
            ("dynamic abstract domain", "it may grow", "dynamic abstract domain ${1:D}"),
            ("domain", "a subset of another", "domain ${1:D} subsetof ${2:Integer}"),
            ("dynamic domain", "a subset that is part of the state", "dynamic domain ${1:D} subsetof ${2:Integer}"),
        ],
    );
    items.extend(words(1, &["definitions:", "anydomain", "basic domain"]));
    items
}

/// In the definitions and in initial states.
pub(super) fn definitions() -> Vec<Item> {
    let mut items = all(
        0,
        &[
            ("rule", "a macro rule", "rule r_${1:name} =\n\t${0:skip}"),
            (
                "turbo rule",
                "called by value, with a result",
                "turbo rule r_${1:name}(\\$${2:x} in ${3:Integer}) in ${4:Integer} =\n\tresult := ${0:\\$x}",
            ),
            ("main rule", "what a step does", "main rule r_Main =\n\t${0:skip}"),
            ("function", "a definition, or an initial value", "function ${1:f} = ${0:0}"),
            ("domain", "the contents of a subset", "domain ${1:D} = {${2:0} : ${3:9}}"),
            ("invariant", "holds in every state", "invariant inv_${1:name} over ${2:f}: ${0:true}"),
            ("CTLSPEC", "a temporal property", "CTLSPEC ${0:ag(true)}"),
            ("LTLSPEC", "a temporal property", "LTLSPEC ${0:g(true)}"),
            ("INVAR", "an assumption", "INVAR ${0:true}"),
            ("default init", "the initial state", "default init ${1:s0}:\n\tfunction ${2:f} = ${0:0}"),
        ],
    );
    items.extend(words(1, &["JUSTICE", "COMPASSION", "agent", "init"]));
    items
}

/// Where a rule may begin.
pub(super) fn rules() -> Vec<Item> {
    let mut items = all(
        2,
        &[
            ("par", "all at once", "par\n\t$0\nendpar"),
            ("seq", "one after the other", "seq\n\t$0\nendseq"),
            ("if", "where a condition holds", "if ${1:condition} then\n\t${0:skip}\nendif"),
            ("if else", "one of two", "if ${1:condition} then\n\t${2:skip}\nelse\n\t${0:skip}\nendif"),
            (
                "switch",
                "by the value of a term",
                "switch ${1:term}\n\tcase ${2:value}:\n\t\t${3:skip}\n\totherwise\n\t\t${0:skip}\nendswitch",
            ),
            ("forall", "for all at once", "forall \\$${1:x} in ${2:D} do\n\t${0:skip}"),
            (
                "forall with",
                "for all that satisfy a condition",
                "forall \\$${1:x} in ${2:D} with ${3:true} do\n\t${0:skip}",
            ),
            ("choose", "for one of them", "choose \\$${1:x} in ${2:D} with ${3:true} do\n\t${0:skip}"),
            (
                "choose ifnone",
                "for one, or else",
                "choose \\$${1:x} in ${2:D} with ${3:true} do\n\t${4:skip}\nifnone\n\t${0:skip}",
            ),
            ("let", "a name for a value", "let (\\$${1:x} = ${2:term}) in\n\t${0:skip}\nendlet"),
            ("extend", "a fresh element", "extend ${1:D} with \\$${2:x} do\n\t${0:skip}"),
            ("while", "in sequence, while a condition holds", "while ${1:condition} do\n\t${0:skip}"),
            ("iterate", "in sequence, until nothing changes", "iterate\n\t${0:skip}\nenditerate"),
            ("local", "a function of this rule alone", "local ${1:f}: ${2:Integer} [${3:skip}]\n$0"),
        ],
    );
    items.extend(words(2, &["skip", "endpar", "endseq"]));
    items
}

/// Where a term may begin.
pub(super) fn terms() -> Vec<Item> {
    let mut items = all(
        5,
        &[
            ("if", "a value by a condition", "if ${1:condition} then ${2:a} else ${0:b} endif"),
            ("switch", "a value by another", "switch ${1:term} case ${2:value}: ${3:a} otherwise ${0:b} endswitch"),
            ("let", "a name for a value", "let (\\$${1:x} = ${2:term}) in ${0:\\$x} endlet"),
            ("(forall", "holds for all", "(forall \\$${1:x} in ${2:D} with ${0:true})"),
            ("(exists", "holds for one", "(exists \\$${1:x} in ${2:D} with ${0:true})"),
            ("(exists unique", "holds for exactly one", "(exists unique \\$${1:x} in ${2:D} with ${0:true})"),
            ("{$x in", "a set by a condition", "{\\$${1:x} in ${2:D} | ${3:true} : ${0:\\$x}}"),
        ],
    );
    items.extend(words(5, &["not"]));
    items
}

/// Behind a term.
pub(super) fn operators() -> Vec<Item> {
    words(
        0,
        &[
            "and",
            "or",
            "xor",
            "implies",
            "iff",
            "mod",
            "in",
            "notin",
            "then",
            "else",
            "elseif",
            "do",
            "with",
            "endif",
            "case",
            "otherwise",
            "endswitch",
            "endlet",
            "ifnone",
        ],
    )
}

/// Domains made of others.
pub(super) fn structured_domains() -> Vec<Item> {
    all(
        2,
        &[
            ("Prod", "tuples", "Prod(${1:D}, ${2:E})"),
            ("Seq", "sequences", "Seq(${1:D})"),
            ("Powerset", "sets", "Powerset(${1:D})"),
            ("Bag", "multisets", "Bag(${1:D})"),
            ("Map", "maps", "Map(${1:D}, ${2:E})"),
            ("Rule", "rules as values", "Rule"),
        ],
    )
}

/// Commands of a scenario.
pub(super) fn commands() -> Vec<Item> {
    let mut items = all(
        0,
        &[
            ("set", "an input", "set ${1:f} := ${2:true};"),
            ("step", "one step", "step"),
            ("step until", "until a condition holds", "step until ${1:condition} within ${2:100};"),
            ("check", "what must hold now", "check ${1:condition};"),
            ("exec", "a rule", "exec ${1:rule};"),
            ("pick", "the next choice", "pick \\$${1:x} in ${2:r_rule} := ${3:value};"),
            ("begin", "a block", "begin ${1:name}\n\t$0\nend"),
            ("execblock", "a block again", "execblock ${1:name};"),
            ("scenario", "a scenario with its model", "scenario ${1:name}\n\nload ${2:Model.asm}\n\n$0"),
            ("load", "the model", "load ${1:Model.asm}"),
            ("invariant", "holds after every step", "invariant ${1:name}: ${2:true};"),
            ("expect", "how it is to fail", "expect ${1:failure};"),
        ],
    );
    items.extend(words(1, &["end"]));
    items
}

/// Parts of a chart.
pub(super) fn chart_items() -> Vec<Item> {
    all(
        0,
        &[
            (
                "machine",
                "a control-state machine",
                "machine ${1:name} \"${2:Name}\"\n\tcontrol ${3:mode}\n\tinitial state ${4:idle} \"${5:Idle}\"\n\t$0\nendmachine",
            ),
            ("state", "a control state", "state ${1:name} \"${2:Name}\""),
            (
                "composite state",
                "a state that holds others",
                "composite state ${1:name} \"${2:Name}\"\n\tinitial state ${3:first} \"${4:First}\"\n\t$0\nendstate",
            ),
            ("entry", "done whenever the composite state is entered", "entry ${1:name} \"${2:NAME}\" {${0:skip}}"),
            ("exit", "done whenever the composite state is left", "exit ${1:name} \"${2:NAME}\" {${0:skip}}"),
            ("history", "the composite state is entered where it was left", "history"),
            ("abort", "done when the pattern is left from outside", "abort ${1:name} \"${2:NAME}\" {${0:skip}}"),
            ("guard", "a test", "guard ${1:name} \"${2:Name}\" {${0:true}}"),
            ("action", "an update action", "action ${1:name} \"${2:NAME}\" {${0:skip}}"),
            ("instance", "a pattern at work", "instance ${1:name} of ${2:pattern}"),
            ("pattern", "a pattern machine", "pattern ${1:name} \"${2:Name}\"\n\t$0\nendpattern"),
        ],
    )
}
