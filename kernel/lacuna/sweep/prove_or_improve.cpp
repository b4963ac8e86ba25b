// SPDX-License-Identifier: MIT
#include <lacuna/core/message.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/sweep/detail/prove_or_improve.h>

#include <lacuna/quality/shared/layered.h>
#include <lacuna/surface/shared/projector.h>
#include <lacuna/sweep/detail/shares.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/sweep/improve.h>

#include <algorithm>
#include <map>
#include <span>
#include <string>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// For each node, the surface on which it may slide. Nodes of the skin inside a face slide on that face.
/// Nodes between faces, and nodes of faces with given quads, are fixed.
std::vector<Index> sliding_nodes(const mesh::HexMesh& mesh, const std::vector<FaceId>& faces,
                                 const std::set<FaceId>& kept)
{
    constexpr Index kInside = -1, kLocked = -2;
    std::vector<Index> surface(mesh.nodes.size(), kInside);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
        for (const Index n : quad.nodes) {
            Index& at = surface[index(n)];
            const bool may = (at == kInside || at == quad.patch) && !kept.contains(faces[index(quad.patch)]);
            at = may ? quad.patch : kLocked;
        }
    }
    return surface;
}

/// The edge that leads from a vertex towards a point; invalid if there is no such edge.
EdgeId edge_towards(const Model& model, VertexId vertex, const Vec3& to)
{
    const Vec3 way = (to - model.at(model[vertex].point)).stableNormalized();
    EdgeId nearest;
    double most = 0;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const Edge& edge = model.edges[e];
        for (const bool forward : {true, false}) {
            if ((forward ? edge.from : edge.to) != vertex) continue;
            const Index next = forward ? edge.points[1] : edge.points[edge.points.size() - 2];
            const double along = (model.at(next) - model.at(model[vertex].point)).stableNormalized().dot(way);
            if (along <= most) continue;
            most = along;
            nearest = EdgeId(e);
        }
    }
    return nearest;
}

/// Describe why a cell has no volume, and suggest a remedy.
Message in_words(const std::string& code, const StuckCorner& stuck, const mesh::HexMesh& mesh,
                 const Model& model)
{
    const auto at = [&](Index node) { return mesh.nodes[index(node)]; };
    Argument corner = place_in_short(at(stuck.node)), sides = "two sides of a cell";
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
        if ((model.at(model.vertices[v].point) - at(stuck.node)).norm() > model.tolerance) continue;
        const EdgeId a = edge_towards(model, VertexId(v), at(stuck.to[0])),
                     b = edge_towards(model, VertexId(v), at(stuck.to[1]));
        if (!a.valid() || !b.valid() || a == b) continue;
        corner = entity_of(model, VertexId(v));
        sides = std::vector{entity_of(model, a), entity_of(model, b)};
        break;
    }
    return Message(
               code,
               "at {}, {} lie in one line: a cell with both at one corner has no volume, whatever its other "
               "nodes are",
               corner, sides)
        .remedy("name other faces as source and target, or cut the volume there");
}

} // namespace

std::string in_words(const Improved& improved)
{
    return formatted(
        "{}: {} cells, {} nodes, least scaled Jacobian {:.3f} before, {:.3f} after, mean {:.3f} and "
        "{:.3f}{}",
        improved.untangled ? "untangled" : "improved", improved.cells, improved.moved, improved.before,
        improved.after, improved.mean_before, improved.mean_after,
        improved.unfinished ? "; stopped by the limit of work, or by improve = { seconds = … }" : "");
}

quality::Proof prove_or_improve(Swept& swept, const topology::Model& model, const std::vector<FaceId>& faces,
                                const std::set<FaceId>& kept, std::vector<char> held,
                                const SweepOptions& options, const RunContext& context)
{
    ImproveOptions improving = options.improving;
    improving.good_enough = std::max(improving.good_enough, options.min_scaled_jacobian);
    quality::Proof proof = quality::prove(swept.mesh, options.min_scaled_jacobian, context);
    const bool poor = proof.finding ? quality::can_be_improved(proof.finding->fault)
                                    : proof.quality.min_scaled_jacobian < improving.good_enough;
    if (!options.improve || !poor) return proof;
    std::map<Index, surface::Projector> projectors; // created on first use
    const auto project = [&](Index patch, std::span<Vec3> points) {
        projectors.try_emplace(patch, model, std::vector<FaceId>{faces[index(patch)]})
            .first->second.project(points, context);
    };
    const Sliding sliding{sliding_nodes(swept.mesh, faces, kept), project, {}, std::move(held)};
    const RunContext part = part_of(context, share::improving, share::order_2);
    Improved improved = improve(std::move(swept.mesh), improving, sliding, part);
    swept.mesh = std::move(improved.mesh);
    report_progress(context, "proof of every cell", share::order_2);
    if (improved.stuck) {
        if (proof.finding) {
            Message& message = proof.finding->message;
            message = in_words(message.code(), *improved.stuck, swept.mesh, model);
        }
        return proof;
    }
    if (improved.won || improved.unfinished) swept.report.push_back(in_words(improved));
    proof = quality::prove(swept.mesh, options.min_scaled_jacobian, context);
    if (proof.finding && quality::can_be_improved(proof.finding->fault)) {
        Message& message = proof.finding->message;
        message = message.attempt({message.code(), "{}", in_words(improved)});
    }
    return proof;
}

} // namespace lacuna::sweep
