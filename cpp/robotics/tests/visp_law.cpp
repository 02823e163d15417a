// The only file that includes ViSP; compiled as C++17.
#include "visp_law.hpp"

#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/vs/vpServo.h>

struct VispLaw::Task {
    vpFeaturePoint present[4], desired[4];
    vpServo servo{};
};

VispLaw::VispLaw(Matrix matrix, const Gain& gain, const Points& desired) : task_{std::make_unique<Task>()} {
    vpServo& servo = task_->servo;
    servo.setServo(vpServo::EYEINHAND_CAMERA);
    const vpServo::vpServoIteractionMatrixType kinds[] = {vpServo::CURRENT, vpServo::DESIRED, vpServo::MEAN};
    servo.setInteractionMatrixType(kinds[static_cast<int>(matrix)], vpServo::PSEUDO_INVERSE);
    if (gain.at_zero == gain.at_infinity) {
        servo.setLambda(gain.at_zero);
    } else {
        servo.setLambda(gain.at_zero, gain.at_infinity, gain.slope_at_zero);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        task_->desired[i].buildFrom(desired[i][0], desired[i][1], desired[i][2]);
        servo.addFeature(task_->present[i], task_->desired[i]);
    }
}

VispLaw::~VispLaw() = default;

std::array<double, 6> VispLaw::twist(const Points& present) {
    for (std::size_t i = 0; i < 4; ++i) {
        task_->present[i].buildFrom(present[i][0], present[i][1], present[i][2]);
    }
    const vpColVector v = task_->servo.computeControlLaw();
    return {v[0], v[1], v[2], v[3], v[4], v[5]};
}
