asm Board
import StandardLibrary
signature:
    domain Lamp subsetof Integer
    monitored pressed: Lamp
    controlled lit: Lamp -> Boolean
definitions:
    domain Lamp = {1 : 9}
    main rule r_Main = lit(pressed) := not lit(pressed)
default init s0:
    function lit($lamp in Lamp) = false
