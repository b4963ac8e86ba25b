// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/morph_ends.h>

#include <lacuna/core/error.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/given_target.h>
#include <lacuna/surface/shared/projector.h>
#include <lacuna/sweep/detail/shared_quads.h>
#include <lacuna/sweep/detail/surface_smoothing.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Points of an image: the nodes of the target edge if it keeps as many, else points at shares of its length.
std::vector<Vec3> image_points(const Model& model, const surface::EdgeImage& image, std::vector<double> at)
{
    const Edge& target = model[image.target];
    const bool along = image.from == 0 && image.to == 1, against = image.from == 1 && image.to == 0;
    if (target.keeps_nodes && target.points.size() == at.size() && (along || against))
        return use_places(model, {image.target, against});
    for (double& f : at) {
        f = image.from + f * (image.to - image.from);
        if (f < 0 || f > 1) f -= std::floor(f); // the position lies past the start of a closed edge
    }
    return surface::edge_points(model, image.target, at);
}

/// Target positions of the source nodes on the rim and on imprinted edges; empty for other nodes. They are
/// known before any face is filled.
std::vector<std::optional<Vec3>> known_places(const surface::SourceMesh& source, const RimColumns& columns,
                                              const surface::Seeds& seeds, const surface::Imprint& imprint)
{
    std::vector<std::optional<Vec3>> places(source.quads.nodes.size());
    for (const auto& [edge, image] : imprint.images) {
        const auto found = source.on_edge.find(edge);
        if (found == source.on_edge.end()) continue; // given quads do not follow the edge
        const std::vector<Index>& nodes = found->second;
        const std::vector<double> at = seeds.fractions(edge);
        const std::vector<Vec3> points = image_points(imprint.volume->model, image, at);
        for (std::size_t i = 0; i < nodes.size(); ++i) places[index(nodes[i])] = points[i];
    }
    const std::span<const Vec3> high = columns.row(columns.layers);
    for (std::size_t k = 0; k < high.size(); ++k) places[index(columns.rim[k])] = high[k];
    return places;
}

/// The quads on one target face as a separate mesh.
struct Part {
    mesh::QuadMesh mesh;
    std::vector<Index> node;                 ///< for each node, its number in the whole mesh
    std::vector<std::optional<Vec3>> places; ///< for each node, its position on the target if it is known
    RimColumns columns;                      ///< columns of one layer over the rim of the part
};

Part part_of(const mesh::QuadMesh& whole, const std::vector<Quad>& quads,
             const std::vector<std::optional<Vec3>>& places)
{
    QuadsAlone alone = quads_alone(quads);
    Part part;
    part.mesh.quads = std::move(alone.quads);
    part.node = std::move(alone.nodes);
    part.columns.layers = 1;
    for (const Index node : part.node) {
        part.mesh.nodes.push_back(whole.nodes[index(node)]);
        part.places.push_back(places[index(node)]);
    }
    std::set<Index> rim;
    for (const mesh::BoundarySide& side : mesh::boundary_sides(part.mesh.quads))
        rim.insert({side.from, side.to});
    part.columns.rim.assign(rim.begin(), rim.end());
    for (const Index node : rim) part.columns.points.push_back(part.mesh.nodes[index(node)]);
    for (const Index node : rim) {
        const std::optional<Vec3>& place = part.places[index(node)];
        if (!place) {
            throw NotSweepable(Message("sweep.imprint_torn",
                                       "nodes between faces of the target have no counterpart on the edges "
                                       "that were imprinted on the source")
                                   .remedy("merge these faces of the target in the CAD system"));
        }
        part.columns.points.push_back(*place);
    }
    return part;
}

} // namespace

EndFaces end_faces(const OpenVolume& volume, const surface::SourceMesh& source,
                   const std::optional<surface::Imprint>& imprint, bool moved)
{
    EndFaces faces;
    const std::vector<FaceId> targets = volume.faces(Role::target);
    const FaceId only = targets.front();
    if (moved) {
        std::map<FaceId, FaceId> image;
        const std::vector<FaceId> sources = volume.faces(Role::source);
        for (std::size_t f = 0; f < sources.size(); ++f) image[sources[f]] = targets[f];
        for (const Index face : source.quads.face) {
            faces.source.emplace_back(face);
            faces.target.push_back(image.at(FaceId(face)));
        }
        return faces;
    }
    for (const Index face : source.quads.face) {
        const FaceId part(face);
        faces.source.push_back(imprint ? imprint->source_of[part.index()] : part);
        faces.target.push_back(imprint ? imprint->target_of[part.index()] : only);
    }
    return faces;
}

Morphed moved_by(const geometry::Motion& motion, const surface::SourceMesh& source, const RimColumns& columns)
{
    Morphed result;
    for (const Vec3& node : source.quads.nodes) result.nodes.push_back(motion.place(node, 1));
    const std::span<const Vec3> high = columns.row(columns.layers);
    for (std::size_t k = 0; k < high.size(); ++k) result.nodes[index(columns.rim[k])] = high[k];
    result.report = "the source moved along the path";
    return result;
}

Morphed morph_onto(const OpenVolume& volume, const surface::SourceMesh& source, const RimColumns& columns,
                   const RunContext& context)
{
    const surface::Projector target(volume.model, volume.faces(Role::target));
    return morph(
        source.quads, columns, [&](std::span<Vec3> points) { target.project(points, context); }, context,
        source.rows);
}

Morphed morph_onto_faces(const surface::SourceMesh& source, const RimColumns& columns,
                         const surface::Seeds& seeds, const surface::Imprint& imprint,
                         const std::vector<FaceId>& face, const RunContext& context)
{
    const std::vector<std::optional<Vec3>> places = known_places(source, columns, seeds, imprint);
    std::map<FaceId, std::vector<Quad>> quads;
    for (std::size_t q = 0; q < face.size(); ++q) quads[face[q]].push_back(source.quads.quads[q]);
    Morphed result;
    result.nodes.resize(source.quads.nodes.size());
    for (const auto& [target, over] : quads) {
        const Part part = part_of(source.quads, over, places);
        const Model& model = imprint.volume->model;
        if (const auto given = surface::given_part(model, target, part.mesh.quads, part.places);
            !given.empty()) {
            for (std::size_t i = 0; i < part.node.size(); ++i) result.nodes[index(part.node[i])] = given[i];
            continue;
        }
        const surface::Projector projector(model, {target});
        const Morphed piece = morph(
            part.mesh, part.columns, [&](std::span<Vec3> points) { projector.project(points, context); },
            context);
        for (std::size_t i = 0; i < part.node.size(); ++i) result.nodes[index(part.node[i])] = piece.nodes[i];
        result.worst = std::min(result.worst, piece.worst);
        result.worst_source = std::min(result.worst_source, piece.worst_source);
    }
    result.report = formatted("{} faces, {} edges between them imprinted on the source; worst quad {:.2g} "
                              "(source {:.2g})",
                              quads.size(), imprint.images.size(), result.worst, result.worst_source);
    return result;
}

} // namespace lacuna::sweep
