// The law's algebra, and what makes four points useless for it.
#include "groundstate/servo/visual_servo.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

namespace groundstate::servo {

Defect defect(const ImagePoints& seen, const Depths& depths) noexcept {
    Eigen::Matrix<double, 2, points> places;
    for (std::size_t i = 0; i < points; ++i) {
        if (!std::isfinite(seen[i].x) || !std::isfinite(seen[i].y) || !std::isfinite(depths[i])) {
            return Defect::not_finite;
        }
        if (depths[i] <= 0) {
            return Defect::behind_camera;
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (std::hypot(seen[i].x - seen[j].x, seen[i].y - seen[j].y) < distinct) {
                return Defect::coincident;
            }
        }
        places.col(static_cast<Eigen::Index>(i)) << seen[i].x, seen[i].y;
    }
    // The extents along the principal axes are the roots of the eigenvalues of the 2x2 matrix of second moments.
    const Eigen::Vector2d middle = places.rowwise().mean();
    const Eigen::Matrix2d moments = (places.colwise() - middle) * (places.colwise() - middle).transpose();
    const double half_trace = moments.trace() / 2;
    const double along = half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - moments.determinant()));
    const double across = moments.determinant() / along;
    return across < flat * flat * along ? Defect::collinear : Defect::none;
}

InteractionMatrix interaction_matrix(const ImagePoints& seen, const Depths& depths) noexcept {
    InteractionMatrix result;
    for (std::size_t i = 0; i < points; ++i) {
        const auto [x, y] = seen[i];
        const double z = depths[i];
        const auto row = static_cast<Eigen::Index>(2 * i);
        result.row(row) << -1 / z, 0, x / z, x * y, -(1 + x * x), y;
        result.row(row + 1) << 0, -1 / z, y / z, 1 + y * y, -x * y, -x;
    }
    return result;
}

double within(const Twist& twist, double most_velocity, double most_turning) noexcept {
    const double velocity = twist.head<3>().norm();
    const double turning = twist.tail<3>().norm();
    double factor = 1;
    if (velocity > most_velocity) {
        factor = most_velocity / velocity;
    }
    if (turning * factor > most_turning) {
        factor = most_turning / turning;
    }
    return factor;
}

Command control(const ServoSettings& settings, const View& present, const View& desired) noexcept {
    Command result;
    result.defect = defect(desired.seen, desired.depths);
    if (result.defect != Defect::none) {
        result.refusal = Refusal::desired;
        return result;
    }
    result.defect = defect(present.seen, present.depths);
    if (result.defect != Defect::none) {
        result.refusal = Refusal::seen;
        return result;
    }

    FeatureError error;
    for (std::size_t i = 0; i < points; ++i) {
        const auto row = static_cast<Eigen::Index>(2 * i);
        error[row] = present.seen[i].x - desired.seen[i].x;
        error[row + 1] = present.seen[i].y - desired.seen[i].y;
    }
    result.error = error.norm();

    InteractionMatrix matrix = InteractionMatrix::Zero();
    if (settings.interaction != Interaction::desired) {
        matrix += interaction_matrix(present.seen, present.depths);
    }
    if (settings.interaction != Interaction::current) {
        matrix += interaction_matrix(desired.seen, desired.depths);
    }
    if (settings.interaction == Interaction::mean) {
        matrix /= 2;
    }

    if (!matrix.allFinite() || !error.allFinite()) {
        result.refusal = Refusal::seen;
        result.defect = Defect::not_finite;
        return result;
    }
    // L^+ = (L^T L)^+ L^T, by the eigenvectors of L^T L, whose eigenvalues are the squared singular values.
    using Square = Eigen::Matrix<double, 6, 6>;
    const Eigen::SelfAdjointEigenSolver<Square> spectrum{Square{matrix.transpose() * matrix}};
    Twist components = spectrum.eigenvectors().transpose() * (matrix.transpose() * error);
    for (Eigen::Index i = 0; i < 6; ++i) {
        const double squared = std::max(0.0, spectrum.eigenvalues()[i]);
        const double damping = settings.damping * std::max(0.0, 1 - std::sqrt(squared) / settings.damp_below);
        const double divisor = squared + damping * damping;
        components[i] = divisor > 0 ? components[i] / divisor : 0;
    }
    const Twist way = spectrum.eigenvectors() * components;
    result.twist = -settings.gain(way.lpNorm<Eigen::Infinity>()) * way;
    if (!result.twist.allFinite()) {
        return {.error = result.error, .refusal = Refusal::seen, .defect = Defect::not_finite};
    }
    result.shortened = within(result.twist, settings.most_velocity, settings.most_turning);
    result.twist *= result.shortened;
    return result;
}

Depths depths_by_area(const ImagePoints& seen, const View& desired) noexcept {
    const double ratio = std::sqrt(area(desired.seen) / std::max(area(seen), 1e-12));
    Depths result = desired.depths;
    for (double& depth : result) {
        depth *= ratio;
    }
    return result;
}

}  // namespace groundstate::servo
