// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/section.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/plane.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/detail/directed_sides.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/side_points.h>
#include <lacuna/topology/shared/split_edge.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace lacuna::topology {

namespace {

SectionPlace place_between(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// Project points onto a surface and a plane, the plane last.
void lay_onto(const geometry::ExactSurface& surface, const geometry::Plane& plane, std::span<Vec3> points,
              std::span<Vec2> uv, double tolerance, const RunContext& context)
{
    for (int i = 0; i < kMostSteps; ++i) {
        double off = 0;
        for (Vec3& p : points) {
            const double h = geometry::height(plane, p);
            off = std::max(off, std::abs(h));
            p -= h * plane.normal;
        }
        if (i > 0 && off <= 1e-3 * tolerance) return;
        surface.project(points, uv, context);
    }
}

/// The intersection curve of a plane and an exact surface, near a chain of points. Its parameter is the index
/// of a point of the chain.
class SectionCurve : public geometry::ExactCurve {
public:
    SectionCurve(std::shared_ptr<const geometry::ExactSurface> surface, const geometry::Plane& plane,
                 double tolerance, std::vector<Vec3> points, std::vector<std::array<Vec2, 2>> uv)
        : surface_(std::move(surface)),
          plane_(plane),
          tolerance_(tolerance),
          points_(std::move(points)),
          uv_(std::move(uv))
    {
    }

    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& context) const override
    {
        std::vector<Vec2> uv;
        for (std::size_t i = 0; i < params.size(); ++i) {
            const double at = std::clamp(params[i], 0.0, static_cast<double>(uv_.size()));
            const std::size_t k = std::min(static_cast<std::size_t>(at), uv_.size() - 1);
            const double f = at - static_cast<double>(k);
            points[i] = (1 - f) * points_[k] + f * points_[k + 1];
            uv.emplace_back((1 - f) * uv_[k][0] + f * uv_[k][1]);
        }
        lay_onto(*surface_, plane_, points, uv, tolerance_, context);
    }

private:
    std::shared_ptr<const geometry::ExactSurface> surface_;
    geometry::Plane plane_;
    double tolerance_;
    std::vector<Vec3> points_;
    std::vector<std::array<Vec2, 2>> uv_; ///< at both ends of each segment
};

// --- intersection -------------------------------------------------------------------------------------

struct Step {
    SectionPlace from, to;
};

class WalkFinder {
public:
    WalkFinder(const Model& model, const std::vector<FaceId>& faces, const geometry::Plane& plane,
               double tolerance)
        : model_(model), plane_(plane)
    {
        side_.reserve(model.points.size());
        for (const Vec3& p : model.points) {
            const double h = geometry::height(plane, p);
            side_.push_back(std::abs(h) <= tolerance ? 0 : h > 0 ? 1 : -1);
        }
        for (const FaceId face : faces) {
            for (const Triangle& t : model[face].triangles) read(t);
        }
        for (const auto& [key, at] : behind_) {
            const auto [a, b] = at;
            if (before_.contains(directed_key(b, a))) steps_.push_back({{a, -1}, {b, -1}});
        }
        std::ranges::sort(steps_, [](const Step& a, const Step& b) {
            return std::tie(a.from, a.to) < std::tie(b.from, b.to);
        });
    }

    std::vector<SectionWalk> walks()
    {
        std::map<SectionPlace, int> excess;
        for (std::size_t s = 0; s < steps_.size(); ++s) {
            from_[steps_[s].from].push_back(s);
            ++excess[steps_[s].from];
            --excess[steps_[s].to];
        }
        used_.assign(steps_.size(), 0);
        std::vector<SectionWalk> result;
        for (std::size_t s = 0; s < steps_.size(); ++s)
            if (used_[s] == 0 && excess.at(steps_[s].from) > 0) result.push_back(walk(s));
        for (std::size_t s = 0; s < steps_.size(); ++s)
            if (used_[s] == 0) result.push_back(walk(s));
        return result;
    }

private:
    void read(const Triangle& t)
    {
        const std::array<int, 3> s{side_[index(t[0])], side_[index(t[1])], side_[index(t[2])]};
        const bool before = std::ranges::find(s, 1) != s.end(), behind = std::ranges::find(s, -1) != s.end();
        if (before && behind) {
            Step step;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
                if (s[k] * s[l] < 0) (s[k] < 0 ? step.from : step.to) = place_between(t[k], t[l]);
                if (s[k] == 0 && s[l] * s[m] < 0) (s[m] < 0 ? step.from : step.to) = {t[k], -1};
            }
            steps_.push_back(step);
            return;
        }
        bool is_behind = behind;
        if (!before && !behind) {
            const Vec3 area = (model_.at(t[1]) - model_.at(t[0])).cross(model_.at(t[2]) - model_.at(t[0]));
            is_behind = area.dot(plane_.normal) > 0;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            if (side_[index(a)] != 0 || side_[index(b)] != 0) continue;
            if (is_behind)
                behind_.emplace(directed_key(a, b), std::pair(a, b));
            else
                before_.insert(directed_key(a, b));
        }
    }

    [[nodiscard]] Vec2 flat(const SectionPlace& place) const
    {
        return geometry::to_plane(plane_, place_at(model_, place, plane_));
    }

    SectionWalk walk(std::size_t start)
    {
        SectionWalk result;
        for (std::size_t s = start;;) {
            used_[s] = 1;
            result.places.push_back(steps_[s].from);
            const SectionPlace& at = steps_[s].to;
            if (at == steps_[start].from) {
                result.closed = true;
                return result;
            }
            // Where walks touch, turn right as sharply as possible, so that each walk stays a simple loop.
            std::size_t next = steps_.size();
            double best = 0;
            const auto onward = from_.find(at);
            if (onward != from_.end()) {
                for (const std::size_t other : onward->second) {
                    if (used_[other] != 0) continue;
                    const double turn = onward->second.size() == 1
                                            ? 0
                                            : geometry::turn_between(flat(steps_[s].from) - flat(at),
                                                                     flat(steps_[other].to) - flat(at));
                    if (next != steps_.size() && turn >= best) continue;
                    best = turn;
                    next = other;
                }
            }
            if (next == steps_.size()) {
                result.places.push_back(at);
                return result;
            }
            s = next;
        }
    }

    const Model& model_;
    const geometry::Plane& plane_;
    std::vector<signed char> side_; ///< for each point: -1 behind the plane, 0 on it, 1 in front of it
    std::vector<Step> steps_;
    std::map<std::uint64_t, std::pair<Index, Index>> behind_; ///< sides in the plane, of facets behind it
    std::unordered_set<std::uint64_t> before_;
    std::map<SectionPlace, std::vector<std::size_t>> from_;
    std::vector<char> used_;
};

// --- imprinting ---------------------------------------------------------------------------------------

class WalkImprinter {
public:
    WalkImprinter(ModelBuilder& model, std::span<const SectionWalk> walks, const geometry::Plane& plane,
                  double tolerance, const RunContext& context)
        : model_(model), walks_(walks), plane_(plane), tolerance_(tolerance), context_(context)
    {
    }

    WalkImprint run()
    {
        make_points();
        find_segments();
        refuse_split_quads();
        for (Face& face : model_.faces) cut_at_sides(model_.points, face, sides_);
        make_vertices();
        split_edges();
        make_edges();
        WalkImprint result;
        result.lines = lines();
        split_faces(result.parent);
        model_.build_loops();
        return result;
    }

private:
    [[nodiscard]] Index point(const SectionPlace& place) const
    {
        return place.b < 0 ? place.a : made_.at(place);
    }
    /// The points of a walk, starting at its place `first`. In a closed walk, the first point is repeated at
    /// the end.
    [[nodiscard]] std::vector<Index> points_along(const SectionWalk& walk, std::ptrdiff_t first = 0) const
    {
        std::vector<Index> points;
        for (const SectionPlace& place : walk.places) points.push_back(point(place));
        std::rotate(points.begin(), points.begin() + first, points.end());
        if (walk.closed) points.push_back(points.front());
        return points;
    }

    void make_points()
    {
        for (const SectionWalk& walk : walks_) {
            for (const SectionPlace& place : walk.places) {
                if (place.b < 0 || made_.contains(place)) continue;
                const double ha = geometry::height(plane_, model_.at(place.a)),
                             hb = geometry::height(plane_, model_.at(place.b));
                const double f = ha / (ha - hb);
                made_.emplace(place, static_cast<Index>(model_.points.size()));
                model_.points.emplace_back((1 - f) * model_.at(place.a) + f * model_.at(place.b));
            }
        }
        lay_onto_faces();
        lay_onto_edges();
        for (const auto& [place, p] : made_) sides_.add(place.a, place.b, {p});
    }

    void lay_onto_faces()
    {
        for (const Face& face : model_.faces) {
            if (!face.surface) continue;
            std::map<Index, Vec2> start;
            for (std::size_t t = 0; t < face.triangles.size(); ++t) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::size_t l = (k + 1) % 3;
                    const auto found = made_.find(place_between(face.triangles[t][k], face.triangles[t][l]));
                    if (found == made_.end()) continue;
                    const double f = fraction_along(model_.at(found->second), model_.at(face.triangles[t][k]),
                                                    model_.at(face.triangles[t][l]));
                    start.try_emplace(found->second, (1 - f) * face.uv[t][k] + f * face.uv[t][l]);
                }
            }
            if (start.empty()) continue;
            std::vector<Vec3> points;
            std::vector<Vec2> uv;
            for (const auto& [p, at] : start) {
                points.push_back(model_.at(p));
                uv.push_back(at);
            }
            lay_onto(*face.surface, plane_, points, uv, tolerance_, context_);
            std::size_t i = 0;
            for (const auto& [p, at] : start) model_.points[index(p)] = points[i++];
        }
    }

    /// Insert the new points into the chains of edges. On an edge with an exact curve, the point moves to
    /// where the curve meets the plane.
    void lay_onto_edges()
    {
        for (Edge& edge : model_.edges) {
            for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
                const auto found = made_.find(place_between(edge.points[i], edge.points[i + 1]));
                if (found == made_.end()) continue;
                const auto after = static_cast<std::ptrdiff_t>(i) + 1;
                if (edge.curve && !edge.params.empty()) {
                    Vec3& place = model_.points[index(found->second)];
                    double low = edge.params[i], high = edge.params[i + 1], middle = low;
                    const bool rises = geometry::height(plane_, model_.at(edge.points[i])) < 0;
                    for (int k = 0; k < std::numeric_limits<double>::digits; ++k) {
                        middle = (low + high) / 2;
                        edge.curve->evaluate({&middle, 1}, {&place, 1}, context_);
                        const double h = geometry::height(plane_, place);
                        if (std::abs(h) <= 1e-3 * tolerance_) break;
                        ((h < 0) == rises ? low : high) = middle;
                    }
                    place -= geometry::height(plane_, place) * plane_.normal;
                    edge.params.insert(edge.params.begin() + after, middle);
                } else if (!edge.params.empty()) {
                    edge.params.insert(edge.params.begin() + after,
                                       (edge.params[i] + edge.params[i + 1]) / 2);
                }
                edge.points.insert(edge.points.begin() + after, found->second);
                ++i;
            }
        }
    }

    void refuse_split_quads() const
    {
        for (std::size_t f = 0; f < model_.faces.size(); ++f) {
            for (const Quad& quad : model_.faces[f].given_quads) {
                bool cut = walked_.contains(edge_key(quad[0], quad[2])) ||
                           walked_.contains(edge_key(quad[1], quad[3]));
                for (std::size_t k = 0; k < 4; ++k)
                    cut = cut || made_.contains(place_between(quad[k], quad[(k + 1) % 4])) ||
                          made_.contains(place_between(quad[k], quad[(k + 2) % 4]));
                if (!cut) continue;
                throw InvalidInput(Message("topology.splits_mesh",
                                           "the cut crosses given quads of {}, which are kept",
                                           entity_of(model_, FaceId(f)))
                                       .remedy("move the plane onto mesh lines of that mesh, or load it with "
                                               "keep_mesh = false"));
            }
        }
    }

    void find_segments()
    {
        const auto add = [](std::unordered_set<std::uint64_t>& sides, const std::vector<Index>& points) {
            for (std::size_t i = 0; i + 1 < points.size(); ++i)
                sides.insert(edge_key(points[i], points[i + 1]));
        };
        for (const SectionWalk& walk : walks_) add(walked_, points_along(walk));
        for (const Edge& edge : model_.edges) add(edge_sides_, edge.points);
    }

    /// Make a vertex where a walk crosses an edge, or where it leaves one. A closed walk that meets no vertex
    /// gets one at its first point.
    void make_vertices()
    {
        std::unordered_set<Index> at_edge;
        for (const Edge& edge : model_.edges) at_edge.insert(edge.points.begin(), edge.points.end());
        for (const Vertex& vertex : model_.vertices) vertex_points_.insert(vertex.point);
        for (const SectionWalk& walk : walks_) {
            const std::vector<Index> points = points_along(walk);
            const std::size_t count = points.size() - 1;
            const auto runs_along = [&](std::size_t i) {
                return edge_sides_.contains(edge_key(points[i], points[i + 1]));
            };
            for (std::size_t i = 0; i < walk.places.size(); ++i) {
                const bool end = !walk.closed && (i == 0 || i == count);
                const bool leaves = end || !runs_along(i % count) || !runs_along((i + count - 1) % count);
                if (at_edge.contains(points[i]) ? leaves : end) vertex_points_.insert(points[i]);
            }
            const bool any = std::ranges::any_of(points, [&](Index p) { return vertex_points_.contains(p); });
            if (!any) vertex_points_.insert(points.front());
        }
        for (const Vertex& vertex : model_.vertices) vertex_points_.erase(vertex.point);
        for (const Index p : vertex_points_) vertex_at_.emplace(p, model_.add_void_vertex(p));
        for (std::size_t v = 0; v < model_.vertices.size(); ++v)
            vertex_at_.emplace(model_.vertices[v].point, VertexId(v));
    }

    void split_edges()
    {
        std::array<int, 2> next{next_tag(model_.edges, Origin::given),
                                next_tag(model_.edges, Origin::made_void)};
        const std::size_t before = model_.edges.size();
        for (std::size_t e = 0; e < before; ++e) {
            const Edge& whole = model_.edges[e];
            std::vector<std::pair<std::size_t, VertexId>> cuts;
            for (std::size_t i = 1; i + 1 < whole.points.size(); ++i)
                if (vertex_points_.contains(whole.points[i]))
                    cuts.emplace_back(i, vertex_at_.at(whole.points[i]));
            if (cuts.empty()) continue;
            std::vector<Edge> parts = divided(whole, cuts);
            for (std::size_t k = 1; k < parts.size(); ++k) {
                parts[k].tag = next[parts[k].origin == Origin::given ? 0 : 1]++;
                model_.edges.push_back(std::move(parts[k]));
            }
            model_.edges[e] = std::move(parts.front());
        }
    }

    /// Make edges of the parts of walks that run across faces.
    void make_edges()
    {
        // Face and facet of each directed side.
        std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>> facet;
        for (std::size_t f = 0; f < model_.faces.size(); ++f) {
            if (!model_.faces[f].surface) continue;
            const std::vector<Triangle>& triangles = model_.faces[f].triangles;
            for (std::size_t t = 0; t < triangles.size(); ++t) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint64_t side = directed_key(triangles[t][k], triangles[t][(k + 1) % 3]);
                    if (walked_.contains(edge_key(triangles[t][k], triangles[t][(k + 1) % 3])))
                        facet.emplace(side, std::pair(f, t));
                }
            }
        }
        for (const SectionWalk& walk : walks_) {
            const std::vector<Index> points = points_along(walk, first_vertex(walk));
            std::vector<Index> chain;
            for (std::size_t k = 0; k + 1 < points.size(); ++k) {
                const Index a = points[k], b = points[k + 1];
                if (edge_sides_.contains(edge_key(a, b))) continue;
                if (chain.empty()) chain.push_back(a);
                chain.push_back(b);
                if (!vertex_at_.contains(b)) continue;
                const EdgeId edge = model_.add_void_edge(vertex_at_.at(chain.front()), vertex_at_.at(b),
                                                         chain);
                set_curve(edge, facet);
                chain.clear();
            }
        }
    }

    [[nodiscard]] std::ptrdiff_t first_vertex(const SectionWalk& walk) const
    {
        const auto found = std::ranges::find_if(
            walk.places, [&](const SectionPlace& place) { return vertex_at_.contains(point(place)); });
        return walk.closed ? found - walk.places.begin() : 0;
    }

    void set_curve(EdgeId id,
                   const std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>>& facet)
    {
        Edge& edge = model_[id];
        std::vector<std::array<Vec2, 2>> uv;
        std::vector<Vec3> points{model_.at(edge.points.front())};
        std::shared_ptr<const geometry::ExactSurface> surface;
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
            const Index a = edge.points[i], b = edge.points[i + 1];
            points.push_back(model_.at(b));
            const auto found = facet.find(directed_key(a, b));
            if (found == facet.end()) return;
            const auto [f, t] = found->second;
            surface = model_.faces[f].surface;
            const Triangle& corner = model_.faces[f].triangles[t];
            const auto uv_at = [&, f = f, t = t](Index p) {
                return model_.faces[f]
                    .uv[t][static_cast<std::size_t>(std::ranges::find(corner, p) - corner.begin())];
            };
            uv.push_back({uv_at(a), uv_at(b)});
            edge.params.push_back(static_cast<double>(i));
        }
        edge.params.push_back(static_cast<double>(uv.size()));
        edge.curve = std::make_shared<SectionCurve>(surface, plane_, tolerance_, std::move(points),
                                                    std::move(uv));
    }

    [[nodiscard]] std::vector<std::vector<EdgeUse>> lines() const
    {
        std::unordered_map<std::uint64_t, EdgeUse> use;
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            const std::vector<Index>& points = model_.edges[e].points;
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                use.try_emplace(directed_key(points[i], points[i + 1]), EdgeUse{EdgeId(e), false});
                use.try_emplace(directed_key(points[i + 1], points[i]), EdgeUse{EdgeId(e), true});
            }
        }
        std::vector<std::vector<EdgeUse>> result;
        for (const SectionWalk& walk : walks_) {
            std::vector<EdgeUse>& line = result.emplace_back();
            const std::vector<Index> points = points_along(walk, first_vertex(walk));
            for (std::size_t k = 0; k + 1 < points.size(); ++k)
                if (vertex_at_.contains(points[k]))
                    line.push_back(use.at(directed_key(points[k], points[k + 1])));
        }
        return result;
    }

    /// Split the faces that fall apart along the walks.
    void split_faces(std::vector<FaceId>& parent)
    {
        const std::size_t before = model_.faces.size();
        parent = all_faces(model_);
        on_walk_.assign(model_.points.size(), false);
        for (const SectionWalk& walk : walks_)
            for (const SectionPlace& place : walk.places) on_walk_[index(point(place))] = true;
        for (std::size_t f = 0; f < before; ++f) {
            if (!is_met(model_.faces[f])) continue;
            std::vector<Face> parts = parts_along(model_.faces[f], walked_, model_.points.size());
            model_.faces[f] = std::move(parts.front());
            for (std::size_t p = 1; p < parts.size(); ++p) {
                model_.faces.push_back(std::move(parts[p]));
                parent.emplace_back(f);
            }
        }
    }

    /// Whether a walk runs along sides of a face's facets.
    [[nodiscard]] bool is_met(const Face& face) const
    {
        // Test the corners before the sides: few corners are on walks, and a flag is cheaper than a look-up.
        const auto is_on = [&](Index p) { return on_walk_[index(p)]; };
        return std::ranges::any_of(face.triangles, [&](const Triangle& t) {
            return std::ranges::count_if(t, is_on) > 1 &&
                   (walked_.contains(edge_key(t[0], t[1])) || walked_.contains(edge_key(t[1], t[2])) ||
                    walked_.contains(edge_key(t[2], t[0])));
        });
    }

    ModelBuilder& model_;
    std::span<const SectionWalk> walks_;
    const geometry::Plane& plane_;
    double tolerance_;
    const RunContext& context_;
    std::map<SectionPlace, Index> made_; ///< points inserted on sides
    SidePoints sides_;
    std::unordered_set<std::uint64_t> walked_;     ///< sides along the walks
    std::vector<bool> on_walk_;                    ///< for each point, whether a walk contains it
    std::unordered_set<std::uint64_t> edge_sides_; ///< sides on edges that the model had before
    std::set<Index> vertex_points_;                ///< points that become vertices
    std::map<Index, VertexId> vertex_at_;
};

} // namespace

Vec3 place_at(const Model& model, const SectionPlace& place, const geometry::Plane& plane)
{
    const Vec3& a = model.at(place.a);
    if (place.b < 0) return a;
    const double ha = geometry::height(plane, a), hb = geometry::height(plane, model.at(place.b));
    return a + ha / (ha - hb) * (model.at(place.b) - a);
}

std::vector<SectionWalk> section_walks(const Model& model, const std::vector<FaceId>& faces,
                                       const geometry::Plane& plane, double tolerance)
{
    return WalkFinder(model, faces, plane, tolerance).walks();
}

std::vector<Face> parts_along(const Face& whole, const std::unordered_set<std::uint64_t>& lines,
                              std::size_t points)
{
    geometry::UnionFind sets(whole.triangles.size());
    DirectedSides sides(points);
    sides.read(whole.triangles);
    for (std::size_t side = 0; side < sides.size(); ++side) {
        if (!lines.contains(edge_key(sides.from(side), sides.to(side))) && sides.across(side) >= 0)
            sets.unite_least(side / 3, index(sides.across(side)) / 3);
    }
    Face empty = whole;
    empty.triangles.clear();
    empty.uv.clear();
    empty.given_quads.clear();
    std::map<std::size_t, std::size_t> number;
    std::vector<Face> parts;
    for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
        const std::size_t part = number.try_emplace(sets.find(t), number.size()).first->second;
        if (part == parts.size()) parts.push_back(empty);
        parts[part].triangles.push_back(whole.triangles[t]);
        if (!whole.uv.empty()) parts[part].uv.push_back(whole.uv[t]);
    }
    for (const Quad& quad : whole.given_quads)
        parts[number.at(sets.find(index(sides.find(quad[0], quad[1])) / 3))].given_quads.push_back(quad);
    return parts;
}

WalkImprint imprint_walks(ModelBuilder& model, std::span<const SectionWalk> walks,
                          const geometry::Plane& plane, double tolerance, const RunContext& context)
{
    return WalkImprinter(model, walks, plane, tolerance, context).run();
}

} // namespace lacuna::topology
