// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/sealed_voids.h>

#include <lacuna/closure/detail/close_trial.h>
#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/membranes.h>
#include <lacuna/closure/detail/moved_end.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// The void faces of two volumes coincide if their distance is below this [model length]. If void faces have
/// the area of a face of a cube, the volume between faces at this distance would be reported.
double same_skin(double enclosed) { return kVolumeNoted * std::cbrt(enclosed); }
/// Added to the cost of the ends if all void faces are bent by a half turn. A closing with flat faces is
/// likelier than one with bent faces. A higher value drops more closings with bent faces.
constexpr double kBentVoid = 0.5;

/// Whether sealing fills each free loop with one face: no void edge is needed, and no face has several loops.
bool fills_each_loop(const OpenVolume& open, std::size_t loops)
{
    const Classification found = classify(open);
    switch (found.value) {
    case VolumeClass::closed:
        return true;
    case VolumeClass::III: // every vertex of both ends is on a wall that reaches the other end
        return found.wall_free_source.empty() && found.wall_free_target.empty();
    case VolumeClass::IV:
        return loops == 1;
    case VolumeClass::V:
        return loops == 2;
    default:
        return false;
    }
}

/// The facets of a volume's void faces.
geometry::FacetTree void_facets(const Sealed& sealed)
{
    const Model& model = sealed.volume.model;
    return {model.points, facets_of(model, sealed.closure.void_faces)};
}

/// Whether the corners and centres of one volume's void facets are near those of another.
bool lies_on(const Sealed& sealed, const geometry::FacetTree& other, double near)
{
    const Model& model = sealed.volume.model;
    const auto on = [&](const Vec3& p) { return other.closest(p, near * near).triangle >= 0; };
    return std::ranges::all_of(facets_of(model, sealed.closure.void_faces), [&](const Triangle& t) {
        return on((model.at(t[0]) + model.at(t[1]) + model.at(t[2])) / 3) &&
               std::ranges::all_of(t, [&](Index p) { return on(model.at(p)); });
    });
}

bool enclose_the_same(const Sealed& a, const Sealed& b)
{
    if (!same_volume(a.enclosed, b.enclosed)) return false;
    const double near = same_skin(std::max(a.enclosed, b.enclosed));
    return lies_on(a, void_facets(b), near) && lies_on(b, void_facets(a), near);
}

/// Whether sealing a candidate only fills planar free loops. All such candidates enclose the same volume.
bool fills_flat_loops(const Model& model, const Roles& roles, const RunContext& context)
{
    const auto fills = unless_refused([&] {
        const OpenVolume open = open_volume(model, roles, context);
        const std::vector<Rim> loops = free_loops(open);
        return fills_each_loop(open, loops.size()) &&
               std::ranges::all_of(loops, [&](const Rim& rim) { return is_flat(open.model, rim); });
    });
    return fills.value_or(false);
}

/// Cost of a void: the cost of its ends plus the cost of bent void faces.
double cost_of(const RoleCandidate& candidate, const Sealed& sealed)
{
    const Model& model = sealed.volume.model;
    double bent = 0, whole = 0;
    for (const FaceId face : sealed.closure.void_faces) {
        const double area = face_area(model, face);
        // As for ends, a bent face costs four times the difference between its area and its projected area,
        // but at most its area. A bend by 90° costs 0.4 times as much as a half turn.
        bent += std::min(area, 4 * (area - face_area_vector(model, face).norm()));
        whole += area;
    }
    return candidate.cost + (whole > 0 ? kBentVoid * bent / whole : 0);
}

/// Whether a void was sealed with a role candidate and its void faces are nearly flat.
bool is_settled(const Void& v)
{
    return !v.untold && v.filled.empty() &&
           std::ranges::all_of(v.sealed.closure.void_faces,
                               [&](FaceId face) { return is_about_flat(v.sealed.volume.model, face); });
}

/// Keep the voids that cost at most `RoleOptions::margin` more than the cheapest. Voids with an ambiguous
/// bend are dropped if there is one for which `is_settled()` is true.
void keep_likely(std::vector<Void>& found)
{
    if (std::ranges::any_of(found, is_settled)) std::erase_if(found, &Void::untold);
    std::ranges::stable_sort(found, {}, &Void::cost);
    std::erase_if(found, [&, least = found.empty() ? 0 : found.front().cost](const Void& v) {
        return v.cost > least + RoleOptions{}.margin;
    });
}

/// Add a candidate to the void that it encloses. If some candidates of a void need an ambiguous bend and
/// others do not, the former are listed in `Void::bent`: closing with their roles would bend a void face.
void add_sealed(std::vector<Void>& found, const RoleCandidate& candidate, Sealed sealed, bool fills_flat)
{
    Void now;
    now.cost = cost_of(candidate, sealed);
    now.first = candidate;
    now.ways.push_back(candidate);
    now.untold = guess_of_bent(sealed.volume, sealed.closure, RolesBy::finding).has_value();
    now.fills_flat_loops = fills_flat;
    now.sealed = std::move(sealed);
    const auto same = std::ranges::find_if(
        found, [&](const Void& v) { return enclose_the_same(v.sealed, now.sealed); });
    if (same == found.end()) {
        found.push_back(std::move(now));
    } else if (same->untold == now.untold) {
        same->ways.push_back(candidate);
        same->fills_flat_loops = same->fills_flat_loops || fills_flat;
    } else if (same->untold) {
        now.cost = std::min(now.cost, same->cost);
        now.bent = std::move(same->ways);
        *same = std::move(now);
    } else {
        same->bent.push_back(candidate);
    }
}

} // namespace

std::optional<Sealed> seal(const Model& model, const Roles& roles, const MayEnclose& may_enclose,
                           const RunContext& context)
{
    auto sealed = unless_refused([&] {
        const OpenVolume open = open_volume(model, roles, context);
        matching::Match match;
        if (!roles.source.empty() && !roles.target.empty() && !free_edges(open).empty())
            match = matching::match(open, {}, context);
        Sealed made{{close_trial(open, match, context), std::move(match)}};
        made.enclosed = enclosed_volume(made.volume);
        return made;
    });
    return sealed && may_enclose(sealed->volume.model) ? std::move(sealed) : std::nullopt;
}

bool same_volume(double a, double b) { return std::abs(a - b) <= kSameVolume * std::max(a, b); }

std::vector<Void> voids(const Model& model, const std::vector<RoleCandidate>& candidates, std::size_t most,
                        const MayEnclose& may_enclose, const RunContext& context)
{
    std::vector<Void> found;
    std::size_t sealed = 0;
    for (const RoleCandidate& candidate : candidates) {
        check_cancelled(context);
        const bool flat = fills_flat_loops(model, candidate.roles, context);
        const auto filled = std::ranges::find(found, true, &Void::fills_flat_loops);
        if (flat && filled != found.end()) {
            filled->ways.push_back(candidate);
            continue;
        }
        if (sealed == most) break;
        std::optional<Sealed> now = seal(model, candidate.roles, may_enclose, context);
        if (!now) continue;
        ++sealed;
        add_sealed(found, candidate, std::move(*now), flat);
    }
    keep_likely(found);
    return found;
}

void take_moved(const Model& model, const std::vector<FaceId>& faces, std::vector<Void>& found,
                const RunContext& context)
{
    const auto known = [&](const std::vector<Vec3>& places) {
        if (found.size() != 1) return false;
        const geometry::FacetTree made = void_facets(found.front().sealed);
        const double near = same_skin(found.front().sealed.enclosed) / 4;
        return std::ranges::all_of(places,
                                   [&](const Vec3& p) { return made.closest(p, near * near).triangle >= 0; });
    };
    std::vector<MovedEnd> moved = move_ends(model, faces, known, context);
    std::vector<Void> ends;
    bool told = true; // false if a rim without walls was extended
    for (MovedEnd& one : moved) {
        Void now;
        now.sealed = {{Closed(std::move(one)), {}}, one.enclosed};
        now.filled = formatted("sealed with the shape of {} at the other end", entity_of(model, one.from));
        now.first.roles.walls = faces; // face i of the sealed volume is faces[i] of the model
        const auto is_same = [&](const Void& v) { return enclose_the_same(v.sealed, now.sealed); };
        if (std::ranges::any_of(ends, is_same)) continue;
        told = told && !one.through;
        if (one.holes) now.through = one.from;
        ends.push_back(std::move(now));
    }
    if (ends.empty()) return;
    std::vector<Void> same;
    for (Void& v : found) {
        const auto end = std::ranges::find_if(
            ends, [&](const Void& e) { return enclose_the_same(v.sealed, e.sealed); });
        // A void with an ambiguous bend is replaced by the one with the moved end.
        const Sealed& own = v.sealed;
        const bool bends = v.untold || !membranes(own.volume.model, own.closure.void_faces).empty();
        if (end != ends.end()) same.push_back(bends ? *end : v);
    }
    if (!same.empty())
        found = std::move(same);
    else if (told)
        found = std::move(ends);
    else // the user decides whether a hole without walls extends to the other end
        found.insert(found.end(), ends.begin(), ends.end());
}

void add_filled(std::vector<Void>& found, Void filled)
{
    const auto known = std::ranges::find_if(
        found, [&](const Void& v) { return enclose_the_same(v.sealed, filled.sealed); });
    if (known == found.end()) {
        found.push_back(std::move(filled));
    } else if (known->untold ||
               filled.sealed.closure.void_faces.size() < known->sealed.closure.void_faces.size()) {
        if (known->untold) known->bent = std::exchange(known->ways, {});
        known->untold = filled.untold;
        known->first = std::move(filled.first);
        known->sealed = std::move(filled.sealed);
        known->filled = std::move(filled.filled);
    }
    keep_likely(found);
}

} // namespace lacuna::closure
