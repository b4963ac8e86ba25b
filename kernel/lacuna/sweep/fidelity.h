// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/mesh/tet_mesh.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// How a mesh deviates from a face.
enum class Misfit {
    none,
    no_quads, ///< the face has no quads
    folded,   ///< a quad is inverted against the face
    /// Nodes are off the face, or the quads cut off an edge of the face.
    cut,
    straight, ///< nodes are on the face, but the face curves between them
};

/// Distance between the mesh's skin and one face of the sealed skin.
struct FaceFidelity {
    FaceId face;        ///< face of the volume's model
    NamedEntity entity; ///< as messages name it
    int tag = 0;        ///< as shown to the user; void faces have tags of their own
    bool made_void = false;
    std::size_t quads = 0; ///< number of quads of the skin on the face
    /// The largest distance from the quads to the face or from the face to the quads [model length]. If the
    /// face has no quads: the width of the face, that is, twice its area divided by the length of its rim.
    double max_distance = 0;
    double mean_distance = 0;  ///< mean over the area; the larger of both directions [model length]
    Vec3 place = Vec3::Zero(); ///< place of the maximum distance

    Misfit misfit = Misfit::none;
    /// Distance found and allowed, where their ratio is largest [model length].
    double found = 0, allowed = 0;
    Vec3 found_at = Vec3::Zero();
    double side = 0; ///< longest side of a quad there; for `straight`, the side that deviates [model length]
    double source_side = 0;    ///< for `straight`: the corresponding side on the source [model length]
    bool along_layers = false; ///< for `straight`: that side runs from layer to layer
};

/// The proof of shape: the mesh's skin against the sealed skin.
struct Fidelity {
    double volume = 0;        ///< volume of the mesh [model length³]
    double sealed_volume = 0; ///< inside the sealed skin, with exact faces [model length³]
    /// The largest distance of any face, and the mean over the area of all faces [model length].
    double max_distance = 0, mean_distance = 0;
    std::vector<FaceFidelity> faces; ///< in the model's order
};

struct FidelityOptions {
    /// Allowed distance between skin and face, >= 0 [model length]; 0: a quarter of the side of a quad there.
    /// For comparison: sides that span a twelfth of a turn deviate by a fifteenth of their length, quads with
    /// such sides on a sphere by an eighth, and coarse quads on domes by up to 0.23.
    double max_deviation = 0;
    /// Void faces between two volumes of an assembly. They may deviate by a whole side, because both volumes
    /// have the same quads there and the position of these quads does not affect the outer shape.
    std::set<FaceId> between{};
    /// The requested size; null: none. Errors suggest a smaller one. Sides may be up to a quarter longer than
    /// requested, so suggesting the same size again would not help.
    surface::SizeField size{};
};

/// Compare the skin of a mesh with the sealed skin, face by face.
///
/// The quads of a face's patch are compared with the face at their nodes, midpoints of sides and centres. The
/// face is compared with the patch at its facets' corners, midpoints of sides and centres. Faces with an
/// exact surface are represented by quadratic patches over their facets (`surface::FaceShape`), whose error
/// is of higher order than that of straight sides. If every patch of quads lies on its face, no quad is
/// inverted and the skin is closed, then the skin covers each face once. The comparison therefore finds an
/// omitted face, a quad on a wrong face and a fold even if no distance shows them.
/// @param faces   face of each patch of the mesh.
/// @param kept    faces whose own quads are kept; they are exact and not compared.
/// @param volume_of_mesh  volume of the cells, which the caller has measured [model length³].
/// @param layers  generator of the nodes; null: the mesh stores its nodes.
/// @throw Cancelled
/// @note  Deterministic for any thread count. O((quads of the skin + facets) log).
Fidelity compare(const topology::OpenVolume& volume, const mesh::HexMesh& mesh,
                 const std::vector<FaceId>& faces, const std::set<FaceId>& kept, double volume_of_mesh,
                 const FidelityOptions& options = {}, const RunContext& context = {},
                 const mesh::LayeredNodes* layers = nullptr);

/// `compare()` for tetrahedra and pyramids.
Fidelity compare(const topology::OpenVolume& volume, const mesh::TetPart& mesh,
                 const std::vector<FaceId>& faces, double volume_of_mesh, const FidelityOptions& options = {},
                 const RunContext& context = {});

/// Describe the face that exceeds the allowed distance most: its name, the place, and the distance found and
/// allowed. For straight sides on a bend, suggest the size or the number of layers that reduces their sag to
/// the allowed distance. Empty if no face exceeds it.
std::optional<Message> misfit(const Fidelity& fidelity, int layers, const FidelityOptions& options = {});

/// Check the total volume. This check finds straight sides across a bend of 90°, which the distance check
/// accepts.
/// @throw NotSweepable "sweep.deviation"  the mesh's volume differs from the sealed volume by more than a
///         fifth.
void require_volume(const Fidelity& fidelity, int layers);

/// One line of text: volumes and distances, and the face with the largest distance.
std::string in_words(const Fidelity& fidelity);

} // namespace lacuna::sweep
