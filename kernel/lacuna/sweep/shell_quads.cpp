// SPDX-License-Identifier: MIT
#include <lacuna/sweep/shared/shell_quads.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/surface/shared/projector.h>
#include <lacuna/sweep/detail/source_quads.h>

#include <algorithm>
#include <map>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Measure each quad in the plane of its corners. Refuse a quad that is folded in this plane.
void measure(const Model& model, ShellQuads& shell)
{
    double sum = 0;
    for (std::size_t q = 0; q < shell.quads.size(); ++q) {
        const mesh::CellNodes& quad = shell.quads[q];
        const std::size_t corners = quad.count;
        const auto at = [&](std::size_t k) { return shell.nodes[index(quad.node[k % corners])]; };
        const Vec3 area = (at(2) - at(0)).cross(at(3) - at(1)) / 2; // in a triangle, at(3) is at(0)
        double least = 1;
        for (std::size_t k = 0; k < corners; ++k) {
            const Vec3 next = at(k + 1) - at(k), last = at(k + corners - 1) - at(k);
            const double sine = next.cross(last).dot(area) / (next.norm() * last.norm() * area.norm());
            least = std::min(least, std::isfinite(sine) ? sine : 0);
        }
        if (!(least > 0))
            throw NotSweepable(Message("sweep.folded_quads", "a quad of {} folds at {}",
                                       entity_of(model, shell.face[q]), place_with_digits(at(0), 4))
                                   .remedy("use a smaller 'size'"));
        shell.min_scaled_jacobian = std::min(shell.min_scaled_jacobian, least);
        sum += least;
        shell.area += area.norm();
    }
    shell.mean_scaled_jacobian = sum / static_cast<double>(std::max<std::size_t>(1, shell.quads.size()));
}

/// Add middle nodes. On an edge they lie halfway between two nodes, elsewhere at the nearest position on the
/// face.
void add_middles(const Model& model, const surface::SourceMesh& source, const surface::Seeds& seeds,
                 bool centres, ShellQuads& shell, const RunContext& context)
{
    std::map<Segment, Index> middle;
    const auto add = [&](const Vec3& place) {
        shell.nodes.push_back(place);
        return static_cast<Index>(shell.nodes.size()) - 1;
    };
    for (const auto& [edge, nodes] : source.on_edge) {
        const std::vector<double> at = seeds.fractions(edge);
        std::vector<double> half;
        for (std::size_t i = 0; i + 1 < at.size(); ++i) half.push_back((at[i] + at[i + 1]) / 2);
        const std::vector<Vec3> places = surface::edge_points(model, edge, half);
        for (std::size_t i = 0; i < places.size(); ++i)
            middle[{std::min(nodes[i], nodes[i + 1]), std::max(nodes[i], nodes[i + 1])}] = add(places[i]);
    }
    std::size_t first = shell.nodes.size();
    for (std::size_t q = 0; q < shell.quads.size(); ++q) {
        mesh::CellNodes& quad = shell.quads[q];
        if (quad.count == 4) {
            Vec3 sum = Vec3::Zero();
            for (std::size_t k = 0; k < 4; ++k) {
                const Index a = quad.node[k], b = quad.node[(k + 1) % 4];
                const auto [found, fresh] = middle.try_emplace({std::min(a, b), std::max(a, b)}, -1);
                if (fresh) found->second = add((shell.nodes[index(a)] + shell.nodes[index(b)]) / 2);
                quad.node[quad.count++] = found->second;
                sum += shell.nodes[index(found->second)] / 2 - shell.nodes[index(a)] / 4;
            }
            if (centres) quad.node[quad.count++] = add(sum);
        }
        if (q + 1 < shell.quads.size() && shell.face[q + 1] == shell.face[q]) continue;
        std::span<Vec3> own = std::span(shell.nodes).subspan(first);
        if (model[shell.face[q]].kind != "plane" && !own.empty()) {
            std::vector<Vec3> places(own.begin(), own.end());
            surface::Projector(model, {shell.face[q]}).project(places, context);
            std::ranges::copy(places, own.begin());
        }
        first = shell.nodes.size();
    }
}

} // namespace

ShellQuads shell_quads(const Model& model, const SweepOptions& options, const RunContext& context)
{
    check(options, context);
    OpenVolume faces;
    faces.model = model;
    faces.role.assign(model.faces.size(), Role::source);
    KnownLinks links(faces);
    SweepOptions one_layer = options;
    one_layer.layers.count = 1;
    const SourceSize sizes = source_size(faces, one_layer, links, context);
    check_cells(sizes.expected, context);
    const surface::Seeds seeds = surface::seed_source(faces, {}, sizes.shape.at, style_of(options, false),
                                                      sizes.sizing, {}, true, {}, context);
    const surface::SourceMesh source = surface::mesh_source(faces, {}, seeds, {sizes.shape.at},
                                                            mesher_of(options, sizes), context);
    ShellQuads shell;
    shell.nodes = source.quads.nodes;
    if (sizes.by_default)
        shell.report.push_back(formatted("size: {:.2g} [model length] by default, {}",
                                         sizes.by_default->length, sizes.by_default->why));
    for (const std::string& note : source.notes) shell.report.push_back(note);
    std::vector<std::size_t> order(source.quads.quads.size()); // order by faces; kept triangles are last
    for (std::size_t q = 0; q < order.size(); ++q) order[q] = q;
    std::ranges::stable_sort(order, {}, [&](std::size_t q) { return source.quads.face[q]; });
    for (const std::size_t q : order) {
        // Quads of a source have normals into the volume.
        const Quad quad = mesh::turned_over(source.quads.quads[q]);
        mesh::CellNodes& own = shell.quads.emplace_back();
        own.count = mesh::corner_count(quad);
        std::copy_n(quad.begin(), own.count, own.node.begin());
        shell.face.emplace_back(source.quads.face[q]);
    }
    measure(model, shell);
    if (options.order > 1)
        add_middles(model, source, seeds, !options.second_order.serendipity, shell, context);
    return shell;
}

} // namespace lacuna::sweep
