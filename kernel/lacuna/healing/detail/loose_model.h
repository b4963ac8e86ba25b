// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/model.h>
#include <lacuna/topology/shared/side_points.h>

#include <string>
#include <vector>

namespace lacuna::healing {

/// A model during stitching. Entities can be removed, points can be merged, and points can be inserted into
/// facet sides. Edges, the faces at edges and the facets are consistent after each call, except that merges
/// of points wait for `settle_points()`. Loops are rebuilt by `settled()`.
class LooseModel {
public:
    /// @pre the model's loops are set.
    explicit LooseModel(const topology::Model& model);

    [[nodiscard]] const topology::Model& model() const { return model_; }
    [[nodiscard]] topology::Edge& edge(EdgeId e) { return model_[e]; }
    [[nodiscard]] bool is_gone(EdgeId e) const { return edge_gone_[e.index()]; }
    [[nodiscard]] bool is_gone(FaceId f) const { return face_gone_[f.index()]; }
    /// The faces at an edge; a face that uses the edge twice is listed twice.
    [[nodiscard]] const std::vector<FaceId>& users(EdgeId e) const { return users_[e.index()]; }
    [[nodiscard]] bool is_free(EdgeId e) const { return !is_gone(e) && users_[e.index()].size() == 1; }
    /// Whether the same face uses the edge twice.
    [[nodiscard]] bool is_seam(EdgeId e) const
    {
        return users(e).size() == 2 && users(e).front() == users(e).back();
    }
    /// Whether a face at the edge has given quads, which must be kept.
    [[nodiscard]] bool keeps_mesh(EdgeId e) const;
    /// For each face, its edges in ascending order, one entry per use.
    [[nodiscard]] std::vector<std::vector<EdgeId>> edges_of_faces() const;

    /// Merge point `gone` into `stays` at the next `settle_points()`. Nodes of given quads do not move: if
    /// only `gone` is such a node, `stays` moves to the position of `gone`.
    void join(Index gone, Index stays);
    /// Merge vertex `gone` and its point into `stays`. @pre `stays` is not merged into another vertex.
    void join(VertexId gone, VertexId stays);
    void move(Index p, const Vec3& to)
    {
        model_.points[index(p)] = to;
        touched_[index(p)] = true;
    }
    struct Shrunk {
        std::vector<FaceId> faces;  ///< faces that collapsed
        std::vector<FaceId> meshes; ///< faces whose given quads were dropped, because some of them collapsed
        int edges = 0;              ///< number of edges that collapsed
    };
    /// Apply the merges of points, and remove the facets, edges and faces that collapsed.
    Shrunk settle_points();
    /// Split the facets of the faces at the given edges, where `sides` has points on sides of the facets.
    void cut(const topology::SidePoints& sides, const std::vector<EdgeId>& edges);
    /// Split an edge at inner points. The first part keeps the tag.
    /// @param at  index of each point on the edge, and its vertex; ascending.
    void divide(EdgeId e, const std::vector<std::pair<std::size_t, VertexId>>& at);
    void remove(EdgeId e) { edge_gone_[e.index()] = true; }
    /// Replace every use of `gone` by a use of `stays`.
    void merge(EdgeId gone, EdgeId stays);
    void remove(FaceId f);
    /// Remove a face that is listed twice; its tag then names the face that stays.
    void remove_repeated(FaceId gone, FaceId stays)
    {
        topology::Face& kept = model_[stays];
        kept.repeated_tags.push_back(model_[gone].tag);
        for (const std::vector<std::string>& region : model_[gone].regions) // of the body on its other side
            if (std::ranges::find(kept.regions, region) == kept.regions.end()) kept.regions.push_back(region);
        remove(gone);
    }

    /// The remaining model, renumbered, with loops.
    /// @throw InvalidInput  the facets are no longer a manifold surface.
    topology::Model settled(const RunContext& context);

private:
    Index stays_as(Index p);
    bool shrink(FaceId f);
    void drop_bare_edges();
    void part_shortcuts();
    void renew_parameters(const RunContext& context);
    void compact();

    topology::ModelBuilder model_;
    std::vector<bool> edge_gone_, face_gone_;
    std::vector<std::vector<FaceId>> users_;
    std::vector<VertexId> vertex_joined_; ///< the vertex that each vertex merges into
    geometry::UnionFind joined_;          ///< sets of merged points; the root of a set is the point that
                                          ///< stays
    std::vector<bool> kept_;              ///< by point: whether it is a node of given quads
    std::vector<bool> touched_;           ///< by point: whether its surface parameters must be recomputed
    std::vector<bool> inside_;            ///< by point: whether it was inserted inside a face, so that it may
                                          ///< be moved onto the surface
    bool folded_ = false;                 ///< whether facets were removed because they lay back to back
    int next_edge_tag_ = 1;
};

} // namespace lacuna::healing
