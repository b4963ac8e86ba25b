// SPDX-License-Identifier: MIT
#include <lacuna/quads/symmetry.h>

#include <lacuna/core/edge_key.h>
#include <lacuna/quads/measure_plane.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace lacuna::quads {
namespace {

/// Nodes are alike that are nearer than this share of the region's extent: what the nodes of a CAD edge are
/// off by. A choice, not a measurement.
constexpr double kAlike = 1e-6;

/// A turn about the centre, after mirroring in the first axis where it mirrors.
struct Isometry {
    Vec2 centre;
    double cosine = 1, sine = 0;
    bool mirrors = false;

    [[nodiscard]] Vec2 operator()(const Vec2& p) const
    {
        const Vec2 d = p - centre;
        const double y = mirrors ? -d.y() : d.y();
        return centre + Vec2(cosine * d.x() - sine * y, sine * d.x() + cosine * y);
    }
    [[nodiscard]] Vec2 back(const Vec2& p) const
    {
        const Vec2 d = p - centre;
        const Vec2 turned(cosine * d.x() + sine * d.y(), -sine * d.x() + cosine * d.y());
        return centre + Vec2(turned.x(), mirrors ? -turned.y() : turned.y());
    }
};

/// A symmetry and the node that each node goes to.
struct Symmetry {
    Isometry map;
    std::vector<Index> to;
};

class SymmetryFinder {
public:
    SymmetryFinder(const PlanarQuads& mesh, const PlanarRegion& region) : mesh_(mesh), region_(region)
    {
        centre_ = Vec2::Zero();
        for (const Vec2& p : region.points) centre_ += p / static_cast<double>(region.points.size());
        double extent = 0;
        for (const Vec2& p : region.points) extent = std::max(extent, (p - centre_).norm());
        alike_ = kAlike * extent;
        for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
            for (std::size_t k = 0; k < 4; ++k)
                side_[directed_key(mesh.quads[q][k], mesh.quads[q][(k + 1) % 4])] = 4 * q + k;
        }
    }

    /// All symmetries of the mesh but the identity.
    std::vector<Symmetry> run()
    {
        std::vector<Symmetry> found;
        const std::vector<Index>& loop = region_.loops[0];
        const Vec2 first = at(loop[0]) - centre_;
        for (const bool mirrors : {false, true}) {
            for (std::size_t k = mirrors ? 0 : 1; k < loop.size(); ++k) {
                const Vec2 image = at(loop[k]) - centre_;
                if (std::abs(image.norm() - first.norm()) > alike_) continue;
                const double y = mirrors ? -first.y() : first.y();
                const double square = first.squaredNorm();
                Symmetry symmetry{{centre_, (first.x() * image.x() + y * image.y()) / square,
                                   (first.x() * image.y() - y * image.x()) / square, mirrors},
                                  std::vector<Index>(mesh_.points.size(), -1)};
                if (maps_outline(symmetry, k) && maps_holes(symmetry) && maps_quads(symmetry))
                    found.push_back(std::move(symmetry));
            }
        }
        return found;
    }

private:
    [[nodiscard]] const Vec2& at(Index p) const { return mesh_.points[index(p)]; }
    static std::size_t index(Index p) { return static_cast<std::size_t>(p); }
    [[nodiscard]] bool is_at(const Isometry& map, Index p, Index q) const
    {
        return (map(at(p)) - at(q)).squaredNorm() <= alike_ * alike_;
    }

    [[nodiscard]] bool maps_loop(Symmetry& symmetry, const std::vector<Index>& loop,
                                 const std::vector<Index>& onto, std::size_t k) const
    {
        const std::size_t n = loop.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Index to = onto[symmetry.map.mirrors ? (k + n - i) % n : (k + i) % n];
            if (!is_at(symmetry.map, loop[i], to)) return false;
            symmetry.to[index(loop[i])] = to;
        }
        return true;
    }

    [[nodiscard]] bool maps_outline(Symmetry& symmetry, std::size_t k) const
    {
        return maps_loop(symmetry, region_.loops[0], region_.loops[0], k);
    }

    [[nodiscard]] bool maps_holes(Symmetry& symmetry) const
    {
        for (std::size_t l = 1; l < region_.loops.size(); ++l) {
            const std::vector<Index>& loop = region_.loops[l];
            bool found = false;
            for (std::size_t m = 1; m < region_.loops.size() && !found; ++m) {
                const std::vector<Index>& onto = region_.loops[m];
                for (std::size_t k = 0; onto.size() == loop.size() && k < onto.size() && !found; ++k)
                    found = is_at(symmetry.map, loop[0], onto[k]) && maps_loop(symmetry, loop, onto, k);
            }
            if (!found) return false;
        }
        return true;
    }

    /// Follow the quads from the boundary inward. @return false where one has no image
    [[nodiscard]] bool maps_quads(Symmetry& symmetry) const
    {
        const bool mirrors = symmetry.map.mirrors;
        std::vector<char> seen(mesh_.quads.size(), 0);
        std::vector<std::size_t> next;
        const auto follow = [&](Index a, Index b) { // a side whose ends have images
            const auto own = side_.find(directed_key(a, b));
            if (own == side_.end() || seen[own->second / 4]) return true;
            const Index to_a = symmetry.to[index(a)], to_b = symmetry.to[index(b)];
            const auto image = side_.find(mirrors ? directed_key(to_b, to_a) : directed_key(to_a, to_b));
            if (image == side_.end()) return false;
            const std::size_t q = own->second / 4, k = own->second % 4;
            const Quad &quad = mesh_.quads[q], &onto = mesh_.quads[image->second / 4];
            const std::size_t start = image->second % 4;
            for (std::size_t i = 0; i < 4; ++i) {
                const Index to = onto[mirrors ? (start + 5 - i) % 4 : (start + i) % 4];
                Index& known = symmetry.to[index(quad[(k + i) % 4])];
                if (known >= 0 && known != to) return false;
                known = to;
            }
            seen[q] = 1;
            next.push_back(q);
            return true;
        };
        const auto& loop = region_.loops[0];
        if (!follow(loop[0], loop[1])) return false;
        while (!next.empty()) {
            const Quad& quad = mesh_.quads[next.back()];
            next.pop_back();
            for (std::size_t k = 0; k < 4; ++k) {
                if (!follow(quad[(k + 1) % 4], quad[k])) return false;
            }
        }
        return true;
    }

    const PlanarQuads& mesh_;
    const PlanarRegion& region_;
    Vec2 centre_;
    double alike_ = 0;
    std::unordered_map<std::uint64_t, std::size_t> side_; ///< 4 × quad + place, by a side's ends
};

double least_jacobian(const PlanarQuads& mesh)
{
    double least = 1;
    for (const Quad& quad : mesh.quads) least = std::min(least, scaled_jacobian(mesh.points, quad));
    return least;
}

} // namespace

std::size_t symmetrise(PlanarQuads& mesh, const PlanarRegion& region)
{
    const std::vector<Symmetry> symmetries = SymmetryFinder(mesh, region).run();
    if (symmetries.empty()) return 1;
    PlanarQuads made = mesh;
    const double share = 1.0 / static_cast<double>(symmetries.size() + 1);
    for (std::size_t p = region.points.size(); p < made.points.size(); ++p) {
        Vec2 sum = mesh.points[p];
        for (const Symmetry& symmetry : symmetries)
            sum += symmetry.map.back(mesh.points[static_cast<std::size_t>(symmetry.to[p])]);
        made.points[p] = share * sum;
    }
    // Means of nodes that smoothing left nearly where their images are do not make quads worse, but may
    // where it stopped early.
    constexpr double kWorse = 0.01; // a choice, not a measurement
    if (least_jacobian(made) < least_jacobian(mesh) - kWorse) return 1;
    mesh = std::move(made);
    return symmetries.size() + 1;
}

} // namespace lacuna::quads
