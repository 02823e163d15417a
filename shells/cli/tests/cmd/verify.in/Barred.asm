asm Barred
import StandardLibrary
signature:
    enum domain Bar = {UP | DOWN}
    controlled bar: Bar
    controlled wait: Integer
    controlled cars: Integer
    monitored train: Boolean
    monitored car: Boolean
definitions:
    invariant inv_wait over wait: wait <= 2
    rule r_count = if car then cars := (cars + 1) mod 3 endif
    main rule r_Main =
        par
            if train and bar = UP then
                par
                    bar := DOWN
                    wait := 2
                endpar
            endif
            if wait > 0 then wait := wait - 1 endif
            if wait = 0 and bar = DOWN and not train then bar := UP endif
            r_count[]
        endpar
default init s0:
    function bar = UP
    function wait = 0
    function cars = 0
