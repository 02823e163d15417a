// The rules of the machine Servoing, as servoing.hpp declares it.
#include "servoing.hpp"

namespace servoing {

gs::Fault Machine::start() {
    return gs::attempt([&] {
#line 80 "../../../Servoing.asm"
        panel_.put(panel_.number(1), initial_panel());
#line 81 "../../../Servoing.asm"
        guiding_.put(guiding_.number(2), initial_guiding());
#line 82 "../../../Servoing.asm"
        unseen_.put(unseen_.number(3), initial_unseen());
#line 15 "servoing.cpp"
    }, [&] {
        roll_back();
    });
}

gs::Fault Machine::step() {
    [[maybe_unused]] Next next{panel_.begin(), guiding_.begin(), unseen_.begin()};
    const gs::Fault fault = gs::attempt([&] {
        r_Main(next);
    }, [&] {
        roll_back();
        ++step_;
    });
    if (fault) {
        return fault;
    }
    std::uint64_t changed = 0;
    changed |= panel_.commit(next.panel);
    changed |= guiding_.commit(next.guiding);
    changed |= unseen_.commit(next.unseen);
    changed_ = changed != 0;
    ++step_;
    return {};
}

void Machine::roll_back() {
}


gs::Maybe<bool> Machine::hasTarget(gs::Site site) {
    return hasTarget_.read(step_, site, [&]() -> gs::Maybe<bool> { return environment_.hasTarget(); });
}

gs::Maybe<bool> Machine::isSeen(gs::Site site) {
    return isSeen_.read(step_, site, [&]() -> gs::Maybe<bool> { return environment_.isSeen(); });
}

gs::Maybe<bool> Machine::hasLaw(gs::Site site) {
    return hasLaw_.read(step_, site, [&]() -> gs::Maybe<bool> { return environment_.hasLaw(); });
}

gs::Maybe<bool> Machine::isClose(gs::Site site) {
    return isClose_.read(step_, site, [&]() -> gs::Maybe<bool> { return environment_.isClose(); });
}

#line 80 "../../../Servoing.asm"
ServoMode Machine::initial_panel() {
#line 80 "../../../Servoing.asm"
    return ServoMode::WITHOUT_TARGET;
#line 65 "servoing.cpp"
}

#line 81 "../../../Servoing.asm"
gs::Maybe<bool> Machine::initial_guiding() {
#line 81 "../../../Servoing.asm"
    return gs::Maybe<bool>{false};
#line 72 "servoing.cpp"
}

#line 82 "../../../Servoing.asm"
std::int64_t Machine::initial_unseen() {
#line 82 "../../../Servoing.asm"
    return std::int64_t{0};
#line 79 "servoing.cpp"
}

#line 24 "../../../Servoing.asm"
std::int64_t Machine::patience() {
#line 30 "../../../Servoing.asm"
    return std::int64_t{10};
#line 86 "servoing.cpp"
}

#line 25 "../../../Servoing.asm"
bool Machine::isFollowing() {
#line 33 "../../../Servoing.asm"
    return ((panel_.read() == ServoMode::TRACKING) || (panel_.read() == ServoMode::CONVERGED)) || (panel_.read() == ServoMode::COVERED);
#line 93 "servoing.cpp"
}

#line 64 "../../../Servoing.asm"
void Machine::r_Main([[maybe_unused]] Next& next) {
#line 65 "../../../Servoing.asm"
    if (gs::holds(gs::negation(hasTarget(6)), 5)) {
#line 66 "../../../Servoing.asm"
        r_is(next, ServoMode::WITHOUT_TARGET, false, std::int64_t{0});
#line 102 "servoing.cpp"
    } else {
#line 68 "../../../Servoing.asm"
        if (gs::holds(isSeen(12), 12)) {
#line 69 "../../../Servoing.asm"
            r_is_2(next, std::int64_t{0});
#line 108 "servoing.cpp"
        } else {
#line 71 "../../../Servoing.asm"
            if (isFollowing() && (unseen_.read() < patience())) {
#line 72 "../../../Servoing.asm"
                r_is_3(next, ServoMode::COVERED);
#line 114 "servoing.cpp"
            } else {
#line 74 "../../../Servoing.asm"
                r_is_4(next, false, std::int64_t{0});
#line 118 "servoing.cpp"
            }
        }
    }
}

#line 35 "../../../Servoing.asm"
void Machine::r_is([[maybe_unused]] Next& next, [[maybe_unused]] ServoMode mode, [[maybe_unused]] bool guiding_2, [[maybe_unused]] std::int64_t unseen_2) {
#line 37 "../../../Servoing.asm"
    panel_.update(next.panel, 27, mode);
#line 38 "../../../Servoing.asm"
    guiding_.update(next.guiding, 28, gs::Maybe<bool>{guiding_2});
#line 39 "../../../Servoing.asm"
    unseen_.update(next.unseen, 29, unseen_2);
#line 132 "servoing.cpp"
}

#line 35 "../../../Servoing.asm"
void Machine::r_is_2([[maybe_unused]] Next& next, [[maybe_unused]] std::int64_t unseen_2) {
#line 37 "../../../Servoing.asm"
    panel_.update(next.panel, 27, gs::holds(gs::conjunction(isClose(31), [&]() -> gs::Maybe<bool> { return hasLaw(32); }), 30) ? ServoMode::CONVERGED : ServoMode::TRACKING);
#line 38 "../../../Servoing.asm"
    guiding_.update(next.guiding, 28, hasLaw(35));
#line 39 "../../../Servoing.asm"
    unseen_.update(next.unseen, 29, unseen_2);
#line 143 "servoing.cpp"
}

#line 35 "../../../Servoing.asm"
void Machine::r_is_3([[maybe_unused]] Next& next, [[maybe_unused]] ServoMode mode) {
#line 37 "../../../Servoing.asm"
    panel_.update(next.panel, 27, mode);
#line 38 "../../../Servoing.asm"
    guiding_.update(next.guiding, 28, hasLaw(35));
#line 39 "../../../Servoing.asm"
    unseen_.update(next.unseen, 29, gs::between(gs::add(unseen_.read(), std::int64_t{1}, 36), 0, 10, 29));
#line 154 "servoing.cpp"
}

#line 35 "../../../Servoing.asm"
void Machine::r_is_4([[maybe_unused]] Next& next, [[maybe_unused]] bool guiding_2, [[maybe_unused]] std::int64_t unseen_2) {
#line 37 "../../../Servoing.asm"
    panel_.update(next.panel, 27, (isFollowing() || (panel_.read() == ServoMode::LOST)) ? ServoMode::LOST : ServoMode::SEARCHING);
#line 38 "../../../Servoing.asm"
    guiding_.update(next.guiding, 28, gs::Maybe<bool>{guiding_2});
#line 39 "../../../Servoing.asm"
    unseen_.update(next.unseen, 29, unseen_2);
#line 165 "servoing.cpp"
}

}  // namespace servoing
