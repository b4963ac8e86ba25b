// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/tet_middles.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/quality/shared/second_order.h>
#include <lacuna/sweep/shared/side_middles.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace lacuna::fill {

using namespace topology;

namespace {

/// Call `visit(from, to, place)` for the sides of all cells, then of the skin. `place` is the index of the
/// side's middle node in `TetMiddles::of_cells` followed by `TetMiddles::of_skin`.
/// @return  the lengths of these two lists
template <class Visit>
std::pair<std::size_t, std::size_t> each_side(const mesh::TetPart& mesh, const Visit& visit)
{
    const bool full = mesh.middles.full;
    std::size_t place = 0;
    for (const Hex& cell : mesh.cells) {
        const mesh::CellNodes own = mesh::distinct_corners(cell);
        const bool is_pyramid = own.count == 5;
        for (const auto& [a, b] :
             side_corners(is_pyramid ? mesh::CellShape::pyramid5 : mesh::CellShape::tet4))
            visit(own.node[index(a)], own.node[index(b)], place++);
        if (is_pyramid && full) ++place;
    }
    const std::size_t of_cells = place;
    for (const Quad& side : mesh.skin) {
        const std::size_t count = mesh::corner_count(side);
        for (std::size_t k = 0; k < count; ++k) visit(side[k], side[(k + 1) % count], place++);
        if (count == 4 && full) ++place;
    }
    return {of_cells, place - of_cells};
}

/// Number the middle nodes of a mesh of order 1. @return the end nodes of each side, in the order of the
/// numbers
std::vector<Segment> number_middles(mesh::TetPart& mesh, const RunContext& context)
{
    mesh::TetMiddles& middles = mesh.middles;
    // Sort the sides into bins by their lower node, so that equal sides are found in one bin.
    std::vector<std::size_t> start(mesh.nodes.size() + 1, 0);
    const auto [of_cells, of_skin] = each_side(
        mesh, [&](Index a, Index b, std::size_t) { ++start[index(std::min(a, b)) + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::pair<Index, std::size_t>> uses(start.back()); // by bin: the higher node of a side, and
                                                                   // the place of its middle node
    std::vector<std::size_t> end(start.begin(), start.end() - 1);
    each_side(mesh, [&](Index a, Index b, std::size_t place) {
        uses[end[index(std::min(a, b))]++] = {std::max(a, b), place};
    });
    middles.of_cells.resize(of_cells);
    middles.of_skin.resize(of_skin);
    std::vector<Segment> sides;
    const auto next = [&](std::size_t i) { return static_cast<Index>(mesh.nodes.size() + i); };
    for (std::size_t low = 0; low < mesh.nodes.size(); ++low) {
        if (low % kBetweenPolls == 0) check_cancelled(context);
        const auto own = std::span(uses).subspan(start[low], start[low + 1] - start[low]);
        std::ranges::sort(own);
        for (const auto& [high, at] : own) {
            const Segment ends{static_cast<Index>(low), high};
            if (sides.empty() || sides.back() != ends) sides.push_back(ends);
            (at < of_cells ? middles.of_cells[at] : middles.of_skin[at - of_cells]) = next(sides.size() - 1);
        }
    }
    if (!middles.full) return sides;
    std::map<Quad, Index> centre;
    for (std::size_t q = 0; q < mesh.skin_quads; ++q)
        centre[face_key(mesh.skin[q])] = middles.of_skin[5 * q + 4] = next(sides.size() + q);
    for (std::size_t c = 0; c < mesh.pyramids; ++c) {
        const Hex& cell = mesh.cells[c];
        middles.of_cells[9 * c + 8] = centre.at(face_key({cell[0], cell[1], cell[2], cell[3]}));
    }
    return sides;
}

class Elevator {
public:
    Elevator(const Model& model, mesh::TetPart& mesh, const std::vector<FaceId>& faces,
             const sweep::SharedMiddles& known, const sweep::SecondOrderOptions& options,
             const RunContext& context)
        : model_(model), mesh_(mesh), faces_(faces), known_(known), options_(options), context_(context)
    {
        mesh_.middles.full = !options.serendipity;
        sides_ = number_middles(mesh_, context);
        states_.assign(sides_.size(), State::inside);
        mesh_.middles.nodes.resize(sides_.size() + (mesh_.middles.full ? mesh_.skin_quads : 0));
        for (std::size_t s = 0; s < sides_.size(); ++s) middle(s) = straight(s);
    }

    void place()
    {
        find_skin();
        take_known();
        take_given();
        place_on(sweep::middles_on_edges, [&](std::size_t s) { return face_[s] != other_[s]; });
        for (const std::size_t s : on_skin_)
            if (states_[s] == State::open && (keeps_cells(face_[s]) || keeps_cells(other_[s])))
                states_[s] = State::fixed;
        place_on(sweep::middles_on_faces, [](std::size_t) { return true; });
        if (mesh_.middles.full) find_centres();
    }

    /// Make sides of invalid cells straight until all cells are valid. @return the quality of the cells
    quality::Quality straighten_invalid(const std::string& region)
    {
        std::vector<mesh::CellNodes> cells;
        for (std::size_t c = 0; c < mesh_.cells.size(); ++c) cells.push_back(merged_nodes(mesh_, c));
        while (true) {
            place_centres();
            std::vector<Vec3> nodes = mesh_.nodes;
            nodes.insert(nodes.end(), mesh_.middles.nodes.begin(), mesh_.middles.nodes.end());
            const std::vector<std::size_t> invalid = quality::invalid_cells(nodes, cells, context_);
            if (invalid.empty()) return quality::measure_cells(nodes, cells, context_);
            const std::size_t before = straightened_;
            for (const std::size_t c : invalid) straighten(c);
            if (straightened_ == before) refuse(region, invalid);
        }
    }

    [[nodiscard]] std::string report() const
    {
        std::string line = formatted("order 2: {} middle nodes; of those on the skin {} on exact curves and "
                                     "surfaces, {} on facets, {} given",
                                     mesh_.middles.nodes.size(), counts_.exact, counts_.facets,
                                     counts_.given);
        if (straightened_ > 0)
            line += formatted("; {} sides stay straight, because cells beside them would not be valid",
                              straightened_);
        return line;
    }

private:
    /// State of the middle node of a side.
    enum class State : std::uint8_t {
        inside, ///< not on the skin
        open,   ///< on the skin, still straight
        bent,   ///< on the skin, moved onto the geometry
        fixed,  ///< given by a neighbour or by a file
    };

    Vec3& middle(std::size_t side) { return mesh_.middles.nodes[side]; }
    [[nodiscard]] const Vec3& end(std::size_t side, std::size_t k) const
    {
        return mesh_.nodes[index(sides_[side][k])];
    }
    [[nodiscard]] Vec3 straight(std::size_t side) const { return (end(side, 0) + end(side, 1)) / 2; }
    [[nodiscard]] std::size_t side_of(Index node) const { return index(node) - mesh_.nodes.size(); }
    [[nodiscard]] bool keeps_cells(FaceId face) const
    {
        return model_[face].keeps_nodes || !model_[face].given_quads.empty();
    }
    void fix(std::size_t side, const Vec3& at)
    {
        middle(side) = at;
        states_[side] = State::fixed;
        ++counts_.given;
    }

    /// Find the sides on the skin, and the faces on both sides of each.
    void find_skin()
    {
        face_.resize(sides_.size());
        other_.resize(sides_.size());
        for (std::size_t i = 0; i < mesh_.skin.size(); ++i) {
            const mesh::CellNodes nodes = skin_nodes(mesh_, i);
            const std::size_t count = mesh::corner_count(mesh_.skin[i]);
            for (std::size_t k = 0; k < count; ++k) {
                const std::size_t s = side_of(nodes.node[count + k]);
                other_[s] = faces_[index(mesh_.skin_patch[i])];
                if (states_[s] == State::open) continue;
                states_[s] = State::open;
                face_[s] = other_[s];
                on_skin_.push_back(s);
            }
        }
    }

    void take_known()
    {
        for (const std::size_t s : on_skin_)
            if (const std::optional<Vec3> known = known_.side(end(s, 0), end(s, 1))) fix(s, *known);
    }

    void take_given()
    {
        if (!options_.given) return;
        std::vector<std::size_t> asked;
        std::vector<Vec3> from, to;
        for (const std::size_t s : on_skin_) {
            if (states_[s] != State::open || !(keeps_cells(face_[s]) || keeps_cells(other_[s]))) continue;
            asked.push_back(s);
            from.push_back(end(s, 0));
            to.push_back(end(s, 1));
        }
        const std::vector<Vec3> given = options_.given(from, to);
        for (std::size_t i = 0; i < asked.size(); ++i)
            if (given[i].allFinite()) fix(asked[i], given[i]);
    }

    template <class Find, class Wanted>
    void place_on(const Find& find, const Wanted& wanted)
    {
        std::vector<std::size_t> asked;
        std::vector<sweep::SideOfSkin> sides;
        for (const std::size_t s : on_skin_) {
            if (states_[s] != State::open || !wanted(s)) continue;
            asked.push_back(s);
            sides.push_back({end(s, 0), end(s, 1), straight(s), face_[s], other_[s]});
        }
        const std::vector<std::optional<Vec3>> found = find(model_, sides, counts_, context_);
        for (std::size_t i = 0; i < asked.size(); ++i) {
            if (!found[i]) continue;
            middle(asked[i]) = *found[i];
            states_[asked[i]] = State::bent;
        }
    }

    /// Find the centres of quads that neighbours or files give.
    void find_centres()
    {
        std::vector<std::array<Vec3, 4>> corners(mesh_.skin_quads);
        for (std::size_t q = 0; q < corners.size(); ++q)
            for (std::size_t k = 0; k < 4; ++k) corners[q][k] = mesh_.nodes[index(mesh_.skin[q][k])];
        const Vec3 none = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
        centres_.assign(corners.size(), none);
        if (options_.given_centres) centres_ = options_.given_centres(corners);
        for (std::size_t q = 0; q < corners.size(); ++q)
            if (const std::optional<Vec3> known = known_.centre(corners[q])) centres_[q] = *known;
    }

    /// Place the centres of quads where they are given, or else compute them from the middle nodes of the
    /// quads' sides.
    void place_centres()
    {
        for (std::size_t q = 0; q < centres_.size(); ++q) {
            const mesh::CellNodes nodes = skin_nodes(mesh_, q);
            Vec3& centre = middle(side_of(nodes.node[8]));
            centre = centres_[q];
            if (centre.allFinite()) continue;
            centre.setZero();
            for (std::size_t k = 0; k < 4; ++k)
                centre += mesh_.node(index(nodes.node[4 + k])) / 2 - mesh_.node(index(nodes.node[k])) / 4;
        }
    }

    /// Straighten the sides of a cell that bend only to follow the geometry.
    void straighten(std::size_t cell)
    {
        const mesh::CellNodes nodes = cell_nodes(mesh_, cell);
        for (std::size_t n = cell < mesh_.pyramids ? 5 : 4; n < nodes.count; ++n) {
            const std::size_t s = side_of(nodes.node[n]);
            if (s >= sides_.size() || states_[s] != State::bent || middle(s) == straight(s)) continue;
            middle(s) = straight(s);
            ++straightened_;
        }
    }

    [[noreturn]] void refuse(const std::string& region, const std::vector<std::size_t>& invalid) const
    {
        const mesh::CellNodes corners = mesh::distinct_corners(mesh_.cells[invalid.front()]);
        Vec3 centre = Vec3::Zero();
        for (const Index n : corners) centre += mesh_.nodes[index(n)] / static_cast<double>(corners.count);
        throw NotSweepable(
            Message("fill.second_order",
                    "{}: {} cells are not valid at order 2, one of them at ({:.4g}, {:.4g}, {:.4g}), because "
                    "the sides of the mesh beside them bend too much",
                    region, found(invalid.size()), centre.x(), centre.y(), centre.z())
                .remedy("use a smaller 'size', or order = 1"));
    }

    const Model& model_;
    mesh::TetPart& mesh_;
    const std::vector<FaceId>& faces_;
    const sweep::SharedMiddles& known_;
    const sweep::SecondOrderOptions& options_;
    const RunContext& context_;
    std::vector<Segment> sides_; ///< the two end nodes of each side
    std::vector<State> states_;
    std::vector<std::size_t> on_skin_; ///< indices of the sides on the skin
    std::vector<FaceId> face_, other_; ///< for each side on the skin, the two faces next to it
    std::vector<Vec3> centres_;        ///< given centres of quads; NaN where none is given
    sweep::SkinCounts counts_;
    std::size_t straightened_ = 0;
};

} // namespace

ElevatedTets elevate(const Model& model, mesh::TetPart& mesh, const std::vector<FaceId>& faces,
                     const sweep::SharedMiddles& known, const sweep::SecondOrderOptions& options,
                     const std::string& region, const RunContext& context)
{
    Elevator elevator(model, mesh, faces, known, options, context);
    elevator.place();
    ElevatedTets result{elevator.straighten_invalid(region), {}};
    result.report = elevator.report();
    return result;
}

} // namespace lacuna::fill
