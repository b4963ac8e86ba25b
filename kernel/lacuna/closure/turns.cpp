// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/turns.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/patches.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

std::vector<std::vector<FaceId>> parts_of(const Model& model)
{
    return connected_parts(model, all_faces(model));
}

/// Whether faces are oriented away from the centroid of their facets.
bool faces_outward(const Model& model, const std::vector<FaceId>& faces)
{
    const Vec3 centre = centroid_of(model, faces);
    double sum = 0;
    for (const Triangle& t : facets_of(model, faces)) {
        const Vec3 &a = model.at(t[0]), &b = model.at(t[1]), &c = model.at(t[2]);
        sum += ((a + b + c) / 3 - centre).dot((b - a).cross(c - a));
    }
    return sum >= 0;
}

/// Positive if the ends in a part face the opposite ends, negative if they face away from them. An opposite
/// end in the same part counts only if no other part has one.
/// @return  sum over both ends: area times the cosine between the normal and the direction to the centre of
///          the opposite ends [model length²].
double faces_opposite(const OpenVolume& volume, const std::vector<FaceId>& part)
{
    double before = 0;
    for (const Role end : {Role::source, Role::target}) {
        std::vector<FaceId> own, opposite = volume.faces(end == Role::source ? Role::target : Role::source);
        std::ranges::copy_if(part, std::back_inserter(own),
                             [&](FaceId face) { return volume.role[face.index()] == end; });
        const auto apart = std::ranges::stable_partition(
            opposite, [&](FaceId face) { return std::ranges::find(part, face) == part.end(); });
        if (apart.begin() != opposite.begin()) opposite.erase(apart.begin(), opposite.end());
        if (own.empty() || opposite.empty()) continue;
        const Vec3 area = area_vector_of(volume.model, own);
        const Vec3 way = centroid_of(volume.model, opposite) - centroid_of(volume.model, own);
        const double along = area.dot(way.stableNormalized());
        if (std::abs(along) > kParallel * area.norm()) before += along;
    }
    return before;
}

/// Positive if the walls of a part lie in front of its ends, on the side to which the ends' normals point;
/// negative if they lie behind the ends. 0 if some lie in front and some behind, or if the part lacks an end.
/// Walls that join both ends lie on the side of the void. The riser of a stepped end is an exception: it lies
/// on the other side of the step above it.
/// @param folds  `folds_across()` of each edge.
/// @return  sum over the edges that an end and a wall share: length times the cosine of the angle between the
///          wall and the end's normal [model length].
double leaves_before(const OpenVolume& volume, const std::vector<FaceId>& part,
                     const std::vector<double>& folds)
{
    const Model& model = volume.model;
    double before = 0, behind = 0;
    std::set<Role> ends;
    for (const FaceId face : part) {
        if (volume.role[face.index()] == Role::wall) continue;
        ends.insert(volume.role[face.index()]);
        for (const EdgeUse& use : uses_of(model[face])) {
            for (const FaceUse& user : model.uses_of_edge(use.edge)) {
                if (volume.role[user.face.index()] != Role::wall) continue;
                const double leaves = -edge_length(model, use.edge) *
                                      std::sin(folds[use.edge.index()] * kDegree);
                (leaves > 0 ? before : behind) += leaves;
            }
        }
    }
    return ends.size() < 2 || (before > 0 && behind < 0) ? 0 : before + behind;
}

/// For each part, whether its facets face the void. The first rule that applies decides:
/// 1. an open part, inside no other part, whose walls all lie on one side of its ends: the void is there too;
/// 2. another open part with an end that faces towards or away from the opposite end: the void is on the side
///    of its ends that faces the opposite ends;
/// 3. any other part: the void is on the side of the facets' centroid, or on the other side if the part is
///    inside another part.
std::vector<bool> parts_facing_void(const OpenVolume& volume, const std::vector<std::vector<FaceId>>& parts,
                                    const std::vector<double>& folds, const RunContext& context)
{
    const Model& model = volume.model;
    const std::vector<bool> inner = inner_parts(model, parts, context);
    std::vector<bool> facing;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        check_cancelled(context);
        double before = 0;
        if (!rims(model, parts[p]).empty()) {
            if (!inner[p]) before = leaves_before(volume, parts[p], folds);
            if (before == 0) before = faces_opposite(volume, parts[p]);
        }
        facing.push_back(before != 0 ? before > 0 : faces_outward(model, parts[p]) == inner[p]);
    }
    return facing;
}

} // namespace

std::vector<double> concave_turns(const OpenVolume& volume, const RunContext& context)
{
    return skin_turns(volume, context).concave;
}

SkinTurns skin_turns(const OpenVolume& volume, const RunContext& context)
{
    const std::vector<std::vector<FaceId>> parts = parts_of(volume.model);
    SkinTurns turns{folds_across(volume.model, context), std::vector<bool>(volume.model.faces.size(), true)};
    const std::vector<bool> facing = parts_facing_void(volume, parts, turns.concave, context);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (facing[p]) continue;
        for (const EdgeId edge : edges_of(volume.model, parts[p])) turns.concave[edge.index()] *= -1;
        for (const FaceId face : parts[p]) turns.faces_void[face.index()] = false;
    }
    return turns;
}

void face_away(OpenVolume& volume, const RunContext& context)
{
    const std::vector<std::vector<FaceId>> parts = parts_of(volume.model);
    const std::vector<bool> facing = parts_facing_void(volume, parts, folds_across(volume.model, context),
                                                       context);
    for (std::size_t p = 0; p < parts.size(); ++p)
        if (facing[p]) flip_faces(volume.model, parts[p]);
}

} // namespace lacuna::closure
