// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>
#include <lacuna/quads/detail/outline_symmetry.h>

#include <functional>
#include <optional>
#include <vector>

namespace lacuna::quads {

/// Numbers of sides for all images of a part.
struct MirrorCounts {
    std::vector<int> sides;
    bool is_grid = false; ///< one fills the part; else they are those wanted, rounded
};

/// Numbers of sides for the part of a symmetric region between mirror axes, and so for all of its images.
/// @return nothing where no axis may be cut along.
std::optional<MirrorCounts> mirror_counts(const CountTask& task);

/// Give the axes of a part numbers of sides with which one grid fills it, as `pattern_counts()` does; where
/// there are none, those of the size with an even number round the part.
/// @return what the grid costs beside that of other parts; nothing where there is none.
/// @param few  whether numbers may be as far from those wanted as a ring's, where there is none else.
/// @throw Cancelled
std::optional<double> count_axes(MirrorPart& part, const std::function<double(const Vec2&)>& size, bool few,
                                 const RunContext& context);

/// A part's axes are divided by a size that changes slowly away from short given sides; where there are fewer
/// quads than this, by the size asked first. A choice, not a measurement.
inline constexpr double kFewForGrading = 200;

/// Parts between other mirror axes that are looked at. A choice, not a measurement.
inline constexpr std::size_t kMostChoices = 4;

} // namespace lacuna::quads
