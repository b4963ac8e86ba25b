// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>

#include <optional>

namespace lacuna::quads {

/// For which region a straight grid is to have numbers of sides.
struct StraightOptions {
    CountRange range = kSegment; ///< that segments may get
    bool is_part = false;        ///< whether the region is a part of another, with axes
    bool few = false;            ///< whether quads are few, so that holes may find no place between lines
};

/// Numbers of sides for a grid of straight lines, where ends of 135° may be soft or hard: those of the lower
/// cost. As many quads as asked count too, for the rows before soft ends add some. Soft ends have quads so
/// much better shaped that they may cost more. Of few quads of a whole region those that a grid fills best.
std::optional<Counts> straight_counts(const CountTask& task, const StraightOptions& options = {});

} // namespace lacuna::quads
