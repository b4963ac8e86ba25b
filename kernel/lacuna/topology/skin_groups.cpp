// SPDX-License-Identifier: MIT
#include <lacuna/topology/skin_groups.h>

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

/// What a face's name becomes where it is another group's.
std::string free_name(const std::string& name, const std::set<std::string>& taken)
{
    int number = 2;
    while (taken.contains(lower(name + "_" + std::to_string(number)))) ++number;
    return name + "_" + std::to_string(number);
}

} // namespace

std::vector<std::vector<std::string>> skin_groups(const OpenVolume& volume)
{
    std::vector<std::vector<std::string>> groups;
    std::set<std::string> generated{"source", "target"};
    for (std::size_t f = 0; f < volume.model.faces.size(); ++f) {
        const Face& face = volume.model.faces[f];
        const bool made = face.origin == Origin::made_void;
        const std::string own = (made ? "void:" : "wall:") + std::to_string(face.tag);
        std::vector<std::string>& of = groups.emplace_back();
        if (volume.role[f] == Role::wall) {
            of.push_back(own);
        } else {
            of.emplace_back((volume.role[f] == Role::source) != volume.turned_round ? "source" : "target");
            if (made) of.push_back(own);
        }
        generated.insert(of.begin(), of.end());
    }
    std::set<std::string> taken = generated;
    for (const Face& face : volume.model.faces) taken.insert(lower(face.name));
    for (std::size_t f = 0; f < groups.size(); ++f) {
        const std::string& name = volume.model.faces[f].name;
        std::vector<std::string>& of = groups[f];
        if (name.empty() || std::ranges::find(of, name) != of.end()) continue;
        const bool its_own = std::ranges::find(of, lower(name)) != of.end();
        of.push_back(!its_own && generated.contains(lower(name)) ? free_name(name, taken) : name);
    }
    return groups;
}

} // namespace lacuna::topology
