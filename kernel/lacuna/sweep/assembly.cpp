// SPDX-License-Identifier: MIT
#include <lacuna/sweep/assembly.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/sweep/detail/assembly_imprint.h>
#include <lacuna/sweep/detail/assembly_nodes.h>
#include <lacuna/sweep/detail/assembly_order.h>
#include <lacuna/sweep/detail/assembly_plan.h>
#include <lacuna/sweep/detail/carry_lines.h>
#include <lacuna/sweep/detail/improve_joined.h>
#include <lacuna/sweep/detail/periodic_nodes.h>
#include <lacuna/sweep/detail/plan_heights.h>
#include <lacuna/sweep/detail/prove_or_improve.h>
#include <lacuna/sweep/detail/second_order.h>
#include <lacuna/sweep/detail/shared_faces.h>
#include <lacuna/sweep/detail/source_quads.h>
#include <lacuna/sweep/detail/volume_share.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/sweep/shared/shared_middles.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/give_mesh.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Copy the mesh of a part's face, moved by `onto`, to a face of another volume.
void hand_on(const Swept& part, FaceId from, OpenVolume& volume, FaceId to, const Eigen::Isometry3d& onto)
{
    FaceMesh mesh = face_mesh(part.skin(), quads_on(part.mesh, part.faces, from));
    for (Vec3& p : mesh.places) p = onto * p;
    give_mesh(volume, to, mesh.places, mesh.quads);
}

/// Codes of errors whose remedy is to remesh a given face, or to load it without its mesh.
constexpr std::array<std::string_view, 4> kGivenMesh{"surface.wall_rows", "surface.wall_not_rows",
                                                     "surface.kept_rim", "sweep.layers_given"};

/// The reason for a member's failure. A remedy that loads the member without its mesh is replaced if the
/// member has no given mesh: the quads that it keeps are then those of neighbours meshed before it.
Message why_failed(const AssemblyMember& member, const Message& error)
{
    Message why = error.about(member.region);
    if (came_with_mesh(member) || std::ranges::find(kGivenMesh, why.code()) == kGivenMesh.end()) return why;
    return std::move(why).remedy(
        "these quads and nodes come from its neighbours: give all of them the same 'size' "
        "and 'layers'");
}

/// Error: a member could not be swept, either alone or together with the meshes of its neighbours.
struct MemberFailed : NotSweepable {
    MemberFailed(std::size_t which, Message why) : NotSweepable(std::move(why)), member(which) {}
    std::size_t member;
};

class Assembler {
public:
    Assembler(std::span<const AssemblyMember> members, const RunContext& context)
        : members_(members.begin(), members.end()), context_(context)
    {
    }

    SweptAssembly run()
    {
        check_members();
        check_count();
        find_shared();
        set_aside();
        if (members_.empty()) return std::move(result_);
        before_ = members_before(members_, result_.shared);
        plan();
        try {
            sweep_all();
        } catch (const MemberFailed& failed) {
            if (!carry_lines()) throw;
            log_line(context_, failed.message().text());
            sweep_again();
        }
        number_nodes(result_);
        if (periodic_.empty()) improve_across();
        for (std::size_t m = 0; m < members_.size(); ++m) {
            if (members_[m].fixed != nullptr) continue;
            note_poor_cells(result_.parts[m]);
            if (members_[m].whole.empty())
                note_lost_volume(result_.parts[m], *members_[m].volume, members_[m].options);
        }
        note_lost_wholes(result_, members_, context_);
        sweep::pair_nodes(images(), result_, context_);
        check_no_hanging_nodes(result_, members_);
        name_groups(result_, members_);
        log_defaults();
        return std::move(result_);
    }

private:
    /// Log each default once, even if several members have it.
    void log_defaults() const
    {
        std::set<std::string> said;
        for (const std::size_t m : order_) {
            const std::string& region = members_[m].region;
            for (const std::string& line : result_.parts[m].defaults)
                if (said.insert(line).second) log_line(context_, formatted("{}: {}", region, line));
            for (const std::string& note : result_.parts[m].notes)
                if (said.insert(note).second) log_line(context_, formatted("note: {}: {}", region, note));
        }
    }

    void check_members() const
    {
        if (members_.empty())
            throw InvalidInput(
                Message("assembly.empty", "an assembly needs at least one volume").remedy("add a volume"));
        check_alike(members_);
    }

    void check_count() const
    {
        ExpectedCells all;
        for (const AssemblyMember& member : members_) {
            if (member.fixed != nullptr || member.unswept) continue;
            KnownLinks links(*member.volume);
            const ExpectedCells own = source_size(*member.volume, member.options, links, context_).expected;
            all.all += own.all;
            all.unasked += own.unasked;
        }
        check_cells(all, context_);
    }

    /// Copies of the volumes, which the assembler may split.
    void copy_volumes()
    {
        if (!imprinted_.empty()) return;
        for (const AssemblyMember& member : members_) imprinted_.push_back(*member.volume);
        for (std::size_t m = 0; m < members_.size(); ++m) members_[m].volume = &imprinted_[m];
    }

    /// Split faces that are shared in part.
    void find_shared()
    {
        FacesInCommon found = faces_in_common(members_, context_);
        if (!found.partly.empty()) {
            copy_volumes();
            FaceImprint imprint = imprint_faces(imprinted_, members_, found.partly, context_);
            notes_ = std::move(imprint.report);
            found = faces_in_common(members_, context_, with_sag_of_parts(found.sag, imprint));
            refuse_partly_shared(found);
        }
        result_.shared = std::move(found.whole);
        sag_ = std::move(found.sag);
        if (std::ranges::any_of(members_, &AssemblyMember::unswept)) {
            copy_volumes();
            add_vertices_beside(imprinted_, members_, result_.shared, context_);
        }
        result_.near_misses = std::move(found.near);
        for (const NearMiss& miss : result_.near_misses)
            notes_.push_back(miss.message.about("near miss").text());
        if (const std::size_t count = result_.near_misses.size()) {
            const std::string more = count > 1 ? formatted("; {} more are in the report", count - 1) : "";
            log_line(context_, formatted("note: {}{}", notes_[notes_.size() - count], more));
        }
    }

    /// Move members that are not swept to the list `unswept` of the result, and the faces that they share to
    /// its list `beside`.
    void set_aside()
    {
        std::vector<std::size_t> place(members_.size(), members_.size());
        std::vector<AssemblyMember> swept;
        std::vector<OpenVolume> volumes;
        for (std::size_t m = 0; m < members_.size(); ++m) {
            if (members_[m].unswept) {
                result_.unswept.push_back({m, *members_[m].volume, std::nullopt});
                continue;
            }
            place[m] = swept.size();
            std::swap(sag_[swept.size()], sag_[m]);
            swept.push_back(members_[m]);
            if (!imprinted_.empty()) volumes.push_back(std::move(imprinted_[m]));
        }
        imprinted_ = std::move(volumes);
        sag_.resize(swept.size());
        for (std::size_t m = 0; m < imprinted_.size(); ++m) swept[m].volume = &imprinted_[m];
        const std::size_t none = members_.size();
        members_ = std::move(swept);
        const auto is_aside = [&](const auto& pair) {
            return place[pair.a] == none || place[pair.b] == none;
        };
        std::ranges::copy_if(result_.shared, std::back_inserter(result_.beside), is_aside);
        for (const SharedFace& face : result_.beside) {
            if (place[face.a] != none) beside_.emplace_back(place[face.a], face.face_a);
            if (place[face.b] != none) beside_.emplace_back(place[face.b], face.face_b);
        }
        std::erase_if(result_.shared, is_aside);
        std::erase_if(result_.near_misses, is_aside);
        for (SharedFace& face : result_.shared) face.a = place[face.a], face.b = place[face.b];
        for (NearMiss& miss : result_.near_misses) {
            miss.a = place[miss.a], miss.b = place[miss.b];
            if (miss.edge) miss.edge_of = place[miss.edge_of];
        }
    }

    /// Split ends along lines that neighbours need. @return  whether any end was split
    bool carry_lines()
    {
        copy_volumes();
        const std::vector<std::size_t> before = faces_of_fixed();
        const auto lines = attempt([&] { return sweep::carry_lines(members_, imprinted_, context_); });
        if (!lines) { // report the first error: it is more informative
            log_line(context_, lines.why->text());
            return false;
        }
        if (faces_of_fixed() != before) return false; // given quads are not split
        notes_.insert(notes_.end(), lines->begin(), lines->end());
        return !lines->empty();
    }

    [[nodiscard]] std::vector<std::size_t> faces_of_fixed() const
    {
        std::vector<std::size_t> counts;
        for (const AssemblyMember& member : members_) {
            if (member.fixed != nullptr) counts.push_back(member.volume->model.faces.size());
        }
        return counts;
    }

    [[nodiscard]] ImagesOf images() const { return {members_, periodic_, grid_}; }

    void plan()
    {
        leave_out_cuts();
        grid_ = grid_of(members_);
        periodic_ = periodic_faces(members_, grid_, context_);
        plan_ = plan_assembly(members_, result_.shared, beside_, periodic_, context_);
    }

    /// Faces between two pieces of one volume are not among the walls that boundary layers name as "walls".
    void leave_out_cuts()
    {
        for (AssemblyMember& member : members_)
            for (surface::BoundaryLayer& layer : member.options.boundary_layers) layer.walls.inner.clear();
        for (const SharedFace& face : result_.shared) {
            const std::string& whole = members_[face.a].whole;
            if (whole.empty() || whole != members_[face.b].whole) continue;
            for (const auto& [m, own] : {std::pair(face.a, face.face_a), std::pair(face.b, face.face_b)})
                for (surface::BoundaryLayer& layer : members_[m].options.boundary_layers)
                    layer.walls.inner.insert(own);
        }
    }

    void sweep_again()
    {
        result_.report.clear();
        result_.shared = faces_in_common(members_, context_, sag_).whole;
        plan();
        sweep_all();
    }

    /// Sweep the members in the plan's order. If a member cannot keep its neighbours' meshes, the order is
    /// changed so that this member comes first, and all are swept again.
    void sweep_all()
    {
        std::vector<std::size_t> first;
        std::optional<MemberFailed> reason;
        std::vector<SharedFace> faces = result_.shared; // a periodic face takes its image's quads
        for (const PeriodicFaces& pair : periodic_)
            if (pair.a != pair.b)
                faces.push_back(pair.a < pair.b ? SharedFace{pair.a, pair.b, pair.face_a, pair.face_b}
                                                : SharedFace{pair.b, pair.a, pair.face_b, pair.face_a});
        for (std::size_t attempt = 0; attempt <= members_.size(); ++attempt) {
            const std::vector<std::size_t> order = order_members(members_, faces, before_, first);
            if (!first.empty() && order == order_) break;
            order_ = order;
            const std::optional<MemberFailed> failed = sweep_in_order();
            if (!failed) {
                note_order(order);
                return;
            }
            if (!reason) reason = failed;
            if (std::ranges::find(first, failed->member) != first.end()) break;
            log_line(context_, failed->message().text());
            first.insert(first.begin(), failed->member);
        }
        throw MemberFailed(*reason);
    }

    /// Improve cells where members meet: their nodes no single sweep may move.
    void improve_across()
    {
        RaiseOrder raise_order;
        if (members_.front().options.order > 1)
            raise_order = [this](std::vector<Swept>& parts, const std::set<std::size_t>& moved) {
                return static_cast<bool>(attempt<NotSweepable>([&] { place_middles(parts, moved); }));
            };
        auto joined = improve_joined(result_, members_, raise_order, context_);
        if (!joined) return;
        result_.parts = std::move(joined->parts);
        result_.report.push_back("across the faces between volumes: " + in_words(joined->improved));
    }

    /// Place the middle nodes of moved parts again. The other parts keep theirs.
    void place_middles(std::vector<Swept>& parts, const std::set<std::size_t>& moved)
    {
        middles_ = {};
        for (const bool again : {false, true})
            for (const std::size_t m : order_) {
                if (moved.contains(m) != again) continue;
                if (again) {
                    SecondOrderOptions options = members_[m].options.second_order;
                    give_middles(options);
                    elevate(*members_[m].volume, parts[m].mesh, parts[m].faces, options, context_);
                }
                keep_middles(m, parts[m]);
            }
    }

    void note_order(const std::vector<std::size_t>& order)
    {
        if (order.size() < 2) return;
        const auto name = [&](std::size_t m) { return members_[m].region; };
        result_.report.push_back(formatted("meshed in this order: {}", full_list(order, name)));
    }

    std::optional<MemberFailed> sweep_in_order()
    {
        result_.parts.resize(members_.size());
        result_.report = notes_;
        middles_ = {};
        std::vector<char> done(members_.size(), 0);
        const double all = static_cast<double>(order_.size() + result_.unswept.size());
        for (double before = 0; const std::size_t m : order_) {
            check_cancelled(context_);
            const RunContext part = part_of(context_, before / all, (before + 1) / all);
            ++before;
            const std::vector<Neighbour> neighbours = shared_with(m, done);
            std::vector<Neighbour> handed = images_for(m, done);
            handed.insert(handed.end(), neighbours.begin(), neighbours.end());
            done[m] = 1;
            const auto made = attempt([&] {
                make(m, handed, part);
                check_kept(m, neighbours);
                if (members_[m].options.order > 1) keep_middles(m, result_.parts[m]);
            });
            if (made) continue;
            MemberFailed failed(m, why_failed(members_[m], *made.why));
            if (!handed.empty()) return failed;
            throw failed;
        }
        return std::nullopt;
    }

    /// A face of a member, and the same face of another member.
    struct Neighbour {
        FaceId own;
        std::size_t other;
        FaceId there;
        Eigen::Isometry3d onto = Eigen::Isometry3d::Identity(); ///< moves that face onto the own one
    };
    /// Periodic faces of a member whose images are meshed already, in other members.
    [[nodiscard]] std::vector<Neighbour> images_for(std::size_t m, const std::vector<char>& done) const
    {
        std::vector<Neighbour> found;
        for (const PeriodicFaces& pair : periodic_) {
            if (pair.a == pair.b) continue;
            if (pair.b == m && done[pair.a] != 0)
                found.push_back({pair.face_b, pair.a, pair.face_a, pair.onto});
            if (pair.a == m && done[pair.b] != 0)
                found.push_back({pair.face_a, pair.b, pair.face_b, pair.onto.inverse()});
        }
        return found;
    }
    /// Faces that a member shares with members that are meshed already.
    [[nodiscard]] std::vector<Neighbour> shared_with(std::size_t m, const std::vector<char>& done) const
    {
        std::vector<Neighbour> found;
        for (const SharedFace& face : result_.shared) {
            if (face.a == m && done[face.b] != 0) found.push_back({face.face_a, face.b, face.face_b});
            if (face.b == m && done[face.a] != 0) found.push_back({face.face_b, face.a, face.face_a});
        }
        return found;
    }

    [[nodiscard]] std::set<FaceId> shared_faces_of(std::size_t m) const
    {
        std::set<FaceId> shared;
        for (const Neighbour& n : shared_with(m, std::vector<char>(members_.size(), 1))) shared.insert(n.own);
        return shared;
    }

    /// Whether rows of a member continue in a neighbour across an end of both, so that it keeps the
    /// neighbour's quads: the same tables apply to the walls next to this end in both, or none in both.
    [[nodiscard]] bool rows_continue(std::size_t m, const Neighbour& n) const
    {
        const auto heights = [&](std::size_t member, FaceId face) {
            const OpenVolume& volume = *members_[member].volume;
            const surface::LayerTables tables = surface::layer_tables(
                volume, members_[member].options.boundary_layers);
            std::set<std::vector<double>> found;
            for (const EdgeUse& use : uses_of(volume.model[face]))
                if (const FaceId wall = surface::wall_on(volume, use.edge);
                    wall.valid() && tables.at(wall) >= 0)
                    found.insert(tables.heights[index(tables.at(wall))]);
            return found;
        };
        const auto is_end = [&](std::size_t member, FaceId face) {
            return members_[member].volume->role[face.index()] != Role::wall;
        };
        if (members_[m].options.boundary_layers.empty() || members_[n.other].fixed != nullptr ||
            !is_end(m, n.own) || !is_end(n.other, n.there))
            return false;
        return heights(m, n.own) == heights(n.other, n.there);
    }

    /// Copy the meshes of shared faces and of images of periodic faces to the member, then sweep the member.
    /// @param handed  the faces that are meshed already, in other members
    void make(std::size_t m, const std::vector<Neighbour>& handed, const RunContext& context)
    {
        const AssemblyMember& member = members_[m];
        if (member.fixed != nullptr) {
            result_.parts[m] = *member.fixed;
            return;
        }
        SweepOptions options = member.options;
        options.fallback = Fallback::none;                      // the caller applies the fallback
        options.layered = options.layered && periodic_.empty(); // periodic pairs need stored nodes
        if (plan_.layers[m] > 0 && options.layers.heights.empty()) options.layers.count = plan_.layers[m];
        if (!plan_.heights[m].empty()) {
            std::vector<double> heights{0};
            heights.insert(heights.end(), plan_.heights[m].begin(), plan_.heights[m].end());
            if (member.volume->turned_round) reverse_heights(heights); // given from the named source
            options.layers.heights.assign(heights.begin() + 1, heights.end());
        }
        if (options.order > 1) give_middles(options.second_order);
        options.beside.between = shared_faces_of(m);
        options.beside.own_mesh = came_with_mesh(member);
        options.beside.given = member.volume;
        OpenVolume volume = *member.volume, sealed = *member.volume;
        give_edge_nodes(volume, plan_.nodes[m]);
        // A member with an explicit option `quads` also keeps the quads of a neighbour that was meshed first.
        // It does not if it has rows along walls or boundary layers: these continue across the shared face,
        // so the member paves that face itself.
        const bool all = options.quads != Quads::automatic && options.rows == 0 &&
                         options.boundary_layers.empty();
        for (const Neighbour& n : handed)
            if (all || rows_continue(m, n)) options.beside.handed.insert(n.own);
        for (const auto& [own, other, from, onto] : handed) {
            hand_on(result_.parts[other], from, volume, own, onto);
            // On a void face, the neighbour's mesh defines the shape.
            if (volume.model[own].origin == Origin::made_void)
                hand_on(result_.parts[other], from, sealed, own, onto);
        }
        const bool keeps = options.quads == Quads::automatic || options.quads == Quads::keep;
        std::set<FaceId> fixed = options.beside.handed; // faces whose nodes are given or copied
        for (const Neighbour& n : handed) fixed.insert(n.own);
        if (keeps) give_to_images(images(), m, volume, fixed);
        options.beside.settle = [&](const mesh::SkinNodes& skin, const std::vector<FaceId>& faces) {
            return tie_images(images(), m, fixed, skin, faces);
        };
        // The reference shape is the sealed volume without the nodes planned on edges. Of the neighbours'
        // quads it has only those on void faces.
        if (!plan_.nodes[m].empty() || !fixed.empty()) options.beside.shape = &sealed;
        result_.parts[m] = sweep(volume, options, context);
    }

    /// Make the options look up a middle node in the members meshed so far and, if they have none, in the
    /// user's files.
    void give_middles(SecondOrderOptions& options) const
    {
        const Vec3 none = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
        const auto with_known = [](std::vector<Vec3> middles, const auto& find) {
            for (std::size_t i = 0; i < middles.size(); ++i)
                if (const std::optional<Vec3> known = find(i)) middles[i] = *known;
            return middles;
        };
        options.given_all_over = true;
        options.given = [=, this, decks = options.given](std::span<const Vec3> from,
                                                         std::span<const Vec3> to) {
            return with_known(decks ? decks(from, to) : std::vector<Vec3>(from.size(), none),
                              [&](std::size_t i) { return middles_.side(from[i], to[i]); });
        };
        options.given_centres = [=, this,
                                 decks = options.given_centres](std::span<const std::array<Vec3, 4>> quads) {
            return with_known(decks ? decks(quads) : std::vector<Vec3>(quads.size(), none),
                              [&](std::size_t i) { return middles_.centre(quads[i]); });
        };
    }

    /// Store a part's middle nodes for later members. Check that the part kept the middle nodes of earlier
    /// members.
    void keep_middles(std::size_t m, const Swept& part)
    {
        const std::set<FaceId> shared = shared_faces_of(m);
        if (!middles_.add(part.mesh, [&](Index patch) { return shared.contains(part.faces[index(patch)]); }))
            throw NotSweepable(
                Message("assembly.not_shared",
                        "middle nodes of {} on shared faces differ from those of its neighbours",
                        members_[m].region)
                    .remedy("use order = 1"));
    }

    /// The quads of a part on a face.
    [[nodiscard]] std::vector<Quad> quads_of(std::size_t m, FaceId face) const
    {
        return quads_on(result_.parts[m].mesh, result_.parts[m].faces, face);
    }

    /// Check that quads on faces shared with earlier members are bit-identical to the quads of those members.
    void check_kept(std::size_t m, const std::vector<Neighbour>& neighbours)
    {
        const Swept& part = result_.parts[m];
        for (const auto& [own, other, there, onto] : neighbours) {
            const std::vector<Quad> a = quads_of(m, own), b = quads_of(other, there);
            const NamedEntity face_a = entity_in(members_[m], own),
                              face_b = entity_in(members_[other], there);
            const std::string &region_a = members_[m].region, &region_b = members_[other].region;
            if (a.size() == b.size() &&
                same_quads(face_mesh(part.skin(), a), face_mesh(result_.parts[other].skin(), b), 0)) {
                result_.report.push_back(formatted("shared: {} of {} and {} of {}, {} {}", face_b, region_b,
                                                   face_a, region_a, a.size(),
                                                   a.size() == 1 ? "quad" : "quads"));
                continue;
            }
            throw NotSweepable(
                Message("assembly.not_shared",
                        "{} of {} and {} of {} are one face, centred at {}, but were meshed differently: "
                        "{} and {} quads{}",
                        face_a, region_a, face_b, region_b,
                        place_with_digits(face_centroid(members_[m].volume->model, own), 4), found(a.size()),
                        needed(b.size()), part.not_kept.empty() ? "" : " (" + part.not_kept.front() + ")")
                    .remedy("give both volumes the same 'size' and 'layers'"));
        }
    }

    std::vector<AssemblyMember> members_;
    std::vector<OpenVolume> imprinted_;                  ///< the members' volumes, if faces had to be split
    std::vector<std::pair<std::size_t, FaceId>> beside_; ///< faces shared with members that are not swept
    std::vector<std::vector<double>> sag_; ///< for each member: sag of each of its faces, measured before
                                           ///< ends were split
    std::vector<std::string> notes_;       ///< lines of the report: imprints and near misses
    const RunContext& context_;
    std::vector<PeriodicFaces> periodic_;
    double grid_ = 0; ///< spacing of the grid that nodes of periodic faces are rounded to
    AssemblyPlan plan_;
    std::vector<std::set<std::size_t>> before_; ///< for each member, those that must precede it
    std::vector<std::size_t> order_;
    SharedMiddles middles_; ///< middle nodes of the parts so far, at order 2
    SweptAssembly result_;
};

} // namespace

SweptAssembly sweep_assembly(std::span<const AssemblyMember> members, const RunContext& context)
{
    std::vector<AssemblyMember> left(members.begin(), members.end());
    for (AssemblyMember& member : left) {
        ImproveOptions& improving = member.options.improving;
        const ImproveOptions& first = left.front().options.improving;
        if (improving.work == first.work && improving.seconds == first.seconds) improving.spent = first.spent;
        improving = with_shared_limits(improving);
    }
    std::vector<std::size_t> place(left.size());
    std::iota(place.begin(), place.end(), std::size_t{0});
    // For each region that was repeated with wedges: its error without wedges.
    std::map<std::string, MemberFailed> without_wedges;
    std::map<std::size_t, Message> failures; // errors of members that are not swept, by index
    std::vector<LeftOut> left_out;
    for (;;) {
        try {
            SweptAssembly swept = Assembler(left, context).run();
            for (std::size_t m = 0; m < left.size(); ++m)
                if (!left[m].unswept) swept.member.push_back(place[m]);
            for (Unswept& one : swept.unswept) {
                one.member = place[one.member];
                if (const auto why = failures.find(one.member); why != failures.end()) one.why = why->second;
            }
            for (SharedFace& face : swept.beside) face.a = place[face.a], face.b = place[face.b];
            for (const auto& [region, failed] : without_wedges)
                swept.report.push_back(
                    formatted("fallback: meshed with wedges, because {}", failed.message().text()));
            for (const LeftOut& out : left_out)
                swept.report.push_back(
                    formatted("left out: {} [{}]", out.message.text(), out.message.code()));
            swept.left_out = std::move(left_out);
            return swept;
        } catch (const MemberFailed& failed) {
            // The index of the failed member in `left`; `failed.member` counts only members that are swept.
            std::size_t m = 0;
            for (std::size_t swept_members = 0; left[m].unswept || swept_members++ < failed.member;) ++m;
            AssemblyMember& member = left[m];
            const Fallback fallback = member.options.fallback;
            if (fallback == Fallback::wedges && !member.options.wedges) {
                member.options.wedges = true;
                without_wedges.emplace(member.region, failed);
            } else if (const auto first = without_wedges.find(member.region); first != without_wedges.end()) {
                throw MemberFailed(first->second); // it says more than the error with wedges
            } else if (fallback == Fallback::mixed) {
                member.unswept = true;
                failures.emplace(place[m], failed.message());
            } else if (fallback == Fallback::leave_out && left.size() > 1) {
                left_out.push_back({member.region, failed.message()});
                left.erase(left.begin() + static_cast<std::ptrdiff_t>(m));
                place.erase(place.begin() + static_cast<std::ptrdiff_t>(m));
            } else {
                throw;
            }
            log_line(context, failed.message().text());
        }
    }
}

} // namespace lacuna::sweep
