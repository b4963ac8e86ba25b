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

/// A model whose parts no longer touch face to face. The faces in contact are gone, and the parts are
/// connected along the rims of these faces.
struct JoinedParts {
    topology::Model model;
    /// For each face of the original model: the faces into which it was split, or the face itself. Empty if
    /// the whole face was in contact and is gone.
    std::vector<std::vector<FaceId>> faces_of;
    std::string note; ///< names a pair of faces in contact
};

/// If ends lie on the outside of one of several bodies, leave out the faces of all others, before walls are
/// found.
/// @return  empty if each end bounds another body or a cavity, or the model is one body.
/// @throw InvalidInput "topology.walls_ambiguous"  the ends lie on the outside of two bodies; names both.
std::optional<JoinedParts> leave_out_other_bodies(const topology::Model& model,
                                                  const std::vector<FaceId>& ends,
                                                  const RunContext& context = {});

/// Leave out faces that coincide with another one on the same edges, before walls are found. A STEP file of
/// solids that touch has the faces between them twice.
/// @param ends  these faces are kept, and the faces that coincide with them are left out.
/// @return  empty if there are no such faces.
std::optional<JoinedParts> leave_out_double_faces(const topology::Model& model,
                                                  const std::vector<FaceId>& ends);

/// Leave out the faces that two solids share where one solid stands on the whole top of the other. At each
/// edge of such a face three faces of the volume meet; without the shared face, two remain.
/// @param named  all faces of the volume; with `all_follow`, only its ends (which are kept).
/// @param all_follow  whether the walls are still unknown; then all other faces of the model are examined.
/// @return  empty if there are no such faces.
std::optional<JoinedParts> leave_out_shared_faces(const topology::Model& model,
                                                  const std::vector<FaceId>& named, bool all_follow);

/// Join the parts of a volume's skin that touch, such as a box and a separate solid that stands on its floor.
/// The area that two faces share is cut out of both faces, because it does not bound the volume.
///
/// Whole solids side by side are not joined, unless they are inside another part.
/// @param named  all faces of the volume; with `all_follow`, only some of them.
/// @param all_follow  whether the other faces of the volume are still unknown and found later.
/// @return  empty if nothing touches.
/// @throw InvalidInput "assembly.part_of_face"  faces in contact cannot be split; names both.
///         "assembly.rims_apart"  see `sweep::shared_faces()`.
/// @note  Only parts with named faces whose boxes meet are compared.
std::optional<JoinedParts> join_touching_parts(const topology::Model& model, const std::vector<FaceId>& named,
                                               bool all_follow, const RunContext& context = {});

} // namespace lacuna::fill
