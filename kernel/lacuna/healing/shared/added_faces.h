// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/healing/split_facets.h>

#include <array>
#include <string>
#include <vector>

namespace lacuna::healing {

/// A face of a model that a recipe makes face by face.
struct AddedFace {
    std::string name;
    std::vector<Vec3> points;
    std::vector<std::array<int, 4>> cells; ///< numbers of points, from 1; the fourth is 0 for a triangle
    bool keep_mesh = false;                ///< whether meshes keep the nodes and quads of this face
};

/// The faces added so far. Each face has its own label, from 0 in the order of adding.
struct AddedFaces {
    FacetSoup soup;
    int count = 0;
    double tolerance = 0; ///< points closer than this are merged; 0: the default
};

/// Append a face. Quads that are not kept are divided into triangles.
void add(AddedFaces& faces, const AddedFace& face);

/// The model of the faces; tags count from 1 in the order of adding.
/// @throw InvalidInput "lua.face_in_parts"  the cells of a face are not connected. Or the errors of
///        split_facets().
/// @throw Cancelled
topology::Model model_of(const AddedFaces& faces, const RunContext& context = {});

} // namespace lacuna::healing
