// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/members.h>

#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/branches.h>
#include <lacuna/closure/shared/piece_ends.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/fill/describe.h>
#include <lacuna/fill/detail/contacts.h>
#include <lacuna/fill/detail/edge_sets.h>
#include <lacuna/fill/detail/parts.h>
#include <lacuna/fill/detail/tets.h>
#include <lacuna/io/shared/units.h>
#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/walls.h>
#include <lacuna/sweep/shared/imprinted.h>
#include <lacuna/sweep/shared/turn_at_axis.h>
#include <lacuna/topology/shared/left_out.h>
#include <lacuna/topology/shared/split_edge.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace lacuna::fill {

namespace {

// --- full turns -------------------------------------------------------------------------------------------

/// Give a piece of a full turn its share of the requested layers.
void share_layers(const Volume& volume, sweep::LayerSpec& layers)
{
    const double share = volume.turn_to - volume.turn_from;
    if (share == 1) return;
    if (!layers.heights.empty() || layers.bias != 1)
        throw InvalidInput(
            Message("sweep.full_turn_layers", "a full turn has no first and no last layer")
                .remedy("give only their number, or sweep the pieces that volume:cut() returns, each with "
                        "its 'heights' or 'bias'"));
    if (layers.count == 0) return;
    if (layers.count < sweep::kLeastPerTurn)
        throw InvalidInput("sweep.full_turn_layers",
                           "a full turn needs at least {} layers, but {} are requested",
                           needed(sweep::kLeastPerTurn), found(layers.count));
    const auto until = [&](double turn) { return static_cast<int>(std::lround(turn * layers.count)); };
    layers.count = std::max(1, until(volume.turn_to) - until(volume.turn_from));
}

// --- parts ------------------------------------------------------------------------------------------------

/// Whether a piece is bounded by six four-sided faces without a mesh, with straight edges.
bool is_block(const closure::StepPiece& piece)
{
    const topology::Model& model = piece.volume.model;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const std::vector<Index>& points = model.edges[e].points;
        const double chord = (model.at(points.back()) - model.at(points.front())).norm();
        if (topology::edge_length(model, EdgeId(e)) > chord + model.tolerance) return false;
    }
    return model.faces.size() == 6 && std::ranges::all_of(model.faces, [](const topology::Face& face) {
               return face.loops.size() == 1 && face.loops.front().uses.size() == 4 &&
                      face.given_quads.empty();
           });
}

/// Add the pieces of a volume. A piece without ends can only be filled with tetrahedra.
/// @param name  region name, to which a number is appended.
/// @param whole  group of the cells of all pieces.
void add_pieces(std::vector<Part>& parts, const Member& asked, const std::string& name,
                const std::string& whole, std::vector<closure::StepPiece> pieces)
{
    int number = 0;
    const bool blocks = pieces.size() > 1 && std::ranges::all_of(pieces, is_block);
    for (closure::StepPiece& piece : pieces) {
        const double from = piece.turn_from, to = piece.turn_to;
        Part& part = parts.emplace_back(Part{&asked, name, {}, nullptr});
        part.volume = piece_of(*asked.volume, std::move(piece), formatted("{}_{}", name, ++number));
        part.volume.turn_from = from;
        part.volume.turn_to = to;
        if (to - from < 1) part.volume.turn_of = name;
        part.piece_of = asked.volume;
        part.whole = whole;
        part.is_block = blocks;
    }
}

/// Whether layers and columns can follow the walls of a sealed volume.
struct Followed {
    std::size_t stops = std::numeric_limits<std::size_t>::max(); ///< `surface::check_wall_edges()`
    std::optional<Message> refused;                              ///< why they cannot
};

Followed follow_walls(const topology::OpenVolume& volume, const RunContext& context)
{
    auto stops = attempt<NotSweepable>([&] { return surface::check_wall_edges(volume, context); });
    if (stops) return {*stops, std::nullopt};
    return {.refused = std::move(stops.why)};
}

/// Why no sweep of a sealed volume can follow its walls; empty if one can.
std::optional<Message> why_no_sweep(const Volume& sealed, const RunContext& context)
{
    const std::size_t ways = sealed.others ? sealed.others->ways.size() : 0;
    for (std::size_t k = 0; k < ways; ++k)
        if (!follow_walls(with_other_sweep(sealed, k).volume, context).refused) return std::nullopt;
    return follow_walls(sealed.volume, context).refused;
}

/// Add a volume, or the pieces into which it has to be cut. A volume without ends that cannot be cut is left
/// to the fallback.
/// @param name, whole see add_pieces()
/// @param meshes  whether the volume is to be meshed; if not, only its own steps are cut
void add_parts(std::vector<Part>& parts, const Member& asked, const std::string& name,
               const std::string& whole, bool meshes, const RunContext& context)
{
    Volume volume = *asked.volume;
    const bool cuts = may_cut(volume, asked.options.fallback == sweep::Fallback::mixed);
    std::optional<Message> no_ends = volume.no_roles, why = no_ends;
    std::vector<closure::StepPiece> pieces;
    const auto tried = attempt([&] {
        if (no_ends) return;
        if (has_pieces(volume, context)) {
            pieces = cut_into_pieces(volume, context);
            for (const closure::StepPiece& piece : pieces)
                if (meshes && cuts && !why) why = follow_walls(piece.volume, context).refused;
        } else if (cuts && meshes && !volume.along && !volume.volume.full_turn) {
            volume = close(volume, {}, context);
            why = why_no_sweep(volume, context);
        }
    });
    if (!tried) {
        if (!cuts) tried.raise();
        why = no_ends = tried.why;
    }
    if (why && meshes) {
        std::vector<closure::StepPiece> swept = swept_pieces(volume, *why, asked.options, context);
        if (!swept.empty()) {
            log_line(context, formatted("note: {} is cut into {} pieces, because {} [{}]", name, swept.size(),
                                        why->parts().text, why->code()));
            pieces = std::move(swept);
        }
    }
    if (!pieces.empty()) return add_pieces(parts, asked, name, whole, std::move(pieces));
    parts.push_back({&asked, name, std::move(volume), nullptr});
    if (no_ends) parts.back().volume.no_roles = std::move(no_ends);
}

/// Run `what` on a volume of an assembly. If `what` fails and the volume may be left out, add the volume to
/// `left_out`.
/// @return  whether `what` succeeded.
template <class Do>
bool do_or_leave_out(std::vector<sweep::LeftOut>& left_out, const std::string& region, const Member& member,
                     const Do& what)
{
    const auto done = attempt(what);
    if (done) return true;
    if (member.options.fallback != sweep::Fallback::leave_out) done.raise();
    left_out.push_back({region, done.why->about(region)});
    return false;
}

sweep::AssemblyMember member_of(const KeptMesh& kept, const std::string& number)
{
    const mesh::HexMesh& own = kept.swept.mesh;
    sweep::AssemblyMember member{
        &kept.skin.volume, {}, kept.region.empty() ? number : kept.region, &kept.swept, kept.turn_of};
    member.whole = kept.whole;
    member.options.order = own.order();
    member.options.second_order.serendipity = own.order() > 1 && !own.middles.full;
    return member;
}

/// The number of layers that the user requested applies only to pieces that run from source to target. The
/// other pieces get the remaining layers.
sweep::AssemblyMember member_of(const Part& part, const std::string& region, bool alone)
{
    const Volume& volume = part.volume;
    sweep::AssemblyMember member{&volume.volume, part.asked->options, region, nullptr, volume.turn_of};
    member.whole = part.whole;
    member.glue = part.glue;
    member.piece_of = part.piece_of != nullptr ? &part.piece_of->volume : nullptr;
    member.alone = alone;
    if (volume.level > 0) member.options.layers = {};
    // An end of one block is a wall of another one, where it is a grid.
    if (part.is_block && member.options.quads == sweep::Quads::automatic)
        member.options.quads = sweep::Quads::mapped;
    share_layers(volume, member.options.layers);
    keep_given_middles(volume, member.options.second_order);
    return member;
}

/// The parts of an assembly, ready to be meshed.
struct Prepared {
    std::vector<sweep::AssemblyMember> members;
    std::vector<std::string> materials; ///< for each member, its material
    std::vector<Part*> parts;
    std::vector<sweep::LeftOut> left_out;
};

/// The highest tag of a model's void faces, or `least` if that is higher.
int last_void_face(const topology::Model& model, int least)
{
    return topology::next_tag(model.faces, topology::Origin::made_void, 0, least + 1) - 1;
}

/// Close the volumes. A volume without ends to sweep between can only be filled with tetrahedra.
Prepared prepare(std::vector<Part>& all, std::vector<sweep::LeftOut> left_out, bool alone,
                 const RunContext& context)
{
    Prepared ready;
    ready.left_out = std::move(left_out);
    // Void faces that close pieces of one volume are groups of one mesh, so their tags differ.
    std::map<const Member*, int> last;
    for (const Part& part : all)
        if (!part.kept) last[part.asked] = last_void_face(part.volume.volume.model, last[part.asked]);
    for (std::size_t p = 0; p < all.size(); ++p) {
        Part& part = all[p];
        const std::string number = formatted("volume_{}", p + 1);
        if (part.kept) {
            ready.materials.push_back(part.kept->material);
            ready.members.push_back(member_of(*part.kept, number));
            ready.parts.push_back(&part);
            continue;
        }
        const bool mixed = part.asked->options.fallback == sweep::Fallback::mixed;
        const std::string region = part.volume.name.empty() ? number : part.volume.name;
        const auto close_part = [&] {
            if (!mixed) {
                if (part.volume.no_roles)
                    throw InvalidInput(with_tets_as_remedy(*part.volume.no_roles, part.asked->options));
                part.volume = close_to_sweep(part.volume, region, context);
            } else if (!part.volume.volume.full_turn) { // a full turn needs no closing
                auto closed = attempt([&] { return close(part.volume, {}, context); });
                if (closed)
                    part.volume = std::move(*closed);
                else if (topology::free_edges(part.volume.volume).empty()) // tetrahedra need no ends
                    part.volume.no_roles = closed.why;
                else
                    closed.raise();
            }
        };
        topology::Model& model = part.volume.volume.model;
        if (last[part.asked] > last_void_face(model, 0)) {
            topology::ModelBuilder numbered(std::move(model));
            numbered.last_void_face = last[part.asked];
            model = std::move(numbered).finish();
        }
        if (part.left_out || !do_or_leave_out(ready.left_out, region, *part.asked, close_part)) continue;
        last[part.asked] = last_void_face(part.volume.volume.model, last[part.asked]);
        ready.materials.push_back(part.volume.material);
        ready.members.push_back(member_of(part, region, alone));
        ready.members.back().unswept = mixed &&
                                       (part.volume.no_roles || !closure::has_ends(part.volume.volume));
        ready.parts.push_back(&part);
    }
    return ready;
}

/// How badly a member's sweep suits its walls, ends and neighbours; lower is better. First: the number of
/// vertices inside its walls at which rows and columns have to meet, of which there are too many if layers
/// cannot follow the walls' edges. Second: the number of faces, beyond one, of the end that has fewer: edges
/// of both ends have to be imprinted on each other. Third: the number of shared faces that are an end of one
/// volume and a wall of the other.
using Unsuited = std::array<std::size_t, 3>;

Unsuited unsuited(const sweep::ImprintedVolumes& split, std::size_t member, const RunContext& context)
{
    const auto is_wall = [&](std::size_t m, FaceId face) {
        return split.volumes[m].role[face.index()] == topology::Role::wall;
    };
    const auto unlike = std::ranges::count_if(split.shared, [&](const sweep::SharedFace& face) {
        return (face.a == member || face.b == member) &&
               is_wall(face.a, face.face_a) != is_wall(face.b, face.face_b);
    });
    const topology::OpenVolume& volume = split.volumes[member];
    const std::size_t fewer = std::min(volume.faces(topology::Role::source).size(),
                                       volume.faces(topology::Role::target).size());
    return {follow_walls(volume, context).stops, std::max<std::size_t>(fewer, 1) - 1,
            static_cast<std::size_t>(unlike)};
}

/// For each volume whose ends the user did not name, choose the sweep that suits it best. Examples: a board
/// on standoffs is swept from the side on which the standoffs are; a square pin between two plates is swept
/// from plate to plate.
void choose_sweeps(Prepared& ready, const RunContext& context)
{
    const auto may_choose = [&](std::size_t m) {
        const Volume& volume = ready.parts[m]->volume;
        return volume.others && !volume.no_roles && !ready.members[m].unswept;
    };
    std::vector<std::size_t> doubtful;
    for (std::size_t m = 0; m < ready.members.size(); ++m)
        if (may_choose(m)) doubtful.push_back(m);
    if (doubtful.empty()) return;
    const sweep::ImprintedVolumes first = sweep::imprinted(ready.members, context);
    std::vector<std::set<std::size_t>> beside(ready.members.size());
    for (const sweep::SharedFace& face : first.shared) {
        beside[face.a].insert(face.b);
        beside[face.b].insert(face.a);
    }
    std::erase_if(doubtful, [&](std::size_t m) { return unsuited(first, m, context) == Unsuited{}; });
    std::set<std::size_t> changed; // each volume changes once, so that the choice ends
    for (std::size_t i = 0; i < doubtful.size(); ++i) {
        const std::size_t m = doubtful[i];
        sweep::AssemblyMember& member = ready.members[m];
        Part& part = *ready.parts[m];
        if (!may_choose(m) || changed.contains(m)) continue;
        const auto against = [&](const Volume& volume) {
            std::vector<sweep::AssemblyMember> near{member};
            near.front().volume = &volume.volume;
            for (const std::size_t other : beside[m]) near.push_back(ready.members[other]);
            return unsuited(sweep::imprinted(near, context), 0, context);
        };
        const Volume own = part.volume;
        Unsuited least = against(own); // the roles of other volumes may have changed
        for (std::size_t k = 0; k < own.others->ways.size(); ++k) {
            Volume other = with_other_sweep(own, k);
            const Unsuited now = against(other);
            if (now >= least) continue;
            least = now;
            part.volume = std::move(other);
            changed.insert(m);
        }
        member.volume = &part.volume.volume;
        if (!changed.contains(m)) continue;
        doubtful.insert(doubtful.end(), beside[m].begin(), beside[m].end());
        log_line(context, formatted("note: {} is swept {}, which suits its walls and neighbours best",
                                    member.region, ends_in_words(part.volume.volume)));
    }
}

/// Fill with tetrahedra the volumes that are not swept, one after the other, each beside the meshes made
/// before it.
void fill_rest(const Prepared& ready, bool alone, FilledParts& mesh, const RunContext& context)
{
    const sweep::SweptAssembly& swept = mesh.swept;
    sweep::SharedMiddles middles;
    const auto require_shared = [&](const std::string& region, bool agree) {
        if (!agree)
            throw NotSweepable(
                Message("assembly.not_shared",
                        "middle nodes of {} on shared sides differ from those of its neighbours", region)
                    .remedy("use order = 1"));
    };
    for (std::size_t p = 0; p < swept.parts.size() && !swept.unswept.empty(); ++p)
        if (const mesh::HexMesh& part = swept.parts[p].mesh; part.order() > 1)
            require_shared(mesh.regions[p], middles.add(part, [](Index) { return true; }));
    const double all = static_cast<double>(swept.parts.size() + swept.unswept.size());
    for (double before = static_cast<double>(swept.parts.size()); const sweep::Unswept& one : swept.unswept) {
        const RunContext part_context = part_of(context, before / all, (before + 1) / all);
        ++before;
        const sweep::AssemblyMember& member = ready.members[one.member];
        const Part& part = *ready.parts[one.member];
        ToFill what{&one.volume,
                    member.region,
                    part.whole,
                    alone,
                    one.why ? *one.why
                    : part.volume.no_roles
                        ? *part.volume.no_roles
                        : Message("closure.no_ends", "the volume has no ends to sweep between"),
                    {},
                    middles};
        for (const sweep::SharedFace& face : swept.beside) {
            if (face.a != one.member && face.b != one.member) continue;
            const bool first = face.a == one.member;
            const std::size_t other = first ? face.b : face.a;
            const FaceId own = first ? face.face_a : face.face_b, there = first ? face.face_b : face.face_a;
            if (const auto p = std::ranges::find(swept.member, other); p != swept.member.end()) {
                const sweep::Swept& made = swept.parts[static_cast<std::size_t>(p - swept.member.begin())];
                what.fixed.push_back(cells_on(made.mesh, made.faces, there, own));
            } else if (const auto t = std::ranges::find(swept.unswept, other, &sweep::Unswept::member);
                       t < swept.unswept.begin() + static_cast<std::ptrdiff_t>(mesh.tets.size())) {
                what.fixed.push_back(
                    cells_on(mesh.tets[static_cast<std::size_t>(t - swept.unswept.begin())], there, own));
            }
        }
        sweep::SweepOptions options = part.asked->options;
        options.second_order = member.options.second_order;
        mesh.tets.push_back(fill_with_tets(what, options, part_context));
        if (options.order > 1) require_shared(member.region, middles.add(mesh.tets.back().mesh));
        mesh.materials.push_back(part.volume.material);
    }
    if (!mesh.tets.empty()) number_nodes(mesh);
    for (const FilledTets& tets : mesh.tets)
        log_line(context,
                 formatted("note: {} cannot be swept and is filled with {} tetrahedra and {} pyramids; "
                           "the report says why",
                           tets.region, tets.mesh.cells.size() - tets.mesh.pyramids, tets.mesh.pyramids));
}

/// Sweep parts that share nodes, and fill those that cannot be swept, if their options say so.
FilledParts sweep_glued(Prepared ready, bool alone, const RunContext& context)
{
    for (sweep::AssemblyMember& member : ready.members) keep_known_faces(member);
    FilledParts mesh{sweep::sweep_assembly(ready.members, context), {}, {}, std::move(ready.left_out), {}};
    for (const std::size_t m : mesh.swept.member) {
        const sweep::AssemblyMember& member = ready.members[m];
        mesh.regions.push_back(member.turn_of.empty() ? member.region : member.turn_of);
        mesh.materials.push_back(ready.materials[m]);
        const std::size_t p = mesh.materials.size() - 1;
        const Part& part = *ready.parts[m];
        for (io::ColumnSet& columns :
             part.kept ? part.kept->columns : column_sets(*part.asked->volume, mesh.swept.parts[p])) {
            columns.part = p;
            mesh.columns.push_back(std::move(columns));
        }
    }
    for (const sweep::LeftOut& out : mesh.left_out)
        mesh.swept.report.push_back(formatted("left out: {} [{}]", out.message.text(), out.message.code()));
    mesh.left_out.insert(mesh.left_out.end(), mesh.swept.left_out.begin(), mesh.swept.left_out.end());
    fill_rest(ready, alone, mesh, context);
    return mesh;
}

/// Close the volumes and sweep all parts. Parts with the same `glue` are swept as one mesh; meshes of
/// different `glue` share no nodes.
/// @param left_out  volumes that were left out before.
/// @param alone  whether the parts are the pieces of a single volume, with no other member.
FilledParts sweep_parts(std::vector<Part>& all, std::vector<sweep::LeftOut> left_out, bool alone,
                        const RunContext& context, const ContactRequest& request = {})
{
    Prepared ready = prepare(all, std::move(left_out), alone, context);
    check_known_faces(all);
    if (ready.members.empty() && !ready.left_out.empty()) throw NotSweepable(ready.left_out.front().message);
    std::map<std::size_t, Prepared> sets; // by `glue`
    for (std::size_t m = 0; m < ready.members.size(); ++m) {
        Prepared& set = sets[ready.members[m].glue];
        set.members.push_back(ready.members[m]);
        set.materials.push_back(ready.materials[m]);
        set.parts.push_back(ready.parts[m]);
    }
    if (ready.members.empty()) sets[0]; // an empty set, which is refused
    if (sets.size() > 1) sweep::check_alike(ready.members);
    std::vector<sweep::AssemblyMember> members; // in the order of the sets
    for (auto& [glue, set] : sets) {
        choose_sweeps(set, context);
        members.insert(members.end(), set.members.begin(), set.members.end());
    }
    const std::vector<FoundContact> found = find_contacts(members, request, context);
    for (const auto& [glue, set] : sets) {
        const sweep::AssemblyMember& first = set.members.front();
        const std::string& name = first.whole.empty() ? first.region : first.whole;
        if (glue > 0 && std::ranges::none_of(found, [&](const FoundContact& of) {
                return std::ranges::find(of.contact.regions, name) != of.contact.regions.end();
            }))
            log_line(context, formatted("note: {} is not glued, and is in contact with no volume", name));
    }
    FilledParts mesh;
    std::size_t before = 0;
    for (auto& [glue, set] : sets) {
        const std::size_t count = set.members.size();
        if (before == 0) set.left_out = std::move(ready.left_out);
        if (sets.size() > 1) keep_known_pairs(set.members);
        if (!found.empty()) // contact pairs are written with the whole mesh
            for (sweep::AssemblyMember& member : set.members) member.options.layered = false;
        const auto members_all = static_cast<double>(ready.members.size());
        const RunContext own = part_of(context, static_cast<double>(before) / members_all,
                                       static_cast<double>(before + count) / members_all);
        FilledParts one = sweep_glued(std::move(set), alone, own);
        for (std::size_t& m : one.swept.member) m += before;
        for (sweep::Unswept& unswept : one.swept.unswept) unswept.member += before;
        append(mesh, std::move(one));
        before += count;
    }
    for (const Part& one : all) {
        const std::string& unit = one.kept ? one.kept->unit : one.volume.unit;
        mesh.unit = io::common_unit(mesh.unit, "a volume of the assembly", unit, "another");
    }
    for (const Part& one : all)
        if (one.asked != nullptr && !one.left_out) report_left_out(one.volume, mesh.swept.report);
    for (const FoundContact& contact : found) add_contact(mesh, members, contact, context);
    return mesh;
}

/// The parts of an assembly: the volumes, cut where needed, and the finished meshes.
/// @param meshes  see add_parts()
std::vector<Part> parts_of(std::span<const Member> members, std::vector<sweep::LeftOut>& left_out,
                           bool meshes, const RunContext& context)
{
    std::vector<Part> parts;
    for (std::size_t m = 0; m < members.size(); ++m) {
        const Member& member = members[m];
        if (member.mesh != nullptr) parts.push_back({nullptr, {}, {}, keep(*member.mesh)});
        if (member.parts != nullptr)
            for (std::unique_ptr<KeptMesh>& kept : keep(*member.parts))
                parts.push_back({nullptr, {}, {}, std::move(kept)});
        if (member.volume == nullptr) continue;
        const std::string& own = member.volume->name;
        const std::string name = own.empty() ? formatted("volume_{}", m + 1) : own;
        const std::size_t first = parts.size();
        const auto add = [&] { add_parts(parts, member, name, name, meshes, context); };
        if (!do_or_leave_out(left_out, name, member, add))
            parts.push_back({&member, name, *member.volume, nullptr, true});
        for (std::size_t p = first; p < parts.size() && !member.volume->glued; ++p) parts[p].glue = m + 1;
    }
    std::vector<KeptMesh*> kept;
    for (const Part& part : parts)
        if (part.kept) kept.push_back(part.kept.get());
    add_skins(kept, context);
    return parts;
}

} // namespace

Volume close_to_sweep(const Volume& volume, const std::string& region, const RunContext& context)
{
    Volume sealed = close(volume, {}, context);
    closure::check_ends(sealed.volume, region);
    return sealed;
}

void report_left_out(const Volume& volume, std::vector<std::string>& report)
{
    for (const std::string& missing : topology::left_out_in_words(volume.volume))
        report.push_back("closed: " + missing);
}

void partitions(const topology::OpenVolume& sealed, const closure::TakePieces& take,
                const RunContext& context)
{
    // No piece is a strip that is a sliver beside cells of the default size.
    closure::partitions(
        sealed, [&](const topology::OpenVolume& piece) { return !follow_walls(piece, context).refused; },
        kOnePoint * surface::default_size(sealed).length, take, context);
}

bool may_cut(const Volume& volume, bool mixed)
{
    const topology::OpenVolume& open = volume.volume;
    // An open ring is closed only after it was cut across.
    if (open.full_turn && !topology::free_edges(open).empty()) return false;
    if (mixed || volume.roles_found) return true;
    return !open.full_turn && std::ranges::none_of(topology::all_faces(open.model), [&](FaceId face) {
        return open.role[face.index()] != topology::Role::wall &&
               open.model[face].origin == topology::Origin::given;
    });
}

double swept_share(const std::vector<closure::StepPiece>& pieces)
{
    double swept = 0, all = 0;
    for (const closure::StepPiece& piece : pieces) {
        const double volume = closure::enclosed_volume(piece.volume);
        all += volume;
        if (closure::has_ends(piece.volume)) swept += volume;
    }
    return swept / all;
}

FilledParts sweep_pieces(const Volume& volume, std::vector<closure::StepPiece> pieces,
                         const sweep::SweepOptions& options, const RunContext& context)
{
    const Member asked{&volume, nullptr, nullptr, options, true, true};
    const std::string& name = volume.name;
    std::vector<Part> parts;
    add_pieces(parts, asked, name.empty() ? "piece" : name, name.empty() ? "volume" : name,
               std::move(pieces));
    for (Part& part : parts) part.asked_name = name.empty() ? "the volume" : name;
    return sweep_parts(parts, {}, true, context);
}

Filled sweep_as_assembly(const Volume& volume, const sweep::SweepOptions& options, const RunContext& context)
{
    const Member asked{&volume, nullptr, nullptr, options};
    std::vector<Part> parts;
    parts.push_back({&asked, "the volume", volume, nullptr});
    if (volume.name.empty()) parts.front().volume.name = "volume";
    Filled filled{{}, sweep_parts(parts, {}, true, context)};
    filled.volumes.push_back(std::move(parts.front().volume));
    filled.volumes.front().name = volume.name;
    return filled;
}

FilledParts fill_alone(const Member& member, const RunContext& context)
{
    std::vector<Part> parts;
    parts.push_back({&member, "the volume", *member.volume, nullptr});
    if (parts.front().volume.name.empty()) parts.front().volume.name = "volume";
    return sweep_parts(parts, {}, true, context);
}

Filled sweep(std::span<const Member> members, const RunContext& host, const ContactRequest& request)
{
    const RunContext context = never_falling(host);
    std::vector<sweep::LeftOut> left_out;
    std::vector<Part> parts = parts_of(members, left_out, true, context);
    const auto asked = std::ranges::find_if(members, [](const Member& member) {
        return member.volume != nullptr && member.options.fallback != sweep::Fallback::mixed;
    });
    const sweep::SweepOptions none;
    Filled filled = sweep_or_name_tets(asked == members.end() ? none : asked->options, [&] {
        return Filled{{}, sweep_parts(parts, std::move(left_out), false, context, request)};
    });
    for (const Member& member : members) {
        if (member.volume == nullptr) continue;
        const auto part = std::ranges::find(parts, &member, &Part::asked);
        filled.volumes.push_back(part != parts.end() && part->piece_of == nullptr ? std::move(part->volume)
                                                                                  : *member.volume);
    }
    report_progress(context, "shape of the skin", 1);
    return filled;
}

std::vector<Contact> contacts(std::span<const Member> members, const ContactRequest& request,
                              const RunContext& context)
{
    // A volume without ends to sweep between can be in contact too.
    std::vector<Member> closed(members.begin(), members.end());
    for (Member& member : closed) member.options.fallback = sweep::Fallback::mixed;
    std::vector<sweep::LeftOut> none;
    std::vector<Part> parts = parts_of(closed, none, false, context);
    return without_faces(find_contacts(prepare(parts, {}, false, context).members, request, context));
}

} // namespace lacuna::fill
