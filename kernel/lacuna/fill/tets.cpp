// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/tets.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/fill/detail/tet_middles.h>
#include <lacuna/quality/shared/prove_cells.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/sweep/shared/face_patches.h>
#include <lacuna/topology/shared/skin_groups.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace lacuna::fill {

using namespace topology;

namespace {

/// A tetrahedron whose scaled Jacobian is smaller is a sliver, and a note says so. Meshes without narrow
/// places reach 0.1.
constexpr double kSliver = 0.02;

// --- meshes that exist ------------------------------------------------------------------------------------

/// Collects the cells of a skin on one face, and numbers their nodes anew.
class CellsOfFace {
public:
    explicit CellsOfFace(FaceId own) : fixed_{own, {}, {}} {}

    /// @param side  a side of the neighbour's skin; it is turned over
    template <class Place>
    void add(Quad side, const Place& place)
    {
        for (Index& node : side) {
            const auto [at, fresh] = number_.try_emplace(node, static_cast<Index>(fixed_.nodes.size()));
            if (fresh) fixed_.nodes.push_back(place(node));
            node = at->second;
        }
        fixed_.quads.push_back(mesh::turned_over(side));
    }
    surface::FixedFace take() { return std::move(fixed_); }

private:
    surface::FixedFace fixed_;
    std::map<Index, Index> number_;
};

// --- shape ------------------------------------------------------------------------------------------------

/// @throw NotSweepable  the skin deviates from a face, or the volume differs from that of the sealed skin
void require_shape(const sweep::Fidelity& shape, const sweep::SweepOptions& options, FilledTets& tets,
                   const RunContext& context)
{
    if (const auto misfit = sweep::misfit(shape, 0, {options.max_deviation, {}, options.size}))
        throw NotSweepable(misfit->about(tets.region));
    const double off = std::abs(shape.volume / shape.sealed_volume - 1);
    if (off <= kVolumeNoted) return;
    Message message("sweep.volume", "{}: the mesh has {:.2g} % {} volume than the sealed skin", tets.region,
                    100 * off, shape.volume < shape.sealed_volume ? "less" : "more");
    message = std::move(message).remedy("use a smaller 'size'");
    if (!options.size || off > 10 * kVolumeNoted) throw NotSweepable(std::move(message));
    tets.report.push_back(message.text());
    log_line(context, "note: " + message.text());
}

/// Report the options that were given but apply only to sweeps.
void tell_idle_options(const sweep::SweepOptions& options, FilledTets& tets, const RunContext& context)
{
    const std::pair<bool, const char*> given[] = {
        {options.layers.count > 0 || !options.layers.heights.empty(), "layers"},
        {!options.boundary_layers.empty(), "boundary_layers"},
        {!options.intervals.empty(), "intervals"},
        {options.rows > 0, "rows"},
        {options.quads != sweep::Quads::automatic, "quads"}};
    std::vector<std::string> idle;
    for (const auto& [is_given, name] : given)
        if (is_given) idle.emplace_back(name);
    if (idle.empty()) return;
    tets.report.push_back(formatted("tetrahedra do not follow {}",
                                    full_list(idle, [](const std::string& name) { return name; })));
    log_line(context, formatted("note: {}: {}", tets.region, tets.report.back()));
}

// --- cells and skin ---------------------------------------------------------------------------------------

/// Turn the cells that fill a skin into a part of the whole mesh.
void take_cells(const ToFill& what, const surface::SkinMesh& skin, mesh::TetMesh made, FilledTets& tets)
{
    mesh::TetPart& part = tets.mesh;
    part.nodes = std::move(made.nodes);
    part.cells = std::move(made.cells);
    const auto tets_at = std::ranges::stable_partition(part.cells, mesh::is_pyramid);
    part.pyramids = static_cast<std::size_t>(tets_at.begin() - part.cells.begin());
    sweep::FacePatches patches(*what.volume, part.patches);
    for (std::size_t i = 0; i < skin.skin.quads.size(); ++i) {
        part.skin.push_back(skin.skin.quads[i]);
        part.skin_patch.push_back(patches.of(skin.quad_face[i]));
    }
    part.skin_quads = part.skin.size();
    for (std::size_t i = 0; i < skin.skin.triangles.size(); ++i) {
        const Triangle& t = skin.skin.triangles[i];
        part.skin.push_back({t[0], t[1], t[2], t[2]});
        part.skin_patch.push_back(patches.of(skin.triangle_face[i]));
    }
    tets.faces = patches.faces();
    const std::string& name = what.whole.empty() ? what.region : what.whole;
    part.volume_groups = {name};
    if (name != "volume") part.volume_groups.emplace_back("volume");
    if (what.alone) return;
    for (mesh::SkinPatch& patch : part.patches) patch.groups = groups_in_assembly(name, patch.groups);
}

/// @throw NotSweepable  the cells are not a valid mesh, or their skin differs from the one to be filled
void prove(FilledTets& tets, const RunContext& context)
{
    quality::CellsProof proved = quality::prove_cells(tets.mesh.nodes, tets.mesh.cells, context);
    quality::require(proved);
    std::set<Quad> skin;
    for (const Quad& side : proved.skin) skin.insert(face_key(side));
    const bool same = skin.size() == tets.mesh.skin.size() &&
                      std::ranges::all_of(tets.mesh.skin,
                                          [&](const Quad& side) { return skin.contains(face_key(side)); });
    if (!same)
        throw NotSweepable(Message("fill.skin_differs",
                                   "{}: the tetrahedra do not have the skin that they should fill",
                                   tets.region)
                               .remedy("use another 'size'"));
    tets.quality = std::move(proved.quality);
}

void require_quality(const FilledTets& tets, const sweep::SweepOptions& options)
{
    // If the coordinates are written in single precision, a flatter cell may become inverted.
    const double least = std::max(options.min_scaled_jacobian, kFileAccuracy);
    if (tets.quality.min_scaled_jacobian < least)
        throw NotSweepable(Message("quality.below_limit",
                                   "{}: the smallest scaled Jacobian is {:.3g}, below the limit of {:.3g}",
                                   tets.region, found(tets.quality.min_scaled_jacobian), needed(least))
                               .remedy("use a smaller 'size'"));
}

void note_slivers(FilledTets& tets, const RunContext& context)
{
    if (!(tets.quality.min_scaled_jacobian < kSliver)) return;
    tets.report.push_back(formatted("the least scaled Jacobian of the tetrahedra is {:.2g}; a smaller 'size' "
                                    "where faces nearly touch makes better ones",
                                    tets.quality.min_scaled_jacobian));
    log_line(context, formatted("note: {}: {}", tets.region, tets.report.back()));
}

} // namespace

surface::FixedFace cells_on(const mesh::HexMesh& mesh, const std::vector<FaceId>& faces, FaceId there,
                            FaceId own)
{
    CellsOfFace cells(own);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad side = skin_quad(mesh, i);
        if (faces[index(side.patch)] == there)
            cells.add(side.nodes, [&](Index n) { return mesh.node(index(n)); });
    }
    return cells.take();
}

surface::FixedFace cells_on(const FilledTets& mesh, FaceId there, FaceId own)
{
    CellsOfFace cells(own);
    for (std::size_t i = 0; i < mesh.mesh.skin.size(); ++i)
        if (mesh.faces[index(mesh.mesh.skin_patch[i])] == there)
            cells.add(mesh.mesh.skin[i], [&](Index n) { return mesh.mesh.nodes[index(n)]; });
    return cells.take();
}

FilledTets fill_with_tets(const ToFill& what, const sweep::SweepOptions& options, const RunContext& context)
{
    if (!options.tet_mesher)
        throw InvalidInput(
            Message("fill.no_tets",
                    "{}: it must be filled with tetrahedra, but this host has no mesher for them",
                    what.region)
                .remedy("set SweepOptions::tet_mesher, for example to cad::fill_skin"));
    FilledTets tets;
    tets.region = what.region;
    tets.report.push_back(formatted("fallback: filled with tetrahedra, because {}", what.why.text()));
    const OpenVolume& volume = *what.volume;
    const surface::DefaultSize size = surface::default_size(volume);
    if (!options.size) tets.report.push_back(formatted("size: {:.3g}, {}", size.length, size.why));
    tell_idle_options(options, tets, context);
    report_progress(context, "triangles of the skin");
    for (const surface::FixedFace& face : what.fixed) tets.shared += face.quads.size();
    surface::SkinMesh skin = surface::triangulate_skin(
        volume.model, options.size ? options.size : surface::even_size(size.length), what.fixed, context);
    report_progress(context, "tetrahedra", 0.2);
    mesh::TetMesh made = options.tet_mesher(skin.skin, context);
    take_cells(what, skin, std::move(made), tets);
    prove(tets, context);
    std::string order_2;
    if (options.order > 1) {
        report_progress(context, "order 2", 0.8);
        ElevatedTets elevated = elevate(volume.model, tets.mesh, tets.faces, what.middles,
                                        options.second_order, tets.region, context);
        tets.quality = std::move(elevated.quality);
        order_2 = std::move(elevated.report);
    }
    require_quality(tets, options);
    note_slivers(tets, context);
    report_progress(context, "shape of the skin", 0.9);
    tets.fidelity = sweep::compare(volume, tets.mesh, tets.faces, tets.quality.volume,
                                   {options.max_deviation}, context);
    tets.report.push_back(formatted("cells: {} tetrahedra, {} pyramids",
                                    tets.mesh.cells.size() - tets.mesh.pyramids, tets.mesh.pyramids));
    if (!order_2.empty()) tets.report.push_back(std::move(order_2));
    tets.report.push_back(sweep::in_words(tets.fidelity));
    require_shape(tets.fidelity, options, tets, context);
    return tets;
}

namespace {

/// Numbers of the middle nodes of skins. A middle node is identified by the numbers of the corners of its
/// side or quad.
class MiddleNumbers {
public:
    /// Add the numbers of a mesh's middle nodes. @param number number of each node of the mesh
    template <class Mesh>
    void add(const Mesh& mesh, const std::vector<Index>& number)
    {
        each(mesh, number, [&](const auto& corners, Index node) {
            numbers(corners).emplace(corners, number[index(node)]);
        });
    }

    /// For each middle node of a mesh: its number if it is known, otherwise -1. @param number numbers of the
    /// corner nodes
    [[nodiscard]] std::vector<Index> find(const mesh::TetPart& mesh, const std::vector<Index>& number)
    {
        std::vector<Index> found(mesh.middles.nodes.size(), -1);
        each(mesh, number, [&](const auto& corners, Index node) {
            if (const auto at = numbers(corners).find(corners); at != numbers(corners).end())
                found[index(node) - mesh.nodes.size()] = at->second;
        });
        return found;
    }

private:
    template <class Mesh, class Take>
    static void each(const Mesh& mesh, const std::vector<Index>& number, const Take& take)
    {
        for (std::size_t i = 0; mesh.order() > 1 && i < mesh.skin_count(); ++i) {
            const mesh::CellNodes nodes = skin_nodes(mesh, i);
            Quad corners = skin_quad(mesh, i).nodes;
            const std::size_t count = mesh::corner_count(corners);
            for (Index& n : corners) n = number[index(n)];
            for (std::size_t k = 0; k < count; ++k)
                take(rising(Segment{corners[k], corners[(k + 1) % count]}), nodes.node[count + k]);
            if (nodes.count == 9) take(rising(corners), nodes.node[8]);
        }
    }
    std::map<Segment, Index>& numbers(const Segment&) { return sides_; }
    std::map<Quad, Index>& numbers(const Quad&) { return quads_; }

    std::map<Segment, Index> sides_;
    std::map<Quad, Index> quads_;
};

} // namespace

void number_nodes(FilledParts& mesh)
{
    const auto by_place = [](const Vec3& a, const Vec3& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    std::map<Vec3, Index, decltype(by_place)> known(by_place);
    std::set<Quad> sides; // sides of the skins so far
    MiddleNumbers middles;
    const auto is_known = [&](Quad side, const std::vector<Index>& number) {
        for (Index& n : side) n = number[index(n)];
        return !sides.insert(face_key(side)).second;
    };
    for (std::size_t p = 0; p < mesh.swept.parts.size(); ++p) {
        const mesh::HexMesh& part = mesh.swept.parts[p].mesh;
        std::vector<Index> number;
        for (std::size_t n = 0; n < part.node_count(); ++n)
            number.push_back(mesh.swept.numbering[p].of(static_cast<Index>(n)));
        for (std::size_t i = 0; i < part.skin_count(); ++i) {
            const Quad side = skin_quad(part, i).nodes;
            for (const Index n : side) known.emplace(part.nodes[index(n)], number[index(n)]);
            is_known(side, number);
        }
        middles.add(part, number);
    }
    for (FilledTets& tets : mesh.tets) {
        std::vector<char> on_skin(tets.mesh.nodes.size(), 0);
        for (const Quad& side : tets.mesh.skin)
            for (const Index n : side) on_skin[index(n)] = 1;
        for (std::size_t n = 0; n < tets.mesh.nodes.size(); ++n) {
            const auto next = static_cast<Index>(mesh.swept.nodes);
            const Index own = on_skin[n] != 0 ? known.emplace(tets.mesh.nodes[n], next).first->second : next;
            if (own == next) ++mesh.swept.nodes;
            tets.number.push_back(own);
        }
        for (Index own : middles.find(tets.mesh, tets.number)) {
            if (own < 0) own = static_cast<Index>(mesh.swept.nodes++);
            tets.number.push_back(own);
        }
        middles.add(tets.mesh, tets.number);
        const auto shared = std::ranges::count_if(
            tets.mesh.skin, [&](const Quad& side) { return is_known(side, tets.number); });
        if (static_cast<std::size_t>(shared) != tets.shared)
            throw NotSweepable(
                Message("fill.not_shared",
                        "{}: {} sides of its skin are shared with its neighbours, but {} should be",
                        tets.region, found(shared), needed(tets.shared))
                    .remedy("sweep with fallback = \"leave_out\""));
    }
}

} // namespace lacuna::fill
