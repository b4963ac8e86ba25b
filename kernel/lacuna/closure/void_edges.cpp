// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/void_edges.h>

#include <lacuna/closure/detail/climber.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Maximum turn between the tangents at both ends of a smooth curve: 3/4 of a circle [radian]. For a full
/// circle, the control points would be infinitely far away.
constexpr double kMostTurn = 1.5 * std::numbers::pi;

// --- gaps ---------------------------------------------------------------------------------------------

std::set<VertexId> free_vertices(const OpenVolume& volume)
{
    std::set<VertexId> vertices;
    for (const EdgeId edge : free_edges(volume)) {
        vertices.insert(volume.model[edge].from);
        vertices.insert(volume.model[edge].to);
    }
    return vertices;
}

// --- the course of one void edge ------------------------------------------------------------------------

/// Total length and number of the facets' sides on the edges at a vertex.
struct Spacing {
    double length = 0;
    std::size_t segments = 0;

    [[nodiscard]] double mean() const { return segments > 0 ? length / static_cast<double>(segments) : 0; }
};

/// Add an edge to the spacing at both of its ends.
void add_edge(const Model& model, EdgeId id, std::vector<Spacing>& at)
{
    const Edge& edge = model[id];
    const double length = edge_length(model, id);
    for (const VertexId end : std::set{edge.from, edge.to}) {
        at[end.index()].length += length;
        at[end.index()].segments += edge.points.size() - 1;
    }
}

/// Spacing at every vertex.
std::vector<Spacing> spacing_of(const Model& model)
{
    std::vector<Spacing> at(model.vertices.size());
    for (std::size_t e = 0; e < model.edges.size(); ++e) add_edge(model, EdgeId(e), at);
    return at;
}

/// Inner points of a curve that is divided into `segments` segments.
/// @param at  returns the point at a parameter in (0, 1)
template <class At>
std::vector<Vec3> inner_points(int segments, const At& at)
{
    std::vector<Vec3> points;
    for (int i = 1; i < segments; ++i) points.push_back(at(static_cast<double>(i) / segments));
    return points;
}

/// @param spacing  spacing of the facet points at the start of the gap; 0: unknown.
std::vector<Vec3> straight_course(const Model& model, const Gap& gap, double spacing)
{
    const Vec3 from = model.at(model[gap.from].point), to = model.at(model[gap.to].point);
    const double wanted = spacing > 0 ? (to - from).norm() / spacing : 1;
    const int segments = static_cast<int>(
        std::clamp(std::round(wanted), 1.0, static_cast<double>(kFineChords)));
    return inner_points(segments, [&](double f) -> Vec3 { return (1 - f) * from + f * to; });
}

/// Points of a void edge across a gap: they follow the walls' motion, and are shifted so that the first and
/// the last meet the ends of the gap.
std::vector<Vec3> followed_course(const Model& model, const Gap& gap, const Follower& follower)
{
    const auto at = [&](VertexId v) { return model.at(model[v].point); };
    const Vec3 source = at(gap.source), target = at(gap.target), from = at(gap.from), to = at(gap.to);
    const auto total = [&](const std::vector<EdgeUse>& uses) {
        double sum = 0;
        for (const EdgeUse& use : uses) sum += edge_length(model, use.edge);
        return sum;
    };
    const double below = total(gap.below), above = total(gap.above);
    const double all = below + (to - from).norm() + above;
    const double low = below / all, high = 1 - above / all;
    const std::size_t walls = follower.walls_at(model[gap.source].point);
    const Vec3 off_from = from - follower.morph(source, target, low, walls);
    const Vec3 off_to = to - follower.morph(source, target, high, walls);
    return inner_points(kFineChords, [&](double f) -> Vec3 {
        return follower.morph(source, target, low + f * (high - low), walls) + (1 - f) * off_from +
               f * off_to;
    });
}

/// Mean normal of an end's faces at a vertex, weighted by the facets' angles.
Vec3 normal_at(const OpenVolume& volume, Role end, VertexId vertex)
{
    const Model& model = volume.model;
    const Index point = model[vertex].point;
    Vec3 sum = Vec3::Zero();
    for (const FaceId face : volume.faces(end)) {
        for (const Triangle& t : model[face].triangles) {
            for (std::size_t i = 0; i < 3; ++i) {
                if (t[i] != point) continue;
                const Vec3 a = model.at(t[(i + 1) % 3]) - model.at(point);
                const Vec3 b = model.at(t[(i + 2) % 3]) - model.at(point);
                const Vec3 area = a.cross(b);
                sum += std::atan2(area.norm(), a.dot(b)) * area.stableNormalized();
            }
        }
    }
    return sum.stableNormalized();
}

/// Unit tangents of a smooth void edge at its first and last end.
struct Tangents {
    Vec3 leave, arrive;
};

/// @param side  1 or -1: side of the ends' faces on which the void lies, see `side_of_void()`.
Tangents tangents_of(const OpenVolume& volume, const Gap& gap, const Follower* walls, double side)
{
    const Model& model = volume.model;
    const Vec3 source = model.at(model[gap.source].point), target = model.at(model[gap.target].point);
    Tangents result;
    if (!gap.below.empty()) {
        result.leave = geometry::end_tangent(use_places(model, gap.below.back()));
    } else if (walls != nullptr) {
        result.leave = walls->leaving(source);
    } else {
        result.leave = side * normal_at(volume, Role::source, gap.source);
    }
    if (!gap.above.empty()) {
        result.arrive = -geometry::end_tangent(use_places(model, gap.above.back()));
    } else if (walls != nullptr) {
        result.arrive = walls->arriving(target);
    } else {
        result.arrive = -side * normal_at(volume, Role::target, gap.target);
    }
    return result;
}

/// Side of the ends' faces on which the void lies: 1 if the normals point into the void, towards the other
/// end; otherwise -1.
double side_of_void(const OpenVolume& volume, const std::vector<Gap>& gaps, const Follower* walls)
{
    const Model& model = volume.model;
    if (walls != nullptr) return 1; // the walls determine the tangents
    double lean = 0, length = 0;
    bool asked = false;
    for (const Gap& gap : gaps) {
        const Vec3 chord = model.at(model[gap.to].point) - model.at(model[gap.from].point);
        length += chord.norm();
        if (gap.below.empty()) lean += chord.dot(normal_at(volume, Role::source, gap.source));
        if (gap.above.empty()) lean -= chord.dot(normal_at(volume, Role::target, gap.target));
        asked = asked || gap.below.empty() || gap.above.empty();
    }
    if (asked && !(std::abs(lean) > kFileAccuracy * length)) {
        throw NotClosed(Message("closure.no_side",
                                "{} and {} do not face each other, so the side to which smooth void edges "
                                "leave them is ambiguous",
                                entity_of(model, volume.faces(Role::source).front()),
                                entity_of(model, volume.faces(Role::target).front()))
                            .remedy("give one edge with close{{ void_edges = … }}"));
    }
    return lean < 0 ? -1 : 1;
}

std::vector<Vec3> smooth_course(const Model& model, const Gap& gap, const Tangents& tangents)
{
    const Vec3 from = model.at(model[gap.from].point), to = model.at(model[gap.to].point);
    const Vec3 chord = to - from;
    const auto turn = [&](const Vec3& tangent) { return geometry::angle_between(tangent, chord); };
    const double theta = std::min(turn(tangents.leave) + turn(tangents.arrive), kMostTurn);
    const double handle = chord.norm() / (3 * std::pow(std::cos(theta / 4), 2));
    const Vec3 a = from + handle * tangents.leave, b = to - handle * tangents.arrive;
    return inner_points(kFineChords, [&](double f) -> Vec3 {
        const double g = 1 - f;
        return g * g * g * from + 3 * g * g * f * a + 3 * g * f * f * b + f * f * f * to;
    });
}

// --- given by the user ----------------------------------------------------------------------------------

NamedEntity vertex(int tag) { return {"vertex", tag}; }

VertexId vertex_on_rim(const OpenVolume& volume, const VoidEdge& edge, int tag,
                       const std::set<VertexId>& free)
{
    const Model& model = volume.model;
    for (const VertexId v : free)
        if (model[v].tag == tag) return v;
    const bool known = std::ranges::find(model.vertices, tag, &Vertex::tag) != model.vertices.end();
    throw InvalidInput(Message("closure.void_edge_vertex", "the void edge from {} to {}: {} is not {}",
                               vertex(edge.from), vertex(edge.to), vertex(tag),
                               known ? "on a free rim" : "in the volume")
                           .remedy("the vertices of the free rims are {}", entities_of(model, free)));
}

/// The course of a user's void edge, without its ends if the user gave them too.
std::vector<Vec3> course_by_hand(const Model& model, const VoidEdge& edge, VertexId from, VertexId to)
{
    std::vector<Vec3> points;
    const Vec3 last = model.at(model[to].point);
    Vec3 before = model.at(model[from].point);
    for (std::size_t i = 0; i < edge.points.size(); ++i) {
        const Vec3& p = edge.points[i];
        if (!p.allFinite())
            throw InvalidInput("closure.void_edge_point",
                               "the void edge from {} to {}: the coordinates of point {} are not finite",
                               vertex(edge.from), vertex(edge.to), i + 1);
        const bool at_end = (i == 0 && (p - before).norm() <= model.tolerance) ||
                            (i + 1 == edge.points.size() && (p - last).norm() <= model.tolerance);
        if (at_end) continue;
        if ((p - before).norm() <= model.tolerance || (p - last).norm() <= model.tolerance)
            throw InvalidInput(
                Message(
                    "closure.void_edge_point",
                    "the void edge from {} to {}: point {} coincides with the previous point or with an end",
                    vertex(edge.from), vertex(edge.to), i + 1)
                    .remedy("leave it out"));
        points.push_back(p);
        before = p;
    }
    return points;
}

/// @throw InvalidInput  the edge crosses a given face.
void check_clear(const Model& model, const VoidEdge& edge, const std::vector<Vec3>& way,
                 const RunContext& context)
{
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        check_cancelled(context);
        const geometry::FacetTree tree(model.points, model.faces[f].triangles);
        for (std::size_t i = 0; i + 1 < way.size(); ++i) {
            const double length = (way[i + 1] - way[i]).norm();
            const Vec3 along = (way[i + 1] - way[i]) / length;
            const double start = i == 0 ? model.tolerance : 0;
            const double end = i + 2 == way.size() ? length - model.tolerance : length;
            const geometry::FacetTree::RayHit hit = tree.first_along(way[i] + start * along, along);
            if (hit.triangle < 0 || hit.t > end - start) continue;
            const Vec3 place = way[i] + (start + hit.t) * along;
            throw InvalidInput(Message("closure.void_edge_crosses",
                                       "the void edge from {} to {} crosses {} at {}", vertex(edge.from),
                                       vertex(edge.to), entity_of(model, FaceId(f)),
                                       place_with_digits(place, 6))
                                   .remedy("move its points"));
        }
    }
}

/// Creates the void edges.
class Maker {
public:
    Maker(OpenVolume& volume, std::vector<Gap> gaps, const RunContext& context)
        : volume_(volume), gaps_(std::move(gaps)), context_(context), spacing_(spacing_of(volume.model))
    {
    }

    void by_hand(const std::vector<VoidEdge>& edges)
    {
        const std::set<VertexId> free = free_vertices(volume_);
        ModelBuilder with_edges(volume_.model);
        for (const VoidEdge& edge : edges) {
            const VertexId from = vertex_on_rim(volume_, edge, edge.from, free);
            const VertexId to = vertex_on_rim(volume_, edge, edge.to, free);
            check_ends(edge, from, to);
            std::vector<Vec3> way = course_by_hand(volume_.model, edge, from, to);
            std::vector<Vec3> whole{volume_.model.at(volume_.model[from].point)};
            whole.insert(whole.end(), way.begin(), way.end());
            whole.push_back(volume_.model.at(volume_.model[to].point));
            check_clear(volume_.model, edge, whole, context_);
            add(with_edges, from, to, way);
        }
        volume_.model = std::move(with_edges).finish();
    }

    void run(const Course& course)
    {
        std::erase_if(gaps_, [&](const Gap& gap) { return pairs_.contains(std::minmax(gap.from, gap.to)); });
        const double side = course.smooth ? side_of_void(volume_, gaps_, course.walls) : 1;
        const Model& model = volume_.model;
        ModelBuilder with_edges(model);
        for (const Gap& gap : gaps_)
            add(with_edges, gap.from, gap.to,
                course.smooth ? smooth_course(model, gap, tangents_of(volume_, gap, course.walls, side))
                : course.follower != nullptr
                    ? followed_course(model, gap, *course.follower)
                    : straight_course(model, gap, spacing_[gap.from.index()].mean()));
        volume_.model = std::move(with_edges).finish();
    }

    [[nodiscard]] std::vector<EdgeId> made() { return std::move(made_); }

private:
    void check_ends(const VoidEdge& edge, VertexId from, VertexId to) const
    {
        const Model& model = volume_.model;
        if (from == to)
            throw InvalidInput(Message("closure.void_edge_ends",
                                       "the void edge from {} to {} ends where it starts", vertex(edge.from),
                                       vertex(edge.to))
                                   .remedy("name two vertices"));
        if (pairs_.contains(std::minmax(from, to)))
            throw InvalidInput(Message("closure.void_edge_twice",
                                       "the void edge from {} to {} is given twice", vertex(edge.from),
                                       vertex(edge.to))
                                   .remedy("give it once"));
        for (const Gap& gap : gaps_) {
            if (std::minmax(gap.from, gap.to) == std::minmax(from, to)) return;
        }
        for (const Gap& gap : gaps_) {
            for (const VertexId end : {from, to}) {
                if (gap.from != end && gap.to != end) continue;
                throw InvalidInput(
                    Message("closure.void_edge_contradicts",
                            "the void edge from {} to {} contradicts the match, which pairs {} with {}",
                            vertex(edge.from), vertex(edge.to), entity_of(model, end),
                            entity_of(model, gap.from == end ? gap.to : gap.from))
                        .remedy("leave the edge out, or pair {} with {} in match{{ vertices = … }}",
                                vertex(edge.from), vertex(edge.to)));
            }
        }
    }

    void add(ModelBuilder& model, VertexId from, VertexId to, const std::vector<Vec3>& between)
    {
        made_.push_back(add_void_edge_through(model, from, to, between));
        add_edge(model, made_.back(), spacing_);
        pairs_.insert(std::minmax(from, to));
    }

    OpenVolume& volume_;
    std::vector<Gap> gaps_;
    const RunContext& context_;
    std::vector<Spacing> spacing_; ///< by vertex
    std::vector<EdgeId> made_;
    std::set<std::pair<VertexId, VertexId>> pairs_;
};

} // namespace

std::vector<Gap> find_gaps(const OpenVolume& volume, const matching::Match& match)
{
    const Model& model = volume.model;
    const Climber climber(volume);
    const std::set<VertexId> free = free_vertices(volume);
    const std::vector<Rim> loops = free_loops(volume);
    std::map<VertexId, std::vector<const Rim*>> through; // the loops at each vertex
    for (const Rim& loop : loops)
        for (const EdgeUse& use : loop.uses) through[use_from(model, use)].push_back(&loop);
    std::vector<Gap> gaps;
    for (const auto& [source, target] : match.vertices) {
        Gap gap{source, target, source, target, climber.climb(source), climber.climb(target)};
        std::set<VertexId> reached{source};
        for (const EdgeUse& use : gap.below) reached.insert(gap.from = use_to(model, use));
        bool joined = reached.contains(target);
        for (const EdgeUse& use : gap.above) joined = joined || reached.contains(gap.to = use_to(model, use));
        joined = joined || !free.contains(gap.from) || !free.contains(gap.to) ||
                 climber.joined(gap.from, gap.to, through[gap.from]);
        if (!joined) gaps.push_back(std::move(gap));
    }
    return gaps;
}

std::vector<EdgeId> make_void_edges(OpenVolume& volume, const matching::Match& match,
                                    const std::vector<VoidEdge>& by_hand, const Course& course,
                                    const RunContext& context)
{
    Maker maker(volume, find_gaps(volume, match), context);
    maker.by_hand(by_hand);
    maker.run(course);
    return maker.made();
}

} // namespace lacuna::closure
