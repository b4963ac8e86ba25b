// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/skin_remesher.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/surface/shared/edge_nodes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>
#include <utility>

namespace lacuna::surface {

namespace {

/// Sides longer than kLong times the size are split, and sides shorter than kShort times the size are
/// collapsed (@cite botsch_2004_remeshing). With these values, both halves of a split side are nearer to the
/// size than the whole side was.
constexpr double kLong = 4.0 / 3, kShort = 4.0 / 5;
/// Tangent of 15°: the smallest angle that a collapse or a move may create. Later flips and moves
/// approximately double such small angles.
constexpr double kPoorAngle = 0.27;
/// Maximum number of triangles, as a multiple of the estimate from area and size before the first round.
/// Skins with badly shaped triangles need at most twice the estimate. Without a limit, splitting would not
/// end next to folded facets.
constexpr double kMostOfEstimate = 4;

} // namespace

double SkinRemesher::ratio(Index s) const
{
    const auto size = [&](Index node) { return mesh_.nodes[index(node)].size; };
    return 2 * mesh_.length(s) / (size(mesh_.from(s)) + size(mesh_.to(s)));
}

double SkinRemesher::worst_around(Index node, const Vec3& place) const
{
    double worst = kInfinity;
    mesh_.each_out(node, [&](Index s) { worst = std::min(worst, mesh_.quality(s, node, place)); });
    return worst;
}

void SkinRemesher::set_normals(Index node)
{
    const Index line = mesh_.nodes[index(node)].line;
    if (line >= 0 && !lines_[index(line)].edge.valid()) return; // a crease has the same face on both sides
    FaceId known;
    Vec3 normal = Vec3::Zero();
    mesh_.each_out(node, [&](Index s) {
        const FaceId face = mesh_.owner(s).face;
        if (mesh_.owner(s).kept) return;
        if (face != known) normal = shapes_[face.index()].closest(mesh_.at(node)).normal;
        known = face;
        mesh_.sides[index(s)].normal = normal;
    });
}

// --- splitting ------------------------------------------------------------------------------------------

Index SkinRemesher::try_split(Index s)
{
    const Index g = mesh_.twin(s), line = mesh_.line(s);
    if (mesh_.is_kept(s) || (line >= 0 && lines_[index(line)].kept)) return -1;
    // A triangle without height is flipped or collapsed first. It is not split, because its parts would have
    // no height either.
    if (line < 0 && std::min(std::abs(mesh_.quality(s)), std::abs(mesh_.quality(g))) < kVisible) return -1;
    const auto& side = mesh_.sides;
    const auto normal_at = [&](Index x) {
        return Vec3(side[index(x)].normal + side[index(LinkedTriangles::next(x))].normal).stableNormalized();
    };
    std::array<Vec3, 2> normals{normal_at(s), normal_at(g)};
    const Vec3 &a = mesh_.at(mesh_.from(s)), &b = mesh_.at(mesh_.to(s));
    const Vec3 &c = mesh_.at(mesh_.apex(s)), &d = mesh_.at(mesh_.apex(g));
    const auto is_upright = [&](const Vec3& m) {
        const Vec3 left = normals[0], right = normals[1];
        return std::min({triangle_quality(a, m, c, left), triangle_quality(m, b, c, left),
                         triangle_quality(b, m, d, right), triangle_quality(m, a, d, right)}) > 0;
    };
    LinkedTriangles::Node node;
    node.at = (a + b) / 2;
    node.line = line;
    if (line >= 0) {
        const Vec3 place = lines_[index(line)].point((side[index(s)].s + side[index(g)].s) / 2);
        if (is_upright(place)) node.at = place;
    } else {
        const auto place = shapes_[mesh_.owner(s).face.index()].closest(node.at);
        normals = {place.normal, place.normal};
        const bool halves = (place.point - node.at).norm() < (b - a).norm() / 4;
        if (halves && is_upright(place.point)) node.at = place.point;
    }
    node.size = size_(node.at);
    // A node that is this close to others is not inserted, because it would be collapsed again.
    const double close = std::min((c - node.at).norm(), (d - node.at).norm());
    if (line < 0 && close < kOnePoint * node.size) return -1;
    return mesh_.split(s, node, normals);
}

double SkinRemesher::most_sides() const
{
    double estimate = 0; // estimated number of triangles
    for (std::size_t i = 0; i < mesh_.sides.size(); i += 3) {
        const auto s = static_cast<Index>(i);
        if (!mesh_.lives(s)) continue;
        const Vec3 &a = mesh_.at(mesh_.from(s)), &b = mesh_.at(mesh_.to(s)), &c = mesh_.at(mesh_.apex(s));
        const double size = size_((a + b + c) / 3);
        estimate += 1 + (b - a).cross(c - a).norm() / (size * size);
    }
    if (!(estimate <= kMostCells))
        throw NotSweepable(Message("surface.skin_count",
                                   "the skin needs {:.2g} triangles; at most {:.2g} are allowed",
                                   found(estimate), needed(kMostCells))
                               .remedy("use a larger 'size'"));
    return static_cast<double>(mesh_.sides.size()) + 3 * kMostOfEstimate * estimate;
}

bool SkinRemesher::split_long(double most)
{
    bool any = false;
    std::priority_queue<std::pair<double, Index>> queue;
    const auto add = [&](Index s) {
        s = std::min(s, mesh_.twin(s));
        if (const double r = ratio(s); r > kLong) queue.emplace(r, s);
    };
    for (std::size_t i = 0; i < mesh_.sides.size(); ++i) {
        const auto s = static_cast<Index>(i);
        if (mesh_.lives(s) && s < mesh_.twin(s)) add(s);
    }
    while (!queue.empty() && static_cast<double>(mesh_.sides.size()) < most) {
        check_cancelled(context_);
        const auto [before, s] = queue.top();
        queue.pop();
        const double now = ratio(s);
        if (now != before) { // the side was changed by a flip or by another split
            add(s);
            continue;
        }
        const Index node = try_split(s);
        if (node < 0) continue;
        any = true;
        std::vector<Index> open;
        mesh_.each_out(node, [&](Index x) { open.push_back(LinkedTriangles::next(x)); });
        for (const Index x : flip_from(std::move(open))) add(x);
        mesh_.each_out(node, add);
    }
    return any;
}

// --- collapsing -----------------------------------------------------------------------------------------

bool SkinRemesher::try_collapse(Index s, double least)
{
    const Index u = mesh_.from(s), v = mesh_.to(s);
    const LinkedTriangles::Node& node = mesh_.nodes[index(u)];
    if (node.fixed || (node.line >= 0 && node.line != mesh_.line(s))) return false;
    const Vec3& place = mesh_.at(v);
    const double longest = least < kInfinity ? kLong : 2 * kLong; // small angles are worse than long sides
    const double before = std::min(least, worst_around(u, node.at));
    bool good = true;
    mesh_.each_out(u, [&](Index x) {
        const Index w = mesh_.to(x);
        if (!good || w == v) return;
        const double size = (mesh_.nodes[index(w)].size + mesh_.nodes[index(v)].size) / 2;
        good = (mesh_.at(w) - place).norm() <= longest * size;
        if (good && w != mesh_.apex(mesh_.twin(s))) good = mesh_.quality(x, u, place) >= before;
    });
    if (!good || !mesh_.can_collapse(s)) return false;
    mesh_.collapse(s);
    return true;
}

bool SkinRemesher::collapse_short()
{
    bool any = false;
    std::vector<std::pair<double, Index>> shorts;
    for (std::size_t i = 0; i < mesh_.sides.size(); ++i) {
        const auto s = static_cast<Index>(i);
        if (!mesh_.lives(s) || mesh_.twin(s) < s) continue;
        if (const double r = ratio(s); r < kShort) shorts.emplace_back(r, s);
    }
    std::ranges::sort(shorts);
    for (const auto& [before, s] : shorts) {
        check_cancelled(context_);
        if (!mesh_.lives(s) || ratio(s) >= kShort) continue;
        any = try_collapse(s, kPoorAngle) || try_collapse(mesh_.twin(s), kPoorAngle) || any;
    }
    return any;
}

// --- flipping -------------------------------------------------------------------------------------------

bool SkinRemesher::is_better_flipped(Index s) const
{
    const Index g = mesh_.twin(s);
    if (mesh_.line(s) >= 0 || mesh_.is_kept(s)) return false;
    const Index sn = LinkedTriangles::next(s), sp = LinkedTriangles::prev(s);
    const Index gn = LinkedTriangles::next(g), gp = LinkedTriangles::prev(g);
    const Index a = mesh_.from(s), b = mesh_.to(s), c = mesh_.apex(s), d = mesh_.apex(g);
    const auto normal = [&](Index x) -> const Vec3& { return mesh_.sides[index(x)].normal; };
    const double before = std::min(mesh_.quality(s), mesh_.quality(g));
    const double after = std::min(
        triangle_quality(mesh_.at(c), mesh_.at(d), mesh_.at(b), normal(sp) + normal(gp) + normal(sn)),
        triangle_quality(mesh_.at(d), mesh_.at(c), mesh_.at(a), normal(sp) + normal(gp) + normal(gn)));
    return c != d && after > before + kFileAccuracy * std::abs(before) && mesh_.valence(a) > 3 &&
           mesh_.valence(b) > 3 && !mesh_.are_neighbours(c, d);
}

std::vector<Index> SkinRemesher::flip_from(std::vector<Index> open)
{
    std::vector<Index> flipped;
    while (!open.empty()) {
        const Index s = open.back();
        open.pop_back();
        if (!mesh_.lives(s) || !is_better_flipped(s)) continue;
        check_cancelled(context_);
        mesh_.flip(s);
        flipped.push_back(s);
        const Index g = mesh_.twin(s);
        for (const Index x : {s, g}) {
            open.push_back(LinkedTriangles::next(x));
            open.push_back(LinkedTriangles::prev(x));
        }
    }
    return flipped;
}

void SkinRemesher::flip_all()
{
    std::vector<Index> open;
    for (std::size_t i = mesh_.sides.size(); i-- > 0;) {
        const auto s = static_cast<Index>(i);
        if (mesh_.lives(s) && s < mesh_.twin(s)) open.push_back(s);
    }
    flip_from(std::move(open));
}

// --- moving ---------------------------------------------------------------------------------------------

Vec3 SkinRemesher::centre_around(Index node) const
{
    Vec3 sum = Vec3::Zero();
    double total = 0;
    mesh_.each_out(node, [&](Index s) {
        const Index b = mesh_.to(s), c = mesh_.apex(s);
        const Vec3 &p = mesh_.at(node), &q = mesh_.at(b), &r = mesh_.at(c);
        const double size = mesh_.nodes[index(b)].size + mesh_.nodes[index(c)].size;
        const double weight = (q - p).cross(r - p).norm() / (size * size);
        sum += weight * (p + q + r) / 3;
        total += weight;
    });
    return total > 0 ? Vec3(sum / total) : mesh_.at(node);
}

bool SkinRemesher::move_to(Index node, const Vec3& place, double least)
{
    LinkedTriangles::Node& own = mesh_.nodes[index(node)];
    if (worst_around(node, place) < std::min(least, worst_around(node, own.at))) return false;
    own.at = place;
    own.size = size_(place);
    set_normals(node);
    return true;
}

bool SkinRemesher::move_along_line(Index node, double least)
{
    const Index line = mesh_.nodes[index(node)].line;
    std::array<Index, 2> out{-1, -1};
    std::size_t count = 0;
    mesh_.each_out(node, [&](Index s) {
        if (mesh_.line(s) == line && count < 2) out[count++] = s;
    });
    if (count < 2) return false;
    std::array<double, 2> s{}, size{};
    for (std::size_t k = 0; k < 2; ++k) {
        s[k] = mesh_.sides[index(mesh_.twin(out[k]))].s;
        size[k] = mesh_.nodes[index(mesh_.to(out[k]))].size;
    }
    const double where = (s[0] * size[1] + s[1] * size[0]) / (size[0] + size[1]);
    if (!move_to(node, lines_[index(line)].point(where), least)) return false;
    for (const Index x : out) mesh_.sides[index(x)].s = where;
    return true;
}

void SkinRemesher::smooth(double least)
{
    for (std::size_t i = 0; i < mesh_.nodes.size(); ++i) {
        const LinkedTriangles::Node& node = mesh_.nodes[i];
        const auto n = static_cast<Index>(i);
        if (node.fixed || node.out < 0) continue;
        check_cancelled(context_);
        if (node.line >= 0)
            move_along_line(n, least);
        else
            move_to(n, shape_at(n).closest(centre_around(n)).point, least);
    }
}

const FaceShapeTree& SkinRemesher::shape_at(Index node) const
{
    return shapes_[mesh_.owner(mesh_.nodes[index(node)].out).face.index()];
}

void SkinRemesher::make_exact(const topology::Model& model)
{
    std::map<Index, std::vector<std::pair<Index, double>>> on_line;
    std::map<FaceId, std::vector<Index>> in_face;
    for (std::size_t i = 0; i < mesh_.nodes.size(); ++i) {
        const LinkedTriangles::Node& node = mesh_.nodes[i];
        const auto n = static_cast<Index>(i);
        if (node.fixed || node.out < 0) continue;
        if (node.line < 0) {
            in_face[mesh_.owner(node.out).face].push_back(n);
            continue;
        }
        mesh_.each_out(n, [&](Index s) {
            if (mesh_.line(s) != node.line) return;
            std::vector<std::pair<Index, double>>& nodes = on_line[node.line];
            if (nodes.empty() || nodes.back().first != n) nodes.emplace_back(n, mesh_.sides[index(s)].s);
        });
    }
    for (const auto& [number, nodes] : on_line) {
        const SkinLine& line = lines_[index(number)];
        if (!line.edge.valid()) continue;
        std::vector<double> fractions;
        for (const auto& [node, s] : nodes) fractions.push_back(s / line.arc.back());
        const std::vector<Vec3> places = edge_points(model, line.edge, fractions);
        for (std::size_t i = 0; i < nodes.size(); ++i) mesh_.nodes[index(nodes[i].first)].at = places[i];
    }
    for (const auto& [face, nodes] : in_face) {
        std::vector<Vec3> places;
        for (const Index n : nodes) places.push_back(mesh_.at(n));
        shapes_[face.index()].make_exact(places, context_);
        for (std::size_t i = 0; i < nodes.size(); ++i) mesh_.nodes[index(nodes[i])].at = places[i];
    }
}

// --- small angles ---------------------------------------------------------------------------------------

/// Move a node of a triangle or collapse one of its sides, if this increases its smallest angle.
bool SkinRemesher::improve(Index side, bool moves)
{
    const double before = mesh_.quality(side);
    std::array<Index, 3> sides{side, LinkedTriangles::next(side), LinkedTriangles::prev(side)};
    for (const Index s : sides) {
        const Index n = mesh_.from(s);
        const LinkedTriangles::Node& node = mesh_.nodes[index(n)];
        if (node.fixed || !moves) continue;
        if (node.line >= 0) {
            if (move_along_line(n, kInfinity) && mesh_.quality(side) > before) return true;
            continue;
        }
        if (move_to(n, shape_at(n).closest(centre_around(n)).point, kInfinity) &&
            mesh_.quality(side) > before)
            return true;
    }
    std::ranges::sort(sides, {}, [&](Index s) { return mesh_.length(s); });
    for (const Index s : sides) {
        if (try_collapse(s, kInfinity) || try_collapse(mesh_.twin(s), kInfinity)) return true;
    }
    return false;
}

void SkinRemesher::improve(bool moves)
{
    // Triangles with an angle below 30°, half of an equilateral triangle's, are improved one by one.
    const double good = std::numbers::inv_sqrt3;
    flip_all();
    for (int round = 0; round < kMostSteps; ++round) {
        std::vector<std::pair<double, Index>> poor;
        for (std::size_t i = 0; i < mesh_.sides.size(); i += 3) {
            const auto s = static_cast<Index>(i);
            if (!mesh_.lives(s) || mesh_.owner(s).kept) continue;
            if (const double q = mesh_.quality(s); q < good) poor.emplace_back(q, s);
        }
        std::ranges::sort(poor);
        bool any = false;
        for (const auto& [before, s] : poor) {
            check_cancelled(context_);
            if (mesh_.lives(s) && mesh_.quality(s) < good) any = improve(s, moves) || any;
        }
        flip_all();
        if (!any) break;
    }
}

void SkinRemesher::run(const topology::Model& model)
{
    flip_all();
    // Compute the limit before the first round: where facets fold, each round adds triangles and area, so a
    // limit computed later would be too large.
    const double most = most_sides();
    for (int round = 0; round < kMostSteps; ++round) {
        const bool split = split_long(most), collapsed = collapse_short();
        flip_all();
        smooth(kPoorAngle);
        flip_all();
        if (!split && !collapsed) break;
    }
    improve(true);
    make_exact(model);
    improve(false); // exact positions may make triangles worse: in narrow places, a node may cross a border
}

} // namespace lacuna::surface
