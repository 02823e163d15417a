asm brackets
signature:
  controlled x: Integer
  controlled s: Powerset(Integer
  controlled t: Seq(Integer)
definitions:
  rule r_a = seq
    x := f(1
    x := g(1, (2 + 3)
    s := {1, 2
    t := [1, 2)
    t := <1, 2
    x := h(1 2, , 3)
    x := (1, )
    x := f()
    x := x)
    let ($y = 3 in
      x := $y
    endlet
    let $y = 3 in x := $y endlet
    s := {$x in s | $x > 1}
    t := {1 -> 2, 3}
    r_b[1, 2)
    r_b(1, 2]
  endseq
  main rule r_Main = x := ((1 + 2)
default init s0:
  function x = f(1
  function s = {}
