// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/hollows.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/facet_sag.h>
#include <lacuna/topology/shared/patches.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>

namespace lacuna::topology {

namespace {

/// The parts of the model without free edges. @pre oriented
std::vector<std::vector<FaceId>> closed_shells(const Model& model)
{
    std::vector<std::vector<FaceId>> shells = connected_parts(model, all_faces(model));
    const auto is_shared = [&](const EdgeUse& use) { return model.uses_of_edge(use.edge).size() == 2; };
    std::erase_if(shells, [&](const std::vector<FaceId>& part) {
        return !std::ranges::all_of(
            part, [&](FaceId face) { return std::ranges::all_of(uses_of(model[face]), is_shared); });
    });
    return shells;
}

Vec3 facet_centre(const Model& model, const Triangle& t)
{
    return (model.at(t[0]) + model.at(t[1]) + model.at(t[2])) / 3;
}

/// The faces that bound one region alone. Faces between two regions of a mesh lie inside the solid.
std::vector<FaceId> outer_faces(const Model& model)
{
    std::vector<FaceId> faces = all_faces(model);
    std::erase_if(faces, [&](FaceId face) { return model[face].regions.size() > 1; });
    return faces;
}

Model only(const Model& model, const std::vector<FaceId>& faces)
{
    return faces.size() == model.faces.size() ? model : extract(model, faces);
}

/// Flip the shells that lie inside an odd number of other shells: the space inside them is not part of the
/// solid. @pre each shell faces outward. @return the flipped shells.
std::vector<std::vector<FaceId>> turn_inner_shells(Model& model,
                                                   const std::vector<std::vector<FaceId>>& shells,
                                                   const RunContext& context)
{
    const std::vector<bool> inner = inner_parts(model, shells, context);
    std::vector<std::vector<FaceId>> turned;
    for (std::size_t s = 0; s < shells.size(); ++s) {
        if (!inner[s]) continue;
        flip_faces(model, shells[s]);
        turned.push_back(shells[s]);
    }
    return turned;
}

/// Largest coordinate of the faces' points along a direction.
double reach(const Model& model, const std::vector<FaceId>& faces, const Vec3& way)
{
    double most = -kInfinity;
    for (const FaceId face : faces)
        for (const Index p : corners_of(model[face])) most = std::max(most, way.dot(model.at(p)));
    return most;
}

/// Finds the faces of bodies that stand in cavities. If the faces of a cavity are removed, the skin falls
/// into parts, bounded by the cavity's rims.
/// - The part with the largest area is the outside. The rims between the outside and the cavity are the
///   cavity's mouths.
/// - Any other part stands in the cavity if all of it lies below the mouths.
/// - Other hollows with two or more rims, such as through bores, are removed too, so that they do not connect
///   parts. Such a hollow stands in the cavity if none of its rims is on the outside.
class Standing {
public:
    /// @param model     oriented
    /// @param hollows   in `model`
    /// @param apart     faces of cavities that are no hollows with two or more rims
    Standing(const Model& model, const std::vector<Hollow>& hollows, const std::vector<FaceId>& apart = {})
        : model_(model), hollows_(hollows), part_at_(model.edges.size(), kNoIndex)
    {
        std::vector<bool> left(model.faces.size(), true);
        for (const FaceId face : apart) left[face.index()] = false;
        for (const Hollow& hollow : hollows)
            for (const FaceId face : hollow.faces)
                if (hollow.mouths > 1) left[face.index()] = false;
        std::vector<FaceId> rest = all_faces(model);
        std::erase_if(rest, [&](FaceId face) { return !left[face.index()]; });
        parts_ = connected_parts(model, rest);
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            double& area = area_.emplace_back(0);
            for (const FaceId face : parts_[p]) {
                area += face_area(model, face);
                for (const EdgeUse& use : uses_of(model[face])) part_at_[use.edge.index()] = p;
            }
        }
    }

    std::vector<FaceId> in(const std::vector<FaceId>& cavity)
    {
        const std::vector<Rim> mouths = rims(model_, cavity);
        const auto part_at = [&](const Rim& rim) { return part_at_[rim.uses.front().edge.index()]; };
        std::set<std::size_t> beside;
        for (const Rim& rim : mouths)
            for (const EdgeUse& use : rim.uses) beside.insert(part_at_[use.edge.index()]);
        beside.erase(kNoIndex);
        if (beside.empty()) return {};
        const std::size_t outside = *std::ranges::max_element(beside, {},
                                                              [&](std::size_t part) { return area_[part]; });
        beside.erase(outside);
        std::vector<std::vector<FaceId>> standing;
        for (const std::size_t part : beside) standing.push_back(parts_[part]);
        for (const std::size_t hollow : hollows_off(outside))
            if (const auto& faces = hollows_[hollow].faces;
                std::ranges::find_first_of(faces, cavity) == faces.end())
                standing.push_back(faces);
        for (const Rim& rim : mouths) {
            if (standing.empty()) break;
            if (part_at(rim) != outside) continue;
            const std::vector<Vec3> mouth = loop_places(model_, rim.uses);
            const Vec3 out = geometry::newell_vector(mouth).stableNormalized();
            double brim = kInfinity;
            for (const Vec3& p : mouth) brim = std::min(brim, out.dot(p));
            std::erase_if(standing, [&](const auto& part) {
                return !(reach(model_, part, out) < brim - model_.tolerance);
            });
        }
        std::vector<FaceId> result;
        for (const std::vector<FaceId>& part : standing)
            result.insert(result.end(), part.begin(), part.end());
        return result;
    }

private:
    /// The hollows with two or more rims of which none is on a part.
    const std::vector<std::size_t>& hollows_off(std::size_t part)
    {
        const auto [found, fresh] = off_.try_emplace(part);
        for (std::size_t h = 0; fresh && h < hollows_.size(); ++h) {
            const std::set<EdgeId> own = rim_edges(model_, hollows_[h].faces);
            if (hollows_[h].mouths > 1 &&
                std::ranges::none_of(own, [&](EdgeId edge) { return part_at_[edge.index()] == part; }))
                found->second.push_back(h);
        }
        return found->second;
    }

    const Model& model_;
    const std::vector<Hollow>& hollows_;
    std::vector<std::vector<FaceId>> parts_;
    std::vector<double> area_;         ///< of the parts [model length²]
    std::vector<std::size_t> part_at_; ///< by edge: the part that it bounds; `kNoIndex`: none
    std::map<std::size_t, std::vector<std::size_t>> off_; ///< see `hollows_off()`
};

/// Groups of faces, and the groups that share an edge with each.
struct FaceGroups {
    std::map<std::size_t, std::vector<FaceId>> faces;
    std::map<std::size_t, std::set<std::size_t>> beside;
    std::vector<std::size_t> seen; ///< by face: the group that it looks at; `kNoIndex` if it looks outside
};

/// The group that each face looks at, along the normal of its largest facet.
std::vector<std::size_t> groups_seen(const Model& model,
                                     const std::map<std::size_t, std::vector<FaceId>>& groups,
                                     const RunContext& context)
{
    std::vector<Triangle> skin;
    std::vector<std::size_t> group_of; // by facet
    for (const auto& [group, faces] : groups)
        for (const FaceId face : faces) {
            std::ranges::copy(model[face].triangles, std::back_inserter(skin));
            group_of.resize(skin.size(), group);
        }
    const geometry::FacetTree tree(model.points, skin, context);
    std::vector<std::size_t> seen(model.faces.size(), kNoIndex);
    const auto area = [&](const Triangle& t) { return facet_area_vector(model, t).squaredNorm(); };
    for (const auto& [group, faces] : groups)
        for (const FaceId face : faces) {
            const Triangle& t = *std::ranges::max_element(model[face].triangles, {}, area);
            const Vec3 out = facet_area_vector(model, t).stableNormalized();
            const auto hit = tree.first_along(facet_centre(model, t) + model.tolerance * out, out);
            if (hit.triangle >= 0) seen[face.index()] = group_of[index(hit.triangle)];
        }
    return seen;
}

/// The groups that enclose the mouth of a hollow, such as the neck of a T-slot: those beside it of which a
/// face looks at the hollow or at another group beside it.
/// @param hollow  groups of the hollow
std::set<std::size_t> neck_of(const FaceGroups& groups, const std::set<std::size_t>& hollow)
{
    std::set<std::size_t> near = hollow, neck;
    for (const std::size_t group : hollow)
        if (const auto found = groups.beside.find(group); found != groups.beside.end())
            near.insert(found->second.begin(), found->second.end());
    for (const std::size_t group : near) {
        const auto looks_inside = [&](FaceId face) {
            const std::size_t seen = groups.seen[face.index()];
            return seen != group && near.contains(seen);
        };
        if (!hollow.contains(group) && std::ranges::any_of(groups.faces.at(group), looks_inside))
            neck.insert(group);
    }
    return neck;
}

} // namespace

std::vector<bool> inner_parts(const Model& model, const std::vector<std::vector<FaceId>>& parts,
                              const RunContext& context)
{
    std::vector<bool> inner(parts.size(), false);
    if (parts.size() < 2) return inner;
    for (std::size_t o = 0; o < parts.size(); ++o) {
        check_cancelled(context);
        const geometry::FacetTree tree(model.points, facets_of(model, parts[o]), context);
        for (std::size_t p = 0; p < parts.size(); ++p) {
            if (p == o) continue;
            const Vec3 at = facet_centre(
                model, model[parts[p].front()].triangles.front()); // corners may be shared by both parts
            if (tree.bounds().contains(at) && std::round(tree.winding_number(at)) != 0) inner[p] = !inner[p];
        }
    }
    return inner;
}

void orient_skin(Model& model, const RunContext& context)
{
    const std::vector<std::vector<FaceId>> parts = connected_parts(model, all_faces(model));
    const std::vector<bool> inner = inner_parts(model, parts, context);
    for (std::size_t p = 0; p < parts.size(); ++p)
        if ((volume_integral(model, parts[p]) > 0) == inner[p]) flip_faces(model, parts[p]);
}

void orient_faces(Model& model, const RunContext& context)
{
    orient_consistently(model);
    for (std::size_t e = 0; e < model.edges.size(); ++e)
        if (model.uses_of_edge(EdgeId(e)).size() == 1) return;
    orient_skin(model, context);
}

bool is_listed_before(const std::vector<FaceId>& a, const std::vector<FaceId>& b)
{
    return a.front() != b.front() ? a.front() < b.front() : a.size() > b.size();
}

std::vector<Hollow> hollows(const Model& given, const RunContext& context)
{
    const std::vector<FaceId> outer = outer_faces(given);
    Model model = only(given, outer);
    if (!attempt<InvalidInput>([&] { orient_consistently(model); })) return {};
    const std::vector<std::vector<FaceId>> shells = closed_shells(model);
    const std::vector<std::vector<FaceId>> inner = turn_inner_shells(model, shells, context);
    const std::vector<double> fold = folds_across(model, context);
    geometry::UnionFind hang(model.faces.size());
    for (const std::vector<FaceId>& shell : inner)
        for (const FaceId face : shell) hang.unite_least(shell.front().index(), face.index());
    for (std::size_t e = 0; e < fold.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() == 2 && fold[e] < kCreaseAngle)
            hang.unite_least(uses[0].face.index(), uses[1].face.index());
    }
    FaceGroups groups;
    for (const std::vector<FaceId>& shell : shells)
        for (const FaceId face : shell) groups.faces[hang.find(face.index())].push_back(face);
    for (std::size_t e = 0; e < fold.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() != 2) continue;
        const std::size_t a = hang.find(uses[0].face.index()), b = hang.find(uses[1].face.index());
        if (a == b || !groups.faces.contains(a) || !groups.faces.contains(b)) continue;
        groups.beside[a].insert(b);
        groups.beside[b].insert(a);
    }
    groups.seen = groups_seen(model, groups.faces, context);
    std::vector<Hollow> found;
    const auto take = [&](std::vector<FaceId> faces) {
        std::sort(faces.begin(), faces.end());
        const bool flat = std::all_of(faces.begin(), faces.end(),
                                      [&](FaceId face) { return model[face].kind == "plane"; });
        const double volume = -volume_of_cones(model, faces, centroid_of(model, faces));
        if ((flat && faces.size() < 3) || !(volume > 0)) return false;
        const std::size_t mouths = rims(model, faces).size();
        found.push_back({std::move(faces), mouths, {}, volume});
        return true;
    };
    for (const auto& [root, faces] : groups.faces) {
        check_cancelled(context);
        if (!take(faces)) continue;
        std::set<std::size_t> hollow{root};
        std::vector<FaceId> wider = faces;
        for (auto neck = neck_of(groups, hollow); !neck.empty(); neck = neck_of(groups, hollow)) {
            hollow.insert(neck.begin(), neck.end());
            for (const std::size_t group : neck)
                std::ranges::copy(groups.faces.at(group), std::back_inserter(wider));
            take(wider);
        }
    }
    Standing standing(model, found);
    for (Hollow& hollow : found)
        if (hollow.mouths > 1) hollow.inside = standing.in(hollow.faces);
    for (Hollow& hollow : found)
        for (std::vector<FaceId>* faces : {&hollow.faces, &hollow.inside})
            for (FaceId& face : *faces) face = outer[face.index()];
    std::ranges::stable_sort(found, is_listed_before, &Hollow::faces);
    return found;
}

std::vector<std::size_t> joined_hollows(const Model& model, const std::vector<Hollow>& hollows)
{
    std::map<EdgeId, std::size_t> first; // first hollow with this edge on a rim
    geometry::UnionFind hang(hollows.size());
    for (std::size_t h = 0; h < hollows.size(); ++h)
        for (const Rim& rim : rims(model, hollows[h].faces))
            for (const EdgeUse& use : rim.uses)
                hang.unite_least(first.emplace(use.edge, h).first->second, h);
    std::vector<std::size_t> joined;
    for (std::size_t h = 0; h < hollows.size(); ++h) joined.push_back(hang.find(h));
    return joined;
}

std::vector<FaceId> cavity_round(const Model& given, const std::vector<FaceId>& faces,
                                 const RunContext& context)
{
    const std::vector<FaceId> outer = outer_faces(given);
    Model model = only(given, outer);
    const std::set<FaceId> asked(faces.begin(), faces.end());
    std::vector<FaceId> named; // the faces, in `model`
    for (std::size_t f = 0; f < outer.size(); ++f)
        if (asked.contains(outer[f])) named.emplace_back(f);
    const bool open = named.size() < asked.size() || std::ranges::any_of(named, [&](FaceId face) {
                          const std::vector<Loop>& loops = model[face].loops; // no loops: closed by itself
                          return !loops.empty() &&
                                 model.uses_of_edge(loops.front().uses.front().edge).size() != 2;
                      });
    const std::vector<Hollow> found = open ? std::vector<Hollow>() : hollows(model, context);
    if (found.empty()) return {};
    orient_consistently(model);
    const std::vector<std::size_t> first = joined_hollows(model, found);
    std::set<std::size_t> taken;
    for (std::size_t h = 0; h < found.size(); ++h)
        if (std::ranges::find_first_of(found[h].faces, named) != found[h].faces.end()) taken.insert(first[h]);
    std::vector<FaceId> cavity;
    for (std::size_t h = 0; h < found.size(); ++h)
        if (taken.contains(first[h])) std::ranges::copy(found[h].faces, std::back_inserter(cavity));
    if (cavity.empty()) return {};
    for (const FaceId face : Standing(model, found, cavity).in(cavity)) cavity.push_back(face);
    for (FaceId& face : cavity) face = outer[face.index()];
    std::sort(cavity.begin(), cavity.end()); // a face may be in several hollows
    cavity.erase(std::unique(cavity.begin(), cavity.end()), cavity.end());
    return cavity;
}

Bodies::Bodies(const Model& model) : body_(model.faces.size(), kNoIndex)
{
    for (const FaceId face : all_faces(model)) area_.push_back(face_area(model, face));
    for (const std::vector<FaceId>& shell : closed_shells(model)) {
        if (!(volume_integral(model, shell) > 0)) continue;
        double& skin = skin_.emplace_back(0);
        for (const FaceId face : shell) {
            body_[face.index()] = skin_.size() - 1;
            skin += area_[face.index()];
        }
    }
}

double Bodies::share_of(const std::vector<FaceId>& faces) const
{
    std::map<std::size_t, double> named; // area of each body
    for (const FaceId face : faces) {
        if (body_[face.index()] == kNoIndex) return 1;
        named[body_[face.index()]] += area_[face.index()];
    }
    double largest = 0;
    for (const auto& [body, area] : named) largest = std::max(largest, area / skin_[body]);
    return largest;
}

bool lies_in_material(const Model& model, const std::vector<FaceId>& faces, const Model& sealed)
{
    std::map<int, FaceId> by_tag;
    for (const FaceId face : faces) by_tag.emplace(model[face].tag, face);
    double alike = 0; // area with the same outward side [model length²]
    for (const FaceId face : all_faces(sealed)) {
        const auto found = by_tag.find(sealed[face].tag);
        if (sealed[face].origin != Origin::given || found == by_tag.end()) continue;
        const Triangle& largest = *std::ranges::max_element(
            sealed[face].triangles, {},
            [&](const Triangle& t) { return facet_area_vector(sealed, t).squaredNorm(); });
        const Vec3 at = facet_centre(sealed, largest);
        const Triangle& own = *std::ranges::min_element(
            model[found->second].triangles, {},
            [&](const Triangle& t) { return (facet_centre(model, t) - at).squaredNorm(); });
        const bool same = facet_area_vector(sealed, largest).dot(facet_area_vector(model, own)) > 0;
        alike += (same ? 1 : -1) * face_area(sealed, face);
    }
    return alike > 0;
}

std::optional<FaceId> any_inside(const Model& model, const std::vector<FaceId>& faces,
                                 const geometry::FacetTree& tree)
{
    // Parts of a body may stick out of the volume, so the place deepest in the volume's box decides.
    const auto depth = [&](const Vec3& p) {
        return std::min((p - tree.bounds().min()).minCoeff(), (tree.bounds().max() - p).minCoeff());
    };
    const auto inside = std::ranges::find_if(faces, [&](FaceId face) {
        const auto centre = [&](const Triangle& t) { return facet_centre(model, t); };
        const Vec3 deepest = centre(*std::ranges::max_element(
            model[face].triangles, {}, [&](const Triangle& t) { return depth(centre(t)); }));
        // A face on the skin, whose facets may be others, is not inside.
        const double off = model.tolerance + 2 * facet_sag(model, model[face]);
        return depth(deepest) > off && tree.closest(deepest, off * off).triangle < 0 &&
               std::round(tree.winding_number(deepest)) != 0;
    });
    return inside == faces.end() ? std::nullopt : std::optional(*inside);
}

std::vector<FaceId> bodies_inside(const Model& model, const Model& volume, const RunContext& context)
{
    std::set<int> own;
    for (const Face& face : volume.faces)
        if (face.origin == Origin::given) own.insert(face.tag);
    std::vector<FaceId> others = outer_faces(model);
    std::erase_if(others, [&](FaceId face) { return own.contains(model[face].tag); });
    Eigen::AlignedBox3d box;
    for (const Face& face : volume.faces)
        for (const Index p : corners_of(face)) box.extend(volume.at(p));
    const auto may_be_inside = [&](FaceId face) {
        return std::ranges::any_of(model[face].triangles, [&](const Triangle& t) {
            const Vec3 centre = facet_centre(model, t);
            return (centre.array() > box.min().array()).all() && (centre.array() < box.max().array()).all();
        });
    };
    std::vector<FaceId> found;
    if (std::ranges::none_of(others, may_be_inside)) return found;
    const geometry::FacetTree tree(volume.points, facets_of(volume, all_faces(volume)), context);
    for (const std::vector<FaceId>& part : connected_parts(model, others)) {
        check_cancelled(context);
        if (const auto inside = any_inside(model, part, tree)) found.push_back(*inside);
    }
    return found;
}

} // namespace lacuna::topology
