// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/edge_rows.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/detail/plan_heights.h>
#include <lacuna/sweep/detail/turned_round.h>

#include <algorithm>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Set the positions of the rows that end at one end of an edge.
void add(RowsOfEdges& rows, EdgeId edge, bool at_end, std::vector<double> places, FaceId face,
         const std::vector<double>& heights)
{
    rows[edge][at_end ? 1 : 0] = {std::move(places), face, heights};
}

/// Add the rows along walls. They end on edges of the source.
void add_rows_of_walls(const OpenVolume& volume, const surface::LayerTables& tables, RowsOfEdges& rows)
{
    const surface::RimRows rim = surface::rim_rows(volume, surface::linking_surfaces(volume), tables);
    for (auto [at, end] : rim.ends) {
        const auto& [edge, at_end] = at;
        end.inward = end.over; // heights over the wall are the same whatever face of an end the rows lie on
        const std::vector<double>& heights = rim.heights[index(end.table)];
        std::vector<double> places = surface::row_places(volume.model, edge, at_end, end, heights);
        if (places.size() < heights.size()) continue;
        const double length = edge_length(volume.model, edge);
        if (at_end) reverse_heights(places);
        for (double& place : places) place *= length;
        add(rows, edge, at_end, std::move(places), end.wall, heights);
    }
}

/// Add the rows along ends. They end on the side lines.
void add_rows_of_ends(const OpenVolume& volume, const surface::LayerTables& tables, RowsOfEdges& rows)
{
    for (const Role role : {Role::source, Role::target}) {
        const auto found = std::ranges::find_if(
            tables.of, [&](const auto& entry) { return volume.role[entry.first.index()] == role; });
        if (found == tables.of.end()) continue;
        for (const surface::LinkingSurface& link : surface::linking_surfaces(volume)) {
            for (const surface::LinkingLine& line : link.lines) {
                if (line.line.uses.size() != 1) continue;
                const EdgeUse use = line.line.uses.front(); // this edge runs from source to target
                const std::vector<double>& heights = tables.heights[index(found->second)];
                add(rows, use.edge, use.reversed == (role == Role::source), heights, found->first, heights);
            }
        }
    }
}

} // namespace

RowsOfEdges edge_rows(const AssemblyMember& member)
{
    if (member.fixed != nullptr || member.options.boundary_layers.empty()) return {};
    auto found = unless_refused([&] {
        RowsOfEdges rows;
        const surface::LayerTables tables = surface::layer_tables(*member.volume,
                                                                  member.options.boundary_layers);
        add_rows_of_walls(*member.volume, tables, rows);
        add_rows_of_walls(turned_round(*member.volume), tables, rows);
        add_rows_of_ends(*member.volume, tables, rows);
        return rows;
    });
    return found ? std::move(*found) : RowsOfEdges{}; // the member's own sweep reports the error
}

} // namespace lacuna::sweep
