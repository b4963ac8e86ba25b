// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/piece_ends.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Largest number of candidates for ends of a piece; those of few faces come first. 600 is enough for a prism
/// with twelve sides. With a higher limit, ends of more faces are found; the cost is quadratic in the limit.
constexpr std::size_t kMostEnds = 600;
/// Subtracted from the cost of a pair for each end that the user named. A higher value keeps named ends at
/// the price of worse cells.
constexpr double kNamed = 0.1;
using FaceSet = std::uint64_t;

constexpr FaceSet one(std::size_t face) { return FaceSet{1} << face; }

template <class Do>
void for_each(FaceSet set, const Do& use)
{
    for (; set != 0; set &= set - 1) use(static_cast<std::size_t>(std::countr_zero(set)));
}

/// Pairs of faces that touch the same face along successive edges. The edges continue each other without a
/// corner.
using Beside = std::vector<std::pair<FaceId, FaceId>>;

Beside faces_in_line(const Model& model, FaceId face)
{
    Beside found;
    const auto face_beside = [&](const EdgeUse& use) {
        for (const FaceUse& user : model.uses_of_edge(use.edge))
            if (user.face != face) return user.face;
        return face;
    };
    for (const Loop& loop : border_loops(model, face)) {
        EdgeUse before = loop.uses.back();
        for (const EdgeUse& use : loop.uses) {
            const std::vector<Vec3> a = use_places(model, before), b = use_places(model, use);
            const Vec3 in = a.back() - a[a.size() - 2], out = b[1] - b[0];
            if (in.stableNormalized().dot(out.stableNormalized()) > kOneCurve)
                found.emplace_back(face_beside(before), face_beside(use));
            before = use;
        }
    }
    return found;
}

/// The faces of a closed skin, with adjacency and shape.
class Skin {
public:
    explicit Skin(const Model& model) : model_(model)
    {
        const std::size_t count = model.faces.size();
        faces_.resize(count);
        std::vector<FaceSet> at(model.vertices.size(), 0);
        for (std::size_t f = 0; f < count; ++f) {
            OneFace& face = faces_[f];
            face.area = face_area(model, FaceId(f));
            face.normal = face_area_vector(model, FaceId(f)) / face.area;
            for (const Loop& loop : border_loops(model, FaceId(f))) {
                std::vector<Side>& sides = face.loops.emplace_back();
                for (const EdgeUse& use : loop.uses) {
                    at[use_from(model, use).index()] |= one(f);
                    at[use_to(model, use).index()] |= one(f);
                    for (const FaceUse& user : model.uses_of_edge(use.edge)) {
                        if (user.face.index() == f) continue;
                        sides.push_back({user.face.index(), edge_length(model, use.edge), use.edge});
                        face.beside |= one(user.face.index());
                    }
                }
            }
        }
        for (const FaceSet met : at) for_each(met, [&](std::size_t f) { faces_[f].touched |= met; });
    }

    /// Sets of faces that may be an end, small ones first.
    [[nodiscard]] std::vector<FaceSet> ends() const
    {
        std::vector<FaceSet> found;
        std::unordered_set<FaceSet> known;
        const auto add = [&](FaceSet set) {
            if (found.size() < kMostEnds && known.insert(set).second) found.push_back(set);
        };
        for (std::size_t f = 0; f < faces_.size(); ++f)
            if (faces_[f].normal.norm() > kQuarterTurn) add(one(f));
        for (std::size_t i = 0; i < found.size(); ++i) {
            const FaceSet set = found[i];
            FaceSet beside = 0;
            for_each(set, [&](std::size_t f) { beside |= faces_[f].beside; });
            for_each(beside & ~set, [&](std::size_t next) {
                bool fits = faces_[next].normal.norm() > kQuarterTurn;
                for_each(set, [&](std::size_t f) {
                    fits = fits && faces_[f].normal.dot(faces_[next].normal) > -kFacesEnd;
                });
                if (fits) add(set | one(next));
            });
        }
        return found;
    }

    /// The faces whose mean normal is within 60° of a direction, such as a flat end with its grooves and
    /// hollows. Faces whose mean normal is shorter than what a quarter turn takes off it are left out:
    /// the mean normal of a closed ring is 0 but for rounding, so its direction means nothing.
    [[nodiscard]] FaceSet facing(const Vec3& direction) const
    {
        FaceSet set = 0;
        for (std::size_t f = 0; f < faces_.size(); ++f)
            if (faces_[f].normal.dot(direction) > std::max(faces_[f].normal.norm() / 2, 1 - kQuarterTurn))
                set |= one(f);
        return set;
    }

    /// Directions in which flat faces face.
    [[nodiscard]] std::vector<Vec3> directions() const
    {
        std::vector<Vec3> found;
        for (const OneFace& face : faces_)
            if (face.normal.norm() > 1 - kFlatShare && std::ranges::none_of(found, [&](const Vec3& own) {
                    return own.cross(face.normal).norm() < kParallel;
                }))
                found.push_back(face.normal);
        return found;
    }

    /// Whether two sets of faces can be the ends: each wall runs from end to end (`runs_between()`), so that
    /// columns of nodes can follow the edges between walls, and each end is connected.
    [[nodiscard]] bool are_ends(FaceSet source, FaceSet target) const
    {
        const FaceSet all = one(faces_.size()) - 1;
        const FaceSet walls = all & ~source & ~target;
        if (source == 0 || target == 0 || walls == 0 || (source & target) != 0) return false;
        bool fits = true;
        for_each(source, [&](std::size_t f) { fits = fits && (faces_[f].touched & target) == 0; });
        for_each(walls, [&](std::size_t f) {
            fits = fits && (faces_[f].beside & source) != 0 && (faces_[f].beside & target) != 0;
        });
        if (!fits) return false;
        for_each(walls, [&](std::size_t f) { fits = fits && runs_between(faces_[f], source, target); });
        return fits && parts_of(source) == 1 && parts_of(target) == 1 && rims_of(source) == rims_of(target) &&
               rims_of(source) == parts_of(walls);
    }

    /// Cost of two ends: 0 if they are flat, of equal area and perpendicular to their walls.
    [[nodiscard]] double cost(FaceSet source, FaceSet target) const
    {
        return cost_of_end(source) + cost_of_end(target) +
               std::abs(std::log(area_of(source) / area_of(target))) / 4;
    }

    [[nodiscard]] std::vector<FaceId> ids(FaceSet set) const
    {
        std::vector<FaceId> result;
        for_each(set, [&](std::size_t f) { result.emplace_back(f); });
        return result;
    }

    [[nodiscard]] std::vector<EdgeId> shared_edges(std::size_t f, FaceSet with) const
    {
        std::vector<EdgeId> result;
        for (const std::vector<Side>& loop : faces_[f].loops) {
            for (const Side& side : loop)
                if ((with & one(side.face)) != 0) result.push_back(side.edge);
        }
        return result;
    }

private:
    struct Side {
        std::size_t face; ///< the adjacent face
        double length;
        EdgeId edge;
    };
    struct OneFace {
        std::vector<std::vector<Side>> loops;
        FaceSet beside = 0, touched = 0; ///< `beside`: faces that share an edge with this face; `touched`:
                                         ///< faces that share a vertex with it
        Vec3 normal = Vec3::Zero();      ///< mean normal: shorter than 1 if the face bends
        double area = 0;
    };

    /// Whether a face is a ring from end to end, or has four sides: one at the source, the opposite one at
    /// the target, and two at other walls (or both at the same wall).
    static bool runs_between(const OneFace& face, FaceSet source, FaceSet target)
    {
        constexpr int kSource = -1, kTarget = -2;
        const auto label = [&](const Side& side) {
            return (source & one(side.face)) != 0   ? kSource
                   : (target & one(side.face)) != 0 ? kTarget
                                                    : static_cast<int>(side.face);
        };
        std::vector<std::vector<int>> runs;
        for (const std::vector<Side>& loop : face.loops) {
            std::vector<int>& own = runs.emplace_back();
            for (const Side& side : loop)
                if (own.empty() || own.back() != label(side)) own.push_back(label(side));
            if (own.size() > 1 && own.front() == own.back()) own.pop_back();
        }
        if (runs.size() == 2)
            return runs[0].size() == 1 && runs[1].size() == 1 && runs[0][0] < 0 && runs[1][0] < 0 &&
                   runs[0][0] != runs[1][0];
        if (runs.size() != 1 || runs.front().size() != 4) return false;
        const std::vector<int>& sides = runs.front();
        const auto at = static_cast<std::size_t>(std::ranges::find(sides, kSource) - sides.begin());
        return at < 4 && sides[(at + 2) % 4] == kTarget && sides[(at + 1) % 4] >= 0 &&
               sides[(at + 3) % 4] >= 0;
    }

    [[nodiscard]] std::size_t rims_of(FaceSet set) const { return rims(model_, ids(set)).size(); }
    [[nodiscard]] std::size_t parts_of(FaceSet set) const { return connected_parts(model_, ids(set)).size(); }

    [[nodiscard]] double area_of(FaceSet set) const
    {
        double area = 0;
        for_each(set, [&](std::size_t f) { area += faces_[f].area; });
        return area;
    }

    [[nodiscard]] double cost_of_end(FaceSet set) const
    {
        Vec3 sum = Vec3::Zero();
        double slant = 0, length = 0;
        for_each(set, [&](std::size_t f) {
            sum += faces_[f].area * faces_[f].normal;
            for (const std::vector<Side>& loop : faces_[f].loops) {
                for (const Side& side : loop) {
                    if ((set & one(side.face)) != 0) continue;
                    const double leaning = faces_[f].normal.dot(faces_[side.face].normal);
                    slant += side.length * leaning * leaning;
                    length += side.length;
                }
            }
        });
        return 2 * (1 - sum.norm() / area_of(set)) + slant / length;
    }

    const Model& model_;
    std::vector<OneFace> faces_;
};

FaceSet set_of(const std::vector<FaceId>& faces)
{
    FaceSet set = 0;
    for (const FaceId face : faces) set |= one(face.index());
    return set;
}

/// Ends between which a piece can be swept.
struct Ends {
    FaceSet source = 0, target = 0; ///< empty: no ends are known
    double cost = 0;
    bool as_named = false;
    /// For each cut face that is a wall, by name: the edges where it touches the ends, by origin and tag.
    std::map<std::string, std::set<std::pair<Origin, int>>> wall{};
};

/// Number of cut faces that are walls of both pieces but touch the ends of the two pieces along different
/// edges. The rows of quads of both pieces cannot match on such a cut face.
std::size_t unlike(const Ends& a, const Ends& b)
{
    return static_cast<std::size_t>(std::ranges::count_if(a.wall, [&](const auto& wall) {
        const auto other = b.wall.find(wall.first);
        return other != b.wall.end() && other->second != wall.second;
    }));
}

/// Pairs of ends between which a piece can be swept. The current pair comes first if it is valid. If there is
/// no pair, or if the piece is not searched, the list holds one entry with empty ends.
std::vector<Ends> ways_of(const OpenVolume& piece, const RunContext& context)
{
    const Model& model = piece.model;
    if (!fit_in_set(model) || !free_edges(piece).empty()) return {Ends{.as_named = true}};
    const Skin skin(model);
    std::vector<Ends> ways;
    const auto add = [&](FaceSet source, FaceSet target, double cost, bool as_named) {
        Ends& own = ways.emplace_back(Ends{source, target, cost, as_named, {}});
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            const Face& face = model.faces[f];
            if (face.origin != Origin::made_void || face.name.empty() || ((source | target) & one(f)) != 0)
                continue;
            auto& sides = own.wall[face.name];
            for (const EdgeId edge : skin.shared_edges(f, source | target))
                sides.emplace(model[edge].origin, model[edge].tag);
        }
    };
    const FaceSet source = set_of(piece.faces(Role::source)), target = set_of(piece.faces(Role::target));
    const bool fits = skin.are_ends(source, target);
    if (fits) add(source, target, skin.cost(source, target) - 2 * kNamed, true);
    const std::vector<FaceSet> ends = skin.ends();
    const auto consider = [&](FaceSet a, FaceSet b) {
        if (!skin.are_ends(a, b)) return;
        const FaceSet both = a | b;
        if (fits && both == (source | target)) return;
        double cost = skin.cost(a, b);
        for (const FaceSet named : {source, target})
            if (named != 0 && (named & both) == named) cost -= kNamed;
        const bool turned = (b & source) != 0 || (a & target) != 0;
        add(turned ? b : a, turned ? a : b, cost, false);
    };
    for (std::size_t a = 0; a < ends.size(); ++a) {
        check_cancelled(context);
        for (std::size_t b = a + 1; b < ends.size(); ++b) consider(ends[a], ends[b]);
    }
    const auto is_known = [&](FaceSet set) { return std::ranges::find(ends, set) != ends.end(); };
    std::vector<FaceSet> sides;
    for (const Vec3& direction : skin.directions())
        for (const FaceSet side : {skin.facing(direction), skin.facing(-direction)})
            if (std::ranges::find(sides, side) == sides.end()) sides.push_back(side);
    for (std::size_t a = 0; a < sides.size(); ++a)
        for (std::size_t b = a + 1; b < sides.size(); ++b)
            if (!is_known(sides[a]) || !is_known(sides[b])) consider(sides[a], sides[b]);
    if (ways.empty()) ways.emplace_back();
    return ways;
}

} // namespace

bool fit_in_set(const Model& model) { return model.faces.size() <= std::numeric_limits<FaceSet>::digits; }

ReadPieces read_ends(std::vector<StepPiece> pieces, const RunContext& context)
{
    std::vector<std::vector<Ends>> ways;
    bool all_fit = true;
    for (const StepPiece& piece : pieces) {
        ways.push_back(ways_of(piece.volume, context));
        all_fit = all_fit && ways.back().front().as_named;
    }
    if (all_fit) return {std::move(pieces)};
    // For each pair of ends of the first piece, choose the best pair of each following piece in turn.
    std::vector<const Ends*> best;
    // Ends come first whose rows of quads match on most cuts.
    std::pair least(kNoIndex, kInfinity);
    for (const Ends& first : ways.front()) {
        check_cancelled(context);
        std::vector<const Ends*> chosen{&first};
        std::pair sum(std::size_t{0}, first.cost);
        for (std::size_t p = 1; p < ways.size(); ++p) {
            const auto worth = [&](const Ends& own) {
                std::pair cost(std::size_t{0}, own.cost);
                for (const Ends* other : chosen) cost.first += unlike(own, *other);
                return cost;
            };
            chosen.push_back(&*std::ranges::min_element(ways[p], {}, worth));
            const auto last = worth(*chosen.back());
            sum = {sum.first + last.first, sum.second + last.second};
        }
        if (sum >= least) continue;
        least = sum;
        best = std::move(chosen);
    }
    std::size_t changed = 0;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        if (best[p]->as_named || best[p]->source == 0) continue;
        ++changed;
        OpenVolume& piece = pieces[p].volume;
        std::ranges::fill(piece.role, Role::wall);
        for_each(best[p]->source, [&](std::size_t f) { piece.role[f] = Role::source; });
        for_each(best[p]->target, [&](std::size_t f) { piece.role[f] = Role::target; });
        piece.turned_round = false;
    }
    return {std::move(pieces), changed};
}

bool walls_run_between_ends(const OpenVolume& volume)
{
    return fit_in_set(volume.model) && free_edges(volume).empty() &&
           Skin(volume.model)
               .are_ends(set_of(volume.faces(Role::source)), set_of(volume.faces(Role::target)));
}

bool ends_suit_columns(const OpenVolume& volume)
{
    const Model& model = volume.model;
    const auto mean = [&](Role end) -> Vec3 {
        return area_vector_of(model, volume.faces(end)).stableNormalized();
    };
    const Vec3 source = mean(Role::source), target = mean(Role::target);
    // A riser inclines the mean normal of its own end towards itself, but not that of the opposite end.
    const bool opposite = source.dot(target) < -kContinues;
    for (const Role end : {Role::source, Role::target}) {
        const Vec3 &here = end == Role::source ? source : target,
                   &there = end == Role::source ? target : source;
        for (const FaceId face : volume.faces(end)) {
            const Vec3 own = face_area_vector(model, face);
            const double least = kFacesEnd * own.norm();
            if (own.dot(here) < least || (opposite && -own.dot(there) < least)) return false;
        }
    }
    // A wall parallel to both ends is a shoulder between two sections.
    const double parallel = std::sqrt(1 - kFacesEnd * kFacesEnd);
    const auto is_shoulder = [&](FaceId wall) {
        const Vec3 own = face_area_vector(model, wall);
        return std::abs(own.dot(source)) > parallel * face_area(model, wall);
    };
    if (source.dot(target) < -parallel && std::ranges::any_of(volume.faces(Role::wall), is_shoulder))
        return false;
    const auto is_wall = [&](FaceId face) { return volume.role[face.index()] == Role::wall; };
    return std::ranges::all_of(volume.faces(Role::wall), [&](FaceId wall) {
        return std::ranges::all_of(faces_in_line(model, wall), [&](const auto& pair) {
            return is_wall(pair.first) == is_wall(pair.second);
        });
    });
}

void check_ends(const OpenVolume& volume, const std::string& what)
{
    const Model& model = volume.model;
    if (!free_edges(volume).empty()) return;
    const std::vector<FaceId> source = volume.faces(Role::source), target = volume.faces(Role::target),
                              walls = volume.faces(Role::wall);
    if (!source.empty() && !target.empty()) return;
    const char *missing = source.empty() ? "source" : "target", *other = source.empty() ? "target" : "source";
    const bool is_piece = std::ranges::any_of(
        model.faces, [](const Face& face) { return face.origin == Origin::made_void && !face.name.empty(); });
    Message message = source.empty() && target.empty()
                          ? Message("closure.no_ends", "{} has neither source nor target: its walls are {}",
                                    what, entities_of(model, walls))
                          : Message("closure.no_ends", "{} has no {}: its {} is {}, and its walls are {}",
                                    what, missing, other,
                                    entities_of(model, source.empty() ? target : source),
                                    entities_of(model, walls));
    if (is_piece)
        throw NotSweepable(
            std::move(message).remedy("cut the volume otherwise, or set fallback = \"leave_out\""));
    throw NotSweepable(std::move(message).remedy("name the {} among them", missing));
}

} // namespace lacuna::closure
