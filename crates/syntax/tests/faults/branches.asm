asm branches
signature:
  controlled x: Integer
definitions:
  rule r_a = seq
    switch x
      case 1: x := 2
      x := 7
      case 2 x := 3
      otherwise x := 4
      case 5: skip
    endswitch
    switch x
      x := 1
    endswitch
    if x = 1 then
      skip
    elif x = 2 then
      skip
    else
      skip
    elseif x = 3 then
      skip
    endif
    if x = 1
      skip
    endif
    if then skip endif
    else skip
    case 4: skip
  endseq
  function f = switch x case 1: 2 otherwise 3 case 4: 5 endswitch
  function g = if x = 1 then 2 else 3 else 4 endif
  main rule r_Main = r_a[]
