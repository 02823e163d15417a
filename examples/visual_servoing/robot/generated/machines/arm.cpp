// The rules of the machine Arm, as arm.hpp declares it.
#include "arm.hpp"

namespace arm {

gs::Fault Machine::start() {
    return gs::attempt([&] {
#line 34 "../../../Arm.asm"
        arm_.put(arm_.number(1), initial_arm());
#line 11 "arm.cpp"
    }, [&] {
        roll_back();
    });
}

gs::Fault Machine::step() {
    [[maybe_unused]] Next next{arm_.begin()};
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
    changed |= arm_.commit(next.arm);
    changed_ = changed != 0;
    ++step_;
    return {};
}

void Machine::roll_back() {
}


gs::Maybe<bool> Machine::isGuided(gs::Site site) {
    return isGuided_.read(step_, site, [&]() -> gs::Maybe<bool> { return environment_.isGuided(); });
}

gs::Maybe<bool> Machine::isStill(gs::Site site) {
    return isStill_.read(step_, site, [&]() -> gs::Maybe<bool> { return environment_.isStill(); });
}

#line 34 "../../../Arm.asm"
ArmMode Machine::initial_arm() {
#line 34 "../../../Arm.asm"
    return ArmMode::STANDING;
#line 51 "arm.cpp"
}

#line 26 "../../../Arm.asm"
void Machine::r_Main([[maybe_unused]] Next& next) {
#line 27 "../../../Arm.asm"
    if (gs::holds(isGuided(3), 3)) {
#line 28 "../../../Arm.asm"
        arm_.update(next.arm, 4, ArmMode::FOLLOWING);
#line 60 "arm.cpp"
    } else {
#line 30 "../../../Arm.asm"
        arm_.update(next.arm, 5, gs::holds(gs::disjunction((arm_.read() == ArmMode::FOLLOWING), [&]() -> gs::Maybe<bool> { return gs::conjunction((arm_.read() == ArmMode::STOPPING), [&]() -> gs::Maybe<bool> { return gs::negation(isStill(13)); }); }), 6) ? ArmMode::STOPPING : ArmMode::STANDING);
#line 64 "arm.cpp"
    }
}

}  // namespace arm
