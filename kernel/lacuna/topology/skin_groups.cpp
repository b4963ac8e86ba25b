// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/skin_groups.h>

#include <lacuna/core/message.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace lacuna::topology {
namespace {

std::string lower(std::string text)
{
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// The name with a suffix that makes it unique.
std::string free_name(const std::string& name, const std::set<std::string>& taken)
{
    for (int number = 2;; ++number) {
        std::string numbered = formatted("{}_{}", name, number);
        if (!taken.contains(lower(numbered))) return numbered;
    }
}

/// Whether a face's name belongs to this face alone: it is neither the name of one of its solids nor a
/// number.
bool is_own_name(const Face& face)
{
    const auto begins = [&](const char* word) { return face.name.starts_with(word); };
    return face.origin == Origin::given && (!face.groups.empty() || face.regions.empty()) &&
           !begins("pid:") && !begins("region:") && !begins("physical_");
}

/// The name that all given faces share, if these have several roles; otherwise empty.
std::string name_of_all(const OpenVolume& volume)
{
    std::set<std::string> names;
    std::set<Role> roles;
    for (std::size_t f = 0; f < volume.model.faces.size(); ++f) {
        if (volume.model.faces[f].origin != Origin::given) continue;
        names.insert(volume.model.faces[f].name);
        roles.insert(volume.role[f]);
    }
    return names.size() == 1 && roles.size() > 1 ? *names.begin() : std::string();
}

} // namespace

std::vector<std::vector<std::string>> skin_groups(const OpenVolume& volume)
{
    std::vector<std::vector<std::string>> groups;
    std::set<std::string> generated{"source", "target"};
    for (std::size_t f = 0; f < volume.model.faces.size(); ++f) {
        const Face& face = volume.model.faces[f];
        const bool made = face.origin == Origin::made_void;
        const Role role = volume.role[f];
        std::vector<std::string>& of = groups.emplace_back();
        if (role != Role::wall)
            of.emplace_back((role == Role::source) != volume.turned_round ? "source" : "target");
        of.push_back(formatted("{}:{}", made ? "void" : role == Role::wall ? "wall" : "face", face.tag));
        generated.insert(of.begin(), of.end());
    }
    const std::string of_all = name_of_all(volume);
    std::set<std::string> taken = generated;
    for (const Face& face : volume.model.faces) taken.insert(lower(face.name));
    for (std::size_t f = 0; f < groups.size(); ++f) {
        const std::string& name = volume.model.faces[f].name;
        std::vector<std::string>& of = groups[f];
        if (volume.model.faces[f].origin == Origin::made_void)
            for (const std::string& set : volume.model.faces[f].groups)
                if (set != name && !generated.contains(lower(set))) of.push_back(set);
        if (name.empty() || std::ranges::find(of, name) != of.end()) continue;
        const bool its_own = std::ranges::find(of, lower(name)) != of.end();
        const bool first = name != of_all && is_own_name(volume.model.faces[f]);
        of.insert(first ? of.begin() : of.end(),
                  !its_own && generated.contains(lower(name)) ? free_name(name, taken) : name);
    }
    return groups;
}

bool is_void_group(std::string_view group)
{
    return group.starts_with("void:") || group.find(":void:") != std::string_view::npos;
}

bool is_role_group(std::string_view group)
{
    const std::string word = lower(std::string(group));
    if (word == "source" || word == "target") return true;
    const bool of_face = word.starts_with("wall:") || word.starts_with("void:") || word.starts_with("face:");
    return of_face && word.size() > 5 && word.find_first_not_of("0123456789", 5) == std::string::npos;
}

std::vector<std::string> groups_in_assembly(const std::string& volume, const std::vector<std::string>& groups)
{
    std::vector<std::string> all;
    for (const std::string& group : groups) {
        if (!is_role_group(group)) all.push_back(group);
        all.push_back(volume + ":" + group);
    }
    return all;
}

} // namespace lacuna::topology
