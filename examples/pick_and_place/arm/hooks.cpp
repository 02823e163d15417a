// Pictures to places, places to set-points, set-points to velocities.
#include "hooks.hpp"

#include <algorithm>

namespace placing_system {

using namespace groundstate;

namespace {

constexpr double travel = 0.15;     // m above the table
constexpr double reach = 0.008;     // where the jaw closes
constexpr double row_begins = 0.1;  // y from which on parts are in the row
constexpr double bound = 0.6;       // m/s
constexpr double turning = 1.5;     // rad/s
constexpr std::int64_t never_ns = INT64_MIN / 2;  // so long ago that no set-point is fresh

Vector6 values(const Joints& vector) {
    Vector6 result;
    Joints::Map(result.data()) = vector;
    return result;
}

}  // namespace

bool TableCamera::grab(const Cycle&, const In&, Out& out) {
    out.image.captured_ns = now_();
    table_.draw(out.image.captured_ns, out.image.frame.view());
    return true;
}

bool PartFinder::find(const Cycle&, const In& in, Out& out) {
    if (!in.image || !in.image.fresh) {
        return false;
    }
    double nearest = INFINITY;
    for (const vision::Disc& disc : detector_.search(in.image->frame.view())) {
        const Place place = on_table(disc.centre);
        const double distance = std::hypot(place.x, place.y);
        if (place.y < row_begins && distance < nearest) {
            nearest = distance;
            last_ = place;
        }
    }
    out.parts.nearest = last_;
    out.sight = {nearest < INFINITY};
    return true;
}

// What was seen is read before where it was seen, so a part that is to be taken has a place.
bool PlacePlanner::plan(const Cycle& cycle, const In& in, Out& out) {
    const std::int64_t before = machine().number();
    const bool decided = PlannerMachine::plan(cycle, in, out);
    if (machine().number() != before) {
        const Move move = out.moves.value.second;
        if (move == Move::OVER && in.parts) {
            part_ = in.parts->nearest;
        }
        missed_ += move == Move::REOPEN;
        const bool is_low = move == Move::DOWN || move == Move::CLOSE || move == Move::LOWER || move == Move::OPEN;
        const bool is_at_row = move == Move::CARRY || move == Move::LOWER || move == Move::OPEN || move == Move::RISE;
        target_ = {machine().number(), is_at_row ? row_[std::min(placed(), row_.size() - 1)] : part_, is_low ? reach : travel};
        if (sent_.size() < sent_.capacity()) {
            sent_.push_back({now_(), move, target_});
        }
    }
    out.target = target_;
    return decided;
}

// Straight towards the place, the tool pointing down; true when it is there.
bool ToolMover::go(const Joints& measured, const Target& target, double dt) {
    const Eigen::Isometry3d tool = motion_.arm().camera(motion_.position());
    const Eigen::Vector3d to{target.place.x, target.place.y, target.height};
    Eigen::Matrix3d down;
    down << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    const Eigen::AngleAxisd turn{tool.linear().transpose() * down};
    const Eigen::Vector3d way = tool.linear().transpose() * (to - tool.translation());
    servo::Twist wanted;
    wanted << 4 * way, 4 * turn.angle() * turn.axis();
    wanted *= servo::within(wanted, bound, turning);
    motion_.step(measured, wanted, dt);
    return way.norm() < 5e-4 && turn.angle() < 5e-3 && motion_.twist().norm() < 1e-2;
}

// The tool moves as the machine has just decided; whether it is there the machine asks in the next cycle.
bool ToolMover::control(const Cycle& cycle, const In& in, Out& out) {
    const bool decided = RobotMachine::control(cycle, in, out);
    arrived_ = false;
    if (!in.encoder_to_robot) {
        out.robot_to_motor = {.set_ns = never_ns};
        return decided;
    }
    const std::int64_t now_ns = now_();
    const double dt = last_ns_ < 0 ? 0 : static_cast<double>(now_ns - last_ns_) * 1e-9;
    last_ns_ = now_ns;
    const Joints measured{in.encoder_to_robot->position.data()};
    const Move move = converted<Move>(machine().move().value);
    const bool is_jaw = move == Move::CLOSE || move == Move::OPEN || move == Move::REOPEN;
    if (!is_jaw && in.target && in.target->number == machine().number() && out.progress.value.first != machine().number()) {
        arrived_ = go(measured, *in.target, dt);
    } else {
        motion_.step(measured, servo::Twist::Zero(), dt);
    }
    out.robot_to_motor = {values(motion_.position()), values(motion_.velocity()), now_ns};
    return decided;
}

void JointDrives::safe_stop() noexcept { command_(now_(), Joints::Zero()); }

bool JointDrives::drive(const Cycle&, const In& in, Out&) {
    const std::int64_t now_ns = now_();
    follower_.begin(now_ns);
    Joints velocity;
    if (in.encoder_to_motor && follower_.is_fresh(in.encoder_to_motor->measured_ns) && in.robot_to_motor &&
        follower_.is_fresh(in.robot_to_motor->set_ns)) {
        const RobotToMotor& set = *in.robot_to_motor;
        velocity = follower_.follow(Joints{set.position.data()}, Joints{set.velocity.data()}, set.set_ns,
                                    Joints{in.encoder_to_motor->position.data()}, in.encoder_to_motor->measured_ns);
    } else {
        velocity = follower_.brake();
    }
    command_(now_ns, velocity);
    return true;
}

bool JointEncoders::acquire(const Cycle&, const In&, Out& out) {
    const std::int64_t now_ns = now_();
    const Vector6 position = values(read_(now_ns));
    out.encoder_to_robot = {position, now_ns};
    out.encoder_to_motor = {position, now_ns};
    return true;
}

}  // namespace placing_system
