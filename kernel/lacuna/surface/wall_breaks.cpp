// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/wall_breaks.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/surface/detail/imprint_rules.h>
#include <lacuna/surface/detail/wall_net.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Whether some edge inside a linking surface ends at a vertex that is on neither a side line nor a rim.
bool has_net(const Model& model, const LinkingSurface& link)
{
    std::set<VertexId> known;
    const auto take = [&](const EdgeUse& use) { known.insert({use_from(model, use), use_to(model, use)}); };
    for (const EdgeUse& use : link.source.uses()) take(use);
    for (const EdgeUse& use : link.target.uses()) take(use);
    for (const LinkingLine& line : link.lines) {
        for (const EdgeUse& use : line.line.uses) take(use);
    }
    for (const FaceId wall : link.walls) {
        for (const EdgeUse& use : uses_of(model[wall])) {

            if (!known.contains(use_from(model, use)) || !known.contains(use_to(model, use))) return true;
        }
    }
    return false;
}

/// Minimum number of layers for edges that run around the walls and end on side lines. For each side line,
/// the inner vertices at which such edges end are counted; the result is one more than the largest count.
int layers_between_rings(const Model& model, const LinkingSurface& link)
{
    std::set<EdgeId> along;
    std::set<VertexId> crossed;
    for (const LinkingLine& line : link.lines)
        for (const EdgeUse& use : line.line.uses) along.insert(use.edge);
    for (const FaceId wall : link.walls) {
        for (const EdgeUse& use : uses_of(model[wall])) {
            if (along.contains(use.edge)) continue;
            crossed.insert({use_from(model, use), use_to(model, use)});
        }
    }
    int layers = 1;
    for (const LinkingLine& line : link.lines) {
        int rings = 0;
        for (std::size_t u = 1; u < line.line.uses.size(); ++u)
            rings += crossed.contains(use_from(model, line.line.uses[u])) ? 1 : 0;
        layers = std::max(layers, rings + 1);
    }
    return layers;
}

class Breaker {
public:
    Breaker(const OpenVolume& volume, const SizeField& size, LinkingSurface& link)
        : size_(size), link_(link), map_(map_of(volume, link)), net_(wall_net(volume.model, link, *map_))
    {
    }

    int run()
    {
        for (std::size_t c = 0; c < net_.columns.size(); ++c) {
            if (!net_.columns[c].line) break_at(c);
        }
        return most_levels(net_.levels_below(*map_)) + 1;
    }

private:
    /// Whether another column already uses a position of the rim, so that this column cannot use it. Two
    /// columns can use one position if their ranges of heights do not overlap.
    [[nodiscard]] bool is_taken(double at, std::size_t column) const
    {
        const WallNet::Column& own = net_.columns[column];
        for (const auto& [place, other] : taken_) {
            const WallNet::Column& that = net_.columns[other];
            if (std::abs(place - at) <= kSamePlace * link_.source.length() && own.low <= that.high &&
                that.low <= own.high)
                return true;
        }
        return std::ranges::any_of(link_.lines, [&](const LinkingLine& line) {
            return std::abs(line.source_at - at) <= kSamePlace * link_.source.length();
        });
    }

    void break_at(std::size_t c)
    {
        const WallNet::Column& column = net_.columns[c];
        double at = column.at * link_.source.length();
        if (column.source_at) {
            taken_.emplace_back(*column.source_at, c);
            return;
        }
        const std::array here{std::min(at, link_.source.length())};
        const double reach = kOneEdge * size_(link_.source.points(here).front());
        double least = std::max(reach, kSamePlace * link_.source.length());
        std::optional<std::size_t> near;
        for (std::size_t i = 0; i < link_.segments.size(); ++i) {
            const double off = std::abs(link_.segments[i].source_from - at);
            const double round = std::min(off, link_.source.length() - off);
            if (round > least || is_taken(link_.segments[i].source_from, c)) continue;
            if (column.target_at && !way_to(i, *column.target_at)) continue;
            least = round;
            near = i;
        }
        taken_.emplace_back(near ? link_.segments[*near].source_from : at, c);
        if (!near) return divide(at);
        if (column.target_at) lead(*near, *way_to(*near, *column.target_at));
    }

    /// The start of segment i lies on the target at `target_from`. This is the distance by which this
    /// position must move along the rim to meet the end of a column. Empty if it must not move: it is a
    /// vertex or a given node, or another segment ends between the two positions.
    [[nodiscard]] std::optional<double> way_to(std::size_t i, double target_at) const
    {
        const double length = link_.target.length();
        const RimSegment &own = link_.segments[i],
                         &before = link_.segments[(i > 0 ? i : link_.segments.size()) - 1];
        const double way = std::remainder(target_at - own.target_from, length);
        if (std::abs(way) <= kSamePlace * length) return 0;
        if (own.given || before.given || own.target_from + way >= own.target_to ||
            before.target_to + way <= before.target_from)
            return std::nullopt;
        for (std::size_t u = 0; u < link_.target.uses().size(); ++u) {
            const double off = std::remainder(link_.target.start(u) - own.target_from, length);
            if (std::abs(off) <= kSamePlace * length) return std::nullopt;
        }
        return way;
    }
    void lead(std::size_t i, double way)
    {
        link_.segments[i].target_from += way;
        link_.segments[(i > 0 ? i : link_.segments.size()) - 1].target_to += way;
        const double turn = link_.segments.front().target_from < 0 ? link_.target.length() : 0;
        for (RimSegment& segment : link_.segments) {
            segment.target_from += turn;
            segment.target_to += turn;
        }
    }

    void divide(double at)
    {
        const double slack = kSamePlace * link_.source.length();
        for (std::size_t i = 0; i < link_.segments.size(); ++i) {
            RimSegment& low = link_.segments[i];
            if (at < low.source_from + slack || at > low.source_to - slack) continue;
            // A side of a given quad is not split: the column uses one of its end nodes.
            if (low.given) return;
            RimSegment high = low;
            const double f = (at - low.source_from) / (low.source_to - low.source_from);
            high.source_from = low.source_to = at;
            high.target_from = low.target_to = low.target_from + f * (low.target_to - low.target_from);
            link_.segments.insert(link_.segments.begin() + static_cast<std::ptrdiff_t>(i) + 1, high);
            return;
        }
    }

    const SizeField& size_;
    LinkingSurface& link_;
    std::shared_ptr<const LinkingMap> map_;
    WallNet net_;
    std::vector<std::pair<double, std::size_t>> taken_; ///< used positions on the source's rim
};

} // namespace

WallBreaks set_wall_breaks(const OpenVolume& volume, const SizeField& size, std::vector<LinkingSurface> links)
{
    int layers = 1;
    for (LinkingSurface& link : links) {
        layers = std::max(layers, layers_between_rings(volume.model, link));
        if (has_net(volume.model, link)) layers = std::max(layers, Breaker(volume, size, link).run());
    }
    return {std::move(links), layers};
}

std::map<EdgeId, double> heights_around(const OpenVolume& volume, const LinkingSurface& link,
                                        const RunContext& context)
{
    std::map<EdgeId, double> heights;
    if (link.walls.size() <= std::max<std::size_t>(1, link.lines.size())) return heights;
    const std::shared_ptr<const LinkingMap> map = map_of(volume, link, true, context);
    for (const LinkingMap::Ring& ring : map->rings())
        for (const LinkingMap::Piece& piece : ring.pieces)
            heights.emplace(piece.edge, map->to_even(ring.height));
    return heights;
}

} // namespace lacuna::surface
