// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/tet_mesh.h>
#include <lacuna/quality/shared/metrics.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

/// Arithmetic of one cell that is not a hexahedron. Internal to this folder.
///
/// A pyramid is (1 - w) B(u, v) + w A, with the bilinear map B of its base and its apex A. Its Jacobian is
/// (1 - w)² det(B_u, B_v, A - B), where B_u and B_v are derivatives of B. This determinant is bilinear in u
/// and v. So the Jacobian is positive everywhere except at the apex if and only if the determinant is
/// positive at the four corners of the base. The Jacobian of a tetrahedron is constant.
namespace lacuna::quality {

enum class CellKind : std::uint8_t { hex, wedge, pyramid, tet };

/// The kind of a cell that is stored as a hexahedron with merged corners. `mesh::is_wedge()` also holds for a
/// tetrahedron, so the apex is tested first.
constexpr CellKind kind_of(const Hex& hex)
{
    if (mesh::has_apex(hex)) return mesh::is_tet(hex) ? CellKind::tet : CellKind::pyramid;
    return mesh::is_wedge(hex) ? CellKind::wedge : CellKind::hex;
}

/// The different corners of a kind of cell, in the order of `mesh::CellShape`, as positions in `Hex`.
inline std::span<const std::uint8_t> corners_of(CellKind kind)
{
    static constexpr std::uint8_t kHex[]{0, 1, 2, 3, 4, 5, 6, 7}, kWedge[]{0, 1, 2, 4, 5, 6},
        kPyramid[]{0, 1, 2, 3, 4}, kTet[]{0, 1, 2, 4};
    static constexpr std::span<const std::uint8_t> kAll[]{kHex, kWedge, kPyramid, kTet};
    return kAll[static_cast<std::size_t>(kind)];
}

/// Eight corners; those that are merged are repeated.
using CellCorners = std::array<Vec3, 8>;

struct OtherValues {
    double scaled = 0;     ///< see `scaled_determinant()`
    double jacobian = 0;   ///< smallest Jacobian at the corners, except at a pyramid's apex
    double volume = 0;     ///< exact
    bool positive = false; ///< the Jacobian is positive everywhere, except at a pyramid's apex
};

/// @pre the cell is not a hexahedron
OtherValues evaluate_other(CellKind kind, const CellCorners& corners);

/// The metric, if it is defined for cells other than hexahedra: scaled Jacobian, Jacobian and volume.
std::optional<double> other_metric(Metric metric, const OtherValues& values);

/// A corner, and its neighbours along three edges, right-handed.
struct CornerNeighbours {
    std::uint8_t at;
    std::array<std::uint8_t, 3> next;
};
/// All corners except a pyramid's apex, where four edges meet. @pre the cell is not a hexahedron
std::span<const CornerNeighbours> neighbours_in(CellKind kind);

/// The determinant of three edges divided by the product of their lengths, scaled to be 1 at the corners of a
/// cell with equal edges; at most 1. The scaled Jacobian of a cell is the smallest of its corners, as in
/// Verdict; of a pyramid, of the corners of its base, where Verdict takes those of the tetrahedra there.
inline double scaled_determinant(CellKind kind, double determinant, const std::array<Vec3, 3>& edges)
{
    const double lengths = edges[0].norm() * edges[1].norm() * edges[2].norm();
    if (!(lengths > 0) || !(lengths <= std::numeric_limits<double>::max())) return 0;
    const double best = kind == CellKind::wedge ? std::sqrt(0.75) : std::sqrt(0.5);
    return std::min(determinant / (best * lengths), 1.0);
}

} // namespace lacuna::quality
