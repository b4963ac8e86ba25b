// SPDX-License-Identifier: MIT
#include <lacuna/fill.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/fill/detail/kept_mesh.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/healing/shared/weld.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace lacuna::fill {

namespace {

/// Move a swept mesh. If the move mirrors it, the quads are turned over, so that cells keep positive volumes.
void move(sweep::Swept& swept, const Eigen::Affine3d& by)
{
    mesh::HexMesh& mesh = swept.mesh;
    for (Vec3& p : mesh.nodes) p = by * p;
    for (Vec3& p : mesh.middles.nodes) p = by * p;
    for (quality::WorstCell& worst : swept.quality.worst) worst.centre = by * worst.centre;
    for (sweep::FaceFidelity& face : swept.fidelity.faces) {
        face.place = by * face.place;
        face.found_at = by * face.found_at;
    }
    if (by.linear().determinant() > 0) return;
    for (Quad& quad : mesh.quads) quad = mesh::turned_over(quad);
    for (Segment& side : mesh.rim) std::swap(side[0], side[1]);
    for (Quad& sides : mesh.middles.side_of) std::ranges::reverse(sides);
}

/// The nodes of a copy, made from those of the mesh.
/// @param joined  nodes of this copy that an earlier copy already has, ascending
mesh::LayeredNodes copied_nodes(std::shared_ptr<const std::vector<Vec3>> nodes, std::size_t row,
                                const Eigen::Affine3d& by, std::vector<std::pair<Index, Vec3>> joined)
{
    const auto places = std::make_shared<const std::vector<std::pair<Index, Vec3>>>(std::move(joined));
    const auto from = [places](Index node) {
        return std::ranges::lower_bound(*places, node, {}, &std::pair<Index, Vec3>::first);
    };
    mesh::LayeredNodes copied;
    copied.place = [=](int first, int, std::span<Vec3> out, const RunContext&) {
        const std::size_t begin = static_cast<std::size_t>(first) * row;
        for (std::size_t n = 0; n < out.size(); ++n) out[n] = by * (*nodes)[begin + n];
        for (auto at = from(static_cast<Index>(begin)); at != places->end(); ++at) {
            const std::size_t n = index(at->first) - begin;
            if (n >= out.size()) break;
            out[n] = at->second;
        }
    };
    copied.on_skin = [=](Index node) -> Vec3 {
        const auto at = from(node);
        return at != places->end() && at->first == node ? at->second : by * (*nodes)[index(node)];
    };
    return copied;
}

/// A node of a part, or a side of its skin.
struct OfPart {
    std::size_t part;
    Index number;
};

/// The first part that has a node of the whole mesh, and the number of the node in that part.
OfPart owner(std::span<const mesh::NodeNumbers> numbering, Index node)
{
    const auto after = std::ranges::upper_bound(numbering, node, {}, &mesh::NodeNumbers::first);
    const mesh::NodeNumbers& numbers = *std::prev(after);
    return {static_cast<std::size_t>(std::prev(after) - numbering.begin()),
            static_cast<Index>(numbers.fresh_node(index(node - numbers.first())))};
}

/// The skins of all parts together.
struct Skin {
    std::vector<OfPart> nodes, sides;
    std::vector<Vec3> places;  ///< places of `nodes`
    std::vector<Quad> corners; ///< corners of `sides`, as indices in `nodes`
    std::vector<Triangle> facets;

    explicit Skin(const FilledParts& mesh)
    {
        for (std::size_t p = 0; p < mesh.regions.size(); ++p) {
            const mesh::HexMesh& part = mesh.swept.parts[p].mesh;
            std::vector<Index> number(part.node_count(), -1);
            for (std::size_t i = 0; i < part.skin_count(); ++i) {
                for (const Index n : mesh::skin_nodes(part, i)) {
                    if (number[index(n)] >= 0) continue;
                    number[index(n)] = static_cast<Index>(nodes.size());
                    nodes.push_back({p, n});
                    places.push_back(part.node(index(n)));
                }
                Quad quad = mesh::skin_quad(part, i).nodes;
                for (Index& n : quad) n = number[index(n)];
                sides.push_back({p, static_cast<Index>(i)});
                corners.push_back(quad);
                facets.push_back({quad[0], quad[1], quad[2]});
                if (quad[2] != quad[3]) facets.push_back({quad[0], quad[2], quad[3]});
            }
        }
    }
};

/// The nodes and skin sides that a mesh shares with a copy of it.
struct InCommon {
    std::vector<std::pair<OfPart, OfPart>> nodes; ///< pairs of a node of the copy and a node of the mesh
    std::vector<OfPart> of_copy, of_mesh;         ///< sides of the skins
};

/// Refuse a copy whose volumes overlap those of the mesh.
/// @param number  number of the copy, for messages.
/// @return  places where mesh and copy nearly touch.
std::vector<sweep::NearMiss> check_volumes(const FilledParts& mesh, const FilledParts& copy, int number,
                                           const RunContext& context)
{
    std::array<FilledParts, 2> pair{mesh, copy};
    for (std::size_t p = 0; p < mesh.regions.size(); ++p) {
        std::string& region = pair[0].regions[p];
        if (region == "volume") region = "the mesh"; // in an assembly, "volume" names all cells
        pair[1].regions[p] = formatted("copy {} of {}", number, region);
        for (FilledParts& one : pair) one.swept.parts[p].mesh.volume_groups = {"volume"};
    }
    RunContext quiet = context;
    quiet.log = nullptr; // the sweep would report faces that are shared in part as near misses
    const std::array<Member, 2> members{Member{nullptr, nullptr, &pair[0]}, {nullptr, nullptr, &pair[1]}};
    return std::get<FilledParts>(sweep(members, quiet).mesh).swept.near_misses;
}

/// Nodes and sides that a copy shares with the mesh: those in the same places.
/// @throw NotSweepable  a node of one lies on the skin of the other, which has no node there.
InCommon in_common(const Skin& skin, const Eigen::Affine3d& by, double diagonal, const RunContext& context)
{
    const std::size_t count = skin.nodes.size();
    std::vector<Vec3> points = skin.places;
    for (const Vec3& p : skin.places) points.push_back(by * p);
    const std::vector<Index> same = healing::weld(points, kSamePlace * diagonal, context);
    InCommon found;
    std::vector<Index> twin(count, -1); // for each node of the copy: the mesh's node at its place; -1: none
    std::vector<char> shared(count, 0); // for each node of the mesh: whether the copy has a node there
    for (std::size_t i = 0; i < count; ++i) {
        if (index(same[count + i]) >= count) continue;
        twin[i] = same[count + i];
        shared[index(twin[i])] = 1;
        found.nodes.emplace_back(skin.nodes[i], skin.nodes[index(twin[i])]);
    }
    std::map<Quad, std::size_t> sides;
    const auto key = [&](Quad quad, const auto& node) {
        for (Index& n : quad) n = node(n);
        std::ranges::sort(quad);
        return quad;
    };
    for (std::size_t s = 0; s < skin.sides.size(); ++s)
        sides.emplace(key(skin.corners[s], [&](Index n) { return same[index(n)]; }), s);
    for (std::size_t s = 0; s < skin.sides.size(); ++s) {
        const auto other = sides.find(key(skin.corners[s], [&](Index n) { return twin[index(n)]; }));
        if (other == sides.end()) continue;
        found.of_copy.push_back(skin.sides[s]);
        found.of_mesh.push_back(skin.sides[other->second]);
    }
    // Find nodes of one skin that lie on a side of the other skin where the other skin has no node.
    const geometry::FacetTree tree(skin.places, skin.facets, context);
    const auto check = [&](const Vec3& place, const Vec3& shown) {
        if ((tree.closest(place).point - place).norm() > kFileAccuracy * diagonal) return;
        throw NotSweepable(Message("assembly.not_shared",
                                   "copies touch at {}, where one has a node and the other has none",
                                   place_with_digits(shown, 4))
                               .remedy("give the faces that come together the same quads"));
    };
    const Eigen::Affine3d back = by.inverse();
    for (std::size_t i = 0; i < count; ++i) {
        if (twin[i] < 0) check(points[count + i], points[count + i]);
        if (shared[index(same[i])] == 0) check(back * points[i], points[i]);
    }
    return found;
}

/// Remove sides of the skin from all groups. If only some sides of a patch are removed, these sides become a
/// new patch.
void make_inner(std::vector<sweep::Swept>& parts, std::size_t first, std::span<const OfPart> sides)
{
    std::map<std::pair<std::size_t, Index>, std::vector<Index*>> of_patch;
    for (const OfPart& side : sides) {
        mesh::HexMesh& mesh = parts[first + side.part].mesh;
        const std::size_t i = index(side.number), quads = mesh.quads.size();
        Index& patch = i < quads       ? mesh.source_patch[i]
                       : i < 2 * quads ? mesh.target_patch[i - quads]
                                       : mesh.wall_patch[i - 2 * quads];
        of_patch[{first + side.part, patch}].push_back(&patch);
    }
    for (const auto& [place, patches] : of_patch) {
        sweep::Swept& part = parts[place.first];
        std::size_t all = 0;
        for (const auto* list : {&part.mesh.source_patch, &part.mesh.target_patch, &part.mesh.wall_patch})
            all += static_cast<std::size_t>(std::ranges::count(*list, place.second));
        if (all == patches.size()) {
            part.mesh.patches[index(place.second)].groups.clear();
            continue;
        }
        for (Index* const patch : patches) *patch = static_cast<Index>(part.mesh.patches.size());
        const int tag = std::ranges::max(part.mesh.patches, {}, &mesh::SkinPatch::tag).tag + 1;
        part.mesh.patches.push_back({tag, {}, 0});
        part.faces.emplace_back();
    }
}

/// The bounding box of a mesh, widened by the distance within which near misses are reported.
Eigen::AlignedBox3d box_of(const FilledParts& mesh)
{
    Eigen::AlignedBox3d box;
    for (const sweep::Swept& part : mesh.swept.parts)
        for (const Vec3& p : part.mesh.nodes) box.extend(p);
    const Vec3 slack = Vec3::Constant(kVisible * box.diagonal().norm());
    return {box.min() - slack, box.max() + slack};
}

/// The copies of a mesh, and what they share.
struct Copies {
    std::vector<Eigen::Affine3d> moves; ///< of each copy; the first is the mesh itself
    std::vector<InCommon> common;       ///< at k: nodes and sides that copies share if they are k steps apart
    std::vector<std::string> gaps;      ///< notes about copies that nearly touch
};

Copies find_copies(const FilledParts& mesh, const Eigen::Affine3d& step, std::size_t count,
                   const RunContext& context)
{
    Copies copies{{Eigen::Affine3d::Identity()}, std::vector<InCommon>(count), {}};
    const Eigen::AlignedBox3d box = box_of(mesh);
    std::optional<Skin> skin;
    for (std::size_t k = 1; k < count; ++k) {
        check_cancelled(context);
        const Eigen::Affine3d by = step * copies.moves.back();
        copies.moves.push_back(by);
        if (!box.intersects(box.transformed(by))) continue;
        if (!skin) skin.emplace(mesh);
        const auto near = check_volumes(mesh, moved(mesh, by), static_cast<int>(k), context);
        copies.common[k] = in_common(*skin, by, box.diagonal().norm(), context);
        if (near.empty() || !copies.common[k].nodes.empty()) continue;
        copies.gaps.push_back(
            formatted("note: pattern: copies come within {:.3g} of each other and share no nodes "
                      "there; correct the motion to join them",
                      near.front().least));
        log_line(context, copies.gaps.back());
    }
    return copies;
}

/// Adds the copies of a mesh one by one. A copy takes the nodes that it shares with earlier copies from them.
class PatternMaker {
public:
    PatternMaker(FilledParts mesh, Copies copies, bool numbered)
        : mesh_(std::move(mesh)),
          copies_(std::move(copies)),
          numbered_(numbered),
          parts_(mesh_.regions.size()),
          nodes_(parts_),
          all_(moved(mesh_, copies_.moves.front()))
    {
        for (std::size_t p = 0; p < parts_; ++p) {
            mesh::HexMesh& part = mesh_.swept.parts[p].mesh;
            if (part.order() == 1)
                nodes_[p] = std::make_shared<const std::vector<Vec3>>(std::exchange(part.nodes, {}));
        }
        whole().shared.clear();
        whole().parts.resize(copies_.moves.size() * parts_);
        whole().numbering.clear();
    }

    FilledParts run(const RunContext& context)
    {
        for (std::size_t k = 0; k < copies_.moves.size(); ++k) {
            check_cancelled(context);
            add_parts(k);
            Known known = share(k);
            if (k > 0) place_nodes(k, std::move(known.places));
            number_nodes(k, std::move(known.numbers));
        }
        whole().nodes = index(next_);
        whole().report.insert(whole().report.end(), copies_.gaps.begin(), copies_.gaps.end());
        whole().report.push_back(
            formatted("pattern: {} copies, {} nodes joined", copies_.moves.size(), joined_));
        return std::move(all_);
    }

private:
    /// For each part of a copy, its nodes that earlier copies already have.
    struct Known {
        std::vector<std::vector<std::pair<Index, Index>>> numbers; ///< in the whole mesh
        std::vector<std::vector<std::pair<Index, Vec3>>> places;
    };

    sweep::SweptAssembly& whole() { return all_.swept; }
    sweep::Swept& part_of(std::size_t k, std::size_t p) { return whole().parts[k * parts_ + p]; }

    void add_parts(std::size_t k)
    {
        for (std::size_t p = 0; p < parts_; ++p) {
            sweep::Swept& part = part_of(k, p);
            if (k > 0) {
                part = mesh_.swept.parts[p];
                part.report.clear();
                move(part, copies_.moves[k]);
                all_.regions.push_back(mesh_.regions[p]);
                all_.materials.push_back(mesh_.materials[p]);
            }
            for (io::ColumnSet columns : mesh_.columns) {
                if (k == 0 || columns.part != p) continue;
                columns.part = k * parts_ + p;
                all_.columns.push_back(std::move(columns));
            }
            if (!numbered_) continue;
            std::string& region = all_.regions[k * parts_ + p];
            region = formatted("{}_{}", mesh_.regions[p], k + 1);
            part.mesh.volume_groups.insert(part.mesh.volume_groups.begin(), region);
        }
    }

    /// Make the sides that a copy shares with earlier copies inner ones.
    Known share(std::size_t k)
    {
        Known known{std::vector<std::vector<std::pair<Index, Index>>>(parts_),
                    std::vector<std::vector<std::pair<Index, Vec3>>>(parts_)};
        for (std::size_t d = 1; d <= k; ++d) {
            const InCommon& common = copies_.common[d];
            for (const auto& [own, there] : common.nodes) {
                const std::size_t before = (k - d) * parts_ + there.part;
                known.numbers[own.part].emplace_back(own.number, whole().numbering[before].of(there.number));
                known.places[own.part].emplace_back(own.number, whole().parts[before].skin()[there.number]);
            }
            make_inner(whole().parts, k * parts_, common.of_copy);
            make_inner(whole().parts, (k - d) * parts_, common.of_mesh);
        }
        return known;
    }

    void place_nodes(std::size_t k, std::vector<std::vector<std::pair<Index, Vec3>>> places)
    {
        for (std::size_t p = 0; p < parts_; ++p) {
            sweep::Swept& part = part_of(k, p);
            std::ranges::stable_sort(places[p], {}, &std::pair<Index, Vec3>::first);
            const auto again = std::ranges::unique(places[p], {}, &std::pair<Index, Vec3>::first);
            places[p].erase(again.begin(), again.end());
            if (nodes_[p])
                part.layers = copied_nodes(nodes_[p], index(part.mesh.nodes_per_layer), copies_.moves[k],
                                           std::move(places[p]));
            else
                for (const auto& [node, there] : places[p]) place(part.mesh, node) = there;
        }
    }

    void number_nodes(std::size_t k, std::vector<std::vector<std::pair<Index, Index>>> known)
    {
        for (std::size_t p = 0; p < parts_; ++p) {
            for (const auto& [own, number] : mesh_.swept.numbering[p].known()) {
                const OfPart first = owner(mesh_.swept.numbering, number);
                known[p].emplace_back(own, whole().numbering[k * parts_ + first.part].of(first.number));
            }
            std::ranges::sort(known[p]);
            const auto again = std::ranges::unique(known[p], {}, &std::pair<Index, Index>::first);
            known[p].erase(again.begin(), again.end());
            joined_ += k > 0 ? known[p].size() - mesh_.swept.numbering[p].known().size() : 0;
            const mesh::HexMesh& part = mesh_.swept.parts[p].mesh;
            whole().numbering.emplace_back(next_, std::move(known[p]),
                                           mesh::corner_count(part) + mesh::middle_count(part));
            next_ += static_cast<Index>(whole().numbering.back().fresh());
        }
    }

    FilledParts mesh_;
    Copies copies_;
    bool numbered_; ///< whether the regions of the copies get numbers
    std::size_t parts_;
    /// For each part of order 1, the nodes of the first mesh. Its copies compute their nodes from these.
    std::vector<std::shared_ptr<const std::vector<Vec3>>> nodes_;
    FilledParts all_;
    Index next_ = 0;
    std::size_t joined_ = 0;
};

} // namespace

FilledParts as_parts(const FilledVolume& mesh)
{
    FilledParts parts;
    parts.swept.parts = {mesh.swept};
    parts.swept.nodes = mesh.swept.mesh.node_count();
    parts.swept.numbering.emplace_back(0, std::vector<std::pair<Index, Index>>(), parts.swept.nodes);
    parts.regions = {mesh.swept.mesh.volume_groups.front()};
    parts.materials = {mesh.material};
    parts.unit = mesh.unit;
    parts.copied = mesh.copied;
    parts.columns = mesh.columns;
    return parts;
}

FilledVolume moved(FilledVolume mesh, const Eigen::Affine3d& by, const std::string& name)
{
    move(mesh.swept, by);
    if (!name.empty()) mesh.swept.mesh.volume_groups.front() = name;
    mesh.copied = true;
    return mesh;
}

FilledParts moved(FilledParts mesh, const Eigen::Affine3d& by, const std::string& name)
{
    if (!mesh.tets.empty())
        throw InvalidInput(Message("fill.copy_mixed", "a mesh with tetrahedra cannot be copied")
                               .remedy("copy it in a solver, or mesh it without fallback = \"mixed\""));
    hold_nodes(mesh);
    for (std::size_t p = 0; p < mesh.regions.size(); ++p) {
        move(mesh.swept.parts[p], by);
        if (name.empty()) continue;
        std::string& group = mesh.swept.parts[p].mesh.volume_groups.front();
        if (group == mesh.regions[p]) group = name + "_" + group;
        mesh.regions[p] = name + "_" + mesh.regions[p];
    }
    mesh.swept.near_misses.clear();
    mesh.copied = true;
    return mesh;
}

FilledParts pattern(FilledParts mesh, const Eigen::Affine3d& step, const PatternOptions& options,
                    const RunContext& context)
{
    if (options.count < 1)
        throw InvalidInput(Message("fill.pattern_count",
                                   "a pattern needs at least {} copy, but {} are requested", needed(1),
                                   found(options.count))
                               .remedy("use count = 1 or more"));
    if (!mesh.interfaces.empty())
        throw InvalidInput(Message("fill.split_member", "a mesh that was split cannot be copied in a pattern")
                               .remedy("make the pattern first, and split it"));
    hold_nodes(mesh, context);
    report_progress(context, "copies");
    Copies copies = find_copies(mesh, step, static_cast<std::size_t>(options.count), context);
    return PatternMaker(std::move(mesh), std::move(copies), options.numbered).run(context);
}

} // namespace lacuna::fill
