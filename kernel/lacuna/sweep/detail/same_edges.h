// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/sweep/detail/member_edge.h>
#include <lacuna/sweep/detail/periodic.h>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

/// The edges of all members of an assembly. Internal to this folder.
namespace lacuna::sweep {

/// The edges of all members, numbered one member after the other, and which of them are the same edge.
///
/// Edges of several members are the same if they are the same curve between the same ends. Images of each
/// other on periodic faces count as the same edge too. Each set of same edges has a first edge, which
/// represents the set.
class SameEdges {
public:
    /// Which given nodes of an edge are kept: none; the rim nodes of a face whose given mesh only defines its
    /// shape; or the nodes of given quads.
    enum class Kept : std::uint8_t { no, rim, quads };

    /// @param beside  faces shared with volumes that are not swept: index of the member, and its face.
    /// @note  O(edges log edges), if few edges overlap in x.
    SameEdges(std::span<const AssemblyMember> members, std::span<const SharedFace> shared,
              std::span<const std::pair<std::size_t, FaceId>> beside,
              std::span<const PeriodicFaces> periodic);

    [[nodiscard]] std::span<const AssemblyMember> members() const { return members_; }
    [[nodiscard]] const topology::Model& model(std::size_t m) const { return members_[m].volume->model; }
    [[nodiscard]] bool is_wall(std::size_t m, FaceId face) const
    {
        return members_[m].volume->role[face.index()] == topology::Role::wall;
    }
    [[nodiscard]] std::span<const SharedFace> shared() const { return shared_; }
    [[nodiscard]] std::span<const PeriodicFaces> periodic() const { return periodic_; }

    [[nodiscard]] std::size_t size() const { return edges_.size(); }
    [[nodiscard]] std::size_t number(std::size_t m, EdgeId edge) const { return first_[m] + edge.index(); }
    [[nodiscard]] const MemberEdge& operator[](std::size_t e) const { return edges_[e]; }
    /// Number of sides of an edge's chain of points.
    [[nodiscard]] int given_sides(std::size_t e) const;

    /// The first of the edges that are the same as an edge.
    [[nodiscard]] std::size_t set_of(std::size_t e) const { return set_[e]; }
    /// Whether an edge runs in the direction of the first edge of its set.
    [[nodiscard]] bool runs_along(std::size_t e) const;
    /// Whether `plan_assembly()` must place the nodes of an edge, for one of these reasons:
    /// - other members have the edge too;
    /// - the edge is on a periodic face;
    /// - the edge is on a face shared with an unswept volume;
    /// - the edge ends at a cusp.
    [[nodiscard]] bool is_planned(std::size_t e) const { return planned_[e]; }
    /// Whether an edge is on a wall shared with a volume that is not swept, or between walls where another
    /// member has it on an end. The rows of the walls need a node at every vertex of such an edge.
    [[nodiscard]] bool is_beside(std::size_t e) const { return beside_.contains(e); }
    /// Whether an edge is the same as an edge on a periodic face.
    [[nodiscard]] bool is_tied(std::size_t e) const { return tied_.contains(set_[e]); }
    [[nodiscard]] Kept kept(std::size_t e) const { return kept_[e]; }
    /// Of the edges of a set with given nodes, the one whose nodes are kept; null: there is none.
    [[nodiscard]] const std::size_t* kept_one(std::size_t set) const;
    /// Minimum lengths of the first and the last side of a set's first edge, which keep quads at cusps from
    /// being flat [model length]; null: no cusp.
    [[nodiscard]] const std::array<double, 2>* cusps(std::size_t set) const;

private:
    /// Find edges that are the same in several members.
    void find_same();
    /// For each rim of a shared face that consists of one closed edge: unite this edge with the corresponding
    /// rim in the other member. Both are the same edge, even if their chords differ widely.
    void find_same_rims(const SharedFace& face);
    /// Join the edges of periodic faces with their images. The first edge of each set defines the position
    /// and the nodes of all edges of the set.
    void join_periodic();
    /// Find the edges between walls that other members have on their ends.
    void find_beside_ends();
    /// Find cusps: corners of ends whose two edges leave in the same direction, such as an arc and its
    /// tangent line. A quad at a cusp has an angle near 0° unless its sides are long enough to reach the
    /// place where the edges have diverged.
    void find_cusps();
    void find_cusp(std::size_t m, FaceId face, const topology::EdgeUse& in, const topology::EdgeUse& out);
    /// Find edges whose given nodes are kept. If several members have the same edge, an edge next to given
    /// quads takes precedence over an edge on the rim of a face whose given mesh only defines its shape.
    void find_kept();

    std::span<const AssemblyMember> members_;
    std::span<const SharedFace> shared_;
    std::span<const PeriodicFaces> periodic_;
    std::vector<std::size_t> first_; ///< index of each member's first edge
    std::vector<MemberEdge> edges_;
    geometry::UnionFind same_{0};
    std::vector<std::size_t> set_; ///< for each edge: the root in `same_`
    std::vector<bool> planned_;
    std::set<std::size_t> beside_;
    std::set<std::size_t> tied_; ///< sets with edges on periodic faces
    std::vector<Kept> kept_;
    std::map<std::size_t, std::size_t> kept_one_;
    std::map<std::size_t, std::array<double, 2>> cusps_; ///< for each set
};

/// Whether the same edge runs in the same direction in two members.
bool run_alike(const MemberEdge& a, const MemberEdge& b);

} // namespace lacuna::sweep
