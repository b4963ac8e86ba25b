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
    automatic, ///< kept if it has given quads; mapped or submapped if opposite sides are similar; else free
    kept,      ///< its own quads, or an error
    mapped,    ///< mapped or submapped, or an error
    free,      ///< by the planar mesher
};

/// A part of an edge with its own number of sides.
struct SeedPiece {
    double from = 0, to = 1; ///< fractions of the edge's length, as the edge runs
    double length = 0;       ///< [model length]
    int count = 1;           ///< sides, >= 1
    double sides = 1;        ///< requested number, before rounding and interval assignment, > 0
    int least = 1;           ///< minimum number by curvature, >= 1
    /// If the size varies along the piece: cumulative number of sides from the start at even steps. Nodes
    /// divide that number evenly. Empty: even spacing.
    std::vector<double> wanted{};
    /// Turn of the rim it is swept to, at even steps from the start [radian]. Empty: unknown.
    std::vector<double> opposite{};
    std::vector<double> kept{}; ///< given nodes inside, as fractions of the edge; with `fixed`
    /// Positions of inner nodes that make the lines of mapped faces square to the edge, as fractions. Empty:
    /// by `wanted`.
    std::vector<double> placed{};
    /// The same on the target's rim, mapped to this piece. Empty: as on the source.
    std::vector<double> placed_above{};
    bool fixed = false;   ///< number and nodes are given or requested and must not change
    bool asked = false;   ///< with `fixed`: requested by the user
    bool bends = false;   ///< curvature requires more sides than the size
    bool follows = false; ///< its ends are vertices of facets that hardly bend between them
    /// Nodes near the start and the end where rows of boundary layers end, as fractions of the edge.
    std::vector<double> low{}, high{};

    /// Number of rows that end on it.
    [[nodiscard]] int rows() const { return static_cast<int>(low.size() + high.size()); }
    /// Number of sides between `low` and `high`, or the ends.
    [[nodiscard]] int between() const { return count - rows(); }
    /// Fractions of the edge at the piece's nodes, its start included, its end not.
    [[nodiscard]] std::vector<double> fractions() const;
    /// Relative positions of the piece's nodes in the direction of an edge use, from 0, below 1.
    [[nodiscard]] std::vector<double> shares(bool reversed) const;
    /// The same for their images on the target's rim.
    [[nodiscard]] std::vector<double> shares_above(bool reversed) const;
};

/// A number of sides for consecutive parts of the source's rim.
struct SidesAsked {
    struct Part {
        EdgeId edge;
        double from = 0, to = 1; ///< fractions of the edge's length, in its direction
        bool reversed = false;   ///< the walk over the parts runs against the edge
    };
    std::vector<Part> parts;
    int count = 1;   ///< over all parts, at least one per part
    double bias = 1; ///< last over first side, > 0 [-]
    Argument name;   ///< origin, for messages
};

/// Requests on the source's edges and faces besides a size.
struct EdgeDemands {
    RimRows rows;
    std::vector<SidesAsked> sides;
    std::set<FaceId> kept; ///< faces that keep their quads in any style, because a neighbour has them too
};

/// Numbers of sides on every edge of the source faces (interval assignment): equal on opposite sides of a
/// mapped face, equal in both directions on a submapped one, an even total on a free one.
struct Seeds {
    std::map<EdgeId, std::vector<SeedPiece>> pieces; ///< in order along the edge
    /// Of mapped faces: the four edge uses that start a side.
    std::map<FaceId, std::vector<std::size_t>> corners;
    std::set<FaceId> submapped;     ///< faces meshed as a grid of right angles
    std::set<FaceId> kept;          ///< faces whose own quads are the mesh
    RimRows rows;                   ///< rows of boundary layers along the rim
    std::vector<std::string> notes; ///< a line for each given mesh that is not kept
    [[nodiscard]] int count(EdgeId edge) const;
    /// Fractions of the edge's nodes, both ends included.
    [[nodiscard]] std::vector<double> fractions(EdgeId edge) const;
    /// The piece of the source edge to which a rim segment corresponds.
    [[nodiscard]] std::size_t piece_of(const LinkingSurface& link, const RimSegment& segment) const;
    /// The nodes of a linking surface, on the source's rim and on the target's.
    [[nodiscard]] LinkingNodes nodes(const LinkingSurface& link) const;
};

/// Assign numbers of sides to the edges of the source: by the size, or by the curvature where it requires
/// more.
///
/// A full turn of an edge gets `sizing.curvature` sides; the excess turn of the target's rim above it counts
/// as well. The bends of a polyline count as those of the curve it approximates, unless they are sharp. With
/// 0 only the size counts, but a side spans at most a sixth of a turn. Edges of faces that keep their own
/// quads have the nodes of those. If size or curvature vary along an edge, so does the spacing of its nodes.
/// A free face that one grid can fill gets counts for which the grid closes (`quads::pattern_counts()`).
///
/// Mapped and submapped faces, free faces that share an edge with them, and sectors that share one with any
/// free face, are solved together, as one integer program over all their edges:
///   minimize Σ (n − wanted)² / n  over the edges' pieces and three lines across each mapped face, with a
///   penalty for sides outside the accepted length range. Opposite sides get equal counts, and no piece gets
///   fewer than its minimum. A free face of three sides is filled by three grids around a node, a half disc
///   by two such, any other face of two sides by a grid with two of its corners inside; all others get an
///   even total.
/// A face with one round side should have rows a third of its radius deep along it, and as many sides on the
/// line behind these rows as its length requires: both are terms of the sum. Lengths are measured in space,
/// so a face that bulges or narrows between its sides gets the counts its interior needs. A face whose given
/// sides contradict each other, or whose grid would be poor by its angles and lengths in space, is free. Then
/// free faces get the counts of a grid one after the other, respecting settled edges; those with the most
/// loops first, because their loops must agree. A second program over all edges of the source makes every
/// free face's total even with the least change. Finally nodes on the sides of mapped faces
/// move along them where the grid's lines are oblique to them; on the target they get positions of their own
/// if the sections in between differ.
/// @param sizing  sides for a full turn; with a gap no face is submapped unless requested, except if
///                `counts_across` is set: then the sides of mapped faces get at least the gap's quads. The
///                rest of the gap is in the size already.
/// @param lengths  of the images of edges, if known [model length]: an edge whose image is longer gets the
///                 sides its image needs.
/// @param wedges   triangles are kept like quads, and a rim with an odd number of given sides stays.
/// @param demands  rows of boundary layers, whose heights become nodes of the edges where they end; and
///                 numbers of sides, which are binding.
/// @throw NotSweepable "surface.layers_room"  an edge too short for the rows that end on it.
///        "surface.sides_asked"  numbers of sides that contradict each other, a given mesh or rows, or that
///        make a face's total odd; names both with their counts.
/// @throw NotSweepable "surface.given_triangles"  a face that came with quads and triangles, without
///                      `wedges`; counts both.
/// @throw NotSweepable  a face to be kept that is not all quads, or whose rim has no node where the other end
///                      has a corner; a face to be mapped that has neither four sides nor right angles only;
///                      a face whose total cannot be made even; names them.
Seeds seed_source(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                  const SizeField& size, QuadStyle style, const ShapeSizing& sizing = {},
                  const std::map<EdgeId, double>& lengths = {}, bool wedges = false,
                  const EdgeDemands& demands = {}, const RunContext& context = {});

} // namespace lacuna::surface
