// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <string>
#include <vector>

namespace lacuna::fill {

/// Add the faces of a model, without joining edges. All edges and vertices become given ones.
void add_model(topology::ModelBuilder& builder, const topology::Model& more);

/// A model whose parts no longer touch. They are connected along the rims of their contacts instead.
struct JoinedParts {
    topology::Model model;
    /// For each face of the original model: the faces that it has become. Empty if the whole face was in
    /// contact.
    std::vector<std::vector<FaceId>> faces_of;
    std::string note; ///< names a pair of faces in contact
};

/// Leave out faces that coincide with another one on the same edges, before walls are found. A STEP file of
/// solids that touch has the faces between them twice.
/// @param ends  these faces are kept, and the faces that coincide with them are left out.
/// @return  empty if there are no such faces.
std::optional<JoinedParts> leave_out_double_faces(const topology::Model& model,
                                                  const std::vector<FaceId>& ends);

/// Leave out the faces that two solids share where one solid stands on the whole top of the other. At each
/// edge of such a face three faces of the volume meet; without the shared face, two remain.
/// @param named  all faces of the volume; if `all_follow`, only its ends, which are kept.
/// @param all_follow  the walls are not known yet, so that every other face of the model may be one.
/// @return  empty if there are no such faces.
std::optional<JoinedParts> leave_out_shared_faces(const topology::Model& model,
                                                  const std::vector<FaceId>& named, bool all_follow);

/// Join the parts of a volume's skin that touch, such as a box and a product of another solid on its floor.
/// The area that two faces share is split off both and left out, because it does not bound the volume.
///
/// Whole solids side by side are not joined, unless they stand inside another part.
/// @param named  faces of the volume, or, if `all_follow`, some of them; the others are then found later.
/// @return  empty if nothing touches.
/// @throw InvalidInput "assembly.part_of_face"  faces in contact cannot be split; names both.
///         "assembly.rims_apart"  see `sweep::shared_faces()`.
/// @note  Only parts with named faces whose boxes meet are compared.
std::optional<JoinedParts> join_touching_parts(const topology::Model& model, const std::vector<FaceId>& named,
                                               bool all_follow, const RunContext& context = {});

} // namespace lacuna::fill
