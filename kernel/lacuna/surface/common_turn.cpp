// SPDX-License-Identifier: MIT
#include <lacuna/surface/common_turn.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

namespace {

constexpr std::size_t kSamples = 96; ///< round a rim; a parabola finds the place between them

std::vector<Vec3> round_points(const Chain& chain)
{
    std::vector<double> at;
    for (std::size_t i = 0; i < kSamples; ++i)
        at.push_back(chain.length() * static_cast<double>(i) / static_cast<double>(kSamples));
    return chain.points(at);
}

Vec3 centre_of(const std::vector<Vec3>& points)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) sum += p;
    return sum / static_cast<double>(points.size());
}

Vec3 area_of(const std::vector<Vec3>& points)
{
    Vec3 sum = Vec3::Zero();
    const Vec3 centre = centre_of(points);
    for (std::size_t i = 0; i < points.size(); ++i)
        sum += (points[i] - centre).cross(points[(i + 1) % points.size()] - centre) / 2;
    return sum;
}

/// Places of source and target that belong together, with the length of rim they stand for.
struct Pair {
    Vec3 source, target;
    double weight;
};

std::vector<Pair> pairs_of(std::span<const Belt> belts)
{
    std::vector<Pair> pairs;
    for (const Belt& belt : belts) {
        if (belt.lines.empty()) {
            pairs.push_back({centre_of(round_points(belt.source)), centre_of(round_points(belt.target)),
                             belt.source.length()});
            continue;
        }
        for (const Stretch& stretch : belt.stretches) {
            const double s[] = {stretch.source_from};
            const double t[] = {std::fmod(stretch.target_from, belt.target.length())};
            pairs.push_back({belt.source.points(s).front(), belt.target.points(t).front(),
                             stretch.source_to - stretch.source_from});
        }
    }
    return pairs;
}

/// The rotation that takes source to target: normals onto each other, then the best turn about them.
std::optional<Eigen::Matrix3d> common_turn(std::span<const Belt> belts)
{
    Vec3 source_area = Vec3::Zero(), target_area = Vec3::Zero();
    for (const Belt& belt : belts) {
        source_area += area_of(round_points(belt.source));
        target_area += area_of(round_points(belt.target));
    }
    if (!(source_area.norm() > 0) || !(target_area.norm() > 0)) return std::nullopt;
    const Vec3 normal = target_area.normalized();
    const Eigen::Matrix3d upright =
        Eigen::Quaterniond::FromTwoVectors(source_area, target_area).toRotationMatrix();

    const std::vector<Pair> pairs = pairs_of(belts);
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    double weight = 0;
    for (const Pair& pair : pairs) {
        from += pair.weight * pair.source;
        to += pair.weight * pair.target;
        weight += pair.weight;
    }
    from /= weight;
    to /= weight;
    double along = 0, across = 0;
    for (const Pair& pair : pairs) {
        Vec3 a = upright * (pair.source - from), b = pair.target - to;
        a -= a.dot(normal) * normal;
        b -= b.dot(normal) * normal;
        along += pair.weight * a.dot(b);
        across += pair.weight * normal.dot(a.cross(b));
    }
    // Loops about one centre say nothing of a turn; a thousandth of the section is as good as one centre.
    const double size2 = std::min(source_area.norm(), target_area.norm());
    if (std::hypot(along, across) < 1e-6 * weight * size2) return std::nullopt;
    return Eigen::AngleAxisd(std::atan2(across, along), normal).toRotationMatrix() * upright;
}

/// The shift of the target's share of length against the source's that leaves the turned rims closest.
double best_start(const Belt& belt, const Eigen::Matrix3d& turn)
{
    std::vector<Vec3> source = round_points(belt.source), target = round_points(belt.target);
    const Vec3 from = centre_of(source), to = centre_of(target);
    for (Vec3& p : source) p = turn * (p - from);
    for (Vec3& p : target) p -= to;
    std::vector<double> apart(kSamples, 0);
    for (std::size_t k = 0; k < kSamples; ++k) {
        for (std::size_t i = 0; i < kSamples; ++i)
            apart[k] += (source[i] - target[(i + k) % kSamples]).squaredNorm();
    }
    const auto best = static_cast<std::size_t>(std::min_element(apart.begin(), apart.end()) - apart.begin());
    const double low = apart[(best + kSamples - 1) % kSamples], high = apart[(best + 1) % kSamples];
    const double bend = low + high - 2 * apart[best];
    const double between = bend > 0 ? (low - high) / (2 * bend) : 0;
    const double share = (static_cast<double>(best) + between) / static_cast<double>(kSamples);
    return (share - std::floor(share)) * belt.target.length();
}

} // namespace

std::vector<std::optional<double>> common_turn_starts(std::span<const Belt> belts)
{
    std::vector<std::optional<double>> starts(belts.size());
    const bool free = std::any_of(belts.begin(), belts.end(), [](const Belt& b) { return b.lines.empty(); });
    if (!free || belts.size() < 2) return starts;
    const std::optional<Eigen::Matrix3d> turn = common_turn(belts);
    for (std::size_t b = 0; turn && b < belts.size(); ++b) {
        if (belts[b].lines.empty()) starts[b] = best_start(belts[b], *turn);
    }
    return starts;
}

} // namespace lacuna::surface
