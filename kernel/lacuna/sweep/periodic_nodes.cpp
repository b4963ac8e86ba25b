// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/periodic_nodes.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/sweep/detail/assembly_nodes.h>
#include <lacuna/sweep/detail/shared_faces.h>
#include <lacuna/topology/shared/give_mesh.h>

#include <algorithm>
#include <map>
#include <optional>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// The given quads of a face. Empty if the face does not keep them.
std::optional<FaceMesh> given_mesh(const Model& model, FaceId face)
{
    if (!model[face].keeps_nodes || model[face].given_quads.empty()) return std::nullopt;
    FaceMesh mesh{quads_alone(model[face].given_quads), {}};
    for (const Index n : mesh.nodes) mesh.places.push_back(model.at(n));
    return mesh;
}

/// The length of the shortest side of some quads.
double shortest_side(const FaceMesh& mesh)
{
    double least = kInfinity;
    for (const Quad& quad : mesh.quads)
        for (std::size_t k = 0; k < 4; ++k)
            if (const Index a = quad[k], b = quad[(k + 1) % 4]; a != b)
                least = std::min(least, (mesh.places[index(a)] - mesh.places[index(b)]).norm());
    return least;
}

[[noreturn]] void refuse_images(const ImagesOf& all, const PeriodicFaces& pair, bool given)
{
    const NamedEntity a = entity_in(all.members[pair.a], pair.face_a),
                      b = entity_in(all.members[pair.b], pair.face_b);
    if (given)
        throw InvalidInput(Message("sweep.periodic_given",
                                   "periodic: the given meshes of {} and {} differ, and given nodes do "
                                   "not move",
                                   a, b)
                               .remedy("load one of them with keep_mesh = false"));
    throw NotSweepable(
        Message("sweep.periodic_unlike", "periodic: the quads on {} and {} are not connected alike", a, b)
            .remedy("make both of them walls, or source and target, or use quads = "
                    "\"mapped\""));
}

/// All nodes of a part on a face, including middle nodes.
std::vector<Index> nodes_on(const Swept& part, FaceId face)
{
    std::set<Index> nodes;
    for (std::size_t i = 0; i < part.mesh.skin_count(); ++i)
        if (part.faces[index(mesh::skin_quad(part.mesh, i).patch)] == face) {
            const mesh::CellNodes own = mesh::skin_nodes(part.mesh, i);
            nodes.insert(own.all().begin(), own.all().end());
        }
    return {nodes.begin(), nodes.end()};
}

} // namespace

void give_to_images(const ImagesOf& all, std::size_t m, OpenVolume& volume, std::set<FaceId>& fixed)
{
    for (const PeriodicFaces& pair : all.faces) {
        for (const auto& [of, member] : {std::pair(pair.face_a, pair.a), std::pair(pair.face_b, pair.b)})
            if (member == m && given_mesh(volume.model, of)) fixed.insert(of);
        if (pair.a != m || pair.b != m || fixed.contains(pair.face_a) == fixed.contains(pair.face_b))
            continue;
        const bool forth = fixed.contains(pair.face_a);
        const auto [from, to] = forth ? std::pair(pair.face_a, pair.face_b)
                                      : std::pair(pair.face_b, pair.face_a);
        const Eigen::Isometry3d onto = forth ? pair.onto : pair.onto.inverse();
        std::optional<FaceMesh> mesh = given_mesh(volume.model, from);
        if (!mesh) continue;
        for (Vec3& p : mesh->places) p = onto * p;
        give_mesh(volume, to, mesh->places, mesh->quads);
        fixed.insert(to);
    }
}

SettledNodes tie_images(const ImagesOf& all, std::size_t m, const std::set<FaceId>& fixed,
                        const mesh::SkinNodes& skin, const std::vector<FaceId>& faces)
{
    SettledNodes settled;
    const double tolerance = all.members[m].volume->model.tolerance;
    std::map<Index, std::size_t> number;
    std::vector<Index> nodes;
    std::vector<Vec3> places;
    std::vector<char> is_fixed;
    std::vector<Tie> ties;
    const auto add = [&](Index node) {
        const auto [found, fresh] = number.try_emplace(node, nodes.size());
        if (fresh) nodes.push_back(node), places.push_back(skin[node]), is_fixed.push_back(0);
        return found->second;
    };
    const Eigen::Isometry3d itself = Eigen::Isometry3d::Identity();
    for (const PeriodicFaces& pair : all.faces) {
        for (const auto& [of, member] : {std::pair(pair.face_a, pair.a), std::pair(pair.face_b, pair.b)}) {
            if (member != m) continue;
            settled.faces.insert(of);
            for (const Quad& quad : quads_on(skin.mesh, faces, of))
                for (const Index node : quad) {
                    const std::size_t n = add(node);
                    if (fixed.contains(of)) is_fixed[n] = 1;
                    if (is_translation(pair.onto)) ties.push_back({n, n, &itself});
                }
        }
        if (pair.a != m || pair.b != m) continue;
        FaceMesh from = face_mesh(skin, quads_on(skin.mesh, faces, pair.face_a));
        const FaceMesh to = face_mesh(skin, quads_on(skin.mesh, faces, pair.face_b));
        for (Vec3& p : from.places) p = pair.onto * p;
        const bool both = fixed.contains(pair.face_a) && fixed.contains(pair.face_b);
        const auto same = same_quads(
            from, to, both ? tolerance : kOnePoint * std::min(shortest_side(from), shortest_side(to)));
        if (!same) refuse_images(all, pair, both);
        for (const NodePair& nodes_of : *same)
            ties.push_back({add(nodes_of.own), add(nodes_of.other), &pair.onto});
    }
    tie_points(places, is_fixed, ties, all.grid);
    for (std::size_t n = 0; n < nodes.size(); ++n) settled.nodes.emplace_back(nodes[n], places[n]);
    return settled;
}

void pair_nodes(const ImagesOf& all, SweptAssembly& result, const RunContext& context)
{
    for (const PeriodicFaces& pair : all.faces) {
        if (result.periodic.size() <= pair.pair) result.periodic.resize(pair.pair + 1);
        mesh::PeriodicNodes& found = result.periodic[pair.pair];
        found.onto = pair.onto;
        Swept &part_a = result.parts[pair.a], &part_b = result.parts[pair.b];
        const std::vector<Index> from = nodes_on(part_a, pair.face_a), to = nodes_on(part_b, pair.face_b);
        std::vector<Vec3> moved, places;
        for (const Index n : from) moved.push_back(pair.onto * part_a.skin()[n]);
        for (const Index n : to) places.push_back(part_b.skin()[n]);
        const FaceMesh corners = face_mesh(part_a.skin(), quads_on(part_a.mesh, part_a.faces, pair.face_a));
        // The allowed distance is not zero: nodes given for the two faces may differ by the tolerance,
        // and middle nodes by the sag of the facets.
        const std::vector<Index> twin = same_places(moved, places, kOnePoint / 4 * shortest_side(corners));
        if (twin.empty()) refuse_images(all, pair, false);
        bool changed = false;
        for (std::size_t n = 0; n < from.size(); ++n) {
            const Index other = to[index(twin[n])];
            found.pairs.push_back({result.numbering[pair.a].of(from[n]), result.numbering[pair.b].of(other)});
            const std::size_t corner_count = mesh::corner_count(part_b.mesh);
            if (index(other) < corner_count || part_b.skin()[other] == moved[n]) continue;
            part_b.mesh.middles.nodes[index(other) - corner_count] = moved[n];
            changed = true;
        }
        std::ranges::sort(found.pairs);
        const auto again = std::ranges::unique(found.pairs);
        found.pairs.erase(again.begin(), again.end());
        if (changed)
            quality::require(
                quality::prove(part_b.mesh, all.members[pair.b].options.min_scaled_jacobian, context));
    }
    for (const mesh::PeriodicNodes& pair : result.periodic)
        result.report.push_back(formatted("periodic: {} pairs of nodes", pair.pairs.size()));
}

} // namespace lacuna::sweep
