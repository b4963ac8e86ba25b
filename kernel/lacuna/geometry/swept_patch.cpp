// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/swept_patch.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/minimal_frame.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/transfinite.h>

#include <algorithm>
#include <cmath>

namespace lacuna::geometry {

namespace {

/// Minimum length of the chord between left and right, as a share of the mean length of bottom and top, and
/// minimum sine of the angle between this chord and the sides. Below, the axes of a frame would be
/// unreliable.
constexpr double kShortChord = 0.1;

} // namespace

Vec3 SweptPatch::SideCurve::at(double f) const
{
    return point_at(points, arc, std::clamp(f, 0.0, 1.0) * arc.back());
}

Vec3 SweptPatch::SideCurve::tangent(double f) const
{
    return at(f + 1.0 / kFineChords) - at(f - 1.0 / kFineChords);
}

SweptPatch::SweptPatch(std::span<const Vec3> bottom, std::span<const Vec3> right, std::span<const Vec3> top,
                       std::span<const Vec3> left)
{
    const auto side = [](std::span<const Vec3> points) {
        return SideCurve{{points.begin(), points.end()}, arc_lengths(points)};
    };
    bottom_ = side(bottom);
    right_ = side(right);
    top_ = side(top);
    left_ = side(left);
    const double size = (bottom_.arc.back() + top_.arc.back()) / 2;
    for (int i = 0; i <= 10; ++i) {
        const Vec3 chord = right_.at(i / 10.0) - left_.at(i / 10.0);
        const Vec3 up = (left_.tangent(i / 10.0) + right_.tangent(i / 10.0));
        const bool clear = chord.norm() > kShortChord * size &&
                           chord.cross(up).norm() > kShortChord * chord.norm() * up.norm();
        turns_ = turns_ && clear;
    }
    if (!turns_ && is_bent_seam()) {
        turns_ = true;
        carry_frame();
    } else if (turns_) {
        first_ = frame(0);
        last_ = frame(1);
    }
}

bool SweptPatch::is_bent_seam() const
{
    const double reach = kSamePlace * left_.arc.back();
    const Vec3 along = (left_.points.back() - left_.points.front()).stableNormalized();
    double stray = 0;
    for (int i = 0; i <= kFineChords; ++i) {
        const Vec3 p = left_.at(static_cast<double>(i) / kFineChords);
        if ((p - right_.at(static_cast<double>(i) / kFineChords)).norm() > reach) return false;
        stray = std::max(stray, (p - left_.points.front()).cross(along).norm());
    }
    return stray > reach;
}

void SweptPatch::carry_frame()
{
    const auto tangent = [&](int i) {
        return Vec3(left_.tangent(static_cast<double>(i) / kFineChords).stableNormalized());
    };
    carried_.emplace_back(least_turn(Vec3::UnitZ(), tangent(0)));
    for (int i = 1; i <= kFineChords; ++i) {
        const auto step = Eigen::Quaterniond(least_turn(tangent(i - 1), tangent(i)));
        carried_.push_back((step * carried_.back()).normalized());
    }
    first_ = frame(0);
    last_ = frame(1);
    double along = 0, across = 0;
    for (int i = 0; i < kFineChords; ++i) {
        const double s = static_cast<double>(i) / kFineChords;
        const Vec3 b = first_.transpose() * (bottom_.at(s) - bottom_.points.front());
        const Vec3 e = last_.transpose() * (top_.at(s) - top_.points.front());
        along += b.head<2>().dot(e.head<2>());
        across += b.x() * e.y() - b.y() * e.x();
    }
    twist_ = std::atan2(across, along);
    last_ = frame(1);
}

Eigen::Matrix3d SweptPatch::frame(double t) const
{
    if (!carried_.empty()) {
        const double at = std::clamp(t, 0.0, 1.0) * kFineChords;
        const auto low = static_cast<std::size_t>(std::min(std::floor(at), kFineChords - 1.0));
        const Eigen::Quaterniond here = carried_[low].slerp(at - static_cast<double>(low), carried_[low + 1]);
        return here.toRotationMatrix() * Eigen::AngleAxisd(t * twist_, Vec3::UnitZ()).toRotationMatrix();
    }
    const Vec3 along = (right_.at(t) - left_.at(t)).normalized();
    const Vec3 up = left_.tangent(t).normalized() + right_.tangent(t).normalized();
    const Vec3 across = along.cross(up).normalized();
    Eigen::Matrix3d axes;
    axes << along, across.cross(along), across;
    return axes;
}

Vec3 SweptPatch::operator()(double s, double t) const
{
    const Vec3 l = left_.at(t), r = right_.at(t);
    const Vec3 b = bottom_.at(s), e = top_.at(s);
    const Vec3 b_chord = (1 - s) * bottom_.points.front() + s * bottom_.points.back();
    const Vec3 e_chord = (1 - s) * top_.points.front() + s * top_.points.back();
    const Vec3 chord = (1 - s) * l + s * r;
    if (!turns_) return chord + (1 - t) * (b - b_chord) + t * (e - e_chord);
    return chord + frame(t) * ((1 - t) * (first_.transpose() * (b - b_chord)) +
                               t * (last_.transpose() * (e - e_chord)));
}

double SweptPatch::unlike() const
{
    const Eigen::Matrix3d none = Eigen::Matrix3d::Identity();
    const auto deviation = [](const SideCurve& side, const Eigen::Matrix3d& frame, double s) {
        const Vec3 chord = (1 - s) * side.points.front() + s * side.points.back();
        return Vec3(frame.transpose() * (side.at(s) - chord) / side.arc.back());
    };
    double most = 0;
    for (int i = 1; i < kFineChords; ++i) {
        const double s = static_cast<double>(i) / kFineChords;
        most = std::max(
            most, (deviation(bottom_, turns_ ? first_ : none, s) - deviation(top_, turns_ ? last_ : none, s))
                      .norm());
    }
    return most;
}

std::vector<Vec3> swept_grid(std::span<const Vec3> bottom, std::span<const Vec3> right,
                             std::span<const Vec3> top, std::span<const Vec3> left)
{
    const SweptPatch patch(bottom, right, top, left);
    const std::size_t n = bottom.size() - 1, m = left.size() - 1;
    std::vector<Vec3> grid = transfinite(bottom, right, top, left);
    const CoonsPatch<Vec3> sides(bottom, right, top, left);
    for (std::size_t j = 1; j < m; ++j) {
        for (std::size_t i = 1; i < n; ++i) {
            const Vec2 st = sides.crossing(i, i, j, j);
            grid[j * (n + 1) + i] = patch(st.x(), st.y());
        }
    }
    return grid;
}

} // namespace lacuna::geometry
