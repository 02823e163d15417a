asm Idle
import StandardLibrary
signature:
    enum domain Mode = {WORK | REST | FAILED}
    controlled mode: Mode
    controlled stopped: Boolean
definitions:
    invariant inv_failed over mode: mode = FAILED implies stopped
    invariant inv_mode over mode: mode = WORK or mode = REST
    main rule r_Main = if mode = WORK then mode := REST else mode := WORK endif
default init s0:
    function mode = WORK
    function stopped = false
