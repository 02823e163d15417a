[
  (signature) (definitions) (initial_state) (enum_domain_declaration)
  (function_definition) (rule_declaration)
  (par_rule) (seq_rule) (iterate_rule) (if_rule) (switch_rule) (let_rule)
  (choose_rule) (forall_rule) (extend_rule) (while_rule) (whilerec_rule)
  (if_term) (switch_term) (let_term)
  (block) (block_comment)
  (machine) (pattern) (composite_state) (layout) (system) (component)
] @fold
