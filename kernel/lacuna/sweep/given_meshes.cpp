// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/given_meshes.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/surface/shared/given_target.h>
#include <lacuna/sweep/detail/place_order.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Points of a face that must become nodes: all points if the face keeps its quads, otherwise the points of
/// its rim.
std::set<Index> nodes_to_keep(const Model& model, const Face& face, bool whole)
{
    std::set<Index> nodes;
    if (whole) {
        for (const Triangle& t : face.triangles) nodes.insert(t.begin(), t.end());
        return nodes;
    }
    for (const Loop& loop : face.loops) {
        for (const EdgeUse& use : loop.uses) {
            const std::vector<Index>& points = model[use.edge].points;
            nodes.insert(points.begin(), points.end());
        }
    }
    return nodes;
}

} // namespace

GivenMeshes given_meshes(const OpenVolume& volume, std::vector<surface::LinkingSurface>& links,
                         const std::vector<double>& asked, const surface::SizeField& size,
                         const SweepOptions& options)
{
    GivenMeshes given;
    given.heights = asked;
    const int layers = std::max(0, static_cast<int>(asked.size()) - 1);
    surface::GivenRows rows = surface::given_columns(volume, links, layers);
    given.columns = std::move(rows.columns);
    given.notes = std::move(rows.notes);
    for (const surface::GivenColumns& columns : given.columns) {
        if (columns.quads && layers > 0 && layers != columns.rows) {
            throw NotSweepable(
                Message("sweep.given_rows",
                        "the walls were given with {} rows of quads between source and target, but the "
                        "sweep has {} layers",
                        needed(columns.rows), found(layers))
                    .remedy("leave out 'layers'{}",
                            options.beside.own_mesh ? ", or load with keep_mesh = false"
                            : options.beside.settle
                                ? ", or cut the volumes beside so that their rows continue"
                                : ""));
        }
    }
    if (asked.empty() || options.layers.heights.empty()) {
        const std::vector<double> heights = surface::given_heights(volume.model, given.columns);
        if (!heights.empty()) given.heights = heights;
    }
    links = surface::align_alike_ends(volume, given.columns, std::move(links), options.wedges);
    surface::KeptNodes kept = surface::keep_given_nodes(volume, given.columns, std::move(links),
                                                        options.wedges);
    links = std::move(kept.links);
    std::ranges::move(kept.notes, std::back_inserter(given.notes));
    const std::vector<double> stubs = surface::stub_heights(
        volume.model, links, given.columns, size, std::max(0, static_cast<int>(given.heights.size()) - 1));
    const bool by_columns = asked.empty() && !given.heights.empty();
    if (!stubs.empty() && !by_columns && options.layers.heights.empty()) given.heights = stubs;
    return given;
}

std::set<FaceId> given_faces(const OpenVolume& volume, std::set<FaceId> faces, bool wedges)
{
    for (const Role role : {Role::wall, Role::target}) {
        for (const FaceId face : volume.faces(role)) {
            const Face& f = volume.model[face];
            const bool triangles = wedges && role == Role::target;
            if (f.keeps_nodes && (triangles || !f.given_quads.empty())) faces.insert(face);
        }
    }
    return faces;
}

void report_given(const OpenVolume& volume, Swept& swept, const SweepOptions& options)
{
    const Model& model = volume.model;
    std::vector<Vec3> skin;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const Face& face = model.faces[f];
        if (!face.keeps_nodes) continue;
        if (skin.empty()) {
            for (std::size_t i = 0; i < swept.mesh.skin_count(); ++i) {
                for (const Index n : mesh::skin_quad(swept.mesh, i).nodes)
                    skin.push_back(swept.layers ? swept.layers->on_skin(n) : swept.mesh.nodes[index(n)]);
            }
            std::ranges::sort(skin, before);
        }
        const bool whole = has_cells_to_keep(face, options.wedges && volume.role[f] != Role::wall);
        const std::set<Index> nodes = nodes_to_keep(model, face, whole);
        const auto is_lost = [&](Index point) {
            return !std::ranges::binary_search(skin, model.at(point), before);
        };
        const auto lost = static_cast<std::size_t>(std::ranges::count_if(nodes, is_lost));
        const bool keeps = options.quads == Quads::automatic || options.quads == Quads::keep;
        if (lost > 0 && whole && keeps && swept.not_kept.empty())
            swept.notes.push_back(
                formatted("given: {} of {} nodes of {} are not nodes of the mesh, such as the one at {}",
                          lost, nodes.size(), entity_of(model, FaceId(f)),
                          place_with_digits(model.at(*std::ranges::find_if(nodes, is_lost)), 4)));
        swept.report.push_back(formatted("given: {}: {} of {}{} nodes coincide", entity_of(model, FaceId(f)),
                                         nodes.size() - lost, nodes.size(), whole ? "" : " rim"));
    }
}

} // namespace lacuna::sweep
