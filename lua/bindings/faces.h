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

/// The conditions of a table that selects faces; all that are set must hold.
struct Selector {
    std::optional<std::vector<int>> tags;
    std::string name, kind, region;
    std::optional<Vec3> facing, near;
    double normal_within = 30;    ///< of `facing` [degrees]
    std::optional<double> within; ///< if set, select all faces within this distance of `near`, not only the
                                  ///< closest [model length]
    std::array<double, 2> area{0, std::numeric_limits<double>::infinity()};
    std::optional<std::array<double, 2>> radius;
    std::optional<Eigen::AlignedBox3d> box;
    std::optional<bool> free;
    /// The selected faces share an edge with this face, given by a handle, a tag or a name.
    std::shared_ptr<ModelState> touching_model;
    FaceId touching;
    std::optional<int> touching_tag;
    std::string touching_name;
};

void read_selector(lua_State* L, int index, const char* call, Selector& selector);

/// The faces that a selector picks, in the model's order. A tag of a face that the file lists twice picks the
/// face that was kept.
std::vector<FaceId> select(const topology::Model& model, Selector selector);

/// Mark the empty array on top of the stack as the result of the selector at `selector`. While the array is
/// empty, read_faces() refuses it and quotes the selector.
void mark_found_nothing(lua_State* L, int selector);

/// Append the faces that the value at `index` names: none for {}. Raises an error if another value names
/// none.
/// @pre the model is up to date.
void read_faces(lua_State* L, int index, const Where& where, const Box<ModelState>& model,
                std::vector<FaceId>& faces);

struct PointAndNormal {
    Vec3 point, normal;
};

/// A plane { point, normal } or { point =, normal = }, whose normal is not 0.
PointAndNormal read_point_and_normal(lua_State* L, int index, const Where& where);

/// The same, with a normal of length 1.
geometry::Plane read_plane(lua_State* L, int index, const Where& where);

/// Grow a face with the options of face_from at `index`, and replace the model by one with that face. Leaves
/// temporaries on the stack. @pre the model is up to date.
FaceId grow_face(lua_State* L, int index, const Box<ModelState>& model);

/// Unit mean normal of the facets; zero if they cancel, as around a whole tube.
Vec3 mean_normal(const topology::Model& model, FaceId face);

/// Push the names of faces, at most twenty, as a list for messages.
const char* push_names(lua_State* L, const topology::Model& model, const std::vector<FaceId>& faces);

/// Adds info(), cavities() and describe() to Model; called by bind_topology().
void bind_info(lua_State* L);

} // namespace lacuna::lua
