// SPDX-License-Identifier: MIT
#pragma once

/// The mesh that `clean_quads()` works on; only sources of this folder include it.

#include <lacuna/quads/clean_quads.h>
#include <lacuna/quads/detail/quad_net.h>

#include <cstdint>
#include <span>
#include <vector>

namespace lacuna::quads::cleaning {

/// How far from good a quad is.
struct QuadLoss {
    double jacobian = 1; ///< scaled
    double loss = 0;     ///< 1 - jacobian, and where a size is asked so much more as the area is off
};

QuadLoss loss_of(std::span<const Vec2> points, const Quad& quad, const CleanOptions& options);

/// Quads with their neighbours, and what is known of each point and quad.
class CleanMesh {
public:
    /// @param options  kept by reference
    CleanMesh(const PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options);

    /// Does every point have its quads in one fan, and lie no point on the boundary but the first ones?
    [[nodiscard]] bool is_sound() const;
    /// Interior points without four quads.
    [[nodiscard]] std::size_t irregular() const;
    /// Points and quads that are left, the fixed points first.
    [[nodiscard]] PlanarQuads taken_out() const;

    [[nodiscard]] const QuadNet& net() const { return net_; }
    [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }
    [[nodiscard]] const Vec2& at(Index p) const { return points_[static_cast<std::size_t>(p)]; }
    /// Quads a point should have.
    [[nodiscard]] int wanted(Index p) const { return wanted_[static_cast<std::size_t>(p)]; }
    [[nodiscard]] bool is_irregular(Index p) const { return net_.is_used(p) && net_.valence(p) != wanted(p); }
    [[nodiscard]] const QuadLoss& loss(Index q);
    /// A number for a quad that is not given again.
    [[nodiscard]] std::uint64_t name(Index q) const
    {
        return (static_cast<std::uint64_t>(q) << 32) + version_[static_cast<std::size_t>(q)] + 1;
    }

    /// Merge quads over interior points that have two alone. @return how many
    std::size_t remove_doublets();
    Index add_point(const Vec2& place);
    /// Put a point elsewhere.
    void move(Index p, const Vec2& place);
    /// Put quads in the place of others with the same outline.
    void replace(std::span<const Index> removed, std::span<const Quad> added);

private:
    [[nodiscard]] int right_angles(Index p) const;

    const CleanOptions& options_;
    std::vector<Vec2> points_;
    QuadNet net_;
    std::size_t fixed_;
    std::vector<int> wanted_;
    std::vector<QuadLoss> loss_;         ///< of each quad, where it is known
    std::vector<char> loss_known_;       ///< of each quad
    std::vector<std::uint32_t> version_; ///< of each quad, as its number is given again
};

} // namespace lacuna::quads::cleaning
