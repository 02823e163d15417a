[
  (signature) (definitions) (initial_state)
  (par_rule) (seq_rule) (iterate_rule) (if_rule) (switch_rule) (let_rule)
  (if_term) (switch_term) (let_term) (case)
  (machine) (pattern) (composite_state) (layout) (system) (component)
] @indent

[
  "endpar" "endseq" "enditerate" "endif" "else" "elseif" "otherwise" "endswitch" "endlet"
  "endmachine" "endpattern" "endstate" "endlayout" "endsystem" "endcomponent"
] @outdent
