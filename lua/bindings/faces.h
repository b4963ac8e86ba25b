// SPDX-License-Identifier: MIT
#pragma once

// How a recipe names faces: a Face, a tag, a name, a selector, or an array of those.

#include "bindings/classes.h"
#include "bindings/options.h"

#include <lacuna/topology/shared/select_faces.h>

#include <vector>

namespace lacuna::lua {

using Selector = topology::FaceSelector;

inline int read_tag(lua_State* L, int index, const Where& where) { return read_whole(L, index, where, 0); }

void read_selector(lua_State* L, int index, const char* call, Selector& selector);

/// Mark the empty array on top of the stack as the result of the selector at `selector`. While the array is
/// empty, read_faces() refuses it and quotes the selector.
void mark_found_nothing(lua_State* L, int selector);

/// Append the faces that the value at `index` names: none for {}. Raises an error if another value names
/// none.
/// @pre the model is up to date.
void read_faces(lua_State* L, int index, const Where& where, const Box<ModelState>& model,
                std::vector<FaceId>& faces);

/// A Face of any model, or one face that the value names in `model`. `of` receives its model.
FaceId read_any_face(lua_State* L, int index, const Where& where, const Box<ModelState>& model,
                     Box<ModelState>& of);

struct PointAndNormal {
    Vec3 point, normal;
};

/// A plane { point, normal } or { point =, normal = }, whose normal is not 0.
PointAndNormal read_point_and_normal(lua_State* L, int index, const Where& where);

/// read_point_and_normal() with a normal of length 1.
geometry::Plane read_plane(lua_State* L, int index, const Where& where);
template <auto Member, class Options>
void plane(lua_State* L, int i, const Where& where, Options& o)
{
    o.*Member = read_plane(L, i, where);
}

/// Grow a face with the options of face_from at `index`, and replace the model by one with that face. Leaves
/// temporaries on the stack. @pre the model is up to date.
FaceId grow_face(lua_State* L, int index, const Box<ModelState>& model);

/// Push the names of faces, at most twenty, as a list for messages.
const char* push_names(lua_State* L, const topology::Model& model, const std::vector<FaceId>& faces);

/// Adds info(), cavities() and describe() to Model; called by bind_topology().
void bind_info(lua_State* L);

} // namespace lacuna::lua
