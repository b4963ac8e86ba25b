// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <cstddef>
#include <vector>

namespace lacuna::topology {

/// Faces of a solid that lie round a hollow of it.
struct Hollow {
    std::vector<FaceId> faces; ///< rising
    std::size_t mouths = 0;    ///< rims: 0 a void inside the solid, 1 a pocket, 2 and more a bore
};

/// The hollows of closed skins: faces that hang together over edges where the skin bends inward, or smoothly,
/// and face the space they surround. A skin that lies within another one surrounds a void inside the solid,
/// whichever way its facets are wound. An outer skin is no hollow, and neither is a skin with free edges.
/// Hollows that share a whole rim, as a bore and what widens it, are told apart.
/// @return in the order of their first faces; none where the faces cannot be oriented.
/// @throw Cancelled
/// @note  Near linear in facets.
std::vector<Hollow> hollows(const Model& model, const RunContext& context = {});

/// Of each hollow the first of those that share whole rims, one with the next, as a bore and what widens it.
std::vector<std::size_t> joined_hollows(const Model& model, const std::vector<Hollow>& hollows);

/// The faces of the cavity of a closed skin that some faces lie in: of the hollows of these, of those that
/// share a whole rim with them, as what widens a bore does, and of what stands in them below their mouths,
/// as the top of a post.
/// @return rising; none where the faces lie in no hollow.
/// @throw Cancelled
/// @note  Near linear in facets.
std::vector<FaceId> cavity_round(const Model& model, const std::vector<FaceId>& faces,
                                 const RunContext& context = {});

} // namespace lacuna::topology
