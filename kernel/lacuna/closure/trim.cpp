// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/trim.h>

#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/segment.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/section.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <ranges>
#include <set>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

struct Range {
    double low = kInfinity, high = -kInfinity; ///< of heights above a plane [model length]
};

Range heights(const Model& model, const std::vector<FaceId>& faces, const geometry::Plane& plane)
{
    Range range;
    for (const FaceId face : faces)
        for (const Index p : corners_of(model[face])) {
            const double h = geometry::height(plane, model.at(p));
            range.low = std::min(range.low, h);
            range.high = std::max(range.high, h);
        }
    return range;
}

/// Some faces as a model in which they are oriented alike, as their rims require; those of a shell mesh need
/// not be. Faces that cannot be oriented stay as they are.
Model oriented(const Model& model, const std::vector<FaceId>& faces)
{
    Model own = extract(model, faces);
    const auto alike = unless_refused([&] {
        Model turned = own;
        orient_consistently(turned);
        return turned;
    });
    return alike ? *alike : own;
}

/// The number of separate voids behind the plane that some faces bound together with the regions of the plane
/// between their rims. Parts without a rim in the plane do not count.
std::size_t count_voids(const Model& skin, const geometry::Plane& plane)
{
    const Model model = oriented(skin, all_faces(skin));
    const std::vector<std::vector<FaceId>> parts = connected_parts(model, all_faces(model));
    std::vector<std::vector<Vec2>> loops;
    std::vector<std::size_t> part_of; // by loop
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const Rim& rim : rims(model, parts[p])) {
            const std::vector<Vec3> places = loop_places(model, rim.uses);
            if (!std::ranges::all_of(places, [&](const Vec3& place) {
                    return std::abs(geometry::height(plane, place)) <= model.tolerance;
                }))
                continue;
            loops.push_back(flat_places(plane, places));
            part_of.push_back(p);
        }
    geometry::UnionFind sets(parts.size());
    for (const std::vector<std::size_t>& region : regions_of(loops))
        for (const std::size_t loop : region) sets.unite_least(part_of[region.front()], part_of[loop]);
    std::set<std::size_t> voids;
    for (const std::size_t part : part_of) voids.insert(sets.find(part));
    return voids.size();
}

/// Whether a given quad has corners on both sides of the plane.
bool crosses_quads(const Model& model, const std::vector<FaceId>& faces, const geometry::Plane& plane)
{
    return std::ranges::any_of(faces, [&](FaceId face) {
        return std::ranges::any_of(model[face].given_quads, [&](const Quad& quad) {
            Range range;
            for (const Index p : quad) {
                range.low = std::min(range.low, geometry::height(plane, model.at(p)));
                range.high = std::max(range.high, geometry::height(plane, model.at(p)));
            }
            return range.low < -model.tolerance && range.high > model.tolerance;
        });
    });
}

/// Whether a plane crosses faces in closed lines only, all inside a loop in that plane.
bool crosses_inside(const Model& model, const std::vector<FaceId>& faces, const geometry::Plane& plane,
                    const std::vector<Vec3>& loop)
{
    const std::vector<SectionWalk> walks = section_walks(model, faces, plane, model.tolerance);
    const std::vector<Vec2> around = flat_places(plane, loop);
    return !walks.empty() && std::ranges::all_of(walks, [&](const SectionWalk& walk) {
        return walk.closed && std::ranges::all_of(walk.places, [&](const SectionPlace& place) {
                   const Vec3 p = place_at(model, place, plane);
                   return geometry::lies_inside(around, geometry::to_plane(plane, p));
               });
    });
}

bool is_flat_in(const Model& model, const std::vector<Vec3>& places, const geometry::Plane& plane)
{
    return std::ranges::all_of(
        places, [&](const Vec3& p) { return std::abs(geometry::height(plane, p)) <= model.tolerance; });
}

/// Whether a rim of a part lies in a plane.
bool has_rim_in(const Model& model, const std::vector<FaceId>& part, const geometry::Plane& plane)
{
    return std::ranges::any_of(rims(model, part), [&](const Rim& rim) {
        return is_flat_in(model, loop_places(model, rim.uses), plane);
    });
}

/// Whether two closed lines are one, within the sag of their chords.
bool are_one_line(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
    Eigen::AlignedBox3d box;
    for (const Vec3& p : b) box.extend(p);
    const double near = kAlikeSizes * box.diagonal().norm();
    const auto lies_on = [&](const std::vector<Vec3>& line, const std::vector<Vec3>& other) {
        return std::ranges::all_of(line, [&](const Vec3& p) {
            return std::ranges::any_of(std::views::iota(std::size_t{0}, other.size()), [&](std::size_t i) {
                return geometry::distance_to_segment(p, other[i], other[(i + 1) % other.size()]) <= near;
            });
        });
    };
    return lies_on(a, b) && lies_on(b, a);
}

/// Whether a wall between a rim of a part and a loop in a plane is missing, although the part crosses the
/// plane inside the loop. Not if the part lies along the loop there. Such a rim
/// - lies in front of or behind the loop, such as that of a boss with a bore, and no other rim of the part
///   around the loop lies there as well, or
/// - lies in front of the plane, and is wider than the part in the plane, such as that of a pulley.
bool has_rim_over(const Model& model, const std::vector<FaceId>& part, const std::vector<FaceId>& around,
                  const geometry::Plane& plane, const std::vector<Vec3>& loop)
{
    std::vector<std::vector<Vec3>> sections;
    for (const SectionWalk& walk : section_walks(model, part, plane, model.tolerance)) {
        std::vector<Vec3>& places = sections.emplace_back();
        for (const SectionPlace& place : walk.places) places.push_back(place_at(model, place, plane));
        if (are_one_line(places, loop)) return false;
    }
    const auto image_of = [&](const Rim& rim) {
        std::vector<Vec3> foot = loop_places(model, rim.uses);
        if (std::abs(geometry::height(plane, foot.front())) <= model.tolerance) foot.clear();
        for (Vec3& p : foot) p -= geometry::height(plane, p) * plane.normal;
        return foot;
    };
    const auto lies_over = [&](const Rim& rim) {
        const std::vector<Vec3> foot = image_of(rim);
        return !foot.empty() && are_one_line(foot, loop);
    };
    const auto is_wider = [&](const Rim& rim) {
        const std::vector<Vec3> foot = image_of(rim);
        if (foot.empty() || geometry::height(plane, loop_places(model, rim.uses).front()) < 0) return false;
        const std::vector<Vec2> outline = flat_places(plane, foot);
        return std::ranges::all_of(sections, [&](const std::vector<Vec3>& section) {
            return !are_one_line(section, foot) && std::ranges::all_of(section, [&](const Vec3& p) {
                return geometry::lies_inside(outline, geometry::to_plane(plane, p));
            });
        });
    };
    const std::vector<Rim> own = rims(model, part);
    return std::ranges::any_of(own, is_wider) ||
           (std::ranges::any_of(own, lies_over) && std::ranges::none_of(rims(model, around), lies_over));
}

/// Whether another rim of some faces lies in the plane of a loop and encloses it.
bool have_rim_around(const Model& model, const std::vector<FaceId>& faces, const geometry::Plane& plane,
                     const std::vector<Vec3>& loop)
{
    return std::ranges::any_of(rims(model, faces), [&](const Rim& rim) {
        const std::vector<Vec3> places = loop_places(model, rim.uses);
        if (std::ranges::find(places, loop.front()) != places.end()) return false; // the loop itself
        return is_flat_in(model, places, plane) &&
               geometry::lies_inside(flat_places(plane, places), geometry::to_plane(plane, loop.front()));
    });
}

/// The faces of a part that lie in a plane.
std::vector<FaceId> faces_in(const Model& model, const std::vector<FaceId>& part,
                             const geometry::Plane& plane)
{
    std::vector<FaceId> flush;
    for (const FaceId face : part)
        if (lies_in_plane(model, face, plane)) flush.push_back(face);
    return flush;
}

bool lie_inside(const Model& model, const std::vector<FaceId>& faces, const geometry::Plane& plane,
                const std::vector<Vec3>& loop)
{
    const std::vector<Vec2> around = flat_places(plane, loop);
    return std::ranges::all_of(faces, [&](FaceId face) {
        return std::ranges::all_of(corners_of(model[face]), [&](Index p) {
            return geometry::lies_inside(around, geometry::to_plane(plane, model.at(p)));
        });
    });
}

/// A part that crosses a plane, lies in front of it, or ends in it with faces.
struct AtPlane {
    std::size_t part = 0;
    bool crosses = false, in_front = false;
    std::vector<FaceId> flush; ///< its faces in the plane
};

std::vector<AtPlane> parts_at(const Model& model, const std::vector<std::vector<FaceId>>& parts,
                              const std::vector<Eigen::AlignedBox3d>& boxes, const geometry::Plane& plane)
{
    std::vector<AtPlane> found;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const double middle = geometry::height(plane, boxes[p].center());
        const double reach = plane.normal.cwiseAbs().dot(boxes[p].sizes()) / 2;
        if (middle + reach < -model.tolerance) continue;
        const Range range = heights(model, parts[p], plane);
        const bool above = range.high > model.tolerance, below = range.low < -model.tolerance;
        AtPlane at{p, above && below, above && !below, faces_in(model, parts[p], plane)};
        if (above || !at.flush.empty()) found.push_back(std::move(at));
    }
    return found;
}

/// A face of a part beside one of its rims.
FaceId face_beside(const Model& model, const std::vector<FaceId>& part, const Rim& rim)
{
    return *std::ranges::find_if(
        part, [&](FaceId face) { return edges_of(model, {face}).contains(rim.uses.front().edge); });
}

/// Whether a rim is filled by the material of the closed solid that its faces belong to: the space behind its
/// plane is then no void that other parts stick out of.
bool is_full(const Model& model, const std::vector<FaceId>& part, const std::vector<Vec3>& rim,
             const geometry::Plane& plane)
{
    for (const std::vector<FaceId>& shell : connected_parts(model, all_faces(model))) {
        if (std::ranges::find(shell, part.front()) == shell.end()) continue;
        if (!rims(model, shell).empty()) return false;
        const Model solid = oriented(model, shell);
        std::vector<FaceId> own;
        for (std::size_t f = 0; f < shell.size(); ++f)
            if (std::ranges::find(part, shell[f]) != part.end()) own.emplace_back(f);
        // The faces are on the left of their rims.
        return std::ranges::any_of(rims(solid, own), [&](const Rim& other) {
            const std::vector<Vec3> places = loop_places(solid, other.uses);
            return places.size() == rim.size() && std::ranges::find(rim, places.front()) != rim.end() &&
                   geometry::newell_vector(places).dot(plane.normal) < 0;
        });
    }
    return false;
}

/// The plane of a rim if the rim is flat and its part lies on one side of it, which is behind the plane.
std::optional<geometry::Plane> plane_of_end(const Model& model, const std::vector<FaceId>& part,
                                            const std::vector<Vec3>& rim)
{
    geometry::Plane plane = geometry::newell_plane(std::array{rim});
    if (!is_flat_in(model, rim, plane)) return std::nullopt;
    Range range = heights(model, part, plane);
    if (-range.low < range.high) {
        plane = geometry::plane_across(plane.origin, -plane.normal);
        range = {-range.high, -range.low};
    }
    if (range.high > model.tolerance || range.low > -model.tolerance) return std::nullopt;
    return plane;
}

} // namespace

std::optional<Trimmed> trim(const Model& model, const std::vector<FaceId>& faces,
                            const std::vector<FaceId>& crossed, const geometry::Plane& plane,
                            const RunContext& context)
{
    const Model own = extract(model, faces);
    std::vector<char> may_lose(faces.size(), 0);
    std::vector<FaceId> cut;
    for (const FaceId face : all_faces(own)) {
        may_lose[face.index()] = std::ranges::find(crossed, faces[face.index()]) != crossed.end() ? 1 : 0;
        if (may_lose[face.index()] != 0) cut.push_back(face);
    }
    const std::vector<SectionWalk> walks = section_walks(own, cut, plane, own.tolerance);
    if (!std::ranges::all_of(walks, &SectionWalk::closed)) return std::nullopt;
    ModelBuilder builder(own);
    const WalkImprint made = imprint_walks(builder, walks, plane, own.tolerance, context);
    const Model split = std::move(builder).finish();
    std::vector<FaceId> kept;
    std::set<FaceId> kept_of, lost_of;
    Trimmed result;
    for (const FaceId face : all_faces(split)) {
        const std::size_t parent = made.parent[face.index()].index();
        if (may_lose[parent] != 0 && heights(split, {face}, plane).low >= -split.tolerance) {
            lost_of.insert(faces[parent]);
            continue;
        }
        kept.push_back(face);
        kept_of.insert(faces[parent]);
        result.parent.push_back(faces[parent]);
    }
    for (const FaceId face : lost_of) (kept_of.contains(face) ? result.cut : result.gone).push_back(face);
    result.model = extract(split, kept);
    result.voids = count_voids(result.model, plane);
    return result;
}

std::optional<Overhang> find_overhang(const Model& whole, const std::vector<FaceId>& named)
{
    if (connected_parts(whole, named).size() < 2) return std::nullopt;
    const Model model = oriented(whole, named);
    const std::vector<FaceId> faces = all_faces(model);
    const std::vector<std::vector<FaceId>> parts = connected_parts(model, faces);
    const auto in_whole = [&](std::vector<FaceId> own) {
        for (FaceId& face : own) face = named[face.index()];
        return own;
    };
    std::vector<Eigen::AlignedBox3d> boxes(parts.size());
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const FaceId face : parts[p])
            for (const Index corner : corners_of(model[face])) boxes[p].extend(model.at(corner));
    // The rims of a bundle lie in a few planes.
    std::vector<std::pair<geometry::Plane, std::vector<AtPlane>>> known;
    const auto at_plane = [&](const geometry::Plane& plane) -> const std::vector<AtPlane>& {
        const auto own = std::ranges::find_if(known, [&](const auto& other) {
            return other.first.normal.dot(plane.normal) > 0 &&
                   other.first.normal.cross(plane.normal).norm() <= kRoundoff &&
                   std::abs(geometry::height(other.first, plane.origin)) <= model.tolerance;
        });
        return own != known.end() ? own->second
                                  : known.emplace_back(plane, parts_at(model, parts, boxes, plane)).second;
    };
    for (std::size_t around = 0; around < parts.size(); ++around)
        for (const Rim& rim : rims(model, parts[around])) {
            const std::vector<Vec3> loop = loop_places(model, rim.uses);
            const auto plane = plane_of_end(model, parts[around], loop);
            if (!plane) continue;
            std::vector<FaceId> out;
            const bool is_mouth = std::ranges::all_of(at_plane(*plane), [&](const AtPlane& at) {
                if (at.part == around) return true;
                if (at.in_front || !lie_inside(model, at.flush, *plane, loop)) return false;
                const std::vector<FaceId>& part = parts[at.part];
                if (!at.crosses)
                    out.insert(out.end(), at.flush.begin(), at.flush.end());
                else if (has_rim_in(model, part, *plane) ||
                         has_rim_over(model, part, parts[around], *plane, loop))
                    return false;
                else if (!crosses_quads(model, part, *plane) && crosses_inside(model, part, *plane, loop))
                    out.insert(out.end(), part.begin(), part.end());
                return true;
            });
            if (is_mouth && !out.empty() && !have_rim_around(model, faces, *plane, loop) &&
                !is_full(whole, in_whole(parts[around]), loop, *plane))
                return Overhang{*plane, in_whole(std::move(out)),
                                named[face_beside(model, parts[around], rim).index()]};
        }
    return std::nullopt;
}

} // namespace lacuna::closure
