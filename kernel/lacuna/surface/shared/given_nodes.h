// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>

#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// Given nodes that start at one rim and end before the other rim. They belong to a wall that covers only a
/// part of the height.
struct GivenStub {
    bool from_target = false;  ///< whether it starts at the target's rim; otherwise at the source's
    double at = 0;             ///< running length on the chain of that rim
    FaceId wall;               ///< the wall of the stub; if it is between two walls, one of them
    std::vector<Index> points; ///< model points, starting at the rim
    /// For each quad between this stub and the next one around the ring: the wall of this quad. Starts at the
    /// rim.
    std::vector<FaceId> faces;
};

/// Given nodes from the source rim to the target rim.
struct GivenColumn {
    double source_at = 0;      ///< running length on the source chain
    double target_at = 0;      ///< running length on the target chain, modulo its length
    std::vector<Index> points; ///< rows + 1 model points, from the source
    /// For each quad between this column and the next one around the ring: the wall of this quad. Empty if
    /// there are no quads.
    std::vector<FaceId> faces;
};

/// Columns of given nodes on the walls of a linking surface. A column without quads is a side line.
struct GivenColumns {
    int rows = 0;                   ///< number of quads in every column; 0: there are no columns
    bool quads = false;             ///< whether some columns have quads between them
    std::vector<GivenColumn> whole; ///< in increasing order of `source_at`
    /// First the stubs from the source, then those from the target, each in order of `at`.
    std::vector<GivenStub> stubs;
};

/// Rows and columns of the given wall meshes.
struct GivenRows {
    /// For each linking surface. All of them have the same number of rows, or no columns.
    std::vector<GivenColumns> columns;
    std::vector<std::string> notes{}; ///< a line for each wall or side line whose nodes are not kept
};

/// Read the meshes of given walls as rows and columns. The columns are found by walking from each side of the
/// source rim over opposite sides of quads to the target rim. A column that starts at one rim and ends before
/// the other rim is a stub. If no wall has quads, side lines are columns, provided that all of them have the
/// same number of nodes.
/// @param layers  requested number of layers; 0: any number. Side lines with another number of sides are not
///         used as columns.
/// @throw NotSweepable "surface.wall_rows"  quads of walls form different numbers of rows, or stubs have as
///         many rows as whole walls; "surface.wall_not_rows"  a quad is in no row. The message names the
///         walls, and the first such quad.
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

/// Use the rim nodes of faces that keep their mesh as nodes of the sweep. Each node ends a segment, and the
/// segment between two such nodes is one side of a quad.
///
/// Nodes of one column correspond to each other. Other nodes of the two rims are paired in order if both rims
/// have the same number of nodes between two side lines or two corners. Otherwise the nodes of the source are
/// kept, and a note counts the nodes of the target that are not kept. If only one rim has given nodes, the
/// other rim gets nodes opposite to them.
/// @param columns  given columns of each linking surface.
/// @param wedges   whether triangles of both ends are kept like quads.
KeptNodes keep_given_nodes(const topology::OpenVolume& volume, std::span<const GivenColumns> columns,
                           std::vector<LinkingSurface> links, bool wedges = false);

} // namespace lacuna::surface
