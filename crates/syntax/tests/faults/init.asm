asm init
signature:
definitions:
  main rule r_Main = skip
default s0:
  function x = 1
init:
  function y
  agent A r_a[]
  agent B: par skip endpar
  agent c: r_b
  controlled z: Integer
  rule r_c = skip
default init s2
  function x := 1
