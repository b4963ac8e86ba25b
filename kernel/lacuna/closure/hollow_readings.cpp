// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/hollow_readings.h>

#include <lacuna/closure/detail/bowl.h>
#include <lacuna/closure/detail/class_five.h>
#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/void_sweeps.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <utility>

namespace lacuna::closure {

using namespace topology;

std::optional<Reading> read_bowl(const Model& model, const std::vector<FaceId>& faces,
                                 const RunContext& context)
{
    auto filled = fill_free_loops(model, faces, Missing::flat, context);
    if (!filled) return std::nullopt;
    auto bowl = part_bowl(filled->volume, context);
    if (!bowl) return std::nullopt;
    Reading reading;
    Roles& roles = reading.roles.roles;
    for (std::size_t f = 0; f < bowl->parent.size(); ++f) {
        const std::size_t given = bowl->parent[f].index();
        if (given >= faces.size()) continue;
        std::vector<FaceId>& list = list_of(roles, bowl->volume.role[f]);
        if (std::ranges::find(list, faces[given]) == list.end()) list.push_back(faces[given]);
    }
    reading.classification.value = filled->closure.void_faces.empty() ? VolumeClass::closed
                                   : roles.target.empty()             ? VolumeClass::IV
                                                                      : VolumeClass::III;
    reading.classification.reasons.push_back(
        formatted("the bottom blends smoothly into the walls; it is separated from them {:.4g} below {}, "
                  "where it bends",
                  bowl->depth, entity_of(bowl->volume.model, bowl->mouth)));
    reading.roles.value = reading.classification.value;
    reading.roles.reasons = reading.classification.reasons;
    reading.others = std::make_shared<const OtherSweeps>(OtherSweeps{*filled, {}});
    reading.volume = std::move(bowl->volume);
    reading.closure = std::move(filled->closure);
    reading.enclosed = enclosed_volume(reading.volume);
    return reading;
}

std::optional<Reading> read_floor(const Model& model, const std::vector<FaceId>& faces,
                                  const MayEnclose& may_enclose, const RunContext& context)
{
    const Roles walls{{}, {}, faces};
    const auto floors = unless_refused([&] {
        OpenVolume open = open_volume(model, walls, context); // renumbers the faces in the listed order
        if (free_loops(open).size() != 2 || connected_parts(open.model, open.faces(Role::wall)).size() != 1)
            return std::pair(false, false);
        const EndLoops ends = group_loops(open);
        return std::pair(!floors_round(open, ends.source).empty(), !floors_round(open, ends.target).empty());
    });
    // With two floors, the faces are a ring between two ends.
    if (!floors || floors->first == floors->second) return std::nullopt;
    const std::optional<Sealed> sealed = seal(model, walls, may_enclose, context);
    if (!sealed) return std::nullopt;
    Reading reading;
    reading.volume = sealed->volume;
    reading.closure = sealed->closure;
    reading.enclosed = sealed->enclosed;
    reading.guess = guess_of_bent(sealed->volume, sealed->closure, RolesBy::finding);
    if (!reading.guess) note_hole(model, {}, faces, *sealed, reading);
    if (!floors->first) {
        for (Role& role : reading.volume.role)
            role = role == Role::source ? Role::target : role == Role::target ? Role::source : role;
    }
    Roles& roles = reading.roles.roles;
    for (std::size_t f = 0; f < faces.size(); ++f)
        (reading.volume.role[f] == Role::source ? roles.source : roles.walls).push_back(faces[f]);
    reading.classification = class_as_given(model, roles);
    reading.roles.value = reading.classification.value;
    reading.roles.reasons.push_back(formatted("{} is a floor round a narrower bore, which is closed there",
                                              entity_of(model, roles.source.front())));
    return reading;
}

} // namespace lacuna::closure
