// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/cavities.h>

#include <lacuna/closure/detail/hollow_readings.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/topology/shared/hollows.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>

namespace lacuna::closure {

using namespace topology;

namespace {

/// The kind of a cavity as users read it.
/// @param mouths  number of free loops of the cavity's faces.
const char* word(VolumeClass value, std::size_t mouths)
{
    return mouths == 0                             ? "inner void"
           : value == VolumeClass::IV              ? "pocket"
           : value == VolumeClass::V && mouths > 1 ? "bore"
                                                   : "slot";
}

/// Hollows that may be a cavity together.
struct Candidate {
    std::vector<FaceId> faces; ///< ascending
    std::size_t mouths = 0;
    double volume = 0; ///< about the volume [model length³]
};

/// Hollows with the bodies that stand in them, and those that share edges merged, each before its parts; in
/// the order of their first faces.
std::vector<Candidate> candidates(const Model& model, const RunContext& context)
{
    std::vector<Hollow> found = hollows(model, context);
    const std::vector<std::size_t> first = joined_hollows(model, found);
    std::vector<Candidate> result;
    for (Hollow& hollow : found) {
        if (hollow.inside.empty()) continue;
        const auto shares = [&](const Hollow& other) {
            return std::ranges::find_first_of(other.faces, hollow.inside) != other.faces.end();
        };
        if (std::ranges::any_of(found, shares)) // it may be no body, but the hollow that this one leads to
            result.push_back({hollow.faces, hollow.mouths, hollow.volume});
        std::ranges::copy(hollow.inside, std::back_inserter(hollow.faces));
        std::ranges::sort(hollow.faces);
        hollow.mouths = rims(model, hollow.faces).size();
    }
    std::map<std::size_t, Candidate> by_root;
    for (std::size_t h = 0; h < found.size(); ++h) {
        if (std::ranges::count(first, first[h]) < 2) continue;
        Candidate& joined = by_root[first[h]];
        std::ranges::copy(found[h].faces, std::back_inserter(joined.faces));
        joined.volume += found[h].volume;
    }
    for (auto& [root, joined] : by_root) {
        std::ranges::sort(joined.faces);
        joined.faces.erase(std::unique(joined.faces.begin(), joined.faces.end()), joined.faces.end());
        joined.mouths = rims(model, joined.faces).size();
        result.push_back(std::move(joined));
    }
    for (const Hollow& hollow : found) result.push_back({hollow.faces, hollow.mouths, hollow.volume});
    std::ranges::stable_sort(result, is_listed_before, &Candidate::faces);
    const auto twice = std::ranges::unique(result, {}, &Candidate::faces);
    result.erase(twice.begin(), twice.end());
    return result;
}

std::optional<std::vector<Reading>> only_reading(const Model& model, const Candidate& candidate,
                                                 const Bodies& bodies, const RunContext& context)
{
    auto readings = unless_refused([&] { return find_readings(model, candidate.faces, bodies, context); });
    if (readings && readings->size() != 1) readings.reset();
    return readings;
}

/// A cavity with the faces of the model's other parts that lie in it.
/// @param skin  the skin of the cavity, sealed if it can be sealed.
Cavity with_bodies(const Model& model, Cavity cavity, const Model& skin, const RunContext& context)
{
    const std::vector<FaceId> inside = bodies_inside(model, skin, context);
    if (inside.empty()) return cavity;
    const std::vector<FaceId> own = cavity.faces;
    for (const std::vector<FaceId>& part : connected_parts(model, all_faces(model))) {
        if (std::ranges::find_first_of(part, inside) == part.end() ||
            std::ranges::find_first_of(part, own) != part.end())
            continue;
        cavity.has_bodies = true;
        cavity.faces.insert(cavity.faces.end(), part.begin(), part.end());
    }
    std::ranges::sort(cavity.faces);
    return cavity;
}

Cavity cavity_of(const Model& model, const Candidate& candidate, const Reading& reading,
                 const RunContext& context)
{
    const VolumeClass value = reading.classification.value;
    const OpenVolume& skin = reading.sealed ? reading.sealed->volume : reading.volume;
    return with_bodies(model, {word(value, candidate.mouths), candidate.faces, value, reading.enclosed},
                       skin.model, context);
}

} // namespace

std::vector<Cavity> cavities(const Model& model, const RunContext& context)
{
    const Bodies bodies(model);
    std::vector<Cavity> result;
    for (const Candidate& candidate : candidates(model, context)) {
        check_cancelled(context);
        if (const auto readings = only_reading(model, candidate, bodies, context)) {
            result.push_back(cavity_of(model, candidate, readings->front(), context));
        } else if (candidate.mouths == 0) {
            Model own = extract(model, candidate.faces);
            orient_consistently(own);
            const double volume = std::abs(volume_integral(own, all_faces(own)));
            result.push_back(with_bodies(
                model, {word(VolumeClass::closed, 0), candidate.faces, VolumeClass::closed, volume}, own,
                context));
        }
    }
    return result;
}

std::vector<Cavity> largest_cavities(const Model& model, std::size_t most, const RunContext& context)
{
    std::vector<Candidate> order = candidates(model, context);
    std::ranges::stable_sort(order, std::greater(), &Candidate::volume);
    const Bodies bodies(model);
    std::vector<Cavity> result;
    for (const Candidate& candidate : order) {
        check_cancelled(context);
        if (result.size() == most) break;
        if (std::ranges::any_of(result, [&](const Cavity& larger) {
                return std::ranges::includes(larger.faces, candidate.faces);
            }))
            continue;
        const auto readings = only_reading(model, candidate, bodies, context);
        if (!readings) continue;
        result.push_back(cavity_of(model, candidate, readings->front(), context));
    }
    return result;
}

} // namespace lacuna::closure
