//! Properties: kinds, temporal operators, what they read.

use expect_test::expect;

use crate::{checked, lowered};

#[test]
fn properties_and_what_they_read() {
    let model = checked(
        "asm x
         import StandardLibrary
         import CTLLibrary
         signature:
            monitored m: Integer
            controlled n: Integer
            derived twice: Integer
            derived plain: Integer
         definitions:
            function twice = m + m
            function plain = n + n
            INVAR m > 0
            JUSTICE m > 1
            invariant inv_a over n: plain >= 0
            invariant inv_b over n: twice > n
            CTLSPEC ctlSpec_c: ag(n >= 0 implies ef(n = 0))
            CTLSPEC absenceBetween(n = 1, n = 2, n = 3)
            main rule r_Main = n := m",
    );
    expect![[r#"
        asm x
        monitored m: Integer
        controlled n: Integer
        derived twice: Integer = IntAdd(m, m)
        derived plain: Integer = IntAdd(n, n)
        rule r_Main#0 main
          n := m
        invar INVAR at line 12 monitored = Gt(m, 0)
        justice JUSTICE at line 13 monitored = Gt(m, 1)
        invariant inv_a = Ge(plain, 0)
        invariant inv_b monitored = Gt(twice, n)
        ctl ctlSpec_c = Ag(Implies(Ge(n, 0), Ef(Eq(n, 0))))
        ctl CTLSPEC at line 17 = AbsenceBetween(Eq(n, 1), Eq(n, 2), Eq(n, 3))
    "#]]
    .assert_eq(&program::dump(&lowered(&model)));
}
