// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/msh.h>

#include <lacuna/core/message.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/topology/shared/skin_groups.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace lacuna::io {

using mesh::MeshView;

namespace {

constexpr std::size_t kLongestName = 127; // longest name that Gmsh allows

/// Make a name safe for the format. The format has no escape for quotes, and ends a name at the end of its
/// line.
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

/// The first bytes of a name, without splitting a UTF-8 character.
std::string shortened(const std::string& name, std::size_t bytes)
{
    if (name.size() <= bytes) return name;
    while (bytes > 0 && (static_cast<unsigned char>(name[bytes]) & 0xC0) == 0x80) --bytes;
    return name.substr(0, bytes);
}

/// Assigns each group a tag. Tags are unique over all dimensions, since some readers ignore the dimension.
class GroupTags {
public:
    /// Give a group the tag that it had in a file. If its name is `unnamed_group()`, the name is not written.
    /// If two groups of one dimension had the same tag, the first keeps it. Call before any other tag is
    /// assigned.
    void keep(int dimension, const std::string& group, int tag)
    {
        if (tag < 1 || tag == std::numeric_limits<int>::max() || tags_.contains({dimension, group}) ||
            !kept_.insert({dimension, tag}).second)
            return;
        tags_[{dimension, group}] = tag;
        next_ = std::max(next_, tag + 1);
        if (group != unnamed_group(tag)) names_.push_back({dimension, tag, unique_name(dimension, group)});
    }
    /// The tags of several groups, ascending.
    std::vector<int> tags_of(int dimension, const std::vector<std::string>& groups)
    {
        std::set<int> tags;
        for (const std::string& group : groups) {
            const auto [at, fresh] = tags_.try_emplace({dimension, group}, next_);
            if (fresh) names_.push_back({dimension, next_++, unique_name(dimension, group)});
            tags.insert(at->second);
        }
        return {tags.begin(), tags.end()};
    }
    std::vector<PhysicalName> take() { return std::move(names_); }

private:
    /// A name that no other group has: shortening may make names equal.
    std::string unique_name(int dimension, const std::string& group)
    {
        const std::string whole = printable(group);
        std::string name = shortened(whole, kLongestName);
        for (int i = 2; !written_.insert({dimension, name}).second; ++i) {
            const std::string mark = "~" + std::to_string(i);
            name = shortened(whole, kLongestName - mark.size()) + mark;
        }
        return name;
    }

    std::map<std::pair<int, std::string>, int> tags_;
    std::set<std::pair<int, std::string>> written_;
    std::vector<PhysicalName> names_;
    std::set<std::pair<int, int>> kept_; ///< dimension and tag
    int next_ = 1;
};

} // namespace

MshGroups msh_groups(const MeshView& view, const std::vector<char>& used_entities, bool all)
{
    MshGroups found;
    std::set<std::string> lost;
    GroupTags tags;
    for (const MeshView::GroupTag& kept : view.group_tags) tags.keep(kept.dimension, kept.group, kept.tag);
    std::set<std::pair<int, int>> used; // dimension and tag
    for (std::size_t e = 0; e < used_entities.size(); ++e) {
        const MeshView::Entity& entity = view.entities[e];
        std::vector<std::string> groups = entity.groups;
        if (groups.empty() && !view.unnamed.empty()) groups = {view.unnamed};
        if (!all && groups.size() > 1) {
            groups = {entity.groups[entity.main]};
            lost.insert(entity.groups.begin(), entity.groups.end());
            lost.erase(groups.front());
        }
        found.tags.push_back(used_entities[e] != 0 ? tags.tags_of(entity.dimension, groups)
                                                   : std::vector<int>());
        for (const int tag : found.tags.back()) used.emplace(entity.dimension, tag);
    }
    found.names = tags.take();
    std::erase_if(found.names, [&](const PhysicalName& name) {
        return !used.contains({name.dimension, name.tag});
    });
    std::erase_if(lost, [](const std::string& name) { // default groups of a swept mesh
        return name == "volume" || topology::is_role_group(name) ||
               topology::is_role_group(name.substr(name.find(':') + 1));
    });
    if (view.source.empty() || lost.empty()) return found;
    found.changed = formatted("each element is written in one group only: {} {} elements that are also in "
                              "others; groups = \"all\" keeps them",
                              full_list(lost, std::identity()), lost.size() > 1 ? "lack" : "lacks");
    return found;
}

} // namespace lacuna::io
