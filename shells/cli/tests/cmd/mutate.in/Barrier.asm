asm Barrier
import StandardLibrary
signature:
    enum domain Position = {UP | DOWN}
    monitored train: Boolean
    controlled barrier: Position
    controlled crossing: Boolean
    controlled count: Integer
definitions:
    // a train goes over the crossing only while the barrier is down
    rule r_close = barrier := DOWN
    rule r_open = barrier := UP
    invariant over barrier: crossing implies barrier = DOWN
    main rule r_Main =
        if barrier = UP then
            if train then r_close[] endif
        else
            par
                crossing := train
                if crossing then count := (count + 1) mod 3 endif
                if not train then r_open[] endif
            endpar
        endif
default init s0:
    function barrier = UP
    function crossing = false
    function count = 0
