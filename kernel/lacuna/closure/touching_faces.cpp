// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/touching_faces.h>

#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/four_corners.h>
#include <lacuna/closure/detail/membranes.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/round_patch.h>
#include <lacuna/closure/detail/round_walls.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Largest number of sides of a loop that is split. The number of splits into three faces grows with the
/// third power of the number of sides.
constexpr std::size_t kMostSides = 48;

// --- one face ---------------------------------------------------------------------------------------------

/// Whether one chain is the other, scaled and shifted; both run in the same direction.
bool are_similar(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
    const double scale = geometry::length(b) / geometry::length(a);
    if (!std::isfinite(scale)) return false;
    const std::vector<Vec3> from = geometry::even_places(a, kChords), to = geometry::even_places(b, kChords);
    const double allowed = kVisible * geometry::length(b);
    for (std::size_t i = 0; i <= kChords; ++i)
        if ((scale * (from[i] - from[0]) - (to[i] - to[0])).norm() > allowed) return false;
    return true;
}

/// Whether two faces are parts of equal spheres, or of cylinders with equal radii and parallel axes.
bool are_alike(const RoundShape& a, const RoundShape& b)
{
    return std::abs(a.radius - b.radius) <= kAlikeSizes * b.radius && a.is_sphere() == b.is_sphere() &&
           (b.is_sphere() || a.axis->cross(*b.axis).norm() <= kParallel);
}

/// Whether a single bent given face, or parts of one cylinder or sphere, surround a loop. The loop is then a
/// hole in these faces; a void face of the same shape would only continue them.
bool is_hole_in_round_face(const Model& model, const Loop& loop)
{
    std::set<FaceId> beside;
    for (const EdgeUse& use : loop.uses)
        for (const FaceUse& by : model.uses_of_edge(use.edge))
            if (model[by.face].origin != Origin::made_void) beside.insert(by.face);
    std::vector<RoundShape> shapes;
    for (const FaceId face : beside) {
        const auto shape = round_shape(model, face);
        if (!shape) return beside.size() == 1 && !plane_of(model, face);
        shapes.push_back(*shape);
    }
    if (shapes.empty()) return false;
    return std::ranges::all_of(shapes,
                               [&](const RoundShape& shape) { return are_alike(shapes.front(), shape); });
}

// --- several faces ----------------------------------------------------------------------------------------

/// A side of a missing face: an edge of the free loop, or a void edge between two missing faces.
struct FaceSide {
    std::vector<Vec3> points; ///< in walking order, both ends included
    EdgeUse given;            ///< the edge of the free loop; invalid for a void edge that is to be made
    VertexId from, to;        ///< invalid for the vertex where three missing faces meet
};
using FaceChain = std::vector<FaceSide>;

std::vector<Vec3> points_along(const FaceChain& chain)
{
    std::vector<Vec3> points{chain.front().points.front()};
    for (const FaceSide& side : chain)
        points.insert(points.end(), side.points.begin() + 1, side.points.end());
    return points;
}

/// Some consecutive sides of a loop.
FaceChain part_of(const FaceChain& loop, std::size_t from, std::size_t to)
{
    FaceChain part;
    for (; from != to; from = (from + 1) % loop.size()) part.push_back(loop[from]);
    return part;
}

FaceSide turned(FaceSide side)
{
    std::ranges::reverse(side.points);
    std::swap(side.from, side.to);
    return side;
}

std::vector<Vec3> inner_points(const FaceSide& side)
{
    return {side.points.begin() + 1, side.points.end() - 1};
}

Vec3 end_to_end(const std::vector<Vec3>& points) { return points.back() - points.front(); }

std::size_t count_turns(const std::vector<Vec3>& chain)
{
    std::size_t count = 0;
    for (std::size_t i = 1; i + 1 < chain.size(); ++i)
        count += geometry::angle_between(chain[i] - chain[i - 1], chain[i + 1] - chain[i]) > kVisible ? 1 : 0;
    return count;
}

/// A split of a loop into the loops of missing faces.
using FaceSplit = std::vector<FaceChain>;

class TouchingFaces {
public:
    TouchingFaces(const Model& model, const RunContext& context) : model_(model), context_(context) {}

    /// The splits of a loop into two faces, of which at least one is flat. The edge between them is a line or
    /// a copy of the opposite side; only if no such edge fits is it the one in which a plane meets a round
    /// wall.
    /// @param bent_sharply  whether a face may have a crease between copied sides, as several faces have.
    [[nodiscard]] std::vector<FaceSplit> in_two(const FaceChain& loop, bool bent_sharply = false) const
    {
        std::vector<FaceSplit> found = with_copied_edge(loop, bent_sharply);
        return found.empty() ? with_round_edge(loop) : found;
    }

    /// Visit both parts of a loop for every two vertices at which it may be split, in either order.
    template <class Visit>
    void each_split(const FaceChain& loop, const Visit& visit) const
    {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            check_cancelled(context_);
            for (std::size_t j = 0; j < loop.size(); ++j)
                if (i != j) visit(part_of(loop, i, j), part_of(loop, j, i), i > j);
        }
    }

    [[nodiscard]] std::vector<FaceSplit> with_copied_edge(const FaceChain& loop, bool bent_sharply) const
    {
        std::vector<FaceSplit> found;
        each_split(loop, [&](const FaceChain& flat, const FaceChain& rest, bool again) {
            const bool flat_there = plane_of_run(flat).has_value();
            const bool both = flat_there && plane_of_run(rest);
            if (both && again) return; // this split was found with the two parts exchanged
            const bool told = flat_there && (count_turns(points_along(flat)) > 1 ||
                                             (both && count_turns(points_along(rest)) > 1));
            const FaceSide chord = across(rest);
            const auto image = both || (!bent_sharply && has_crease(rest)) ? std::nullopt
                                                                           : image_of_opposite(rest);
            if (image && tells_face(closed(rest, *image)) && tells_face(closed(flat, turned(*image))))
                add(found, {closed(flat, turned(*image)), closed(rest, *image)});
            else if ((told || (both && loop.size() == 4)) &&
                     fits(chord, {start_of(flat), end_of(flat), start_of(rest), end_of(rest)}) &&
                     (both || tells_face(closed(rest, chord))))
                add(found, {closed(flat, turned(chord)), closed(rest, chord)});
        });
        return found;
    }

    [[nodiscard]] std::vector<FaceSplit> with_round_edge(const FaceChain& loop) const
    {
        std::vector<FaceSplit> found;
        each_split(loop, [&](const FaceChain& flat, const FaceChain& rest, bool) {
            const auto plane = plane_of_run(flat);
            if (!plane || count_turns(points_along(flat)) < 2) return;
            std::vector<std::vector<Vec3>> sides;
            for (const FaceSide& side : rest) sides.push_back(side.points);
            const FaceSide edge{edge_in_plane(sides, *plane), {}, rest.back().to, rest.front().from};
            if (edge.points.empty() || is_known(edge)) return;
            if (plane_of_run(closed(flat, turned(edge))) && tells_face(closed(rest, edge)))
                add(found, {closed(flat, turned(edge)), closed(rest, edge)});
        });
        return found;
    }

    /// The splits into three faces: a flat one and two others, or three flat ones that meet in a vertex.
    [[nodiscard]] std::vector<FaceSplit> in_three(const FaceChain& loop) const
    {
        std::vector<FaceSplit> found;
        const std::size_t sides = loop.size();
        std::vector<Run> runs;
        for (std::size_t i = 0; i < sides; ++i) {
            check_cancelled(context_);
            for (std::size_t j = 0; j < sides; ++j) {
                Run& run = runs.emplace_back();
                if (i == j) continue;
                run.sides = part_of(loop, i, j);
                run.plane = plane_of_run(run.sides);
            }
        }
        const auto run = [&](std::size_t i, std::size_t j) -> const Run& { return runs[i * sides + j]; };
        for (std::size_t i = 0; i < sides; ++i) {
            for (std::size_t j = 0; j < sides; ++j) {
                const FaceChain &flat = run(i, j).sides, &rest = run(j, i).sides;
                if (!run(i, j).plane) continue;
                const FaceSide chord = across(rest);
                if (rest.size() > 1 && count_turns(points_along(flat)) > 1 &&
                    fits(chord, {start_of(flat), end_of(flat), start_of(rest), end_of(rest)})) {
                    for (FaceSplit split : in_two(closed(rest, chord))) {
                        split.push_back(closed(flat, turned(chord)));
                        add(found, std::move(split));
                    }
                }
                for (std::size_t k = j + 1; i < j && k < sides; ++k)
                    if (auto split = round_vertex({&run(i, j), &run(j, k), &run(k, i)}))
                        found.push_back(std::move(*split));
            }
        }
        return found;
    }

private:
    /// A run: some consecutive sides of a loop, which bound one missing face. Its plane if it has one.
    struct Run {
        FaceChain sides;
        std::optional<geometry::Plane> plane;
    };

    /// The plane of the missing face at a run. Empty in any of these cases: the run is straight or not flat;
    /// the rim of the face would cross itself; all given faces along the run lie in the plane, so that the
    /// new face would overlap or merely extend them.
    [[nodiscard]] std::optional<geometry::Plane> plane_of_run(const FaceChain& run) const
    {
        std::vector<Vec3> points = points_along(run);
        const double length = geometry::length(points);
        if ((points.back() - points.front()).norm() <= model_.tolerance) points.pop_back();
        const geometry::Plane plane = geometry::newell_plane({&points, 1});
        if (!(geometry::newell_vector(points).norm() > kVisible * length * length)) return std::nullopt;
        if (std::ranges::any_of(points, [&](const Vec3& p) {
                return std::abs(geometry::height(plane, p)) >
                       std::max(model_.tolerance, kFileAccuracy * length);
            }))
            return std::nullopt;
        const auto is_given = [](const FaceSide& side) { return side.given.edge.valid(); };
        const bool doubles = std::ranges::any_of(run, is_given) &&
                             std::ranges::all_of(run, [&](const FaceSide& side) {
                                 return !is_given(side) || lies_in_plane(model_, face_beside(side), plane);
                             });
        Outline outline;
        outline.add_loop(flat_places(plane, points));
        if (doubles || geometry::find_crossing(outline.flat, outline.loops)) return std::nullopt;
        return plane;
    }

    [[nodiscard]] FaceId face_beside(const FaceSide& side) const
    {
        return model_.uses_of_edge(side.given.edge).front().face;
    }

    /// The straight edge from the end of a run to its start.
    static FaceSide across(const FaceChain& run)
    {
        return straight(run.back().to, run.back().points.back(), run.front().from,
                        run.front().points.front());
    }

    static FaceSide straight(VertexId from, const Vec3& start, VertexId to, const Vec3& end)
    {
        return {{start, end}, {}, from, to};
    }

    static FaceChain closed(FaceChain run, FaceSide last)
    {
        run.push_back(std::move(last));
        return run;
    }

    /// Direction of a run at its start.
    static Vec3 start_of(const FaceChain& run)
    {
        const std::vector<Vec3>& points = run.front().points;
        return (points[1] - points[0]).stableNormalized();
    }

    /// Direction of a run at its end.
    static Vec3 end_of(const FaceChain& run)
    {
        const std::vector<Vec3>& points = run.back().points;
        return (points.back() - points[points.size() - 2]).stableNormalized();
    }

    /// Whether a straight void edge may separate faces: no straight edge joins its ends already, and the void
    /// edge is not parallel to the sides at its ends.
    [[nodiscard]] bool fits(const FaceSide& chord, std::initializer_list<Vec3> sides) const
    {
        const Vec3 way = end_to_end(chord.points).stableNormalized();
        if (std::ranges::any_of(sides, [&](const Vec3& side) { return side.cross(way).norm() <= kParallel; }))
            return false;
        return std::ranges::none_of(model_.edges, [&](const Edge& edge) {
            return std::minmax(edge.from, edge.to) == std::minmax(chord.from, chord.to) &&
                   count_turns(places_at(model_, edge.points)) == 0;
        });
    }

    /// Whether an edge with the same ends passes the middle of a void edge.
    [[nodiscard]] bool is_known(const FaceSide& made) const
    {
        const Vec3& middle = made.points[made.points.size() / 2];
        const double near = kVisible * geometry::length(made.points);
        return std::ranges::any_of(model_.edges, [&](const Edge& edge) {
            return std::minmax(edge.from, edge.to) == std::minmax(made.from, made.to) &&
                   std::ranges::any_of(places_at(model_, edge.points),
                                       [&](const Vec3& p) { return (p - middle).norm() <= near; });
        });
    }

    /// Whether the loop of a face determines its shape.
    [[nodiscard]] bool tells_face(const FaceChain& chain) const
    {
        if (plane_of_run(chain)) return true;
        Model model = model_;
        Loop loop;
        for (const FaceSide& side : chain) {
            EdgeUse use = side.given;
            if (!use.edge.valid()) {
                if (!side.from.valid() || !side.to.valid()) return false;
                use = {add_void_edge_through(model, side.from, side.to, inner_points(side)), false};
            }
            loop.uses.push_back(use);
        }
        return closure::tells_face(model, loop, context_);
    }

    /// Whether a run turns between its inner sides: sharply, or from one straight side to another.
    [[nodiscard]] static bool has_crease(const FaceChain& run)
    {
        for (std::size_t k = 1; k + 2 < run.size(); ++k) {
            const double turn = geometry::angle_between(end_of({run[k]}), start_of({run[k + 1]}));
            const bool straight = count_turns(run[k].points) == 0 && count_turns(run[k + 1].points) == 0;
            if (turn > (straight ? kVisible : kCreaseAngle * kDegree)) return true;
        }
        return false;
    }

    /// A void edge from the end of a run to its start: a shifted copy of the run without its first and last
    /// side. Empty unless these two sides are straight, parallel and equally long.
    [[nodiscard]] static std::optional<FaceSide> image_of_opposite(const FaceChain& run)
    {
        if (run.size() < 3) return std::nullopt;
        const Vec3 up = end_to_end(run.front().points), down = end_to_end(run.back().points);
        if (count_turns(run.front().points) > 0 || count_turns(run.back().points) > 0 ||
            (up + down).norm() > kVisible * up.norm())
            return std::nullopt;
        FaceSide image;
        const std::vector<Vec3> opposite = points_along({run.begin() + 1, run.end() - 1});
        for (const Vec3& p : opposite) image.points.push_back(p - up);
        image.points.front() = run.front().points.front();
        image.points.back() = run.back().points.back();
        image.from = run.front().from;
        image.to = run.back().to;
        return turned(std::move(image));
    }

    /// The split into three flat faces whose planes meet in a new vertex; empty if the three runs permit
    /// none.
    [[nodiscard]] std::optional<FaceSplit> round_vertex(const std::array<const Run*, 3>& runs) const
    {
        if (!std::ranges::all_of(runs, [](const Run* run) { return run->plane.has_value(); }))
            return std::nullopt;
        const auto normal = [&](std::size_t r) -> const Vec3& { return runs[r % 3]->plane->normal; };
        const double volume = normal(0).dot(normal(1).cross(normal(2)));
        if (std::abs(volume) <= kParallel) return std::nullopt;
        Vec3 place = Vec3::Zero();
        for (std::size_t r = 0; r < 3; ++r)
            place += normal(r).dot(runs[r]->plane->origin) / volume * normal(r + 1).cross(normal(r + 2));
        const double near = kVisible * (runs[0]->sides.front().points.front() - place).norm();
        if (std::ranges::any_of(model_.vertices,
                                [&](const Vertex& v) { return (model_.at(v.point) - place).norm() <= near; }))
            return std::nullopt;
        FaceSplit split;
        for (std::size_t r = 0; r < 3; ++r) {
            const FaceChain& run = runs[r]->sides;
            const FaceSide in = straight(run.back().to, run.back().points.back(), {}, place);
            const FaceSide out = straight({}, place, run.front().from, run.front().points.front());
            if (!fits(out, {end_of(runs[(r + 2) % 3]->sides), start_of(run)})) return std::nullopt;
            split.push_back(closed(closed(run, in), out));
            if (!plane_of_run(split.back())) return std::nullopt;
        }
        return split;
    }

    /// Add a split, unless one with the same new edges is known.
    static void add(std::vector<FaceSplit>& splits, FaceSplit split)
    {
        const auto made = [](const FaceSplit& one) {
            std::set<std::tuple<VertexId, VertexId, bool>> edges;
            for (const FaceChain& chain : one)
                for (const FaceSide& side : chain)
                    if (!side.given.edge.valid())
                        edges.emplace(std::min(side.from, side.to), std::max(side.from, side.to),
                                      count_turns(side.points) == 0);
            return edges;
        };
        if (std::ranges::none_of(splits, [&](const FaceSplit& other) { return made(other) == made(split); }))
            splits.push_back(std::move(split));
    }

    const Model& model_;
    const RunContext& context_;
};

/// Add the edges and the vertex of a split to the model.
std::vector<Loop> add_split(Model& model, const FaceSplit& split)
{
    std::vector<Loop> loops;
    VertexId middle;
    std::map<std::pair<VertexId, VertexId>, EdgeId> made;
    const auto vertex = [&](VertexId known, const Vec3& place) {
        if (known.valid() || middle.valid()) return known.valid() ? known : middle;
        ModelBuilder builder(std::move(model));
        builder.points.push_back(place);
        middle = builder.add_void_vertex(static_cast<Index>(builder.points.size()) - 1);
        model = std::move(builder).finish();
        return middle;
    };
    for (const FaceChain& chain : split) {
        Loop& loop = loops.emplace_back();
        for (const FaceSide& side : chain) {
            if (side.given.edge.valid()) {
                loop.uses.push_back(side.given);
                continue;
            }
            const VertexId from = vertex(side.from, side.points.front()),
                           to = vertex(side.to, side.points.back());
            const auto known = made.find({to, from});
            if (known == made.end()) {
                made[{from, to}] = add_void_edge_through(model, from, to, inner_points(side));
                loop.uses.push_back({made.at({from, to}), false});
            } else {
                loop.uses.push_back({known->second, true});
            }
        }
    }
    return loops;
}

} // namespace

bool is_ruled_between_alike(const Model& model, const Loop& loop)
{
    const auto sides = four_corners(model, loop);
    for (std::size_t s = 0; s + 2 < sides.size(); ++s) {
        if (!is_straight(model, sides[s]) || !is_straight(model, sides[s + 2])) continue;
        std::vector<Vec3> opposite = use_places(model, sides[(s + 3) % 4]);
        std::ranges::reverse(opposite);
        if (are_similar(use_places(model, sides[s + 1]), opposite)) return true;
    }
    return false;
}

bool lies_on_quadric(const Model& model, const Loop& loop, bool (&is_wanted)(const Quadric&))
{
    const std::vector<Vec3> places = loop_places(model, loop.uses);
    return std::ranges::any_of(shapes_of_rim(model, {loop}, geometry::newell_plane({&places, 1})).told,
                               [&](const QuadricSheet& sheet) { return is_wanted(sheet.quadric); });
}

bool tells_face(const Model& model, const Loop& loop, const RunContext& context)
{
    return is_ruled_between_alike(model, loop) ||
           (!is_hole_in_round_face(model, loop) &&
            (lies_on_quadric(model, loop, is_bent) || fill_round_patch(model, loop, context)));
}

std::optional<std::vector<Loop>> split_touching(Model& model, const Rim& rim, const RunContext& context)
{
    if (rim.uses.size() > kMostSides) return std::nullopt;
    FaceChain loop;
    for (const EdgeUse& use : rim.uses)
        loop.push_back({use_places(model, use), use, use_from(model, use), use_to(model, use)});
    const TouchingFaces faces(model, context);
    std::vector<FaceSplit> splits = faces.in_two(loop);
    if (splits.empty()) splits = faces.in_three(loop);
    if (splits.empty()) splits = faces.in_two(loop, true);
    if (splits.size() != 1) return std::nullopt;
    return add_split(model, splits.front());
}

bool closes_hole_in_bent_face(const Model& model, FaceId face)
{
    return model[face].loops.size() == 1 && !has_flat_loops(model, face) &&
           is_hole_in_round_face(model, model[face].loops.front());
}

bool continues_face_beside(const Model& model, FaceId face)
{
    const auto plane = plane_of(model, face);
    const auto shape = plane ? std::nullopt : round_shape(model, face);
    return std::ranges::any_of(faces_beside(model, face), [&](FaceId other) {
        if (model[other].origin != Origin::given) return false;
        if (plane) return lies_in_plane(model, other, *plane);
        const auto beside = shape ? round_shape(model, other) : std::nullopt;
        return beside && are_alike(*shape, *beside);
    });
}

bool is_untold(const Model& model, FaceId face)
{
    if (rims(model, {face}).size() == 2) return is_ring_at_step(model, face);
    return !has_flat_loops(model, face) && !is_about_flat(model, face) && !round_shape(model, face) &&
           !cone_shape(model, face) && !tells_face(model, model[face].loops.front());
}

bool rests_on_void_edges(const Model& model, FaceId face)
{
    const std::vector<Loop>& loops = model[face].loops;
    const auto is_void = [&](const EdgeUse& use) { return model[use.edge].origin == Origin::made_void; };
    return std::ranges::any_of(uses_of(model[face]), is_void) && !has_flat_loops(model, face) &&
           !(loops.size() == 1 && (is_ruled_between_alike(model, loops.front()) ||
                                   given_sides_show_round_wall(model, loops.front())));
}

bool has_only_quadric(const Model& model, FaceId face)
{
    if (has_flat_loops(model, face) || is_about_flat(model, face) || round_shape(model, face) ||
        cone_shape(model, face) || model[face].loops.size() > 1)
        return false;
    const Loop& loop = model[face].loops.front();
    return !is_ruled_between_alike(model, loop) && !lies_on_quadric(model, loop, is_round) &&
           lies_on_quadric(model, loop, is_bent) && !fill_round_patch(model, loop, {});
}

std::optional<Message> untold_face(const OpenVolume& sealed, const Closure& closure, double least)
{
    const Model& model = sealed.model;
    for (const FaceId face : closure.void_faces) {
        if (std::pow(face_area(model, face), 1.5) <= least || !is_untold(model, face)) continue;
        std::vector<NamedEntity> beside;
        for (const FaceId other : faces_beside(model, face))
            if (model[other].origin == Origin::given) beside.push_back(entity_of(model, other));
        return Message("topology.shape_open",
                       "the shape of the missing face beside {} is ambiguous: its rim does not determine it",
                       beside);
    }
    return std::nullopt;
}

} // namespace lacuna::closure
