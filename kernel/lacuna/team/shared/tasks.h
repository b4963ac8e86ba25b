// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/team.h>
#include <lacuna/io/partition.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/quality/shared/metrics.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/shared/layer_plan.h>

#include <string>
#include <string_view>
#include <vector>

/// Tasks of a process group, in which each process works on its own layers. The amount of data that the
/// processes exchange does not depend on the number of cells.
namespace lacuna::team {

/// Options of writing a layered mesh.
struct LayeredFile {
    bool binary = true;
    double version = 4.1;                   ///< version of the MSH format
    std::vector<quality::Metric> quality{}; ///< written as cell fields; not for decks
    std::string material{};                 ///< material name, for decks
    io::PartitionOptions partition{};       ///< for .msh and .pvtu
    bool all_groups = false;                ///< for .msh, see `io::MeshFileOptions::all_groups`
    std::string unit{};                     ///< see `io::MeshFileOptions::unit`
};

/// Write a mesh whose nodes are computed during writing. The file extension determines the format. A process
/// group, if there is one, shares the work.
/// @param plan  computes the nodes of each layer.
/// @pre  the format is streamed
/// @throw  as `io::write_mesh()`; TeamFailed
void write_layered(const mesh::LayeredMesh& layered, const sweep::LayerPlan& plan, const io::OutputPath& path,
                   const LayeredFile& file, const Crew* crew, const RunContext& context);

/// Write the mesh of an assembly. A process group, if there is one, shares the work; if a part stores its
/// nodes, this process works alone.
/// @pre  the format can stream parts; `file` has no partition, fields or material
/// @throw  as `write_layered()`
void write_parts(const sweep::SweptAssembly& assembly, const io::OutputPath& path, const LayeredFile& file,
                 const Crew* crew, const RunContext& context);

/// Do this process's share of a task that rank 0 started.
/// @throw  the error that stopped the task; all processes of the team receive it.
void help(std::string_view task, const std::string& bytes, const Team& team, const RunContext& context);

} // namespace lacuna::team
