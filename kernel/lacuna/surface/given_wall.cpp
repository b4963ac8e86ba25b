// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/given_wall.h>

#include <lacuna/core/error.h>
#include <lacuna/surface/detail/chain_nodes.h>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

using namespace topology;

namespace {

class WallBeginner {
public:
    WallBeginner(const Model& model, const LinkingSurface& link, const LinkingNodes& nodes,
                 std::size_t layers)
        : model_(model), link_(link), nodes_(nodes), count_(nodes.source_at.size()), layers_(layers)
    {
        made_.mesh.points.resize(count_ * (layers_ + 1));
        made_.mesh.face.resize(count_ * layers_);
        made_.given = {count_, std::vector<Index>(count_ * (layers_ + 1), GivenWall::kNotGiven),
                       std::vector<char>(count_ * layers_, 0)};
    }

    /// Begin the grid with the nodes of columns and stubs, which do not change.
    BegunWall run(const GivenColumns& columns)
    {
        std::vector<GivenWay> up, from_source, from_target;
        if (columns.rows == static_cast<int>(layers_)) {
            for (const GivenColumn& column : columns.whole)
                add_way(column.source_at, false, column.points, column.faces, up);
        }
        for (const GivenStub& stub : columns.stubs) {
            std::vector<GivenWay>& ways = stub.from_target ? from_target : from_source;
            const bool beside = !ways.empty() && !ways.back().faces->empty();
            const std::size_t before = ways.empty() ? 0 : ways.back().node;
            if (!add_way(stub.at, stub.from_target, stub.points, stub.faces, ways)) refuse_stub(stub);
            // Between two adjacent given columns, a rim may have one more node, which was added because its
            // number of sides was odd. Further nodes belong to the mesh of the opposite rim, which is then
            // different.
            if (beside && (ways.back().node + count_ - before) % count_ > 2) refuse_stub(stub);
        }
        take_ways(up, false);
        take_ways(from_source, false);
        take_ways(from_target, true);
        return std::move(made_);
    }

private:
    /// Given nodes that lead from a node of the rim into the wall.
    struct GivenWay {
        std::size_t node;
        const std::vector<Index>* points;
        const std::vector<FaceId>* faces;
    };

    /// @return  false if the rim has no node at `at`.
    bool add_way(double at, bool from_target, const std::vector<Index>& points,
                 const std::vector<FaceId>& faces, std::vector<GivenWay>& ways) const
    {
        const double length = from_target ? link_.target.length() : link_.source.length();
        const std::vector<double>& nodes = from_target ? nodes_.target_at : nodes_.source_at;
        const double slack = kSamePlace * length;
        const auto off = [&](double node) { return std::abs(std::remainder(node - at, length)); };
        // Positions increase from the first node; on the target they may exceed the length.
        const double start = nodes.front(), from = at + (at < start - slack ? length : 0);
        auto found = std::lower_bound(nodes.begin(), nodes.end(), from - slack);
        if (found == nodes.end()) found = nodes.begin();
        if (off(*found) > slack) return false;
        ways.push_back({static_cast<std::size_t>(found - nodes.begin()), &points, &faces});
        return true;
    }

    [[noreturn]] void refuse_stub(const GivenStub& stub) const
    {
        throw NotSweepable(Message("surface.wall_rows",
                                   "{} was given with quads on the {}'s rim, but the opposite rim has "
                                   "different nodes between the same corners",
                                   entity_of(model_, stub.wall), stub.from_target ? "target" : "source")
                               .remedy("mesh both rims alike, or load one with keep_mesh = false"));
    }

    void take_ways(const std::vector<GivenWay>& ways, bool from_target)
    {
        const auto layer = [&](std::size_t k) { return from_target ? layers_ - k : k; };
        for (std::size_t w = 0; w < ways.size(); ++w) {
            const GivenWay &way = ways[w], &next = ways[(w + 1) % ways.size()];
            for (std::size_t k = 0; k < way.points->size(); ++k) {
                made_.given.node[layer(k) * count_ + way.node] = (*way.points)[k];
                point(layer(k), way.node) = model_.at((*way.points)[k]);
            }
            const std::size_t end = next.node > way.node ? next.node : next.node + count_;
            for (std::size_t i = way.node; i < end && !way.faces->empty(); ++i) {
                // A node between two given columns was added because the rim's number of sides was odd. It
                // splits the given quads there.
                const double share = static_cast<double>(i - way.node) / static_cast<double>(end - way.node);
                for (std::size_t k = 0; k < way.faces->size(); ++k) {
                    const std::size_t low = std::min(layer(k), layer(k + 1));
                    made_.mesh.face[low * count_ + i % count_] = (*way.faces)[k];
                    made_.given.side[low * count_ + i % count_] = 1;
                }
                for (std::size_t k = 0; k <= way.faces->size() && i > way.node; ++k) {
                    made_.given.node[layer(k) * count_ + i % count_] = GivenWall::kBetweenGiven;
                    point(layer(k), i) = (1 - share) * model_.at((*way.points)[k]) +
                                         share * model_.at((*next.points)[k]);
                }
            }
        }
    }

    [[nodiscard]] Vec3& point(std::size_t layer, std::size_t node)
    {
        return made_.mesh.points[layer * count_ + node % count_];
    }

    const Model& model_;
    const LinkingSurface& link_;
    const LinkingNodes& nodes_;
    std::size_t count_, layers_;
    BegunWall made_;
};

} // namespace

bool GivenWall::has_sides() const { return std::ranges::find(side, 1) != side.end(); }

bool GivenWall::has_all(std::size_t first, std::size_t last) const
{
    for (std::size_t row = 0; row < side.size(); row += count) {
        const auto begin = side.begin() + static_cast<std::ptrdiff_t>(row);
        if (std::find(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last),
                      0) != begin + static_cast<std::ptrdiff_t>(last))
            return false;
    }
    return true;
}

BegunWall begin_wall(const Model& model, const LinkingSurface& link, const LinkingNodes& nodes,
                     const GivenColumns& columns, std::size_t layers)
{
    return WallBeginner(model, link, nodes, layers).run(columns);
}

} // namespace lacuna::surface
