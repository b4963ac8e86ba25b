// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/given_nodes.h>
#include <lacuna/sweep/sweep.h>

#include <set>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// The given meshes of walls and rims that the sweep keeps, as columns and layers.
struct GivenMeshes {
    std::vector<surface::GivenColumns> columns; ///< given columns of each linking surface
    std::vector<double> heights;                ///< heights of the layers; empty: not constrained
    std::vector<std::string> notes;
};

/// Read the meshes of walls and rims, and split the segments of `links` at given nodes.
/// @param asked  heights from the options; empty: none.
/// @param size   size of the layers above walls that cover only a part of the height.
/// @throw NotSweepable "sweep.given_rows"  the number of rows of quads on walls differs from the requested
///         number of layers; or as `surface::given_columns()`.
GivenMeshes given_meshes(const topology::OpenVolume& volume, std::vector<surface::LinkingSurface>& links,
                         const std::vector<double>& asked, const surface::SizeField& size,
                         const SweepOptions& options);

/// `faces`, plus the walls and targets with given quads. Improvement does not move the nodes of these faces.
std::set<FaceId> given_faces(const topology::OpenVolume& volume, std::set<FaceId> faces, bool wedges);

/// A line of the report for each face that keeps its nodes, with the number of nodes that the mesh contains.
/// Also a note, if quads were to be kept, lost nodes, and no other line says why.
/// @param volume  as it was given.
void report_given(const topology::OpenVolume& volume, Swept& swept, const SweepOptions& options);

} // namespace lacuna::sweep
