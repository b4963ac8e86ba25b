// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/size_field.h>

#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// Given nodes that lead up from one rim and end before the other: those of a wall that covers only part of
/// the height.
struct GivenStub {
    bool from_target = false;  ///< it hangs from the target's rim; else it stands on the source's
    double at = 0;             ///< running length on the chain of that rim
    FaceId wall;               ///< that it is of, or one of two that it is between
    std::vector<Index> points; ///< model points from the rim on
    std::vector<FaceId> faces; ///< wall of each quad up to the next stub round the ring, from the rim on
};

/// Columns of given nodes on the walls of a linking surface, from the source rim to the target rim. Column c
/// and the next one, round the ring, have given quads between them where `faces[c]` names their walls; a
/// column without is a side line.
struct GivenColumns {
    int rows = 0;                           ///< quads in every column; 0: there are no columns
    bool quads = false;                     ///< some columns have quads between them
    std::vector<double> source_at;          ///< running lengths on the source chain, rising
    std::vector<double> target_at;          ///< and on the target chain, below its length
    std::vector<std::vector<Index>> points; ///< rows + 1 model points of each column, from the source
    std::vector<std::vector<FaceId>> faces; ///< wall of each quad up to the next column; empty: none there
    std::vector<GivenStub> stubs;           ///< in order of their running lengths, the source's first
};

/// Read the meshes that walls came with as rows and columns, by walking from each side of the source rim over
/// opposite sides of quads to the target rim. What ends before it, from either rim, is stubs. Side lines of
/// walls without quads are columns where all have as many nodes.
/// @param layers  asked for; 0: any. Side lines with another number of nodes are then no columns.
/// @param notes   out: a line for each wall or side line whose nodes are not kept.
/// @return  for each linking surface; all that have columns have the same number of rows.
/// @throw NotSweepable "surface.wall_rows"  walls whose quads make different numbers of rows, or stubs of as
///                     many rows as whole walls have; "surface.wall_not_rows"  quads that are in no row;
///                     names the walls, and the first quad.
/// @note  O(quads).
std::vector<GivenColumns> given_columns(const topology::OpenVolume& volume,
                                        std::span<const LinkingSurface> links, int layers,
                                        std::vector<std::string>& notes);

/// Shares of the way up of the columns' nodes, rows + 1 numbers from 0 to 1, the mean over all columns.
/// Empty without columns.
std::vector<double> given_heights(const topology::Model& model, std::span<const GivenColumns> columns);

/// The same for walls whose quads end before the target, or before the source: stubs at one place make one
/// column, and what they leave open is divided evenly.
/// @param links   with the segments that say what is above what.
/// @param layers  0: as many as the tallest stubs and the size of what they leave open ask for.
/// @return  empty without stubs.
/// @throw NotSweepable "surface.stub_rows"  stubs that leave no layer for what they leave open; names the
///                     wall, its rows and the layers.
std::vector<double> stub_heights(const topology::Model& model, std::span<const LinkingSurface> links,
                                 std::span<const GivenColumns> columns, const SizeField& size, int layers);

/// Make the nodes of the rims of faces that keep their mesh nodes of the sweep: each becomes a break of the
/// segments, and what lies between two is one side of a quad.
///
/// Nodes of columns go to the nodes above them. Otherwise the nodes of both ends are paired in order where
/// there are as many between side lines, or between corners; where there are not, those of the source stay
/// and a note counts those of the target. Nodes that one end alone has lead the other.
/// @param columns  of each linking surface.
/// @param wedges   the triangles of both ends stay as their quads do.
/// @param notes    out: a line for each rim whose nodes are not kept.
void keep_given_nodes(const topology::OpenVolume& volume, std::span<const GivenColumns> columns,
                      std::vector<LinkingSurface>& links, std::vector<std::string>& notes,
                      bool wedges = false);

} // namespace lacuna::surface
