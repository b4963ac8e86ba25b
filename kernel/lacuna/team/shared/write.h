// SPDX-License-Identifier: MIT
#pragma once

// In: a mesh and a user's options for writing; out: files, written by one or several processes.
//
// Where to change things:
//   options, which writer is called  write.cpp
//   tasks of several processes       tasks.cpp

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/team.h>
#include <lacuna/fill.h>
#include <lacuna/io/load_facets.h>
#include <lacuna/io/mesh_file.h>
#include <lacuna/quality/shared/metrics.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::team {

/// Options of writing a mesh, as a user gives them. An option that the format of the file lacks is refused.
struct WriteRequest {
    std::optional<double> version; ///< of MSH: 4.1, the default, or 2.2
    std::optional<bool> binary;    ///< default: true
    std::optional<bool> all_groups;
    /// Cell fields. Default: the scaled Jacobian; in MSH 2.2 none, because some readers of this version
    /// (meshio 5) refuse files with $ElementData.
    std::optional<std::vector<quality::Metric>> quality;
    std::optional<bool> renumber;  ///< see `io::MergeOptions`, for several decks
    std::optional<int> partitions; ///< 0: one for each process
    int ghosts = 0;
    bool interfaces = false, orientation = false;
    std::string element{};
    int first_node = 0, first_cell = 0;
    bool gmsh_options = false; ///< also write a file with Gmsh's display options beside the mesh
    /// Models whose decks the mesh joins, the volume's first; empty: the mesh is written alone.
    std::vector<std::shared_ptr<const io::LoadedFiles>> with{};
    std::vector<std::string> without{}; ///< parts of these decks that the mesh replaces
};

/// Write a mesh. The file extension determines the format. If the format allows it, nodes that are not stored
/// are computed during writing. A process group, if there is one, shares this work.
/// @throw InvalidInput "lua.idle_option"  an option that the format or the kind of mesh lacks;
///        "lua.no_deck"  a model of `with` was not read from a mesh; "lua.mixed_write", "lua.split_write"  a
///        file that cannot hold tetrahedra or cells without thickness. Or the errors of `io::write_mesh()`,
///        `io::write_deck()` and `fill::joined_deck()`.
void write(const fill::FilledVolume& mesh, const WriteRequest& request, const io::OutputPath& path,
           const Crew* crew, const RunContext& context);
void write(fill::FilledParts& mesh, const WriteRequest& request, const io::OutputPath& path, const Crew* crew,
           const RunContext& context);
void write(const fill::FilledShell& mesh, const WriteRequest& request, const io::OutputPath& path,
           const RunContext& context);

/// Write the mesh of a sweep. @return  its report, with a line about nodes that were held in memory
std::vector<std::string> write_swept(fill::Filled& filled, const WriteRequest& request,
                                     const io::OutputPath& path, const Crew* crew, const RunContext& context);

/// Refuse formats that are not written a layer at a time, and options that the format lacks.
/// @throw InvalidInput "lua.not_layered", "lua.idle_option"
void require_layered(const WriteRequest& request, const io::OutputPath& path);
/// Refuse the option `interfaces`, which the mesh of one volume does not have.
/// @throw InvalidInput "lua.idle_option"
void refuse_interfaces(const WriteRequest& request);
/// Whether the mesh of an assembly is written a layer at a time. If so, its parts need not store their nodes.
bool may_be_layered_of_parts(const WriteRequest& request, const io::OutputPath& path);

} // namespace lacuna::team
