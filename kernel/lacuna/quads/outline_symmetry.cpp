// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/outline_symmetry.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/predicates.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace lacuna::quads {
namespace {

Vec2 middle_of(const PlanarRegion& region)
{
    Vec2 centre = Vec2::Zero();
    for (const Vec2& p : region.points) centre += p / static_cast<double>(region.points.size());
    return centre;
}

double extent_of(const PlanarRegion& region, const Vec2& centre)
{
    double extent = 0;
    for (const Vec2& p : region.points) extent = std::max(extent, (p - centre).norm());
    return extent;
}

class OutlineFinder {
public:
    explicit OutlineFinder(const PlanarRegion& region)
        : region_(region), centre_(middle_of(region)), alike_(kFileAccuracy * extent_of(region, centre_))
    {
    }

    std::vector<Symmetry> run() const
    {
        std::vector<Symmetry> found = all();
        // Maximum number of rotations, which limits the time. More rotations would not improve the mesh.
        constexpr std::size_t kMostTurns = 64;
        const auto turns = 1 + static_cast<std::size_t>(std::ranges::count_if(
                                   found, [](const Symmetry& s) { return !s.map.mirrors; }));
        if (turns <= kMostTurns) return found;
        // Keep the quarter turns, if there are any.
        const std::size_t quarters = std::gcd(turns, std::size_t{4});
        std::size_t every = (turns + kMostTurns - 1) / kMostTurns;
        while (turns % every != 0 || turns / every % quarters != 0) ++every;
        const Index first = region_.loops[0][0];
        const auto through = std::ranges::find_if(
            found, [&](const Symmetry& s) { return s.map.mirrors && s.to[index(first)] == first; });
        const bool has_axis = through != found.end();
        const double axis = has_axis ? through->map.angle() : 0;
        const double step = kFullTurn * static_cast<double>(every) / static_cast<double>(turns);
        std::erase_if(found, [&](const Symmetry& s) {
            if (s.map.mirrors && !has_axis) return true;
            const double off = std::remainder(s.map.angle() - (s.map.mirrors ? axis : 0), step);
            return std::abs(off) > 0.01 * step / static_cast<double>(every); // far below one step
        });
        return found;
    }

private:
    [[nodiscard]] std::vector<Symmetry> all() const
    {
        std::vector<Symmetry> found;
        const std::vector<Index>& loop = region_.loops[0];
        std::size_t far = 0;
        for (std::size_t i = 1; i < loop.size(); ++i) {
            if ((at(loop[i]) - centre_).norm() > (at(loop[far]) - centre_).norm() + alike_) far = i;
        }
        const Vec2 first = at(loop[far]) - centre_;
        const std::size_t n = loop.size();
        for (const bool mirrors : {false, true}) {
            for (std::size_t k = mirrors ? 0 : 1; k < n; ++k) {
                const Vec2 image = at(loop[(far + k) % n]) - centre_;
                if (std::abs(image.norm() - first.norm()) > alike_) continue;
                const double y = mirrors ? -first.y() : first.y();
                Vec2 turn(first.x() * image.x() + y * image.y(), first.x() * image.y() - y * image.x());
                turn.normalize();
                Symmetry symmetry{{centre_, turn.x(), turn.y(), mirrors},
                                  std::vector<Index>(region_.points.size(), -1)};
                const std::size_t shift = mirrors ? 2 * far + k : k;
                if (maps_loop(symmetry, loop, loop, shift % n) && maps_holes(symmetry))
                    found.push_back(std::move(symmetry));
            }
        }
        return found;
    }

    [[nodiscard]] const Vec2& at(Index p) const { return region_.points[index(p)]; }
    [[nodiscard]] bool is_at(const Isometry& map, Index p, Index q) const
    {
        return (map(at(p)) - at(q)).squaredNorm() <= alike_ * alike_;
    }

    [[nodiscard]] bool maps_loop(Symmetry& symmetry, const std::vector<Index>& loop,
                                 const std::vector<Index>& onto, std::size_t k) const
    {
        const std::size_t n = loop.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Index to = onto[symmetry.map.mirrors ? (k + n - i) % n : (k + i) % n];
            if (!is_at(symmetry.map, loop[i], to)) return false;
            symmetry.to[index(loop[i])] = to;
        }
        return true;
    }

    [[nodiscard]] bool maps_holes(Symmetry& symmetry) const
    {
        for (std::size_t l = 1; l < region_.loops.size(); ++l) {
            const std::vector<Index>& loop = region_.loops[l];
            bool found = false;
            for (std::size_t m = 1; m < region_.loops.size() && !found; ++m) {
                const std::vector<Index>& onto = region_.loops[m];
                for (std::size_t k = 0; onto.size() == loop.size() && k < onto.size() && !found; ++k)
                    found = is_at(symmetry.map, loop[0], onto[k]) && maps_loop(symmetry, loop, onto, k);
            }
            if (!found) return false;
        }
        return true;
    }

    const PlanarRegion& region_;
    Vec2 centre_;
    double alike_;
};

/// A mirror axis and the angle of its direction, 0…π.
struct Axis {
    double angle = 0;
    /// Rank of the axis: twice the number of loops that the reflection maps onto themselves, plus one if the
    /// axis passes through the first node.
    int worth = 0;
    std::size_t symmetry = 0;
};

/// Number of sides that the size requires along a line.
double sides_along(const Vec2& from, const Vec2& to, const SizeField& size)
{
    double sum = 0;
    for (int i = 0; i < kFineChords; ++i) sum += 1 / size(from + (i + 0.5) / kFineChords * (to - from));
    return sum * (to - from).norm() / kFineChords;
}

/// Cuts a region between two rays from its centre. Two opposite rays form one line.
class PartCutter {
public:
    PartCutter(const PlanarRegion& region, const Vec2& centre, double from, double to, bool has_centre)
        : region_(region),
          centre_(centre),
          alike_(kFileAccuracy * extent_of(region, centre)),
          ray_{Vec2(std::cos(from), std::sin(from)), Vec2(std::cos(to), std::sin(to))},
          is_half_(to - from > std::numbers::pi - 1e-9),
          has_centre_(has_centre)
    {
    }

    std::optional<MirrorPart> run(const SizeField& size)
    {
        if (!collect()) return std::nullopt;
        part_.has_centre = has_centre_;
        part_.region.size = region_.size;
        part_.region.row_height = region_.row_height;
        for (const std::vector<Index>& loop : whole_loops_) {
            part_.region.loops.emplace_back();
            for (const Index p : loop) push(p);
        }
        while (!chains_.empty()) {
            if (!join_chains(size)) return std::nullopt;
        }
        return sort_loops() ? std::optional(std::move(part_)) : std::nullopt;
    }

private:
    [[nodiscard]] Vec2 arm(Index p) const { return region_.points[index(p)] - centre_; }
    /// Distance of a point from a ray; positive on the side of the part.
    [[nodiscard]] double within(const Vec2& d, int ray) const
    {
        return ray == 0 ? cross(ray_[0], d) : cross(d, ray_[1]);
    }
    [[nodiscard]] bool is_inside(const Vec2& d) const
    {
        return within(d, 0) > alike_ && within(d, 1) > alike_;
    }
    /// 1 or 2 for a point on a ray, otherwise 0.
    [[nodiscard]] char ray_of(const Vec2& d) const
    {
        for (int r = 0; r < 2; ++r) {
            if (std::abs(within(d, r)) <= alike_ && d.dot(ray_[static_cast<std::size_t>(r)]) > 0)
                return static_cast<char>(r + 1);
        }
        return 0;
    }

    /// Collect the loops inside the part, and the pieces of loops between their crossings with the rays.
    bool collect()
    {
        for (const std::vector<Index>& loop : region_.loops) {
            const std::size_t n = loop.size();
            std::vector<char> in(n);
            for (std::size_t i = 0; i < n; ++i) {
                if (arm(loop[i]).norm() <= alike_) return false;
                const Vec2 a = arm(loop[i]), b = arm(loop[(i + 1) % n]);
                in[i] = is_inside((a + b) / 2) ? 1 : 0;
                // If a side crosses a ray, its middle and one of its ends are on different sides of the ray.
                for (const Vec2& d : {a, b}) {
                    if (in[i] && !is_inside(d) && ray_of(d) == 0) return false;
                }
            }
            const auto out = static_cast<std::size_t>(std::ranges::find(in, 0) - in.begin());
            if (out == n) {
                whole_loops_.push_back(loop);
                // A loop that only touches a ray cannot be cut there.
                for (const Index p : loop)
                    if (ray_of(arm(p)) != 0) return false;
                continue;
            }
            for (std::size_t k = 1; k <= n; ++k) {
                const std::size_t i = (out + k) % n, before = (i + n - 1) % n;
                if (!in[i]) continue;
                const char ray = ray_of(arm(loop[i]));
                if (!in[before] || ray != 0) {
                    if (ray == 0) return false;
                    chains_.push_back({loop[i]});
                }
                chains_.back().push_back(loop[(i + 1) % n]);
            }
        }
        return !chains_.empty() && std::ranges::none_of(chains_, [&](const auto& chain) {
            return ray_of(arm(chain.back())) == 0;
        });
    }

    void push(Index whole) { part_.add(region_.points[index(whole)], whole, -1, ray_of(arm(whole))); }

    /// Walk around one loop of the part, along chains and axes in turn.
    bool join_chains(const SizeField& size)
    {
        part_.region.loops.emplace_back();
        const Index start = chains_.front().front();
        auto at = chains_.begin();
        while (true) {
            const std::vector<Index> chain = *at;
            chains_.erase(at);
            for (const Index p : chain) push(p);
            // Continue along the ray to the next place where it meets the region's boundary, and with the
            // chain that starts there.
            Vec2 from = region_.points[index(chain.back())];
            char ray = ray_of(from - centre_);
            auto next = next_start(ray, (ray == 1 ? 1 : -1) * (from - centre_).norm(), start);
            if (!next && ray == 2 && has_centre_) { // continue across the centre to the other ray
                next = next_start(1, 0, start);
                if (next && !is_half_) {
                    walk_axis(from, centre_, 2, size);
                    part_.add(centre_, -1, -1, 3);
                    from = centre_;
                }
                ray = 1;
            }
            if (!next) return false;
            walk_axis(from, region_.points[index(*next)], ray, size);
            if (*next == start) return true;
            at = std::ranges::find(chains_, *next, [](const auto& other) { return other.front(); });
            if (at == chains_.end()) return false;
        }
    }

    /// The first start of a chain on a ray beyond a position. On the first ray the walk leads outward, on the
    /// second ray inward.
    [[nodiscard]] std::optional<Index> next_start(char ray, double beyond, Index start) const
    {
        std::optional<Index> best;
        double nearest = kInfinity;
        const auto look = [&](Index p) {
            if (ray_of(arm(p)) != ray) return;
            const double at = ray == 1 ? arm(p).norm() : -arm(p).norm();
            if (at <= beyond + alike_ || at >= nearest) return;
            nearest = at;
            best = p;
        };
        look(start);
        for (const auto& chain : chains_) look(chain.front());
        return best;
    }

    /// Add nodes along an axis, starting from the node that was added last. The two ends are excluded.
    void walk_axis(const Vec2& from, const Vec2& to, char ray, const SizeField& size)
    {
        const auto axis = static_cast<int>(part_.wanted.size());
        part_.wanted.push_back(sides_along(from, to, size));
        part_.axis.back() = axis;
        const auto sides = static_cast<std::size_t>(std::max(1L, std::lround(part_.wanted.back())));
        for (const Vec2& p : points_between(from, to, sides, size)) part_.add(p, -1, axis, ray);
    }

    /// Move the outer loop to the front. @return false if the number of outer loops is not one
    bool sort_loops()
    {
        std::size_t outer = 0, count = 0;
        for (std::size_t l = 0; l < part_.region.loops.size(); ++l) {
            if (twice_area(part_.region.points, part_.region.loops[l]) <= 0) continue;
            outer = l;
            ++count;
        }
        std::swap(part_.region.loops[0], part_.region.loops[outer]);
        return count == 1;
    }

    const PlanarRegion& region_;
    const Vec2 centre_;
    const double alike_;
    const std::array<Vec2, 2> ray_;
    const bool is_half_, has_centre_;
    std::vector<std::vector<Index>> whole_loops_;
    std::vector<std::vector<Index>> chains_;
    MirrorPart part_;
};

/// Whether a reflection maps a side onto itself, so that its axis crosses the side.
bool crosses_side(const PlanarRegion& region, const Symmetry& mirror)
{
    bool crosses = false;
    for_sides_of(region.loops, [&](Index a, Index b) {
        crosses = crosses || (mirror.to[index(a)] == b && mirror.to[index(b)] == a);
    });
    return crosses;
}

/// Whether an axis halves a corner and the halves deviate too much from a multiple of a right angle.
bool halves_corner(const PlanarRegion& region, const Symmetry& mirror)
{
    // 25°, in right angles. The limit must allow a hole with eight sides, where the halves of a corner
    // deviate by 22.5°.
    constexpr double kMostOff = 25.0 / 90;
    for (const std::vector<Index>& loop : region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            if (mirror.to[index(loop[i])] != loop[i]) continue;
            const double half = corner_angle(region.points, loop, i) / std::numbers::pi;
            if (std::abs(half - std::round(half)) > kMostOff) return true;
        }
    }
    return false;
}

std::vector<Axis> axes_of(const PlanarRegion& region, const std::vector<Symmetry>& symmetries)
{
    std::vector<Axis> axes;
    for (std::size_t s = 0; s < symmetries.size(); ++s) {
        const Symmetry& symmetry = symmetries[s];
        if (!symmetry.map.mirrors || crosses_side(region, symmetry) || halves_corner(region, symmetry))
            continue;
        Axis axis{symmetry.map.angle() / 2, 0, s};
        const Index first = region.loops[0][0];
        if (symmetry.to[index(first)] == first) axis.worth = 1;
        if (axis.angle < 0) axis.angle += std::numbers::pi;
        for (const std::vector<Index>& loop : region.loops) {
            const Index to = symmetry.to[index(loop[0])];
            if (std::ranges::find(loop, to) != loop.end()) axis.worth += 2;
        }
        axes.push_back(axis);
    }
    std::ranges::sort(axes, [](const Axis& a, const Axis& b) { return a.angle < b.angle; });
    return axes;
}

bool lies_in(const PlanarRegion& region, const Vec2& p)
{
    return std::ranges::count_if(region.loops, [&](const Cycle& loop) {
               return geometry::lies_inside(region_within(region.points, {loop}).region.points, p);
           }) == 1;
}

/// The angles at which the part may begin and end. The pair with the best rank comes first.
std::vector<std::array<double, 2>> parts_between(const std::vector<Axis>& axes, bool has_centre)
{
    // Maximum number of axes through a centre outside the region. If the parts were many and narrow, there
    // would be little room for irregular nodes.
    constexpr std::size_t kMostAxes = 8;
    if (!has_centre && axes.size() > 1) {
        std::size_t every = (axes.size() + kMostAxes - 1) / kMostAxes;
        while (axes.size() % every != 0) ++every;
        return {{axes[0].angle, every == axes.size() ? axes[0].angle + 2 * kRightAngle : axes[every].angle}};
    }
    struct Pair {
        int worth;
        double angle;
    };
    std::vector<Pair> pairs;
    for (const Axis& axis : axes) {
        for (const Axis& other : axes) {
            if (std::abs(other.angle - axis.angle - kRightAngle) <= kFileAccuracy)
                pairs.push_back({axis.worth + other.worth, axis.angle});
        }
    }
    std::ranges::stable_sort(pairs, [](const Pair& a, const Pair& b) { return a.worth > b.worth; });
    std::vector<std::array<double, 2>> parts;
    for (const Pair& pair : pairs) parts.push_back({pair.angle, pair.angle + kRightAngle});
    if (!parts.empty()) return parts;
    const double angle = std::ranges::max_element(axes, [](const Axis& a, const Axis& b) {
                             return a.worth < b.worth;
                         })->angle;
    return {{angle, angle + 2 * kRightAngle}};
}

} // namespace

std::vector<Symmetry> outline_symmetries(const PlanarRegion& region) { return OutlineFinder(region).run(); }

std::optional<MirrorPart> mirror_part(const PlanarRegion& region, const std::vector<Symmetry>& symmetries,
                                      const SizeField& size, std::size_t choice)
{
    const std::vector<Axis> axes = axes_of(region, symmetries);
    if (axes.empty()) return std::nullopt;
    const Vec2 centre = symmetries.front().map.centre;
    const bool has_centre = lies_in(region, centre);
    const std::vector<std::array<double, 2>> parts = parts_between(axes, has_centre);
    if (choice >= parts.size()) return std::nullopt;
    const auto [from, to] = parts[choice];
    auto part = PartCutter(region, centre, from, to, has_centre).run(size);
    if (!part) return std::nullopt;
    // The images of the part. Each is rotated by a multiple of twice the part's angle, or reflected and then
    // rotated.
    const double angle = to - from;
    const auto count = static_cast<int>(std::lround(kFullTurn / angle));
    part->images.push_back({{centre, 1, 0, false}, {}});
    part->images.back().to.resize(region.points.size());
    std::iota(part->images.back().to.begin(), part->images.back().to.end(), 0);
    for (int j = 1; j < count; ++j) {
        const bool mirrors = j % 2 != 0;
        const double turn = mirrors ? 2 * from + (j + 1) * angle : j * angle;
        const auto found = std::ranges::find_if(symmetries, [&](const Symmetry& s) {
            return s.map.mirrors == mirrors && std::abs(s.map.cosine - std::cos(turn)) < kFileAccuracy &&
                   std::abs(s.map.sine - std::sin(turn)) < kFileAccuracy;
        });
        if (found == symmetries.end()) return std::nullopt;
        part->images.push_back({{centre, std::cos(turn), std::sin(turn), mirrors}, found->to});
    }
    part->is_some = symmetries.size() + 1 > part->images.size();
    return part;
}

void divide_axes(MirrorPart& part, const std::vector<int>& sides, const SizeField& size)
{
    MirrorPart made;
    made.wanted = part.wanted;
    made.has_centre = part.has_centre;
    made.is_some = part.is_some;
    made.region.size = part.region.size;
    made.region.row_height = part.region.row_height;
    for (const std::vector<Index>& loop : part.region.loops) {
        made.region.loops.emplace_back();
        const std::size_t n = loop.size();
        // Begin at the start of a piece of an axis, if there is one.
        std::size_t first = 0;
        while (first < n && part.axis[index(loop[first])] >= 0 &&
               part.axis[index(loop[first])] == part.axis[index(loop[(first + n - 1) % n])])
            ++first;
        for (std::size_t k = 0; k < n;) {
            const Index here = loop[(first + k) % n];
            const int axis = part.axis[index(here)];
            made.add(part.region.points[index(here)], part.whole[index(here)], axis, part.ray[index(here)]);
            std::size_t end = k + 1;
            if (axis >= 0) {
                while (end < n && part.axis[index(loop[(first + end) % n])] == axis) ++end;
                const Index last = loop[(first + end) % n];
                // Nodes inside the piece are on the same ray as the end that is not the centre.
                const char ray = part.ray[index(here)] == 3 ? part.ray[index(last)] : part.ray[index(here)];
                for (const Vec2& p :
                     points_between(part.region.points[index(here)], part.region.points[index(last)],
                                    static_cast<std::size_t>(sides[static_cast<std::size_t>(axis)]), size))
                    made.add(p, -1, axis, ray);
            }
            k = end;
        }
    }
    made.images = std::move(part.images);
    part = std::move(made);
}

PlanarQuads unfold(const MirrorPart& part, const PlanarQuads& mesh, const PlanarRegion& region)
{
    PlanarQuads whole{region.points, {}, mesh.how};
    const std::size_t own = mesh.points.size(), images = part.images.size();
    std::vector<std::vector<Index>> node(images, std::vector<Index>(own, -1));
    for (std::size_t j = 0; j < images; ++j) {
        const Symmetry& image = part.images[j];
        for (std::size_t p = 0; p < own; ++p) {
            Index& here = node[j][p];
            const bool rim = p < part.whole.size();
            if (rim && part.whole[p] >= 0) {
                here = image.to[index(part.whole[p])];
                continue;
            }
            // An image shares an axis with the image before it or after it. The last image shares the first
            // ray with the first image.
            const int ray = rim ? part.ray[p] : 0;
            if (ray == 3 && j > 0) here = node[0][p];
            if (ray == 2 && j % 2 != 0) here = node[j - 1][p];
            if (ray == 1 && j > 0 && j % 2 == 0) here = node[j - 1][p];
            if (ray == 1 && j + 1 == images) here = node[0][p];
            if (here >= 0) continue;
            here = static_cast<Index>(whole.points.size());
            whole.points.push_back(image.map(mesh.points[p]));
        }
        for (Quad quad : mesh.quads) {
            for (Index& p : quad) p = node[j][index(p)];
            if (image.map.mirrors) std::ranges::reverse(quad);
            whole.quads.push_back(quad);
        }
    }
    return whole;
}

} // namespace lacuna::quads
