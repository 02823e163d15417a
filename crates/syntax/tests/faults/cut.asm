asm cut
signature:
  controlled x: Integer
definitions:
  main rule r_Main =
    par
      if x = 1 then
        x := f(1, {2