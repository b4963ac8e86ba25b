// SPDX-License-Identifier: MIT
#include <lacuna/sweep/fidelity.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/matching/side_lines.h>
#include <lacuna/surface/shared/face_shape.h>
#include <lacuna/sweep/detail/compare_face.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/topology/shared/face_facts.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Lower bound of the allowed distance: this share of the model's diagonal, or this share of the face's
/// diagonal if that is smaller. Faces of real parts have gaps and overlaps of this size, which no mesh
/// resolves.
constexpr double kLeastOfModel = 1e-4, kLeastOfFace = 1e-2;

/// Allowed relative difference between the mesh's volume and the sealed volume. A disc with six sides per
/// turn, the fewest that the size alone permits, loses 17 %, so the limit must be higher. Not measured.
constexpr double kMostOfVolume = 0.2;

/// The result for a face on which the skin has no quads.
FaceFidelity left_out(const Model& model, const Skin& skin, FaceId face, const DeviationLimit& limit)
{
    FaceFidelity result;
    result.face = face;
    result.place = result.found_at = face_centroid(model, face);
    double rim = 0;
    for (const Loop& loop : model[face].loops) {
        for (const EdgeUse& use : loop.uses) rim += edge_length(model, use.edge);
    }
    const double width = rim > 0 ? 2 * face_area(model, face) / rim : 0;
    result.max_distance = result.mean_distance = result.found = width;
    double nearest = kInfinity;
    for (const SkinOfFace& other : skin.faces) {
        for (std::size_t q = 0; q < other.quads.size(); ++q) {
            const double distance = (skin.points[index(other.quads[q][0])] - result.place).squaredNorm();
            if (distance >= nearest) continue;
            nearest = distance;
            result.side = other.side[q];
        }
    }
    result.allowed = limit.length > 0 ? limit.length : std::max(limit.share * result.side, limit.least);
    if (width > result.allowed) result.misfit = Misfit::no_quads;
    return result;
}

/// Walls that continue over void faces. They are compared together with these faces.
struct Continued {
    std::map<FaceId, FaceId> wall;       ///< by void face
    std::map<FaceId, SkinOfFace> joined; ///< by wall
};

/// @param shapes  by face; the shapes of void faces are appended to those of their walls
Continued join_continued(const OpenVolume& volume, const Skin& skin, std::vector<surface::FaceShape>& shapes)
{
    Continued result;
    for (const FaceId face : volume.faces(Role::wall)) {
        const std::optional<FaceId> wall = matching::continued_wall(volume.model, face);
        if (!wall) continue;
        result.wall[face] = *wall;
        SkinOfFace& all = result.joined.try_emplace(*wall, skin.faces[wall->index()]).first->second;
        const SkinOfFace& more = skin.faces[face.index()];
        all.quads.insert(all.quads.end(), more.quads.begin(), more.quads.end());
        all.item.insert(all.item.end(), more.item.begin(), more.item.end());
        all.side.insert(all.side.end(), more.side.begin(), more.side.end());
        shapes[wall->index()].append(shapes[face.index()]);
    }
    return result;
}

std::string at_place(const Vec3& p) { return place_with_digits(p, 4); }

/// A length a little below `value`, rounded to two digits.
double rounded_down(double value)
{
    const double step = std::pow(10, std::floor(std::log10(value)) - 1);
    return std::floor(value / step) * step;
}

/// The face that exceeds the allowed distance most; null: none does.
const FaceFidelity* worst_misfit(const Fidelity& fidelity)
{
    const FaceFidelity* worst = nullptr;
    for (const FaceFidelity& face : fidelity.faces) {
        if (face.misfit == Misfit::none) continue;
        if (worst == nullptr || face.found * worst->allowed > worst->found * face.allowed) worst = &face;
    }
    return worst;
}

/// Suggest the number of layers, or the size, with which straight sides follow the curvature of a face. Side
/// lengths vary, so the suggestion is a tenth finer than the sag requires.
Message with_finer_sides(Message message, const FaceFidelity& face, int layers,
                         const FidelityOptions& options)
{
    // The sag of a straight side is proportional to the square of its length. The ratio of sag and length is
    // proportional to the length.
    const double share = kSuggestedShare * face.allowed / face.found;
    const double by = options.max_deviation > 0 ? std::sqrt(share) : share;
    if (face.along_layers) {
        return std::move(message).remedy(
            "use {} layers instead of {}: straight sides then follow the bend from layer to layer",
            needed(static_cast<int>(std::ceil(layers / by))), found(layers));
    }
    const double asked = options.size ? options.size(face.found_at) : face.source_side;
    return std::move(message).remedy(
        "use a size of {:.2g}: a straight side of {:.2g} does not follow the bend",
        needed(rounded_down(std::min(face.source_side, asked) * by)), found(face.side));
}

} // namespace

void sum_distances(Fidelity& fidelity, const Model& model)
{
    double area = 0, sum = 0;
    fidelity.max_distance = 0;
    for (const FaceFidelity& face : fidelity.faces) {
        const double own = face_area(model, face.face);
        fidelity.max_distance = std::max(fidelity.max_distance, face.max_distance);
        sum += own * face.mean_distance;
        area += own;
    }
    fidelity.mean_distance = area > 0 ? sum / area : 0;
}

DeviationLimit limit_of(const Model& model, FaceId face, const FidelityOptions& options)
{
    const bool made_void = model[face].origin == Origin::made_void;
    const bool between = made_void && options.between.contains(face);
    const Eigen::AlignedBox3d box = box_of(model, face);
    const double least = box.isEmpty()
                             ? 0
                             : std::min(kLeastOfModel * model.diagonal, kLeastOfFace * box.diagonal().norm());
    return {options.max_deviation, between ? 1 : kFollowsFace, least, !made_void}; // between volumes: a side
}

namespace {

/// Compare the skin of a mesh with the sealed skin.
/// @param mesh   as in compare_face()
/// @param order  order of the cells
Fidelity compare(const OpenVolume& volume, const mesh::HexMesh* mesh, int order, const Skin& skin,
                 const std::set<FaceId>& kept, double volume_of_mesh, const FidelityOptions& options,
                 const RunContext& context)
{
    const Model& model = volume.model;
    Fidelity result;
    result.volume = volume_of_mesh;
    const Vec3 origin = skin.points.front();
    std::vector<surface::FaceShape> shapes;
    for (const SkinOfFace& patch : skin.faces) {
        check_cancelled(context);
        const double side = patch.quads.empty() ? kInfinity : patch.mean_side;
        shapes.push_back(surface::face_shape(model, patch.face, [side](const Vec3&) { return side; }));
        result.sealed_volume += shapes.back().volume_integral(origin);
    }
    const double sign = result.sealed_volume < 0 ? -1 : 1;
    result.sealed_volume *= sign;
    const Continued continued = join_continued(volume, skin, shapes);
    // Faces are compared in parallel, because the comparison of one large face uses only one thread in part.
    RunContext quiet;
    quiet.threads = context.threads;
    quiet.cancel = context.cancel;
    std::vector<FaceFidelity> compared(skin.faces.size());
    parallel_each(context, skin.faces.size(), 1, [&](std::size_t f) {
        const auto joined = continued.joined.find(skin.faces[f].face);
        const SkinOfFace& patch = joined == continued.joined.end() ? skin.faces[f] : joined->second;
        if (patch.quads.empty() || continued.wall.contains(patch.face)) return;
        const DeviationLimit limit = limit_of(model, patch.face, options);
        if (!kept.contains(patch.face))
            compared[f] = compare_face(mesh, skin, patch, std::move(shapes[f]), sign, limit, quiet);
    });
    for (const auto& [covered, wall] : continued.wall) {
        compared[covered.index()] = compared[wall.index()];
        compared[covered.index()].misfit = Misfit::none; // reported for the wall
    }
    for (const SkinOfFace& patch : skin.faces) {
        FaceFidelity& face = compared[patch.face.index()];
        if (patch.quads.empty() && !continued.wall.contains(patch.face))
            face = left_out(model, skin, patch.face, limit_of(model, patch.face, options));
        face.face = patch.face;
        face.quads = patch.quads.size();
        if (order > 1) face.quads /= 4; // each quad was divided into four
        if (order > 1 && mesh != nullptr) face.side *= 2;
        face.entity = entity_of(model, patch.face);
        face.tag = model[patch.face].tag;
        face.made_void = model[patch.face].origin == Origin::made_void;
        result.faces.push_back(std::move(face));
    }
    sum_distances(result, model);
    return result;
}

} // namespace

Fidelity compare(const OpenVolume& volume, const mesh::HexMesh& mesh, const std::vector<FaceId>& faces,
                 const std::set<FaceId>& kept, double volume_of_mesh, const FidelityOptions& options,
                 const RunContext& context, const mesh::LayeredNodes* layers)
{
    return compare(volume, &mesh, mesh.order(),
                   skin_of({mesh, layers}, faces, volume.model.faces.size(), context), kept, volume_of_mesh,
                   options, context);
}

Fidelity compare(const OpenVolume& volume, const mesh::TetPart& mesh, const std::vector<FaceId>& faces,
                 double volume_of_mesh, const FidelityOptions& options, const RunContext& context)
{
    return compare(volume, nullptr, mesh.order(), skin_of(mesh, faces, volume.model.faces.size()), {},
                   volume_of_mesh, options, context);
}

std::optional<Message> misfit(const Fidelity& fidelity, int layers, const FidelityOptions& options)
{
    const FaceFidelity* worst = worst_misfit(fidelity);
    const bool given = options.max_deviation > 0;
    if (worst == nullptr) return std::nullopt;
    const bool whole_side = worst->allowed >= worst->side;
    const bool least = worst->allowed > 2 * worst->side;
    const char* const limit = given        ? " (max_deviation)"
                              : least      ? ", the least allowed on a face of its extent"
                              : whole_side ? ", a quad's side there"
                                           : ", a quarter of a quad's side there";
    const std::string code = "sweep.deviation", place = at_place(worst->found_at);
    if (worst->misfit == Misfit::no_quads)
        return Message(
            code,
            "the mesh leaves out {}, about {:.2g} wide, at {}: no quad of its skin lies on it, and only "
            "faces up to {:.2g}{}, may be left out. The sides of quads there are {:.2g} long",
            worst->entity, found(worst->found), place, needed(worst->allowed), limit, worst->side);
    if (worst->misfit == Misfit::folded)
        return Message(code,
                       "the skin of the mesh folds on {}: the normal of a quad at {} points into the volume",
                       worst->entity, place);
    if (worst->misfit == Misfit::straight)
        return with_finer_sides(
            Message(code, "{}: the skin of the mesh is {:.2g} away from this face at {}, more than {:.2g}{}",
                    worst->entity, found(worst->found), place, needed(worst->allowed), limit),
            *worst, layers, options);
    return Message(code,
                   "{}: the skin of the mesh is {:.2g} away from this face at {}, more than {:.2g}{}. The "
                   "quads there run across an edge of the face; the sides of the largest are {:.2g} long",
                   worst->entity, found(worst->found), place, needed(worst->allowed), limit, worst->side);
}

void require_volume(const Fidelity& fidelity, int layers)
{
    const double off = fidelity.volume / fidelity.sealed_volume - 1;
    if (!(std::abs(off) > kMostOfVolume)) return;
    const auto worst = std::ranges::max_element(fidelity.faces, {}, &FaceFidelity::max_distance);
    throw NotSweepable(
        Message("sweep.deviation",
                "the mesh's volume is {:.2g} % {} than the sealed one, above the limit of {:.2g} %. Its skin "
                "is up to {:.2g} away from {}, at {}",
                found(100 * std::abs(off)), off < 0 ? "less" : "more", needed(100 * kMostOfVolume),
                found(worst->max_distance), worst->entity, at_place(worst->place))
            .remedy("use more than {} layers or a smaller 'size', or allow the distance with 'max_deviation'",
                    found(layers)));
}

std::string in_words(const Fidelity& fidelity)
{
    const double more = 100 * (fidelity.volume / fidelity.sealed_volume - 1);
    std::string line = formatted(
        "shape: volume {:.6g} of {:.6g} sealed ({}{:.2f} %), skin off by {:.2g} at most, "
        "{:.2g} on average",
        fidelity.volume, fidelity.sealed_volume, more < 0 ? "" : "+", more, fidelity.max_distance,
        fidelity.mean_distance);
    const auto worst = std::ranges::max_element(fidelity.faces, {}, &FaceFidelity::max_distance);
    const double rounding = kSamePlace * std::cbrt(std::abs(fidelity.sealed_volume));
    if (worst != fidelity.faces.end() && worst->max_distance > rounding)
        line += formatted("; most on {} at {}", worst->entity, at_place(worst->place));
    return line;
}

} // namespace lacuna::sweep
