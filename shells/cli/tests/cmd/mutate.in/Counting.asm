module Counting
import StandardLibrary
export *
signature:
    controlled number: Integer
    controlled full: Boolean
definitions:
    rule r_count($limit in Integer) =
        if number < $limit then
            number := number + 1
        else
            if number > $limit then full := true else number := 0 endif
        endif
