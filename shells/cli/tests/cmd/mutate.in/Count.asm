asm Count
import Counting
import StandardLibrary
import CTLLibrary
signature:
definitions:
    invariant inv_small over number: number >= 0 and number <= 4
    CTLSPEC ctlSpec_four: ef(number = 4)
    main rule r_Main = r_count[4]
default init s0:
    function number = 0
    function full = false
