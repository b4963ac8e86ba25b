// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/parts.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/nearest_word.h>
#include <lacuna/surface/shared/boundary_layers.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <type_traits>
#include <utility>

namespace lacuna::fill {

namespace {

/// Call `give(name, faces)` for each option that names faces.
template <class Options, class Do>
void for_each_names(Options& options, const Do& give)
{
    for (auto& layer : options.boundary_layers) give("boundary_layers", layer.walls);
    for (auto& interval : options.intervals)
        if (interval.of == surface::Interval::Of::wall) give("intervals", interval.walls);
}

/// The most similar face name among the given volumes; empty if no face has a name.
std::string nearest_face_name(const std::vector<Part>& all, const std::string& wanted, const Member* of)
{
    std::set<std::string> known;
    for (const Part& one : all) {
        if (one.asked == nullptr || (of != nullptr && one.asked != of)) continue;
        for (const topology::Face& face : one.volume.volume.model.faces) {
            if (!face.name.empty() && face.origin == topology::Origin::given) known.insert(face.name);
            known.insert(face.groups.begin(), face.groups.end());
        }
    }
    if (known.empty()) return {};
    std::vector<const char*> keys;
    keys.reserve(known.size());
    for (const std::string& name : known) keys.push_back(name.c_str());
    return keys[nearest_word(wanted.c_str(), keys)];
}

} // namespace

void keep_known_faces(sweep::AssemblyMember& member)
{
    for_each_names(member.options, [&](const char*, surface::FaceNames& names) {
        std::erase_if(names.tags, [&](int tag) { return !surface::has_face(*member.volume, tag); });
        std::erase_if(names.names,
                      [&](const auto& name) { return !surface::has_face(*member.volume, name); });
    });
    const auto is_empty = [](const surface::FaceNames& names) {
        return names.tags.empty() && names.names.empty();
    };
    std::erase_if(member.options.boundary_layers, [&](auto& layer) { return is_empty(layer.walls); });
    std::erase_if(member.options.intervals, [&](auto& interval) {
        return interval.of == surface::Interval::Of::wall && is_empty(interval.walls);
    });
}

void keep_known_pairs(std::vector<sweep::AssemblyMember>& members)
{
    const auto has_face = [&](const surface::FaceNames& names) {
        return std::ranges::any_of(members, [&](const sweep::AssemblyMember& member) {
            const auto known = [&](const auto& face) { return surface::has_face(*member.volume, face); };
            return std::ranges::any_of(names.tags, known) || std::ranges::any_of(names.names, known);
        });
    };
    for (sweep::AssemblyMember& member : members)
        std::erase_if(member.options.periodic, [&](const surface::PeriodicPair& pair) {
            return !has_face(pair.a) && !has_face(pair.b);
        });
}

void check_known_faces(const std::vector<Part>& all)
{
    std::set<std::tuple<const Member*, std::string, std::string>> seen;
    const auto check = [&](const Part& by, const std::string& option, bool own, const Argument& what,
                           const auto& face) {
        const Member* const of = own ? by.asked : nullptr;
        if (!seen.emplace(of, option, formatted("{}", what)).second) return;
        const bool known = std::ranges::any_of(all, [&](const Part& one) {
            return one.asked != nullptr && (of == nullptr || one.asked == of) &&
                   surface::has_face(one.volume.volume, face);
        });
        if (known) return;
        Message message("surface.no_such_face", "sweep: option '{}'{} names {}, which {}", option,
                        own ? " of " + by.asked_name : "", what,
                        own ? by.asked_name + " does not have" : "no volume of the assembly has");
        std::string nearest;
        if constexpr (std::is_same_v<std::decay_t<decltype(face)>, std::string>)
            nearest = nearest_face_name(all, face, of);
        if (nearest.empty()) throw InvalidInput(std::move(message).remedy("volume:tree() lists faces"));
        throw InvalidInput(std::move(message).remedy(
            "the nearest is \"{}\"{}", nearest, option == "periodic" ? "" : "; \"walls\" names all walls"));
    };
    for (const Part& one : all) {
        if (one.asked == nullptr) continue;
        for_each_names(one.asked->options, [&](const std::string& option, const surface::FaceNames& names) {
            const bool own = option == "intervals" ? one.asked->own_intervals
                                                   : one.asked->own_boundary_layers;
            for (const int tag : names.tags) check(one, option, own, NamedEntity{"face", tag}, tag);
            for (const std::string& name : names.names) check(one, option, own, '"' + name + '"', name);
        });
        for (const surface::PeriodicPair& pair : one.asked->options.periodic)
            for (const surface::FaceNames* names : {&pair.a, &pair.b}) {
                for (const int tag : names->tags)
                    check(one, "periodic", false, NamedEntity{"face", tag}, tag);
                for (const std::string& name : names->names)
                    check(one, "periodic", false, '"' + name + '"', name);
            }
    }
}

} // namespace lacuna::fill
