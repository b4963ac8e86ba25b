// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/quads/detail/counted_loop.h>
#include <lacuna/quads/detail/outline_symmetry.h>
#include <lacuna/quads/shared/pattern_counts.h>

#include <optional>
#include <vector>

namespace lacuna::quads {

/// Numbers of sides for a symmetric region: they are found for the part between mirror axes and applied to
/// all images of this part. If no grid fills the part, the result is the wanted numbers, rounded, with
/// infinite cost.
/// @return empty if the region cannot be cut along any axis.
std::optional<Counts> mirror_counts(const CountTask& task);

/// Set the numbers of sides of a part's axes so that one grid fills the part, as `pattern_counts()` does. If
/// there are no such numbers, use those that the size requires, with an even total around the part.
/// @param few  whether numbers may deviate from the wanted ones as much as on a ring, if nothing else fits.
/// @return  cost of the grid, for comparison with other parts; infinite if there is no grid.
/// @throw Cancelled
double count_axes(MirrorPart& part, const SizeField& size, bool few, const RunContext& context);

/// The cheapest result over parts between different pairs of axes. At most `kCandidates` pairs are tried,
/// those with the best rank.
/// @param sizes  sizes for dividing the axes. The last size is used only if no grid fills a part with any of
///         the other sizes.
/// @param make   makes a result from a part. The result has a cost, which is infinite if no grid fills the
///         part.
/// @return empty if there are no parts.
template <class Make>
auto cheapest_of_parts(const PlanarRegion& region, const std::vector<Symmetry>& symmetries,
                       const std::vector<SizeField>& sizes, const Make& make)
{
    decltype(std::optional(make(MirrorPart()))) best;
    for (std::size_t s = 0; s < sizes.size() && !best; ++s) {
        const bool is_last = s + 1 == sizes.size();
        for (std::size_t choice = 0; choice < (is_last ? 1 : kCandidates); ++choice) {
            auto part = mirror_part(region, symmetries, sizes[s], choice);
            if (!part) break;
            auto made = make(std::move(*part));
            if (is_last || made.cost < (best ? best->cost : kInfinity)) best = std::move(made);
        }
    }
    return best;
}

} // namespace lacuna::quads
