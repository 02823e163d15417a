asm Relay
import StandardLibrary
signature:
    controlled coil: Boolean
    controlled on: Boolean
definitions:
    main rule r_Main = if coil = on then coil := not coil else on := coil endif
default init s0:
    function coil = false
    function on = false
