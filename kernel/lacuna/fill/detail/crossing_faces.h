// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <vector>

namespace lacuna::fill {

/// The message that two given faces of a volume cross: parts that reach into each other bound no volume.
/// Facets of curved faces may cross where the faces do not. They count if they cross by more than their sag,
/// and if no cylinder or ball of one face has the facet of the other on one side of it. If none cross, the
/// message that two parts touch along a line or at a point.
/// @return  empty if there are no such faces
/// @note  O(facets log facets).
std::optional<Message> crossing_faces(const topology::Model& model, const std::vector<FaceId>& faces,
                                      const RunContext& context);

/// Do a job on some faces of a model. If it is refused and faces cross or touch, the refusal says so: stages
/// see that only by its effects, such as a loop that leaves a face.
/// @throw InvalidInput "topology.faces_cross", "topology.faces_touch". Or the errors of the job.
template <class Job>
auto unless_faces_cross(const topology::Model& model, const std::vector<FaceId>& faces,
                        const RunContext& context, const Job& job)
{
    try {
        return job();
    } catch (const Cancelled&) {
        throw;
    } catch (const BackendError&) {
        throw;
    } catch (const Error& error) {
        if (const auto why = crossing_faces(model, faces, context))
            throw InvalidInput(Message(*why).attempt(error.message()));
        throw;
    }
}

} // namespace lacuna::fill
