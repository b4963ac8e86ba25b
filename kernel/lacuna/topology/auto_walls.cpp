// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/auto_walls.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>

namespace lacuna::topology {

namespace {

/// Maximum number of steps of the search for choices. A hundred sheets, of which three meet at each shared
/// edge, need about this number.
constexpr std::size_t kWalkLimit = 100000;

/// All faces connected to the faces `from` over shared edges, without crossing the faces `without`.
std::vector<FaceId> reachable_from(const Model& model, const std::vector<FaceId>& from,
                                   const std::vector<FaceId>& without)
{
    std::vector<FaceId> rest = all_faces(model), result;
    std::erase_if(rest, [&](FaceId face) { return std::ranges::find(without, face) != without.end(); });
    for (const std::vector<FaceId>& part : connected_parts(model, rest))
        if (std::ranges::find_first_of(part, from) != part.end())
            std::ranges::copy(part, std::back_inserter(result));
    std::erase_if(result, [&](FaceId face) { return std::ranges::find(from, face) != from.end(); });
    std::sort(result.begin(), result.end());
    return result;
}

/// A set of chosen sheets, with the values that rank it.
struct Choice {
    std::vector<bool> sheets;
    double free_length = 0; ///< [model length]
    double volume = 0;      ///< enclosed, with free loops closed by cones to their centres [model length³]
};

/// Enumerates the choices of sheets, as `find_walls()` defines them.
class Sheets {
public:
    Sheets(const Model& model, std::vector<FaceId> ends, const std::vector<FaceId>& reached,
           const RunContext& context)
        : model_(model), context_(context), ends_(std::move(ends)), count_(model.edges.size(), 0)
    {
        std::vector<bool> in(model.faces.size(), false), is_wall(model.faces.size(), false);
        for (const FaceId face : ends_) in[face.index()] = true;
        for (const FaceId face : reached) in[face.index()] = is_wall[face.index()] = true;
        geometry::UnionFind hang(model.faces.size());
        for (std::size_t e = 0; e < model.edges.size(); ++e) {
            std::vector<FaceId> here;
            for (const FaceUse& use : model.uses_of_edge(EdgeId(e))) {
                if (in[use.face.index()]) here.push_back(use.face);
            }
            crowded_ = crowded_ || here.size() > 2;
            if (here.size() == 2 && is_wall[here[0].index()] && is_wall[here[1].index()])
                hang.unite_least(here[0].index(), here[1].index());
        }
        std::map<std::size_t, std::vector<FaceId>> by_root;
        for (const FaceId face : reached) by_root[hang.find(face.index())].push_back(face);
        for (auto& [root, faces] : by_root) {
            edges_.push_back(edges_of(faces));
            sheets_.push_back(std::move(faces));
        }
        for (const EdgeId edge : edges_of(ends_)) ++count_[edge.index()];
    }

    /// Whether an edge is used more than twice.
    [[nodiscard]] bool crowded() const { return crowded_; }
    [[nodiscard]] const std::vector<std::vector<FaceId>>& sheets() const { return sheets_; }

    /// All maximal choices. Empty if there are too many, or if a sheet cannot be taken as a whole because the
    /// sheet and the ends together use an edge more than twice.
    std::optional<std::vector<Choice>> choices()
    {
        for (std::size_t s = 0; s < sheets_.size(); ++s)
            if (!may_add(s)) return std::nullopt;
        chosen_.assign(sheets_.size(), false);
        if (!search(0)) return std::nullopt;
        return std::move(found_);
    }

    /// An edge of the sheet that two faces of a choice already use. @pre the sheet cannot be added
    EdgeId taken_edge(const Choice& choice, std::size_t sheet)
    {
        for (std::size_t s = 0; s < sheets_.size(); ++s) {
            if (choice.sheets[s]) add_sheet(s, 1);
        }
        const auto taken = std::ranges::find_if(edges_[sheet],
                                                [&](EdgeId edge) { return count_[edge.index()] >= 2; });
        for (std::size_t s = 0; s < sheets_.size(); ++s) {
            if (choice.sheets[s]) add_sheet(s, -1);
        }
        return taken == edges_[sheet].end() ? EdgeId() : *taken;
    }

private:
    /// The edge of every use of the faces.
    [[nodiscard]] std::vector<EdgeId> edges_of(const std::vector<FaceId>& faces) const
    {
        std::vector<EdgeId> edges;
        for (const FaceId face : faces)
            for (const EdgeUse& use : uses_of(model_[face])) edges.push_back(use.edge);
        return edges;
    }

    void add_sheet(std::size_t sheet, int sign)
    {
        for (const EdgeId edge : edges_[sheet]) count_[edge.index()] += sign;
    }

    /// Whether each edge of a sheet has at most two uses, now that the sheet is counted.
    [[nodiscard]] bool fits(std::size_t sheet) const
    {
        return std::ranges::all_of(edges_[sheet], [&](EdgeId edge) { return count_[edge.index()] <= 2; });
    }

    [[nodiscard]] bool may_add(std::size_t sheet)
    {
        add_sheet(sheet, 1);
        const bool may = fits(sheet);
        add_sheet(sheet, -1);
        return may;
    }

    /// @return false if the step limit is reached.
    bool search(std::size_t sheet)
    {
        check_cancelled(context_);
        if (++steps_ > kWalkLimit) return false;
        if (sheet == sheets_.size()) {
            keep();
            return true;
        }
        add_sheet(sheet, 1);
        chosen_[sheet] = true;
        const bool counted = !fits(sheet) || search(sheet + 1);
        add_sheet(sheet, -1);
        chosen_[sheet] = false;
        return counted && search(sheet + 1);
    }

    void keep()
    {
        for (std::size_t s = 0; s < sheets_.size(); ++s)
            if (!chosen_[s] && may_add(s)) return;
        std::vector<FaceId> faces = ends_;
        for (std::size_t s = 0; s < sheets_.size(); ++s) {
            if (chosen_[s]) faces.insert(faces.end(), sheets_[s].begin(), sheets_[s].end());
        }
        Choice choice{chosen_, 0, 0};
        Vec3 middle = Vec3::Zero();
        for (std::size_t e = 0; e < count_.size(); ++e) {
            if (count_[e] != 1) continue;
            const double length = edge_length(model_, EdgeId(e));
            const std::vector<Index>& points = model_.edges[e].points;
            choice.free_length += length;
            middle += length * (model_.at(points.front()) + model_.at(points[points.size() / 2])) / 2;
        }
        if (choice.free_length > 0) middle /= choice.free_length;
        Model part = extract(model_, faces);
        orient_consistently(part);
        choice.volume = std::abs(volume_of_cones(part, all_faces(part), middle));
        found_.push_back(std::move(choice));
    }

    const Model& model_;
    const RunContext& context_;
    std::vector<FaceId> ends_;
    std::vector<std::vector<FaceId>> sheets_;
    std::vector<std::vector<EdgeId>> edges_; ///< for each sheet, the edges of its uses
    std::vector<int> count_;                 ///< uses of each edge by the ends and the chosen sheets
    std::vector<bool> chosen_;
    std::vector<Choice> found_;
    std::size_t steps_ = 0;
    bool crowded_ = false;
};

WallChoice walls_of(const Choice& choice, Sheets& sheets)
{
    WallChoice result;
    std::map<FaceId, EdgeId> left;
    for (std::size_t s = 0; s < sheets.sheets().size(); ++s) {
        const std::vector<FaceId>& faces = sheets.sheets()[s];
        if (choice.sheets[s]) {
            result.walls.insert(result.walls.end(), faces.begin(), faces.end());
            continue;
        }
        const EdgeId edge = sheets.taken_edge(choice, s);
        for (const FaceId face : faces) left.emplace(face, edge);
    }
    // Rims of two sources may take the same sheet.
    std::ranges::sort(result.walls);
    result.walls.erase(std::ranges::unique(result.walls).begin(), result.walls.end());
    for (const auto& [face, edge] : left) {
        result.left_out.push_back(face);
        result.taken.push_back(edge);
    }
    return result;
}

/// The faces next to each connected set of walls that extends from the end to the rim of the cavity. The
/// walls around a step of the end do not reach the rim. A flat face next to walls that do, such as a ledge at
/// a side wall, is therefore a wall, not a step.
std::set<FaceId> beside_long_walls(const Model& model, const std::vector<FaceId>& walls,
                                   const std::vector<FaceId>& end, const std::vector<FaceId>& cavity)
{
    std::set<FaceId> found;
    for (const std::vector<FaceId>& part : connected_parts(model, walls)) {
        std::set<FaceId> round;
        for (const Rim& rim : rims(model, part))
            for (const EdgeUse& use : rim.uses)
                for (const FaceUse& by : model.uses_of_edge(use.edge)) round.insert(by.face);
        const auto is_outside = [&](FaceId face) {
            return !std::ranges::binary_search(cavity, face) && std::ranges::find(end, face) == end.end();
        };
        if (std::ranges::find_first_of(round, end) != round.end() && std::ranges::any_of(round, is_outside))
            found.merge(round);
    }
    return found;
}

/// The walls of an end in a cavity. Empty if a face of the end lies outside the cavity, or if the other end
/// is on the same skin but outside the cavity: the solid itself is then the volume.
std::optional<WallChoice> walls_of_cavity(const Model& model, const std::vector<FaceId>& source,
                                          const std::vector<FaceId>& target, const RunContext& context)
{
    const std::vector<FaceId>& end = source.empty() ? target : source;
    WallChoice result{cavity_round(model, end, context), {}, {}, true, {}, {}};
    for (const FaceId face : end)
        if (!std::ranges::binary_search(result.walls, face)) return std::nullopt;
    const std::vector<FaceId> skin = reachable_from(model, result.walls, {}); // its faces outside the cavity
    for (const std::vector<FaceId>* list : {&source, &target}) {
        for (const FaceId face : *list) {
            if (std::ranges::binary_search(skin, face)) return std::nullopt;
            std::erase(result.walls, face);
        }
    }
    if (result.walls.empty()) return std::nullopt;
    Model oriented = model;
    orient_consistently(oriented);
    const Vec3 way = face_area_vector(oriented, end.front()).stableNormalized();
    const auto is_flat = [&](FaceId face, const Vec3& normal) {
        return face_area_vector(oriented, face).dot(normal) > (1 - kFlatShare) * face_area(oriented, face);
    };
    const auto faces_as_end = [&](FaceId face) { return is_flat(face, way); };
    if (!std::ranges::all_of(end, faces_as_end)) return result;
    std::vector<FaceId> across = result.walls;
    std::erase_if(across, [&](FaceId face) { return is_flat(face, way) || is_flat(face, -way); });
    const std::set<FaceId> walls = beside_long_walls(oriented, across, end, result.walls);
    const auto take_flat = [&](const Vec3& normal, std::vector<FaceId>& into) {
        const auto is_more = [&](FaceId face) { return is_flat(face, normal) && !walls.contains(face); };
        std::ranges::copy_if(result.walls, std::back_inserter(into), is_more);
        std::erase_if(result.walls, is_more);
    };
    take_flat(way, result.more_of_end);
    take_flat(-way, result.more_of_other);
    const NamedEntity first = entity_of(model, end.front());
    for (const FaceId face : result.more_of_end)
        log_line(
            context,
            formatted(
                "note: {} of the same cavity becomes part of the end with {}, because both face the same way",
                entity_of(model, face), first));
    for (const FaceId face : result.more_of_other)
        log_line(context,
                 formatted("note: {} of the same cavity becomes part of the end opposite to {}, because "
                           "it faces the other way",
                           entity_of(model, face), first));
    return result;
}

} // namespace

WallChoice find_walls(const Model& model, const std::vector<FaceId>& source,
                      const std::vector<FaceId>& target, const RunContext& context)
{
    std::vector<FaceId> ends = source;
    ends.insert(ends.end(), target.begin(), target.end());
    const std::vector<FaceId> reached = source.empty() ? reachable_from(model, target, source)
                                                       : reachable_from(model, source, target);
    if (auto cavity = walls_of_cavity(model, source, target, context)) return std::move(*cavity);
    Sheets sheets(model, ends, reached, context);
    std::optional<std::vector<Choice>> choices;
    if (sheets.crowded()) choices = sheets.choices();
    if (choices && (source.empty() || target.empty()))
        std::erase_if(*choices, [](const Choice& choice) { return choice.free_length == 0; });
    if (!choices || choices->empty()) return {reached, {}, {}, false, {}, {}};
    const double same = kFileAccuracy * model.diagonal;
    const double least = std::ranges::min_element(*choices, {}, &Choice::free_length)->free_length;
    std::erase_if(*choices, [&](const Choice& choice) { return choice.free_length > least + same; });
    std::ranges::stable_sort(*choices, {}, &Choice::volume);
    WallChoice result = walls_of(choices->front(), sheets);
    if (choices->size() > 1 && (*choices)[1].volume * (1 - kSameVolume) <= choices->front().volume) {
        throw InvalidInput(
            Message("topology.walls_ambiguous",
                    "walls = \"auto\" finds two equally good choices of walls: ({}) and ({})",
                    entities_of(model, result.walls),
                    entities_of(model, walls_of((*choices)[1], sheets).walls))
                .remedy("name them, such as walls = {{{}, …}}", model[result.walls.front()].tag));
    }
    return result;
}

} // namespace lacuna::topology
