// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/motion.h>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// A smooth part of a path. Two points are a line. More points are closely spaced points of a curve; between
/// consecutive points, the curve is a cubic.
using PathPart = std::vector<Vec3>;

/// Orientation of the section along a path.
enum class SectionFrame {
    minimal, ///< turned with the path by rotation-minimising frames @cite wang_2008_frames
    fixed,   ///< not turned
};

/// The motion along a path of parts that meet in corners. Heights are shares of the path's length.
///
/// With minimal frames, the section at a corner lies in the plane that halves the angle between the two
/// parts, as in a mitre joint: it is sheared against the plane normal to the path. Along each part, the shear
/// of a corner decreases linearly to zero at the other end of the part.
/// @throw InvalidInput "geometry.path_short"  successive points of a part coincide. "geometry.path_corner"  a
///        corner turns by more than 90° with minimal frames. Both messages give the place.
Motion motion_along_path(std::span<const PathPart> parts, SectionFrame frame);

/// Direction in which a path starts, of length 1. @pre the first part has a length
Vec3 start_of_path(std::span<const PathPart> parts);

} // namespace lacuna::geometry
