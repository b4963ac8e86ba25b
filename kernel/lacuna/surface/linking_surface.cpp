// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/linking_surface.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/matching/shared/corners.h>
#include <lacuna/surface/detail/common_turn.h>
#include <lacuna/surface/detail/linking_map.h>
#include <lacuna/surface/detail/paired_breaks.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

std::vector<EdgeUse> against(const std::vector<EdgeUse>& uses)
{
    std::vector<EdgeUse> result;
    for (auto use = uses.rbegin(); use != uses.rend(); ++use) result.push_back(opposite(*use));
    return result;
}

/// Rotate a closed walk so that it starts at the use with index `first`.
std::vector<EdgeUse> rotated(std::vector<EdgeUse> uses, std::size_t first)
{
    std::rotate(uses.begin(), uses.begin() + static_cast<std::ptrdiff_t>(first), uses.end());
    return uses;
}

std::optional<std::size_t> use_leaving(const Model& model, const std::vector<EdgeUse>& uses, VertexId vertex)
{
    for (std::size_t i = 0; i < uses.size(); ++i) {
        if (use_from(model, uses[i]) == vertex) return i;
    }
    return std::nullopt;
}

struct RimOf {
    std::map<EdgeId, std::size_t> rim; ///< for each rim edge, the index of its rim
    std::vector<Rim> rims;
};

RimOf rims_of(const OpenVolume& volume, Role role)
{
    RimOf result;
    result.rims = rims(volume.model, volume.faces(role));
    for (std::size_t r = 0; r < result.rims.size(); ++r) {
        for (const EdgeUse& use : result.rims[r].uses) result.rim[use.edge] = r;
    }
    return result;
}

/// The rim that a connected part of the walls touches. @throw NotSweepable  it touches none or several
std::size_t only_rim(const Model& model, const std::vector<FaceId>& part, const RimOf& of, const char* end)
{
    std::set<std::size_t> touched;
    for (const FaceId face : part) {
        for (const EdgeUse& use : uses_of(model[face])) {
            const auto found = of.rim.find(use.edge);
            if (found != of.rim.end()) touched.insert(found->second);
        }
    }
    if (touched.size() == 1) return *touched.begin();
    throw NotSweepable(Message("surface.belt_loops",
                               "the connected walls {} touch {} loops of the {} instead of one: each ring of "
                               "walls must join one source loop to one target loop",
                               entities_of(model, part), found(touched.size()), end)
                           .remedy("name as walls only the faces of such rings, or add the other walls to "
                                   "source or target"));
}

/// Keep the first side line. Of the others, keep those that come in the same order around both rims.
std::vector<LinkingLine> in_order(std::vector<LinkingLine> lines)
{
    std::vector<LinkingLine> kept;
    for (LinkingLine& line : lines) {
        if (kept.empty() || line.target_at > kept.back().target_at) kept.push_back(std::move(line));
    }
    return kept;
}

std::vector<double> corners_between(const Model& model, const Chain& chain, double from, double to, bool all)
{
    std::vector<double> result;
    const double length = chain.length();
    for (int turn = 0; turn < 2; ++turn) {
        for (std::size_t i = 0; i < chain.uses().size(); ++i) {
            const double at = chain.start(i) + turn * length;
            if (at > from + model.tolerance && at < to - model.tolerance &&
                (all || matching::is_corner(model, chain.uses(), i)))
                result.push_back(at);
        }
    }
    return result;
}

void add_segments(const Model& model, LinkingSurface& link, double s0, double s1, double t0, double t1)
{
    // Without side lines, the walls determine the correspondence of the rims, and only corners that are close
    // to each other are paired.
    const Pairing pairing = link.lines.empty() ? Pairing::near : Pairing::in_order;
    std::vector<double> a = corners_between(model, link.source, s0, s1, true);
    std::vector<double> b = corners_between(model, link.target, t0, t1, false);
    for (double& x : a) x = (x - s0) / (s1 - s0);
    for (double& x : b) x = (x - t0) / (t1 - t0);
    BreakPairs breaks = paired_breaks(a, b, pairing);
    complete(breaks);
    breaks.emplace_back(1, 1);
    double a0 = 0, b0 = 0;
    for (const auto& [a1, b1] : breaks) {
        RimSegment segment{s0 + a0 * (s1 - s0), s0 + a1 * (s1 - s0), t0 + b0 * (t1 - t0), t0 + b1 * (t1 - t0),
                           0};
        segment.use = link.source.position((segment.source_from + segment.source_to) / 2).use;
        link.segments.push_back(segment);
        a0 = a1;
        b0 = b1;
    }
}

/// The positions of two corresponding vertices on the two chains.
struct PairedPlaces {
    double source_at, target_at;
};

/// Add the segments between two positions of each chain, split at the pairs between these positions.
void add_paired_segments(const Model& model, LinkingSurface& link, std::vector<PairedPlaces> pairs, double s0,
                         double s1, double t0, double t1)
{
    const double slack = model.tolerance; // minimum length of a segment
    for (PairedPlaces& pair : pairs) {
        if (pair.target_at < t0) pair.target_at += link.target.length();
    }
    for (const PairedPlaces& pair : pairs) {
        if (pair.source_at < s0 + slack || pair.source_at > s1 - slack || pair.target_at < t0 + slack ||
            pair.target_at > t1 - slack)
            continue;
        add_segments(model, link, s0, pair.source_at, t0, pair.target_at);
        s0 = pair.source_at;
        t0 = pair.target_at;
    }
    add_segments(model, link, s0, s1, t0, t1);
}

/// The pairs whose vertices lie on both chains, in the source's order.
std::vector<PairedPlaces> places_of(const Model& model, const LinkingSurface& link,
                                    std::span<const RimPair> pairs)
{
    std::vector<PairedPlaces> places;
    for (const RimPair& pair : pairs) {
        const auto s = use_leaving(model, link.source.uses(), pair.source);
        const auto t = use_leaving(model, link.target.uses(), pair.target);
        if (s && t) places.push_back({link.source.start(*s), link.target.start(*t)});
    }
    std::ranges::sort(places, {}, &PairedPlaces::source_at);
    return places;
}

/// On bent walls without side lines, let the target rim correspond to the source rim by a frame that is moved
/// along the walls with minimal rotation (`LinkingMap::turn()`).
void turn_least(const OpenVolume& volume, LinkingSurface& link, const RunContext& context)
{
    if (runs_straight(volume.model, link)) return;
    const std::shared_ptr<const LinkingMap> map = map_of(volume, link, true, context);
    if (map->turn() == 0) return;
    const double length = link.target.length();
    const double share = link.segments.front().target_from / length + map->turn();
    const double start = (share - std::floor(share)) * length;
    link.branch = map->target_branch() - map->turn();
    link.segments.clear();
    add_segments(volume.model, link, 0, link.source.length(), start, start + length);
}

/// Whether the only side line is the seam of a periodic face and should be ignored. A seam is ignored in
/// these cases:
/// - It winds around the walls.
/// - The walls bend and have several faces; rows that follow the seam would then be sheared.
bool is_idle_seam(const OpenVolume& volume, const LinkingSurface& link, const RunContext& context)
{
    if (link.lines.size() != 1 || runs_straight(volume.model, link)) return false;
    for (const EdgeUse& use : link.lines.front().line.uses) {
        const std::span<const FaceUse> beside = volume.model.uses_of_edge(use.edge);
        if (beside.size() != 2 || beside[0].face != beside[1].face) return false;
    }
    const std::shared_ptr<const LinkingMap> map = map_of(volume, link, true, context);
    return map->most_turned() > kParallel / kFullTurn || (map->bends() && link.walls.size() > 1);
}

LinkingSurface make_link(const OpenVolume& volume, std::vector<FaceId> walls, const Rim& source_rim,
                         const Rim& target_rim, const std::vector<matching::SideLine>& lines,
                         std::span<const RimPair> pairs, const RunContext& context)
{
    const Model& model = volume.model;
    std::vector<EdgeUse> source = source_rim.uses;
    std::vector<EdgeUse> target = against(target_rim.uses);
    std::vector<matching::SideLine> mine;
    for (const matching::SideLine& line : lines) {
        if (use_leaving(model, source, line.source) && use_leaving(model, target, line.target))
            mine.push_back(line);
    }
    if (!mine.empty()) {
        source = rotated(std::move(source), *use_leaving(model, source, mine.front().source));
        target = rotated(std::move(target), *use_leaving(model, target, mine.front().target));
    }
    bool started = false; // without side lines, a pair defines the start of both chains
    for (const RimPair& pair : pairs) {
        const auto s = use_leaving(model, source, pair.source), t = use_leaving(model, target, pair.target);
        if (!mine.empty() || started || !s || !t) continue;
        source = rotated(std::move(source), *s);
        target = rotated(std::move(target), *t);
        started = true;
    }
    LinkingSurface link{std::move(walls), Chain(model, source), Chain(model, target), {}, {}, {}};
    for (const matching::SideLine& line : mine) {
        link.lines.push_back({line, link.source.start(*use_leaving(model, source, line.source)),
                              link.target.start(*use_leaving(model, target, line.target))});
    }
    std::ranges::sort(link.lines, {}, &LinkingLine::source_at);
    link.lines = in_order(std::move(link.lines));

    const double s_end = link.source.length();
    const double t_end = link.target.length();
    const std::vector<PairedPlaces> places = places_of(model, link, pairs);
    if (link.lines.empty()) {
        double start = 0;
        if (!started) std::tie(start, link.branch) = unguided_target(volume, link, context);
        add_paired_segments(model, link, places, 0, s_end, start, start + t_end);
        if (!started && places.empty()) turn_least(volume, link, context);
    }
    for (std::size_t i = 0; i < link.lines.size(); ++i) {
        const bool last = i + 1 == link.lines.size();
        add_paired_segments(model, link, places, link.lines[i].source_at,
                            last ? s_end : link.lines[i + 1].source_at, link.lines[i].target_at,
                            last ? t_end : link.lines[i + 1].target_at);
    }
    return link;
}

/// Check that the walls of a loop form a ring. Walls with a tunnel between them (a bore from one wall to
/// another) cannot be mapped onto a strip.
void check_ring(const Model& model, const std::vector<FaceId>& part)
{
    if (euler_number(model, part) == 0) return;
    std::vector<FaceId> pierced;
    for (const FaceId face : part) {
        if (model[face].loops.size() > 1) pierced.push_back(face);
    }
    if (pierced.empty())
        throw NotSweepable(Message("surface.wall_pierced",
                                   "the walls {} do not form a simple ring between source and target",
                                   entities_of(model, part))
                               .remedy("cut the volume through them"));
    throw NotSweepable(
        Message(
            "surface.wall_pierced",
            "the walls do not form a simple ring between source and target: {} have openings to other walls",
            entities_of(model, pierced))
            .remedy("cut the volume there"));
}

} // namespace

std::pair<double, double> edge_part(const LinkingSurface& link, const RimSegment& segment)
{
    const double start = link.source.start(segment.use);
    const double length = link.source.start(segment.use + 1) - start;
    const double from = std::clamp((segment.source_from - start) / length, 0.0, 1.0);
    const double to = std::clamp((segment.source_to - start) / length, 0.0, 1.0);
    return link.source.uses()[segment.use].reversed ? std::pair{1 - to, 1 - from} : std::pair{from, to};
}

EdgeUse target_use(const LinkingSurface& link, const RimSegment& segment)
{
    const double middle = link.target.wrapped((segment.target_from + segment.target_to) / 2);
    return link.target.uses()[link.target.position(middle).use];
}

LinkingSurface tube_link(const OpenVolume& volume, FaceId face, const RunContext& context)
{
    const std::vector<Loop>& loops = volume.model[face].loops;
    return make_link(volume, {face}, {against(loops[0].uses)}, {against(loops[1].uses)}, {}, {}, context);
}

bool runs_straight(const Model& model, const LinkingSurface& link)
{
    const Vec3 way = (geometry::mean_point(round_points(link.target)) -
                      geometry::mean_point(round_points(link.source)))
                         .stableNormalized();
    return std::ranges::all_of(link.walls, [&](FaceId wall) {
        return std::ranges::all_of(model[wall].triangles, [&](const Triangle& t) {
            const Vec3 normal = facet_area_vector(model, t);
            return std::abs(normal.dot(way)) <= kParallel * normal.norm();
        });
    });
}

bool has_bent_line(const Model& model, const LinkingSurface& link)
{
    return std::ranges::any_of(link.lines, [&](const LinkingLine& line) {
        const std::vector<Vec3> places = places_at(model, use_points(model, line.line.uses));
        return geometry::length(places) > (1 + kVisible) * (places.back() - places.front()).norm();
    });
}

std::vector<LinkingSurface> linking_surfaces(const OpenVolume& volume, Turning turning,
                                             std::span<const RimPair> pairs, const RunContext& context)
{
    const Model& model = volume.model;
    const RimOf source = rims_of(volume, Role::source);
    const RimOf target = rims_of(volume, Role::target);
    if (source.rims.size() != target.rims.size()) {
        throw NotSweepable(Message("surface.loop_counts",
                                   "source and target must have the same number of loops, but have {} and {}",
                                   found(source.rims.size()), found(target.rims.size()))
                               .remedy("check source and target, or cut the volume"));
    }
    const std::vector<matching::SideLine> lines = matching::side_lines(volume, context);
    std::vector<std::optional<LinkingSurface>> by_rim(source.rims.size());
    for (std::vector<FaceId>& part : connected_parts(model, volume.faces(Role::wall))) {
        const std::size_t s = only_rim(model, part, source, "source");
        const std::size_t t = only_rim(model, part, target, "target");
        check_ring(model, part);
        check_cancelled(context);
        if (by_rim[s]) {
            throw NotSweepable(
                Message("surface.belt_twice",
                        "the walls ({}) and ({}) touch the same source loop but not each other, "
                        "although the walls of a loop must be connected",
                        entities_of(model, part), entities_of(model, by_rim[s]->walls))
                    .remedy("name the walls between them, or close the volume first"));
        }
        by_rim[s] = make_link(volume, std::move(part), source.rims[s], target.rims[t], lines, pairs, context);
        if (!is_idle_seam(volume, *by_rim[s], context)) continue;
        by_rim[s] = make_link(volume, by_rim[s]->walls, source.rims[s], target.rims[t], {}, pairs, context);
    }
    std::vector<LinkingSurface> result;
    for (std::size_t s = 0; s < by_rim.size(); ++s) {
        if (!by_rim[s]) {
            throw NotSweepable(Message("surface.no_belt", "{}, which contains {}, has no walls",
                                       NamedEntity{"source loop", static_cast<long long>(s) + 1},
                                       entity_of(model, source.rims[s].uses.front().edge))
                                   .remedy("close the volume first"));
        }
        result.push_back(std::move(*by_rim[s]));
    }
    if (turning == Turning::each) return result;
    const std::vector<std::optional<CommonTurn>> turns = common_turns(result);
    for (std::size_t b = 0; b < result.size(); ++b) {
        if (!turns[b]) continue;
        LinkingSurface& link = result[b];
        link.segments.clear();
        add_segments(model, link, 0, link.source.length(), turns[b]->start,
                     turns[b]->start + link.target.length());
        link.branch = turns[b]->branch;
    }
    return result;
}

} // namespace lacuna::surface
