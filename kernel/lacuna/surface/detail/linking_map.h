// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/projector.h>

#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace lacuna::surface {

/// A point of a wall.
struct WallPosition {
    FaceId face;
    FacetPosition at;
};

/// Points at positions: on the exact faces or on the facets. All points of a face are evaluated in one call,
/// because exact surfaces are in another process.
std::vector<Vec3> points_at(const topology::Model& model, std::span<const WallPosition> places,
                            bool exact = true);

/// The points of a side line, the shares of its length at which they lie, and their coordinates t.
struct LineHeights {
    std::vector<Vec3> points;
    std::vector<double> shares, heights;
};

/// A linking surface mapped onto a strip. The coordinate s runs around the linking surface from 0 to 1 and is
/// periodic. The coordinate t increases from 0 on the source rim to 1 on the target rim.
///
/// At first both coordinates are harmonic functions (mean value weights). The segments prescribe their values
/// on the rims. On each side line, s is constant, and t is the share of the line's length; but where walls
/// bend, t on the lines is harmonic too, so that layers run straight across the bend, although the line on
/// its inside is shorter. The map is one to one (Tutte) for any arrangement of wall faces: stacked, side by
/// side, or with seams that do not line up.
///
/// On the inner side of a bend, lines of constant harmonic s lie close together. If the walls are not
/// straight, s is therefore replaced by a share of length along each section. Section: a line of constant t.
/// - With side lines, s is a share of the length from one side line to the next.
/// - Without side lines, s is a share of the length from the start of the section. The starts of all sections
///   follow from a frame that is moved along the sweep with minimal rotation. If the rims prescribe another
///   rotation, the difference is spread evenly over the length.
class LinkingMap {
public:
    /// @param void_edges  whether the rings and uprights include edges between void faces.
    LinkingMap(const topology::OpenVolume& volume, const LinkingSurface& link, bool void_edges = true,
               const RunContext& context = {});

    /// Whether the map was made for the linking surface as it is now.
    [[nodiscard]] bool is_of(const topology::OpenVolume& volume, const LinkingSurface& link,
                             bool void_edges) const
    {
        return model_ == &volume.model && void_edges_ == void_edges && given_branch_ == link.branch &&
               segments_ == link.segments;
    }

    [[nodiscard]] WallPosition locate(double s, double t) const
    {
        std::size_t near = kNoIndex;
        return locate(s, t, near);
    }
    /// As above, for a sequence of positions.
    /// @param near  triangle of the previous position, kNoIndex for the first one; updated
    [[nodiscard]] WallPosition locate(double s, double t, std::size_t& near) const;

    /// Coordinates (s, t) of a model point on the walls; s modulo 1.
    [[nodiscard]] Vec2 place_of(Index point) const { return upright(strip_.at(point)); }

    /// The t at a share of the walls' length from source to target (averaged over the columns), and the
    /// inverse. They are equal if t is the share of the side lines' length; the harmonic t increases faster
    /// where the walls are narrow.
    [[nodiscard]] double from_even(double height) const;
    [[nodiscard]] double to_even(double t) const;
    /// The t at a share of a side line's length, and the inverse.
    [[nodiscard]] double on_line(std::size_t line, double share) const;
    [[nodiscard]] double share_of_line(std::size_t line, double t) const;
    /// As `LinkingSurface::branch`, by the segments of the linking surface [turns].
    [[nodiscard]] double target_branch() const { return branch_; }

    /// Rotation of the frames that are moved with minimal rotation, relative to the harmonic s [turns]: at
    /// the target, and the maximum over all sections.
    [[nodiscard]] double turn() const { return turn_; }
    [[nodiscard]] double most_turned() const { return most_turned_; }
    /// Whether the line through the centres of the sections bends.
    [[nodiscard]] bool bends() const { return bends_; }

    /// A piece of an edge in the strip.
    struct Piece {
        Vec2 a, b; ///< (s, t) of its ends
        EdgeId edge;
        double from = 0, to = 1; ///< fractions of the edge's length at its ends
    };
    /// Ring: connected edges between stacked faces, which run around the linking surface. A layer must follow
    /// them.
    struct Ring {
        double height = 0; ///< mean t
        std::vector<Piece> pieces;
        std::vector<VertexId> vertices;
    };
    [[nodiscard]] const std::vector<Ring>& rings() const { return rings_; }
    /// Upright: an edge between two walls that runs more along the sweep than around it, and is not a side
    /// line.
    struct Upright {
        EdgeId edge;
        std::vector<Piece> pieces;
    };
    [[nodiscard]] const std::vector<Upright>& uprights() const { return uprights_; }
    /// The mean lengths of the linking surface in space: around the walls, for s from 0 to 1, and along the
    /// sweep, for t from 0 to 1. They give the strip its proportions.
    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] double height() const { return height_; }

    /// The crossing of a ring with a column.
    struct Crossing {
        double t = 0;
        EdgeId edge;
        double at = 0; ///< fraction of the edge's length
    };
    /// The crossings of a ring with the line of constant s, from lowest to highest; usually one.
    [[nodiscard]] static std::vector<Crossing> crossings(const Ring& ring, double s);

private:
    void measure_heights(const topology::Model& model);
    void measure_columns(const topology::Model& model, const LinkingSurface& link, const RunContext& context);
    /// The harmonic s of column s at height t, and the inverse.
    [[nodiscard]] double harmonic(double s, double t) const;
    [[nodiscard]] Vec2 upright(const Vec2& place) const;
    void find_rings(const topology::OpenVolume& volume, const LinkingSurface& link,
                    const std::vector<std::array<Vec2, 3>>& corners, bool void_edges);

    const topology::Model* model_;
    bool void_edges_;
    std::optional<double> given_branch_;
    std::vector<RimSegment> segments_;
    std::unordered_map<Index, Vec2> strip_; ///< (s, t) of the walls' points
    FacetSet facets_;
    std::vector<Vec3> flat_;      ///< corners of the triangles of the tree, three each
    std::vector<Index> original_; ///< for each triangle of the tree, the triangle of the linking surface
    double width_ = 1, height_ = 1;
    double branch_ = 0;
    std::vector<double> even_;       ///< share of the walls' length at even steps of t; empty: equal to t
    std::vector<LineHeights> lines_; ///< for each side line; empty: t is the share
    double turn_ = 0, most_turned_ = 0;
    bool bends_ = false;
    std::vector<double> row_at_;               ///< t of each row of `columns_`
    std::vector<std::vector<double>> columns_; ///< for each row, harmonic s at even s; empty: identity
    geometry::FacetTree tree_;
    std::vector<Ring> rings_;
    std::vector<Upright> uprights_;
};

/// The map of a linking surface. It is kept in `link.map` and computed again only if the segments have
/// changed, because a sweep needs it up to seven times. Parameters are those of the constructor.
std::shared_ptr<const LinkingMap> map_of(const topology::OpenVolume& volume, const LinkingSurface& link,
                                         bool void_edges = true, const RunContext& context = {});

/// For a linking surface without side lines: map the walls to a strip with the least shear between both
/// chains.
/// @return  the position on the target chain that corresponds to the start of the source chain [running
///         length], and the branch (`LinkingSurface::branch`) [turns].
std::pair<double, double> unguided_target(const topology::OpenVolume& volume, const LinkingSurface& link,
                                          const RunContext& context = {});

/// The edges between stacked or adjacent walls of a linking surface, except its rims and side lines.
/// @param void_edges  whether edges between two void faces are included.
std::vector<topology::EdgeUse> edges_between(const topology::Model& model, const LinkingSurface& link,
                                             bool void_edges);

/// Whether the walls of a linking surface consist of nearly parallel straight lines.
bool runs_straight(const topology::Model& model, const LinkingSurface& link);

/// The coordinate s in [0, 1] of a position on the target rim, as the linking surface's segments prescribe
/// it.
/// @param target_at  running length on the target chain.
double target_coordinate(const LinkingSurface& link, double target_at);

} // namespace lacuna::surface
