asm operators
signature:
  static distance: Place * Place -> Real
  controlled x: Integer
definitions:
  function f = x == 1 && x <> 2 || !(x % 2 != 0)
  function g = x ≠ 1 ∧ ¬ (x ≤ 2) => true
  function h = x := 3
  function k = {1..5}
  function l = mod 3 + * 4
  function m = forall $x in {1:3} with $x > 2
  function n = r_a[1] + r_b
  function o = x ? 1 : 2
  main rule r_Main = par
    x = 4
    x : = 5
    x += 6
    x == 7
    r_run[<<skip>>]
    x
  endpar
