// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/given_target.h>

#include <lacuna/core/message.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/shared/point_tree.h>
#include <lacuna/surface/detail/chain_nodes.h>

#include <algorithm>
#include <array>
#include <unordered_map>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Finds quads by their sides. A side has at most two quads.
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

    /// The quad on a side that is not `other`; -1 if there is none.
    [[nodiscard]] Index beside(Index a, Index b, Index other) const
    {
        const auto found = beside_.find(edge_key(a, b));
        if (found == beside_.end()) return -1;
        return found->second[0] == other ? found->second[1] : found->second[0];
    }

    /// The corners of a quad or triangle, starting with the side from `a` to `b`.
    [[nodiscard]] Quad from(Index quad, Index a, Index b) const
    {
        const Quad& q = quads_[index(quad)];
        if (mesh::is_triangle(q)) {
            const Index last = *std::ranges::find_if(q, [&](Index n) { return n != a && n != b; });
            return {a, b, last, last};
        }
        const auto at = static_cast<std::size_t>(std::ranges::find(q, a) - q.begin());
        if (q[(at + 1) % 4] == b) return {a, b, q[(at + 2) % 4], q[(at + 3) % 4]};
        return {a, b, q[(at + 2) % 4], q[(at + 1) % 4]};
    }

    [[nodiscard]] bool is_triangle(Index quad) const { return mesh::is_triangle(quads_[index(quad)]); }

private:
    static constexpr std::array<Index, 2> kNone{-1, -1};
    std::span<const Quad> quads_;
    std::unordered_map<std::uint64_t, std::array<Index, 2>> beside_;
};

/// The quads of an end, all faces together.
struct EndQuads {
    std::vector<Quad> quads;
    std::vector<FaceId> face;
};

std::optional<EndQuads> quads_of(const OpenVolume& volume, Role end, std::string& why, bool wedges)
{
    EndQuads target;
    FaceId without;
    for (const FaceId id : volume.faces(end)) {
        const Face& face = volume.model[id];
        if (!face.keeps_nodes || !has_cells_to_keep(face, wedges)) without = id;
        target.quads.insert(target.quads.end(), face.given_quads.begin(), face.given_quads.end());
        if (wedges && face.keeps_nodes) {
            for (const Triangle& t : loose_triangles(face)) target.quads.push_back({t[0], t[1], t[2], t[2]});
        }
        target.face.resize(target.quads.size(), id);
    }
    if (target.quads.empty()) return std::nullopt;
    if (!without.valid()) return target;
    why = formatted("{} has cells other than quads", entity_of(volume.model, without));
    return std::nullopt;
}

/// Pair the quads of two meshes with the same connectivity, starting from sides of the first mesh.
/// @param image  for each node of the first mesh, the corresponding node of the second mesh. The caller sets
///         it for the nodes of `sides`, and the function sets it for all other nodes.
/// @return  for each quad of the first mesh, the corresponding quad of the second mesh. Empty if the
///         connectivity differs, or if some quads are not reached.
std::optional<std::vector<Index>> paired_quads(std::span<const Quad> all_from, std::span<const Quad> all_to,
                                               std::vector<Index>& image, std::span<const Segment> sides)
{
    const QuadsBySide from(all_from), to(all_to);
    std::vector<Index> twin(all_from.size(), -1);
    std::vector<char> taken(all_to.size(), 0);
    struct Step {
        Index a, b, source, target; ///< a side, and the source and target quads already visited next to it
    };
    std::vector<Step> steps;
    for (const Segment& side : sides) steps.push_back({side[0], side[1], -1, -1});
    std::size_t paired = 0;
    while (!steps.empty()) {
        const Step step = steps.back();
        steps.pop_back();
        const Index q = from.beside(step.a, step.b, step.source);
        const Index t = to.beside(image[index(step.a)], image[index(step.b)], step.target);
        if (q < 0 && t < 0) continue;
        bool same = q >= 0 && t >= 0 && (twin[index(q)] == t || (twin[index(q)] < 0 && taken[index(t)] == 0));
        if (same && twin[index(q)] == t) continue;
        if (!same || from.is_triangle(q) != to.is_triangle(t)) return std::nullopt;
        const Quad corners = from.from(q, step.a, step.b);
        const Quad images = to.from(t, image[index(step.a)], image[index(step.b)]);
        for (std::size_t k = 2; k < 4; ++k) {
            Index& known = image[index(corners[k])];
            if (known < 0) known = images[k];
            if (known != images[k]) return std::nullopt;
        }
        twin[index(q)] = t;
        taken[index(t)] = 1;
        ++paired;
        for (std::size_t k = 1; k < 4; ++k) {
            if (mesh::is_side(corners, k)) steps.push_back({corners[k], corners[(k + 1) % 4], q, t});
        }
    }
    if (paired != all_from.size()) return std::nullopt;
    return twin;
}

/// A node of the source's chain and the corresponding node of the target's chain, at a column or a side line.
/// Both are -1 if there is no such pair.
std::pair<Index, Index> first_pair(const Model& model, const LinkingSurface& link,
                                   const GivenColumns& columns)
{
    const bool has_columns = columns.rows > 0;
    const Index low = node_at(chain_nodes(model, link.source), link.source,
                              has_columns ? columns.whole.front().source_at : link.lines.front().source_at);
    const Index high = node_at(chain_nodes(model, link.target), link.target,
                               has_columns ? columns.whole.front().target_at : link.lines.front().target_at);
    return high < 0 ? std::pair{high, high} : std::pair{low, high};
}

} // namespace

GivenTarget given_target(const OpenVolume& volume, std::span<const LinkingSurface> links,
                         const SourceMesh& source, bool wedges)
{
    const Model& model = volume.model;
    GivenTarget result;
    const std::optional<EndQuads> target = quads_of(volume, Role::target, result.why, wedges);
    if (!target) return result;
    const std::vector<Quad>& quads = source.quads.quads;
    if (quads.size() != target->quads.size())
        return {.why = formatted("the source has {} quads", quads.size())};
    std::vector<Index> image(source.quads.nodes.size(), -1);
    std::vector<Segment> sides;
    for (std::size_t b = 0; b < links.size(); ++b) {
        const std::vector<ChainNode> nodes = chain_nodes(model, links[b].target);
        const std::vector<double>& at = source.links[b].target_at;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const Index node = node_at(nodes, links[b].target, at[i]);
            if (node < 0 || nodes.size() != at.size())
                return {.why = "its rim nodes do not match the source's"};
            image[index(source.first[b]) + i] = nodes[index(node)].point;
        }
        const auto n = static_cast<Index>(at.size());
        for (Index i = 0; i < n; ++i) sides.push_back({source.first[b] + i, source.first[b] + (i + 1) % n});
    }
    const std::optional<std::vector<Index>> twin = paired_quads(quads, target->quads, image, sides);
    if (!twin) return {.why = "its quads are connected differently from the source's"};
    for (const Index point : image) result.nodes.push_back(model.at(point));
    for (const Index t : *twin) result.face.push_back(target->face[index(t)]);
    return result;
}

std::vector<Vec3> given_part(const Model& model, FaceId face, const std::vector<Quad>& quads,
                             std::span<const std::optional<Vec3>> places)
{
    const std::vector<Quad>& given = model[face].given_quads;
    if (!model[face].keeps_nodes || given.size() != quads.size()) return {};
    std::vector<Index> rim;
    for (const mesh::BoundarySide& side : mesh::boundary_sides(given)) rim.push_back(side.from);
    const geometry::FacetTree tree = geometry::point_tree(places_at(model, rim));
    std::vector<Index> image(places.size(), -1);
    std::vector<Segment> sides;
    for (const mesh::BoundarySide& side : mesh::boundary_sides(quads)) {
        const auto hit = tree.closest(*places[index(side.from)], model.tolerance * model.tolerance);
        if (hit.triangle < 0) return {};
        image[index(side.from)] = rim[index(hit.triangle)];
        sides.push_back({side.from, side.to});
    }
    if (!paired_quads(quads, given, image, sides)) return {};
    return places_at(model, image);
}

std::vector<LinkingSurface> align_alike_ends(const OpenVolume& volume, std::span<const GivenColumns> columns,
                                             std::vector<LinkingSurface> links, bool wedges)
{
    // Columns and side lines determine the rotation of a loop (`sure`). The rotation of the other loops
    // follows from the pairing of the quads, which starts at a loop with a determined rotation.
    std::vector<std::size_t> unsure;
    const LinkingSurface* sure = nullptr;
    for (std::size_t b = 0; b < links.size(); ++b) {
        if (links[b].lines.empty() && columns[b].rows == 0)
            unsure.push_back(b);
        else if (sure == nullptr)
            sure = &links[b];
    }
    std::string why;
    if (sure == nullptr || unsure.empty()) return links;
    const std::optional<EndQuads> source = quads_of(volume, Role::source, why, wedges);
    const std::optional<EndQuads> target = quads_of(volume, Role::target, why, wedges);
    if (!source || !target || source->quads.size() != target->quads.size()) return links;

    const Model& model = volume.model;
    const auto [low, high] = first_pair(model, *sure, columns[static_cast<std::size_t>(sure - links.data())]);
    const std::vector<ChainNode> below = chain_nodes(model, sure->source),
                                 above = chain_nodes(model, sure->target);
    if (low < 0 || below.size() != above.size()) return links;
    std::vector<Index> image(model.points.size(), -1);
    std::vector<Segment> sides;
    const std::size_t n = below.size();
    for (std::size_t i = 0; i < n; ++i) {
        const ChainNode& a = below[(static_cast<std::size_t>(low) + i) % n];
        image[index(a.point)] = above[(static_cast<std::size_t>(high) + i) % n].point;
        sides.push_back({a.point, below[(static_cast<std::size_t>(low) + i + 1) % n].point});
    }
    if (!paired_quads(source->quads, target->quads, image, sides)) return links;
    for (const std::size_t b : unsure) {
        LinkingSurface& link = links[b];
        const Index start = image[index(chain_nodes(model, link.source).front().point)];
        for (const ChainNode& node : chain_nodes(model, link.target)) {
            if (node.point != start) continue;
            const double move = node.at - link.segments.front().target_from;
            for (RimSegment& segment : link.segments) {
                segment.target_from += move;
                segment.target_to += move;
            }
        }
    }
    return links;
}

} // namespace lacuna::surface
