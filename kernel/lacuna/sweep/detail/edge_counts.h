// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/surface/shared/intervals.h>
#include <lacuna/sweep/detail/assembly_levels.h>
#include <lacuna/sweep/detail/edge_rows.h>
#include <lacuna/sweep/detail/lines_ahead.h>
#include <lacuna/sweep/detail/same_edges.h>

#include <array>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Interval assignment over an assembly. Internal to this folder.
namespace lacuna::sweep {

/// Numbers of sides of all edges of an assembly's members.
///
/// Edges that need equal numbers of sides form one class:
/// - the copies of an edge that several members have;
/// - an edge of a source's rim and its image on the target's rim;
/// - the side lines of a member;
/// - opposite edges of a four-sided wall.
///
/// A class gets the requested number of sides or, without a request, the largest number that the size
/// requires for one of its edges. If all edges of an end have planned or given nodes and the number of its
/// sides is odd, one class without a requested number gets one more side, preferably the one with the most
/// sides.
class EdgeCounts {
public:
    using Line = std::vector<topology::EdgeUse>;

    /// An edge whose sides follow facets, and the positions of its vertices that become nodes, as shares of
    /// its length.
    struct Followed {
        std::size_t edge = 0;
        std::vector<double> ends;
    };

    /// @throw  as `plan_assembly()`.
    EdgeCounts(const SameEdges& edges, const RunContext& context);

    /// Number of sides of an edge.
    [[nodiscard]] int sides_of(std::size_t e) const { return count_.at(class_of(e)); }
    /// Whether `plan_assembly()` places the nodes of an edge: as `SameEdges::is_planned()`, with two
    /// exceptions. Edges are not planned if their side line consists of several edges. Rims of ends are
    /// planned too if they are in one class with a planned edge that runs around the walls.
    [[nodiscard]] bool is_planned(std::size_t e) const { return planned_[e]; }
    /// Whether an edge is on the rim of an end or on a side line. The nodes of the other edges of walls
    /// follow from these.
    [[nodiscard]] bool is_on_frame(std::size_t e) const { return frame_[e]; }

    /// Node positions as shares of an edge's length: even, or by the sizes along its class.
    [[nodiscard]] std::vector<double> spread(std::size_t e, int count) const;

    /// For each member: its side lines that consist of one edge.
    [[nodiscard]] const std::map<std::size_t, Line>& side_lines() const { return sides_; }
    /// For each member: its side lines that consist of several edges, at least one of them beside another
    /// volume (`SameEdges::is_beside()`).
    [[nodiscard]] const std::map<std::size_t, std::vector<Line>>& stacks() const { return stacks_; }
    /// `surface::shares_on_line()` of the side line of a member that begins with an edge. The search for the
    /// line is O(log lines).
    [[nodiscard]] std::vector<double> on_line(std::size_t m, EdgeId first, std::vector<double> heights) const;
    /// Number of layers of a member with side lines that consist of several edges: at least the largest
    /// number of edges of one line.
    [[nodiscard]] int layers_of(std::size_t m, const std::vector<Line>& lines) const;
    /// For each member: see `AssemblyLevels::heights()`.
    [[nodiscard]] const std::vector<std::vector<double>>& heights() const { return heights_; }

    /// Properties of a set of same edges; null: the set does not have them.
    /// - `followed()`: the vertices that become nodes because the edge's sides follow facets
    /// - `rows()`: the rows of boundary layers that end at the start and at the end of the set's first edge
    /// - `bias()`: an edge of the set with a requested bias, and that bias
    [[nodiscard]] const Followed* followed(std::size_t set) const { return entry(followed_, set); }
    [[nodiscard]] const std::array<EdgeRows, 2>* rows(std::size_t set) const { return entry(rows_, set); }
    [[nodiscard]] const std::pair<std::size_t, double>* bias(std::size_t set) const
    {
        return entry(bias_, set);
    }

private:
    /// An edge of the source with an interval request.
    struct EdgeAsked {
        EdgeId edge;
        double covered = 0; ///< share of its length that the request covers
        double length = 0;  ///< covered length [model length]
        bool reversed = false;
    };
    struct SidesOfClass {
        int count = 0;
        std::string region; ///< region of the member with the request
        Argument name;      ///< name of the entity with the request
    };

    template <class T>
    static const T* entry(const std::map<std::size_t, T>& of, std::size_t set)
    {
        const auto at = of.find(set);
        return at == of.end() ? nullptr : &at->second;
    }

    /// Two edges with the same number of sides, and whether their sides correspond in opposite directions.
    struct JoinedEdges {
        std::size_t a = 0, b = 0;
        bool reversed = false;
    };
    void join(std::size_t a, std::size_t b, bool reversed);
    /// An edge of one rim of a member and the edges of the other rim that correspond to it.
    struct Chain {
        std::size_t whole = 0;
        std::vector<std::size_t> parts;
    };
    /// Find the direction of each edge relative to the other edges of its class.
    void find_directions();
    /// Find the densities of sides along classes with an edge on the rim of a source beside a narrow place,
    /// or in front of a line (`lines_ahead()`). The classes of side lines are left out: layers do not follow
    /// narrow places.
    void find_dense();
    [[nodiscard]] std::size_t class_of(std::size_t e) const { return class_[e]; }
    [[nodiscard]] double size(std::size_t m, const Vec3& p) const;
    /// Join edges that must have the same number of sides for the sweep of a member.
    void join_by_sweep(std::size_t m);
    /// Read the interval requests of a member. Errors are ignored here, because the member's own sweep
    /// reports them.
    void find_demands(std::size_t m, std::span<const surface::LinkingSurface> links);
    /// Find the numbers of sides and layers that a member needs to keep its volume.
    void plan_sides(std::size_t m, std::span<const surface::LinkingSurface> links);
    /// Join opposite edges of walls, whose quads form rows and columns. Also join opposite edges of shared
    /// faces with four edges, so that both members mesh such a face by the same grid.
    void join_opposite();
    /// @param rows  whether the quads form rows. A face with two rims then has the same number of nodes on
    ///         both rims.
    void join_opposite(std::size_t m, FaceId face, bool rows);
    /// Find shared edges that run around a member's walls, such as the rim of a band. Such an edge needs as
    /// many sides as the rims of the member's ends, so the nodes of these rims are planned too.
    void find_across();
    /// Number of sides of an edge that belong to boundary-layer rows, and the length of the edge outside
    /// these rows [model length].
    [[nodiscard]] std::pair<int, double> beside_rows(std::size_t e) const;
    /// Check that edges have enough sides for their rows.
    void check_rows() const;
    /// Assign requested numbers of sides to classes. A request that covers only a part of an edge is left to
    /// the sweep of the member.
    void ask_sides();
    /// Distribute the requested sides over several edges by length. Every edge gets at least one side.
    void ask_sides(std::size_t m, const surface::SidesAsked& asked, const std::vector<EdgeAsked>& edges);
    void ask_class(std::size_t e, const SidesOfClass& sides);
    [[nodiscard]] int layers_asked(std::size_t m) const;
    /// Number of sides of about the requested size if all positions in `followed.ends` become nodes.
    [[nodiscard]] double followed_sides(const Followed& followed, const MemberEdge& edge) const;
    /// Number of sides that an edge needs for the size and the curvature of its member.
    [[nodiscard]] double wanted(const MemberEdge& edge) const;
    /// Determine the number of sides of each class.
    void count();
    /// Settle the numbers of sides of planned edges (`match_chains()`, `make_even()`). Chains are left to the
    /// members' sweeps if their numbers do not settle.
    void settle();
    /// @return  whether all numbers fit.
    bool settle(bool chains);
    /// Give an edge that corresponds to a chain of several edges on its member's other rim as many sides as
    /// the chain. @return  whether a class has got more sides.
    bool match_chains();
    /// If all edges of an end are shared or have given nodes, make the number of its sides even, because
    /// quads need an even number.
    /// @return  whether a class has got one more side.
    bool make_even(std::size_t m, FaceId face, int round);
    void find_frame();

    const SameEdges& edges_;
    const RunContext& context_;
    geometry::UnionFind classes_;
    std::vector<std::size_t> class_;    ///< for each edge: the root in `classes_`
    std::vector<bool> planned_, frame_; ///< for each edge
    std::map<std::size_t, int> count_;  ///< for each class
    std::map<std::size_t, Line> sides_;
    std::map<std::size_t, std::vector<Line>> stacks_;
    /// Sets of same edges that, in some member, form only a part of a side line.
    std::set<std::size_t> stacked_;
    std::vector<int> per_turn_, layers_;        ///< numbers that each member needs at least
    std::vector<surface::LinkingSurface> bent_; ///< those with side lines that bend
    /// For each member and first edge of a side line in `bent_`: the linking surface, and the line in it.
    std::map<std::pair<std::size_t, EdgeId>, std::pair<std::size_t, std::size_t>> bent_lines_;
    AssemblyLevels levels_;
    std::vector<std::vector<double>> heights_;
    std::map<std::size_t, Followed> followed_;
    RowsOfSets rows_;
    std::map<std::size_t, surface::IntervalDemands> demands_; ///< for each member that has any
    std::map<std::size_t, SidesOfClass> intervals_; ///< for each class: sides requested by 'intervals'
    std::map<std::size_t, std::pair<std::size_t, double>> bias_;
    std::vector<LineAhead> ahead_; ///< lines in front of grids
    std::vector<JoinedEdges> joined_;
    std::vector<Chain> chains_;
    std::vector<bool> reversed_; ///< for each edge, whether it runs against its class
    /// For each class beside narrow places: at even steps along it, the number of sides that the size there
    /// would give its whole length.
    std::map<std::size_t, std::vector<double>> dense_;
    std::set<std::size_t> asked_; ///< classes with a number requested by the user
    /// For each class, the largest `Kept` of its edges.
    std::map<std::size_t, SameEdges::Kept> kept_of_class_;
    std::map<std::size_t, int> bumps_; ///< number of sides added to each class
    std::vector<double> spacing_;      ///< for each member: default size
};

} // namespace lacuna::sweep
