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

/// Breaks: vertices of coarse facets that become nodes of the rims.
struct RimBreaks {
    /// For each linking surface, its breaks: pairs of running lengths on the source's and the target's chain.
    /// Empty: no breaks.
    std::vector<std::vector<std::pair<double, double>>> pairs;
    /// For each linking surface, whether the columns at all its breaks run along creases.
    std::vector<char> on_crease;
    /// For each edge that has breaks inside: their positions as fractions.
    std::map<EdgeId, std::vector<double>> edges;
    std::set<Index> points; ///< points of the model at all breaks
};

/// A chain of facet sides along the walls from rim to rim. A column of nodes follows it.
struct Crease {
    double source_at = 0;      ///< running length of its start on the source's chain
    std::vector<Index> points; ///< points from the source's rim to the target's rim
};

/// Finds the vertices of coarse facets at which rims need nodes.
///
/// An edge without an exact curve is a polyline. Candidates for breaks are its vertices that the
/// Douglas-Peucker rule keeps (@cite douglas_1973_reduction). The tolerance of this rule is the sag of one
/// mesh side, if the edge were an arc of the same length and turn. An edge with more candidates than the arc
/// would have mesh sides gets no breaks.
///
/// A break is useful only if a crease leads from it to another rim. The crease is either a single facet side
/// across an end, or a chain up the walls, and then a column of nodes follows it. An edge gets no breaks if
/// one of its candidates has no such crease.
class RimFacets {
public:
    RimFacets(const topology::OpenVolume& volume, std::span<const LinkingSurface> links);

    /// @param per_turn  number of mesh sides for a full turn, >= 1.
    /// @param size      length of mesh sides. Each edge has the number of sides that the turn or the size
    ///                  requires, whichever is larger.
    [[nodiscard]] RimBreaks breaks(int per_turn, const SizeField& size);

    /// Points of the crease from a point of a rim to another rim. At each point, the crease continues along
    /// the facet side with the largest angle between its two facets. Empty if there is no crease.
    const std::vector<Index>& crease(Index rim);

private:
    struct Vertex {
        double at = 0; ///< running length on the chain
        Index point = -1;
        EdgeId edge;
        double fraction = 0;   ///< fraction of the edge's length
        bool at_start = false; ///< whether the edge starts there; then a node exists in any case
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
    std::vector<std::vector<Side>> sides_; ///< facet sides at each point
    /// Creases computed so far, by their first point on a rim. An entry is empty if no crease starts there.
    std::map<Index, std::vector<Index>> creases_;
};

/// The creases at the starts of segments with `on_crease`, in order of the segments.
std::vector<Crease> creases_of(const topology::OpenVolume& volume, const LinkingSurface& link);

/// Divide the segments of the rims at the breaks, and mark the segments that start on creases.
std::vector<LinkingSurface> follow_facets(const RimBreaks& breaks, std::vector<LinkingSurface> links);

} // namespace lacuna::surface
