// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/healing/detail/edge_track.h>
#include <lacuna/healing/detail/loose_model.h>
#include <lacuna/healing/shared/stitch.h>

#include <map>
#include <optional>
#include <vector>

namespace lacuna::healing {

/// The steps of `stitch()`. Vertices and T-junctions: stitch.cpp; edges that lie on each other:
/// stitch_edges.cpp.
class Stitcher {
public:
    Stitcher(const topology::Model& model, double tolerance, const RunContext& context, double share)
        : loose_(model), tolerance_(tolerance), share_(share), context_(context)
    {
    }

    StitchReport run();
    topology::Model result() { return loose_.settled(context_); }

private:
    /// A vertex in the interior of an edge, where the edge will be split.
    struct Stop {
        VertexId vertex;
        EdgeTrack::EdgePosition place;
        std::size_t node = 0; ///< index of the edge's point with which the vertex merges; 0: a new point is
                              ///< inserted
    };
    /// A point of a merged edge.
    struct Node {
        double s = 0, param = 0; ///< position and parameter on the bundle's first edge
        Index point = -1;
    };
    /// An edge that merges into another, and the index of the node that each of its points becomes.
    struct MergedEdge {
        EdgeId edge;
        std::vector<std::size_t> nodes;
    };
    /// Coincident edges.
    struct Bundle {
        EdgeId first; ///< the edge that gives the bundle its shape and tag
        std::vector<Node> nodes;
        std::vector<std::size_t> order; ///< nodes in order along the edge
        std::vector<MergedEdge> merged;
        bool keeps_mesh = false;
    };
    /// The positions of an edge's points along another edge.
    struct Along {
        bool reversed = false; ///< the edges run in opposite directions, and `at` begins at the last point
        std::vector<EdgeTrack::EdgePosition> at;
    };

    void join_vertices();
    void collapse_short_edges();
    void settle_points();
    void split_at_vertices();
    std::map<EdgeId, std::vector<Stop>> find_stops();
    void place_stops(EdgeId e, std::vector<Stop>& stops);
    std::map<EdgeId, VertexId> begin_elsewhere(std::map<EdgeId, std::vector<Stop>>& stops);
    void insert_stops(EdgeId e, const std::vector<Stop>& stops, std::optional<VertexId> begin);
    void merge_edges();
    bool take_kept_nodes(const std::vector<EdgeId>& group);
    std::vector<Bundle> bundles_of(std::vector<EdgeId> group);
    std::optional<Along> points_along(EdgeId first, EdgeId e, double tolerance);
    bool try_add(Bundle& bundle, EdgeId e, double tolerance);
    void sew_by_vertices(std::vector<Bundle>& bundles);
    bool add_nodes(Bundle& bundle, EdgeId e, bool reversed,
                   const std::vector<EdgeTrack::EdgePosition>& places);

    const topology::Model& model() const { return loose_.model(); }
    NamedEntity named(EdgeId e) const { return {"edge", model()[e].tag}; }
    const EdgeTrack& track(EdgeId e)
    {
        auto& track = tracks_[e];
        if (!track) {
            check_cancelled(context_);
            track.emplace(model(), e, context_);
        }
        return *track;
    }

    LooseModel loose_;
    double tolerance_, share_;
    const RunContext& context_;
    StitchReport report_;
    std::map<EdgeId, std::optional<EdgeTrack>> tracks_; ///< cache; cleared when edges change
};

} // namespace lacuna::healing
