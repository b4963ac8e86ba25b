// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/hex_mesh.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// What an MSH file says beside nodes and cells: entities and physical groups. Internal to this folder.
namespace lacuna::io {

struct PhysicalName {
    int dimension;
    int tag;
    std::string name;
};

/// Gives each group one tag. Tags are unique over all dimensions, for readers that know a tag alone.
class GroupTags {
public:
    /// Give a group the tag it has in a file; its name is not written where that is `unnamed_group()`. Of
    /// two groups that want the same tag in one dimension the first has it. Before any other is asked for.
    void keep(int dimension, const std::string& group, int tag);
    int tag_of(int dimension, const std::string& group);
    /// Of several groups, rising.
    std::vector<int> tags_of(int dimension, const std::vector<std::string>& groups);
    std::vector<PhysicalName> take() { return std::move(names_); }

private:
    std::string unique_name(int dimension, const std::string& group);

    std::map<std::pair<int, std::string>, int> tags_;
    std::set<std::pair<int, std::string>> written_;
    std::vector<PhysicalName> names_;
    std::set<std::pair<int, int>> kept_; ///< dimensions and tags
    int next_ = 1;
};

/// A surface entity: a skin patch that has quads or triangles.
struct MshSurface {
    int tag = 0;
    std::vector<int> physical; ///< tags of its groups, rising
    Eigen::AlignedBox3d box;
    std::size_t begin = 0, end = 0; ///< its quads and triangles in `MshContent::skin`
    std::size_t triangles = 0;      ///< the last of them
};

struct MshContent {
    std::vector<PhysicalName> names;
    std::vector<MshSurface> surfaces;
    std::vector<int> volume_physical;
    Eigen::AlignedBox3d box;
    std::vector<std::uint32_t> skin; ///< numbers of all skin quads, patch after patch, triangles last in each
};

inline constexpr int kVolumeTag = 1;

/// Header and names, which are text in every version.
std::string msh_opening(const std::vector<PhysicalName>& names, const char* version, bool binary);

/// Whether a file is to hold all groups: not of version 2.2, and the log says so where they were asked for.
bool holds_all_groups(bool asked, double version, const OutputPath& path, const RunContext& context);

/// @throw InvalidInput  a skin quad belongs to no patch, or two patches share a tag.
void check_skin(const mesh::HexMesh& mesh);

/// @param all_groups  entities are in all their groups, else in one each.
/// @throw InvalidInput  as `check_skin()`.
MshContent msh_content(const mesh::HexMesh& mesh, const NodeReader& nodes, bool all_groups);

} // namespace lacuna::io
