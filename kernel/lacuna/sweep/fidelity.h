// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// What a mesh does to a face it is too far off.
enum class Misfit {
    none,
    no_quads, ///< the skin leaves the face out
    folded,   ///< a quad of it faces the other way
    cut,      ///< nodes are off the face, or part of the face is off the quads: an edge is cut across
    straight, ///< nodes are on the face, which bends away between them
};

/// How far the mesh's skin and one face of the sealed skin are apart.
struct FaceFidelity {
    FaceId face;      ///< of the volume's model
    std::string name; ///< as messages name it: `face 12 "lid"`
    int tag = 0;      ///< as the person knows it; void faces have tags of their own
    bool made_void = false;
    std::size_t quads = 0; ///< of the skin
    /// Larger of the two ways: quads to face, and face to the quads that are its own [model length]. Of a
    /// face without quads its width: twice its area over the length of its rim.
    double max_distance = 0;
    double mean_distance = 0;  ///< by area, the larger of the two ways [model length]
    Vec3 place = Vec3::Zero(); ///< where the two are furthest apart

    Misfit misfit = Misfit::none;
    double found = 0, allowed = 0; ///< where distance over what is allowed is largest [model length]
    Vec3 found_at = Vec3::Zero();
    double side = 0; ///< longest side of a quad there; of `straight`, the one that is off [model length]
    double source_side = 0;    ///< of `straight`: the side of the source it was swept from [model length]
    bool along_layers = false; ///< of `straight`: that side runs from layer to layer
};

/// The proof of shape: the mesh's skin against the sealed skin.
struct Fidelity {
    double volume = 0;        ///< of the hexahedra [model length³]
    double sealed_volume = 0; ///< within the sealed skin, exact faces as they are [model length³]
    double max_distance = 0, mean_distance = 0; ///< over all faces [model length]
    std::vector<FaceFidelity> faces;            ///< in the model's order
};

struct FidelityOptions {
    /// How far skin and face may be apart, >= 0 [model length]; 0: a quarter of the side of a quad there.
    /// Sides that stand for a twelfth of a turn are off by a fifteenth of their length, quads on a sphere of
    /// such sides by an eighth; domes of coarse quads by up to 0.23.
    double max_deviation = 0;
    /// Void faces between two volumes of an assembly: both have the same quads there, and the place of these
    /// changes nothing of the whole. They may be off by a whole side.
    std::set<FaceId> between{};
    /// The size asked for, null: none was. What an error names is smaller: sides may be up to a quarter
    /// longer than asked, and a size that is named again would not help.
    surface::SizeField size{};
};

/// Compare the skin of a mesh with the sealed skin, face by face.
///
/// Nodes, middles of sides and centres of the quads of a face's patch are compared with the face; corners,
/// middles of sides and centres of the face's facets with the patch. Faces with an exact surface are
/// compared as quadratic patches over their facets (`surface::FaceShape`), whose error is of a higher order
/// than what straight sides miss. Where every patch lies on its face, no quad faces the other way and
/// the skin is closed, it covers each face once; so a face that is left out, a quad of the wrong face and
/// a fold are found even where no distance shows them.
/// @param faces   of each patch of the mesh.
/// @param kept    faces whose own quads are the mesh; they are exact, and not compared.
/// @param volume_of_mesh  of the hexahedra, as measured already [model length³].
/// @param layers  what makes the nodes of a mesh that does not hold them; null: it holds them.
/// @throw Cancelled
/// @note  The same for any thread count. O((quads of the skin + facets) log).
Fidelity compare(const topology::OpenVolume& volume, const mesh::HexMesh& mesh,
                 const std::vector<FaceId>& faces, const std::set<FaceId>& kept, double volume_of_mesh,
                 const FidelityOptions& options = {}, const RunContext& context = {},
                 const mesh::LayeredNodes* layers = nullptr);

/// The face that is furthest beyond what is allowed, for a person: its name, the place, the distance found
/// and allowed, and for straight sides on a bend the size, or the number of layers, by which their sag would
/// be as small as that. Empty where every face is followed.
std::string misfit_in_words(const Fidelity& fidelity, int layers, const FidelityOptions& options = {});

/// Chords of long sides stay within a quarter of their own length of a face that turns by a right angle under
/// them: what they cut off in all tells.
/// @throw NotSweepable "sweep.deviation"  the mesh's volume is more than a fifth off the sealed one.
void require_volume(const Fidelity& fidelity, int layers);

/// One line for a person: volumes and distances, and the face that is furthest off.
std::string in_words(const Fidelity& fidelity);

} // namespace lacuna::sweep
