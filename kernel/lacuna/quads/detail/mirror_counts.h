// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>
#include <lacuna/quads/detail/outline_symmetry.h>

#include <limits>
#include <optional>
#include <vector>

namespace lacuna::quads {

/// Numbers of sides for the part of a symmetric region between mirror axes, and so for all of its images.
/// Their cost is infinite where no grid fills the part: they are those wanted, rounded.
/// @return nothing where no axis may be cut along.
std::optional<Counts> mirror_counts(const CountTask& task);

/// Give the axes of a part numbers of sides with which one grid fills it, as `pattern_counts()` does; where
/// there are none, those of the size with an even number round the part.
/// @return what the grid costs beside that of other parts; infinite where there is none.
/// @param few  whether numbers may be as far from those wanted as a ring's, where there is none else.
/// @throw Cancelled
double count_axes(MirrorPart& part, const SizeField& size, bool few, const RunContext& context);

/// A part's axes are divided by a size that changes slowly away from short given sides; where there are fewer
/// quads than this, by the size asked first. A choice, not a measurement.
inline constexpr double kFewForGrading = 200;

/// Parts between other mirror axes that are looked at. A choice, not a measurement.
inline constexpr std::size_t kMostChoices = 4;

/// The cheapest of what is made of parts between some axes or others.
/// @param sizes  that axes are divided by: the last one counts where no grid fills a part with those before.
/// @param make   makes of a part something with a cost, infinite where no grid fills it.
/// @return nothing where there are no parts.
template <class Make>
auto cheapest_of_parts(const PlanarRegion& region, const std::vector<Symmetry>& symmetries,
                       const std::vector<SizeField>& sizes, const Make& make)
{
    decltype(std::optional(make(MirrorPart()))) best;
    for (std::size_t s = 0; s < sizes.size() && !best; ++s) {
        const bool is_last = s + 1 == sizes.size();
        for (std::size_t choice = 0; choice < (is_last ? 1 : kMostChoices); ++choice) {
            auto part = mirror_part(region, symmetries, sizes[s], choice);
            if (!part) break;
            auto made = make(std::move(*part));
            if (is_last || made.cost < (best ? best->cost : std::numeric_limits<double>::infinity()))
                best = std::move(made);
        }
    }
    return best;
}

} // namespace lacuna::quads
