// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <vector>

namespace lacuna::fill {

/// The message that two given faces of a volume cross: parts that reach into each other bound no volume.
/// Facets of curved faces may cross where the faces do not. They count if they cross by more than their sag,
/// and if no cylinder or ball of one face has the facet of the other on one side of it.
/// @return  empty if no faces cross
/// @note  O(facets log facets).
std::optional<Message> crossing_faces(const topology::Model& model, const std::vector<FaceId>& faces,
                                      const RunContext& context);

/// Do a job on some faces of a model. If it is refused and faces cross, the refusal says so: stages see the
/// crossing only by its effects, such as a loop that leaves a face.
/// @throw InvalidInput "topology.faces_cross". Or the errors of the job.
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
    } catch (const Error&) {
        if (const auto why = crossing_faces(model, faces, context)) throw InvalidInput(*why);
        throw;
    }
}

} // namespace lacuna::fill
