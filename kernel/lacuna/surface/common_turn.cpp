// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/common_turn.h>

#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/minimal_frame.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::surface {

namespace {

/// Corresponding points of source and target, and the length of the rim that the pair represents.
struct RimPlaces {
    Vec3 source, target;
    double weight;
};

std::vector<RimPlaces> pairs_of(std::span<const LinkingSurface> links)
{
    std::vector<RimPlaces> pairs;
    for (const LinkingSurface& link : links) {
        if (link.lines.empty()) {
            pairs.push_back({geometry::mean_point(round_points(link.source)),
                             geometry::mean_point(round_points(link.target)), link.source.length()});
            continue;
        }
        for (const RimSegment& segment : link.segments) {
            const std::array s{segment.source_from}, t{std::fmod(segment.target_from, link.target.length())};
            pairs.push_back({link.source.points(s).front(), link.target.points(t).front(),
                             segment.source_to - segment.source_from});
        }
    }
    return pairs;
}

/// The rotation that best maps the source points of pairs onto their target points: the smallest rotation of
/// the source's area vector onto the target's area vector, followed by a rotation about the latter by the
/// best angle. Empty if the pairs do not determine this angle.
std::optional<Eigen::Matrix3d> fitted_turn(const std::vector<RimPlaces>& pairs, const Vec3& source_area,
                                           const Vec3& target_area)
{
    if (!(source_area.norm() > 0) || !(target_area.norm() > 0)) return std::nullopt;
    const Vec3 normal = target_area.normalized();
    const Eigen::Matrix3d upright = geometry::least_turn(source_area, target_area);

    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    double weight = 0;
    for (const RimPlaces& pair : pairs) {
        from += pair.weight * pair.source;
        to += pair.weight * pair.target;
        weight += pair.weight;
    }
    from /= weight;
    to /= weight;
    double along = 0, across = 0;
    for (const RimPlaces& pair : pairs) {
        Vec3 a = upright * (pair.source - from), b = pair.target - to;
        a -= a.dot(normal) * normal;
        b -= b.dot(normal) * normal;
        along += pair.weight * a.dot(b);
        across += pair.weight * normal.dot(a.cross(b));
    }
    // Concentric loops do not determine the angle. Loops count as concentric if their centres are closer to
    // each other than a thousandth of the section's size.
    const double size2 = std::min(source_area.norm(), target_area.norm());
    if (std::hypot(along, across) < 1e-6 * weight * size2) return std::nullopt;
    return Eigen::AngleAxisd(std::atan2(across, along), normal).toRotationMatrix() * upright;
}

} // namespace

std::vector<Vec3> round_points(const Chain& chain)
{
    std::vector<double> at;
    for (int i = 0; i < kFineChords; ++i) at.push_back(chain.length() * i / kFineChords);
    return chain.points(at);
}

double best_shift(std::vector<Vec3> source, std::vector<Vec3> target, const Eigen::Matrix3d& turn)
{
    const Vec3 from = geometry::mean_point(source), to = geometry::mean_point(target);
    for (Vec3& p : source) p = turn * (p - from);
    for (Vec3& p : target) p -= to;
    const std::size_t n = source.size();
    std::vector<double> apart(n, 0);
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < n; ++i) apart[k] += (source[i] - target[(i + k) % n]).squaredNorm();
    }
    const auto best = static_cast<std::size_t>(std::ranges::min_element(apart) - apart.begin());
    const double low = apart[(best + n - 1) % n], high = apart[(best + 1) % n];
    const double bend = low + high - 2 * apart[best];
    const double between = bend > 0 ? (low - high) / (2 * bend) : 0;
    const double share = (static_cast<double>(best) + between) / static_cast<double>(n);
    return share - std::floor(share);
}

std::vector<std::optional<CommonTurn>> common_turns(std::span<const LinkingSurface> links)
{
    std::vector<std::optional<CommonTurn>> turns(links.size());
    const bool free = std::ranges::any_of(links, [](const LinkingSurface& b) { return b.lines.empty(); });
    if (!free || links.size() < 2) return turns;
    Vec3 source_area = Vec3::Zero(), target_area = Vec3::Zero();
    for (const LinkingSurface& link : links) {
        source_area += geometry::newell_vector(round_points(link.source));
        target_area += geometry::newell_vector(round_points(link.target));
    }
    const std::optional<Eigen::Matrix3d> turn = fitted_turn(pairs_of(links), source_area, target_area);
    if (!turn) return turns;
    for (std::size_t b = 0; b < links.size(); ++b) {
        const Chain &low = links[b].source, &high = links[b].target;
        if (!links[b].branch) continue;
        const double shift = best_shift(round_points(low), round_points(high), *turn);
        const double off = shift - links[b].segments.front().target_from / high.length();
        turns[b] = CommonTurn{shift * high.length(), *links[b].branch - std::remainder(off, 1.0)};
    }
    return turns;
}

} // namespace lacuna::surface
