// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/steps.h>

#include <lacuna/closure/detail/end_holes.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/step_cutter.h>
#include <lacuna/closure/detail/turns.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/closure/detail/void_faces.h>
#include <lacuna/closure/shared/cut.h>
#include <lacuna/closure/shared/round_rims.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Whether the walls at an edge lead away from the opposite end.
/// @param out  direction away from the opposite end.
bool leads_away(const OpenVolume& volume, EdgeId edge, const Vec3& out)
{
    const Model& model = volume.model;
    const std::vector<Index>& line = model[edge].points;
    const std::set<Index> on(line.begin(), line.end());
    Vec3 way = Vec3::Zero();
    for (const FaceUse& user : model.uses_of_edge(edge)) {
        if (volume.role[user.face.index()] != Role::wall) continue;
        for (const Triangle& t : model[user.face].triangles) {
            const auto corner = std::ranges::find_if(t, [&](Index p) { return !on.contains(p); });
            if (std::ranges::count_if(t, [&](Index p) { return on.contains(p); }) != 2) continue;
            const std::size_t k = static_cast<std::size_t>(corner - t.begin());
            const Vec3 side = model.at(t[(k + 2) % 3]) - model.at(t[(k + 1) % 3]);
            const Vec3 up = model.at(*corner) - model.at(t[(k + 1) % 3]);
            way += (up - up.dot(side) / side.squaredNorm() * side).stableNormalized();
        }
    }
    return way.stableNormalized().dot(out) > std::sin(kCreaseAngle * kDegree);
}

Steps find_steps(const OpenVolume& volume, Role end, const std::vector<double>& turns)
{
    const Model& model = volume.model;
    Steps steps;
    const double corner = 180 - kCornerBelow;
    const std::vector<FaceId> faces = volume.faces(end);
    if (faces.empty()) return steps;
    steps.parts = connected_parts(model, faces);
    for (std::size_t p = 0; p < steps.parts.size(); ++p) {
        const Vec3 out = area_vector_of(model, steps.parts[p]).stableNormalized();
        for (Rim& rim : topology::rims(model, steps.parts[p])) {
            std::size_t away = 0, onward = 0;
            std::vector<FaceId> risers;
            for (const EdgeUse& use : rim.uses) {
                const double turn = turns[use.edge.index()];
                // The edge is at a step if the skin turns towards the void, or, on a divided round, if the
                // walls lead away from the opposite end.
                if (turn < corner && !(turn > -corner && leads_away(volume, use.edge, out))) {
                    if (model.uses_of_edge(use.edge).size() > 1) ++onward;
                    continue;
                }
                ++away;
                for (const FaceUse& user : model.uses_of_edge(use.edge))
                    if (volume.role[user.face.index()] == Role::wall) risers.push_back(user.face);
            }
            if (away == 0) continue;
            if (onward == 0)
                steps.closed.push_back({p, std::move(rim)});
            else
                steps.risers.insert(steps.risers.end(), risers.begin(), risers.end());
        }
    }
    return steps;
}

/// Close a missing end opposite to steps by a face in the only open loop. The face is flat or bent like the
/// loop.
void cap_opposite(OpenVolume& volume, Role other, const Steps& steps, const RunContext& context)
{
    const std::vector<Rim> open = free_loops(volume);
    const NamedEntity step = entity_of(volume.model,
                                       volume.model.faces.empty() ? FaceId() : steps.parts.back().front());
    if (open.size() != 1)
        throw NotSweepable(Message("closure.steps",
                                   "the steps at {} need the opposite end, which is missing, and {} loops "
                                   "are open instead of one",
                                   step, found(open.size()))
                               .remedy("give that end, or the other missing faces"));
    add_void_face(volume,
                  fill(volume, {reversed(open.front())}, nullptr, {"the end opposite ", {step}}, context),
                  other);
    volume.model = with_loops(std::move(volume.model));
}

/// Cut a volume by the planes of some of its faces in turn. Each plane cuts all pieces that it crosses near
/// its face.
std::vector<StepPiece> cut_by_planes(const OpenVolume& volume, const std::vector<FaceId>& faces,
                                     const RunContext& context)
{
    std::vector<StepPiece> pieces{{volume, 0}};
    for (const FaceId face : faces) {
        const std::optional<geometry::Plane> plane = plane_of(volume.model, face);
        if (!plane)
            throw NotSweepable(Message("closure.steps",
                                       "the step at {} is not flat, so it has no plane to cut by, and its "
                                       "rim is not closed",
                                       entity_of(volume.model, face))
                                   .remedy("cut the volume with cut{{ plane = … }}"));
        // The plane of a face cuts only pieces near this face.
        const Eigen::AlignedBox3d reach = box_of(volume.model, face);
        const auto cut = [&](const OpenVolume& piece) {
            return cut_by_face(piece, volume.model, face, context);
        };
        pieces = cut_each(std::move(pieces), *plane, cut, &reach);
    }
    return pieces;
}

/// The steps of the two ends of a volume.
std::array<Steps, 2> steps_of(const OpenVolume& volume, const RunContext& context)
{
    const std::vector<double> turns = concave_turns(volume, context);
    return {find_steps(volume, Role::source, turns), find_steps(volume, Role::target, turns)};
}

/// The unit direction from source to target, from their faces.
Vec3 sweep_way(const OpenVolume& volume)
{
    Vec3 way = Vec3::Zero();
    for (const FaceId face : volume.faces(Role::target)) way += face_area_vector(volume.model, face);
    for (const FaceId face : volume.faces(Role::source)) way -= face_area_vector(volume.model, face);
    return way.stableNormalized();
}

/// Levels of pieces that lie side by side: the number of distinct lengths along the sweep that are greater
/// than the length of the piece; 0 for the longest.
std::vector<int> levels_by_length(const std::vector<StepPiece>& pieces, const Vec3& way)
{
    std::vector<double> length;
    double tolerance = 0;
    for (const StepPiece& piece : pieces) {
        const Model& model = piece.volume.model;
        double low = kInfinity, high = -low;
        for (const Face& face : model.faces) {
            for (const Index p : corners_of(face)) {
                low = std::min(low, model.at(p).dot(way));
                high = std::max(high, model.at(p).dot(way));
            }
        }
        length.push_back(high - low);
        tolerance = std::max(tolerance, 10 * model.tolerance);
    }
    std::vector<double> lengths = length;
    std::ranges::sort(lengths, std::greater<>());
    const auto same = [&](double a, double b) { return a - b <= tolerance; };
    lengths.erase(std::unique(lengths.begin(), lengths.end(), same), lengths.end());
    std::vector<int> levels;
    for (const double own : length) {
        levels.push_back(static_cast<int>(
            std::ranges::count_if(lengths, [&](double other) { return other - own > tolerance; })));
    }
    return levels;
}

/// If the only open loop is flat, lies across the sweep and is bounded by walls, close it as part of an end.
/// Example: the brim of a box around a floating board. Without this face, the columns beside the board would
/// have no end.
void close_brim(OpenVolume& volume, const RunContext& context)
{
    const std::vector<Rim> open = free_loops(volume);
    if (open.size() != 1 || volume.faces(Role::source).empty() || volume.faces(Role::target).empty()) return;
    const auto is_wall = [&](const FaceUse& use) { return volume.role[use.face.index()] == Role::wall; };
    for (const EdgeUse& use : open.front().uses)
        if (!std::ranges::all_of(volume.model.uses_of_edge(use.edge), is_wall)) return;
    const Vec3 way = sweep_way(volume);
    const std::vector<Vec3> places = places_at(volume.model, loop_points(volume.model, open.front().uses));
    const auto [low, high] = std::ranges::minmax(places, {}, [&](const Vec3& p) { return p.dot(way); });
    const double width = std::sqrt(geometry::newell_vector(places).norm());
    if (!((high - low).dot(way) <= kParallel * width)) return;
    const bool is_ahead = (low - centroid_of(volume.model, all_faces(volume.model))).dot(way) > 0;
    add_void_face(volume, fill(volume, {reversed(open.front())}, nullptr, {"the brim"}, context),
                  is_ahead ? Role::target : Role::source);
    volume.model = with_loops(std::move(volume.model));
}

/// Cover the holes without walls in the tops of steps, such as a bore in a boss that ends below the brim. If
/// the holes were extended to the other end, they would become pins in the void.
void cover_step_holes(OpenVolume& volume, const RunContext& context)
{
    std::set<FaceId> tops;
    for (const Steps& own : steps_of(volume, context))
        for (const Hanging& hanging : own.closed)
            tops.insert(own.parts[hanging.part].begin(), own.parts[hanging.part].end());
    std::vector<EndHole> holes = holes_without_walls(volume);
    std::erase_if(holes, [&](const EndHole& hole) { return !tops.contains(hole.face); });
    if (holes.empty()) return;
    for (const EndHole& hole : holes)
        log_line(context, formatted("note: a hole in {}, the top of a step, is covered by a flat face",
                                    entity_of(volume.model, hole.face)));
    cover_holes(volume, holes, context);
    volume.model = with_loops(std::move(volume.model));
}

std::vector<StepPiece> hang_all(OpenVolume volume, const RunContext& context, int round);

/// Cut a volume by the planes of walls at steps. Then extrude void faces from the rims of the remaining
/// steps, where all walls lead away from the opposite end.
std::vector<StepPiece> cut_at_risers(const OpenVolume& volume, const std::vector<FaceId>& risers,
                                     const RunContext& context, int round)
{
    std::vector<StepPiece> result;
    const std::vector<StepPiece> cut = cut_by_planes(volume, risers, context);
    const std::vector<int> levels = levels_by_length(cut, sweep_way(volume));
    for (std::size_t p = 0; p < cut.size(); ++p) {
        for (StepPiece& own : hang_all(cut[p].volume, context, round)) {
            own.level += levels[p];
            result.push_back(std::move(own));
        }
    }
    return result;
}

/// Extrude void faces from the rims in `Steps::closed`, one end after the other, until no piece has such a
/// rim.
std::vector<StepPiece> hang_all(OpenVolume volume, const RunContext& context, int round)
{
    face_away(volume, context);
    std::array<Steps, 2> steps = steps_of(volume, context);
    for (const Role end : {Role::source, Role::target}) {
        Steps& own = steps[end == Role::source ? 0 : 1];
        if (own.closed.empty()) continue;
        // Each cut reduces the number of steps.
        if (round == kMostRounds)
            throw NotSweepable(
                Message("closure.steps", "the volume has too many steps").remedy("cut it by planes first"));
        const Role other = end == Role::source ? Role::target : Role::source;
        if (volume.faces(other).empty()) cap_opposite(volume, other, own, context);
        std::vector<StepPiece> result;
        for (StepPiece& piece : cut_below_rims(volume, end, std::move(own), context)) {
            for (StepPiece& part : hang_all(std::move(piece.volume), context, round + 1)) {
                part.level += piece.level;
                result.push_back(std::move(part));
            }
        }
        return result;
    }
    for (const Role end : {Role::source, Role::target}) {
        const auto& [parts, closed, risers] = steps[end == Role::source ? 0 : 1];
        if (parts.size() < 2) continue;
        // A wall at a step may end in the plane of an earlier cut. Then the step's rim also has other walls,
        // and the planes of its walls must cut.
        if (!risers.empty() && round < kMostRounds) return cut_at_risers(volume, risers, context, round + 1);
        throw NotSweepable(
            Message("closure.steps",
                    "the {} has several separate parts, such as {} and {}, and no walls lead from one to the "
                    "other",
                    end == Role::source ? "source" : "target", entity_of(volume.model, parts[0].front()),
                    entity_of(volume.model, parts[1].front()))
                .remedy("make two volumes of it, or cut it with cut{{ plane = … }}"));
    }
    return {{std::move(volume), 0}};
}

bool is_stepped(const Steps& steps)
{
    return steps.parts.size() > 1 || !steps.closed.empty() || !steps.risers.empty();
}

bool is_stepped(const OpenVolume& volume, const RunContext& context)
{
    return std::ranges::any_of(steps_of(volume, context),
                               [](const Steps& steps) { return is_stepped(steps); });
}

/// Cut by the planes of all steps. Empty if a step is not flat, if a cut fails, or if a piece still has
/// steps.
std::vector<StepPiece> cut_in_layers(const OpenVolume& volume, const std::array<Steps, 2>& steps,
                                     const RunContext& context)
{
    std::vector<FaceId> faces;
    for (const Steps& own : steps) {
        for (const Hanging& hanging : own.closed) faces.push_back(own.parts[hanging.part].front());
    }
    auto pieces = unless_refused([&] { return cut_by_planes(volume, faces, context); });
    const auto stepped = [&](const StepPiece& piece) { return is_stepped(piece.volume, context); };
    if (!pieces || std::ranges::any_of(*pieces, stepped)) return {};
    return std::move(*pieces);
}

} // namespace

bool has_round_steps(const OpenVolume& volume, const RunContext& context)
{
    // Between two open skins, such as two cups, all walls are missing.
    if (volume.faces(Role::wall).empty() && !free_edges(volume).empty()) return false;
    std::vector<double> turns;
    // Walls that meet the whole rim of an end at corners are beside it, so all of it is an end: a dome that
    // is swept through its thickness.
    const auto is_at_corner = [&](const EdgeUse& use) {
        const auto users = volume.model.uses_of_edge(use.edge);
        return std::abs(turns[use.edge.index()]) > 180 - kCornerBelow &&
               std::ranges::any_of(
                   users, [&](const FaceUse& user) { return volume.role[user.face.index()] == Role::wall; });
    };
    const auto has_cap = [&](Role end) {
        const std::vector<FaceId> faces = volume.faces(end);
        const Vec3 out = area_vector_of(volume.model, faces).stableNormalized();
        return std::ranges::any_of(faces, [&](FaceId face) {
            if (!is_end_with_walls(volume.model, face, out)) return false;
            if (turns.empty()) turns = concave_turns(volume, context);
            return !std::ranges::all_of(border_loops(volume.model, face).front().uses, is_at_corner);
        });
    };
    if (!has_cap(Role::source) && !has_cap(Role::target)) return false;
    OpenVolume divided = volume;
    split_round_rims(divided, RoundsOf::ends_and_walls, context);
    return is_stepped(divided, context);
}

bool has_steps(const OpenVolume& volume, const RunContext& context)
{
    return is_stepped(volume, context) || has_round_steps(volume, context);
}

std::vector<StepPiece> cut_steps(const OpenVolume& whole, const RunContext& context)
{
    OpenVolume volume = whole;
    face_away(volume, context);
    if (!has_steps(volume, context)) return {{whole, 0}};
    close_brim(volume, context);
    cover_step_holes(volume, context);
    split_round_rims(volume, RoundsOf::ends_and_walls, context);
    const std::array<Steps, 2> steps = steps_of(volume, context);
    std::vector<FaceId> risers = steps[0].risers;
    risers.insert(risers.end(), steps[1].risers.begin(), steps[1].risers.end());
    std::vector<StepPiece> result;
    if (!risers.empty()) {
        result = cut_at_risers(volume, risers, context, 0);
    } else {
        auto hung = attempt([&] { return hang_all(volume, context, 0); });
        result = hung ? std::move(*hung) : cut_in_layers(volume, steps, context);
        if (result.empty() && !hung) hung.raise();
    }
    std::ranges::stable_sort(result, {}, &StepPiece::level);
    return result;
}

} // namespace lacuna::closure
