// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>
#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/shape_size.h>
#include <lacuna/surface/shared/walls.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// How source faces are meshed.
enum class QuadStyle {
    /// Kept if the face has given quads; else mapped or submapped if opposite sides are similar; else free.
    automatic,
    kept,   ///< the face's own quads are kept; an error if it has none
    mapped, ///< mapped or submapped; an error if that is impossible
    free,   ///< filled by the planar mesher
};

/// A part of an edge with its own number of sides.
struct SeedPiece {
    double from = 0, to = 1; ///< the part of the edge, as fractions of its length in the edge's direction
    double length = 0;       ///< length of the piece [model length]
    int count = 1;           ///< number of sides, >= 1
    /// Number of sides that size and curvature require, before rounding and interval assignment, > 0.
    double sides = 1;
    int least = 1; ///< minimum number of sides required by curvature, >= 1
    /// Set if the size varies along the piece. For each of a series of even steps: the number of sides that
    /// the size requires from the start up to there. Nodes divide the last of these numbers evenly. Empty:
    /// nodes are evenly spaced.
    std::vector<double> wanted{};
    /// Turn of the target's rim opposite to the piece, at even steps from the start [radian]. Empty: unknown.
    std::vector<double> opposite{};
    std::vector<double> kept{}; ///< if `fixed`: given nodes inside, as fractions of the edge
    /// Positions of inner nodes, as fractions of the edge, for which the lines of mapped faces are square to
    /// the edge. Empty: `wanted` determines the positions.
    std::vector<double> placed{};
    /// As `placed`, for the corresponding nodes on the target's rim. Empty: they have the positions of the
    /// source's nodes.
    std::vector<double> placed_above{};
    bool fixed = false; ///< whether number and positions of nodes are given or requested, and must not change
    bool asked = false; ///< if `fixed`: whether the user requested them
    bool bends = false; ///< whether curvature requires more sides than the size
    /// Whether both ends of the piece are vertices of facets, and the edge hardly bends between them.
    bool follows = false;
    /// Positions of the nodes where rows of boundary layers end near the start and near the end, as fractions
    /// of the edge.
    std::vector<double> low{}, high{};

    /// Number of rows that end on the piece.
    [[nodiscard]] int rows() const { return static_cast<int>(low.size() + high.size()); }
    /// Number of sides that are not part of these rows.
    [[nodiscard]] int between() const { return count - rows(); }
    /// Fractions of the edge at the piece's nodes, including its start but not its end.
    [[nodiscard]] std::vector<double> fractions() const;
    /// Relative positions of the piece's nodes in the direction of an edge use, from 0 to below 1.
    [[nodiscard]] std::vector<double> shares(bool reversed) const;
    /// As `shares()`, for the images of the nodes on the target's rim.
    [[nodiscard]] std::vector<double> shares_above(bool reversed) const;
};

/// A number of sides for consecutive parts of the source's rim.
struct SidesAsked {
    struct Part {
        EdgeId edge;
        double from = 0, to = 1; ///< fractions of the edge's length, in its direction
        bool reversed = false;   ///< whether the parts are listed against the direction of the edge
    };
    std::vector<Part> parts;
    int count = 1;   ///< total number of sides of all parts; each part gets at least one
    double bias = 1; ///< ratio of last to first side, > 0 [-]
    Argument name;   ///< origin, for messages
};

/// Requests on the source's edges and faces besides a size.
struct EdgeDemands {
    RimRows rows;
    std::vector<SidesAsked> sides;
    /// Faces that keep their quads whatever the style is, because a neighbour has the same quads.
    std::set<FaceId> kept;
};

/// Numbers of sides on every edge of the source faces (interval assignment). Opposite sides of a mapped face
/// have equal numbers, the sides of a submapped face have equal totals in opposite directions, and a free
/// face has an even total.
struct Seeds {
    std::map<EdgeId, std::vector<SeedPiece>> pieces; ///< in order along the edge
    /// For each mapped face: the indices of the four edge uses that start a side.
    std::map<FaceId, std::vector<std::size_t>> corners;
    std::set<FaceId> submapped;     ///< faces meshed as a grid of right angles
    std::set<FaceId> kept;          ///< faces whose own quads are kept
    RimRows rows;                   ///< rows of boundary layers along the rim
    std::vector<std::string> notes; ///< a line for each given mesh that is not kept
    [[nodiscard]] int count(EdgeId edge) const;
    /// Positions of the nodes of an edge as fractions, including both ends.
    [[nodiscard]] std::vector<double> fractions(EdgeId edge) const;
    /// The index of the piece of the source edge that contains a rim segment.
    [[nodiscard]] std::size_t piece_of(const LinkingSurface& link, const RimSegment& segment) const;
    /// The nodes of a linking surface on both rims.
    [[nodiscard]] LinkingNodes nodes(const LinkingSurface& link) const;
};

/// Assign numbers of sides to the edges of the source (interval assignment), in five steps.
///
/// 1. Each edge requests the number of sides that the size requires or, if that is larger, the curvature: a
///    full turn of an edge gets `sizing.curvature` sides. If the target's rim turns more than the source's,
///    the excess counts as well. Bends of a polyline count as those of the curve that it approximates, unless
///    they are sharp. With `curvature` 0 only the size counts, but a side spans at most a sixth of a turn. If
///    size or curvature vary along an edge, so does the spacing of its nodes. Edges of faces that keep their
///    own quads have the nodes of these quads.
///
/// 2. One integer program covers all edges of mapped and submapped faces, of free faces that share an edge
///    with these, and of sectors that share an edge with any free face. It minimizes Σ (n − wanted)² / n over
///    the edges' pieces and three lines across each mapped face, with a penalty for sides outside the
///    accepted range of lengths. Opposite sides get equal numbers, and no piece gets fewer sides than its
///    minimum. A free face of three sides is filled by three grids around a node, and a half disc by two such
///    patterns. Any other face of two sides is filled by a grid with two of its corners inside. All other
///    free faces get an even total.
///
///    Two more terms concern a face with one round side. Along this side, rows should have a total depth of a
///    third of the radius. The line behind these rows should have as many sides as its length requires.
///    Lengths are measured in space, so a face that bulges or narrows between its sides gets the numbers that
///    its interior needs. A mapped face becomes free if its given sides contradict each other, or if its grid
///    would have poor angles or lengths in space.
///
/// 3. Of the remaining free faces, those that one grid can fill get numbers for which the grid closes
///    (`quads::pattern_counts()`). They are treated one after the other and keep the numbers found so far.
///    Faces with the most loops come first, because their loops must agree.
///
/// 4. A second program over all edges of the source makes the total of every free face even, with the least
///    change.
///
/// 5. Where lines of a grid are oblique to the sides of a mapped face, the nodes on these sides move along
///    them. If the sections of the volume differ, such nodes get other positions on the target.
///
/// @param sizing   sides for a full turn, and the gap. With a gap, the size already includes it, and faces
///         are submapped only on request. With `counts_across` the size does not include it: the sides of
///         mapped faces get at least as many quads as the gap requires, and faces may be submapped.
/// @param lengths  lengths of the images of edges, if known [model length]. If the image is longer than the
///         edge, the edge gets the sides that its image needs.
/// @param wedges   whether triangles are kept like quads, and a rim with an odd number of given sides stays
///         odd.
/// @param demands  rows of boundary layers, whose heights become nodes of the edges where they end; and
///         numbers of sides, which are binding.
/// @throw NotSweepable "surface.layers_room"  an edge is too short for the rows that end on it;
///         "surface.sides_asked"  requested numbers of sides contradict each other, a given mesh or rows, or
///         make a face's total odd; names both with their numbers; "surface.given_triangles"  a face has
///         given quads and triangles, and `wedges` is not set; counts both.
/// @throw NotSweepable  a face to be kept has other cells than quads, or its rim has no node opposite to a
///         corner of the other end; a face to be mapped has neither four sides nor right angles only; or a
///         face's total cannot be made even. The message names the faces.
Seeds seed_source(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                  const SizeField& size, QuadStyle style, const ShapeSizing& sizing = {},
                  const std::map<EdgeId, double>& lengths = {}, bool wedges = false,
                  const EdgeDemands& demands = {}, const RunContext& context = {});

} // namespace lacuna::surface
