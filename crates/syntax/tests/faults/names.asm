asm names
import StandardLibrary
signature:
  enum domain Colour = {RED_light | Green | BLUE | A1}
  abstract domain colour
  domain Small subsetof integer
  controlled Speed: Integer
  controlled r_x: Integer
  controlled out: Integer
  controlled i: Complex
  monitored go Boolean
  static pair: Prod(Integer) -> Map(Integer)
  static größe: Integer
definitions:
  rule main = skip
  rule fire = skip
  rule r_a(x in Integer) =
    choose y in Colour with true do skip
  rule r_b = RED := 1
  rule r_c = forall $x in _internal do extend agent with $y do skip
  main rule r_Main = skip
