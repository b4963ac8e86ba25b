// SPDX-License-Identifier: MIT
#pragma once

// The C++ objects behind Lua's classes, and functions that push values to Lua.

#include "bindings/box.h"
#include "bindings/push.h"
#include "bindings/stage_clock.h"

#include <lacuna/core/run_context.h>
#include <lacuna/fill.h>
#include <lacuna/fill/shared/cell_data.h>
#include <lacuna/healing/shared/added_faces.h>
#include <lacuna/io/load_facets.h>
#include <lacuna/topology/model.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lacuna::lua {

/// A model that was read, or one made by hand, to which a recipe adds faces. The facets of added faces are
/// collected first; the topology is made when it is needed.
struct ModelState : io::LoadedFiles {
    bool hand_made = false;
    healing::AddedFaces added{}; ///< with `hand_made`
    bool stale = false;          ///< `model` lacks faces of `added`
    /// For each face that was grown: the new id of every earlier face; not valid: merged into the grown one.
    std::vector<std::vector<FaceId>> moves;
};

/// Rebuild `model` if faces were added.
/// @throw InvalidInput  the cells of an added face are not connected.
/// @throw Cancelled
void refresh(ModelState& state, const RunContext& context);

/// refresh() with the host's context. Raises Lua errors.
void bring_up_to_date(lua_State* L, ModelState& state);
/// The Model at `index`, held and brought up to date.
const Box<ModelState>& hold_model(lua_State* L, int index);

struct FaceHandle {
    std::shared_ptr<ModelState> model;
    FaceId face;           ///< id in the model when the handle was made
    std::size_t moves = 0; ///< number of the model's `moves` at that time
};

/// The current id of a handle's face; invalid if the face has become part of another.
FaceId face_now(const FaceHandle& handle);
/// face_now() of a face that must exist.
/// @throw InvalidInput "lua.face_grown_over"  the face has become part of another.
FaceId face_of(const FaceHandle& handle);

struct VolumeState : fill::Volume {
    const char* busy = nullptr; ///< the method that works on it; null: none
    /// Take the result of a stage.
    VolumeState& operator=(fill::Volume made)
    {
        fill::Volume::operator=(std::move(made));
        return *this;
    }
};

/// Marks a volume as worked on, so that a function of the recipe that is called meanwhile cannot change it.
class Busy {
public:
    /// @throw InvalidInput "lua.busy"  the volume is marked already.
    Busy(VolumeState& state, const char* method);
    ~Busy() { state_.busy = nullptr; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

private:
    VolumeState& state_;
};

struct MeshState : fill::FilledVolume {
    StageSeconds seconds; ///< of the sweep
};

/// The mesh of an assembly.
struct AssemblyMeshState : fill::FilledParts {
    std::optional<quality::Quality> quality;
    StageSeconds seconds; ///< of the sweep
};

/// Quads on faces.
struct QuadMeshState : fill::FilledShell {
    StageSeconds seconds;
};

/// Push the mesh of a sweep as a Mesh or an AssemblyMesh.
void push_filled(lua_State* L, fill::Filled& filled, const StageSeconds& seconds);

/// Volumes to be meshed as one, and meshes that stay as they are.
struct AssemblyState {
    /// Exactly one of the three is set.
    struct Entry {
        std::shared_ptr<VolumeState> volume;
        std::shared_ptr<MeshState> mesh;
        std::shared_ptr<AssemblyMeshState> meshes;
        [[nodiscard]] fill::Member member() const { return {volume.get(), mesh.get(), meshes.get()}; }
        friend bool operator==(const Entry&, const Entry&) = default;
    };
    std::vector<Entry> entries;
};

using fill::whole_cells;
using fill::WholeCells;

/// Push a mesh's `fidelity` as a table. Given faces have their tags as keys, faces of voids the names of
/// their groups.
void push_fidelity(lua_State* L, const sweep::Fidelity& fidelity);

template <>
inline constexpr const char* kClassName<ModelState> = "Model";
template <>
inline constexpr const char* kClassName<AssemblyState> = "Assembly";
template <>
inline constexpr const char* kClassName<AssemblyMeshState> = "AssemblyMesh";
template <>
inline constexpr const char* kClassName<QuadMeshState> = "QuadMesh";
template <>
inline constexpr const char* kClassName<FaceHandle> = "Face";
template <>
inline constexpr const char* kClassName<VolumeState> = "Volume";
template <>
inline constexpr const char* kClassName<MeshState> = "Mesh";

/// A context with the host's cancel flag and log, as a temporary on the stack.
RunContext& push_context(lua_State* L);

// --- pushing ------------------------------------------------------------------------------------------

/// The option `contacts` of the table at `index`, as a temporary.
fill::ContactRequest& push_contact_request(lua_State* L, int index);
/// Near misses of an assembly, as `near_misses` of the report on top of the stack.
void set_near_misses(lua_State* L, const fill::FilledParts& mesh);
void push_face(lua_State* L, const Box<ModelState>& model, FaceId face);
/// { { name=, dim=, cells= }, ... }
void push_groups(lua_State* L, const std::vector<fill::Group>& groups);
/// Push lines as a Report, as mesh.report returns it.
void push_report(lua_State* L, const std::vector<std::string>& lines, const StageSeconds& seconds);

/// The number at index 2, from 1 to `count`, as an index from 0; raises an error for other values.
std::size_t check_number(lua_State* L, const char* call, std::size_t count);

/// A field whose value `Get` takes from the object.
template <class State, auto Get>
int field(lua_State* L)
{
    return give(L, Get(check<State>(L, 1)));
}

/// An edge of the model as a table: its tag, those of its ends, its length.
void push_edge(lua_State* L, const topology::Model& model, EdgeId edge);

/// Tags of entities of the model, as an array in the table on top.
template <class Id>
void set_tags(lua_State* L, const char* key, const topology::Model& model, const std::vector<Id>& ids)
{
    set_array(L, key, ids, [&](const auto& id) { push(L, model[id].tag); });
}

// --- fields and methods that several kinds of meshes share ------------------------------------------

template <class State>
int mesh_nodes(lua_State* L)
{
    return give(L, fill::node_count(check<State>(L, 1)));
}
template <class State>
int mesh_order(lua_State* L)
{
    return give(L, fill::order(check<State>(L, 1)));
}
/// Number of cells of a shape that the mesh cannot have
template <class State>
int no_cells(lua_State* L)
{
    check<State>(L, 1);
    return give(L, 0);
}
template <class State, mesh::CellShape Shape>
int cell_count(lua_State* L)
{
    return give(L, fill::cell_count(check<State>(L, 1), Shape));
}
/// x, y, z = mesh:node(i)
template <class State>
int mesh_node(lua_State* L)
{
    lua_settop(L, 2);
    const State& state = check<State>(L, 1);
    for (const double x : fill::node(state, check_number(L, "node", fill::node_count(state))))
        lua_pushnumber(L, x);
    return 3;
}
/// n1, ... = mesh:hex(i), mesh:wedge(i), mesh:pyramid(i) or mesh:tet(i): the corners, also of cells of order
/// 2. Cells are numbered part by part.
template <class State, mesh::CellShape Shape>
int cell(lua_State* L)
{
    lua_settop(L, 2);
    const State& state = check<State>(L, 1);
    const std::size_t number = check_number(L, fill::shape_name(Shape), fill::cell_count(state, Shape));
    const mesh::CellNodes corners = fill::cell(state, Shape, number);
    for (const Index corner : corners) lua_pushinteger(L, to_lua(corner));
    return static_cast<int>(corners.count);
}
/// { {name=, dim=, cells=}, ... } = mesh:groups()
template <class State>
int mesh_groups(lua_State* L)
{
    const State& state = hold<State>(L, 1);
    auto& groups = temporary<std::vector<fill::Group>>(L);
    guard(L, [&] { groups = fill::groups(state); });
    push_groups(L, groups);
    return 1;
}

// --- one for each kernel folder; each adds its functions to the module's table on top of the stack -----

void bind_topology(lua_State* L);
void bind_open_volume(lua_State* L);
void bind_matching(lua_State* L);
void bind_closure(lua_State* L);
void bind_sweep(lua_State* L);
void bind_assembly(lua_State* L);
void bind_assembly_sweep(lua_State* L);
void bind_mesh(lua_State* L);
void bind_quads(lua_State* L);
void bind_quality(lua_State* L);
void bind_io(lua_State* L);
void bind_cad(lua_State* L);
void bind_copies(lua_State* L);
void bind_view(lua_State* L);

} // namespace lacuna::lua
