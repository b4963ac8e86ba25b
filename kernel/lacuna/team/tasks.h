// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/team.h>
#include <lacuna/io/partition.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/quality/metrics.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/layer_plan.h>

#include <string>
#include <string_view>
#include <vector>

/// What a crew does together: each the layers that are its share. Nothing that is sent grows with the cells.
namespace lacuna::team {

/// How a layered mesh is written.
struct LayeredFile {
    bool binary = true;
    double version = 4.1;                   ///< of .msh
    std::vector<quality::Metric> quality{}; ///< fields of cells; decks have none
    std::string material{};                 ///< of decks
    io::PartitionOptions partition{};       ///< of .msh and .pvtu
    bool all_groups = false;                ///< of .msh: as `io::MeshFileOptions::all_groups`
};

/// Write a mesh whose nodes are made as they are written, in the format that the path's ending says: with a
/// crew, where there is one.
/// @param plan  what the layers are placed by.
/// @pre  the format is streamed
/// @throw  as `io::write_mesh()`; TeamFailed
void write_layered(const mesh::LayeredMesh& layered, const sweep::LayerPlan& plan, const io::OutputPath& path,
                   const LayeredFile& file, const Crew* crew, const RunContext& context);

/// Write the mesh of an assembly with the bytes of `io::write_deck()` of its deck: with a crew, where there
/// is one and no part holds its nodes.
/// @pre  parts of the format are streamed; `file` has no parts, fields or material
/// @throw  as `write_layered()`
void write_parts(const sweep::SweptAssembly& assembly, const io::OutputPath& path, const LayeredFile& file,
                 const Crew* crew, const RunContext& context);

/// Do one's part of a task that a crew was called to.
/// @throw  what went wrong; all of the team know of it.
void help(std::string_view task, const std::string& bytes, const Team& team, const RunContext& context);

} // namespace lacuna::team
