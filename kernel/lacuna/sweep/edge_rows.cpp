// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/edge_rows.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/detail/plan_heights.h>
#include <lacuna/sweep/detail/shared_faces.h>
#include <lacuna/sweep/detail/turned_round.h>

#include <algorithm>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// For each edge, the rows at its start and at its end.
using RowsOfEdges = std::map<EdgeId, std::array<EdgeRows, 2>>;

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

/// The rows that end on edges of a member: rows of walls on the edges of its source and target, and rows of
/// ends on its side lines. Empty if the sweep will refuse the boundary layers.
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

/// Whether rows of boundary layers have the same heights.
bool are_alike(const std::vector<double>& a, const std::vector<double>& b)
{
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double thick = a[i] - (i > 0 ? a[i - 1] : 0);
        if (std::abs(a[i] - b[i]) > kVolumeNoted * thick) return false;
    }
    return true;
}

[[noreturn]] void refuse_rows(const SameEdges& edges, const EdgeRows& there, const EdgeRows& here,
                              std::size_t e)
{
    const AssemblyMember& own = edges.members()[here.member];
    const AssemblyMember& other = edges.members()[there.member];
    throw NotSweepable(Message("assembly.layers_differ",
                               "the boundary layers of {} of {} and of {} of {} end on the same edge, "
                               "{} of {}, but differ",
                               entity_in(other, there.face), other.region, entity_in(own, here.face),
                               own.region, entity_in(own, edges[e].edge), own.region)
                           .remedy("give both faces the same table of 'boundary_layers'"));
}

} // namespace

RowsOfSets shared_rows(const SameEdges& edges)
{
    RowsOfSets all;
    for (std::size_t m = 0; m < edges.members().size(); ++m) {
        for (auto& [edge, rows] : edge_rows(edges.members()[m])) {
            const std::size_t e = edges.number(m, edge);
            if (edges[e].closed || edges.kept(e) == SameEdges::Kept::quads) continue; // its nodes are given
            if (!edges.runs_along(e)) std::swap(rows[0], rows[1]);
            std::array<EdgeRows, 2>& here = all[edges.set_of(e)];
            for (std::size_t k = 0; k < 2; ++k) {
                if (rows[k].places.empty()) continue;
                rows[k].member = m;
                if (here[k].places.empty()) {
                    here[k] = std::move(rows[k]);
                    continue;
                }
                if (!are_alike(here[k].heights, rows[k].heights)) refuse_rows(edges, here[k], rows[k], e);
                // Rows of one table reach the edge at different lengths where walls lean differently.
                ++here[k].faces;
                for (std::size_t i = 0; i < here[k].places.size(); ++i)
                    here[k].places[i] += (rows[k].places[i] - here[k].places[i]) / here[k].faces;
            }
            const double taken = (here[0].places.empty() ? 0 : here[0].places.back()) +
                                 (here[1].places.empty() ? 0 : here[1].places.back());
            if (taken >= edges[e].length)
                all.erase(edges.set_of(e)); // drop the rows; the sweep reports the misfit
        }
    }
    return all;
}

} // namespace lacuna::sweep
