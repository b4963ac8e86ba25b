// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/given_meshes.h>

#include <lacuna/core/error.h>
#include <lacuna/sweep/detail/words.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lacuna::sweep {

using namespace topology;

namespace {

bool before(const Vec3& a, const Vec3& b)
{
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Points of a face that are to be nodes: of its quads, or of its rim where it has triangles.
std::set<Index> nodes_to_keep(const Model& model, const Face& face)
{
    std::set<Index> nodes;
    for (const Quad& quad : face.given_quads) nodes.insert(quad.begin(), quad.end());
    if (has_quads_all_over(face)) return nodes;
    nodes.clear();
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
                         const std::vector<double>& asked, const SweepOptions& options)
{
    GivenMeshes given;
    given.heights = asked;
    const int layers = std::max(0, static_cast<int>(asked.size()) - 1);
    given.columns = surface::given_columns(volume, links, layers, given.notes);
    for (const surface::GivenColumns& columns : given.columns) {
        if (columns.quads && layers > 0 && layers != columns.rows) {
            throw NotSweepable("sweep.given_rows",
                               "the walls came with " + std::to_string(columns.rows) +
                                   " rows of quads between source and target, and " + std::to_string(layers) +
                                   " layers were asked for; leave out 'layers', or load with "
                                   "keep_mesh = false");
        }
    }
    if (asked.empty() || options.layers.heights.empty()) {
        const std::vector<double> heights = surface::given_heights(volume.model, given.columns);
        if (!heights.empty()) given.heights = heights;
    }
    surface::keep_given_nodes(volume, given.columns, links, given.notes);
    return given;
}

std::vector<double> default_heights(const std::vector<surface::LinkingSurface>& links,
                                    const surface::SizeField& size, LayerSpec spec, int least)
{
    double sides = 0, segments = 0;
    for (const surface::LinkingSurface& link : links) {
        for (const surface::RimSegment& segment : link.segments) {
            const std::array<double, 1> low{segment.source_from};
            const double end = link.target.length();
            const std::array<double, 1> high{segment.target_from >= end ? segment.target_from - end
                                                                        : segment.target_from};
            const Vec3 from = link.source.points(low).front(), to = link.target.points(high).front();
            ++segments;
            sides += (to - from).norm() / size((from + to) / 2);
        }
    }
    const double count = segments > 0 ? sides / segments : 1;
    if (!(count < std::numeric_limits<Index>::max() / 16.0)) {
        throw InvalidInput("sweep.too_many",
                           "about " + in_short(count) + " layers would be needed at the size; give 'layers'");
    }
    spec.count = std::max(least, static_cast<int>(std::lround(count)));
    return layer_heights(spec);
}

std::set<FaceId> given_faces(const OpenVolume& volume, std::set<FaceId> faces)
{
    for (const Role role : {Role::wall, Role::target}) {
        for (const FaceId face : volume.faces(role)) {
            if (volume.model[face].keeps_nodes && !volume.model[face].given_quads.empty()) faces.insert(face);
        }
    }
    return faces;
}

void report_given(const OpenVolume& volume, Swept& swept)
{
    const Model& model = volume.model;
    std::vector<Vec3> skin;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const Face& face = model.faces[f];
        if (!face.keeps_nodes) continue;
        if (skin.empty()) {
            for (std::size_t i = 0; i < swept.mesh.skin_count(); ++i) {
                for (const Index n : mesh::skin_quad(swept.mesh, i).nodes)
                    skin.push_back(swept.mesh.nodes[index(n)]);
            }
            std::sort(skin.begin(), skin.end(), before);
        }
        const std::set<Index> nodes = nodes_to_keep(model, face);
        const auto found = std::count_if(nodes.begin(), nodes.end(), [&](Index point) {
            return std::binary_search(skin.begin(), skin.end(), model.at(point), before);
        });
        const bool quads = has_quads_all_over(face);
        swept.report.push_back("given: " + name_of(model, FaceId(f)) + ": " + std::to_string(found) + " of " +
                               std::to_string(nodes.size()) + (quads ? "" : " rim") + " nodes coincide");
    }
}

} // namespace lacuna::sweep
