// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/union_find.h>
#include <lacuna/topology/model.h>
#include <lacuna/topology/side_points.h>

#include <string>
#include <vector>

namespace lacuna::healing {

/// A model while it is being stitched: entities go, points join and sides of facets get points, so that at
/// any time edges, the faces that use them and facets agree; loops do not, until `settled()`.
class LooseModel {
public:
    /// @pre the model's loops are set.
    explicit LooseModel(topology::Model model);

    [[nodiscard]] const topology::Model& model() const { return model_; }
    [[nodiscard]] topology::Edge& edge(EdgeId e) { return model_[e]; }
    [[nodiscard]] bool is_gone(EdgeId e) const { return edge_gone_[e.index()]; }
    [[nodiscard]] bool is_gone(FaceId f) const { return face_gone_[f.index()]; }
    /// The faces at an edge, once a use.
    [[nodiscard]] const std::vector<FaceId>& users(EdgeId e) const { return users_[e.index()]; }
    [[nodiscard]] bool is_free(EdgeId e) const { return !is_gone(e) && users_[e.index()].size() == 1; }
    /// Is it where one face meets itself?
    [[nodiscard]] bool is_seam(EdgeId e) const
    {
        return users(e).size() == 2 && users(e).front() == users(e).back();
    }
    /// Has a face at the edge a mesh that must stay?
    [[nodiscard]] bool keeps_mesh(EdgeId e) const;
    /// Edges of each face, once a use, in order.
    [[nodiscard]] std::vector<std::vector<EdgeId>> edges_of_faces() const;

    /// Let `gone` be `stays` from the next `settle_points()` on. Nodes of kept meshes do not move: where only
    /// the first is one, the second takes its place.
    void join(Index gone, Index stays);
    /// Let vertex `gone` be `stays`, and their points join. @pre `stays` is joined to none.
    void join(VertexId gone, VertexId stays);
    void move(Index p, const Vec3& to)
    {
        model_.points[index(p)] = to;
        touched_[index(p)] = true;
    }
    struct Shrunk {
        std::vector<FaceId> faces;  ///< went
        std::vector<FaceId> meshes; ///< whose given quads went, since some shrank
    };
    /// Renumber what was joined; facets, edges and faces that shrank to nothing go.
    Shrunk settle_points();
    /// Cut the facets at the edges named wherever `sides` has points.
    void cut(const topology::SidePoints& sides, const std::vector<EdgeId>& edges);
    /// Cut an edge at inner points of it, which become or are vertices. The first part keeps the tag.
    void divide(EdgeId e, const std::vector<std::pair<std::size_t, VertexId>>& at);
    void remove(EdgeId e) { edge_gone_[e.index()] = true; }
    /// The uses of `gone` become uses of `stays`.
    void merge(EdgeId gone, EdgeId stays);
    void remove(FaceId f);

    /// What is left, compact, with loops.
    /// @throw InvalidInput  the facets are no surface any more.
    topology::Model settled(const RunContext& context);

private:
    Index stays_as(Index p);
    bool shrink(FaceId f);
    void drop_bare_edges();
    void part_shortcuts();
    void renew_parameters(const RunContext& context);
    void compact();

    topology::Model model_;
    std::vector<bool> edge_gone_, face_gone_;
    std::vector<std::vector<FaceId>> users_;
    std::vector<VertexId> vertex_joined_; ///< what each vertex is to be
    geometry::UnionFind joined_;          ///< points, by the one that each is to be
    std::vector<bool> kept_;              ///< points that are nodes of given quads
    std::vector<bool> touched_;           ///< points whose surface parameters are to be found anew
    std::vector<bool> inside_;            ///< points put inside faces, which may move onto the surface
    bool folded_ = false;                 ///< facets went that lay on each other's back
    int next_edge_tag_ = 1;
};

} // namespace lacuna::healing
