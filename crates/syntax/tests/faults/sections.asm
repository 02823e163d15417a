asm sections
signature:
  controlled x: Integer
import StandardLibrary
signature:
  controlled y: Integer
definitions:
  static z: Integer
  rule r_a = skip
main rule r_Main = r_a[]
  rule r_b = skip
  function f = 1
default init s0:
  function x = 1
main rule r_Other = skip
export *
end
