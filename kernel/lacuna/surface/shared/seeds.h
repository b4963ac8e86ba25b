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
    rows,   ///< as `free`, but several loops get numbers of sides for a pattern: equal ones if concentric
};

/// A part of an edge with its own number of sides.
struct SeedPiece {
    double from = 0, to = 1; ///< the part of the edge, as fractions of its length in the edge's direction
    double length = 0;       ///< length of the piece [model length]
    int count = 1;           ///< number of sides, >= 1
    /// Number of sides that size and curvature require, before rounding and interval assignment, > 0.
    double sides = 1;
    int least = 1; ///< minimum number of sides required by curvature, >= 1
    /// If size or curvature vary along the piece: the number of sides, not rounded, that they require from
    /// the start of the piece up to each of several even steps. The mesh nodes lie where this number has
    /// equal increments. Empty: nodes are evenly spaced.
    std::vector<double> wanted{};
    /// If the piece is on the rim: the piece is divided into even steps. For each step, the turn of the
    /// target's rim along its image [radian]. Empty otherwise.
    std::vector<double> opposite{};
    std::vector<double> kept{}; ///< if `fixed`: given nodes inside, as fractions of the edge
    /// Positions of inner nodes, as fractions of the edge, after `square_mapped_lines()` has moved them.
    /// Empty: not moved.
    std::vector<double> placed{};
    /// As `placed`, for the corresponding nodes on the target's rim. Empty: they have the same fractions as
    /// the source's nodes.
    std::vector<double> placed_above{};
    bool fixed = false; ///< whether number and positions of nodes are given or requested, and must not change
    bool asked = false; ///< if `fixed`: whether the user requested number and positions
    bool bends = false; ///< whether curvature requires more sides than the size
    /// As `RimSegment::follows`. The turn of the edge then requires no sides.
    bool follows = false;
    /// Nodes at which rows of boundary layers end, near the start (`low`) and near the end (`high`) of the
    /// piece, as fractions of the edge.
    std::vector<double> low{}, high{};

    /// Number of rows that end on the piece.
    [[nodiscard]] int rows() const { return static_cast<int>(low.size() + high.size()); }
    /// Number of sides that are not part of these rows.
    [[nodiscard]] int between() const { return count - rows(); }
    /// Fractions of the edge at the piece's nodes, including its start but not its end.
    [[nodiscard]] std::vector<double> fractions() const;
    /// Positions of the piece's nodes as shares of the piece, from 0 to below 1, in the direction of an edge
    /// use.
    [[nodiscard]] std::vector<double> shares(bool reversed) const;
    /// As `shares()`, for the images of the nodes on the target's rim.
    [[nodiscard]] std::vector<double> shares_above(bool reversed) const;
};

/// A requested number of sides on consecutive parts of edges of the source.
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

/// Numbers of sides on every edge of the source faces (interval assignment). The numbers fit the faces:
/// - Mapped face: opposite sides have equal numbers.
/// - Submapped face: the sides that run in one direction of the grid have the same total as those that run
///   back.
/// - Free face: the total of all sides is even.
struct Seeds {
    std::map<EdgeId, std::vector<SeedPiece>> pieces; ///< in order along the edge
    /// For each mapped face: the indices of the four edge uses that start a side.
    std::map<FaceId, std::vector<std::size_t>> corners;
    std::set<FaceId> submapped;     ///< faces meshed as a grid of right angles
    std::set<FaceId> tubes;         ///< faces meshed as a grid round a tube (`is_tube()`)
    std::set<FaceId> kept;          ///< faces whose own quads are kept
    RimRows rows;                   ///< rows of boundary layers along the rim
    std::vector<std::string> notes; ///< for the user: given meshes and sides that are changed
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
/// 1. Each edge gets a wanted number of sides: the number that the size or the curvature requires, whichever
///    is larger. For curvature, a full turn of an edge gets `sizing.curvature` sides.
///    - If the target's rim turns more than the source's, the excess counts as well.
///    - Bends of a polyline count as those of the curve that it approximates, unless they are sharp.
///    - With `curvature` 0 only the size counts, but a side spans at most a sixth of a turn.
///    - If size or curvature vary along an edge, so does the spacing of its nodes.
///    - Edges of faces that keep their own quads have the nodes of these quads.
///
///    Then each face is classified as mapped, submapped or free. A face does not become mapped if its grid
///    would have poor angles or lengths in space.
///
/// 2. One integer program determines the numbers of sides on the edges of these faces (b and c only with
///    `QuadStyle::automatic`):
///    a. mapped and submapped faces;
///    b. free faces that share an edge with a face of a;
///    c. large sectors that share an edge with another free face. Sector: a face with three sides, one of
///       which is round (`RoundSide`).
///
///    Opposite sides of grids get equal numbers, and no piece gets fewer sides than its minimum. Free faces
///    are filled as follows: a face with three sides by three grids around an inner node; a half disc by two
///    such patterns; any other face with two sides by a grid of which two corners lie inside the face. All
///    other free faces get an even total.
///
///    The program minimizes Σ (n − wanted)² / n, with higher costs for sides outside the accepted range of
///    lengths. The sum runs over the pieces of all edges, and over lines across mapped faces (three in each
///    direction), so that a face that bulges or narrows between its sides gets the numbers that its interior
///    needs. For a sector or a half disc, further terms are added. Rows of quads run along the round side;
///    these rows should fill a third of the radius, and the round side should have as many sides as the line
///    at which these rows end needs for its length.
///
///    After the program, a mapped or submapped face becomes free if given numbers make its opposite sides
///    unequal.
///
/// 3. The other free faces that one grid can fill get numbers of sides for which this grid exists
///    (`quads::pattern_counts()`). The faces are treated one after the other, those with the most loops
///    first, because their loops constrain each other. Numbers that were found before do not change.
///
/// 4. A second program over all edges of the source makes the total of every free face even, with the least
///    change.
///
/// 5. Where lines of a grid are oblique to the sides of a mapped face, the nodes on these sides move along
///    the sides. If sections of the volume differ, such a node may get another position on the target than on
///    the source.
///
/// @param size     already reduced for `sizing.gap`, except with `sizing.counts_across`.
/// @param sizing   sides for a full turn, and the number of quads across narrow places. With
///         `counts_across`, the sides of mapped faces get at least `gap` quads. If `gap` is set without
///         `counts_across`, faces are submapped only on request.
/// @param lengths  lengths of the images of edges, if known [model length]. If the image is longer than the
///         edge, the edge gets the sides that its image needs.
/// @param wedges   whether given triangles are kept like quads. A rim with an odd number of given sides then
///         stays odd.
/// @param demands  rows of boundary layers, and binding numbers of sides. The edges on which rows end get
///         nodes at the heights of these rows.
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
