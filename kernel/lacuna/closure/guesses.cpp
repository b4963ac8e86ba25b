// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/guesses.h>

#include <lacuna/closure/detail/axis_rims.h>
#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/four_corners.h>
#include <lacuna/closure/detail/membranes.h>
#include <lacuna/closure/detail/rim_quadrics.h>
#include <lacuna/closure/detail/thin_plate.h>
#include <lacuna/closure/detail/touching_faces.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A bent face is ambiguous if more than this share of the enclosed volume lies between the face and its mean
/// plane. Another bend of the face would change the volume by about as much.
constexpr double kDoubt = 0.05;
/// A missing end is ambiguous if more than this share of the enclosed volume lies between the end and another
/// smooth face over its rim. Measured on 893 ends over twelve outlines: 762 ends are accepted; of these, 12
/// have a volume error above 3 %, and 719 one below 1 %. 131 ends are refused, those with straight rims
/// included; of these, 41 have an error above 3 %, and 70 one below 1 %.
constexpr double kBendDoubt = 0.03;
/// A rim is rough, not bent, if its points deviate from a plane by at most this share of its diameter, as in
/// scans of cut bones.
constexpr double kRough = 0.05;

/// Volume between a face and another surface, given as heights over a plane [model length³].
struct Between {
    double all = 0, above = 0; ///< `all`: in total; `above`: where the surface is above the face, minus where
                               ///< it is below
};

/// @return  empty if the surface is undefined over a part of the face.
template <class Heights>
std::optional<Between> between(const Model& model, FaceId face, const geometry::Plane& plane,
                               const Heights& heights)
{
    Between sum;
    for (const Triangle& t : model[face].triangles) {
        const Vec3 &a = model.at(t[0]), &b = model.at(t[1]), &c = model.at(t[2]);
        const Vec3 middle = (a + b + c) / 3;
        const std::optional<double> height = heights(geometry::to_plane(plane, middle));
        if (!height) return std::nullopt;
        const double off = *height - geometry::height(plane, middle);
        const double part = off * (b - a).cross(c - a).dot(plane.normal) / 2;
        sum.all += std::abs(part);
        sum.above += part;
    }
    return sum;
}

/// Volume between a void face and a plane [model length³].
double beside(const geometry::Plane& plane, const Model& model, FaceId face)
{
    return between(model, face, plane, [](const Vec2&) { return std::optional(0.0); })->all;
}

/// Volume between a void face and the plane through its centre [model length³].
double beside_plane(const Model& model, FaceId face)
{
    if (!(face_area_vector(model, face).norm() > 0)) return 0;
    return beside(mean_plane(model, face), model, face);
}

Between beside_thin_plate(const Model& model, FaceId face)
{
    if (!(face_area_vector(model, face).norm() > 0)) return {}; // the face has no mean normal
    const geometry::Plane plane = mean_plane(model, face);
    const ThinPlate plate = plate_over(plane, model, model[face].loops);
    return *between(model, face, plane, [&](const Vec2& p) { return std::optional(plate.height(p)); });
}

/// Largest distance of points from the plane of their largest projected area [model length].
double off_one_plane(const std::vector<Vec3>& places)
{
    const geometry::Plane plane = geometry::newell_plane({&places, 1});
    double furthest = 0;
    for (const Vec3& p : places) furthest = std::max(furthest, std::abs(geometry::height(plane, p)));
    return furthest;
}

/// Volume between a void face with several loops and the plane of its longest loop, if this loop is flat. The
/// missing face may be flat there, and the parts at the other loops end before or behind it [model length³].
double beside_flat_rim(const Model& model, FaceId face)
{
    if (model[face].loops.size() < 2) return 0;
    std::vector<Vec3> rim;
    for (const Loop& loop : model[face].loops) {
        std::vector<Vec3> places = loop_places(model, loop.uses);
        if (geometry::length(places) > geometry::length(rim)) rim = std::move(places);
    }
    if (off_one_plane(rim) > model.tolerance) return 0;
    return beside(geometry::newell_plane({&rim, 1}), model, face);
}

bool is_far_off_plane(const Model& model, double enclosed, FaceId face)
{
    return beside_plane(model, face) >= kDoubt * enclosed;
}

/// Whether an edge consists of straight parts with corners between them.
bool is_straight_between_corners(const Model& model, const EdgeUse& use)
{
    const std::vector<Vec3> chain = use_places(model, use);
    for (std::size_t i = 2; i < chain.size(); ++i) {
        const double turn = geometry::angle_between(chain[i - 1] - chain[i - 2], chain[i] - chain[i - 1]);
        if (turn > kParallel && turn < kCreaseAngle * kDegree) return false;
    }
    return true;
}

bool is_straight_sided(const Model& model, const Loop& loop)
{
    return std::ranges::all_of(loop.uses,
                               [&](const EdgeUse& use) { return is_straight_between_corners(model, use); });
}

/// Whether a polygonal rim is too far off a plane. The measure is half of the face's projected area times the
/// largest distance of a rim point from the plane (the volume under a roof), as a share of the enclosed
/// volume.
bool is_rim_far_off_plane(const Model& model, double enclosed, FaceId face, const Loop& loop)
{
    const double furthest = off_one_plane(loop_places(model, loop.uses));
    return furthest * face_area_vector(model, face).norm() / 2 >= kDoubt * enclosed;
}

/// Whether the shape of a missing end is ambiguous. A rim of more than four straight sides that is far off a
/// plane suggests several flat faces, so the shape is ambiguous. For other rims, the volume between the end
/// and the thin plate over the rim decides.
bool is_end_in_doubt(const Model& model, double enclosed, FaceId face)
{
    for (const Loop& loop : model[face].loops)
        if (sharp_corners(model, loop).size() > 4 && is_straight_sided(model, loop) &&
            is_rim_far_off_plane(model, enclosed, face, loop))
            return true;
    return beside_thin_plate(model, face).all >= kBendDoubt * enclosed;
}

/// Whether a void face is an end that was blended between four sides, of which no two opposite ones are
/// straight.
bool is_end_between_bent_sides(const OpenVolume& sealed, FaceId face)
{
    const Model& model = sealed.model;
    if (sealed.role[face.index()] == Role::wall || model[face].geometry != Geometry::transfinite)
        return false;
    const auto sides = four_corners(model, model[face].loops.front());
    return !sides.empty() && !is_ruled(model, sides);
}

/// Whether a smooth void face is far from one of the quadrics through its rim.
bool may_lie_on_other_quadric(const OpenVolume& sealed, double enclosed, FaceId face)
{
    const Model& model = sealed.model;
    const bool smooth = model[face].geometry == Geometry::newell || is_end_between_bent_sides(sealed, face);
    if (!smooth || has_flat_loops(model, face)) return false;
    const geometry::Plane plane = mean_plane(model, face);
    const RimShapes shapes = shapes_of_rim(model, model[face].loops, plane);
    const auto is_far_off = [&](const QuadricSheet& sheet) {
        const auto off = between(model, face, plane, [&](const Vec2& p) { return sheet.height(p); });
        return off && off->all >= kBendDoubt * enclosed;
    };
    return std::ranges::any_of(shapes.told.empty() ? shapes.possible : shapes.told, is_far_off);
}

/// Whether a void face closes a rough rim: the rim is nearly planar, and different smooth faces over it
/// enclose about the same volume.
bool closes_rough_rim(const Model& model, double enclosed, FaceId face)
{
    std::vector<Vec3> places;
    for (const Loop& loop : model[face].loops)
        std::ranges::copy(loop_places(model, loop.uses), std::back_inserter(places));
    const Vec3 middle = geometry::mean_point(places);
    double radius = 0;
    for (const Vec3& p : places) radius = std::max(radius, (p - middle).norm());
    const bool about_flat = off_one_plane(places) <= kRough * 2 * radius;
    return about_flat && std::abs(beside_thin_plate(model, face).above) <= kVolumeNoted * enclosed;
}

bool is_open_far_off_plane(const Model& model, double enclosed, FaceId face)
{
    return is_far_off_plane(model, enclosed, face) && is_membrane(model, face);
}

/// Whether the rim of a void face leaves the shape of the face ambiguous, if rough rims count as well.
bool is_rim_in_doubt(const OpenVolume& sealed, double enclosed, FaceId face, RolesBy by)
{
    const Model& model = sealed.model;
    if (by == RolesBy::person &&
        (model[face].geometry == Geometry::newell || is_end_between_bent_sides(sealed, face)))
        return !has_flat_loops(model, face) && !bends_as_rim(model, face) &&
               is_end_in_doubt(model, enclosed, face);
    return is_open_far_off_plane(model, enclosed, face);
}

/// Whether a void face leaves the shape of a sealed volume ambiguous.
bool is_in_doubt(const OpenVolume& sealed, double enclosed, FaceId face, RolesBy by)
{
    const Model& model = sealed.model;
    return may_lie_on_other_quadric(sealed, enclosed, face) ||
           (is_rim_in_doubt(sealed, enclosed, face, by) && !closes_rough_rim(model, enclosed, face));
}

/// The given faces beside some void faces.
std::vector<NamedEntity> given_beside(const Model& model, const std::vector<FaceId>& faces)
{
    std::set<int> tags;
    for (const FaceId face : faces)
        for (const FaceId other : faces_beside(model, face))
            if (model[other].origin == Origin::given) tags.insert(model[other].tag);
    std::vector<NamedEntity> beside;
    for (const int tag : tags) beside.push_back({"face", tag});
    return beside;
}

/// Note that one face is assumed in a rim that more faces may fill.
void note_one_wall(const Model& model, FaceId face, Closure& closure, Assumed what = Assumed::shape,
                   double share = 1)
{
    assume(closure,
           Message("closure.wall_assumed",
                   "the rim of {} does not determine how many faces are missing beside {}; one face is "
                   "assumed",
                   entity_of(model, face), given_beside(model, {face}))
               .remedy("if several faces or a whole part are missing there, give them"),
           share, what);
}

/// Whether a void face meets another void face.
bool touches_void_face(const Model& model, FaceId face)
{
    return std::ranges::any_of(faces_beside(model, face),
                               [&](FaceId other) { return model[other].origin == Origin::made_void; });
}

/// Whether all given faces beside a flat void face are perpendicular to it.
bool is_square_to_given(const Model& model, FaceId face)
{
    const Vec3 normal = mean_plane(model, face).normal;
    return std::ranges::all_of(faces_beside(model, face), [&](FaceId other) {
        return model[other].origin == Origin::made_void ||
               std::ranges::all_of(model[other].triangles, [&](const Triangle& t) {
                   const Vec3 area = facet_area_vector(model, t);
                   return std::abs(area.dot(normal)) <= kParallel * area.norm();
               });
    });
}

/// Whether the given edges of a flat void face show its plane:
/// - three straight sides, or one and a curve. Two straight sides that meet or are parallel are coplanar
///   whatever is missing there, and a round face may end in a planar curve as well;
/// - two straight sides that meet, or a curve, if all given faces there are perpendicular to the void face. A
///   rounded end may be missing between parallel sides.
bool shows_plane(const Model& model, FaceId face)
{
    const auto is_given = [&](const EdgeUse& use) { return model[use.edge].origin == Origin::given; };
    std::vector<Vec3> straight;
    bool curved = false;
    for (const Loop& loop : model[face].loops) {
        for (std::size_t i = 0; i < loop.uses.size(); ++i) {
            const EdgeUse use = loop.uses[i],
                          before = loop.uses[(i + loop.uses.size() - 1) % loop.uses.size()];
            if (!is_given(use)) continue;
            const std::vector<Vec3> places = use_places(model, use);
            if (!is_straight(model, {use}))
                curved = true;
            else if (!is_given(before) || !is_straight(model, {before}) || turns_sharply(model, before, use))
                straight.push_back((places.back() - places.front()).stableNormalized());
        }
    }
    const bool meet = std::ranges::any_of(
        straight, [&](const Vec3& side) { return side.cross(straight.front()).norm() > kParallel; });
    return straight.size() + (curved ? 2 : 0) > 2 || ((meet || curved) && is_square_to_given(model, face));
}

/// The given faces at a rim of a void face.
std::vector<FaceId> given_at(const Model& model, const Rim& rim)
{
    std::vector<FaceId> given;
    for (const EdgeUse& use : rim.uses)
        for (const FaceUse& by : model.uses_of_edge(use.edge))
            if (model[by.face].origin == Origin::given) given.push_back(by.face);
    return given;
}

/// Note a void wall between two flat rims if the plane of one rim crosses a face at the other rim, as where a
/// shaft ends inside its sleeve: the volume may end in that plane.
void note_end_inside(const OpenVolume& sealed, FaceId wall, const std::vector<Rim>& rims, Closure& closure)
{
    const Model& model = sealed.model;
    for (const std::size_t i : {0, 1}) {
        const std::vector<std::vector<Vec3>> loop{loop_places(model, rims[i].uses)};
        geometry::Plane plane = geometry::newell_plane(loop);
        const FaceId inner = given_at(model, rims[i]).front(), outer = given_at(model, rims[1 - i]).front();
        double low = 0, high = 0;
        for (const Index p : corner_points(model[outer])) {
            const double height = geometry::height(plane, model.at(p));
            low = std::min(low, height);
            high = std::max(high, height);
        }
        if (low >= -model.tolerance || high <= model.tolerance) continue;
        if (geometry::height(plane, face_centroid(model, inner)) > 0) plane.normal = -plane.normal;
        const auto without_noise = [](const Vec3& v, double noise) -> Vec3 {
            return v.unaryExpr([&](double x) { return std::abs(x) <= noise ? 0.0 : x; });
        };
        const Vec3 o = without_noise(plane.origin, model.tolerance),
                   n = without_noise(plane.normal, kSamePlace);
        assume(
            closure,
            Message("closure.end_inside",
                    "{} runs from the rim of {} to the rim of {}, which extends past the plane of the "
                    "first rim",
                    entity_of(model, wall), entity_of(model, inner), entity_of(model, outer))
                .remedy("if the volume ends in this plane, give fill_to = {{ {{ {:.6g}, {:.6g}, {:.6g} }}, "
                        "{{ {:.6g}, {:.6g}, {:.6g} }} }}",
                        o.x(), o.y(), o.z(), n.x(), n.y(), n.z()),
            beside(plane, model, wall) / enclosed_volume(sealed));
    }
}

/// Note flat void faces in circles. Balls, cones and rings go through a circle as well, and no edge shows
/// which of these faces is missing.
void note_flat_in_circles(const Model& model, double enclosed, Closure& closure)
{
    std::vector<FaceId> flat;
    double largest = 0;
    for (const FaceId face : closure.void_faces) {
        const std::vector<Loop>& loops = model[face].loops;
        const auto radius = loops.size() == 1 ? radius_of_circle(model, {loops.front().uses}) : std::nullopt;
        if (!radius || given_beside(model, {face}).empty() || face_round_hole(model, face)) continue;
        flat.push_back(face);
        largest = std::max(largest, *radius);
    }
    if (flat.empty()) return;
    const double half_ball = 2 * std::numbers::pi / 3 * std::pow(largest, 3);
    assume(closure,
           Message("closure.flat_assumed",
                   "flat faces are assumed in the circles beside {}: {}. Part of a ball, a cone or a ring "
                   "can end in such a circle, too, and half a ball would change the volume by {:.0f} %",
                   given_beside(model, flat), entities_of(model, flat), 100 * half_ball / enclosed)
               .remedy("if a true face is not flat or has a hole, give it"),
           1, Assumed::straight);
}

/// Note flat void faces that meet other void faces and whose given edges do not show their plane.
void note_unshown_planes(const Model& model, Closure& closure)
{
    std::vector<FaceId> unshown;
    for (const FaceId face : closure.void_faces)
        if (has_flat_loops(model, face) && touches_void_face(model, face) && !shows_plane(model, face))
            unshown.push_back(face);
    if (unshown.empty()) return;
    assume(closure,
           Message("closure.edge_assumed",
                   "flat faces that meet in straight edges are assumed to be missing beside {}",
                   given_beside(model, unshown))
               .remedy("if more faces are missing there, give them"),
           1, Assumed::rim);
}

/// Whether the given faces beside a void face are flat and the void face closes holes of them.
bool ends_in_holes(const Model& model, FaceId wall)
{
    return std::ranges::all_of(uses_of(model[wall]), [&](const EdgeUse& use) {
        return model[use.edge].origin != Origin::given ||
               std::ranges::all_of(model.uses_of_edge(use.edge), [&](const FaceUse& by) {
                   if (by.face == wall) return true;
                   const Face& given = model[by.face];
                   return plane_of(model, by.face) && given.loops.size() > 1 &&
                          std::ranges::none_of(given.loops.front().uses,
                                               [&](const EdgeUse& u) { return u.edge == use.edge; });
               });
    });
}

/// Note round void walls between holes of flat faces if the volume lies inside these walls: flat faces in the
/// holes would leave it out. Outside a wall, a flat face would merely continue the face that it is in.
void note_rods(const Model& model, double enclosed, Closure& closure)
{
    std::vector<FaceId> walls;
    double inside = 0;
    for (const FaceId face : closure.void_faces) {
        const auto shape = round_shape(model, face);
        if (!shape || shape->is_sphere() || !ends_in_holes(model, face)) continue;
        walls.push_back(face);
        for (const Triangle& t : model[face].triangles) {
            const Vec3 out = model.at(t[0]) - shape->centre;
            inside += (out - out.dot(*shape->axis) * *shape->axis).dot(facet_area_vector(model, t)) / 2;
        }
    }
    if (!(inside > 0)) return;
    assume(closure,
           Message("closure.round_wall",
                   "the volume goes on inside the round wall {} between the holes of {}; flat faces in these "
                   "holes would take {:.3g} from it",
                   entities_of(model, walls), given_beside(model, walls), inside)
               .remedy("if flat faces are missing, give them"),
           inside / enclosed, Assumed::round_wall);
}

} // namespace

std::optional<Message> guess_of_bent(const OpenVolume& sealed, const Closure& closure, RolesBy by)
{
    const Model& model = sealed.model;
    const double enclosed = enclosed_volume(sealed);
    for (const FaceId face : closure.void_faces) {
        if (!is_in_doubt(sealed, enclosed, face, by)) continue;
        return Message(by == RolesBy::person ? "closure.shape_open" : "topology.shape_open",
                       "the shape of the missing face beside {} is ambiguous: its rim is not planar",
                       given_beside(model, {face}));
    }
    return std::nullopt;
}

void assume(Closure& closure, Message note, double share, Assumed what)
{
    if (share > kVolumeNoted) closure.assumptions.push_back({closure.notes.size(), what});
    closure.notes.push_back(std::move(note));
}

void assume_walls(const OpenVolume& sealed, const Message& note, Closure& closure)
{
    const double taken = enclosed_volume(sealed);
    double open = 0;
    for (const FaceId face : closure.void_faces) {
        double perimeter = 0;
        for (const EdgeUse& use : uses_of(sealed.model[face]))
            perimeter += edge_length(sealed.model, use.edge);
        if (sealed.role[face.index()] == Role::wall)
            open += std::pow(face_area(sealed.model, face), 2) / perimeter;
    }
    assume(closure, {note.code(), "{}; this encloses {:.4g}", note.parts(), taken}, open / taken);
}

void note_open_rims(const OpenVolume& sealed, RolesBy by, Closure& closure)
{
    const Model& model = sealed.model;
    const double enclosed = enclosed_volume(sealed);
    for (const FaceId face : membranes(model, closure.void_faces)) {
        // A membrane in place of several faces may be as far from them as from its plane.
        const double others = by == RolesBy::finding ? beside_plane(model, face) : 0;
        assume(
            closure,
            Message("closure.membrane",
                    "{} is a smooth face over a rim that is not planar, so its shape is assumed",
                    entity_of(model, face))
                .remedy("if the true face bulges otherwise, give it"),
            std::max({std::abs(beside_thin_plate(model, face).above), beside_flat_rim(model, face), others}) /
                enclosed);
    }
    if (by == RolesBy::finding) {
        note_flat_in_circles(model, enclosed, closure);
        note_unshown_planes(model, closure);
        note_rods(model, enclosed, closure);
    }
    for (const FaceId face : closure.void_faces) {
        // If the user named the roles, exactly one wall is missing at such a rim. Otherwise several faces may
        // be missing there.
        if (by == RolesBy::finding && !is_membrane(model, face)) {
            if (is_untold(model, face) || closes_hole_in_bent_face(model, face))
                note_one_wall(model, face, closure);
            else if (has_only_quadric(model, face))
                note_one_wall(model, face, closure, Assumed::rim);
            else if (closure.assumptions.empty() && // one note is enough for a closing
                     (rests_on_void_edges(model, face) ||
                      (continues_face_beside(model, face) && !face_round_hole(model, face))))
                note_one_wall(model, face, closure, Assumed::rim,
                              std::pow(face_area(model, face), 1.5) / enclosed);
        }
        if (!is_rim_in_doubt(sealed, enclosed, face, by) || is_in_doubt(sealed, enclosed, face, by)) continue;
        assume(closure,
               Message("closure.rough_rim", "the rim of {} is rough and is closed by a smooth face",
                       entity_of(model, face))
                   .remedy("if the true face bulges otherwise, give it"),
               1);
    }
}

void note_joined_rims(const OpenVolume& sealed, RolesBy by, Closure& closure)
{
    const Model& model = sealed.model;
    const auto is_flat_and_given = [&](const Rim& rim) {
        return is_flat(model, rim) && !given_at(model, rim).empty();
    };
    for (const FaceId face : closure.void_faces) {
        const std::vector<Rim> both = rims(model, {face});
        if (both.size() != 2 || plane_of(model, face) || is_untold(model, face) ||
            !std::ranges::all_of(both, is_flat_and_given))
            continue;
        if (by == RolesBy::finding)
            note_one_wall(model, face, closure);
        else
            note_end_inside(sealed, face, both, closure);
    }
}

} // namespace lacuna::closure
