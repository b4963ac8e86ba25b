// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/given_nodes.h>
#include <lacuna/sweep/sweep.h>

#include <set>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// What the faces came with, as the sweep is to keep it.
struct GivenMeshes {
    std::vector<surface::GivenColumns> columns; ///< of each linking surface
    std::vector<double> heights;                ///< of the layers; empty: nobody says
    std::vector<std::string> notes;
};

/// Read the meshes of walls and rims; the segments of `links` are broken at given nodes.
/// @param asked  heights that the options give; empty: none.
/// @param size   what walls that end half way leave open is divided by it.
/// @throw NotSweepable "sweep.given_rows"  rows of quads on walls that are not as many as the layers asked
///                     for; what `surface::given_columns()` throws.
GivenMeshes given_meshes(const topology::OpenVolume& volume, std::vector<surface::LinkingSurface>& links,
                         const std::vector<double>& asked, const surface::SizeField& size,
                         const SweepOptions& options);

/// `faces`, walls and targets with quads of their own: their nodes take no part in improving.
std::set<FaceId> given_faces(const topology::OpenVolume& volume, std::set<FaceId> faces, bool wedges);

/// A line of the report for each face that keeps its nodes: how many of them are nodes of the mesh.
/// @param wedges  triangles of the ends stay as well.
void report_given(const topology::OpenVolume& volume, Swept& swept, bool wedges);

} // namespace lacuna::sweep
