asm Clients
import StandardLibrary

signature:
    abstract domain Client
    abstract domain Server
    enum domain Mode = {IDLE | WAITS | USES}
    controlled mode: Client -> Mode
    controlled holder: Server -> Client
    static ann: Client
    static bob: Client
    static cim: Client
    static one: Server
    static two: Server

definitions:
    invariant inv_first over holder: holder(one) != undef or holder(two) = undef
    rule r_Client($c in Client) =
        switch mode($c)
            case IDLE: mode($c) := WAITS
            case WAITS:
                choose $s in Server with holder($s) = undef do
                    par
                        holder($s) := $c
                        mode($c) := USES
                    endpar
            case USES:
                par
                    mode($c) := IDLE
                    forall $s in Server with holder($s) = $c do holder($s) := undef
                endpar
        endswitch

    main rule r_Main = choose $c in Client with true do r_Client[$c]

default init s0:
    function mode($c in Client) = IDLE
