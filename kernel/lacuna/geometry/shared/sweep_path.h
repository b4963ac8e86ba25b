// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/motion.h>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// A smooth part of a path: two points of a line, or closely spaced points of a curve, which a cubic through
/// them replaces.
using PathPart = std::vector<Vec3>;

/// Orientation of the section along a path.
enum class SectionFrame {
    minimal, ///< turned with the path by rotation-minimising frames @cite wang_2008_frames
    fixed,   ///< not turned
};

/// The motion along a path of parts that meet in corners. Heights are shares of the path's length.
///
/// With minimal frames, the section at a corner lies in the plane that halves the angle between both parts,
/// as in a mitre joint; on a curved part, this shear of the section fades out along the part.
/// @throw InvalidInput "geometry.path_short"  a part without length; says where. "geometry.path_corner": a
///                     corner of more than 90° with minimal frames; says where.
Motion motion_along_path(std::span<const PathPart> parts, SectionFrame frame);

/// Direction in which a path starts, of length 1. @pre the first part has a length
Vec3 start_of_path(std::span<const PathPart> parts);

} // namespace lacuna::geometry
