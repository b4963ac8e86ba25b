// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/healing/detail/facet_sides.h>
#include <lacuna/healing/detail/soup_facets.h>

#include <vector>

/// Normals of facets, by which split_facets() decides where faces end; for clean and for noisy surfaces. Each
/// function takes time linear in the number of facets.
namespace lacuna::healing {

/// Number of facets in a patch of `patch_normals()`. With noise of 40 % of the facets' sides, patches of 32
/// merge adjacent sides of a square tube; patches of 64 deviate too much from the surface of a round tube
/// with 40 sides.
inline constexpr std::size_t kPatch = 40;

/// The side of another facet with the same label on the segment of this side. -1 if there is none, if there
/// are several, or if a facet of another label also has the segment.
Index partner(const Facets& facets, const FacetSides& sides, Index side);

/// Unit normals of the facets. If moving the points of a thin facet by the tolerance could turn it by the
/// feature angle [radians], it gets the normal of the neighbour across its longest side.
std::vector<Vec3> own_normals(const Facets& facets, const FacetSides& sides, double feature,
                              const RunContext& context);

/// Give each facet without a normal the normal of a neighbour, preferably the one across its longest side. A
/// facet without any such neighbour keeps a zero normal.
void borrow_normals(const Facets& facets, const FacetSides& sides, std::vector<Index> without,
                    std::vector<Vec3>& normal, const RunContext& context);

/// Whether the surface is rough next to many of its creases, as in a noisy scan. Clean surfaces are smooth on
/// both sides of a crease.
/// @param flipped  facets oriented against their face. @param feature  smallest turn of a crease [radians].
bool is_noisy(const Facets& facets, const FacetSides& sides, const std::vector<Vec3>& normal,
              const std::vector<bool>& flipped, double feature, const RunContext& context);

/// For each facet, the mean normal of the flattest patch that contains it. Inside a face this is the mean
/// over the facet's neighbourhood; next to a crease it is the mean over one side of the crease. Only the
/// border of a patch determines the sum of its area vectors, so noise inside the patch has no effect.
/// Choosing the flattest patch is Kuwahara's filter for images @cite kuwahara_1976_smoothing.
std::vector<Vec3> patch_normals(const Facets& facets, const FacetSides& sides, const RunContext& context);

} // namespace lacuna::healing
