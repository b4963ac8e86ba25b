// SPDX-License-Identifier: MIT
//
// The step of stitch() that merges coincident edges with all their points.
#include <lacuna/healing/detail/stitcher.h>

#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace lacuna::healing {

void Stitcher::merge_edges()
{
    std::map<std::pair<VertexId, VertexId>, std::vector<EdgeId>> groups;
    for (std::size_t e = 0; e < model().edges.size(); ++e) {
        const topology::Edge& edge = model().edges[e];
        if (!loose_.is_gone(EdgeId(e))) groups[std::minmax(edge.from, edge.to)].emplace_back(e);
    }
    bool moved = false;
    for (const auto& [ends, group] : groups) moved = take_kept_nodes(group) || moved;
    if (moved) settle_points();
    std::vector<Bundle> bundles;
    for (auto& [ends, group] : groups) {
        if (group.size() < 2) continue;
        for (Bundle& bundle : bundles_of(std::move(group)))
            if (!bundle.merged.empty()) bundles.push_back(std::move(bundle));
    }
    if (bundles.empty()) return;

    // A facet side that gets points: its ends and its new points, numbered as before the points merge. All
    // sides are collected before any side is changed.
    struct FilledSide {
        Index from, to;
        std::vector<Index> between;
    };
    std::vector<FilledSide> filled;
    std::vector<EdgeId> edges;
    for (const Bundle& bundle : bundles) {
        std::vector<std::size_t> position(bundle.nodes.size());
        for (std::size_t i = 0; i < bundle.order.size(); ++i) position[bundle.order[i]] = i;
        const auto fill = [&](EdgeId e, const std::vector<std::size_t>& nodes) {
            edges.push_back(e);
            for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
                FilledSide side{bundle.nodes[nodes[i]].point, bundle.nodes[nodes[i + 1]].point, {}};
                for (std::size_t k = position[nodes[i]] + 1; k < position[nodes[i + 1]]; ++k)
                    side.between.push_back(bundle.nodes[bundle.order[k]].point);
                if (!side.between.empty()) filled.push_back(std::move(side));
            }
        };
        std::vector<std::size_t> own(model()[bundle.first].points.size());
        std::iota(own.begin(), own.end(), std::size_t{0});
        fill(bundle.first, own);
        for (const MergedEdge& merged : bundle.merged) fill(merged.edge, merged.nodes);
        topology::Edge& edge = loose_.edge(bundle.first);
        edge.points.clear();
        const bool exact = !edge.params.empty();
        edge.params.clear();
        for (const std::size_t n : bundle.order) {
            edge.points.push_back(bundle.nodes[n].point);
            if (exact) edge.params.push_back(bundle.nodes[n].param);
        }
    }
    settle_points();
    topology::SidePoints sides;
    for (FilledSide& side : filled) sides.add(side.from, side.to, std::move(side.between));
    loose_.cut(sides, edges);
    for (const Bundle& bundle : bundles) {
        for (const MergedEdge& merged : bundle.merged) {
            if (loose_.is_gone(merged.edge)) continue;
            loose_.merge(merged.edge, bundle.first);
            ++report_.edges_merged;
        }
    }
}

/// Move the points of exact edges that coincide with the edge of a kept mesh to its nodes. The points of an
/// exact edge only divide its facets, and could not be added to the sides of given quads.
/// @return  whether points were moved
bool Stitcher::take_kept_nodes(const std::vector<EdgeId>& group)
{
    bool moved = false;
    for (const EdgeId e : group) {
        if (loose_.keeps_mesh(e) || model()[e].params.empty()) continue;
        for (const EdgeId kept : group) {
            const auto along = loose_.keeps_mesh(kept) ? points_along(e, kept, tolerance_) : std::nullopt;
            if (!along) continue;
            std::vector<Index> nodes = model()[kept].points;
            if (along->reversed) std::ranges::reverse(nodes);
            const std::vector<Index> points = model()[e].points;
            for (std::size_t i = 1; i + 1 < points.size(); ++i) {
                const auto near = std::ranges::min_element(along->at, {}, [&](const auto& place) {
                    return std::abs(place.s - static_cast<double>(i));
                });
                loose_.join(points[i], nodes[static_cast<std::size_t>(near - along->at.begin())]);
                loose_.edge(e).params[i] = near->param;
            }
            moved = true;
            break; // nodes of another mesh stay where they are
        }
    }
    return moved;
}

std::vector<Stitcher::Bundle> Stitcher::bundles_of(std::vector<EdgeId> group)
{
    // Exact curves come first, so that polylines take the shape of an exact curve.
    std::stable_sort(group.begin(), group.end(),
                     [&](EdgeId a, EdgeId b) { return track(a).exact() && !track(b).exact(); });
    std::vector<Bundle> bundles;
    for (const EdgeId e : group) {
        if (std::any_of(bundles.begin(), bundles.end(),
                        [&](Bundle& bundle) { return try_add(bundle, e, tolerance_); }))
            continue;
        Bundle& own = bundles.emplace_back();
        own.first = e;
        own.keeps_mesh = loose_.keeps_mesh(e);
        const topology::Edge& edge = model()[e];
        for (std::size_t i = 0; i < edge.points.size(); ++i) {
            own.nodes.push_back(
                {static_cast<double>(i), edge.params.empty() ? 0 : edge.params[i], edge.points[i]});
            own.order.push_back(i);
        }
    }
    if (share_ > 0) sew_by_vertices(bundles);
    return bundles;
}

/// Merge two free edges with exact curves that are further apart than the tolerance, if their distance is at
/// most `share_` times the length of the shorter one.
void Stitcher::sew_by_vertices(std::vector<Bundle>& bundles)
{
    std::vector<Bundle*> free;
    for (Bundle& bundle : bundles)
        if (bundle.merged.empty() && loose_.is_free(bundle.first) && track(bundle.first).exact())
            free.push_back(&bundle);
    if (free.size() != 2) return;
    const EdgeId a = free[0]->first, b = free[1]->first;
    const FaceId face_a = loose_.users(a)[0], face_b = loose_.users(b)[0];
    if (face_a == face_b || model()[a].from == model()[a].to) return;
    const double reach = share_ * std::min(track(a).length(), track(b).length());
    if (!try_add(*free[0], b, reach)) return;
    report_.notes.push_back(Message("healing.edges_sewn",
                                    "{} of {} and {} of {} have the same ends and are up to {:.3g} apart; "
                                    "they were merged into the first",
                                    named(a), entity_of(model(), face_a), named(b),
                                    entity_of(model(), face_b),
                                    greatest_gap(track(a), track(b), tolerance_, context_))
                                .remedy("to decide this yourself, give a tolerance")
                                .as_warning());
    std::erase_if(bundles, [&](const Bundle& bundle) { return bundle.first == b; });
}

/// The positions of an edge's points along another edge with the same ends. Empty if the edges are further
/// apart than a tolerance.
std::optional<Stitcher::Along> Stitcher::points_along(EdgeId first, EdgeId e, double tolerance)
{
    const topology::Edge& edge = model()[e];
    const EdgeTrack& along = track(first);
    const EdgeTrack& own = track(e);
    const bool closed = edge.from == edge.to;
    for (const bool reversed : {false, true}) {
        if (!closed && reversed != (edge.from != model()[first].from)) continue;
        std::vector<Vec3> samples = own.samples();
        std::vector<Vec3> samples_along = along.samples();
        if (reversed) {
            std::reverse(samples.begin(), samples.end());
            std::reverse(samples_along.begin(), samples_along.end());
        }
        const auto places = along.follow(samples, tolerance, context_);
        if (!places || !own.follow(samples_along, tolerance, context_)) continue;
        Along result{reversed, {}};
        const std::size_t stride = own.exact() ? 2 : 1;
        for (std::size_t i = 0; i < places->size(); i += stride) result.at.push_back((*places)[i]);
        return result;
    }
    return std::nullopt;
}

/// Merge an edge into a bundle, if it stays close to the bundle's first edge.
/// @param tolerance  largest distance between edges that merge.
/// @return  whether the edge was merged
bool Stitcher::try_add(Bundle& bundle, EdgeId e, double tolerance)
{
    const auto along = points_along(bundle.first, e, tolerance);
    return along && add_nodes(bundle, e, along->reversed, along->at);
}

/// Merge the points of an edge into the nodes of a bundle; a point without a near node becomes a new node.
/// @return false, with a note, if a kept mesh does not permit this.
bool Stitcher::add_nodes(Bundle& bundle, EdgeId e, bool reversed,
                         const std::vector<EdgeTrack::EdgePosition>& places)
{
    std::vector<Index> points = model()[e].points;
    if (reversed) std::reverse(points.begin(), points.end());
    const auto at = [&](Index p) -> const Vec3& { return model().at(p); };
    const bool keeps_mesh = loose_.keeps_mesh(e);
    const bool may_slide = !bundle.keeps_mesh && !keeps_mesh &&
                           (track(e).exact() || track(bundle.first).exact());
    std::vector<Node> nodes = bundle.nodes;
    std::vector<std::size_t> order = bundle.order;
    std::vector<std::size_t> become{order.front()};
    std::size_t last = 0; // position in `order` of the node that the previous point became
    bool fits = true;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const double s = places[i].s;
        std::size_t after = last + 1;
        while (after + 1 < order.size() && nodes[order[after]].s <= s) ++after;
        double radius = tolerance_;
        if (may_slide) {
            const double side = std::min(
                {(at(points[i]) - at(points[i - 1])).norm(), (at(points[i + 1]) - at(points[i])).norm(),
                 (at(nodes[order[after]].point) - at(nodes[order[after - 1]].point)).norm()});
            radius = std::max(radius, kOnePoint * side);
        }
        const auto apart = [&](std::size_t k) { return (at(nodes[order[k]].point) - at(points[i])).norm(); };
        const std::size_t near = apart(after) < apart(after - 1) ? after : after - 1;
        if (apart(near) <= radius) {
            become.push_back(order[near]);
            last = near;
            continue;
        }
        fits = fits && !bundle.keeps_mesh;
        order.insert(order.begin() + static_cast<std::ptrdiff_t>(after), nodes.size());
        become.push_back(nodes.size());
        nodes.push_back({std::max(s, nodes[order[after - 1]].s), places[i].param, points[i]});
        last = after;
    }
    become.push_back(order.back());
    if (keeps_mesh) fits = fits && std::set<std::size_t>(become.begin(), become.end()).size() == order.size();
    if (!fits) {
        report_.notes.push_back(
            Message(
                "healing.kept_meshes_differ",
                "{} and {} coincide, but a kept mesh has other nodes there, so the faces stay unconnected",
                named(bundle.first), named(e))
                .remedy("load with keep_mesh = false, or make the meshes match"));
        return false;
    }
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        loose_.join(points[i], nodes[become[i]].point);
        if (nodes[become[i]].point == points[i] && places[i].distance > tolerance_)
            loose_.move(points[i], places[i].at);
    }
    bundle.nodes = std::move(nodes);
    bundle.order = std::move(order);
    bundle.keeps_mesh = bundle.keeps_mesh || keeps_mesh;
    bundle.merged.push_back({e, std::move(become)});
    return true;
}

} // namespace lacuna::healing
