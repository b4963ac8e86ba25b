// SPDX-License-Identifier: MIT
#include "bindings/sweep_members.h"

#include "bindings/faces.h"
#include "bindings/full_turns.h"
#include "bindings/names.h"

#include <lacuna/cad/left_out.h>
#include <lacuna/closure/branches.h>
#include <lacuna/closure/piece_ends.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <type_traits>

namespace lacuna::lua {

namespace {

/// Give each word of those and the faces that it names.
template <class Options, class Do>
void for_each_names(Options& options, const Do& give)
{
    for (auto& layer : options.boundary_layers) give(kOfFaces[0], layer.walls);
    for (auto& interval : options.intervals)
        if (interval.of == surface::Interval::Of::wall) give(kOfFaces[1], interval.walls);
}

/// Options for many volumes name faces that one alone has: leave out those that this one has not.
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

constexpr const char* kWhereFacesAre = "; volume:tree() lists faces";

/// "; the nearest is …": of the names of faces of some volumes.
std::string nearest_face_name(const std::vector<ToMesh>& all, const std::string& wanted,
                              const SweepArguments* of)
{
    std::set<std::string> known;
    for (const ToMesh& one : all) {
        if (!one.volume || (of != nullptr && one.arguments != of)) continue;
        for (const topology::Face& face : one.volume->volume.model.faces) {
            if (!face.name.empty() && face.origin == topology::Origin::given) known.insert(face.name);
            known.insert(face.groups.begin(), face.groups.end());
        }
    }
    if (known.empty()) return kWhereFacesAre;
    std::vector<const char*> keys;
    keys.reserve(known.size());
    for (const std::string& name : known) keys.push_back(name.c_str());
    return "; the nearest is \"" + std::string(keys[nearest(wanted.c_str(), keys.data(), keys.size())]) +
           "\"";
}

/// Refuse a face that is named and that no volume has; of options of one volume, that one.
void check_known_faces(const std::vector<ToMesh>& all)
{
    std::set<std::tuple<const SweepArguments*, std::string, std::string>> seen;
    const auto check = [&](const ToMesh& by, const std::string& option, bool own, const std::string& what,
                           const auto& face) {
        const SweepArguments* const of = own ? by.arguments : nullptr;
        if (!seen.emplace(of, option, what).second) return;
        const bool known = std::ranges::any_of(all, [&](const ToMesh& one) {
            return one.volume && (of == nullptr || one.arguments == of) &&
                   surface::has_face(one.volume->volume, face);
        });
        if (known) return;
        std::string advice = kWhereFacesAre;
        if constexpr (std::is_same_v<std::decay_t<decltype(face)>, std::string>)
            advice = nearest_face_name(all, face, of);
        const std::string name = own ? by.arguments->name : "";
        throw InvalidInput("surface.no_such_face",
                           "sweep: option '" + option + "'" + (own ? " of " + name : "") + " names " + what +
                               ", which " + (own ? name : "no volume of the assembly") + " has" +
                               (own ? " not" : "") + advice);
    };
    for (const ToMesh& one : all) {
        if (!one.volume) continue;
        for_each_names(one.arguments->options,
                       [&](const std::string& option, const surface::FaceNames& names) {
                           const bool own = one.arguments->own.contains(option);
                           for (const int tag : names.tags)
                               check(one, option, own, "face " + std::to_string(tag), tag);
                           for (const std::string& name : names.names)
                               check(one, option, own, '"' + name + '"', name);
                       });
    }
}

/// A turn of fewer layers would have one of 120° and more, which no hexahedron spans.
constexpr int kLeastPerTurn = 4;

/// A piece of a full turn has its share of the layers asked for.
void share_layers(const VolumeState& state, sweep::LayerSpec& layers)
{
    const double share = state.turn_to - state.turn_from;
    if (share == 1) return;
    if (!layers.heights.empty() || layers.bias != 1)
        throw InvalidInput(
            "sweep.full_turn_layers",
            "layers of a full turn have no first and no last: give their count alone, or "
            "sweep the pieces that volume:cut() gives with 'heights' or a 'bias' of their own");
    if (layers.count == 0) return;
    if (layers.count < kLeastPerTurn)
        throw InvalidInput("sweep.full_turn_layers", "a full turn needs " + std::to_string(kLeastPerTurn) +
                                                         " layers at least; asked for are " +
                                                         std::to_string(layers.count));
    const auto until = [&](double turn) { return static_cast<int>(std::lround(turn * layers.count)); };
    layers.count = std::max(1, until(state.turn_to) - until(state.turn_from));
}

} // namespace

void add_members(std::vector<ToMesh>& members, const Box<VolumeState>& volume, const std::string& name,
                 const std::string& whole, const SweepArguments& arguments, const RunContext& context)
{
    if (!closure::has_pieces(volume->volume, context)) {
        members.push_back({volume, &arguments, nullptr, false});
        return;
    }
    int number = 0;
    for (closure::StepPiece& piece : closure::cut_into_pieces(volume->volume, context)) {
        members.push_back({std::make_shared<VolumeState>(), &arguments, nullptr, false});
        VolumeState& own = *members.back().volume;
        own.volume = std::move(piece.volume);
        own.level = piece.level;
        own.turn_from = piece.turn_from;
        own.turn_to = piece.turn_to;
        if (piece.turn_to - piece.turn_from < 1) own.turn_of = name;
        own.name = name + "_" + std::to_string(++number);
        own.material = volume->material;
        members.back().piece_of = volume;
        members.back().whole = whole;
    }
}

void tell_left_out(const VolumeState& state, std::vector<std::string>& report)
{
    for (const std::string& missing : cad::left_out_in_words(state.volume))
        report.push_back("closed: " + missing);
}

std::shared_ptr<AssemblyMeshState> sweep_members(const std::vector<ToMesh>& all,
                                                 std::vector<sweep::LeftOut> left_out, bool alone,
                                                 const RunContext& context)
{
    std::vector<sweep::AssemblyMember> members;
    std::vector<std::string> materials;
    std::vector<std::unique_ptr<Busy>> busy;
    auto mesh = std::make_shared<AssemblyMeshState>();
    for (std::size_t m = 0; m < all.size(); ++m) {
        const std::string number = "volume_" + std::to_string(m + 1);
        if (const FixedMember* fixed = all[m].fixed.get()) {
            const mesh::HexMesh& own = fixed->swept.mesh;
            materials.push_back(fixed->material);
            members.push_back(
                {&fixed->skin.volume, {}, fixed->region.empty() ? number : fixed->region, &fixed->swept, {}});
            members.back().whole = fixed->whole;
            members.back().turn_of = fixed->turn_of;
            members.back().options.order = own.order();
            members.back().options.second_order.serendipity = own.order() > 1 && !own.middles.full;
            continue;
        }
        VolumeState& state = *all[m].volume;
        busy.push_back(std::make_unique<Busy>(state, "sweep"));
        const std::string region = state.name.empty() ? number : state.name;
        const auto close = [&] {
            close_volume(state, {}, context);
            closure::check_ends(state.volume, region);
        };
        if (all[m].left_out || !do_or_leave_out(left_out, region, *all[m].arguments, close)) continue;
        materials.push_back(state.material);
        members.push_back({&state.volume, all[m].arguments->options, region, nullptr, state.turn_of});
        members.back().whole = all[m].whole;
        members.back().piece_of = all[m].piece_of ? &all[m].piece_of->volume : nullptr;
        members.back().alone = alone;
        if (state.level > 0) members.back().options.layers = {};
        share_layers(state, members.back().options.layers);
    }
    check_known_faces(all);
    for (sweep::AssemblyMember& member : members) keep_known_faces(member);
    if (members.empty() && !left_out.empty())
        throw NotSweepable(left_out.front().code, left_out.front().message);
    mesh->swept = sweep::sweep_assembly(members, context);
    std::vector<std::string> turns; // of each part
    for (const std::size_t m : mesh->swept.member) {
        turns.push_back(members[m].turn_of);
        mesh->regions.push_back(members[m].region);
        mesh->materials.push_back(materials[m]);
    }
    join_turns(*mesh, turns);
    for (const ToMesh& one : all)
        if (one.volume && !one.left_out) tell_left_out(*one.volume, mesh->swept.report);
    for (const sweep::LeftOut& out : left_out)
        mesh->swept.report.push_back("left out: " + out.message + " [" + out.code + "]");
    mesh->left_out = std::move(left_out);
    mesh->left_out.insert(mesh->left_out.end(), mesh->swept.left_out.begin(), mesh->swept.left_out.end());
    return mesh;
}

} // namespace lacuna::lua
