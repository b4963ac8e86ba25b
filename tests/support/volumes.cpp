// SPDX-License-Identifier: MIT
#include "support/volumes.h"

#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/healing/split_facets.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>
#include <random>

namespace lacuna::test {

using namespace topology;

namespace {

constexpr double kPi = std::numbers::pi;

/// A closed loop in the plane, region on the left, cut into sides and those into pieces.
struct SectionLoop {
    std::vector<Vec2> points;
    std::vector<std::size_t> start; ///< first point of each wall, side by side, piece by piece
    int sides = 1;
};

/// A loop through corners, each straight side cut `between` times.
SectionLoop loop_through(const std::vector<Vec2>& corners, int between, int sides,
                         const PrismOptions& options)
{
    SectionLoop loop;
    loop.sides = sides;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (int k = 0; k < between; ++k) {
            const double f = static_cast<double>(k) / between;
            loop.points.push_back((1 - f) * corners[i] + f * corners[(i + 1) % corners.size()]);
        }
    }
    const std::size_t walls = static_cast<std::size_t>(loop.sides) * static_cast<std::size_t>(options.pieces);
    for (std::size_t w = 0; w < walls; ++w) loop.start.push_back(w * loop.points.size() / walls);
    return loop;
}

SectionLoop section_loop(int sides, double radius, const Vec2& centre, bool hole, const PrismOptions& options)
{
    const bool round = sides == 0;
    std::vector<Vec2> corners(static_cast<std::size_t>(round ? 12 * options.cuts * options.pieces : sides));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double angle = (hole ? -2 : 2) * kPi * static_cast<double>(i) /
                             static_cast<double>(corners.size());
        corners[i] = centre + radius * Vec2(std::cos(angle), std::sin(angle));
    }
    return loop_through(corners, round ? 1 : options.cuts * options.pieces, round ? 1 : sides, options);
}

std::vector<SectionLoop> section_of(const PrismOptions& o)
{
    std::vector<SectionLoop> section{o.outline.empty() ? section_loop(o.sides, o.radius, Vec2(0, 0), false, o)
                                                       : loop_through(o.outline, o.cuts * o.pieces,
                                                                      static_cast<int>(o.outline.size()), o)};
    if (!o.hole_list.empty() || !o.outline.empty()) {
        for (const RoundHole& hole : o.hole_list)
            section.push_back(section_loop(0, hole.radius, hole.centre, true, o));
        return section;
    }
    const double inner = o.sides == 0 ? o.radius : o.radius * std::cos(kPi / o.sides);
    const double reach = o.holes == 1 ? 0 : 0.55 * inner;
    const double room = o.holes == 1 ? inner
                                     : std::min(reach * std::sin(kPi / std::max(o.holes, 2)), inner - reach);
    for (int h = 0; h < o.holes; ++h) {
        // Off the section's own symmetry, so that loops and turns can be told.
        const double angle = 2 * kPi * h / o.holes + 0.1;
        const double radius = (0.45 + 0.15 * h / o.holes) * room;
        section.push_back(
            section_loop(o.hole_sides, radius, reach * Vec2(std::cos(angle), std::sin(angle)), true, o));
    }
    return section;
}

Vec3 carried(const PrismOptions& o, const Vec2& p, double t)
{
    const double angle = o.twist * kPi / 180 * t;
    const double size = (1 + (o.taper - 1) * t) * (1 + (o.belly - 1) * 4 * t * (1 - t));
    const Vec2 q(size * (std::cos(angle) * p.x() - std::sin(angle) * p.y()),
                 size * (std::sin(angle) * p.x() + std::cos(angle) * p.y()));
    double along = o.height * t;
    if (o.target == End::tilted) along += t * o.lift * p.x() / o.radius;
    const double outward = 1 - p.squaredNorm() / (o.radius * o.radius);
    if (o.target == End::bowed) along += t * o.lift * outward;
    if (o.target == End::saddle)
        along += t * o.lift * (p.x() * p.x() - p.y() * p.y()) / (o.radius * o.radius);
    if (o.source == End::bowed) along -= (1 - t) * o.lift * outward;
    const double bend = o.bend * kPi / 180;
    if (bend == 0) return {q.x(), q.y(), along};
    const double r = o.height / bend;
    return {r - (r - q.x()) * std::cos(along / r), q.y(), (r - q.x()) * std::sin(along / r)};
}

/// Collects the faces of the whole, and the soup of those that are left.
class Builder {
public:
    explicit Builder(const PrismOptions& options) : o_(options), section_(section_of(options)) {}

    Prism run()
    {
        add_end(Role::source, 0);
        add_end(Role::target, 1);
        for (std::size_t l = 0; l < section_.size(); ++l) {
            for (std::size_t w = 0; w < section_[l].start.size(); ++w) {
                for (int row = 0; row < o_.rows; ++row) add_wall(l, w, row);
            }
        }
        for (const Triangle& t : whole_) {
            result_.facet_volume += at(t[0]).dot(at(t[1]).cross(at(t[2]))) / 6;
        }
        result_.volume = formula();
        if (result_.soup.triangles.empty()) return std::move(result_);
        healing::SplitOptions split;
        split.whole_labels = true;
        split.feature_angle = o_.feature_angle;
        result_.model = healing::split_facets(result_.soup, split);
        for (std::size_t f = 0; f < result_.model.faces.size(); ++f) {
            const auto label = static_cast<std::size_t>(std::stoi(result_.model.faces[f].name.substr(1)));
            result_.part.push_back(parts_[label]);
            const Role role = parts_[label].role;
            auto& list = role == Role::source   ? result_.roles.source
                         : role == Role::target ? result_.roles.target
                                                : result_.roles.walls;
            list.emplace_back(f);
        }
        return std::move(result_);
    }

private:
    [[nodiscard]] const Vec3& at(Index p) const { return result_.soup.points[static_cast<std::size_t>(p)]; }

    void add_face(const Part& part, const std::vector<Vec3>& points, std::vector<Triangle> triangles)
    {
        const auto base = static_cast<Index>(result_.soup.points.size());
        result_.soup.points.insert(result_.soup.points.end(), points.begin(), points.end());
        for (Triangle& t : triangles) {
            for (Index& p : t) p += base;
        }
        whole_.insert(whole_.end(), triangles.begin(), triangles.end());
        if (o_.drop && o_.drop(part)) return;
        const int label = static_cast<int>(parts_.size());
        parts_.push_back(part);
        // A word that is no role, so that names stay what they are.
        result_.soup.label_name.push_back("f" + std::to_string(label));
        for (const Triangle& t : triangles) {
            result_.soup.triangles.push_back(t);
            result_.soup.triangle_label.push_back(label);
        }
    }

    void add_end(Role role, double t)
    {
        std::vector<Vec2> flat;
        std::vector<std::vector<Index>> loops;
        for (const SectionLoop& loop : section_) {
            loops.emplace_back();
            for (const Vec2& p : loop.points) {
                loops.back().push_back(static_cast<Index>(flat.size()));
                flat.push_back(p);
            }
        }
        geometry::TriangulateOptions options;
        options.grading = 0.5;
        geometry::Triangulation section = geometry::triangulate(flat, loops, options);
        std::vector<Vec3> points;
        for (const Vec2& p : section.points) points.push_back(carried(o_, p, t));
        if (role == Role::source) {
            for (Triangle& triangle : section.triangles) std::swap(triangle[1], triangle[2]);
        }
        add_face({role, 0, 0, 0, 0}, points, section.triangles);
    }

    void add_wall(std::size_t l, std::size_t w, int row)
    {
        const SectionLoop& loop = section_[l];
        const std::size_t n = loop.points.size();
        const std::size_t first = loop.start[w];
        const std::size_t last = w + 1 < loop.start.size() ? loop.start[w + 1] : n;
        std::vector<Vec3> points;
        std::vector<Triangle> triangles;
        const auto columns = static_cast<Index>(last - first + 1);
        for (int level = 0; level <= o_.levels; ++level) {
            const double t = (row + static_cast<double>(level) / o_.levels) / o_.rows;
            for (std::size_t i = first; i <= last; ++i) points.push_back(carried(o_, loop.points[i % n], t));
        }
        for (Index level = 0; level < o_.levels; ++level) {
            for (Index i = 0; i + 1 < columns; ++i) {
                const Index a = level * columns + i, b = a + 1;
                triangles.push_back({a, b, b + columns});
                triangles.push_back({a, b + columns, a + columns});
            }
        }
        const int side = static_cast<int>(w) / o_.pieces;
        add_face({Role::wall, static_cast<int>(l), side, row, static_cast<int>(w) % o_.pieces}, points,
                 triangles);
    }

    /// A straight or tapered prism over the polygons, its target planar or tilted; else the facets' own
    /// volume.
    [[nodiscard]] double formula() const
    {
        double area = 0;
        Vec2 moment = Vec2::Zero();
        for (const SectionLoop& loop : section_) {
            for (std::size_t i = 0; i < loop.points.size(); ++i) {
                const Vec2& a = loop.points[i];
                const Vec2& b = loop.points[(i + 1) % loop.points.size()];
                const double cross = a.x() * b.y() - a.y() * b.x();
                area += cross / 2;
                moment += cross / 6 * (a + b);
            }
        }
        if (o_.target == End::bowed || o_.target == End::saddle || o_.source == End::bowed || o_.belly != 1)
            return result_.facet_volume;
        if (o_.target == End::tilted && (o_.twist != 0 || o_.taper != 1 || o_.bend != 0))
            return result_.facet_volume;
        const double k = o_.taper;
        double sum = area * o_.height * (1 + k + k * k) / 3;
        if (o_.target == End::tilted) sum += o_.lift * moment.x() / o_.radius;
        // Pappus: what lies on the bend's inner side is shorter. A taper or a twist moves the centroid: not
        // told here.
        if (o_.bend != 0 && (k != 1 || o_.twist != 0)) return result_.facet_volume;
        return sum - o_.bend * kPi / 180 * moment.x();
    }

    const PrismOptions& o_;
    std::vector<SectionLoop> section_;
    Prism result_;
    std::vector<Part> parts_;
    std::vector<Triangle> whole_;
};

} // namespace

FaceId Prism::face(const Part& wanted) const
{
    for (std::size_t f = 0; f < part.size(); ++f) {
        const Part& p = part[f];
        if (p.role != wanted.role) continue;
        if (p.role != Role::wall || (p.loop == wanted.loop && p.side == wanted.side && p.row == wanted.row &&
                                     p.piece == wanted.piece)) {
            return FaceId(f);
        }
    }
    return {};
}

Prism prism(const PrismOptions& options) { return Builder(options).run(); }

std::function<bool(const Part&)> without(bool source, bool target, bool walls, std::vector<int> sides)
{
    return [=](const Part& part) {
        if (part.role == Role::source) return source;
        if (part.role == Role::target) return target;
        return walls || (part.loop == 0 && std::find(sides.begin(), sides.end(), part.side) != sides.end());
    };
}

void add_seam(Model& model, FaceId wall)
{
    const Face& face = model[wall];
    const VertexId from = use_from(model, face.loops.at(0).uses.front());
    const VertexId to = use_from(model, face.loops.at(1).uses.front());
    std::map<Index, std::vector<Index>> next;
    for (const Triangle& t : face.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            next[t[i]].push_back(t[(i + 1) % 3]);
            next[t[(i + 1) % 3]].push_back(t[i]);
        }
    }
    std::map<Index, bool> on_rim;
    for (const Loop& loop : face.loops) {
        for (const EdgeUse& use : loop.uses) {
            for (const Index p : model[use.edge].points) on_rim[p] = true;
        }
    }
    const Index start = model[from].point, end = model[to].point;
    std::map<Index, double> cost{{start, 0}};
    std::map<Index, Index> back;
    std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, std::greater<>>
        front;
    front.emplace(0, start);
    while (!front.empty()) {
        const auto [c, p] = front.top();
        front.pop();
        if (p == end || c > cost[p]) continue;
        for (const Index q : next[p]) {
            if (q != end && on_rim.contains(q)) continue;
            const double sum = c + (model.at(q) - model.at(p)).norm();
            const auto known = cost.find(q);
            if (known != cost.end() && known->second <= sum) continue;
            cost[q] = sum;
            back[q] = p;
            front.emplace(sum, q);
        }
    }
    Edge seam;
    seam.tag = static_cast<int>(model.edges.size()) + 1;
    seam.from = from;
    seam.to = to;
    for (Index p = end; p != start; p = back.at(p)) seam.points.push_back(p);
    seam.points.push_back(start);
    std::reverse(seam.points.begin(), seam.points.end());
    ModelBuilder builder(std::move(model));
    builder.edges.push_back(std::move(seam));
    builder.build_loops();
    model = std::move(builder).finish();
}

Model moved(Model whole, const std::function<Vec3(const Vec3&)>& map)
{
    ModelBuilder model(std::move(whole));
    Vec3 low = Vec3::Constant(1e300), high = -low;
    for (Vec3& p : model.points) {
        p = map(p);
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    model.diagonal = (high - low).norm();
    model.tolerance = 1e-6 * model.diagonal;
    return std::move(model).finish();
}

healing::FacetSoup scrambled_facets(const healing::FacetSoup& soup, unsigned seed)
{
    std::mt19937 dice(seed);
    healing::FacetSoup result = soup;
    const int labels = *std::max_element(soup.triangle_label.begin(), soup.triangle_label.end()) + 1;
    std::vector<bool> flip(static_cast<std::size_t>(labels));
    for (std::size_t l = 0; l < flip.size(); ++l) flip[l] = dice() % 2 != 0;
    std::vector<std::size_t> order(soup.triangles.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), dice);
    for (std::size_t i = 0; i < order.size(); ++i) {
        Triangle t = soup.triangles[order[i]];
        std::rotate(t.begin(), t.begin() + dice() % 3, t.end());
        result.triangle_label[i] = soup.triangle_label[order[i]];
        if (flip[static_cast<std::size_t>(result.triangle_label[i])]) std::swap(t[1], t[2]);
        result.triangles[i] = t;
    }
    return result;
}

} // namespace lacuna::test
