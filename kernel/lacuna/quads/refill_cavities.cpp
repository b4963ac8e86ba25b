// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/refill_cavities.h>

#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/quads/detail/open_corners.h>
#include <lacuna/quads/detail/quad_net.h>
#include <lacuna/quads/detail/triangle_quads.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace lacuna::quads::paving {
namespace {

/// Closed loops of point numbers, the outer one first.
using Loops = std::vector<Cycle>;

/// Rings of quads removed with the folded ones, because their nodes lie in the fold. More rings replace more
/// good quads, fewer leave less room.
constexpr int kRings = 2;

class CavityFinder {
public:
    explicit CavityFinder(PlanarQuads& mesh)
        : mesh_(mesh), net_(mesh.points.size(), mesh.quads), out_(mesh.quads.size(), false)
    {
    }

    /// Mark the folded quads and the rings around them. @return whether there are any
    bool mark()
    {
        for (std::size_t q = 0; q < out_.size(); ++q)
            out_[q] = !(scaled_jacobian(mesh_.points, mesh_.quads[q]) > 0);
        if (std::ranges::none_of(out_, [](bool b) { return b; })) return false;
        for (int ring = 0; ring < kRings; ++ring) grow(std::vector<bool>(mesh_.points.size(), true));
        return true;
    }

    /// Remove more quads until every cavity can be filled. @return the outlines of the cavities, each with
    /// its outer loop first
    std::vector<Loops> find_cavities()
    {
        while (true) {
            std::vector<Loops> cavities;
            std::vector<bool> from(mesh_.points.size(), false);
            bool bad = false;
            for (const std::vector<Index>& part : parts()) {
                auto outline = outline_of(part);
                if (outline) {
                    cavities.push_back(std::move(*outline));
                    continue;
                }
                bad = true;
                for (const Index q : part) {
                    for (const Index p : net_.quad(q)) from[index(p)] = true;
                }
            }
            // If all quads are removed, the outline is the region's own, which was checked before.
            if (!bad || !grow(from)) return cavities;
        }
    }

    void remove_quads()
    {
        std::vector<Quad> kept;
        for (std::size_t q = 0; q < out_.size(); ++q) {
            if (!out_[q]) kept.push_back(mesh_.quads[q]);
        }
        mesh_.quads = std::move(kept);
    }

private:
    /// Remove the quads at those nodes of removed quads that `from` allows. @return whether any were removed
    bool grow(const std::vector<bool>& from)
    {
        std::vector<bool> reached(mesh_.points.size(), false);
        for (std::size_t q = 0; q < out_.size(); ++q) {
            if (!out_[q]) continue;
            for (const Index p : mesh_.quads[q]) reached[index(p)] = from[index(p)];
        }
        bool more = false;
        for (std::size_t q = 0; q < out_.size(); ++q) {
            if (out_[q]) continue;
            for (const Index p : mesh_.quads[q]) {
                if (!reached[index(p)]) continue;
                out_[q] = more = true;
                break;
            }
        }
        return more;
    }

    /// The removed quads in groups connected by edges.
    [[nodiscard]] std::vector<std::vector<Index>> parts() const
    {
        std::vector<std::vector<Index>> result;
        std::vector<bool> seen(out_.size(), false);
        for (std::size_t start = 0; start < out_.size(); ++start) {
            if (!out_[start] || seen[start]) continue;
            std::vector<Index>& part = result.emplace_back(1, static_cast<Index>(start));
            seen[start] = true;
            for (std::size_t i = 0; i < part.size(); ++i) {
                for (Index side = 4 * part[i]; side < 4 * part[i] + 4; ++side) {
                    const Index other = net_.opposite(side);
                    if (other < 0 || !out_[index(other / 4)] || seen[index(other / 4)]) continue;
                    seen[index(other / 4)] = true;
                    part.push_back(other / 4);
                }
            }
        }
        return result;
    }

    /// The loops around a group, the outer one first; empty if they are pinched, cross or have the wrong
    /// direction.
    [[nodiscard]] std::optional<Loops> outline_of(const std::vector<Index>& part) const
    {
        std::unordered_map<Index, Index> next;
        std::vector<Index> starts;
        for (const Index q : part) {
            for (Index side = 4 * q; side < 4 * q + 4; ++side) {
                const Index other = net_.opposite(side);
                if (other >= 0 && out_[index(other / 4)]) continue;
                if (!next.emplace(net_.from(side), net_.to(side)).second) return std::nullopt;
                starts.push_back(net_.from(side));
            }
        }
        Loops loops;
        for (const Index start : starts) {
            if (!next.contains(start)) continue;
            std::vector<Index>& loop = loops.emplace_back();
            Index p = start;
            for (auto found = next.find(p); found != next.end(); found = next.find(p)) {
                loop.push_back(p);
                p = found->second;
                next.erase(found);
            }
            if (p != start || loop.size() < 3) return std::nullopt;
        }
        const auto outer = std::ranges::find_if(
            loops, [&](const auto& l) { return twice_area(mesh_.points, l) > 0; });
        if (outer == loops.end()) return std::nullopt;
        std::iter_swap(loops.begin(), outer);
        const bool turned = std::any_of(loops.begin() + 1, loops.end(),
                                        [&](const auto& l) { return !(twice_area(mesh_.points, l) < 0); });
        if (turned || geometry::find_crossing(mesh_.points, loops)) return std::nullopt;
        return loops;
    }

    PlanarQuads& mesh_;
    QuadNet net_;
    std::vector<bool> out_; ///< quads to be removed
};

} // namespace

int refill_cavities(PlanarQuads& mesh, const PlanarRegion& region, const SizeField& size)
{
    CavityFinder finder(mesh);
    if (!finder.mark()) return 0;
    const std::vector<Loops> cavities = finder.find_cavities();
    finder.remove_quads();
    for (const Loops& loops : cavities) {
        const auto [cavity, own] = region_within(mesh.points, loops, size);
        add_filling(mesh, own, quads_of_triangles(cavity));
    }
    drop_loose_points(mesh, region.points.size());
    return static_cast<int>(cavities.size());
}

} // namespace lacuna::quads::paving
