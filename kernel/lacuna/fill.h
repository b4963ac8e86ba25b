// SPDX-License-Identifier: MIT
#pragma once

// The entry point of the library: meshes the void that a set of faces bounds.
//
//   in   a model from `healing::split_facets()`, `io::load_facets()` or `cad::load_files()`
//   out  validated hexahedra and wedges with groups, regions and a report; the sealed volume
//
// fill() does the same as `model:open_volume{}` followed by `volume:sweep{}` in a recipe. Its stages can be
// called one by one, and each call of a recipe maps onto one of them:
//
//   open_volume, match, close, cut    fill/volume.h
//   sweep, assembly                   this header
//   tree, describe                    fill/describe.h
//   mesh.regions, groups, node …      fill/filled.h
//
// Stages take values and return values: a stage that fails or is cancelled changes nothing.
//
// Where to change things: finding and naming of roles, open.cpp; matching, closing and cutting, volume.cpp;
// alternative sweeps of one void, sweep.cpp; assembling pieces, volumes and meshes into one mesh,
// members.cpp.

#include <lacuna/fill/filled.h>
#include <lacuna/fill/volume.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::fill {

/// Options for sweeping one volume.
struct SweepRequest {
    sweep::SweepOptions options;
    /// With `options.layered`: whether the pieces of a volume that is cut may also compute their nodes only
    /// when they are written.
    bool layered_parts = true;
};

/// Options for all stages of `fill()`.
struct Request {
    RoleRequest roles;
    std::optional<matching::MatchOptions> match; ///< none: the volume is matched only if closing needs it
    std::optional<closure::CloseOptions> close;  ///< none: default closing shapes
    SweepRequest sweep;
    /// The meshes that the model was read from; order 2 reuses their mid-side nodes. `scale` converts their
    /// coordinates to those of the model.
    std::vector<std::shared_ptr<const io::Deck>> decks;
    double scale = 1;
    std::string unit; ///< unit of the model's lengths, a name that `io::metres_of()` knows; empty: none
};

/// Mesh the void that the faces of a model bound: open(), match(), close() and sweep().
/// @throw  the errors of these functions; the model is not modified.
Filled fill(const topology::Model& model, const Request& request = {}, const RunContext& context = {});

/// Close a volume if it is still open, and sweep it. A volume with steps or branches, or a full-turn volume,
/// is cut and its pieces are swept. If the user did not name the roles and the sweep fails, the alternative
/// sweeps of the same void (other sources and targets) are tried in turn; the report names the one used.
/// @return  `volumes` contains the one volume with the roles of the successful sweep, sealed unless it was
/// cut.
/// @throw NotSweepable, NotClosed  the reason why the first of these sweeps failed.
/// @throw InvalidInput  the errors of `sweep::sweep()`.
/// @throw Cancelled
Filled sweep(const Volume& volume, const SweepRequest& request = {}, const RunContext& context = {});

/// A member of an assembly: a volume with its options, or a finished mesh. Exactly one pointer is set.
struct Member {
    const Volume* volume = nullptr;
    const FilledVolume* mesh = nullptr;
    const FilledParts* parts = nullptr;
    sweep::SweepOptions options{}; ///< for `volume`
    /// Whether the boundary layers, and the intervals, were given for this volume alone. Then this volume
    /// must have the faces that these options name. Otherwise it is enough that one volume of the assembly
    /// has these faces.
    bool own_boundary_layers = false, own_intervals = false;
};

/// Contact pairs of an assembly: all faces of two regions that touch, or face each other within a gap.
struct ContactRequest {
    double gap = 0;   ///< for pairs of regions without an entry of their own [model length]
    bool tied = true; ///< whether these pairs are tied; otherwise they can slide and separate (contact)
    struct Pair {
        std::array<std::string, 2> regions;
        std::string name; ///< empty: "a_b", of the regions
        double gap = 0;
        bool tied = true;
    };
    std::vector<Pair> pairs;
};

/// Find the faces in contact by `sweep::faces_in_contact()`. The result has one entry for each pair of
/// regions in contact. The first overload takes the members of an assembly and closes them first. The second
/// takes a model. Its bodies are its regions or, if its faces have no regions, its parts that no edge
/// connects.
/// @throw InvalidInput "fill.contact_region"  a pair names an unknown region; "fill.contact_none"  the
///         regions of a pair have no faces within the gap; "fill.contact_name"  two pairs have one name;
///         "fill.contact_bodies"  the model has one body. Or the errors of `sweep::faces_in_contact()` and
///         `close()`.
std::vector<Contact> contacts(std::span<const Member> members, const ContactRequest& request,
                              const RunContext& context = {});
std::vector<Contact> contacts(const topology::Model& model, const ContactRequest& request,
                              const RunContext& context = {});

/// Close several volumes and sweep them, cut into pieces where needed, as one conforming mesh. Volumes that
/// are not glued do not share nodes with their neighbours. The faces of `contacts()` become groups NAME_slave
/// and NAME_master of the mesh. The slave is the side with the smaller faces or, if their areas are equal,
/// the side with the finer mesh.
/// @return  `volumes` holds the member volumes in their order. A volume that was left out or swept in pieces
///          is returned unchanged.
/// @throw InvalidInput "surface.no_such_face"  an option names a face that no volume has.
/// @throw  the errors of `contacts()`, `sweep::sweep_assembly()` and `closure::close()`.
Filled sweep(std::span<const Member> members, const RunContext& context = {},
             const ContactRequest& request = {});

/// A copy of a mesh, rotated, translated or mirrored. In a mirrored mesh the quads are turned over, so that
/// cells keep positive volumes. In an assembly, if a node of the copy differs from a node of another member
/// by rounding only, it is moved onto that node.
/// @param by    a motion or mirroring that keeps all lengths.
/// @param name  name of the copy's region. If the mesh has several regions, their names start with it. Empty:
///              regions keep their names.
/// @pre  the mesh stores its nodes.
/// @throw InvalidInput "fill.copy_mixed"  the mesh has tetrahedra.
FilledVolume moved(FilledVolume mesh, const Eigen::Affine3d& by, const std::string& name = {});
FilledParts moved(FilledParts mesh, const Eigen::Affine3d& by, const std::string& name = {});

struct PatternOptions {
    int count = 2;         ///< copies, the mesh itself included, >= 1
    bool numbered = false; ///< whether copies are regions `name_1`, `name_2` …; otherwise one region
};

/// A mesh and its copies as one mesh. Each copy is the previous one, moved by `step`.
///
/// Two faces that coincide become one inner face: they share their nodes and are removed from their groups.
/// Copies of a group form one group. It is enough to compare the first mesh with its copies, because any two
/// copies lie relative to each other like the first mesh and one of its copies.
/// @throw InvalidInput "fill.pattern_count"  the count is below 1; "fill.copy_mixed"  the mesh has
///         tetrahedra. Or the errors of `sweep::sweep_assembly()`: copies overlap, or share part of a face.
/// @throw NotSweepable "assembly.not_shared"  faces coincide, but their quads differ; "assembly.hanging_node"
///         a node of one copy lies on a side of another.
/// @throw Cancelled
/// @post  The copies of parts of order 1 do not store their nodes: see `hold_nodes()`.
/// @note  Memory: the source quads of each copy, and 24 bytes per node once nodes are stored.
FilledParts pattern(FilledParts mesh, const Eigen::Affine3d& step, const PatternOptions& options = {},
                    const RunContext& context = {});

/// Quads on faces, without layers.
struct FilledShell {
    io::Deck deck; ///< quads of 4, 8 or 9 nodes and kept triangles; one region for each face, or each name of
                   ///< faces
    double min_scaled_jacobian = 1, mean_scaled_jacobian = 1; ///< over the corners of all quads, each
                                                              ///< measured in its own plane
    double area = 0, face_area = 0; ///< area of the quads, and of the facets of the faces [model length²]
    std::vector<std::string> report;
};

/// Mesh faces of a model with quads that conform along common edges. Given quads are kept.
/// @param options  used: size, curvature, gap, quads, order, second_order
/// @throw InvalidInput "fill.no_faces"  there are no faces. Or the errors of `sweep::check()`.
/// @throw NotSweepable "sweep.folded_quads"  names the face and the place. Or the errors of
///         `surface::mesh_source()`.
/// @throw Cancelled
FilledShell quads(const topology::Model& model, const std::vector<FaceId>& faces,
                  const sweep::SweepOptions& options = {}, const RunContext& context = {});

/// The quads and triangles of a deck without solids, measured like the quads of `quads()`.
/// @throw  the errors of `io::read_facets()` and `quads()`
FilledShell measured_quads(const io::Deck& deck, const RunContext& context = {});

/// A model of the shell with one face for each region. The faces keep the quads. It can be shown or swept.
topology::Model model_of(const FilledShell& shell, const RunContext& context = {});

} // namespace lacuna::fill
