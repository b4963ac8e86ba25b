// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/square_rows.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/pattern_search.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/plane_energy.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::quads::paving {
namespace {

/// A boundary side, the two nodes above it, and the target shape of its quad.
///
///     d ---- c
///     |      |
///     a ---- b    on the boundary
struct RowSide {
    Index a, b, c, d;
    Vec2 along;         ///< unit length, from a to b
    Lanes cosine, sine; ///< cosine and sine of the target angle at each corner
    double height;      ///< target height [length]
};

class RowSquarer {
public:
    /// @param sizes  whether to improve the lengths of sides too.
    RowSquarer(PlanarQuads& mesh, const PlanarRegion& region, std::span<const Symmetry> symmetries,
               bool sizes)
        : mesh_(mesh),
          symmetries_(symmetries),
          fixed_(region.points.size()),
          stars_(mesh.points.size(), mesh.quads),
          moved_(mesh.points.size(), 0),
          searched_(mesh.points.size(), 0)
    {
        collect(region);
        if (sizes && region.size) {
            for (const Vec2& p : mesh.points) asked_.push_back(region.size(p));
        }
        floor_ = std::max(kGood, least_scaled_jacobian(mesh.points, mesh.quads));
    }

    /// Move each node once. @return the largest move, as a share of the mean length of the node's sides
    double round()
    {
        double most = 0;
        for (const Index p : nodes_to_move()) {
            if (is_settled(p)) continue;
            const double way = move(p);
            ++searches_;
            for_images(p, [&](Index image) { (way > 0 ? moved_ : searched_)[index(image)] = searches_; });
            most = std::max(most, way);
        }
        return most;
    }

private:
    // - kGood: minimum scaled Jacobian of neighbouring quads.
    // - kOffRight (the sine of an angle) and kOffHeight: the deviations that the search aims at. They are
    //   stricter than kRowOffRight and kRowOffHeight.
    // - kShape: weight of the shape energy of the quads.
    // - kGivenUp: the cost at which the weight of a row is half.
    // - kShorter and kLonger: the range of side lengths that the search aims at, relative to the requested
    //   size.
    // Each was chosen from a few values: these give the most good rows on 70 outlines of the held family
    // (benchmarks/pave/) without worse quads between sharp corners.
    static constexpr double kGood = 0.7;
    static constexpr double kOffRight = 0.3, kOffHeight = 0.24, kShape = 0.002, kGivenUp = 0.5;
    static constexpr double kShorter = kShortestOfSize + 0.02, kLonger = kLongestOfSize - 0.05;

    [[nodiscard]] const Vec2& at(Index p) const { return mesh_.points[index(p)]; }

    /// Call `use` for a node and for each of its images.
    template <class Use>
    void for_images(Index p, const Use& use) const
    {
        use(p);
        for (const Symmetry& symmetry : symmetries_) use(symmetry.to[index(p)]);
    }

    /// Find the directions in which the current node may move, and the symmetries that map it to one of its
    /// neighbours.
    void set_images(Index p, std::span<const Spoke> star)
    {
        near_.clear();
        const Symmetry* own = nullptr; // a symmetry that maps the node to itself
        bool is_centre = false;
        for (const Symmetry& symmetry : symmetries_) {
            const Index image = symmetry.to[index(p)];
            const auto touches = [&](const Spoke& s) {
                return s.next == image || s.across == image || s.before == image;
            };
            if (image == p) {
                is_centre = own != nullptr || !symmetry.map.mirrors;
                own = &symmetry;
            } else if (std::ranges::any_of(star, touches)) {
                near_.push_back(&symmetry);
            }
        }
        kept_.clear();
        for (const Symmetry* symmetry : near_) kept_.push_back(at(symmetry->to[index(p)]));
        ways_ = geometry::all_around();
        if (own == nullptr) return;
        const double half = own->map.angle() / 2;
        const Vec2 along(std::cos(half), std::sin(half));
        axis_ = {along, -along};
        ways_ = is_centre ? std::span<const Vec2>() : std::span<const Vec2>(axis_);
    }

    /// Move the current node, and those of its images that are its neighbours.
    void place(Index p, const Vec2& x)
    {
        mesh_.points[index(p)] = x;
        for (const Symmetry* symmetry : near_) mesh_.points[index(symmetry->to[index(p)])] = symmetry->map(x);
    }

    void collect(const PlanarRegion& region)
    {
        std::vector<double> wanted(fixed_, 0);
        std::vector<char> possible(fixed_, 0);
        const std::vector<double> angles = boundary_angles(region);
        std::size_t node = 0;
        for (const auto& loop : region.loops) {
            for (const Index p : loop) {
                const auto quads = static_cast<Index>(stars_[index(p)].size());
                wanted[index(p)] = row_corner(angles[node], quads);
                possible[index(p)] = may_be_good(angles[node++], quads) ? 1 : 0;
            }
        }
        const std::vector<Index> opposite = mesh::opposite_sides(mesh_.quads,
                                                                 static_cast<Index>(mesh_.points.size()));
        of_node_.resize(mesh_.points.size());
        for (std::size_t side = 0; side < opposite.size(); ++side) {
            if (opposite[side] != mesh::kRimSide) continue;
            const Quad& quad = mesh_.quads[side / 4];
            const std::size_t k = side % 4;
            if (possible[index(quad[k])] == 0 || possible[index(quad[(k + 1) % 4])] == 0) continue;
            RowSide row{quad[k], quad[(k + 1) % 4], quad[(k + 2) % 4], quad[(k + 3) % 4], {}, {}, {}, 0};
            const double length = (at(row.b) - at(row.a)).norm();
            row.along = (at(row.b) - at(row.a)) / length;
            row.height = length;
            if (region.size) {
                // Where given sides do not have the requested length, their length determines the height of
                // the row.
                const double asked = region.size((at(row.a) + at(row.b)) / 2);
                row.height = std::clamp(asked, length / kLongestOfSize, length / kShortestOfSize);
            }
            const double first = wanted[index(row.a)], second = wanted[index(row.b)];
            row.cosine = Lanes{std::cos(first), std::cos(second), -std::cos(second), -std::cos(first)};
            row.sine = Lanes{std::sin(first), std::sin(second), std::sin(second), std::sin(first)};
            for (const Index p : {row.c, row.d}) {
                if (index(p) >= fixed_) of_node_[index(p)].push_back(static_cast<Index>(rows_.size()));
            }
            rows_.push_back(row);
        }
    }

    /// For each corner: the sine of the deviation from its ideal angle, minus the limit, squared. If the
    /// deviation exceeds a right angle, its sine counts as 1.
    LACUNA_INLINE void beyond_right(const RowSide& row, Lanes& beyond) const
    {
        const Vec2 &a = at(row.a), &b = at(row.b), &c = at(row.c), &d = at(row.d);
        const Lanes outx{b.x() - a.x(), c.x() - b.x(), d.x() - c.x(), a.x() - d.x()},
            outy{b.y() - a.y(), c.y() - b.y(), d.y() - c.y(), a.y() - d.y()};
        const Lanes lastx{outx[3], outx[0], outx[1], outx[2]}, lasty{outy[3], outy[0], outy[1], outy[2]};
        const Lanes squared = (outx * outx + outy * outy) * (lastx * lastx + lasty * lasty);
        const Lanes lengths{std::sqrt(squared[0]), std::sqrt(squared[1]), std::sqrt(squared[2]),
                            std::sqrt(squared[3])};
        const Lanes cosine = -(outx * lastx + outy * lasty) / lengths,
                    sine = (outy * lastx - outx * lasty) / lengths;
        const Lanes off = sine * row.cosine - cosine * row.sine, size = off < 0 ? -off : off;
        const Lanes most = sine * row.sine + cosine * row.cosine > 0 ? size : Lanes{1, 1, 1, 1};
        beyond = most > kOffRight ? (most - kOffRight) * (most - kOffRight) : Lanes{};
    }

    [[nodiscard]] LACUNA_INLINE double cost_of(const RowSide& row) const
    {
        double cost = 0;
        Lanes right;
        beyond_right(row, right);
        for (std::size_t k = 0; k < 4; ++k) cost += right[k];
        for (const Index p : {row.c, row.d}) { // the ends of the upper side
            const double off = std::abs(cross(row.along, at(p) - at(row.a)) / row.height - 1);
            if (off > kOffHeight) cost += (off - kOffHeight) * (off - kOffHeight);
        }
        if (cost == 0) return 0;
        // The cost is bounded. Otherwise a good row might be sacrificed to improve a row that stays bad.
        return cost * kGivenUp / (cost + kGivenUp);
    }

    /// Whether a node did not move in its last search, and nothing around it has moved since then. A new
    /// search would then have the same result.
    [[nodiscard]] bool is_settled(Index p) const
    {
        const std::size_t when = searched_[index(p)];
        const auto is_newer = [&](Index q) { return moved_[index(q)] > when; };
        return when > moved_[index(p)] && std::ranges::none_of(stars_[index(p)], [&](const Spoke& s) {
                   return is_newer(s.next) || is_newer(s.across) || is_newer(s.before);
               });
    }

    /// Cost of the lengths of a node's sides.
    [[nodiscard]] double cost_of_sizes(Index p) const
    {
        if (asked_.empty()) return 0;
        double cost = 0;
        for (const Spoke& spoke : stars_[index(p)]) {
            const double asked = (asked_[index(p)] + asked_[index(spoke.next)]) / 2;
            const double length = (at(spoke.next) - at(p)).norm() / asked;
            const double off = std::max({0.0, kShorter - length, length - kLonger});
            cost += off * off;
        }
        return cost;
    }

    /// The nodes of row quads that exceed their limits, the nodes of all quads around these, and the ends of
    /// sides that are too short or too long. If several nodes are images of each other, only the first of
    /// them is included.
    [[nodiscard]] std::vector<Index> nodes_to_move() const
    {
        std::vector<char> moves(mesh_.points.size(), 0);
        for (const RowSide& row : rows_) {
            if (!(cost_of(row) > 0)) continue;
            for (const Index p : {row.c, row.d}) {
                moves[index(p)] = 1;
                for (const Spoke& spoke : stars_[index(p)])
                    moves[index(spoke.next)] = moves[index(spoke.across)] = 1;
            }
        }
        for (std::size_t p = fixed_; p < asked_.size(); ++p) {
            if (cost_of_sizes(static_cast<Index>(p)) > 0) moves[p] = 1;
        }
        std::vector<Index> nodes;
        for (std::size_t p = fixed_; p < moves.size(); ++p) {
            if (moves[p] == 0) continue;
            Index first = static_cast<Index>(p);
            for_images(first, [&](Index image) { first = std::min(first, image); });
            if (moves[index(first)] == 2) continue;
            moves[index(first)] = 2;
            nodes.push_back(first);
        }
        return nodes;
    }

    /// Cost of the quads around the current node, if it is below a bound. Otherwise a number that is not
    /// below the bound. Compiled for the widest vectors of the machine; the results are bit-identical on all
    /// machines.
    [[nodiscard]] double cost_above(Index p, double bound) const
    {
        return with_avx2([&]() LACUNA_INLINE_BODY { return sum_up(p, bound); });
    }

    [[nodiscard]] LACUNA_INLINE double sum_up(Index p, double bound) const
    {
        double cost = cost_of_sizes(p);
        for (const Index row : of_node_[index(p)]) {
            if (cost >= bound) return cost;
            cost += cost_of(rows_[index(row)]);
        }
        lanes_.add_shapes(cost, at(p), kShape, bound);
        return cost;
    }

    /// @return length of the move, as a share of the mean length of the node's sides.
    double move(Index p)
    {
        // First and last step, as shares of the mean side. Not measured.
        constexpr double kFirst = 0.08, kLast = 0.009;
        const auto star = stars_[index(p)];
        double side = 0;
        for (const Spoke& spoke : star)
            side += (at(spoke.next) - at(p)).norm() / static_cast<double>(star.size());
        const Vec2 start = at(p);
        const double floor = std::min(floor_, least_sine(mesh_.points, star, start));
        lanes_.set(mesh_.points, star, index(p), {});
        set_images(p, star);
        const auto value = [&](const Vec2& to, double least) {
            place(p, to);
            if (!near_.empty()) lanes_.set(mesh_.points, star, index(p), {});
            const double cost = cost_above(p, -least);
            return cost < -least && least_sine(mesh_.points, star, at(p)) >= floor ? -cost : least;
        };
        Vec2 x = start;
        geometry::pattern_search(x, -cost_above(p, kInfinity), {side, 0, kFirst, kLast}, value, ways_);
        place(p, x);
        if (x == start) {
            for (std::size_t i = 0; i < near_.size(); ++i)
                mesh_.points[index(near_[i]->to[index(p)])] = kept_[i];
            return 0;
        }
        for (const Symmetry& symmetry : symmetries_) {
            if (symmetry.to[index(p)] != p) mesh_.points[index(symmetry.to[index(p)])] = symmetry.map(at(p));
        }
        return (at(p) - start).norm() / side;
    }

    PlanarQuads& mesh_;
    std::span<const Symmetry> symmetries_;
    /// Symmetries that map the current node to one of its neighbours, see `set_images()`.
    std::vector<const Symmetry*> near_;
    std::vector<Vec2> kept_;     ///< positions of these neighbours before the search
    std::span<const Vec2> ways_; ///< directions in which the current node may move
    std::array<Vec2, 2> axis_;
    std::size_t fixed_;
    Stars stars_;
    StarLanes lanes_; ///< the star of the current node
    std::vector<RowSide> rows_;
    std::vector<std::vector<Index>> of_node_; ///< for each node above the boundary, its rows
    std::vector<double> asked_;               ///< requested size at each node, if sizes count
    std::size_t searches_ = 0;
    /// Searches are numbered. For each node: the number of the last search that moved the node, and the
    /// number of the node's last search.
    std::vector<std::size_t> moved_, searched_;
    double floor_ = kGood;
};

/// Value of a mesh for comparison, see `square_rows()`. The part of a share above `kPromisedShare` counts
/// only a quarter, so that it does not outweigh poor quads.
double worth_of(const PlaneQuality& quality)
{
    constexpr double kBeyond = 0.25;
    const auto share = [](double x) {
        return std::min(x, kPromisedShare) + kBeyond * std::max(0.0, x - kPromisedShare);
    };
    return quality.mean_scaled_jacobian + share(quality.row_share()) / 2 + share(quality.size_share()) / 2;
}

/// Move nodes as long as this increases the value of the mesh.
/// @param quality  quality of the mesh; updated.
void improve(PlanarQuads& mesh, const PlanarRegion& region, std::span<const Symmetry> symmetries, bool sizes,
             PlaneQuality& quality)
{
    const PlaneQuality before = quality;
    const double rounding = symmetries.empty() ? 0 : kFileAccuracy;
    const auto keeps = [](double was, double is) { return is >= kPromisedShare || was < kPromisedShare; };
    PlanarQuads made = mesh;
    RowSquarer squarer(made, region, symmetries, sizes);
    for (int round = 0, idle = 0; round < kMostSteps && idle < kIdleRounds; ++round, ++idle) {
        const double most = squarer.round();
        const PlaneQuality after = measure_plane(made, region);
        if (worth_of(after) > worth_of(quality) &&
            after.mean_scaled_jacobian >= before.mean_scaled_jacobian - kAlikeSizes &&
            after.min_scaled_jacobian >= before.min_scaled_jacobian - rounding &&
            keeps(before.row_share(), after.row_share()) && keeps(before.size_share(), after.size_share())) {
            quality = after;
            idle = -1;
            mesh.points = made.points;
        }
        if (most == 0) break;
    }
}

} // namespace

void square_rows(PlanarQuads& mesh, const PlanarRegion& region, std::span<const Symmetry> symmetries)
{
    PlaneQuality quality = measure_plane(mesh, region);
    if (quality.good_rows < quality.possible_rows) improve(mesh, region, symmetries, false, quality);
    if (quality.size_share() < kPromisedShare) improve(mesh, region, symmetries, true, quality);
}

} // namespace lacuna::quads::paving
