// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>

#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// Given nodes that start at one rim and end before the other: those of a wall that covers only part of the
/// height.
struct GivenStub {
    bool from_target = false;  ///< it starts at the target's rim, otherwise at the source's
    double at = 0;             ///< running length on the chain of that rim
    FaceId wall;               ///< its wall, or one of the two walls it separates
    std::vector<Index> points; ///< model points from the rim on
    std::vector<FaceId> faces; ///< wall of each quad up to the next stub around the ring, starting at the rim
};

/// Given nodes from the source rim to the target rim.
struct GivenColumn {
    double source_at = 0;      ///< running length on the source chain
    double target_at = 0;      ///< running length on the target chain, modulo its length
    std::vector<Index> points; ///< rows + 1 model points, from the source
    std::vector<FaceId> faces; ///< wall of each quad up to the next column around the ring; empty: none there
};

/// Columns of given nodes on the walls of a linking surface. A column without quads is a side line.
struct GivenColumns {
    int rows = 0;                   ///< quads in every column; 0: there are no columns
    bool quads = false;             ///< some columns have quads between them
    std::vector<GivenColumn> whole; ///< in order of their running lengths on the source chain
    std::vector<GivenStub> stubs;   ///< in order of their running lengths, the source's first
};

/// Rows and columns of the given wall meshes.
struct GivenRows {
    /// For each linking surface; all have the same number of rows, or none.
    std::vector<GivenColumns> columns;
    std::vector<std::string> notes{}; ///< a line for each wall or side line whose nodes are not kept
};

/// Read the meshes of given walls as rows and columns, by walking from each side of the source rim over
/// opposite sides of quads to the target rim. Columns from either rim that end before the other are stubs.
/// Side lines of walls without quads are columns if all have the same number of nodes.
/// @param layers  requested; 0: any. Side lines with another number of nodes are then no columns.
/// @throw NotSweepable "surface.wall_rows"  walls whose quads form different numbers of rows, or stubs with
///        as many rows as whole walls; "surface.wall_not_rows"  quads that are in no row; names the walls,
///        and the first quad.
/// @note  O(quads).
GivenRows given_columns(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                        int layers);

/// Relative heights of the columns' nodes: rows + 1 numbers from 0 to 1, averaged over all columns. Empty
/// without columns.
std::vector<double> given_heights(const topology::Model& model, std::span<const GivenColumns> columns);

/// The same for walls whose quads end before the opposite rim: facing stubs form one column, and the gap
/// between them is divided evenly.
/// @param links   with the segments that relate both rims.
/// @param layers  0: the tallest stubs plus the gap divided by the size.
/// @return  empty without stubs.
/// @throw NotSweepable "surface.stub_rows"  stubs that leave no layer for the gap; names the wall, its rows
///        and the layers.
std::vector<double> stub_heights(const topology::Model& model, std::span<const LinkingSurface> links,
                                 std::span<const GivenColumns> columns, const SizeField& size, int layers);

/// Linking surfaces with breaks at given nodes.
struct KeptNodes {
    std::vector<LinkingSurface> links;
    std::vector<std::string> notes{}; ///< a line for each rim whose nodes are not kept
};

/// Use the rim nodes of faces that keep their mesh as nodes of the sweep: each becomes a break of the
/// segments, and the interval between two breaks is one side of a quad.
///
/// Nodes of columns correspond to each other. Other nodes of the two ends are paired in order if their
/// numbers between side lines, or between corners, are equal; otherwise those of the source stay and a note
/// counts those of the target. If only one end has given nodes, the other end follows it.
/// @param columns  of each linking surface.
/// @param wedges   triangles of both ends are kept like quads.
KeptNodes keep_given_nodes(const topology::OpenVolume& volume, std::span<const GivenColumns> columns,
                           std::vector<LinkingSurface> links, bool wedges = false);

} // namespace lacuna::surface
