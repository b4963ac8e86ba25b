// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/facet_tree.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace lacuna::geometry {

namespace {

using Box = Eigen::AlignedBox3d;
using Corners = std::array<Vec3, 3>;

/// Limit on the triangles in a leaf.
constexpr std::uint32_t kLeaf = 4;
/// Stack of a depth-first traversal, which stores one sibling per level. Each level halves the triangles, so
/// there are fewer levels than bits in the number of a node.
template <class Entry, std::size_t trees = 1>
using Stack = std::array<Entry, trees * std::numeric_limits<std::uint32_t>::digits>;

Box box_of(const Corners& c)
{
    Box box(c[0]);
    box.extend(c[1]);
    box.extend(c[2]);
    return box;
}

/// Squared distance to a box, rounded down: no point in the box is closer.
double distance2(const Box& box, const Vec3& p)
{
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = std::max({box.min()[axis] - p[axis], 0.0, p[axis] - box.max()[axis]});
        sum += d * d;
    }
    return sum;
}

bool near(const Box& a, const Box& b, double margin)
{
    return ((a.min().array() - margin) <= b.max().array()).all() &&
           ((b.min().array() - margin) <= a.max().array()).all();
}

/// Componentwise inverse. Both +0 and -0 give +∞: the sign of a zero must not exchange the two sides of a
/// box.
Vec3 inverse_of(const Vec3& direction) { return (direction.array() + 0.0).inverse(); }

/// Whether the ray intersects the box before t_max. `inverse` may contain infinities.
bool meets(const Box& box, const Vec3& origin, const Vec3& inverse, double t_max)
{
    double enter = 0, leave = t_max;
    for (int axis = 0; axis < 3; ++axis) {
        double t0 = (box.min()[axis] - origin[axis]) * inverse[axis];
        double t1 = (box.max()[axis] - origin[axis]) * inverse[axis];
        if (t0 > t1) std::swap(t0, t1);
        // A ray in the plane of a side gives 0 · ∞ = NaN. It must not become a bound, and does not:
        // comparisons with it are false.
        if (t0 > enter) enter = t0;
        if (t1 < leave) leave = t1;
    }
    // An intersection with a facet on a side of the box may be rounded to just beyond it.
    const double slack = 4 * std::numeric_limits<double>::epsilon();
    return enter <= leave * (1 + slack) + std::numeric_limits<double>::min();
}

/// Intersection of a ray with a triangle, by the signed volumes of the tetrahedra that the ray forms with the
/// triangle's sides. A side that two triangles share has the same volume in both, up to the sign, so that no
/// ray passes between the triangles @cite woop_2013_watertight.
FacetTree::RayHit ray_triangle(const Corners& c, const Vec3& origin, const Vec3& direction)
{
    const Vec3 a = c[0] - origin, b = c[1] - origin, d = c[2] - origin;
    const Vec3 sides(direction.dot(d.cross(b)), direction.dot(a.cross(d)), direction.dot(b.cross(a)));
    const double determinant = sides.sum();
    if (!((sides.array() >= 0).all() || (sides.array() <= 0).all()) || determinant == 0) return {};
    FacetTree::RayHit hit;
    hit.barycentric = sides / determinant;
    const Vec3 place = hit.barycentric[0] * a + hit.barycentric[1] * b + hit.barycentric[2] * d;
    hit.t = place.dot(direction) / direction.squaredNorm();
    return hit.t >= 0 ? hit : FacetTree::RayHit{};
}

/// Partition the triangles by their centres at the median along the longest side of the bounding box.
void halve(std::span<Index> ids, std::span<const Vec3> centres)
{
    Box box;
    for (const Index id : ids) box.extend(centres[index(id)]);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    struct Keyed {
        double at;
        Index id;
    };
    std::vector<Keyed> keyed;
    keyed.reserve(ids.size());
    for (const Index id : ids) keyed.push_back({centres[index(id)][axis], id});
    // Break ties by index, so that the tree depends only on the triangles.
    std::nth_element(keyed.begin(), keyed.begin() + static_cast<std::ptrdiff_t>(ids.size() / 2), keyed.end(),
                     [](const Keyed& a, const Keyed& b) { return a.at != b.at ? a.at < b.at : a.id < b.id; });
    std::transform(keyed.begin(), keyed.end(), ids.begin(), [](const Keyed& k) { return k.id; });
}

/// Number of nodes of a tree with this number of triangles.
std::uint32_t node_count(std::uint32_t triangles)
{
    if (triangles <= kLeaf) return 1;
    return 1 + node_count(triangles / 2) + node_count(triangles - triangles / 2);
}

FacetTree::Hit closest_on_sides(const Vec3& p, const Corners& c)
{
    FacetTree::Hit best;
    for (int side = 0; side < 3; ++side) {
        const int next = (side + 1) % 3;
        const Vec3 d = c[next] - c[side];
        const double length2 = d.squaredNorm();
        const double t = length2 > 0 ? std::clamp((p - c[side]).dot(d) / length2, 0.0, 1.0) : 0.0;
        const Vec3 point = t < 1 ? Vec3(c[side] + t * d) : c[next];
        const double found = (p - point).squaredNorm();
        if (!(found < best.distance2)) continue;
        best.distance2 = found;
        best.point = point;
        best.barycentric.setZero();
        best.barycentric[side] = 1 - t;
        best.barycentric[next] = t;
    }
    return best;
}

} // namespace

FacetTree::Hit closest_on_triangle(const Vec3& p, const Corners& c)
{
    // The closest point is inside if the projection has three positive weights (areas of the parts of the
    // triangle, signed along the normal); otherwise it is on a side. For a triangle so thin that rounding
    // decides the signs, only the sides are used.
    const Vec3 ab = c[1] - c[0], ac = c[2] - c[0];
    const Vec3 normal = ab.cross(ac);
    const double area2 = normal.squaredNorm();
    const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (c[2] - c[1]).squaredNorm()});
    const double thin = std::numeric_limits<double>::epsilon() * longest2;
    if (area2 > thin * thin) {
        const Vec3 pa = c[0] - p, pb = c[1] - p, pc = c[2] - p;
        const double wa = pb.cross(pc).dot(normal), wb = pc.cross(pa).dot(normal);
        const double wc = pa.cross(pb).dot(normal);
        if (wa > 0 && wb > 0 && wc > 0) {
            FacetTree::Hit hit;
            hit.barycentric = Vec3(wa, wb, wc) / (wa + wb + wc);
            hit.point = c[0] + hit.barycentric[1] * ab + hit.barycentric[2] * ac;
            hit.distance2 = (p - hit.point).squaredNorm();
            return hit;
        }
    }
    return closest_on_sides(p, c);
}

/// Input of the construction of a tree.
struct FacetTree::Parts {
    std::span<const Vec3> centre;
    std::span<const Box> box;
};

FacetTree::FacetTree(std::span<const Vec3> points, std::span<const Triangle> triangles,
                     const RunContext& context)
{
    const auto count = static_cast<std::uint32_t>(triangles.size());
    if (count == 0) return;
    const auto at = [&](Index i) -> const Vec3& { return points[static_cast<std::size_t>(i)]; };
    std::vector<Box> box(count);
    std::vector<Vec3> centre(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        for (const Index corner : triangles[i]) box[i].extend(at(corner));
        centre[i] = box[i].center();
    }
    id_.resize(count);
    std::iota(id_.begin(), id_.end(), Index{0});
    node_.resize(node_count(count));
    build({centre, box}, 0, 0, count, thread_count(context), context);
    check_cancelled(context);
    corner_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triangle& t = triangles[static_cast<std::size_t>(id_[i])];
        corner_[i] = {at(t[0]), at(t[1]), at(t[2])};
    }
    bounds_ = node_.front().box;
}

/// Build the nodes over the triangles [begin, end), starting at node `self`. The nodes of the lower half come
/// before those of the upper half.
/// @return  index of the node after the last one that was built.
std::uint32_t FacetTree::build(const Parts& parts, std::uint32_t self, std::uint32_t begin, std::uint32_t end,
                               int threads, const RunContext& context)
{
    if (end - begin > kBetweenPolls) check_cancelled(context);
    Node& node = node_[self];
    node.begin = begin;
    node.end = end;
    const std::span ids(id_.begin() + begin, end - begin);
    if (end - begin <= kLeaf) {
        for (const Index id : ids) node.box.extend(parts.box[index(id)]);
        return self + 1;
    }
    halve(ids, parts.centre);
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::uint32_t behind = 0;
    if (threads > 1 && end - begin > kBetweenPolls) { // smaller subtrees take less than 1 ms
        node.right = self + 1 + node_count(middle - begin);
        RunContext two = context;
        two.threads = 2;
        parallel_for(two, 2, 1, [&](std::size_t half, std::size_t) {
            if (half == 0)
                build(parts, self + 1, begin, middle, (threads + 1) / 2, context);
            else
                behind = build(parts, node.right, middle, end, threads / 2, context);
        });
    } else {
        node.right = build(parts, self + 1, begin, middle, 1, context);
        behind = build(parts, node.right, middle, end, 1, context);
    }
    node.box = node_[self + 1].box.merged(node_[node.right].box);
    return behind;
}

FacetTree::Hit FacetTree::closest(const Vec3& p, double max_distance2) const
{
    Hit best;
    if (node_.empty()) return best;
    double reach = max_distance2;
    Stack<std::pair<std::uint32_t, double>> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, distance2(node_.front().box, p)};
    while (depth > 0) {
        const auto [index, away] = stack[--depth];
        if (away > reach) continue;
        const Node& node = node_[index];
        if (node.right != 0) {
            std::pair<std::uint32_t, double> near_child{index + 1, distance2(node_[index + 1].box, p)};
            std::pair<std::uint32_t, double> far_child{node.right, distance2(node_[node.right].box, p)};
            if (far_child.second < near_child.second) std::swap(near_child, far_child);
            if (far_child.second <= reach) stack[depth++] = far_child;
            if (near_child.second <= reach) stack[depth++] = near_child;
            continue;
        }
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const Corners& c = corner_[i];
            if (distance2(box_of(c), p) > reach) continue;
            Hit hit = closest_on_triangle(p, c);
            if (hit.distance2 > reach) continue;
            if (best.triangle >= 0 && hit.distance2 == best.distance2 && id_[i] > best.triangle) continue;
            best = hit;
            best.triangle = id_[i];
            reach = hit.distance2;
        }
    }
    return best;
}

bool FacetTree::overlaps(const FacetTree& other, const std::function<bool(Index, Index)>& visit,
                         double margin, const RunContext& context) const
{
    if (node_.empty() || other.node_.empty()) return true;
    const bool itself = &other == this;
    const auto leaves = [&](const Node& a, const Node& b) {
        for (std::uint32_t i = a.begin; i < a.end; ++i) {
            const Box own = box_of(corner_[i]);
            for (std::uint32_t j = b.begin; j < b.end; ++j) {
                // Within one tree, both (i, j) and (j, i) are reached.
                if (itself && id_[i] >= other.id_[j]) continue;
                if (!near(own, box_of(other.corner_[j]), margin)) continue;
                if (!visit(id_[i], other.id_[j])) return false;
            }
        }
        return true;
    };
    // Each step splits the larger node of a pair, which gives two pairs. The stack therefore holds at most
    // twice as many pairs as a tree has levels.
    Stack<std::pair<std::uint32_t, std::uint32_t>, 2> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, 0};
    for (std::size_t steps = 0; depth > 0; ++steps) {
        if (steps % kBetweenPolls == 0) check_cancelled(context);
        const auto [ia, ib] = stack[--depth];
        const Node& a = node_[ia];
        const Node& b = other.node_[ib];
        if (!near(a.box, b.box, margin)) continue;
        if (a.right == 0 && b.right == 0) {
            if (!leaves(a, b)) return false;
        } else if (b.right == 0 || (a.right != 0 && a.end - a.begin >= b.end - b.begin)) {
            stack[depth++] = {a.right, ib};
            stack[depth++] = {ia + 1, ib};
        } else {
            stack[depth++] = {ia, b.right};
            stack[depth++] = {ia, ib + 1};
        }
    }
    return true;
}

template <class Enters, class Visit>
bool FacetTree::each_leaf(const Enters& enters, const Visit& visit) const
{
    if (node_.empty()) return true;
    Stack<std::uint32_t> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t at = stack[--depth];
        const Node& node = node_[at];
        if (!enters(node.box)) continue;
        if (node.right != 0) {
            stack[depth++] = node.right;
            stack[depth++] = at + 1;
        } else if (!visit(node)) {
            return false;
        }
    }
    return true;
}

bool FacetTree::may_meet(const Box& box) const
{
    return !each_leaf([&](const Box& own) { return near(own, box, 0); }, [](const Node&) { return false; });
}

template <class Visit>
bool FacetTree::along(const Vec3& origin, const Vec3& direction, const double& farthest,
                      const Visit& visit) const
{
    const Vec3 inverse = inverse_of(direction);
    const auto enters = [&](const Box& box) { return meets(box, origin, inverse, farthest); };
    return each_leaf(enters, [&](const Node& node) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            RayHit hit = ray_triangle(corner_[i], origin, direction);
            if (!std::isfinite(hit.t)) continue;
            hit.triangle = id_[i];
            if (!visit(hit)) return false;
        }
        return true;
    });
}

FacetTree::RayHit FacetTree::first_along(const Vec3& origin, const Vec3& direction) const
{
    RayHit best;
    along(origin, direction, best.t, [&](const RayHit& hit) {
        if (hit.t < best.t || (hit.t == best.t && hit.triangle <= best.triangle)) best = hit;
        return true;
    });
    return best;
}

bool FacetTree::all_along(const Vec3& origin, const Vec3& direction,
                          const std::function<bool(const RayHit&)>& visit) const
{
    return along(origin, direction, kInfinity, visit);
}

double FacetTree::winding_number(const Vec3& p) const
{
    // Solid angle of a triangle at the origin (van Oosterom and Strackee 1983).
    double sum = 0;
    for (const Corners& c : corner_) {
        const Vec3 a = c[0] - p, b = c[1] - p, d = c[2] - p;
        const double la = a.norm(), lb = b.norm(), ld = d.norm();
        const double above = a.dot(b.cross(d));
        const double below = la * lb * ld + a.dot(b) * ld + b.dot(d) * la + d.dot(a) * lb;
        if (above != 0 || below > 0) sum += 2 * std::atan2(above, below);
    }
    return sum / (4 * std::numbers::pi);
}

namespace {

/// Heights of a triangle's corners over the plane of another; heights within the tolerance are set to zero.
Vec3 heights_over(const Corners& of, const Corners& plane, const Vec3& normal, double tolerance)
{
    Vec3 result;
    for (int i = 0; i < 3; ++i) {
        // A shared corner is on the plane exactly, without rounding.
        const bool shared = of[i] == plane[0] || of[i] == plane[1] || of[i] == plane[2];
        const double h = (of[i] - plane[0]).dot(normal);
        result[i] = shared || std::abs(h) <= tolerance ? 0 : h;
    }
    return result;
}

/// The interval that a triangle occupies on the line in which two planes intersect. Its ends are corners on
/// the other plane, or places where sides cross that plane.
std::pair<double, double> stretch(const Corners& c, const Vec3& heights, const Vec3& origin, const Vec3& line)
{
    std::pair<double, double> range{kInfinity, -kInfinity};
    const auto add = [&](double s) { range = {std::min(range.first, s), std::max(range.second, s)}; };
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const double si = (c[i] - origin).dot(line), sj = (c[j] - origin).dot(line);
        if (heights[i] == 0) add(si);
        if ((heights[i] < 0 && heights[j] > 0) || (heights[i] > 0 && heights[j] < 0))
            add(si + heights[i] / (heights[i] - heights[j]) * (sj - si));
    }
    return range;
}

/// Whether two coplanar triangles overlap by more than `tolerance` along the normal of each of their sides.
bool overlap_in_plane(const Corners& a, const Corners& b, const Vec3& normal, double tolerance)
{
    for (const Corners* triangle : {&a, &b}) {
        for (int side = 0; side < 3; ++side) {
            const Vec3 axis = normal.cross((*triangle)[(side + 1) % 3] - (*triangle)[side]).normalized();
            Vec3 sa, sb;
            for (int i = 0; i < 3; ++i) {
                sa[i] = (a[i] - a[0]).dot(axis);
                sb[i] = (b[i] - a[0]).dot(axis);
            }
            const double shared = std::min(sa.maxCoeff(), sb.maxCoeff()) -
                                  std::max(sa.minCoeff(), sb.minCoeff());
            if (!(shared > tolerance)) return false;
        }
    }
    return true;
}

} // namespace

namespace {

/// Two triangles relative to each other's planes.
struct Crossing {
    Vec3 normal_a, normal_b;
    Vec3 heights_a, heights_b; ///< of the corners over the plane of the other triangle; 0 within `reach`
    double reach = 0;          ///< the tolerance, or the rounding error if that is larger
};

/// @return  empty if a triangle is degenerate: where such a triangle intersects another one, its neighbours
///          do too.
std::optional<Crossing> crossing_of(const Corners& a, const Corners& b, double tolerance)
{
    const Vec3 area_a = (a[1] - a[0]).cross(a[2] - a[0]), area_b = (b[1] - b[0]).cross(b[2] - b[0]);
    if (area_a.isZero(0) || area_b.isZero(0)) return std::nullopt;
    Crossing c;
    c.normal_a = area_a.normalized();
    c.normal_b = area_b.normalized();
    // Heights and lengths have rounding errors of a few bits of the extent of the triangles.
    const Box extent = box_of(a).merged(box_of(b));
    c.reach = std::max(tolerance, 16 * std::numeric_limits<double>::epsilon() * extent.diagonal().norm());
    c.heights_a = heights_over(a, b, c.normal_b, c.reach);
    c.heights_b = heights_over(b, a, c.normal_a, c.reach);
    return c;
}

std::optional<std::array<Vec3, 2>> line_of(const Corners& a, const Corners& b, const Crossing& c)
{
    const Vec3 &ha = c.heights_a, &hb = c.heights_b;
    if (!(ha.minCoeff() < 0 && ha.maxCoeff() > 0 && hb.minCoeff() < 0 && hb.maxCoeff() > 0))
        return std::nullopt;
    const Vec3 line = c.normal_a.cross(c.normal_b).normalized();
    const auto [a0, a1] = stretch(a, ha, a[0], line);
    const auto [b0, b1] = stretch(b, hb, a[0], line);
    const double from = std::max(a0, b0), to = std::min(a1, b1);
    if (!(to - from > c.reach)) return std::nullopt;
    // A point of the line has height 0 over both planes; a[0] has not.
    const auto foot = std::ranges::find_if(ha, [](double h) { return h > 0; }) - ha.begin();
    const auto other = std::ranges::find_if(ha, [](double h) { return h < 0; }) - ha.begin();
    const Vec3 on = a[foot] + ha[foot] / (ha[foot] - ha[other]) * (a[other] - a[foot]);
    const double at = (on - a[0]).dot(line);
    return std::array<Vec3, 2>{on + (from - at) * line, on + (to - at) * line};
}

} // namespace

bool triangles_cross(const Corners& a, const Corners& b, double tolerance)
{
    const auto crossing = crossing_of(a, b, tolerance);
    if (!crossing) return false;
    if (crossing->heights_a.isZero(0)) return overlap_in_plane(a, b, crossing->normal_b, crossing->reach);
    if (crossing->heights_b.isZero(0)) return overlap_in_plane(a, b, crossing->normal_a, crossing->reach);
    return line_of(a, b, *crossing).has_value();
}

std::optional<std::array<Vec3, 2>> crossing_line(const Corners& a, const Corners& b, double tolerance)
{
    const auto crossing = crossing_of(a, b, tolerance);
    return crossing ? line_of(a, b, *crossing) : std::nullopt;
}

} // namespace lacuna::geometry
