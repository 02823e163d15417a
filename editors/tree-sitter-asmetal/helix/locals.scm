[
  (rule_declaration) (function_definition) (machine) (pattern)
  (choose_rule) (forall_rule) (extend_rule) (let_rule) (let_term)
  (quantified_term) (comprehension)
] @local.scope

(parameter name: (variable) @local.definition)
(binder name: (variable) @local.definition)
(binding name: (variable) @local.definition)
(extend_rule (variable) @local.definition)
(variable) @local.reference
