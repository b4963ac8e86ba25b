// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/bowl.h>

#include <lacuna/closure/detail/pieces.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/patches.h>
#include <lacuna/topology/shared/section.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::closure {

using namespace topology;

namespace {

/// If the steepest inclination of a skin is below this (11°), the skin has no walls [radians]. With a lower
/// value, surfaces that hardly rise count as walls; with a higher one, shallow bowls have no walls.
constexpr double kLeastLean = 0.2;

/// Coplanar faces with the same normal, or the only end of a volume.
struct Mouth {
    std::vector<FaceId> faces;
    geometry::Plane plane; ///< no point of the mouth is further out
    double area = 0;
};

/// Flat faces that have all other faces on the side opposite to their normal, the largest first.
std::vector<Mouth> mouths(const Model& model)
{
    std::vector<Mouth> found;
    for (const FaceId id : all_faces(model)) {
        const Vec3 sum = face_area_vector(model, id);
        const double area = face_area(model, id);
        if (model[id].triangles.empty() || !(sum.norm() > (1 - kFlatShare) * area)) continue;
        const Vec3& at = model.at(model[id].triangles.front()[0]);
        const auto same = std::ranges::find_if(found, [&](const Mouth& mouth) {
            return mouth.plane.normal.dot(sum) > (1 - kFlatShare) * area &&
                   std::abs(geometry::height(mouth.plane, at)) <= model.tolerance;
        });
        if (same != found.end()) {
            same->faces.push_back(id);
            same->area += area;
        } else {
            found.push_back({{id}, geometry::plane_across(at, sum), area});
        }
    }
    std::erase_if(found, [&](const Mouth& mouth) {
        return std::ranges::any_of(model.faces, [&](const Face& face) {
            return std::ranges::any_of(corners_of(face), [&](Index p) {
                return geometry::height(mouth.plane, model.at(p)) > 10 * model.tolerance;
            });
        });
    });
    std::ranges::stable_sort(found, std::greater<>(), &Mouth::area);
    if (found.size() > kMostTrials) found.resize(kMostTrials);
    return found;
}

/// The only end of a volume, such as the bent mouth of a branch; empty if it has both or none.
std::optional<Mouth> only_end(const OpenVolume& volume)
{
    const Model& model = volume.model;
    std::vector<FaceId> faces = volume.faces(Role::source);
    std::vector<FaceId> others = volume.faces(Role::target);
    if (faces.empty()) std::swap(faces, others);
    if (faces.empty() || !others.empty()) return std::nullopt;
    Mouth mouth{faces, geometry::plane_across(Vec3::Zero(), area_vector_of(model, faces))};
    double out = -kInfinity;
    for (const FaceId face : faces)
        for (const Index p : corners_of(model[face]))
            out = std::max(out, geometry::height(mouth.plane, model.at(p)));
    mouth.plane.origin = out * mouth.plane.normal;
    return mouth;
}

bool has(const std::vector<FaceId>& faces, FaceId face)
{
    return std::ranges::find(faces, face) != faces.end();
}

/// Depth below the mouth at which the walls end and the bottom begins; empty if there is no such depth.
std::optional<double> parting_depth(const Model& model, const Mouth& mouth)
{
    double depth = 0;
    for (const Face& face : model.faces)
        for (const Index p : corners_of(face))
            depth = std::max(depth, -geometry::height(mouth.plane, model.at(p)));
    if (!(depth > model.tolerance)) return std::nullopt;
    std::array<double, kFineChords> area{}, across{}; // from the bottom up
    const auto bin = [&](double d) {
        const double share = (1 - d / depth) * kFineChords;
        return static_cast<std::size_t>(std::clamp(share, 0.0, kFineChords - 1.0));
    };
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        if (has(mouth.faces, FaceId(f))) continue;
        for (const Triangle& t : model.faces[f].triangles) {
            const Vec3 twice = (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0]));
            std::array<double, 3> d{};
            for (std::size_t i = 0; i < 3; ++i) d[i] = -geometry::height(mouth.plane, model.at(t[i]));
            const auto [least, most] = std::ranges::minmax(d);
            const std::size_t low = bin(most), high = bin(least);
            for (std::size_t b = low; b <= high; ++b) {
                area[b] += twice.norm() / static_cast<double>(high - low + 1);
                across[b] += std::abs(twice.dot(mouth.plane.normal)) / static_cast<double>(high - low + 1);
            }
        }
    }
    const auto lean = [&](std::size_t b) {
        return area[b] > 0 ? std::acos(std::clamp(across[b] / area[b], 0.0, 1.0)) : 0.0;
    };
    double steepest = 0;
    for (std::size_t b = 0; b < kFineChords; ++b) steepest = std::max(steepest, lean(b));
    if (steepest < kLeastLean || !(lean(0) < steepest / 2)) return std::nullopt;
    std::size_t first = 0;
    while (lean(first) < steepest / 2) ++first;
    return depth * (1 - static_cast<double>(first) / kFineChords);
}

/// Whether faces form a ring: they have two rims and the Euler number 0.
bool join(const Model& model, const std::vector<FaceId>& ring)
{
    return rims(model, ring).size() == 2 && euler_number(model, ring) == 0;
}

std::optional<Bowl> part_at(const OpenVolume& sealed, const Mouth& mouth, const RunContext& context)
{
    const auto depth = parting_depth(sealed.model, mouth);
    if (!depth) return std::nullopt;
    Bowl bowl;
    bowl.mouth = mouth.faces.front();
    bowl.depth = *depth;
    geometry::Plane plane = mouth.plane;
    plane.origin -= *depth * plane.normal;
    const std::vector<SectionWalk> walks = section_walks(sealed.model, all_faces(sealed.model), plane,
                                                         sealed.model.tolerance);
    const auto open = [](const SectionWalk& walk) { return !walk.closed; };
    if (walks.empty() || std::ranges::any_of(walks, open)) return std::nullopt;
    // The plane must pass below a bent mouth.
    for (const FaceId face : mouth.faces)
        for (const Index p : corners_of(sealed.model[face]))
            if (geometry::height(plane, sealed.model.at(p)) <= sealed.model.tolerance) return std::nullopt;
    bowl.volume = sealed;
    bowl.parent = imprint(bowl.volume, walks, plane, context).parent;
    const Model& model = bowl.volume.model;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const bool at_mouth = has(mouth.faces, bowl.parent[f]);
        const bool below = geometry::height(plane, face_centroid(model, FaceId(f))) < 0;
        bowl.volume.role[f] = at_mouth ? Role::target : below ? Role::source : Role::wall;
    }
    const std::vector<FaceId> bottom = bowl.volume.faces(Role::source);
    if (bottom.empty() || connected_parts(model, bottom).size() != 1) return std::nullopt;
    // A bottom with creases, such as the rim of another mouth, does not blend into the walls.
    const std::vector<double> angles = angles_across(model, context);
    const auto in_bottom = [&](const FaceUse& use) {
        return bowl.volume.role[use.face.index()] == Role::source;
    };
    for (std::size_t e = 0; e < model.edges.size(); ++e)
        if (angles[e] > kCreaseAngle && std::ranges::all_of(model.uses_of_edge(EdgeId(e)), in_bottom))
            return std::nullopt;
    const std::size_t loops = rims(model, bowl.volume.faces(Role::target)).size();
    const auto rings = connected_parts(model, bowl.volume.faces(Role::wall));
    if (rims(model, bottom).size() != loops || rings.size() != loops) return std::nullopt;
    if (!std::ranges::all_of(rings, [&](const auto& ring) { return join(model, ring); })) return std::nullopt;
    return bowl;
}

} // namespace

std::optional<Bowl> part_bowl(const OpenVolume& sealed, const RunContext& context)
{
    const auto end = only_end(sealed);
    for (const Mouth& mouth : end ? std::vector{*end} : mouths(sealed.model)) {
        check_cancelled(context);
        // part_at() throws if the plane would cross given quads of a face.
        auto bowl = unless_refused([&] { return part_at(sealed, mouth, context); });
        if (bowl && *bowl) return std::move(*bowl);
    }
    return std::nullopt;
}

} // namespace lacuna::closure
