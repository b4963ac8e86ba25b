// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/intervals.h>

#include <lacuna/core/error.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

class IntervalFinder {
public:
    IntervalFinder(const OpenVolume& volume, std::span<const LinkingSurface> links)
        : volume_(volume), model_(volume.model), links_(links)
    {
    }

    IntervalDemands find(std::span<const Interval> intervals)
    {
        for (const Interval& interval : intervals) {
            switch (interval.of) {
            case Interval::Of::edge:
                on_edge(edge_tagged(interval.edge), interval, false);
                break;
            case Interval::Of::vertices:
                between(interval);
                break;
            case Interval::Of::wall:
                on_walls(interval);
                break;
            case Interval::Of::sweep:
                ask_layers(interval.count, interval.bias, "the sweep", true);
                break;
            }
        }
        return std::move(demands_);
    }

private:
    [[nodiscard]] EdgeId edge_tagged(int tag) const
    {
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            if (model_.edges[e].tag == tag && !model_.uses_of_edge(EdgeId(e)).empty()) return EdgeId(e);
        }
        throw InvalidInput(Message("surface.no_such_edge",
                                   "sweep: option 'intervals' names {}, which the volume does not have",
                                   NamedEntity{"edge", tag})
                               .remedy("volume:tree() lists its edges"));
    }

    void between(const Interval& interval)
    {
        const auto& tag = interval.vertices;
        const auto is = [&](VertexId v, std::size_t k) { return model_[v].tag == tag[k]; };
        for (const LinkingSurface& link : links_) {
            for (const LinkingLine& line : link.lines) {
                const bool up = is(line.line.source, 0) && is(line.line.target, 1);
                const bool down = is(line.line.source, 1) && is(line.line.target, 0);
                if (!up && !down) continue;
                std::vector<NamedEntity> edges;
                for (const EdgeUse& use : line.line.uses) edges.push_back(entity_of(model_, use.edge));
                ask_layers(interval.count, up ? interval.bias : 1 / interval.bias, edges);
                return;
            }
        }
        std::vector<EdgeId> found;
        bool reversed = false;
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            const Edge& edge = model_.edges[e];
            const bool along = is(edge.from, 0) && is(edge.to, 1), back = is(edge.from, 1) && is(edge.to, 0);
            if (model_.uses_of_edge(EdgeId(e)).empty() || (!along && !back)) continue;
            found.emplace_back(e);
            reversed = !along;
        }
        if (found.size() == 1) return on_edge(found.front(), interval, reversed);
        const NamedEntity a{"vertex", tag[0]}, b{"vertex", tag[1]};
        if (found.empty())
            throw InvalidInput(
                Message("surface.no_such_edge",
                        "sweep: option 'intervals' names the edge between {} and {}, but no edge joins them",
                        a, b)
                    .remedy("volume:tree() lists edges with their vertices"));
        throw InvalidInput(Message("surface.no_such_edge",
                                   "sweep: option 'intervals' names the edge between {} and {}, but {} do", a,
                                   b, entities_of(model_, found))
                               .remedy("name one by its tag"));
    }

    void on_edge(EdgeId edge, const Interval& interval, bool reversed)
    {
        SidesAsked asked{
            {}, interval.count, reversed ? 1 / interval.bias : interval.bias, entity_of(model_, edge)};
        for (const FaceUse& use : model_.uses_of_edge(edge)) {
            if (volume_.role[use.face.index()] != Role::source) continue;
            asked.parts.push_back({edge, 0, 1, false});
            demands_.sides.push_back(std::move(asked));
            return;
        }
        for (const LinkingSurface& link : links_) {
            for (const LinkingLine& line : link.lines) {
                const auto& uses = line.line.uses;
                const auto use = std::ranges::find_if(uses, [&](const EdgeUse& u) { return u.edge == edge; });
                if (use == uses.end()) continue;
                if (uses.size() > 1)
                    throw InvalidInput(
                        Message("surface.no_such_edge",
                                "sweep: option 'intervals' names {}, one of several edges between source and "
                                "target there",
                                entity_of(model_, edge))
                            .remedy("give layer heights instead: layers = {{ … }}"));
                ask_layers(interval.count, use->reversed ? 1 / asked.bias : asked.bias, asked.name);
                return;
            }
        }
        if (!on_target(edge, asked)) {
            throw InvalidInput(
                Message("surface.no_such_edge",
                        "sweep: option 'intervals' names {}, which lies inside the target or a wall",
                        entity_of(model_, edge))
                    .remedy("name an edge of the source, of the target's rim, or one from source to target"));
        }
        demands_.sides.push_back(std::move(asked));
    }

    /// Assign the request to the part of the source's rim that is swept to the given edge of the target's
    /// rim.
    bool on_target(EdgeId edge, SidesAsked& asked) const
    {
        for (const LinkingSurface& link : links_) {
            const std::vector<EdgeUse>& uses = link.target.uses();
            const auto use = std::ranges::find_if(uses, [&](const EdgeUse& u) { return u.edge == edge; });
            if (use == uses.end()) continue;

            add_segments(link, asked,
                         [&](const RimSegment& segment) { return target_use(link, segment) == *use; });
            if (use->reversed) turn_round(asked);
            return !asked.parts.empty();
        }
        return false;
    }

    static void turn_round(SidesAsked& asked)
    {
        std::ranges::reverse(asked.parts);
        for (SidesAsked::Part& part : asked.parts) part.reversed = !part.reversed;
    }

    /// Add the selected segments of a rim in walking order. The walk starts after a segment that is not
    /// selected.
    template <class IsMeant>
    static void add_segments(const LinkingSurface& link, SidesAsked& asked, const IsMeant& is_meant)
    {
        const std::size_t n = link.segments.size();
        std::size_t start = 0;
        for (std::size_t i = 0; i < n; ++i) {
            if (is_meant(link.segments[i]) && !is_meant(link.segments[(i + n - 1) % n])) start = i;
        }
        for (std::size_t k = 0; k < n; ++k) {
            const RimSegment& segment = link.segments[(start + k) % n];
            if (!is_meant(segment)) continue;
            const EdgeUse use = link.source.uses()[segment.use];
            const auto [from, to] = edge_part(link, segment);
            asked.parts.push_back({use.edge, from, to, use.reversed});
        }
    }

    void on_walls(const Interval& interval)
    {
        const std::vector<FaceId> named = faces_named(volume_, interval.walls, "intervals");
        const std::set<FaceId> walls(named.begin(), named.end());
        SidesAsked asked{{}, interval.count, 1, entities_of(model_, named)};
        for (const FaceId wall : named) {
            if (volume_.role[wall.index()] != Role::wall)
                throw InvalidInput(Message("surface.no_such_edge",
                                           "sweep: option 'intervals' names {}, which is not a wall",
                                           entity_of(model_, wall))
                                       .remedy("for source and target name their edges"));
        }
        for (const LinkingSurface& link : links_) {
            add_segments(link, asked, [&](const RimSegment& segment) {
                const EdgeId low = link.source.uses()[segment.use].edge;
                return walls.contains(wall_on(volume_, low)) ||
                       walls.contains(wall_on(volume_, target_use(link, segment).edge));
            });
        }
        if (asked.parts.empty())
            throw InvalidInput(
                Message("surface.no_such_edge",
                        "sweep: option 'intervals' names {}, which touches neither source nor target",
                        asked.name)
                    .remedy("name the wall below or above it"));
        demands_.sides.push_back(std::move(asked));
    }

    void ask_layers(int count, double bias, const Argument& name, bool of_sweep = false)
    {
        const auto& before = demands_.layers;
        if (before && (before->count != count || before->bias != bias)) {
            throw NotSweepable(
                Message("surface.sides_asked",
                        "intervals: {} asks for {} layers and {} for {}{}, but a sweep has the "
                        "same layers everywhere",
                        before->name, found(before->count), name, found(count),
                        count == before->count ? " with another bias" : "")
                    .remedy("leave one of them out"));
        }
        demands_.layers = {count, bias, name, of_sweep};
    }

    const OpenVolume& volume_;
    const Model& model_;
    std::span<const LinkingSurface> links_;
    IntervalDemands demands_;
};

} // namespace

IntervalDemands find_intervals(const OpenVolume& volume, std::span<const LinkingSurface> links,
                               std::span<const Interval> intervals)
{
    return intervals.empty() ? IntervalDemands{} : IntervalFinder(volume, links).find(intervals);
}

} // namespace lacuna::surface
