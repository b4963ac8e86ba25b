// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/healing/detail/facet_sides.h>
#include <lacuna/healing/detail/soup_facets.h>

#include <vector>

/// Normals of facets on clean and on noisy surfaces. split_facets() decides by these normals where faces end.
/// Each function takes time linear in the number of facets.
namespace lacuna::healing {

/// Number of facets in a patch of `patch_normals()`. The value lies between two that fail with noise of 40 %
/// of the facets' sides: patches of 32 merge adjacent sides of a square tube; patches of 64 deviate too much
/// from a round tube with 40 sides.
inline constexpr std::size_t kPatch = 40;

/// The side of the adjacent facet of the same label: it lies on the same segment as `side`. -1 if there is no
/// such facet, if there are several, or if a facet of another label is at the segment too (unless that facet
/// coincides with one of the two).
Index partner(const Facets& facets, const FacetSides& sides, Index side);

/// Unit normals of the facets. A thin facet gets the normal of the facet across its longest side. Thin: if
/// its points moved by the tolerance, the facet could turn by the feature angle.
/// @param feature  the feature angle [radians].
std::vector<Vec3> own_normals(const Facets& facets, const FacetSides& sides, double feature,
                              const RunContext& context);

/// Give each facet without a normal that of an adjacent facet, preferably of the one across its longest side.
/// A facet that is connected to no facet with a normal keeps a zero normal.
void borrow_normals(const Facets& facets, const FacetSides& sides, std::vector<Index> without,
                    std::vector<Vec3>& normal, const RunContext& context);

/// Whether the surface is rough next to many of its creases, as in a noisy scan, and creases also lie where
/// they separate no two faces of at least kPatch facets, and neighbouring points do not stand out alike. A
/// clean surface is smooth on both sides of a crease; on a sawn bone with little noise, all creases separate
/// faces; points of coarse facets on a bent tube stand out alike.
/// @param face  by facet: the face that it belongs to, by its own normals.
/// @param flipped  by facet: whether it is oriented against its face.
/// @param feature  smallest turn of a crease [radians].
bool is_noisy(const Facets& facets, const FacetSides& sides, const std::vector<Vec3>& normal,
              const std::vector<Index>& face, const std::vector<bool>& flipped, double feature,
              const RunContext& context);

/// For each facet, the mean normal of the flattest patch that contains it (patch: a facet and the facets
/// nearest to it, `kPatch` in all). Inside a face this is the mean over the surroundings of the facet; next
/// to a crease it is the mean over one side of the crease. Noise inside a patch has no effect, because the
/// sum of the area vectors depends only on the patch's border. The choice of the flattest patch is Kuwahara's
/// filter for images @cite kuwahara_1976_smoothing.
std::vector<Vec3> patch_normals(const Facets& facets, const FacetSides& sides, const RunContext& context);

} // namespace lacuna::healing
