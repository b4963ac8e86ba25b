// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>

#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// Stub: a column of given nodes that starts at one rim and ends before the other rim, because the given wall
/// covers only a part of the height.
struct GivenStub {
    bool from_target = false;  ///< whether it starts at the target's rim; otherwise at the source's
    double at = 0;             ///< running length on the chain of that rim
    FaceId wall;               ///< the wall of the stub; if it is between two walls, one of them
    std::vector<Index> points; ///< model points, starting at the rim
    /// The walls of the quads between this stub and the next stub around the ring, starting at the rim.
    std::vector<FaceId> faces;
};

/// A column of given nodes from the source rim to the target rim.
struct GivenColumn {
    double source_at = 0;      ///< running length on the source chain
    double target_at = 0;      ///< running length on the target chain, modulo its length
    std::vector<Index> points; ///< rows + 1 model points, from the source
    /// The walls of the quads between this column and the next column around the ring, starting at the
    /// source. Empty if there are no given quads.
    std::vector<FaceId> faces;
};

/// Columns of given nodes on the walls of a linking surface. A column without given quads is a side line.
struct GivenColumns {
    int rows = 0;                   ///< number of quads in every column; 0: there are no columns
    bool quads = false;             ///< whether some columns have quads between them
    std::vector<GivenColumn> whole; ///< in increasing order of `source_at`
    /// First the stubs from the source, then those from the target, each in order of `at`.
    std::vector<GivenStub> stubs;
};

/// Rows and columns of the given wall meshes.
struct GivenRows {
    /// The columns of each linking surface. All linking surfaces with columns have the same number of rows.
    std::vector<GivenColumns> columns;
    std::vector<std::string> notes{}; ///< a line for each wall or side line whose nodes are not kept
};

/// Read the meshes of given walls as rows and columns. A walk starts at each side of the source rim and
/// crosses quads from one side to the opposite side, up to the target rim. Walks that end before the other
/// rim give stubs; these are also searched from the target rim. If no wall has quads, the side lines are
/// columns, provided that all of them have the same number of nodes.
/// @param layers  requested number of layers; 0: none. Side lines with another number of sides are not used
///         as columns.
/// @throw NotSweepable "surface.wall_rows"  quads of walls form different numbers of rows, or stubs have as
///         many rows as whole walls; names the walls. "surface.wall_not_rows"  a quad is in no row; names the
///         wall and the first such quad.
/// @note  O(quads).
GivenRows given_columns(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                        int layers);

/// Relative heights of the columns' nodes: rows + 1 numbers from 0 to 1, averaged over all columns. Empty if
/// there are no columns.
std::vector<double> given_heights(const topology::Model& model, std::span<const GivenColumns> columns);

/// As `given_heights()`, for walls whose quads end before the opposite rim. Two stubs that face each other
/// form one column, and the gap between them is divided evenly.
/// @param links   linking surfaces with segments, which relate both rims.
/// @param layers  number of layers; 0: those of the tallest stubs, plus the gap divided by the size.
/// @return  empty if there are no stubs.
/// @throw NotSweepable "surface.stub_rows"  stubs leave no layer for the gap; names the wall, its rows and
///         the layers.
std::vector<double> stub_heights(const topology::Model& model, std::span<const LinkingSurface> links,
                                 std::span<const GivenColumns> columns, const SizeField& size, int layers);

/// Linking surfaces with breaks at given nodes.
struct KeptNodes {
    std::vector<LinkingSurface> links;
    std::vector<std::string> notes{}; ///< a line for each rim whose nodes are not kept
};

/// Use the rim nodes of faces that keep their mesh as nodes of the sweep. A segment of a rim ends at each of
/// these nodes, and the segment between two of them is one side of a quad.
///
/// The two end nodes of a column correspond to each other. Other nodes, between two side lines or two
/// corners:
/// - If both rims have the same number of given nodes there, these are paired in order.
/// - If the numbers differ, the nodes of the source are kept, and a note counts the nodes of the target that
///   are not kept.
/// - If only one rim has given nodes, the other rim gets nodes opposite to them.
/// @param columns  given columns of each linking surface.
/// @param wedges   whether triangles of both ends are kept like quads.
KeptNodes keep_given_nodes(const topology::OpenVolume& volume, std::span<const GivenColumns> columns,
                           std::vector<LinkingSurface> links, bool wedges = false);

} // namespace lacuna::surface
