// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/intervals.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

[[noreturn]] void refuse(const std::string& what)
{
    throw InvalidInput("surface.no_such_edge", "sweep: option 'intervals' " + what);
}

class IntervalFinder {
public:
    IntervalFinder(const OpenVolume& volume, std::span<const LinkingSurface> links)
        : volume_(volume), model_(volume.model), links_(links), uses_(edge_uses(volume.model))
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
            if (model_.edges[e].tag == tag && !uses_[e].empty()) return EdgeId(e);
        }
        refuse("names edge " + std::to_string(tag) +
               ", which the volume does not have; volume:tree() lists its edges");
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
                ask_layers(interval.count, up ? interval.bias : 1 / interval.bias, words(interval));
                return;
            }
        }
        std::vector<EdgeId> found;
        bool reversed = false;
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            const Edge& edge = model_.edges[e];
            const bool along = is(edge.from, 0) && is(edge.to, 1), back = is(edge.from, 1) && is(edge.to, 0);
            if (uses_[e].empty() || (!along && !back)) continue;
            found.emplace_back(e);
            reversed = !along;
        }
        if (found.size() == 1) return on_edge(found.front(), interval, reversed);
        refuse("names the edge between vertices " + std::to_string(tag[0]) + " and " +
               std::to_string(tag[1]) + ", but " +
               (found.empty() ? "no edge joins them" : names_of(model_, found) + " do; name one by its tag") +
               "; volume:tree() lists edges with their vertices");
    }

    [[nodiscard]] std::string words(const Interval& interval) const
    {
        if (interval.of == Interval::Of::vertices)
            return "the edge between vertices " + std::to_string(interval.vertices[0]) + " and " +
                   std::to_string(interval.vertices[1]);
        return "edge " + std::to_string(interval.edge);
    }

    void on_edge(EdgeId edge, const Interval& interval, bool reversed)
    {
        SidesAsked asked{{}, interval.count, reversed ? 1 / interval.bias : interval.bias, words(interval)};
        for (const FaceUse& use : uses_[edge.index()]) {
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
                    refuse("names " + name_of(model_, edge) +
                           ", one of several edges between source and target there; give layer heights "
                           "instead: layers = { … }");
                ask_layers(interval.count, use->reversed ? 1 / asked.bias : asked.bias, asked.name);
                return;
            }
        }
        if (!on_target(edge, asked)) {
            refuse("names " + name_of(model_, edge) +
                   ", which lies inside the target or a wall; name an edge of the source, of the target's "
                   "rim, or one from source to target");
        }
        demands_.sides.push_back(std::move(asked));
    }

    /// The part of the source's rim that is swept to an edge of the target's rim, along that edge.
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

    /// The selected segments of a rim in walking order, starting after a gap.
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
        SidesAsked asked{
            {}, interval.count, 1, full_list(named, [&](FaceId wall) { return name_of(model_, wall); })};
        for (const FaceId wall : named) {
            if (volume_.role[wall.index()] != Role::wall)
                refuse("names " + name_of(model_, wall) +
                       ", which is not a wall; for source and target name their edges");
        }
        for (const LinkingSurface& link : links_) {
            add_segments(link, asked, [&](const RimSegment& segment) {
                const EdgeId low = link.source.uses()[segment.use].edge;
                return walls.contains(wall_on(volume_, uses_, low)) ||
                       walls.contains(wall_on(volume_, uses_, target_use(link, segment).edge));
            });
        }
        if (asked.parts.empty())
            refuse("names " + asked.name +
                   ", which touches neither source nor target; name the wall below or above it");
        demands_.sides.push_back(std::move(asked));
    }

    void ask_layers(int count, double bias, const std::string& name, bool of_sweep = false)
    {
        if (demands_.layers && (demands_.layers->count != count || demands_.layers->bias != bias)) {
            throw NotSweepable("surface.sides_asked",
                               "intervals: " + demands_.layers->name + " asks for " +
                                   std::to_string(demands_.layers->count) + " layers and " + name + " for " +
                                   std::to_string(count) +
                                   (count == demands_.layers->count ? " with another bias" : "") +
                                   "; all columns need the same layers");
        }
        demands_.layers = {count, bias, name, of_sweep};
    }

    const OpenVolume& volume_;
    const Model& model_;
    std::span<const LinkingSurface> links_;
    std::vector<std::vector<FaceUse>> uses_;
    IntervalDemands demands_;
};

} // namespace

IntervalDemands find_intervals(const OpenVolume& volume, std::span<const LinkingSurface> links,
                               std::span<const Interval> intervals)
{
    return intervals.empty() ? IntervalDemands{} : IntervalFinder(volume, links).find(intervals);
}

} // namespace lacuna::surface
