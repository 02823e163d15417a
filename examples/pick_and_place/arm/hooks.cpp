// Parts to moves, moves to set-points, set-points to velocities.
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
    Parts& parts = out.parts;
    parts.count = 0;
    parts.captured_ns = in.image->captured_ns;
    for (const vision::Disc& disc : detector_.search(in.image->frame.view())) {
        if (parts.count < Parts::most) {
            parts.places[parts.count++] = on_table(disc.centre);
        }
    }
    return true;
}

// The nearest one that is not in the row yet.
bool PlacePlanner::choose(const Parts& parts) {
    double nearest = INFINITY;
    for (std::size_t i = 0; i < parts.count; ++i) {
        const Place& place = parts.places[i];
        const double distance = std::hypot(place.x, place.y);
        if (place.y < row_begins && distance < nearest) {
            nearest = distance;
            part_ = place;
        }
    }
    return nearest < INFINITY;
}

Moves PlacePlanner::move() const {
    using Kind = Moves::Kind;
    const Place& goal = row_[std::min(placed_, row_.size() - 1)];
    switch (step_) {
        case Step::over:
        case Step::up: return {number_, Kind::go, part_, travel};
        case Step::down: return {number_, Kind::go, part_, reach};
        case Step::close: return {number_, Kind::close, part_, reach};
        case Step::carry:
        case Step::rise: return {number_, Kind::go, goal, travel};
        case Step::lower: return {number_, Kind::go, goal, reach};
        case Step::open: return {number_, Kind::open, goal, reach};
        case Step::look:
        case Step::aside: break;
    }
    return {number_, Kind::open, part_, travel};
}

// What follows on the step that is done.
void PlacePlanner::next(const Progress& progress) {
    switch (step_) {
        case Step::up:
            if (!progress.holds) {
                ++missed_;
                step_ = Step::aside;
                return;
            }
            break;
        case Step::rise:
            ++placed_;
            step_ = Step::look;
            free_ns_ = progress.at_ns;
            return;
        case Step::aside:
            step_ = Step::look;
            free_ns_ = progress.at_ns;
            return;
        default: break;
    }
    step_ = static_cast<Step>(static_cast<int>(step_) + 1);
}

bool PlacePlanner::plan(const Cycle&, const In& in, Out& out) {
    if (!in.progress) {
        return false;
    }
    if (waits_ && in.progress->done == number_) {
        waits_ = false;
        next(*in.progress);
    }
    if (waits_) {
        return false;
    }
    if (step_ == Step::look) {
        if (placed_ == row_.size() || !in.parts || in.parts->captured_ns < free_ns_ || !choose(*in.parts)) {
            return false;
        }
        step_ = Step::over;
    }
    ++number_;
    waits_ = true;
    out.moves = move();
    if (sent_.size() < sent_.capacity()) {
        sent_.push_back({now_(), out.moves});
    }
    return true;
}

// Straight towards the place, the tool pointing down; true when it is there.
bool ToolMover::go(const Joints& measured, double dt) {
    const Eigen::Isometry3d tool = motion_.arm().camera(motion_.position());
    const Eigen::Vector3d to{move_.place.x, move_.place.y, move_.height};
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

bool ToolMover::control(const Cycle&, const In& in, Out& out) {
    if (!in.encoder_to_robot) {
        return false;
    }
    const std::int64_t now_ns = now_();
    const double dt = last_ns_ < 0 ? 0 : static_cast<double>(now_ns - last_ns_) * 1e-9;
    last_ns_ = now_ns;
    const Joints measured{in.encoder_to_robot->position.data()};
    if (in.moves && in.moves.fresh) {
        move_ = *in.moves;
        closed_ = move_.kind == Moves::Kind::go ? closed_ : move_.kind == Moves::Kind::close;
    }
    bool is_done = false;
    if (move_.number > done_ && move_.kind == Moves::Kind::go) {
        is_done = go(measured, dt);
    } else {
        motion_.step(measured, servo::Twist::Zero(), dt);
        is_done = in.grip && (closed_ ? in.grip->closed : in.grip->open);
    }
    done_ = is_done ? move_.number : done_;
    out.robot_to_motor = {values(motion_.position()), values(motion_.velocity()), now_ns};
    out.jaw_order = {closed_};
    out.progress = {done_, in.grip && in.grip->holds, now_ns};
    return true;
}

bool JawController::close(const Cycle&, const In& in, Out& out) {
    out.grip = jaw_(in.jaw_order && in.jaw_order->closed);
    return true;
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
