// SPDX-License-Identifier: MIT
#include <lacuna/surface/given_target.h>

#include <lacuna/core/edge_key.h>
#include <lacuna/surface/detail/chain_nodes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Quads by their sides; a side has two at most.
class QuadsBySide {
public:
    explicit QuadsBySide(std::span<const Quad> quads) : quads_(quads)
    {
        beside_.reserve(2 * quads.size());
        for (std::size_t q = 0; q < quads.size(); ++q) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (!mesh::is_side(quads[q], k)) continue;
                std::array<Index, 2>& both =
                    beside_.try_emplace(edge_key(quads[q][k], quads[q][(k + 1) % 4]), kNone).first->second;
                both[both[0] < 0 ? 0 : 1] = static_cast<Index>(q);
            }
        }
    }

    /// The quad at a side that is not `other`; -1 where there is none.
    [[nodiscard]] Index beside(Index a, Index b, Index other) const
    {
        const auto found = beside_.find(edge_key(a, b));
        if (found == beside_.end()) return -1;
        return found->second[0] == other ? found->second[1] : found->second[0];
    }

    /// The corners of a quad or triangle from `a` over `b` on.
    [[nodiscard]] Quad from(Index quad, Index a, Index b) const
    {
        const Quad& q = quads_[index(quad)];
        if (mesh::is_triangle(q)) {
            const Index last = *std::find_if(q.begin(), q.end(), [&](Index n) { return n != a && n != b; });
            return {a, b, last, last};
        }
        const auto at = static_cast<std::size_t>(std::find(q.begin(), q.end(), a) - q.begin());
        if (q[(at + 1) % 4] == b) return {a, b, q[(at + 2) % 4], q[(at + 3) % 4]};
        return {a, b, q[(at + 2) % 4], q[(at + 1) % 4]};
    }
    [[nodiscard]] bool is_triangle(Index quad) const { return mesh::is_triangle(quads_[index(quad)]); }

private:
    static constexpr std::array<Index, 2> kNone{-1, -1};
    std::span<const Quad> quads_;
    std::unordered_map<std::uint64_t, std::array<Index, 2>> beside_;
};

/// The target's quads, all faces together.
struct TargetQuads {
    std::vector<Quad> quads;
    std::vector<FaceId> face;
};

std::optional<TargetQuads> quads_of_target(const OpenVolume& volume, std::string& why, bool wedges)
{
    TargetQuads target;
    std::string without;
    for (const FaceId id : volume.faces(Role::target)) {
        const Face& face = volume.model[id];
        if (!face.keeps_nodes || !has_cells_to_keep(face, wedges)) without = name_of(volume.model, id);
        target.quads.insert(target.quads.end(), face.given_quads.begin(), face.given_quads.end());
        if (wedges && face.keeps_nodes) {
            for (const Triangle& t : loose_triangles(face)) target.quads.push_back({t[0], t[1], t[2], t[2]});
        }
        target.face.resize(target.quads.size(), id);
    }
    if (target.quads.empty()) return std::nullopt;
    if (without.empty()) return target;
    why = without + " is not all quads";
    return std::nullopt;
}

/// Model point of the target at a running length of its chain; -1 where there is none.
class TargetPoints {
public:
    TargetPoints(const Model& model, const Chain& chain)
        : points_(chain_nodes(model, chain)), slack_(kSamePlace * chain.length()), length_(chain.length())
    {
    }

    [[nodiscard]] std::size_t count() const { return points_.size(); }
    [[nodiscard]] Index at(double place) const
    {
        if (place >= length_ - slack_) place -= length_;
        const auto next = std::lower_bound(points_.begin(), points_.end(), place - slack_,
                                           [](const ChainNode& node, double at) { return node.at < at; });
        return next != points_.end() && next->at <= place + slack_ ? next->point : -1;
    }

private:
    std::vector<ChainNode> points_;
    double slack_, length_;
};

} // namespace

std::optional<GivenTarget> given_target(const OpenVolume& volume, std::span<const LinkingSurface> links,
                                        const SourceMesh& source, std::string& why, bool wedges)
{
    const Model& model = volume.model;
    why.clear();
    const std::optional<TargetQuads> target = quads_of_target(volume, why, wedges);
    if (!target) return std::nullopt;
    const std::vector<Quad>& quads = source.quads.quads;
    if (quads.size() != target->quads.size()) {
        why = "the source has " + std::to_string(quads.size()) + " quads";
        return std::nullopt;
    }
    std::vector<Index> image(source.quads.nodes.size(), -1);
    for (std::size_t b = 0; b < links.size(); ++b) {
        const TargetPoints points(model, links[b].target);
        const std::vector<double>& at = source.links[b].target_at;
        for (std::size_t i = 0; i < at.size(); ++i) {
            Index& point = image[index(source.first[b]) + i];
            point = points.at(at[i]);
            if (point < 0 || points.count() != at.size()) {
                why = "its rim has other nodes than the source's rim leads to";
                return std::nullopt;
            }
        }
    }

    const QuadsBySide from(quads), to(target->quads);
    std::vector<Index> twin(quads.size(), -1);
    std::vector<char> taken(target->quads.size(), 0);
    struct Step {
        Index a, b, source, target; ///< a side, and the quads it is left from
    };
    std::vector<Step> steps;
    for (std::size_t b = 0; b < links.size(); ++b) {
        const auto n = static_cast<Index>(source.links[b].target_at.size());
        for (Index i = 0; i < n; ++i)
            steps.push_back({source.first[b] + i, source.first[b] + (i + 1) % n, -1, -1});
    }
    std::size_t paired = 0;
    while (!steps.empty()) {
        const Step step = steps.back();
        steps.pop_back();
        const Index q = from.beside(step.a, step.b, step.source);
        const Index t = to.beside(image[index(step.a)], image[index(step.b)], step.target);
        if (q < 0 && t < 0) continue;
        bool same = q >= 0 && t >= 0 && (twin[index(q)] == t || (twin[index(q)] < 0 && taken[index(t)] == 0));
        if (same && twin[index(q)] == t) continue;
        same = same && from.is_triangle(q) == to.is_triangle(t);
        Quad corners{}, images{};
        if (same) {
            corners = from.from(q, step.a, step.b);
            images = to.from(t, image[index(step.a)], image[index(step.b)]);
            for (std::size_t k = 2; k < 4; ++k) {
                Index& known = image[index(corners[k])];
                if (known < 0) known = images[k];
                same = same && known == images[k];
            }
        }
        if (!same) {
            why = "its quads are laid out otherwise than the source's";
            return std::nullopt;
        }
        twin[index(q)] = t;
        taken[index(t)] = 1;
        ++paired;
        for (std::size_t k = 1; k < 4; ++k) {
            if (mesh::is_side(corners, k)) steps.push_back({corners[k], corners[(k + 1) % 4], q, t});
        }
    }
    if (paired != quads.size()) {
        why = "its quads are laid out otherwise than the source's";
        return std::nullopt;
    }
    GivenTarget result;
    for (const Index point : image) result.nodes.push_back(model.at(point));
    for (const Index t : twin) result.face.push_back(target->face[index(t)]);
    return result;
}

} // namespace lacuna::surface
