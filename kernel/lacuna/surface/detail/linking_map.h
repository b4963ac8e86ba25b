// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/facet_tree.h>
#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/projector.h>

#include <utility>
#include <vector>

namespace lacuna::surface {

/// A point of a wall.
struct WallPosition {
    FaceId face;
    FacetPosition at;
};

/// A linking surface mapped onto a strip: s runs round it from 0 to 1 and closes on itself, t rises from 0 on
/// the source rim to 1 on the target rim.
///
/// Both coordinates are harmonic (mean value weights). They are given on the rims, by their segments, and on
/// the side lines, which are upright. So the map is one to one (Tutte) whatever faces the walls are made of:
/// stacked, in rows, with seams that do not line up.
///
/// Lines of one harmonic s crowd on the inner side of a bend. So where the walls are not straight, s is the
/// share of the length round a section, which is a line of one t, or from one side line to the next. Without
/// side lines sections are turned against each other as frames that are moved from one to the next with the
/// least rotation. Where the rims tell another turn, the rest is spread evenly over the way.
class LinkingMap {
public:
    /// @param void_edges  edges between void faces are among the rings and uprights.
    LinkingMap(const topology::OpenVolume& volume, const LinkingSurface& link, bool void_edges = true,
               const RunContext& context = {});

    [[nodiscard]] WallPosition locate(double s, double t) const;

    /// Where a model point of the walls lies; s but for whole turns.
    [[nodiscard]] Vec2 place_of(Index point) const { return upright(strip_.row(point).transpose()); }

    /// t at a share of the walls' length from source to target, in the mean over the columns. Where there are
    /// side lines t is that share already; without them a harmonic t rises faster where the walls are narrow.
    [[nodiscard]] double from_even(double height) const;
    /// s of the target end of the shortest way up a linking surface without side lines, with whole turns
    /// counted.
    [[nodiscard]] double target_branch() const { return branch_; }

    /// How far frames moved with the least rotation have turned against the rims' segments: on the target,
    /// and in the section where it is most [turns].
    [[nodiscard]] double turn() const { return turn_; }
    [[nodiscard]] double most_turned() const { return most_turned_; }
    [[nodiscard]] bool bends() const { return bends_; } ///< the way through the sections' middles

    /// A piece of an edge in the strip.
    struct Piece {
        Vec2 a, b; ///< (s, t) of its ends
        EdgeId edge;
        double from = 0, to = 1; ///< shares of the edge's length at its ends
    };
    /// Edges that run round the linking surface, between faces stacked on each other: where a layer is to
    /// lie.
    struct Ring {
        double height = 0; ///< mean t
        std::vector<Piece> pieces;
        std::vector<VertexId> vertices;
    };
    [[nodiscard]] const std::vector<Ring>& rings() const { return rings_; }
    /// An edge between two walls that climbs more than it runs round, and is part of no side line.
    struct Upright {
        EdgeId edge;
        std::vector<Piece> pieces;
    };
    [[nodiscard]] const std::vector<Upright>& uprights() const { return uprights_; }
    /// The strip's own proportions: lengths in space of a whole s and a whole t, in the mean.
    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] double height() const { return height_; }

    /// Where a ring crosses a column.
    struct Crossing {
        double t = 0;
        EdgeId edge;
        double at = 0; ///< share of the edge's length
    };
    /// The places where a ring crosses the column at s, from lowest to highest; usually one.
    [[nodiscard]] static std::vector<Crossing> crossings(const Ring& ring, double s);

private:
    void measure_heights(const topology::Model& model);
    void measure_columns(const topology::Model& model, const LinkingSurface& link, const RunContext& context);
    /// The harmonic s of column s at height t, and a harmonic place as one of columns.
    [[nodiscard]] double harmonic(double s, double t) const;
    [[nodiscard]] Vec2 upright(const Vec2& place) const;
    void find_rings(const topology::OpenVolume& volume, const LinkingSurface& link,
                    const std::vector<std::array<Vec2, 3>>& corners, bool void_edges);

    Eigen::MatrixXd strip_; ///< (s, t) of every model point
    std::vector<FaceId> face_of_;
    std::vector<Index> triangle_of_;
    std::vector<Index> original_; ///< triangle of the linking surface behind each triangle of the tree
    double width_ = 1, height_ = 1;
    double branch_ = 0;
    std::vector<double> even_; ///< share of the way up at equal steps of t; empty with side lines
    double turn_ = 0, most_turned_ = 0;
    bool bends_ = false;
    std::vector<double> row_at_;               ///< t of rows of columns
    std::vector<std::vector<double>> columns_; ///< of each row harmonic s at even steps of s; empty: the same
    geometry::FacetTree tree_;
    std::vector<Ring> rings_;
    std::vector<Upright> uprights_;
};

/// Where on the target chain of a linking surface without side lines the source chain's start belongs, so
/// that the strip is sheared least [running length], and the branch of that: see `LinkingSurface::branch`.
std::pair<double, double> unguided_target(const topology::OpenVolume& volume, const LinkingSurface& link,
                                          const RunContext& context = {});

/// Whether the walls of a linking surface are straight lines beside each other, all about one way.
bool runs_straight(const topology::Model& model, const LinkingSurface& link);

/// s in [0, 1] of a running length of the target chain, by the linking surface's segments.
double target_coordinate(const LinkingSurface& link, double target_at);

} // namespace lacuna::surface
