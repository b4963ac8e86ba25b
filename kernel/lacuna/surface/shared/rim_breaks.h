// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>

#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace lacuna::surface {

/// Vertices of facets that become nodes of the rims.
struct RimBreaks {
    /// For each linking surface, pairs of running lengths on the source's and the target's chain; empty: no
    /// breaks.
    std::vector<std::vector<std::pair<double, double>>> pairs;
    std::vector<char> on_crease; ///< for each linking surface, whether all its columns at breaks run along
                                 ///< creases
    /// Edges with such vertices inside, and the positions of these as fractions.
    std::map<EdgeId, std::vector<double>> edges;
    std::set<Index> points; ///< all such vertices
};

/// A chain of facet sides from rim to rim along the walls, followed by a column.
struct Crease {
    double source_at = 0;      ///< running length of its start on the source's chain
    std::vector<Index> points; ///< from the source's rim to the target's
};

/// Finds the vertices of coarse facets at which rims need nodes.
///
/// On a rim made of facets, breaks are the vertices that the Douglas-Peucker rule keeps (@cite
/// douglas_1973_reduction). Its tolerance is the sag of one side of an arc with the length and turn of the
/// edge. A break helps only if a crease leads from it to another rim: across an end as one side of a facet,
/// or up the walls, where a column then follows it. An edge gets no breaks if its creases lead elsewhere, or
/// if it has more such vertices than its arc has sides.
class RimFacets {
public:
    RimFacets(const topology::OpenVolume& volume, std::span<const LinkingSurface> links);

    /// @param per_turn  number of sides for a full turn, >= 1. @param size  length of sides; used where it is
    ///         larger.
    [[nodiscard]] RimBreaks breaks(int per_turn, const SizeField& size);

    /// Points along the sharpest sides of facets from a point of a rim to another rim; empty if there is no
    /// such crease.
    const std::vector<Index>& crease(Index rim);

private:
    struct Vertex {
        double at = 0; ///< running length on the chain
        Index point = -1;
        EdgeId edge;
        double fraction = 0;   ///< fraction of the edge's length
        bool at_start = false; ///< whether the edge starts there, so that a node exists in any case
    };
    struct Side {
        Index to = -1;
        double turn = 0; ///< angle between the two facets of the side [radian]
    };
    void find_sides();
    [[nodiscard]] std::vector<Index> crease_from(Index rim) const;
    [[nodiscard]] bool has_nodes_at(const LinkingSurface& link,
                                    std::span<const std::pair<double, double>> creases) const;
    [[nodiscard]] std::vector<Vertex> kept(const Chain& chain, int per_turn, const SizeField& size) const;
    [[nodiscard]] std::vector<Vertex> on_creases(std::vector<Vertex> vertices);

    const topology::OpenVolume& volume_;
    std::span<const LinkingSurface> links_;
    std::vector<char> end_of_; ///< for each model point: 1 on the source's rims, 2 on the target's
    std::map<Index, std::vector<Side>> sides_; ///< facet sides at each point
    /// Creases computed so far, by their start on a rim; empty: there is none.
    std::map<Index, std::vector<Index>> creases_;
};

/// The creases at the starts of segments with `on_crease`, in order of the segments.
std::vector<Crease> creases_of(const topology::OpenVolume& volume, const LinkingSurface& link);

/// Divide the segments of the rims at the breaks, and mark the segments that start on creases.
std::vector<LinkingSurface> follow_facets(const RimBreaks& breaks, std::vector<LinkingSurface> links);

} // namespace lacuna::surface
