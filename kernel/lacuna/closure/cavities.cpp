// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/cavities.h>

#include <lacuna/closure/detail/unless_refused.h>
#include <lacuna/topology/shared/hollows.h>

#include <algorithm>
#include <cmath>
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
    return value == VolumeClass::closed            ? "inner void"
           : value == VolumeClass::IV              ? "pocket"
           : value == VolumeClass::V && mouths > 1 ? "bore"
                                                   : "slot";
}

std::optional<Cavity> cavity(const Model& model, const std::vector<FaceId>& faces, const RunContext& context)
{
    const std::size_t mouths = rims(model, faces).size();
    const auto readings = unless_refused([&] { return find_readings(model, faces, context); });
    if (readings && readings->size() == 1) {
        const VolumeClass value = readings->front().classification.value;
        return Cavity{word(value, mouths), faces, value, readings->front().enclosed};
    }
    if (mouths > 0) return std::nullopt;
    Model own = extract(model, faces);
    orient_consistently(own);
    return Cavity{word(VolumeClass::closed, mouths), faces, VolumeClass::closed,
                  std::abs(volume_integral(own, all_faces(own)))};
}

/// Hollows that share a whole rim, merged.
std::vector<std::vector<FaceId>> joined(const Model& model, const std::vector<Hollow>& hollows)
{
    const std::vector<std::size_t> first = joined_hollows(model, hollows);
    std::map<std::size_t, std::vector<FaceId>> by_root;
    for (std::size_t h = 0; h < hollows.size(); ++h)
        if (std::ranges::count(first, first[h]) > 1)
            std::ranges::copy(hollows[h].faces, std::back_inserter(by_root[first[h]]));
    std::vector<std::vector<FaceId>> result;
    for (auto& [root, faces] : by_root) {
        std::sort(faces.begin(), faces.end());
        result.push_back(std::move(faces));
    }
    return result;
}

} // namespace

std::vector<Cavity> cavities(const Model& model, const RunContext& context)
{
    const std::vector<Hollow> found = hollows(model, context);
    std::vector<std::vector<FaceId>> groups;
    for (const Hollow& hollow : found) groups.push_back(hollow.faces);
    for (std::vector<FaceId>& faces : joined(model, found)) groups.push_back(std::move(faces));
    std::ranges::stable_sort(groups, {}, [](const auto& faces) { return faces.front(); });
    std::vector<Cavity> result;
    for (const std::vector<FaceId>& faces : groups) {
        check_cancelled(context);
        if (auto one = cavity(model, faces, context)) result.push_back(std::move(*one));
    }
    return result;
}

} // namespace lacuna::closure
