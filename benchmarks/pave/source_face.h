// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "saddle_face.h"

#include <lacuna/topology/open_volume.h>

#include <string>
#include <vector>

namespace lacuna::bench {

/// A prism over an outline: its source is the outline, in the plane z = 0, at the start of the faces.
/// @param file  written: the prism as Open CASCADE keeps it (.brep)
topology::OpenVolume prism_over(const test::PlaneDomain& domain, const std::string& file);

/// A real case, sealed.
/// @param spec  FILE|SOURCE|TARGET|WALLS, each of the last three tags of faces with commas, or nothing
topology::OpenVolume real_case(const std::string& spec);

/// Neighbouring faces of a CAD file that look one way, as sources for `raised_over()`: for each face those of
/// 1, 2, 4, 7 and 12 next to it by breadth, each set once.
/// @return  tags with commas.
std::vector<std::string> groups_of(const topology::Model& model);

/// The volume between faces of a CAD file, exact as they are, and the same faces moved along their mean
/// normal by 0.6 of the root of their area: the former are its source, each edge of their rim has a wall.
/// @param tags  of the faces, with commas
topology::OpenVolume raised_over(const topology::Model& model, const std::string& tags);

/// The source faces of a volume, meshed as a sweep meshes them: the numbers of sides on their edges are the
/// kernel's choice.
struct SourceQuads {
    std::vector<FaceId> faces;
    std::vector<SurfaceQuads> on_face; ///< quads as the face is seen from outside
    double size = 0;                   ///< asked for [model length]
    double seconds = 0;                ///< of numbers of sides and quads, of this process
    std::string how;                   ///< the notes of the faces
};

/// @param quads  asked for over all source faces together
SourceQuads mesh_source_faces(const topology::OpenVolume& volume, double quads);

} // namespace lacuna::bench
