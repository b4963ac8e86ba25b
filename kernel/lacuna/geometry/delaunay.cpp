// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/delaunay.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/predicates.h>

#include <algorithm>
#include <bit>
#include <map>
#include <tuple>

namespace lacuna::geometry {
namespace {

/// Position on the Hilbert curve through a 2^16 × 2^16 grid.
std::uint32_t hilbert_key(std::uint32_t x, std::uint32_t y)
{
    std::uint32_t key = 0;
    for (std::uint32_t s = 1u << 15; s > 0; s >>= 1) {
        const std::uint32_t rx = (x & s) ? 1 : 0;
        const std::uint32_t ry = (y & s) ? 1 : 0;
        key += s * s * ((3 * rx) ^ ry);
        if (ry == 0) {
            if (rx == 1) {
                x = 0xFFFFu - x;
                y = 0xFFFFu - y;
            }
            std::swap(x, y);
        }
    }
    return key;
}

/// A hash, to shuffle points.
std::uint32_t scattered(Index p)
{
    auto x = static_cast<std::uint32_t>(p);
    x = (x ^ (x >> 16)) * 0x7feb352dU; // Wellons' lowbias32
    x = (x ^ (x >> 15)) * 0x846ca68bU;
    return x ^ (x >> 16);
}

} // namespace

DelaunayMesh::DelaunayMesh(std::span<const Vec2> points, const std::vector<Index>& used)
    : points_(points.begin(), points.end()), given_(static_cast<Index>(points.size()))
{
    Eigen::AlignedBox2d box;
    for (const Index p : used) box.extend(at(p));
    if (used.empty()) box.extend(Vec2(0, 0));
    const Vec2 centre = box.center();
    double extent = box.sizes().maxCoeff();
    if (!(extent > 0)) extent = 1;
    // The triangle is a few times larger than the points' box, so that the first triangles are not slivers.
    points_.push_back(centre + Vec2(-8, -5) * extent);
    points_.push_back(centre + Vec2(8, -5) * extent);
    points_.push_back(centre + Vec2(0, 9) * extent);
    triangle_of_.assign(points_.size(), -1);
    triangles_.reserve(2 * used.size() + 8);
    stamp_.reserve(triangles_.capacity());
    triangles_.push_back({.corner = {given_, given_ + 1, given_ + 2}});
    stamp_.push_back(-1);
    for (Index i = 0; i < 3; ++i) triangle_of_[index(given_ + i)] = 0;
    insert_all(used, box.min(), extent);
}

void DelaunayMesh::insert_all(const std::vector<Index>& used, const Vec2& low, double extent)
{
    // Insert the points in rounds @cite amenta_2003_order. Each round has about as many points as all rounds
    // before it, chosen by a hash and ordered along a Hilbert curve. Without rounds, the points of a line or
    // circle would be inserted one after the other along it. Each of them would replace nearly all triangles
    // at the previous one, and a walk could pass all of these points.
    constexpr std::size_t kFirstRound = 1024; // upper bound of the number of points in the first round
    int rounds = 0;
    while (used.size() >> rounds > kFirstRound) ++rounds;
    std::vector<std::tuple<int, std::uint32_t, Index>> order;
    order.reserve(used.size());
    for (const Index p : used) {
        const Vec2 cell = (at(p) - low) / extent * 65535.0;
        const int halvings = std::countl_zero(scattered(p));
        order.emplace_back(
            rounds - std::min(halvings, rounds),
            hilbert_key(static_cast<std::uint32_t>(cell.x()), static_cast<std::uint32_t>(cell.y())), p);
    }
    std::sort(order.begin(), order.end());

    Cavity cavity;
    std::vector<Index> fresh;
    Index last = 0;
    for (const auto& [round, key, p] : order) {
        const Index holder = locate(at(p), last);
        if (holder < 0 || !find_cavity(at(p), holder, cavity)) {
            throw InvalidInput(
                Message("geometry.point_twice", "point {} coincides with an earlier point", found(p + 1))
                    .remedy("give it once"));
        }
        fan(p, cavity, fresh);
        last = fresh.front();
    }
}

Index DelaunayMesh::locate(const Vec2& p, Index start) const
{
    // Walk towards p. Without constraints the walk always arrives; with them it may be blocked or, rarely,
    // cycle, so the number of steps is limited.
    Index t = start;
    std::uint32_t dice = 1;
    for (std::size_t steps = 0; steps <= triangles_.size(); ++steps) {
        const DelaunayTriangle& tri = (*this)[t];
        dice = dice * 1664525u + 1013904223u;
        const int first = static_cast<int>((dice >> 16) % 3);
        Index onward = -1;
        bool here = true;
        for (int k = 0; k < 3 && onward < 0; ++k) {
            const int side = (first + k) % 3;
            if (orient2d(at(tri.from(side)), at(tri.to(side)), p) >= 0) continue;
            here = false;
            if (!tri.is_fixed(side)) onward = tri.across(side);
        }
        if (here) return t;
        if (onward < 0) return -1;
        t = onward;
    }
    return -1;
}

bool DelaunayMesh::find_cavity(const Vec2& p, Index holder, Cavity& cavity)
{
    cavity.triangles.clear();
    cavity.border.clear();
    ++stamp_now_;
    // Visit triangles depth first, and their sides counter-clockwise from the side of entry. This gives the
    // border in order.
    auto& pending = cavity.pending;
    pending.clear();
    cavity.triangles.push_back(holder);
    stamp_[index(holder)] = stamp_now_;
    for (const int side : {2, 1, 0}) pending.emplace_back(holder, side);
    while (!pending.empty()) {
        const auto [t, side] = pending.back();
        pending.pop_back();
        const DelaunayTriangle& tri = (*this)[t];
        const Index other = tri.across(side);
        const bool fixed = tri.is_fixed(side);
        if (other >= 0 && !fixed && stamp_[index(other)] != stamp_now_) {
            const DelaunayTriangle& far = (*this)[other];
            if (incircle(at(far.corner[0]), at(far.corner[1]), at(far.corner[2]), p) > 0) {
                stamp_[index(other)] = stamp_now_;
                cavity.triangles.push_back(other);
                int entry = 0;
                while (far.across(entry) != t || far.from(entry) != tri.to(side)) ++entry;
                pending.emplace_back(other, (entry + 2) % 3);
                pending.emplace_back(other, (entry + 1) % 3);
                continue;
            }
        }
        if (orient2d(at(tri.from(side)), at(tri.to(side)), p) <= 0) return false;
        cavity.border.push_back({tri.from(side), tri.to(side), other, fixed});
    }
    // A disc without inner points has two more border sides than triangles.
    return cavity.border.size() == cavity.triangles.size() + 2;
}

Index DelaunayMesh::fill_cavity(const Vec2& p, const Cavity& cavity, std::vector<Index>& fresh)
{
    const auto point = static_cast<Index>(points_.size());
    points_.push_back(p);
    triangle_of_.push_back(-1);
    fan(point, cavity, fresh);
    return point;
}

void DelaunayMesh::relink(Index t, Index from, Index to, Index next)
{
    if (t < 0) return;
    DelaunayTriangle& tri = triangle(t);
    for (int side = 0; side < 3; ++side)
        if (tri.from(side) == from && tri.to(side) == to) tri.next[static_cast<std::size_t>(side)] = next;
}

void DelaunayMesh::fan(Index point, const Cavity& cavity, std::vector<Index>& fresh)
{
    const bool inside = (*this)[cavity.triangles.front()].inside;
    const std::size_t count = cavity.border.size();
    fresh.clear();
    for (std::size_t i = 0; i < count; ++i) {
        if (i < cavity.triangles.size()) {
            fresh.push_back(cavity.triangles[i]);
        } else {
            fresh.push_back(static_cast<Index>(triangles_.size()));
            triangles_.emplace_back();
            stamp_.push_back(-1);
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        const Cavity::Border& side = cavity.border[i];
        DelaunayTriangle& tri = triangle(fresh[i]);
        tri.corner = {point, side.from, side.to};
        tri.next = {side.outer, fresh[(i + 1) % count], fresh[(i + count - 1) % count]};
        tri.fixed = side.fixed ? 1 : 0;
        tri.inside = inside;
        triangle_of_[index(side.from)] = fresh[i];
        relink(side.outer, side.to, side.from, fresh[i]);
    }
    triangle_of_[index(point)] = fresh.front();
}

std::pair<Index, int> DelaunayMesh::find_side(Index a, Index b) const
{
    const Index start = triangle_of_[index(a)];
    // Every given point is inside the outer triangle, so the triangles around it form a closed fan.
    for (Index t = start; t >= 0;) {
        const DelaunayTriangle& tri = (*this)[t];
        int corner = 0;
        while (tri.corner[static_cast<std::size_t>(corner)] != a) ++corner;
        const int side = (corner + 2) % 3; // from a to the next corner
        if (tri.to(side) == b) return {t, side};
        t = tri.across((corner + 1) % 3);
        if (t == start) break;
    }
    return {-1, -1};
}

void DelaunayMesh::mark_fixed(Index a, Index b)
{
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        const auto [t, side] = find_side(from, to);
        if (t >= 0) triangle(t).fixed |= static_cast<std::uint8_t>(1 << side);
    }
}

void DelaunayMesh::fix_segment(Index a, Index b)
{
    if (find_side(a, b).first >= 0 || find_side(b, a).first >= 0) {
        mark_fixed(a, b);
        return;
    }
    // Find the triangle at a that the segment crosses first, then follow the segment to b.
    const Index start = triangle_of_[index(a)];
    Index t = start;
    int side = 0;
    while (true) {
        const DelaunayTriangle& tri = (*this)[t];
        side = 0;
        while (tri.corner[static_cast<std::size_t>(side)] != a) ++side;
        if (orient2d(at(a), at(b), at(tri.from(side))) < 0 && orient2d(at(a), at(b), at(tri.to(side))) > 0)
            break;
        t = tri.across((side + 1) % 3);
        if (t == start || t < 0)
            throw Error("geometry.internal",
                        "internal error: no triangle at a point contains the direction of its segment");
    }
    std::vector<Index> strip{t};
    std::vector<Index> right{a, (*this)[t].from(side)};
    std::vector<Index> left{a, (*this)[t].to(side)};
    while (true) {
        const Index before = t;
        const Index from = (*this)[t].from(side);
        t = (*this)[t].across(side);
        strip.push_back(t);
        const DelaunayTriangle& tri = (*this)[t];
        int entry = 0;
        while (tri.across(entry) != before || tri.to(entry) != from) ++entry;
        const Index apex = tri.corner[static_cast<std::size_t>(entry)];
        if (apex == b) break;
        const double turn = orient2d(at(a), at(b), at(apex));
        if (turn == 0) throw Error("geometry.internal", "internal error: a segment passes through a point");
        (turn > 0 ? left : right).push_back(apex);
        // The segment leaves the triangle between the apex and the last point of the other chain (the apex
        // has just been added to its own chain).
        side = turn > 0 ? (entry + 1) % 3 : (entry + 2) % 3;
    }
    left.push_back(b);
    right.push_back(b);
    replace_strip(strip, std::move(left), right);
    mark_fixed(a, b);
}

void DelaunayMesh::replace_strip(const std::vector<Index>& strip, std::vector<Index> left,
                                 const std::vector<Index>& right)
{
    // For each side on the border of the strip, find the triangle beyond it. Sides are identified by their
    // end points, not by their position in a chain, because a chain may contain a point twice (a side that
    // has the strip on both sides).
    std::map<std::pair<Index, Index>, std::tuple<Index, bool>> across;
    const bool inside = (*this)[strip.front()].inside;
    for (const Index t : strip) stamp_[index(t)] = -2;
    for (const Index t : strip) {
        const DelaunayTriangle& tri = (*this)[t];
        for (int side = 0; side < 3; ++side) {
            const Index other = tri.across(side);
            const bool within = other >= 0 && stamp_[index(other)] == -2;
            if (!within || tri.is_fixed(side)) {
                across[{tri.from(side), tri.to(side)}] = {within ? -1 : other, tri.is_fixed(side)};
            }
        }
    }
    for (const Index t : strip) stamp_[index(t)] = -1;

    // On each side of the segment, the segment and a chain bound a polygon. The segment is its base. One
    // point of the chain forms the Delaunay triangle on the base: the circle through this point and the base
    // contains no other point of the chain. The triangle divides the rest into two smaller polygons, whose
    // bases are its other sides (Anglada 1997).
    std::reverse(left.begin(), left.end());
    std::vector<Triangle> made;
    const auto fill = [&](const std::vector<Index>& chain) {
        std::vector<std::pair<std::size_t, std::size_t>> pending{{0, chain.size() - 1}};
        while (!pending.empty()) {
            const auto [first, last] = pending.back();
            pending.pop_back();
            if (last - first < 2) continue;
            std::size_t best = 0;
            for (std::size_t i = first + 1; i < last; ++i) {
                if (orient2d(at(chain[last]), at(chain[first]), at(chain[i])) <= 0) continue;
                if (best == 0 ||
                    incircle(at(chain[last]), at(chain[first]), at(chain[best]), at(chain[i])) > 0) {
                    best = i;
                }
            }
            if (best == 0)
                throw Error("geometry.internal",
                            "internal error: a strip along a segment cannot be triangulated");
            made.push_back({chain[last], chain[first], chain[best]});
            pending.emplace_back(first, best);
            pending.emplace_back(best, last);
        }
    };
    fill(left);  // b … a; the base is a → b
    fill(right); // a … b; the base is b → a
    if (made.size() != strip.size())
        throw Error("geometry.internal",
                    "internal error: retriangulating a strip changed its number of triangles");

    std::map<std::pair<Index, Index>, Index> owner;
    for (std::size_t i = 0; i < made.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) owner[{made[i][k], made[i][(k + 1) % 3]}] = strip[i];
    }
    for (std::size_t i = 0; i < made.size(); ++i) {
        DelaunayTriangle tri;
        tri.corner = made[i];
        tri.inside = inside;
        for (int side = 0; side < 3; ++side) {
            const auto twin = owner.find({tri.to(side), tri.from(side)});
            const auto outer = across.find({tri.from(side), tri.to(side)});
            const bool fixed = outer != across.end() && std::get<1>(outer->second);
            if (fixed) tri.fixed |= static_cast<std::uint8_t>(1 << side);
            if (twin != owner.end()) {
                tri.next[static_cast<std::size_t>(side)] = twin->second;
            } else {
                tri.next[static_cast<std::size_t>(side)] = std::get<0>(outer->second);
                relink(std::get<0>(outer->second), tri.to(side), tri.from(side), strip[i]);
            }
        }
        triangle(strip[i]) = tri;
        for (const Index corner : tri.corner) triangle_of_[index(corner)] = strip[i];
    }
}

void DelaunayMesh::mark_inside()
{
    // Depth of a triangle: number of constraints between this triangle and the outside. Visit the triangles
    // in order of their depth, starting outside, at a corner of the huge triangle.
    std::vector<Index> depth(triangles_.size(), -1);
    std::vector<Index> level{triangle_of_[index(given_)]};
    for (Index now = 0; !level.empty(); ++now) {
        std::vector<Index> deeper;
        while (!level.empty()) {
            const Index t = level.back();
            level.pop_back();
            if (depth[index(t)] >= 0) continue;
            depth[index(t)] = now;
            triangle(t).inside = now % 2 == 1;
            for (int side = 0; side < 3; ++side) {
                const Index other = (*this)[t].across(side);
                if (other < 0 || depth[index(other)] >= 0) continue;
                ((*this)[t].is_fixed(side) ? deeper : level).push_back(other);
            }
        }
        level = std::move(deeper);
    }
}

} // namespace lacuna::geometry
