// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/sweep_path.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/minimal_frame.h>
#include <lacuna/geometry/shared/polyline.h>

#include <algorithm>
#include <memory>

namespace lacuna::geometry {

namespace {

/// A point of a curve, and the direction of the curve there.
struct Place {
    Vec3 point, tangent;
};

/// Directions of a curve at its points: at each point, the tangent of the parabola through it and its two
/// neighbours.
std::vector<Vec3> tangents_at(const PathPart& points, const std::vector<double>& at)
{
    const std::size_t n = points.size();
    const auto chord = [&](std::size_t i) -> Vec3 {
        return (points[i + 1] - points[i]) / (at[i + 1] - at[i]);
    };
    std::vector<Vec3> tangents;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t k = std::clamp<std::size_t>(i, 1, std::max<std::size_t>(n - 2, 1));
        if (n == 2) {
            tangents.push_back(chord(0).normalized());
            continue;
        }
        const double before = at[k] - at[k - 1], after = at[k + 1] - at[k];
        const Vec3 bend = (chord(k) - chord(k - 1)) / (before + after);
        tangents.push_back((chord(k - 1) + (2 * at[i] - at[k - 1] - at[k]) * bend).normalized());
    }
    return tangents;
}

/// The rotation of rotation-minimising frames from one place of a curve to the next, by double reflection.
Eigen::Matrix3d double_reflection(const Place& from, const Place& to)
{
    const auto reflection = [](const Vec3& normal) -> Eigen::Matrix3d {
        return Eigen::Matrix3d::Identity() - 2 / normal.squaredNorm() * normal * normal.transpose();
    };
    const Vec3 step = to.point - from.point;
    if (!(step.norm() > 0)) return Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d first = reflection(step);
    const Vec3 second = to.tangent - first * from.tangent;
    if (!(second.norm() > kRoundoff)) return least_turn(from.tangent, to.tangent);
    return reflection(second) * first;
}

/// A smooth part with its frames.
class Part {
public:
    Part(const PathPart& points, double start)
        : points_(points), at_(arc_lengths(points)), tangents_(tangents_at(points, at_)), start_(start)
    {
    }

    [[nodiscard]] double length() const { return at_.back(); }
    [[nodiscard]] double start() const { return start_; }
    [[nodiscard]] Place first() const { return {points_.front(), tangents_.front()}; }
    [[nodiscard]] Place last() const { return {points_.back(), tangents_.back()}; }

    /// Largest rate of turning (turn per length), times the length of the part [radian].
    [[nodiscard]] double turn() const
    {
        double most = 0;
        for (std::size_t i = 0; i + 1 < points_.size(); ++i)
            most = std::max(most, angle_between(tangents_[i], tangents_[i + 1]) / (at_[i + 1] - at_[i]));
        return most * length();
    }

    /// @return  the frame at the end.
    Eigen::Matrix3d set_frames(const Eigen::Matrix3d& first)
    {
        frames_ = {first};
        for (std::size_t i = 0; i + 1 < points_.size(); ++i)
            frames_.emplace_back(double_reflection(knot(i), knot(i + 1)) * frames_.back());
        return frames_.back();
    }

    struct Frame {
        Vec3 point;
        Eigen::Matrix3d turned;
    };
    /// @param length  from the start of the part.
    [[nodiscard]] Frame frame(double length) const
    {
        const PolylinePlace at = place_at(at_, std::clamp(length, 0.0, at_.back()));
        const std::size_t i = at.segment;
        const double f = at.fraction, step = at_[i + 1] - at_[i];
        const Vec3 chord = points_[i + 1] - points_[i];
        const Vec3 low = step * tangents_[i] - chord, high = step * tangents_[i + 1] - chord;
        // Evaluate the cubic as a point of its chord, plus terms in the differences between its directions at
        // both ends and the chord. On a line these terms are zero bit for bit.
        const Vec3 point = points_[i] + f * chord + f * (1 - f) * ((1 - f) * low - f * high);
        const Vec3 tangent = chord + (1 - f) * (1 - 3 * f) * low - f * (2 - 3 * f) * high;
        return {point, double_reflection(knot(i), {point, tangent.normalized()}) * frames_[i]};
    }

    /// Shear of the section at the start and at the end of the part, caused by the corners there.
    Eigen::Matrix3d low_mitre = Eigen::Matrix3d::Zero(), high_mitre = Eigen::Matrix3d::Zero();

private:
    [[nodiscard]] Place knot(std::size_t i) const { return {points_[i], tangents_[i]}; }

    PathPart points_;
    std::vector<double> at_;
    std::vector<Vec3> tangents_;
    std::vector<Eigen::Matrix3d> frames_;
    double start_ = 0; ///< length of the path before this part
};

/// The projection of a section normal to `in`, along `in`, onto the plane that halves the corner.
Eigen::Matrix3d mitre(const Vec3& in, const Vec3& out)
{
    const Vec3 normal = (in + out).normalized();
    // maps v across `in` to v - in (v · normal) / (in · normal), and `in` itself to the normal
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - in * in.transpose();
    return (Eigen::Matrix3d::Identity() - in * normal.transpose() / in.dot(normal)) * across +
           normal * in.transpose();
}

std::vector<Part> parts_of(std::span<const PathPart> given)
{
    std::vector<Part> parts;
    double length = 0;
    for (const PathPart& points : given) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            if ((points[i + 1] - points[i]).norm() > 0) continue;
            throw InvalidInput(Message("geometry.path_short", "the path has two points at {}",
                                       found(place_with_digits(points[i], 6)))
                                   .remedy("leave one of them out"));
        }
        parts.emplace_back(points, length);
        length += parts.back().length();
    }
    return parts;
}

void set_mitres(std::vector<Part>& parts)
{
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Eigen::Matrix3d end = parts[i].set_frames(frame);
        if (i + 1 == parts.size()) break;
        const Vec3 in = parts[i].last().tangent, out = parts[i + 1].first().tangent;
        const double turn = angle_between(in, out);
        if (turn > kRightAngle + kFileAccuracy) {
            throw InvalidInput(Message("geometry.path_corner",
                                       "the path turns by {:.3g}° at {}, and corners are mitred up to {}°",
                                       found(turn / kDegree), place_with_digits(parts[i].last().point, 6),
                                       needed(90))
                                   .remedy("add a point that divides the corner, or use frame = \"fixed\""));
        }
        frame = least_turn(in, out) * end;
        const Eigen::Matrix3d halved = mitre(in, out) * end;
        parts[i].high_mitre = halved - end;
        parts[i + 1].low_mitre = halved - frame;
    }
}

} // namespace

Vec3 start_of_path(std::span<const PathPart> parts) { return Part(parts.front(), 0).first().tangent; }

Motion motion_along_path(std::span<const PathPart> given, SectionFrame frame)
{
    auto parts = std::make_shared<std::vector<Part>>(parts_of(given));
    const bool turns = frame == SectionFrame::minimal;
    if (turns)
        set_mitres(*parts);
    else
        for (Part& part : *parts) part.set_frames(Eigen::Matrix3d::Identity());
    const double length = parts->back().start() + parts->back().length();
    const Vec3 start = parts->front().first().point;
    Motion motion;
    motion.levels = {0};
    std::vector<double> turn;
    for (const Part& part : *parts) {
        motion.levels.push_back((part.start() + part.length()) / length);
        turn.push_back(part.turn());
    }
    motion.levels.back() = 1;
    motion.rows = motion.levels;
    divide_turns(motion, turn);
    motion.at = [parts = std::shared_ptr<const std::vector<Part>>(std::move(parts)), turns, length,
                 start](double height) {
        const double at = height * length;
        const auto next = std::ranges::find_if(*parts, [&](const Part& p) { return p.start() > at; });
        const Part& part = *(next == parts->begin() ? next : next - 1);
        const double along = at - part.start(), share = along / part.length();
        const Part::Frame section = part.frame(along);
        Eigen::Affine3d map = Eigen::Affine3d::Identity();
        map.linear() = turns ? Eigen::Matrix3d(section.turned + (1 - share) * part.low_mitre +
                                               share * part.high_mitre)
                             : Eigen::Matrix3d::Identity();
        map.translation() = section.point - map.linear() * start;
        return map;
    };
    return motion;
}

} // namespace lacuna::geometry
