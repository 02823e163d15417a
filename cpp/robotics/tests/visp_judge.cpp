// ViSP as the judge of the servo law: the same twist on random views, the same convergence.
#include <cstdio>
#include <cstdlib>

#include "seen_square.hpp"
#include "visp_law.hpp"

using namespace groundstate;
using namespace groundstate::servo;

namespace {

VispLaw::Points numbers(const View& view) {
    VispLaw::Points result{};
    for (std::size_t i = 0; i < points; ++i) {
        result[i] = {view.seen[i].x, view.seen[i].y, view.depths[i]};
    }
    return result;
}

struct Judge {
    Judge(const ServoSettings& settings, const View& desired)
        : law{static_cast<VispLaw::Matrix>(settings.interaction),
              {settings.gain.at_zero, settings.gain.at_infinity, settings.gain.slope_at_zero},
              numbers(desired)} {}

    Twist twist(const View& present) {
        const std::array<double, 6> v = law.twist(numbers(present));
        return Twist{v.data()};
    }

    VispLaw law;
};

ServoSettings settings(Interaction interaction, const Gain& gain) {
    // The judge knows no limits.
    return {.gain = gain, .interaction = interaction, .most_velocity = 1e9, .most_turning = 1e9};
}

}  // namespace

int main() {
    const View desired = seen_square(pose({0, 0, -0.5}, {0.05, 0, 0}));
    double worst = 0;
    double worst_pose = 0;
    int worst_steps = 0;
    int compared = 0;
    for (const Interaction interaction : {Interaction::current, Interaction::desired, Interaction::mean}) {
        for (const Gain& gain : {Gain{0.8, 0.8, 0}, Gain{4, 0.4, 30}}) {
            const ServoSettings own = settings(interaction, gain);
            Judge judge{own, desired};
            plant::Random random{11};
            for (int trial = 0; trial < 500; ++trial) {
                const View present = seen_square(somewhere(random));
                const Command command = control(own, present, desired);
                worst = std::max(worst, (command.twist - judge.twist(present)).cwiseAbs().maxCoeff());
                compared += 1;
            }
            // Two cameras fly home from one place, one by each law.
            for (int trial = 0; trial < 10; ++trial) {
                Eigen::Isometry3d ours = somewhere(random);
                Eigen::Isometry3d theirs = ours;
                int our_steps = 0;
                int their_steps = 0;
                for (int step = 0; step < 1000; ++step) {
                    const Command command = control(own, seen_square(ours), desired);
                    const Command by_judge = control(own, seen_square(theirs), desired);  // for its error alone
                    our_steps += command.error > 1e-3;
                    their_steps += by_judge.error > 1e-3;
                    ours = moved(ours, command.twist, 0.02);
                    theirs = moved(theirs, judge.twist(seen_square(theirs)), 0.02);
                }
                worst_steps = std::max(worst_steps, std::abs(our_steps - their_steps));
                worst_pose = std::max(worst_pose, (ours.matrix() - theirs.matrix()).cwiseAbs().maxCoeff());
                if (our_steps >= 1000) {
                    std::puts("does not converge");
                    return EXIT_FAILURE;
                }
            }
        }
    }
    std::printf("%d twists differ from ViSP's by at most %.1e; convergence by %d steps, the last pose by %.1e\n", compared,
                worst, worst_steps, worst_pose);
    return compared == 3000 && worst < 1e-6 && worst_steps <= 1 && worst_pose < 1e-6 ? EXIT_SUCCESS : EXIT_FAILURE;
}
