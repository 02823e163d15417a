asm ends
signature:
  controlled x: Integer
definitions:
  function f($a in Integer) = if $a > 3 then 1 else 0
  rule r_a =
    par
      if x = 3 then
        x := 4
      x := 5
    endpar
  rule r_b =
    if x = 1 then
      x := 4
    else if x = 2 then
      skip
    endif
  rule r_c =
    seq
      if x > 1 then
        if x > 2 then
          x := 3
      endif
      x := 4
    endseq
  rule r_d =
    par
      x := 1
    endseq
  rule r_e =
    par
      x := 1
    endpar
    endpar
  rule r_f =
    seq
      iterate
        let ($x = 1) in
          x := $x
      enditerate
      x := 2
  main rule r_Main =
    forall $x in {1:3} do
      skip
    endforall
