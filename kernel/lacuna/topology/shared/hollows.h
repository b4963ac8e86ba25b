// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/model.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::topology {

/// For each part of a skin, whether it lies inside an odd number of other parts. @note O(facets · parts)
std::vector<bool> inner_parts(const Model& model, const std::vector<std::vector<FaceId>>& parts,
                              const RunContext& context = {});

/// Orient a closed skin so that its faces point out of the volume. The faces around a void inside the volume
/// then point into the void.
/// @pre  the faces of each connected part are oriented consistently.
void orient_skin(Model& model, const RunContext& context = {});

/// Orient the faces of each connected part consistently and, if no edge is free, out of the volume that they
/// enclose (`orient_skin()`).
/// @throw InvalidInput  as `orient_consistently()`
void orient_faces(Model& model, const RunContext& context = {});

/// Faces of a solid around a hollow, see `hollows()`.
struct Hollow {
    std::vector<FaceId> faces;  ///< ascending
    std::size_t mouths = 0;     ///< number of rims: 0 a void inside the solid, 1 a pocket, 2 or more a bore
    std::vector<FaceId> inside; ///< faces of bodies that stand in it and do not reach its mouths, such as the
                                ///< top of a post
    double volume = 0; ///< with each rim closed by a cone to the centre of the faces [model length³]
};

/// The order in which sets of faces are listed: by their first faces, then the largest first.
/// @pre both ascending, not empty
bool is_listed_before(const std::vector<FaceId>& a, const std::vector<FaceId>& b);

/// The hollows of closed skins. Hollow: a set of faces that are connected over concave or smooth edges, and
/// that face the space between them. A skin inside another skin is one hollow, whatever its orientation: it
/// surrounds a void in the solid. Outer skins as a whole and skins with free edges are not hollows. Hollows
/// that share a whole rim, such as a bore and its counterbore, are separate. A hollow with faces beside it
/// that enclose its mouth, such as the neck of a T-slot, is listed with these faces and without them.
/// @return in the order of their first faces, the largest first; empty if the faces cannot be oriented.
/// @throw Cancelled
/// @note  Near linear in facets.
std::vector<Hollow> hollows(const Model& model, const RunContext& context = {});

/// Group hollows that share an edge, directly or through other hollows, such as a bore and its counterbore,
/// or a pocket and a slot in its side. @return  for each hollow, the index of the first hollow of its group.
std::vector<std::size_t> joined_hollows(const Model& model, const std::vector<Hollow>& hollows);

/// The faces of the cavity to which the given faces of a closed skin belong:
/// - the faces of the hollows that contain the given faces;
/// - the faces of hollows that share an edge with these hollows, such as a counterbore;
/// - the faces of bodies that stand in the cavity and do not reach its mouths, such as a post.
/// @return ascending; empty if the faces lie in no hollow.
/// @throw Cancelled
/// @note  Near linear in facets.
std::vector<FaceId> cavity_round(const Model& model, const std::vector<FaceId>& faces,
                                 const RunContext& context = {});

/// The closed bodies of a model whose faces point outward.
class Bodies {
public:
    explicit Bodies(const Model& model);

    /// The share of the skins of bodies that some faces are, by area; the largest of several bodies. 1 if a
    /// face belongs to no body.
    [[nodiscard]] double share_of(const std::vector<FaceId>& faces) const;

private:
    std::vector<std::size_t> body_; ///< by face; `kNoIndex`: none
    std::vector<double> area_;      ///< of the faces [model length²]
    std::vector<double> skin_;      ///< areas of the bodies [model length²]
};

/// Whether a sealed volume lies in the material of the bodies to which its given faces belong, by area.
/// @param faces   of the bodies in `model`
/// @param sealed  these faces with their tags, and void faces; oriented outward
bool lies_in_material(const Model& model, const std::vector<FaceId>& faces, const Model& sealed);

/// The first of some faces that lies inside a volume; checked where the face is deepest in the volume's box.
/// @param tree  of the facets of the volume.
std::optional<FaceId> any_inside(const Model& model, const std::vector<FaceId>& faces,
                                 const geometry::FacetTree& tree);

/// One face of each connected part of a model's other faces that lies inside a volume, where a mesh of the
/// volume goes through a body or a shell. Faces between two mesh regions are left out.
/// @param volume  some faces of the model, with their tags; void faces may be added.
/// @throw Cancelled
/// @note  O(facets of the volume) for each face within its bounding box.
std::vector<FaceId> bodies_inside(const Model& model, const Model& volume, const RunContext& context = {});

} // namespace lacuna::topology
