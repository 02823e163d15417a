asm rules
signature:
  controlled x: Integer
definitions:
  rule r_a = skip
  rule r_b = par
    r_a
    r_a; r_a[];
    x := 1,
    x := r_a[]
    x <- r_a[]
    x <- 5
    if x > 1 then x := 2 x := 3 endif
    if x > 1 { x := 1 }
    else { x := 2 }
    endif
    while x > 1
      x := x - 1
    choose $x in {1:3} with $x > 1 x := $x
    x + 1
    5
    (x := 1)
    extend with $y do skip
    local y [skip] x := y
  endpar
  rule r_c = par endpar
  rule r_d =
    x := 1
    x := 2
  main rule = skip
