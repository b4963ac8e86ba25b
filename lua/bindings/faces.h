// SPDX-License-Identifier: MIT
#pragma once

// How a recipe names faces: a Face, a tag, a name, a selector, or an array of those.

#include "bindings/classes.h"
#include "bindings/options.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace lacuna::lua {

/// What a table that selects faces asks for; all that is set must hold.
struct Selector {
    std::optional<std::vector<int>> tags;
    std::string name, kind, region;
    std::optional<Vec3> facing, near;
    double normal_within = 30;    ///< of `facing` [degrees]
    std::optional<double> within; ///< all faces that close to `near`, not the one closest [model length]
    std::array<double, 2> area{0, std::numeric_limits<double>::infinity()};
    std::optional<std::array<double, 2>> radius;
    std::optional<Eigen::AlignedBox3d> box;
    std::optional<bool> free;
    /// Shares an edge with a face: one of a handle, a tag or a name.
    std::shared_ptr<ModelState> touching_model;
    FaceId touching;
    std::optional<int> touching_tag;
    std::string touching_name;
};

void read_selector(lua_State* L, int index, const char* call, Selector& selector);

/// Faces a selector picks, in the model's order.
std::vector<FaceId> select(const topology::Model& model, const Selector& selector);

/// Mark the empty array on top of the stack as what the selector at `selector` found; read_faces() refuses it
/// by the selector's words until faces are put into it.
void mark_found_nothing(lua_State* L, int selector);

/// Append the faces the value at `index` means: none where it is {}. Raises where something else means none.
/// @pre the model is up to date.
void read_faces(lua_State* L, int index, const Where& where, const Box<ModelState>& model,
                std::vector<FaceId>& faces);

/// A plane { point, normal }.
geometry::Plane read_plane(lua_State* L, int index, const Where& where);

/// Grow a face by the options of face_from at `index`; the model is another afterwards. Leaves temporaries on
/// the stack. @pre the model is up to date.
FaceId grow_face(lua_State* L, int index, const Box<ModelState>& model);

/// Unit mean normal of the facets; zero where they have none, as all round a tube.
Vec3 mean_normal(const topology::Model& model, FaceId face);

/// Push the names of faces, at most twenty, as a list for messages.
const char* push_names(lua_State* L, const topology::Model& model, const std::vector<FaceId>& faces);

/// Adds info(), cavities() and describe() to Model; called by bind_topology().
void bind_info(lua_State* L);

} // namespace lacuna::lua
