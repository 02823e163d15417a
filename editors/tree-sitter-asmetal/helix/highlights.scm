; The patterns of ../queries/highlights.scm, with the names that Helix has for colours.

(line_comment) @comment
(block_comment) @comment

[
  "if" "then" "else" "elseif" "endif"
  "switch" "case" "otherwise" "endswitch"
] @keyword.control.conditional

[
  "par" "endpar" "seq" "endseq" "let" "endlet" "choose" "with" "do" "ifnone" "extend"
  "iterate" "enditerate" "while" "whilerec" "forall" "exists" "exist" "unique"
] @keyword

(skip_rule) @keyword

[
  "check" "strict" "set" "step" "until" "exec" "pick" "begin" "end" "execblock"
  "expect" "failure" "by" "inconsistent" "update" "error"
] @keyword

["in" "notin" "and" "or" "xor" "not" "implies" "iff" "mod"] @keyword.operator

["import" "load"] @keyword.control.import

[
  "static" "dynamic" "derived" "monitored" "controlled" "shared" "out" "local"
  "abstract" "basic" "default" "turbo" "macro" "main" "asyncr" "initial" "composite"
] @keyword.storage.modifier

[
  "asm" "module" "export" "signature" "definitions" "init" "agent" "function" "rule" "domain" "enum" "anydomain"
  "subsetof" "invariant" "over" "scenario"
  "CTLSPEC" "ctlspec" "LTLSPEC" "ltlspec" "INVAR" "invar"
  "JUSTICE" "justice" "FAIRNESS" "fairness" "COMPASSION" "compassion"
] @keyword

[
  "chart" "machine" "endmachine" "pattern" "endpattern" "control" "state" "endstate" "guard" "action" "instance" "of"
  "to" "refine" "enter" "exit" "yes" "no" "sequence" "history" "entry" "abort" "layout" "endlayout" "at"
  "system" "endsystem" "tick" "processors" "component" "endcomponent" "synchronous" "asynchronous" "period" "jitter" "offset"
  "deadline" "awaits" "all" "any" "read" "elaborate" "write" "as" "channel" "from" "swinging" "buffer" "master" "queue" "value"
  "sensor" "actuator" "within" "misses" "every" "fresh"
] @keyword

["Prod" "Seq" "Powerset" "Bag" "Map" "Rule"] @type.builtin

(boolean) @constant.builtin.boolean
(undef) @constant.builtin
(number) @constant.numeric
(step_command (integer) @constant.numeric)
(step_until_command (integer) @constant.numeric)
(character) @constant.character
(string) @string
(escape) @constant.character.escape
(path) @string.special.path

(variable) @variable.parameter

((name) @type (#match? @type "^[A-Z]($|[^A-Z]|[A-Z0-9_]*[a-z])"))
((name) @constant (#match? @constant "^[A-Z][A-Z][A-Z0-9_]*$"))
((name) @function (#match? @function "^r_."))
((name) @variable.other.member (#match? @variable.other.member "^([a-qs-z]|r$|r[^_]|r_$)"))

(machine_name name: (identifier) @namespace)
(scenario_head name: (identifier) @namespace)
(chart_head name: (identifier) @namespace)
(initial_state name: (identifier) @label)
(block name: (identifier) @label)
(execblock_command (identifier) @label)
(invariant name: (identifier) @label)
(ctl_specification name: (identifier) @label)
(ltl_specification name: (identifier) @label)
(scenario_invariant name: (identifier) @label)
(control_variable name: (identifier) @variable.other.member)
(control_state name: (identifier) @constant)
(composite_state name: (identifier) @constant)
(guard name: (identifier) @variable.other.member)
(action name: (identifier) @function)
(entry_action name: (identifier) @function)
(exit_action name: (identifier) @function)
(abort_action name: (identifier) @function)
(instance name: (identifier) @function)
(instance of: (identifier) @type)
(machine name: (identifier) @type)
(pattern name: (identifier) @type)
(layout name: (identifier) @type)
(system name: (identifier) @type)
(component name: (identifier) @type)
(channel name: (identifier) @variable.other.member)
(device name: (identifier) @variable.other.member)
(quantity unit: (identifier) @type.builtin)

[":=" "<-" "->" "=" "!=" "<" "<=" ">" ">=" "+" "-" "*" "/" "^"] @operator
["(" ")" "[" "]" "{" "}"] @punctuation.bracket
["," ":" ";" "." "|"] @punctuation.delimiter
