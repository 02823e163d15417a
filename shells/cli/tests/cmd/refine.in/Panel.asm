asm Panel
import StandardLibrary
signature:
    domain Lamp subsetof Integer
    monitored pressed: Lamp
    controlled on: Lamp -> Boolean
    controlled spare: Lamp -> Boolean
    controlled presses: Boolean
definitions:
    domain Lamp = {1 : 9}
    main rule r_Main =
        par
            if pressed = 7 then
                forall $lamp in Lamp with $lamp > 2 do on($lamp) := not on($lamp)
            else
                on(pressed) := not on(pressed)
            endif
            presses := not presses
        endpar
default init s0:
    function on($lamp in Lamp) = false
    function spare($lamp in Lamp) = false
    function presses = false
