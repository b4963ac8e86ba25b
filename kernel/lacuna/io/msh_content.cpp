// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/msh_content.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/msh_shapes.h>
#include <lacuna/io/detail/sections.h>

#include <algorithm>
#include <limits>

namespace lacuna::io {
namespace {

constexpr std::size_t kLongestName = 127; // what Gmsh reads

/// A name the format can hold: it knows no escape for a quote, and a name ends with its line.
std::string printable(const std::string& name)
{
    std::string result;
    for (const char c : name) {
        if (c == '"')
            result += '\'';
        else if (static_cast<unsigned char>(c) < 32 || c == 127)
            result += ' ';
        else
            result += c;
    }
    return result;
}

/// The first bytes of a name, no UTF-8 character cut in two.
std::string shortened(const std::string& name, std::size_t bytes)
{
    if (name.size() <= bytes) return name;
    while (bytes > 0 && (static_cast<unsigned char>(name[bytes]) & 0xC0) == 0x80) --bytes;
    return name.substr(0, bytes);
}

} // namespace

int GroupTags::tag_of(int dimension, const std::string& group)
{
    const auto [at, fresh] = tags_.try_emplace({dimension, group}, next_);
    if (fresh) names_.push_back({dimension, next_++, unique_name(dimension, group)});
    return at->second;
}

void GroupTags::keep(int dimension, const std::string& group, int tag)
{
    if (tag < 1 || tag == std::numeric_limits<int>::max() || tags_.contains({dimension, group}) ||
        !kept_.insert({dimension, tag}).second)
        return;
    tags_[{dimension, group}] = tag;
    next_ = std::max(next_, tag + 1);
    if (group != unnamed_group(tag)) names_.push_back({dimension, tag, unique_name(dimension, group)});
}

std::vector<int> GroupTags::tags_of(int dimension, const std::vector<std::string>& groups)
{
    std::set<int> tags;
    for (const std::string& group : groups) tags.insert(tag_of(dimension, group));
    return {tags.begin(), tags.end()};
}

/// Two groups stay two, even where shortening makes their names alike.
std::string GroupTags::unique_name(int dimension, const std::string& group)
{
    const std::string whole = printable(group);
    std::string name = shortened(whole, kLongestName);
    for (int i = 2; !written_.insert({dimension, name}).second; ++i) {
        const std::string mark = "~" + std::to_string(i);
        name = shortened(whole, kLongestName - mark.size()) + mark;
    }
    return name;
}

void check_skin(const mesh::HexMesh& mesh)
{
    const auto layers = static_cast<std::size_t>(std::max(mesh.layers, 0));
    const auto valid = [&](Index patch) {
        return patch >= 0 && static_cast<std::size_t>(patch) < mesh.patches.size();
    };
    const bool sizes = mesh.source_patch.size() == mesh.quads.size() &&
                       mesh.target_patch.size() == mesh.quads.size() &&
                       mesh.wall_patch.size() == layers * mesh.rim.size();
    if (!sizes || !std::all_of(mesh.source_patch.begin(), mesh.source_patch.end(), valid) ||
        !std::all_of(mesh.target_patch.begin(), mesh.target_patch.end(), valid) ||
        !std::all_of(mesh.wall_patch.begin(), mesh.wall_patch.end(), valid))
        throw InvalidInput("io.no_patch",
                           "a quad of the skin belongs to no patch; every one needs one to be written");
    std::set<int> tags;
    for (const mesh::SkinPatch& patch : mesh.patches)
        if (patch.tag <= 0 || !tags.insert(patch.tag).second)
            throw InvalidInput("io.patch_tag", "the skin patch with tag " + std::to_string(patch.tag) +
                                                   " must have a positive tag of its own");
}

std::string msh_opening(const std::vector<PhysicalName>& names, const char* version, bool binary)
{
    std::string text = std::string("$MeshFormat\n") + version + (binary ? " 1 8\n" : " 0 8\n");
    if (binary) {
        put(text, int{1}); // tells the reader the order of bytes
        text += "\n";
    }
    text += "$EndMeshFormat\n$PhysicalNames\n" + std::to_string(names.size()) + "\n";
    for (const PhysicalName& name : names)
        text += std::to_string(name.dimension) + " " + std::to_string(name.tag) + " \"" + name.name + "\"\n";
    return text + "$EndPhysicalNames\n";
}

bool holds_all_groups(bool asked, double version, const OutputPath& path, const RunContext& context)
{
    if (!asked || version != 2.2) return asked;
    log_line(context, "note: " + path.text() +
                          ": MSH 2.2 holds one group an element, so groups = \"all\" is "
                          "not followed; version = 4.1 holds all");
    return false;
}

MshContent msh_content(const mesh::HexMesh& mesh, const NodeReader& nodes, bool all_groups)
{
    check_skin(mesh);
    MshContent content;
    std::vector<std::size_t> start(mesh.patches.size() + 1, 0);
    for (const std::vector<Index>* patches : {&mesh.source_patch, &mesh.target_patch, &mesh.wall_patch})
        for (const Index patch : *patches) ++start[index(patch) + 1];
    for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
    content.skin.resize(mesh.skin_count());
    std::vector<Eigen::AlignedBox3d> boxes(mesh.patches.size());
    std::vector<std::size_t> triangles(mesh.patches.size(), 0);
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (std::size_t i = 0; i < content.skin.size(); ++i) {
        const mesh::SkinQuad quad = skin_quad(mesh, i);
        const std::size_t patch = index(quad.patch);
        content.skin[next[patch]++] = static_cast<std::uint32_t>(i);
        if (mesh::is_triangle(quad.nodes)) ++triangles[patch];
        const auto extend = [&](Index node) { boxes[patch].extend(nodes.on_skin(node)); };
        if (mesh.middles.empty())
            std::for_each(quad.nodes.begin(), quad.nodes.end(), extend);
        else
            for (const Index node : skin_nodes(mesh, i).all()) extend(node);
    }

    GroupTags groups;
    const auto tags_of = [&](int dimension, std::vector<std::string> own, const std::string& otherwise) {
        if (own.empty()) own.push_back(otherwise);
        if (!all_groups) own.resize(1);
        return groups.tags_of(dimension, own);
    };
    for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
        if (start[p] == start[p + 1]) continue; // nothing to see of it
        MshSurface surface;
        surface.tag = mesh.patches[p].tag;
        surface.physical = tags_of(2, mesh.patches[p].groups, "surface:" + std::to_string(surface.tag));
        surface.box = boxes[p];
        surface.begin = start[p];
        surface.end = start[p + 1];
        surface.triangles = triangles[p];
        // A patch lies on the source, on the target or on walls: its triangles came last by themselves, but
        // where faces of both ends are one patch.
        if (triangles[p] > 0)
            std::stable_partition(
                content.skin.begin() + static_cast<std::ptrdiff_t>(start[p]),
                content.skin.begin() + static_cast<std::ptrdiff_t>(start[p + 1]),
                [&](std::uint32_t i) { return !mesh::is_triangle(skin_quad(mesh, i).nodes); });
        content.box.extend(surface.box); // the inside of a valid mesh reaches no further than its skin
        content.surfaces.push_back(std::move(surface));
    }
    content.volume_physical = tags_of(3, mesh.volume_groups, "volume");
    content.names = groups.take();
    return content;
}

} // namespace lacuna::io
