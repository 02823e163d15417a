//! Rules: every construct once.

use expect_test::expect;

use crate::check;

#[test]
fn every_rule() {
    check(
        "dynamic abstract domain Item\n controlled n: Integer\n controlled of: Item -> Integer",
        "rule r_step = skip
         main rule r_Main = par
            if n = 0 then n := 1 else if n = 1 then n := 2 else skip endif endif
            switch n case 1: n := 2 case 2: n := 3 otherwise r_step[] endswitch
            let ($a = n, $b = $a + 1) in n := $b endlet
            choose $i in Item, $k in {1 : of($i)} with of($i) > $k do of($i) := $k ifnone skip
            forall $j in Item do of($j) := 0
            extend Item with $x, $y do par of($x) := 1 of($y) := 2 endpar
            seq iterate if n < 9 then n := n + 1 endif enditerate while n > 0 do n := n - 1 whilerec n < 3 do n := n + 1 endseq
         endpar",
        expect![[r#"
            asm x
            dynamic abstract Item {}
            controlled n: Integer
            controlled of: Item -> Integer
            rule r_Main#0 main
              par
                if Eq(n, 0)
                  n := 1
                else
                  if Eq(n, 1)
                    n := 2
                  else
                    skip
                switch n
                case 1
                  n := 2
                case 2
                  n := 3
                otherwise
                  call r_step#1()
                let $a = n
                  let $b = IntAdd($a, 1)
                    n := $b
                choose $i in Item, $k in Set{1 : of($i)} with Gt(of($i), $k)
                  of($i) := $k
                ifnone
                  skip
                forall $j in Item
                  of($j) := 0
                extend Item with $x, $y
                  par
                    of($x) := 1
                    of($y) := 2
                seq
                  iterate
                    if Lt(n, 9)
                      n := IntAdd(n, 1)
                  while Gt(n, 0)
                    n := IntSub(n, 1)
                  whilerec Lt(n, 3)
                    n := IntAdd(n, 1)
            rule r_step#1
              skip
        "#]],
    );
}

#[test]
fn local_functions() {
    check(
        "controlled n: Integer",
        "turbo rule r_sum($k in Integer) in Integer =
            local j: Integer [ j := 0 ]
            local at: Integer -> Integer [ skip ]
            seq while j < $k do par j := j + 1 at(j) := j endpar result := at($k) endseq
         main rule r_Main = n <- r_sum(5)",
        expect![[r#"
            asm x
            controlled n: Integer
            local j: Integer
            local at: Integer -> Integer
            rule r_Main#0 main
              n <- r_sum#1(5)
            turbo r_sum#1($k)
              local j
                j := 0
              local at
                skip
              in
                seq
                  while Lt(j, $k)
                    par
                      j := IntAdd(j, 1)
                      at(j) := j
                  result := at($k)
        "#]],
    );
}
