// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/healing/detail/facet_sides.h>
#include <lacuna/healing/detail/soup_facets.h>

#include <vector>

/// The normals by which facets are told apart, of clean and of noisy surfaces. Each function is linear in the
/// facets.
namespace lacuna::healing {

/// Facets of a patch of `patch_normals()`. With noise of 40 % of the sides, 32 join sides of a square tube;
/// 64 turn too far from the surface of a round one of 40 sides.
inline constexpr std::size_t kPatch = 40;

/// The only other side of the same label on the side's segment; -1 if there is none, there are several, or a
/// facet of another label branches off.
Index partner(const Facets& facets, const FacetSides& sides, Index side);

/// Unit normals. A facet so thin that moving its points by the tolerance could turn it by the feature angle
/// [radians] takes the normal of its neighbour across its longest side.
std::vector<Vec3> own_normals(const Facets& facets, const FacetSides& sides, double feature,
                              const RunContext& context);

/// Give facets without a normal that of the neighbour across their longest side that has one; the normal
/// stays zero where no neighbour has one.
void borrow_normals(const Facets& facets, const FacetSides& sides, std::vector<Index> without,
                    std::vector<Vec3>& normal, const RunContext& context);

/// Is the surface rough beside many of its creases, as the noise of a scan makes it? Clean surfaces are
/// smooth on both sides of a crease.
/// @param flipped  facets oriented against their face. @param feature  least turn of a crease [radians].
bool is_noisy(const Facets& facets, const FacetSides& sides, const std::vector<Vec3>& normal,
              const std::vector<bool>& flipped, double feature, const RunContext& context);

/// For each facet the mean normal of the flattest patch that contains it: the mean over its neighbourhood,
/// beside a crease over that of one side. The area vectors of a patch add up to a sum that its border alone
/// determines, so noise inside it has no effect. To choose the flattest patch is the filter of Kuwahara
/// @cite kuwahara_1976_smoothing for images.
std::vector<Vec3> patch_normals(const Facets& facets, const FacetSides& sides, const RunContext& context);

} // namespace lacuna::healing
