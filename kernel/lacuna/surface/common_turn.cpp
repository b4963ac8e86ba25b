// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/common_turn.h>

#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/minimal_frame.h>
#include <lacuna/surface/detail/linking_map.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::surface {

namespace {

/// Corresponding points of source and target, with the rim length that each represents.
struct RimPair {
    Vec3 source, target;
    double weight;
};

std::vector<RimPair> pairs_of(std::span<const LinkingSurface> links)
{
    std::vector<RimPair> pairs;
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

/// The rotation that maps the pairs' source points to their target points: area vectors onto each other
/// first, then the best rotation about them.
std::optional<Eigen::Matrix3d> fitted_turn(const std::vector<RimPair>& pairs, const Vec3& source_area,
                                           const Vec3& target_area)
{
    if (!(source_area.norm() > 0) || !(target_area.norm() > 0)) return std::nullopt;
    const Vec3 normal = target_area.normalized();
    const Eigen::Matrix3d upright = geometry::least_turn(source_area, target_area);

    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    double weight = 0;
    for (const RimPair& pair : pairs) {
        from += pair.weight * pair.source;
        to += pair.weight * pair.target;
        weight += pair.weight;
    }
    from /= weight;
    to /= weight;
    double along = 0, across = 0;
    for (const RimPair& pair : pairs) {
        Vec3 a = upright * (pair.source - from), b = pair.target - to;
        a -= a.dot(normal) * normal;
        b -= b.dot(normal) * normal;
        along += pair.weight * a.dot(b);
        across += pair.weight * normal.dot(a.cross(b));
    }
    // Concentric loops do not determine a rotation; centres within a thousandth of the section count as one.
    const double size2 = std::min(source_area.norm(), target_area.norm());
    if (std::hypot(along, across) < 1e-6 * weight * size2) return std::nullopt;
    return Eigen::AngleAxisd(std::atan2(across, along), normal).toRotationMatrix() * upright;
}

/// Integrates the common rotation along the walls, row by row.
class TurnTracker {
public:
    TurnTracker(const topology::OpenVolume& volume, std::span<const LinkingSurface> links)
        : links_(links), rings_(links.size())
    {
        for (const LinkingSurface& link : links) maps_.emplace_back(volume, link);
        for (std::size_t b = 0; b < links.size(); ++b) {
            for (std::size_t row = 0; row <= kRows; ++row)
                rings_[b].push_back(ring(volume.model, maps_[b], static_cast<double>(row) / kRows));
        }
    }

    /// For each linking surface, the s of the target end of its shortest path, relative to its start column.
    std::vector<double> branches()
    {
        std::vector<double> shift(links_.size(), 0.0);
        Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
        for (std::size_t row = 1; row <= kRows; ++row) {
            turn = step(row) * turn;
            for (std::size_t b = 0; b < links_.size(); ++b) {
                if (!links_[b].lines.empty()) continue;
                const double off = best_shift(rings_[b].front(), rings_[b][row], turn) - shift[b];
                shift[b] += off - std::round(off);
            }
        }
        std::vector<double> branches;
        for (std::size_t b = 0; b < links_.size(); ++b)
            branches.push_back(maps_[b].target_branch() - shift[b]);
        return branches;
    }

private:
    static constexpr std::size_t kRows = 32; ///< a full turn is resolved in steps of 11 degrees

    static std::vector<Vec3> ring(const topology::Model& model, const LinkingMap& map, double height)
    {
        std::vector<Vec3> points;
        for (std::size_t i = 0; i < kRingPoints; ++i) {
            const WallPosition place = map.locate(static_cast<double>(i) / kRingPoints,
                                                  map.from_even(height));
            points.push_back(points_at(model, place.face, std::array{place.at}).front());
        }
        return points;
    }

    /// The rotation from one row to the next: of the rings' centres, and of the rings' points if side lines
    /// relate them.
    [[nodiscard]] Eigen::Matrix3d step(std::size_t row) const
    {
        std::vector<RimPair> pairs;
        Vec3 low = Vec3::Zero(), high = Vec3::Zero();
        for (std::size_t b = 0; b < links_.size(); ++b) {
            const std::vector<Vec3>&from = rings_[b][row - 1], &to = rings_[b][row];
            low += geometry::newell_vector(from);
            high += geometry::newell_vector(to);
            const double weight = links_[b].source.length();
            if (links_[b].lines.empty()) {
                pairs.push_back({geometry::mean_point(from), geometry::mean_point(to), weight});
                continue;
            }
            for (std::size_t i = 0; i < kRingPoints; ++i)
                pairs.push_back({from[i], to[i], weight / kRingPoints});
        }
        return fitted_turn(pairs, low, high).value_or(geometry::least_turn(low, high));
    }

    std::span<const LinkingSurface> links_;
    std::vector<LinkingMap> maps_;
    std::vector<std::vector<std::vector<Vec3>>> rings_; ///< for each linking surface and row
};

} // namespace

std::vector<Vec3> round_points(const Chain& chain)
{
    std::vector<double> at;
    for (std::size_t i = 0; i < kRingPoints; ++i)
        at.push_back(chain.length() * static_cast<double>(i) / static_cast<double>(kRingPoints));
    return chain.points(at);
}

double best_shift(std::vector<Vec3> source, std::vector<Vec3> target, const Eigen::Matrix3d& turn)
{
    const Vec3 from = geometry::mean_point(source), to = geometry::mean_point(target);
    for (Vec3& p : source) p = turn * (p - from);
    for (Vec3& p : target) p -= to;
    std::vector<double> apart(kRingPoints, 0);
    for (std::size_t k = 0; k < kRingPoints; ++k) {
        for (std::size_t i = 0; i < kRingPoints; ++i)
            apart[k] += (source[i] - target[(i + k) % kRingPoints]).squaredNorm();
    }
    const auto best = static_cast<std::size_t>(std::ranges::min_element(apart) - apart.begin());
    const double low = apart[(best + kRingPoints - 1) % kRingPoints], high = apart[(best + 1) % kRingPoints];
    const double bend = low + high - 2 * apart[best];
    const double between = bend > 0 ? (low - high) / (2 * bend) : 0;
    const double share = (static_cast<double>(best) + between) / static_cast<double>(kRingPoints);
    return share - std::floor(share);
}

std::vector<std::optional<CommonTurn>> common_turns(const topology::OpenVolume& volume,
                                                    std::span<const LinkingSurface> links)
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
    const std::vector<double> branches = TurnTracker(volume, links).branches();
    for (std::size_t b = 0; b < links.size(); ++b) {
        const Chain &low = links[b].source, &high = links[b].target;
        if (!links[b].lines.empty()) continue;
        const double shift = best_shift(round_points(low), round_points(high), *turn);
        turns[b] = CommonTurn{shift * high.length(), branches[b]};
    }
    return turns;
}

} // namespace lacuna::surface
