// SPDX-License-Identifier: MIT
#pragma once

/// The mesh that `clean_quads()` works on.

#include <lacuna/quads/detail/clean_quads.h>
#include <lacuna/quads/detail/quad_net.h>

#include <cstdint>
#include <span>
#include <vector>

namespace lacuna::quads::cleaning {

/// Deviation of a quad from an ideal one.
struct QuadLoss {
    double jacobian = 1; ///< scaled Jacobian
    double loss = 0;     ///< 1 - jacobian; with a target size, plus a penalty for a deviating area
};

QuadLoss loss_of(std::span<const Vec2> points, const Quad& quad, const CleanOptions& options);

/// Quads with their neighbours and ideal valences of points.
class CleanMesh {
public:
    /// @param options  kept by reference
    CleanMesh(const PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options);

    /// Whether the quads of every point form one fan, and only fixed points lie on the boundary.
    [[nodiscard]] bool is_sound() const;
    /// The points and quads that were not removed, the fixed points first.
    [[nodiscard]] PlanarQuads result() const;

    [[nodiscard]] const QuadNet& net() const { return net_; }
    [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }
    [[nodiscard]] const Vec2& at(Index p) const { return points_[index(p)]; }
    /// Ideal valence of a point: 4 inside; on the boundary, the number of right angles that is nearest to the
    /// point's angle.
    [[nodiscard]] int ideal_valence(Index p) const { return ideal_[index(p)]; }
    [[nodiscard]] bool is_irregular(Index p) const
    {
        return net_.is_used(p) && net_.valence(p) != ideal_valence(p);
    }
    [[nodiscard]] QuadLoss loss(Index q) const { return loss_of(points_, net_.quad(q), options_); }
    /// Identifier of a quad. If a later quad reuses the number of a removed quad, it gets another identifier.
    [[nodiscard]] std::uint64_t name(Index q) const
    {
        return (static_cast<std::uint64_t>(q) << 32) + version_[index(q)] + 1;
    }

    /// Remove doublets: delete each interior point of valence 2, so that its two quads become one.
    void remove_doublets();
    Index add_point(const Vec2& position);
    void move(Index p, const Vec2& position) { points_[index(p)] = position; }
    /// Replace quads by others with the same outline.
    void replace(std::span<const Index> removed, std::span<const Quad> added);

private:
    [[nodiscard]] int right_angles(Index p) const;

    const CleanOptions& options_;
    std::vector<Vec2> points_;
    QuadNet net_;
    std::size_t fixed_;
    std::vector<int> ideal_;
    std::vector<std::uint32_t> version_; ///< for each quad; counts how often its number was reused
};

} // namespace lacuna::quads::cleaning
