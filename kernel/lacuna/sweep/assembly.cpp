// SPDX-License-Identifier: MIT
#include <lacuna/sweep/assembly.h>

#include <lacuna/core/error.h>
#include <lacuna/sweep/detail/assembly_plan.h>
#include <lacuna/sweep/detail/place_order.h>
#include <lacuna/topology/give_mesh.h>
#include <lacuna/topology/side_points.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace lacuna::sweep {

using namespace topology;

namespace {

std::string place_of(const Vec3& p)
{
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "(%.6g, %.6g, %.6g)", p.x(), p.y(), p.z());
    return text.data();
}

/// The quads of a face in a part's skin, by the part's nodes.
std::vector<Quad> quads_on(const Swept& part, FaceId face)
{
    std::vector<Quad> quads;
    for (std::size_t i = 0; i < part.mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(part.mesh, i);
        if (part.faces[index(quad.patch)] == face) quads.push_back(quad.nodes);
    }
    return quads;
}

/// Hand a face's mesh on to the volume behind it.
void hand_on(const Swept& part, FaceId from, OpenVolume& volume, FaceId to)
{
    std::vector<Quad> quads = quads_on(part, from);
    std::map<Index, Index> number;
    std::vector<Vec3> nodes;
    for (Quad& quad : quads) {
        for (Index& n : quad) {
            const auto [place, fresh] = number.try_emplace(n, static_cast<Index>(nodes.size()));
            if (fresh) nodes.push_back(part.mesh.nodes[index(n)]);
            n = place->second;
        }
    }
    give_mesh(volume, to, nodes, quads);
}

/// A member that could not be swept where others had been before it.
struct Failed {
    std::size_t member;
    std::string code, why;
};

class Assembler {
public:
    Assembler(std::span<const AssemblyMember> members, const RunContext& context)
        : members_(members), context_(context)
    {
    }

    SweptAssembly run()
    {
        check_members();
        result_.shared = shared_faces(members_, context_);
        find_order();
        plan_ = plan_assembly(members_, result_.shared, context_);
        sweep_all();
        number_nodes();
        check_no_hanging_nodes();
        name_groups();
        return std::move(result_);
    }

private:
    void check_members() const
    {
        if (members_.empty()) throw InvalidInput("assembly.empty", "an assembly needs one volume at least");
        for (std::size_t m = 0; m < members_.size(); ++m) {
            if (members_[m].region == "volume")
                throw InvalidInput(
                    "assembly.same_name",
                    "a volume of an assembly is named \"volume\", which is the group of all of "
                    "them; give it another name");
            if (members_[m].options.order > 1 || members_[m].options.wedges)
                throw InvalidInput("assembly.cells", members_[m].region +
                                                         ": volumes of an assembly, and pieces of one with "
                                                         "steps, are swept into hexahedra of order 1; "
                                                         "leave out 'order' and 'wedges'");
            for (std::size_t n = 0; n < m; ++n) {
                if (members_[m].region == members_[n].region)
                    throw InvalidInput("assembly.same_name", "two volumes of the assembly are named \"" +
                                                                 members_[m].region + "\"");
            }
        }
    }

    [[nodiscard]] bool is_void(std::size_t m, FaceId face) const
    {
        return members_[m].volume->model[face].origin == Origin::made_void;
    }
    [[nodiscard]] bool is_wall(std::size_t m, FaceId face) const
    {
        return members_[m].volume->role[face.index()] == Role::wall;
    }

    /// Which members come after which: a face is what is given before what was made there, and rows before
    /// ends, if they can.
    void find_order()
    {
        after_.resize(members_.size());
        for (const SharedFace& face : result_.shared) {
            const bool void_a = is_void(face.a, face.face_a), void_b = is_void(face.b, face.face_b);
            if (void_a && !void_b) after_[face.a].insert(face.b);
            if (void_b && !void_a) after_[face.b].insert(face.a);
        }
        std::vector<std::size_t> order = order_of({});
        if (order.size() == members_.size()) return;
        std::string names;
        for (std::size_t m = 0; m < members_.size(); ++m) {
            if (std::ranges::find(order, m) == order.end())
                names += (names.empty() ? "" : ", ") + members_[m].region;
        }
        throw NotSweepable("assembly.round",
                           "each of " + names +
                               " lacks a face that the next one has, all round, so none can "
                               "be meshed first; give one of them that face too");
    }

    /// Members by what they wait for; of those that are free to come, `first` as listed, then those that
    /// share an end with one that is there, those whose walls are no one's ends that wait, and by number.
    [[nodiscard]] std::vector<std::size_t> order_of(std::span<const std::size_t> first) const
    {
        std::vector<char> placed(members_.size(), 0);
        std::vector<std::size_t> order;
        const auto has = [&](std::size_t m, bool wall, bool other_wall, bool there) {
            return std::ranges::any_of(result_.shared, [&](const SharedFace& face) {
                if (face.a != m && face.b != m) return false;
                const bool is_a = face.a == m;
                const std::size_t other = is_a ? face.b : face.a;
                return (placed[other] != 0) == there &&
                       is_wall(m, is_a ? face.face_a : face.face_b) == wall &&
                       is_wall(other, is_a ? face.face_b : face.face_a) == other_wall;
            });
        };
        for (;;) {
            std::size_t next = members_.size();
            const auto take = [&](std::size_t m, bool ready) {
                if (next == members_.size() && placed[m] == 0 && ready &&
                    std::ranges::all_of(after_[m], [&](std::size_t other) { return placed[other] != 0; }))
                    next = m;
            };
            for (const std::size_t m : first) take(m, true);
            const auto waits = [&](std::size_t m) { return has(m, false, true, false); };
            for (std::size_t m = 0; m < members_.size(); ++m)
                take(m, has(m, false, false, true) && !waits(m));
            for (std::size_t m = 0; m < members_.size(); ++m) take(m, !waits(m));
            for (std::size_t m = 0; m < members_.size(); ++m) take(m, true);
            if (next == members_.size()) return order;
            placed[next] = 1;
            order.push_back(next);
        }
    }

    /// In the plan's order; where a member cannot keep what others have made, it goes before them.
    void sweep_all()
    {
        std::vector<std::size_t> first;
        std::optional<Failed> reason;
        for (std::size_t attempt = 0; attempt <= members_.size(); ++attempt) {
            const std::vector<std::size_t> order = order_of(first);
            if (!first.empty() && order == order_) break;
            order_ = order;
            const std::optional<Failed> failed = sweep_in_order();
            if (!failed) {
                note_order(order);
                return;
            }
            if (!reason) reason = failed;
            if (std::ranges::find(first, failed->member) != first.end()) break;
            log_line(context_, failed->why);
            first.insert(first.begin(), failed->member);
        }
        throw NotSweepable(reason->code, reason->why);
    }

    void note_order(const std::vector<std::size_t>& order)
    {
        if (order.size() < 2) return;
        std::string names;
        for (const std::size_t m : order) names += (names.empty() ? "" : ", ") + members_[m].region;
        result_.report.push_back("meshed in this order: " + names);
    }

    std::optional<Failed> sweep_in_order()
    {
        result_.parts.assign(members_.size(), {});
        result_.report.clear();
        std::vector<char> done(members_.size(), 0);
        for (const std::size_t m : order_) {
            check_cancelled(context_);
            bool given = false;
            try {
                result_.parts[m] = sweep_one(m, done, given);
            } catch (const Cancelled&) {
                throw;
            } catch (const Error& error) {
                Failed failed{m, error.code(), members_[m].region + ": " + error.what()};
                if (given) return failed;
                throw NotSweepable(failed.code, failed.why);
            }
            done[m] = 1;
        }
        return std::nullopt;
    }

    /// A face of a member and the same one of another.
    struct Neighbour {
        FaceId own;
        std::size_t other;
        FaceId there;
    };
    /// Faces that a member shares with those that are done.
    [[nodiscard]] std::vector<Neighbour> shared_with(std::size_t m, const std::vector<char>& done) const
    {
        std::vector<Neighbour> found;
        for (const SharedFace& face : result_.shared) {
            if (face.a == m && done[face.b] != 0) found.push_back({face.face_a, face.b, face.face_b});
            if (face.b == m && done[face.a] != 0) found.push_back({face.face_b, face.a, face.face_a});
        }
        return found;
    }

    Swept sweep_one(std::size_t m, const std::vector<char>& done, bool& given)
    {
        const AssemblyMember& member = members_[m];
        SweepOptions options = member.options;
        if (plan_.layers[m] > 0 && options.layers.heights.empty()) options.layers.count = plan_.layers[m];
        OpenVolume volume = *member.volume, sealed = *member.volume;
        give_edge_nodes(volume, plan_.nodes[m]);
        for (const auto& [own, other, from] : shared_with(m, done)) {
            given = true;
            hand_on(result_.parts[other], from, volume, own);
            // Where the face is void, what the neighbour has there is the shape.
            if (is_void(m, own)) hand_on(result_.parts[other], from, sealed, own);
        }
        Swept part = sweep(volume, options, context_);
        check_kept(m, part, done);
        if (plan_.nodes[m].empty()) return part;
        // Shape is that of the volume as it was sealed, not as its neighbours' quads bound it.
        part.fidelity = compare(sealed, part.mesh, part.faces, {}, part.fidelity.volume,
                                {options.max_deviation}, context_);
        require(part.fidelity, part.mesh.layers, {options.max_deviation});
        std::erase_if(part.report, [](const std::string& line) { return line.starts_with("shape: volume"); });
        part.report.push_back(in_words(part.fidelity));
        return part;
    }

    /// Groups of each part's own, told apart by its region's name, beside those that all parts have.
    void name_groups()
    {
        for (std::size_t m = 0; m < members_.size(); ++m) {
            mesh::HexMesh& mesh = result_.parts[m].mesh;
            mesh.volume_groups.insert(mesh.volume_groups.begin(), members_[m].region);
            for (mesh::SkinPatch& patch : mesh.patches) {
                const std::vector<std::string> groups = patch.groups;
                for (const std::string& group : groups)
                    patch.groups.push_back(members_[m].region + ":" + group);
            }
        }
    }

    /// One number for nodes in one place, on the skins.
    void number_nodes()
    {
        struct SkinNode {
            std::size_t part;
            Index node;
        };
        std::vector<SkinNode> skin;
        result_.number.resize(members_.size());
        for (std::size_t m = 0; m < members_.size(); ++m) {
            const mesh::HexMesh& mesh = result_.parts[m].mesh;
            std::vector<char> on_skin(mesh.nodes.size(), 0);
            for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
                for (const Index n : mesh::skin_quad(mesh, i).nodes) on_skin[index(n)] = 1;
            }
            for (std::size_t n = 0; n < on_skin.size(); ++n) {
                if (on_skin[n] != 0) skin.push_back({m, static_cast<Index>(n)});
            }
            result_.number[m].assign(mesh.nodes.size(), -1);
        }
        const auto place = [&](const SkinNode& s) -> const Vec3& {
            return result_.parts[s.part].mesh.nodes[index(s.node)];
        };
        std::sort(skin.begin(), skin.end(), [&](const SkinNode& a, const SkinNode& b) {
            if (before(place(a), place(b))) return true;
            if (before(place(b), place(a))) return false;
            return std::tie(a.part, a.node) < std::tie(b.part, b.node);
        });
        // The first part's node stands for all in its place.
        std::vector<std::pair<SkinNode, SkinNode>> same;
        for (std::size_t i = 0, first = 0; i < skin.size(); ++i) {
            if (i == 0 || before(place(skin[first]), place(skin[i]))) first = i;
            if (first != i) same.emplace_back(skin[i], skin[first]);
        }
        std::sort(same.begin(), same.end(), [](const auto& a, const auto& b) {
            return std::tie(a.first.part, a.first.node) < std::tie(b.first.part, b.first.node);
        });
        Index next = 0;
        auto twin = same.begin();
        for (std::size_t m = 0; m < members_.size(); ++m) {
            std::vector<Index>& number = result_.number[m];
            for (std::size_t n = 0; n < number.size(); ++n) {
                if (twin != same.end() && twin->first.part == m && index(twin->first.node) == n) {
                    number[n] = result_.number[twin->second.part][index(twin->second.node)];
                    ++twin;
                } else {
                    number[n] = next++;
                }
            }
        }
        result_.nodes = index(next);
    }

    [[nodiscard]] std::string named(std::size_t member, FaceId face) const
    {
        return name_of(members_[member].volume->model, face) + " of " + members_[member].region;
    }

    /// Corners of a quad in an order of their own.
    using Places = std::array<std::array<double, 3>, 4>;
    static std::set<Places> places_on(const Swept& part, FaceId face)
    {
        std::set<Places> quads;
        for (const Quad& quad : quads_on(part, face)) {
            Places corners{};
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec3& p = part.mesh.nodes[index(quad[k])];
                corners[k] = {p.x(), p.y(), p.z()};
            }
            std::sort(corners.begin(), corners.end());
            quads.insert(corners);
        }
        return quads;
    }

    /// The quads of faces that members before this one have too are theirs, to the bit.
    void check_kept(std::size_t m, const Swept& part, const std::vector<char>& done)
    {
        for (const auto& [own, other, there] : shared_with(m, done)) {
            const std::set<Places> a = places_on(part, own), b = places_on(result_.parts[other], there);
            if (a == b) {
                result_.report.push_back("shared: " + named(other, there) + " and " + named(m, own) + ", " +
                                         std::to_string(a.size()) + (a.size() == 1 ? " quad" : " quads"));
                continue;
            }
            std::string why;
            for (const std::string& line : part.report)
                if (line.find("not kept") != std::string::npos) why += "; " + line;
            throw NotSweepable("assembly.not_shared", named(m, own) + " and " + named(other, there) +
                                                          " are one face, and their meshes differ on it: " +
                                                          std::to_string(a.size()) + " quads and " +
                                                          std::to_string(b.size()) + why);
        }
    }

    /// Nodes on the edges of a part's faces against such sides of the others: volumes that touch along an
    /// edge alone have no face to agree on.
    void check_no_hanging_nodes() const
    {
        struct EdgeSide {
            std::size_t part;
            Segment nodes;
        };
        std::vector<EdgeSide> sides;
        std::vector<std::array<Vec3, 2>> segments;
        std::vector<std::pair<std::size_t, Index>> at;
        std::vector<Vec3> points;
        double tolerance = 0;
        for (std::size_t m = 0; m < members_.size(); ++m) {
            tolerance = std::max(tolerance, members_[m].volume->model.tolerance);
            const mesh::HexMesh& mesh = result_.parts[m].mesh;
            std::map<Segment, Index> patch_at;
            std::set<Index> nodes;
            for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
                const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
                for (std::size_t k = 0; k < 4; ++k) {
                    Segment side{quad.nodes[k], quad.nodes[(k + 1) % 4]};
                    if (side[0] > side[1]) std::swap(side[0], side[1]);
                    const auto [found, fresh] = patch_at.try_emplace(side, quad.patch);
                    if (fresh) continue;
                    if (found->second != quad.patch) {
                        sides.push_back({m, side});
                        segments.push_back({mesh.nodes[index(side[0])], mesh.nodes[index(side[1])]});
                        nodes.insert(side.begin(), side.end());
                    }
                    patch_at.erase(found);
                }
            }
            for (const Index n : nodes) {
                at.emplace_back(m, n);
                points.push_back(mesh.nodes[index(n)]);
            }
        }
        for (const NearSegment& near : near_segments(points, segments, tolerance)) {
            const auto& [part, node] = at[index(near.point)];
            const EdgeSide& side = sides[index(near.segment)];
            if (part == side.part) continue;
            const Index number = result_.number[part][index(node)];
            const Segment ends{result_.number[side.part][index(side.nodes[0])],
                               result_.number[side.part][index(side.nodes[1])]};
            if (number == ends[0] || number == ends[1]) continue;
            const Vec3& p = points[index(near.point)];
            const auto& [a, b] = segments[index(near.segment)];
            const double f = fraction_along(p, a, b);
            if ((p - ((1 - f) * a + f * b)).norm() > tolerance) continue;
            throw NotSweepable(
                "assembly.hanging_node",
                members_[part].region + " has a node at " + place_of(p) + ", where " +
                    members_[side.part].region +
                    " has none: they touch along an edge and share no face there; give them the "
                    "same size along it");
        }
    }

    std::span<const AssemblyMember> members_;
    const RunContext& context_;
    AssemblyPlan plan_;
    std::vector<std::set<std::size_t>> after_; ///< of each member, those that must come before it
    std::vector<std::size_t> order_;
    SweptAssembly result_;
};

} // namespace

SweptAssembly sweep_assembly(std::span<const AssemblyMember> members, const RunContext& context)
{
    return Assembler(members, context).run();
}

} // namespace lacuna::sweep
