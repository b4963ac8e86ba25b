// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/boundary_layers.h>
#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/shape_size.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/surface/walls.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// How source faces are meshed.
enum class QuadStyle {
    automatic, ///< kept where it came with quads, mapped or submapped where sides are alike, else free
    kept,      ///< its own quads, or an error
    mapped,    ///< mapped or submapped, or an error
    free,      ///< by the planar mesher
};

/// A part of an edge with its own number of sides.
struct SeedPiece {
    double from = 0, to = 1; ///< fractions of the edge's length, as the edge runs
    double length = 0;       ///< [model length]
    int count = 1;           ///< sides, >= 1
    double sides = 1;        ///< as many as are asked for, before they are made to agree and whole, > 0
    int least = 1;           ///< sides that its curvature needs, >= 1
    /// Where the size asked for changes along the piece: the number of sides it asks for from the start to
    /// each of some even steps. Nodes divide that number evenly. Empty: nodes stand evenly.
    std::vector<double> wanted{};
    /// How much the rim it is swept to turns along it, at even steps from the start [radian]. Empty: unknown.
    std::vector<double> opposite{};
    std::vector<double> kept{}; ///< nodes inside that were given, as fractions of the edge; with `fixed`
    /// Nodes inside where the lines of mapped faces meet the edge best, as fractions. Empty: by `wanted`.
    std::vector<double> placed{};
    /// The same of what they are swept to on the target's rim, as if on this piece. Empty: as on the source.
    std::vector<double> placed_above{};
    bool fixed = false;   ///< the nodes of a given mesh, or asked for: none more, none less
    bool asked = false;   ///< with `fixed`: by a person
    bool bends = false;   ///< its bends asked for more sides than the size
    bool follows = false; ///< its ends are vertices of facets that hardly bend between them
    /// Nodes near the start and the end on which rows of boundary layers end, as fractions of the edge.
    std::vector<double> low{}, high{};

    /// Sides that rows leave between `low` and `high` or the ends.
    [[nodiscard]] int between() const { return count - static_cast<int>(low.size() + high.size()); }
    /// Fractions of the edge at the piece's nodes, its start included, its end not.
    [[nodiscard]] std::vector<double> fractions() const;
    /// Shares of the piece at its nodes as a use of the edge meets them, from 0, below 1.
    [[nodiscard]] std::vector<double> shares(bool reversed) const;
    /// The same of what they are swept to, on the target's rim.
    [[nodiscard]] std::vector<double> shares_above(bool reversed) const;
};

/// A number of sides for parts of the source's rim that follow each other.
struct SidesAsked {
    struct Part {
        EdgeId edge;
        double from = 0, to = 1; ///< fractions of its length, as it runs
        bool reversed = false;   ///< the parts' walk runs against the edge
    };
    std::vector<Part> parts;
    int count = 1;    ///< over all parts, >= one each
    double bias = 1;  ///< last over first side, > 0 [-]
    std::string name; ///< who asks, for messages
};

/// What is asked of the source's edges and faces besides a size.
struct EdgeDemands {
    RimRows rows;
    std::vector<SidesAsked> sides;
    std::set<FaceId> kept; ///< faces whose quads stay whatever the style, for a neighbour has them too
};

/// Numbers of sides on every edge of the source faces, made to agree (interval assignment): equal on opposite
/// sides of a mapped face, as many each way as back on a submapped one, an even number in all on a free one.
struct Seeds {
    std::map<EdgeId, std::vector<SeedPiece>> pieces; ///< in order along the edge
    /// Of mapped faces: the four uses of the loop that start a side.
    std::map<FaceId, std::vector<std::size_t>> corners;
    std::set<FaceId> submapped;     ///< faces whose counts are those of a grid of right angles
    std::set<FaceId> kept;          ///< faces whose own quads are the mesh
    RimRows rows;                   ///< of boundary layers, along the rim
    std::vector<std::string> notes; ///< a line for each given mesh that could not stay
    [[nodiscard]] int count(EdgeId edge) const;
    /// Fractions of the edge's nodes, both ends included.
    [[nodiscard]] std::vector<double> fractions(EdgeId edge) const;
    /// The piece, among those of its edge, that a segment of a rim is.
    [[nodiscard]] std::size_t piece_of(const LinkingSurface& link, const RimSegment& segment) const;
    /// The nodes of a linking surface, on the source's rim and on the target's.
    [[nodiscard]] LinkingNodes nodes(const LinkingSurface& link) const;
};

/// Assign numbers of sides to the edges of the source: by the size, or by the curvature where it wants more.
///
/// A full turn of an edge gets `sizing.curvature` sides, and so does what the part of the target's rim it is
/// swept to turns more. The bends of a polyline count as the curve they stand for, unless they are sharp.
/// With 0 the size alone decides, but a side stands for no more than a sixth of a turn. Edges of faces that
/// keep their own quads have the nodes of those. Where size or curvature change along an edge its nodes
/// follow. A free face that one grid fills gets numbers for which it closes (`quads::pattern_counts()`).
///
/// Mapped and submapped faces, free ones that share an edge with them, and sectors that share one with any
/// free face, are solved together, as one program of whole numbers over all their edges:
///   least Σ (n − wanted)² / n  over the edges' pieces and three lines across each mapped face, and more for
///   sides of another size, so that opposite sides have as many and no piece fewer than it needs; so that a
///   free face of three sides is three grids round a node, a half disc two such, another of two sides a grid
///   with two corners inside it, and any other has an even number in all.
/// A face with one round side is to have rows a third of its radius deep along it, and the line behind these
/// as many sides as its length asks for: the two are terms of the sum as well.
/// Lengths are those in space, so a face that bulges between its sides, or is narrower there, gets what its
/// inside needs. Where given numbers contradict each other, sides are raised to the larger count, a face at a
/// time until nothing changes. A face whose grid would be poor all over, by its angles and lengths in space,
/// is free. Free faces then get the counts of a grid one after the other, with what others have settled;
/// those with the most loops first, for their loops must agree. Last, each free face with an odd total gets
/// one more side on a rim edge of its own, or on an edge towards one; a mapped face between passes it on.
/// Then nodes on the sides of mapped faces move along them, where the grid's lines are oblique to them; on
/// the target otherwise than on the source where the way between bends another way.
/// @param sizing  sides for a full turn; with a gap no face is submapped that need not be, unless
///                `counts_across` is set: then the sides of mapped faces get the gap's quads at least. The
///                rest of it is in the size already.
/// @param lengths  of what an edge is swept to, where that is known [model length]: one that is longer there
///                 gets the sides it needs there.
/// @param wedges   triangles are a mesh as quads are, and a rim of an odd number of given sides stays.
/// @param demands  rows of boundary layers, whose heights become nodes of the edges they end on; and numbers
///                 of sides, which are kept to.
/// @throw NotSweepable "surface.layers_room"  an edge too short for the rows that end on it.
///        "surface.sides_asked"  numbers of sides that contradict each other, a given mesh or rows, or that
///        make a face's total odd; names both with their counts.
/// @throw NotSweepable "surface.given_triangles"  a face that came with quads and triangles, without
///                      `wedges`; counts both.
/// @throw NotSweepable  a face to be kept that has not quads all over, or whose rim has no node where the
///                      other end has a corner; a face to be mapped that has neither four sides nor right
///                      angles alone; a face whose total cannot be made even; names them.
Seeds seed_source(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                  const SizeField& size, QuadStyle style, const ShapeSizing& sizing = {},
                  const std::map<EdgeId, double>& lengths = {}, bool wedges = false,
                  const EdgeDemands& demands = {}, const RunContext& context = {});

} // namespace lacuna::surface
