//! Systems: components, their phases, the channels between them, and devices (spec/charts.md).
//!
//! In: the cursor at `system`. Out: SYSTEM_CHART. Every length of time is a number and a unit.

use super::chart_part::{block, eat_word, expect_word, keyword, no_item, rest_of_line, rule_link, shape_name};
use super::domain::domain;
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::parser::Parser;

/// `system NAME "text" … endsystem`
pub(super) fn system(p: &mut Parser<'_>) {
    p.start(SYSTEM_CHART);
    p.bump_opener_as(SYSTEM_KW, ENDSYSTEM_KW);
    shape_name(p);
    p.eat(STRING);
    block(p, ENDSYSTEM_KW, item);
    p.finish();
}

/// The words that items start with; a connection starts with a name.
const ITEMS: [SyntaxKind; 7] = [TICK_KW, PROCESSORS_KW, COMPONENT_KW, CHANNEL_KW, SENSOR_KW, ACTUATOR_KW, WITHIN_KW];

fn starts_item(p: &Parser<'_>) -> bool {
    keyword(p, &ITEMS).is_some() || p.peek(1) == ARROW
}

fn item(p: &mut Parser<'_>) {
    match keyword(p, &ITEMS) {
        _ if p.peek(1) == ARROW => connection(p),
        Some(TICK_KW) => {
            p.start(TICK);
            p.bump_as(TICK_KW);
            quantity(p);
            p.finish();
        }
        Some(PROCESSORS_KW) => {
            p.start(PROCESSORS);
            p.bump_as(PROCESSORS_KW);
            p.expect(INTEGER, "as the number of processors");
            p.finish();
        }
        Some(WITHIN_KW) => age_bound(p),
        Some(COMPONENT_KW) => component(p),
        Some(CHANNEL_KW) => channel(p),
        Some(device) => {
            p.start(DEVICE);
            p.bump_as(device);
            if shape_name(p) {
                message(p);
                p.eat(STRING);
            }
            p.finish();
        }
        None => no_item(p, "a component, channel, sensor, actuator, age bound or connection", starts_item),
    }
}

/// `NUMBER UNIT`
fn quantity(p: &mut Parser<'_>) {
    length(p, false);
}

/// `NUMBER UNIT`, or `NUMBER..NUMBER UNIT` if it may vary
fn length(p: &mut Parser<'_>, varies: bool) {
    p.start(QUANTITY);
    let number = |p: &mut Parser<'_>| p.eat(REAL) || p.expect(INTEGER, "as a length of time");
    let mut complete = number(p);
    if complete && varies && p.at(DOT) && p.peek(1) == DOT {
        p.bump();
        p.bump();
        complete = number(p);
    }
    if complete {
        // The next line is another item, and a word that goes on here is not a unit.
        let goes_on = [JITTER_KW, OFFSET_KW, DEADLINE_KW, MISSES_KW, BY_KW, FROM_KW, EVERY_KW, FRESH_KW];
        if p.on_new_line() || p.at(EOF) || p.at(DOT) || keyword(p, &goes_on).is_some() {
            let found = p.missing();
            p.fault(fault::expected_unit(found));
        } else {
            shape_name(p);
        }
    }
    p.finish();
}

/// `: DOMAIN`, if it is there: what goes through a channel or a device
fn message(p: &mut Parser<'_>) {
    if p.eat(COLON) {
        domain(p);
    }
}

/// `within Q from NAME to NAME`: how old data may be
fn age_bound(p: &mut Parser<'_>) {
    p.start(AGE_BOUND);
    p.bump_as(WITHIN_KW);
    quantity(p);
    if expect_word(p, FROM_KW, "behind the age that data may have") {
        shape_name(p);
        if expect_word(p, TO_KW, "behind the place that data come from") {
            shape_name(p);
        }
    }
    p.finish();
}

/// `NAME -> NAME`: a physical connection
fn connection(p: &mut Parser<'_>) {
    p.start(CONNECTION);
    shape_name(p);
    p.bump();
    shape_name(p);
    p.finish();
}

/// `component NAME "text" KIND … endcomponent`
fn component(p: &mut Parser<'_>) {
    p.start(COMPONENT);
    p.bump_opener_as(COMPONENT_KW, ENDCOMPONENT_KW);
    if shape_name(p) {
        p.eat(STRING);
        kind(p);
    }
    block(p, ENDCOMPONENT_KW, phase);
    p.finish();
}

/// `synchronous period Q jitter Q offset Q deadline Q misses N of N`, `asynchronous awaits all NAME, NAME`
fn kind(p: &mut Parser<'_>) {
    p.start(COMPONENT_KIND);
    if eat_word(p, ASYNCHRONOUS_KW) {
        if keyword(p, &[AWAITS_KW]).is_some() {
            awaits(p);
        }
        // Without a period it means nothing; the chart's reader says so.
        if eat_word(p, JITTER_KW) {
            quantity(p);
        }
    } else if expect_word(p, SYNCHRONOUS_KW, "or `asynchronous` behind the name of a component") {
        if expect_word(p, PERIOD_KW, "behind `synchronous`") {
            quantity(p);
        }
        for word in [JITTER_KW, OFFSET_KW, DEADLINE_KW] {
            if eat_word(p, word) {
                quantity(p);
            }
        }
        if keyword(p, &[MISSES_KW]).is_some() {
            tolerance(p);
        }
    }
    p.finish();
}

/// `awaits NAME`, `awaits all NAME, NAME`, `awaits any NAME, NAME`
fn awaits(p: &mut Parser<'_>) {
    p.start(AWAITS);
    p.bump_as(AWAITS_KW);
    // A channel may have these names, too: then no other name follows.
    let next = p.next_text();
    let ends = [READ_KW, ELABORATE_KW, WRITE_KW, ENDCOMPONENT_KW, JITTER_KW];
    let names =
        next.starts_with(|c: char| c.is_alphabetic() || c == '_') && !ends.iter().any(|end| end.text() == Some(next));
    if let Some(word) = keyword(p, &[ALL_KW, ANY_KW]).filter(|_| names) {
        p.bump_as(word);
    }
    while shape_name(p) && p.eat(COMMA) {
        // The phase behind a comma too many is none of the names.
        if p.on_new_line() && keyword(p, &ends).is_some() {
            let found = p.missing();
            p.fault(fault::expected_name(found, GENERIC_ID));
            break;
        }
    }
    p.finish();
}

/// `misses N of N`: how many deadlines a task may miss
fn tolerance(p: &mut Parser<'_>) {
    p.start(TOLERANCE);
    p.bump_as(MISSES_KW);
    if p.expect(INTEGER, "as the number of deadlines that may be missed")
        && expect_word(p, OF_KW, "behind the number of deadlines that may be missed")
    {
        p.expect(INTEGER, "as the number of successive cycles");
    }
    p.finish();
}

/// `every Q fresh`: how often a reading brings something new
fn fresh_bound(p: &mut Parser<'_>) {
    p.start(FRESH_BOUND);
    p.bump_as(EVERY_KW);
    quantity(p);
    expect_word(p, FRESH_KW, "behind the time within which something new comes");
    p.finish();
}

/// `read NAME as NAME Q every Q fresh`, `elaborate NAME Q by NAME {rule}`, `write NAME as NAME Q`
fn phase(p: &mut Parser<'_>) {
    let Some(word) = keyword(p, &[READ_KW, ELABORATE_KW, WRITE_KW]) else {
        let starts = |p: &Parser<'_>| keyword(p, &[READ_KW, ELABORATE_KW, WRITE_KW]).is_some();
        no_item(p, "a phase: `read`, `elaborate` or `write`", |p| starts(p) || starts_item(p));
        return;
    };
    p.start(PHASE);
    p.bump_as(word);
    if shape_name(p) {
        if eat_word(p, AS_KW) {
            shape_name(p);
        }
        if p.at(INTEGER) || p.at(REAL) {
            length(p, true);
        }
        if word == READ_KW && keyword(p, &[EVERY_KW]).is_some() {
            fresh_bound(p);
        }
        if eat_word(p, BY_KW) {
            shape_name(p);
        }
        rule_link(p);
    }
    p.finish();
}

/// `channel NAME : DOMAIN from NAME to NAME, NAME KIND`
fn channel(p: &mut Parser<'_>) {
    p.start(CHANNEL);
    p.bump_as(CHANNEL_KW);
    let named = shape_name(p);
    if named {
        message(p);
    }
    if named && expect_word(p, FROM_KW, "behind the name of a channel") {
        shape_name(p);
        if expect_word(p, TO_KW, "behind the sender of a channel") {
            while shape_name(p) && p.eat(COMMA) {}
        }
        channel_kind(p);
    }
    p.finish();
}

/// `swinging buffer N master NAME`, `queue N`, `shared value`
fn channel_kind(p: &mut Parser<'_>) {
    p.start(CHANNEL_KIND);
    let complete = if eat_word(p, SWINGING_KW) {
        let sized = expect_word(p, BUFFER_KW, "behind `swinging`") && p.expect(INTEGER, "as the number of arrays");
        if sized && eat_word(p, MASTER_KW) {
            shape_name(p);
        }
        sized
    } else if eat_word(p, QUEUE_KW) {
        p.expect(INTEGER, "as the capacity of the queue")
    } else if p.at(SHARED_KW) {
        p.bump();
        expect_word(p, VALUE_KW, "behind `shared`")
    } else {
        let found = p.missing();
        p.fault(fault::expected_channel_kind(found));
        false
    };
    if !complete {
        rest_of_line(p, starts_item);
    }
    p.finish();
}

#[cfg(test)]
mod tests {
    use crate::grammar::brief::chart;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&chart(text));
    }

    #[test]
    fn systems() {
        check(
            "chart C system s \"S\" tick 0.1 ms sensor camera \"Camera\" component grab \"Grab\" synchronous period 10 ms offset 1 ms deadline 9 ms elaborate shot 6 ms {r_shot[]} write frames as w 0.1 ms endcomponent component vs asynchronous awaits frames read frames endcomponent channel frames from grab to vs swinging buffer 2 master vs channel q from vs to grab queue 4 channel v from vs to grab shared value camera -> grab endsystem",
            expect![[r#"
                chart
                C
                SYSTEM_CHART(
                  system
                  s
                  "S"
                  TICK(tick QUANTITY(0.1 ms))
                  DEVICE(sensor camera "Camera")
                  COMPONENT(
                    component
                    grab
                    "Grab"
                    COMPONENT_KIND(
                      synchronous
                      period
                      QUANTITY(10 ms)
                      offset
                      QUANTITY(1 ms)
                      deadline
                      QUANTITY(9 ms))
                    PHASE(
                      elaborate
                      shot
                      QUANTITY(6 ms)
                      LINK({ MACRO_CALL(r_shot ARGUMENT_LIST([ ])) }))
                    PHASE(write frames as w QUANTITY(0.1 ms))
                    endcomponent)
                  COMPONENT(
                    component
                    vs
                    COMPONENT_KIND(asynchronous AWAITS(awaits frames))
                    PHASE(read frames)
                    endcomponent)
                  CHANNEL(
                    channel
                    frames
                    from
                    grab
                    to
                    vs
                    CHANNEL_KIND(swinging buffer 2 master vs))
                  CHANNEL(channel q from vs to grab CHANNEL_KIND(queue 4))
                  CHANNEL(channel v from vs to grab CHANNEL_KIND(shared value))
                  CONNECTION(camera -> grab)
                  endsystem)"#]],
        );
    }

    #[test]
    fn what_is_awaited() {
        let kind = |awaits: &str| {
            let text =
                chart(&format!("chart C system s component c asynchronous {awaits} read a endcomponent endsystem"));
            let start = text.find("AWAITS(").unwrap_or(0);
            let end = text[start..].find("PHASE").map_or(text.len(), |length| start + length);
            text[start..end].split_whitespace().collect::<Vec<_>>().join(" ")
        };
        assert_eq!(kind("awaits a"), "AWAITS(awaits a))");
        assert_eq!(kind("awaits all a, b"), "AWAITS(awaits all a , b))");
        assert_eq!(kind("awaits any a, b, all"), "AWAITS(awaits any a , b , all))");
        assert_eq!(kind("awaits a, b"), "AWAITS(awaits a , b))");
        // A channel of that name.
        assert_eq!(kind("awaits all"), "AWAITS(awaits all))");
        assert_eq!(kind("awaits any, all"), "AWAITS(awaits any , all))");
    }

    #[test]
    fn machines_and_messages() {
        check(
            "chart C system s sensor stop : Boolean \"Stop\" component c synchronous period 1 ms elaborate e 1 ms by M elaborate f by N {r_f[]} endcomponent channel x : Prod(Code, Integer) from c to c queue 2 endsystem",
            expect![[r#"
                chart
                C
                SYSTEM_CHART(
                  system
                  s
                  DEVICE(sensor stop : Boolean "Stop")
                  COMPONENT(
                    component
                    c
                    COMPONENT_KIND(synchronous period QUANTITY(1 ms))
                    PHASE(elaborate e QUANTITY(1 ms) by M)
                    PHASE(
                      elaborate
                      f
                      by
                      N
                      LINK({ MACRO_CALL(r_f ARGUMENT_LIST([ ])) }))
                    endcomponent)
                  CHANNEL(
                    channel
                    x
                    :
                    STRUCTURED(Prod ( Code , Integer ))
                    from
                    c
                    to
                    c
                    CHANNEL_KIND(queue 2))
                  endsystem)"#]],
        );
    }

    #[test]
    fn processors_and_age_bounds() {
        check(
            "chart C system s processors 2 within 50 ms from camera to arm within -> a processors -> b endsystem",
            expect![[r#"
                chart
                C
                SYSTEM_CHART(
                  system
                  s
                  PROCESSORS(processors 2)
                  AGE_BOUND(within QUANTITY(50 ms) from camera to arm)
                  CONNECTION(within -> a)
                  CONNECTION(processors -> b)
                  endsystem)"#]],
        );
        check(
            "chart C system s processors within 50 from a within 5 ms to b endsystem",
            expect![[r#"
            chart
            C
            SYSTEM_CHART(
              system
              s
              PROCESSORS(processors)
              AGE_BOUND(within QUANTITY(50) from a)
              AGE_BOUND(within QUANTITY(5 ms))
              ERROR(to b)
              endsystem)
            !expected-token
            !expected-token
            !expected-token
            !expected-token
            !expected-shape"#]],
        );
    }

    #[test]
    fn what_may_be_missed_and_how_often_something_new_comes() {
        check(
            "chart C system s component c synchronous period 10 ms deadline 9 ms misses 1 of 20 read every as fresh 1 ms every 20 ms fresh read x every 5 ms fresh elaborate misses 1 ms endcomponent endsystem",
            expect![[r#"
                chart
                C
                SYSTEM_CHART(
                  system
                  s
                  COMPONENT(
                    component
                    c
                    COMPONENT_KIND(
                      synchronous
                      period
                      QUANTITY(10 ms)
                      deadline
                      QUANTITY(9 ms)
                      TOLERANCE(misses 1 of 20))
                    PHASE(
                      read
                      every
                      as
                      fresh
                      QUANTITY(1 ms)
                      FRESH_BOUND(every QUANTITY(20 ms) fresh))
                    PHASE(read x FRESH_BOUND(every QUANTITY(5 ms) fresh))
                    PHASE(elaborate misses QUANTITY(1 ms))
                    endcomponent)
                  endsystem)"#]],
        );
        check(
            "chart C system s component c synchronous period 10 misses of 20 read x every fresh write y every 5 ms fresh endcomponent endsystem",
            expect![[r#"
                chart
                C
                SYSTEM_CHART(
                  system
                  s
                  COMPONENT(
                    component
                    c
                    COMPONENT_KIND(synchronous period QUANTITY(10) TOLERANCE(misses))
                    ERROR(of 20 read x every fresh write y every 5 ms fresh)
                    endcomponent)
                  endsystem)
                !expected-token
                !expected-token
                !expected-shape"#]],
        );
    }

    #[test]
    fn jitter() {
        check(
            "chart C system s component jitter synchronous period 10 ms jitter 1 ms offset 1 ms elaborate jitter 1 ms endcomponent component d asynchronous jitter 1 ms endcomponent component e synchronous period 10 jitter endcomponent endsystem",
            expect![[r#"
                chart
                C
                SYSTEM_CHART(
                  system
                  s
                  COMPONENT(
                    component
                    jitter
                    COMPONENT_KIND(
                      synchronous
                      period
                      QUANTITY(10 ms)
                      jitter
                      QUANTITY(1 ms)
                      offset
                      QUANTITY(1 ms))
                    PHASE(elaborate jitter QUANTITY(1 ms))
                    endcomponent)
                  COMPONENT(
                    component
                    d
                    COMPONENT_KIND(asynchronous jitter QUANTITY(1 ms))
                    endcomponent)
                  COMPONENT(
                    component
                    e
                    COMPONENT_KIND(synchronous period QUANTITY(10) jitter)
                    endcomponent)
                  endsystem)
                !expected-token
                !expected-token"#]],
        );
    }

    #[test]
    fn faults() {
        check(
            "chart C system s component c period 1 ms read endcomponent channel x to y endsystem",
            expect![[r#"
            chart
            C
            SYSTEM_CHART(
              system
              s
              COMPONENT(component c ERROR(period 1 ms read) endcomponent)
              CHANNEL(channel x)
              ERROR(to y)
              endsystem)
            !expected-token
            !expected-shape
            !expected-token
            !expected-shape"#]],
        );
        check(
            "chart C system s component c synchronous period ms stray 3 endcomponent channel x from a to b endsystem",
            expect![[r#"
            chart
            C
            SYSTEM_CHART(
              system
              s
              COMPONENT(
                component
                c
                COMPONENT_KIND(synchronous period)
                ERROR(ms stray 3)
                endcomponent)
              CHANNEL(channel x from a to b)
              endsystem)
            !expected-token
            !expected-shape
            !expected-token"#]],
        );
    }
}
