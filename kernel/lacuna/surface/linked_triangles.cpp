// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/linked_triangles.h>

#include <lacuna/core/shared/edge_key.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace lacuna::surface {

double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal)
{
    /// Minimum cosine of the angle between a triangle's normal and the face normals at its corners: 60°. A
    /// larger angle is not caused by curvature, because the face turns by at most 30° along a side.
    constexpr double kAligned = 0.5;
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    const Vec3 across = ab.cross(-ca);
    const double twice = across.norm(), up = across.dot(normal);
    if (up < kAligned * twice * normal.norm()) return up / (twice * normal.norm()) - 1;
    const double dot = std::max({-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)});
    return dot > 0 ? twice / dot : 0;
}

Index LinkedTriangles::build(std::vector<Node> given, std::span<const Triangle> corners,
                             std::span<const Owner> of)
{
    nodes = std::move(given);
    owners.assign(of.begin(), of.end());
    sides.assign(3 * corners.size(), {});
    std::unordered_map<std::uint64_t, Index> numbers;
    numbers.reserve(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Triangle& t = corners[i / 3];
        sides[i].from = t[i % 3];
        nodes[index(t[i % 3])].out = static_cast<Index>(i);
        if (!numbers.emplace(directed_key(t[i % 3], t[(i + 1) % 3]), static_cast<Index>(i)).second)
            return static_cast<Index>(i);
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const auto s = static_cast<Index>(i);
        const auto found = numbers.find(directed_key(to(s), from(s)));
        if (found == numbers.end()) return s;
        sides[i].twin = found->second;
    }
    divide_fans();
    return -1;
}

void LinkedTriangles::divide_fans()
{
    std::vector<char> seen(sides.size(), 0), taken(nodes.size(), 0);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (seen[i] != 0) continue;
        Index node = sides[i].from;
        if (taken[index(node)] != 0) {
            nodes[index(node)].fixed = true;
            nodes.push_back(nodes[index(node)]);
            node = static_cast<Index>(nodes.size()) - 1;
            taken.push_back(0);
        }
        taken[index(node)] = 1;
        nodes[index(node)].out = static_cast<Index>(i);
        each_out(node, [&](Index s) {
            seen[index(s)] = 1;
            sides[index(s)].from = node;
        });
    }
}

bool LinkedTriangles::are_neighbours(Index a, Index b) const
{
    bool found = false;
    each_out(a, [&](Index s) { found = found || to(s) == b; });
    return found;
}

int LinkedTriangles::valence(Index node) const
{
    int count = 0;
    each_out(node, [&](Index) { ++count; });
    return count;
}

bool LinkedTriangles::can_collapse(Index s) const
{
    const Index u = from(s), v = to(s), c = apex(s), d = apex(twin(s));
    if (c == d || valence(c) <= 3 || valence(d) <= 3) return false;
    int common = 0;
    each_out(u, [&](Index x) { common += to(x) != v && are_neighbours(v, to(x)) ? 1 : 0; });
    return common == 2;
}

double LinkedTriangles::quality(Index side) const { return quality(side, -1, Vec3::Zero()); }

double LinkedTriangles::quality(Index side, Index moved, const Vec3& place) const
{
    const auto first = index(side - side % 3);
    const Side &a = sides[first], &b = sides[first + 1], &c = sides[first + 2];
    const auto where = [&](const Side& s) -> const Vec3& { return s.from == moved ? place : at(s.from); };
    return triangle_quality(where(a), where(b), where(c), a.normal + b.normal + c.normal);
}

void LinkedTriangles::set_twins(Index a, Index b)
{
    sides[index(a)].twin = b;
    sides[index(b)].twin = a;
}

///        c                 c
///      / | \             / | \        s: a to b, g: b to a. The triangles of s and g keep a and b as
///    a - s - b    to   a - m - b      first corner; two new ones take the other halves.
///      \ | /             \ | /
///        d                 d
Index LinkedTriangles::split(Index s, Node node, const std::array<Vec3, 2>& normals)
{
    const Index g = twin(s), sn = next(s), gn = next(g);
    const auto m = static_cast<Index>(nodes.size());
    const Index a = from(s), b = to(s);
    const auto x = static_cast<Index>(sides.size()), y = x + 3;
    sides.resize(sides.size() + 6);
    owners.push_back(Owner(owner(s)));
    owners.push_back(Owner(owner(g)));
    const double half = (sides[index(s)].s + sides[index(g)].s) / 2;
    const auto take = [&](Index fresh, Index old, Index old_next, const Vec3& normal) {
        // `fresh` runs from m to the end of the old side. Its next side replaces `old_next`, which then
        // starts at m.
        sides[index(fresh)] = {m, -1, line(old), half, normal};
        Side& outer = sides[index(next(fresh))];
        outer = sides[index(old_next)];
        set_twins(next(fresh), twin(old_next));
        Side& inner = sides[index(prev(fresh))];
        inner = {apex(old), -1, -1, 0, sides[index(prev(old))].normal};
        sides[index(old_next)] = {m, -1, -1, 0, normal};
        set_twins(prev(fresh), old_next);
    };
    take(x, s, sn, normals[0]);
    take(y, g, gn, normals[1]);
    set_twins(s, y);
    set_twins(g, x);
    node.out = x;
    nodes.push_back(node);
    nodes[index(a)].out = s;
    nodes[index(b)].out = g;
    return m;
}

void LinkedTriangles::collapse(Index s)
{
    const Index g = twin(s), u = from(s), v = to(s);
    const double place = sides[index(g)].s; // position of v on the line that contains s
    const std::array<Vec3, 2> normal{sides[index(next(s))].normal, sides[index(g)].normal};
    std::size_t beyond = 0; // 0 on the left of s, 1 after the fan of triangles has crossed the line of s
    std::vector<Index> fan;
    each_out(u, [&](Index x) { fan.push_back(x); });
    std::ranges::rotate(fan, std::ranges::find(fan, s));
    for (const Index x : fan) {
        Side& side = sides[index(x)];
        if (x != s && side.line >= 0) {
            beyond = 1;
            side.s = place;
        }
        side.from = v;
        side.normal = normal[beyond];
    }
    const auto close = [&](Index gone) { // removes the triangle of a side
        const Index n = next(gone), p = prev(gone), outer_n = twin(n), outer_p = twin(p);
        const auto keep_line = [&](Index own, Index opposite) { // both start at the same node
            if (line(own) < 0) return;
            sides[index(opposite)].line = line(own);
            sides[index(opposite)].s = sides[index(own)].s;
        };
        keep_line(n, outer_p);
        keep_line(p, outer_n);
        set_twins(outer_n, outer_p);
        nodes[index(from(outer_n))].out = outer_n;
        nodes[index(from(outer_p))].out = outer_p;
        for (const Index side : {gone, n, p}) sides[index(side)] = {};
    };
    close(s);
    close(g);
    nodes[index(u)].out = -1;
}

///        c                 c
///      /   \             / | \        s: a to b becomes c to d, g: b to a becomes d to c.
///    a - s - b    to   a   s   b
///      \   /             \ | /
///        d                 d
void LinkedTriangles::flip(Index s)
{
    const Index g = twin(s), sn = next(s), sp = prev(s), gn = next(g), gp = prev(g);
    const Side a = sides[index(gn)], b = sides[index(sn)], c = sides[index(sp)], d = sides[index(gp)];
    const auto put = [&](Index side, const Side& old) {
        sides[index(side)] = old;
        set_twins(side, old.twin);
        nodes[index(old.from)].out = side;
    };
    put(sp, b);
    put(sn, d);
    put(gp, a);
    put(gn, c);
    sides[index(s)] = {c.from, g, -1, 0, c.normal};
    sides[index(g)] = {d.from, s, -1, 0, d.normal};
}

} // namespace lacuna::surface
