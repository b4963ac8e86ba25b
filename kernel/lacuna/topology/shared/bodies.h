// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::topology {

/// A closed body of a model, such as a solid of a CAD file or a part of a mesh.
struct Body {
    std::string name;          ///< of its region; "body_1" … if its faces have none
    std::vector<FaceId> faces; ///< ascending; a face between two bodies is in both
};

/// The bodies of a model: its closed regions, in the order of their first faces, then the closed connected
/// parts of the other faces. Such a part within another one bounds a void of that one.
/// @throw Cancelled
std::vector<Body> bodies(const Model& model, const RunContext& context = {});

/// Check that no body lies inside another one, even in part. Bodies may touch.
/// @throw InvalidInput "topology.bodies_overlap"  names both.
/// @throw Cancelled
void require_apart(const Model& model, const std::vector<Body>& bodies, const RunContext& context = {});

} // namespace lacuna::topology
