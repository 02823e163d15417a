asm definitions
signature:
  domain D = {1, 2}
  local y: Integer
  x: Integer
  controlled f: Integer ->
  dynamic g: Integer
definitions:
  domain E subsetof Integer
  function f 3
  function g =
  function = 1
  function h(x in Integer, $y) = 1
  invariant x > 3
  invariant inv_a: x > 3
  invariant inv_b over: x > 3
  invariant inv_c over x, y x > 3
  CTLSPEC live: ag(x)
  COMPASSION p, q
  x := 5
  macro turbo rule r_x = skip
  rule r_y skip
