// SPDX-License-Identifier: MIT
#pragma once

// What Lua's objects hold, and the small C++ between them and the kernel. Nothing here knows of Lua but the
// names.

#include "bindings/box.h"
#include "bindings/stage_clock.h"

#include <lacuna/closure/close.h>
#include <lacuna/closure/readings.h>
#include <lacuna/core/run_context.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/io/deck.h>
#include <lacuna/matching/match.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/model.h>
#include <lacuna/topology/open_volume.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::lua {

/// A model that was read, or one whose faces a recipe adds: then facets are gathered first and the
/// topology is made when it is asked for.
struct ModelState {
    topology::Model model;
    bool hand_made = false;
    double tolerance = 0;     ///< with `hand_made`: points closer than this are one; 0: the default
    healing::FacetSoup added; ///< with `hand_made`: a label a face, in the order of adding
    int added_faces = 0;
    bool stale = false;                                 ///< `model` lacks faces of `added`
    std::vector<std::shared_ptr<const io::Deck>> decks; ///< the meshes it was read from
    double scale = 1;                                   ///< of its coordinates to theirs
    /// Of each time a face was grown, where each face there was went; not valid: into the grown one.
    std::vector<std::vector<FaceId>> moves;
};

/// Bring `model` up to date with what was added.
/// @throw InvalidInput  an added face falls apart into several; names it. Cancelled.
void refresh(ModelState& state, const RunContext& context);

/// The same with the host's context, where errors may be raised.
void bring_up_to_date(lua_State* L, ModelState& state);

struct FaceHandle {
    std::shared_ptr<ModelState> model;
    FaceId face;           ///< as its model was
    std::size_t moves = 0; ///< after so many of the model's
};

/// The face a handle means in its model as it is; not valid: it is part of another by now.
FaceId face_now(const FaceHandle& handle);
/// The same where there must be one.
/// @throw InvalidInput "lua.face_grown_over"  it is part of another by now.
FaceId face_of(const FaceHandle& handle);

struct VolumeState {
    topology::OpenVolume volume;
    const char* busy = nullptr;              ///< the method that works on it; null: none
    std::vector<std::string> role_reasons;   ///< why the faces got their roles; empty where they were named
    topology::Classification classification; ///< as the volume was given
    std::optional<matching::Match> match;
    std::optional<closure::Closure> closure;
    std::optional<closure::SealedVolume> as_read; ///< where its roles were found: how it is closed by default
    /// Of found roles: other ways to sweep what is enclosed, for where this one fails.
    std::shared_ptr<const closure::OtherSweeps> others;
    std::string name;        ///< of the region its cells are; empty: the default
    bool take_guess = false; ///< whether a shape that nothing given tells is taken as it closes
    bool told = false;       ///< whether the closure's notes were logged
    int level = 0; ///< of a piece cut at steps: 0 goes from end to end, others have what layers are left
    double turn_from = 0, turn_to = 1; ///< of a piece of a full turn: where it is, as shares of the turn
    std::string turn_of;               ///< of a piece of a full turn: the region that all of it is
    std::string material;              ///< name or number of its material; empty: none was said
    std::vector<std::shared_ptr<const io::Deck>> decks; ///< those of the model it was made of
    double scale = 1;                                   ///< of its coordinates to theirs
};

/// Marks a volume as worked on, so that a function of the recipe that is called meanwhile cannot change it.
class Busy {
public:
    /// @throw InvalidInput "lua.busy"  it is being worked on.
    Busy(VolumeState& state, const char* method);
    ~Busy() { state_.busy = nullptr; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

private:
    VolumeState& state_;
};

/// Match the ends unless that is done.
void match_volume(VolumeState& state, const matching::MatchOptions& options, const RunContext& context);
/// Seal the volume unless that is done; as it was before where it fails.
void close_volume(VolumeState& state, const closure::CloseOptions& options, const RunContext& context);

struct MeshState {
    sweep::Swept swept;
    std::string material; ///< of the volume
    StageSeconds seconds; ///< of the sweep
};

/// The mesh of an assembly.
struct AssemblyMeshState {
    sweep::SweptAssembly swept;
    std::vector<std::string> regions;   ///< of each part
    std::vector<std::string> materials; ///< of each part; empty ones: none was said
    std::vector<sweep::LeftOut> left_out;
    std::optional<quality::Quality> quality;
    StageSeconds seconds; ///< of the sweep
};

/// Volumes to be meshed as one, and meshes that stay as they are.
struct AssemblyState {
    /// One of the three.
    struct Entry {
        std::shared_ptr<VolumeState> volume;
        std::shared_ptr<MeshState> mesh;
        std::shared_ptr<AssemblyMeshState> meshes;
        friend bool operator==(const Entry&, const Entry&) = default;
    };
    std::vector<Entry> entries;
};

/// The nodes and cells of all parts, numbered as one mesh.
struct WholeCells {
    std::vector<Vec3> nodes;
    std::vector<Hex> hexes;              ///< corners; wedges as `mesh::is_wedge()` has them
    std::vector<mesh::CellNodes> curved; ///< of order 2: all nodes
    std::vector<Index> column;           ///< that each cell is of, numbered over all parts
};
WholeCells whole_cells(const sweep::SweptAssembly& swept);

/// Push what a mesh's `fidelity` is to recipes: given faces by their tags, void ones by their groups' names.
void push_fidelity(lua_State* L, const sweep::Fidelity& fidelity);

template <>
inline constexpr const char* kClassName<ModelState> = "Model";
template <>
inline constexpr const char* kClassName<AssemblyState> = "Assembly";
template <>
inline constexpr const char* kClassName<AssemblyMeshState> = "AssemblyMesh";
template <>
inline constexpr const char* kClassName<FaceHandle> = "Face";
template <>
inline constexpr const char* kClassName<VolumeState> = "Volume";
template <>
inline constexpr const char* kClassName<MeshState> = "Mesh";

/// A context with the host's cancel flag and log, as a temporary on the stack.
RunContext& push_context(lua_State* L);

// --- texts a person reads -----------------------------------------------------------------------------

/// Volume, faces, edges, vertices, void ones marked, with the geometry of each.
std::string tree(const topology::OpenVolume& volume);
/// Roles, class and why, what is void, what matched.
std::string describe(const VolumeState& state);

// --- pushing ------------------------------------------------------------------------------------------

void push_vector(lua_State* L, const Vec3& vector);           ///< {x, y, z}
void set_number(lua_State* L, const char* key, double value); ///< into the table on top
void set_count(lua_State* L, const char* key, std::size_t value);
void set_boolean(lua_State* L, const char* key, bool value);
void set_string(lua_State* L, const char* key, const char* value);
void set_strings(lua_State* L, const char* key, const std::vector<std::string>& values);
/// The array of lines on top prints as lines from now on, and gets the field `seconds`, a table by stage.
void set_report_meta(lua_State* L, const StageSeconds& seconds);
void push_face(lua_State* L, const Box<ModelState>& model, FaceId face);
void push_group(lua_State* L, const std::string& name, int dim,
                std::size_t cells); ///< { name=, dim=, cells= }

/// The number at index 2, from 1 to `count`, as an index from 0; raises where it is none.
std::size_t check_number(lua_State* L, const char* call, std::size_t count);

/// Numbers of Lua count from 1, the kernel's from 0: the one place that knows.
inline lua_Integer to_lua(std::size_t index) { return static_cast<lua_Integer>(index) + 1; }
inline lua_Integer to_lua(Index index) { return static_cast<lua_Integer>(index) + 1; }
inline std::size_t from_lua(lua_Integer number) { return static_cast<std::size_t>(number - 1); }

// --- one a kernel folder: adds its functions to the module's table, which is on top of the stack ------

void bind_topology(lua_State* L);
void bind_open_volume(lua_State* L);
void bind_matching(lua_State* L);
void bind_closure(lua_State* L);
void bind_sweep(lua_State* L);
void bind_assembly(lua_State* L);
void bind_assembly_sweep(lua_State* L);
void bind_mesh(lua_State* L);
void bind_quality(lua_State* L);
void bind_io(lua_State* L);
void bind_cad(lua_State* L);
void bind_view(lua_State* L);

} // namespace lacuna::lua
