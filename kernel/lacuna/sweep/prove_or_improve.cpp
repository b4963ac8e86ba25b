// SPDX-License-Identifier: MIT
#include <lacuna/core/number_text.h>
#include <lacuna/sweep/detail/prove_or_improve.h>

#include <lacuna/quality/layered.h>
#include <lacuna/surface/projector.h>
#include <lacuna/sweep/improve.h>

#include <algorithm>
#include <map>
#include <span>
#include <string>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Skin nodes within one face slide on it; those between faces stay, as do those of faces that keep their own
/// quads.
std::vector<Index> sliding_nodes(const mesh::HexMesh& mesh, const std::vector<FaceId>& faces,
                                 const std::set<FaceId>& kept)
{
    constexpr Index kInside = -1, kLocked = -2;
    std::vector<Index> surface(mesh.nodes.size(), kInside);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
        for (const Index n : quad.nodes) {
            Index& at = surface[static_cast<std::size_t>(n)];
            at = at == kInside || at == quad.patch ? quad.patch : kLocked;
            if (kept.contains(faces[static_cast<std::size_t>(quad.patch)])) at = kLocked;
        }
    }
    return surface;
}

/// Projectors made when first asked for.
class FaceProjectors {
public:
    FaceProjectors(const Model& model, std::vector<FaceId> faces, const RunContext& context)
        : model_(model), faces_(std::move(faces)), context_(context)
    {
    }

    void project(Index patch, std::span<Vec3> points)
    {
        const FaceId face = faces_[static_cast<std::size_t>(patch)];
        projector_.try_emplace(patch, model_, std::vector<FaceId>{face})
            .first->second.project(points, context_);
    }

private:
    const Model& model_;
    std::vector<FaceId> faces_;
    const RunContext& context_;
    std::map<Index, surface::Projector> projector_;
};

std::string in_words(const Improved& improved)
{
    const auto value = [](double jacobian) { return with_decimals(jacobian, 3); };
    return std::string(improved.untangled ? "untangled: " : "improved: ") + std::to_string(improved.cells) +
           " cells, " + std::to_string(improved.moved) + " nodes, least scaled Jacobian " +
           value(improved.before) + " before, " + value(improved.after) + " after, mean " +
           value(improved.mean_before) + " and " + value(improved.mean_after) +
           (improved.unfinished ? "; ended before it was done: improve = { seconds = … } gives it more" : "");
}

} // namespace

quality::Proof prove_or_improve(Swept& swept, const topology::Model& model, const std::vector<FaceId>& faces,
                                const std::set<FaceId>& kept, std::vector<char> held,
                                std::optional<quality::Quality> measured, const SweepOptions& options,
                                const RunContext& context)
{
    ImproveOptions improving = options.improving;
    improving.good_enough = std::max(improving.good_enough, options.min_scaled_jacobian);
    quality::Proof proof = quality::prove(swept.mesh, std::move(measured), options.min_scaled_jacobian,
                                          context);
    const bool poor = proof.finding ? quality::can_be_improved(proof.finding->fault)
                                    : proof.quality.min_scaled_jacobian < improving.good_enough;
    if (!options.improve || !poor) return proof;
    FaceProjectors projectors(model, faces, context);
    const Sliding sliding{sliding_nodes(swept.mesh, faces, kept),
                          [&](Index patch, std::span<Vec3> points) { projectors.project(patch, points); },
                          std::move(held)};
    const Improved improved = improve(swept.mesh, improving, sliding, context);
    if (improved.won || improved.unfinished) swept.report.push_back(in_words(improved));
    proof = quality::prove(swept.mesh, options.min_scaled_jacobian, context);
    if (proof.finding && quality::can_be_improved(proof.finding->fault))
        proof.finding->message += "\n" + in_words(improved);
    return proof;
}

} // namespace lacuna::sweep
