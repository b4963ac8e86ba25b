// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/sweep/detail/shared_quads.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace lacuna::sweep {

namespace {

/// The positions projected onto an oblique line, in increasing order, each with its index.
std::vector<std::pair<double, Index>> along_line(std::span<const Vec3> places)
{
    // Rows of a mesh are unlikely to have this direction.
    const Vec3 slanted = Vec3(1, 0.6180339887498949, 0.2720196495140690).normalized();
    std::vector<std::pair<double, Index>> line;
    for (const Vec3& p : places) line.emplace_back(slanted.dot(p), static_cast<Index>(line.size()));
    std::ranges::sort(line);
    return line;
}

/// Sort the nodes of each quad, and then the quads.
std::vector<Quad> sorted(std::vector<Quad> quads)
{
    for (Quad& quad : quads) std::ranges::sort(quad);
    std::ranges::sort(quads);
    return quads;
}

} // namespace

std::vector<Quad> quads_on(const mesh::HexMesh& mesh, std::span<const FaceId> faces, FaceId face)
{
    std::vector<Quad> quads;
    const auto add = [&](const std::vector<Index>& patches, std::size_t first) {
        for (std::size_t i = 0; i < patches.size(); ++i) {
            if (faces[index(patches[i])] == face) quads.push_back(mesh::skin_quad(mesh, first + i).nodes);
        }
    };
    add(mesh.source_patch, 0);
    add(mesh.target_patch, mesh.quads.size());
    add(mesh.wall_patch, 2 * mesh.quads.size());
    return quads;
}

std::vector<Index> same_places(std::span<const Vec3> a, std::span<const Vec3> b, double within)
{
    if (a.size() != b.size() || a.empty()) return {};
    const std::vector<std::pair<double, Index>> line_a = along_line(a), line_b = along_line(b);
    std::vector<Index> twin(a.size(), -1);
    std::vector<char> used(b.size(), 0);
    std::size_t first = 0;
    // The slack includes the rounding of positions along the line.
    const double slack = within +
                         1e-15 * std::max(std::abs(line_a.front().first), std::abs(line_a.back().first));
    for (const auto& [at, place] : line_a) {
        while (first < line_b.size() && line_b[first].first < at - slack) ++first;
        const Vec3& p = a[index(place)];
        for (std::size_t i = first; i < line_b.size() && line_b[i].first <= at + slack; ++i) {
            const Index candidate = line_b[i].second;
            const Vec3& q = b[index(candidate)];
            const bool same = within > 0 ? (p - q).squaredNorm() <= within * within : p == q;
            if (!same || used[index(candidate)] != 0) continue;
            used[index(candidate)] = 1;
            twin[index(place)] = candidate;
            break;
        }
        if (twin[index(place)] < 0) return {};
    }
    return twin;
}

FaceMesh face_mesh(const mesh::SkinNodes& skin, std::span<const Quad> quads)
{
    FaceMesh mesh{quads_alone({quads.begin(), quads.end()}), {}};
    for (const Index n : mesh.nodes) mesh.places.push_back(skin[n]);
    return mesh;
}

std::optional<std::vector<NodePair>> same_quads(FaceMesh own, const FaceMesh& other, double within)
{
    const std::vector<Index> twin = same_places(own.places, other.places, within);
    if (twin.empty()) return std::nullopt;
    for (Quad& quad : own.quads)
        for (Index& n : quad) n = twin[index(n)];
    if (sorted(std::move(own.quads)) != sorted(other.quads)) return std::nullopt;
    std::vector<NodePair> pairs;
    pairs.reserve(twin.size());
    for (std::size_t n = 0; n < twin.size(); ++n)
        pairs.push_back({own.nodes[n], other.nodes[index(twin[n])]});
    return pairs;
}

QuadsAlone quads_alone(std::vector<Quad> quads)
{
    QuadsAlone alone{std::move(quads), {}};
    std::unordered_map<Index, Index> number;
    for (Quad& quad : alone.quads) {
        for (Index& n : quad) {
            const auto [own, fresh] = number.try_emplace(n, static_cast<Index>(alone.nodes.size()));
            if (fresh) alone.nodes.push_back(n);
            n = own->second;
        }
    }
    return alone;
}

std::vector<Segment> patch_borders(const mesh::HexMesh& mesh)
{
    std::vector<Segment> borders;
    const auto add = [&](Index a, Index b) { borders.push_back({std::min(a, b), std::max(a, b)}); };
    const auto layers = static_cast<std::size_t>(mesh.layers);
    const std::size_t sides = mesh.rim.size();
    const Index top = mesh.layers * mesh.nodes_per_layer;
    std::vector<std::size_t> side_from(index(mesh.nodes_per_layer), sides);
    for (std::size_t r = 0; r < sides; ++r) {
        add(mesh.rim[r][0], mesh.rim[r][1]);
        add(top + mesh.rim[r][0], top + mesh.rim[r][1]);
        side_from[index(mesh.rim[r][0])] = r;
    }
    for (std::size_t l = 0; l < layers; ++l) {
        const Index low = static_cast<Index>(l) * mesh.nodes_per_layer;
        for (std::size_t r = 0; r < sides; ++r) {
            const Index patch = mesh.wall_patch[l * sides + r];
            const std::size_t next = side_from[index(mesh.rim[r][1])];
            const Index node = low + mesh.rim[r][1];
            if (next == sides || mesh.wall_patch[l * sides + next] != patch)
                add(node, node + mesh.nodes_per_layer);
            if (l + 1 < layers && mesh.wall_patch[(l + 1) * sides + r] != patch)
                add(low + mesh.nodes_per_layer + mesh.rim[r][0], low + mesh.nodes_per_layer + mesh.rim[r][1]);
        }
    }
    for (const bool target : {false, true}) {
        const std::vector<Index>& patch = target ? mesh.target_patch : mesh.source_patch;
        const auto other = [&](Index p) { return p != patch.front(); };
        if (std::ranges::none_of(patch, other)) continue;
        std::unordered_map<std::uint64_t, Index> beside;
        for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
            for (std::size_t k = 0; k < 4; ++k) {
                const Index a = mesh.quads[q][k], b = mesh.quads[q][(k + 1) % 4];
                if (a == b) continue;
                const auto [known, fresh] = beside.try_emplace(edge_key(a, b), patch[q]);
                if (!fresh && known->second != patch[q]) add((target ? top : 0) + a, (target ? top : 0) + b);
            }
        }
    }
    return borders;
}

} // namespace lacuna::sweep
