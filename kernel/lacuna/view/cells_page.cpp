// SPDX-License-Identifier: MIT
#include <lacuna/view/page.h>

#include <lacuna/quality/shared/metrics.h>
#include <lacuna/view/detail/base64.h>
#include <lacuna/view/detail/cell_set.h>
#include <lacuna/view/detail/page_file.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

namespace lacuna::view {

namespace {

/// Values in units of 1e-4, as the page expects them; `kNoValue` of `page/cells.js` for NaN.
std::vector<Index> rounded(const std::vector<double>& values)
{
    constexpr double kParts = 10000;
    std::vector<Index> whole;
    whole.reserve(values.size());
    for (const double value : values)
        whole.push_back(std::isnan(value) ? Index{std::numeric_limits<std::int16_t>::min()}
                                          : static_cast<Index>(std::lround(value * kParts)));
    return whole;
}

template <std::size_t N>
std::vector<Index> flat(const std::vector<std::array<Index, N>>& rows)
{
    std::vector<Index> numbers;
    numbers.reserve(N * rows.size());
    for (const auto& row : rows) numbers.insert(numbers.end(), row.begin(), row.end());
    return numbers;
}

/// Patch numbers of one region, shifted by `first` to number the patches of all regions.
std::vector<Index> shifted(std::vector<Index> patches, Index first)
{
    for (Index& patch : patches)
        if (patch >= 0) patch += first;
    return patches;
}

void add_swept(Json& json, const Region& region, const Grid& grid, Index first_patch,
               const RunContext& context)
{
    const mesh::HexMesh& mesh = *region.mesh;
    const auto stride = index(mesh.nodes_per_layer);
    json.begin_object().member("name", region.name).member("swept", true);
    json.member("layers", mesh.layers).member("perLayer", mesh.nodes_per_layer);
    json.member("quadCount", mesh.quads.size()).member("quads", pack(flat(mesh.quads), 4));
    json.member("rimCount", mesh.rim.size()).member("rim", pack(flat(mesh.rim), 2));
    add_nodes(json.key("nodes"), grid, mesh.nodes, stride);
    json.member("sourcePatch", pack(shifted(mesh.source_patch, first_patch), 1));
    json.member("targetPatch", pack(shifted(mesh.target_patch, first_patch), 1));
    json.member("wallPatch", pack(shifted(mesh.wall_patch, first_patch), mesh.rim.size()));
    json.member("values",
                pack(rounded(quality::metric_values(mesh, quality::Metric::scaled_jacobian, context)),
                     mesh.quads.size()));
    if (mesh.order() == 2) {
        const mesh::MiddleNodes& middles = mesh.middles;
        json.key("middles").begin_object();
        json.member("full", middles.full).member("sideCount", middles.sides.size());
        json.member("sideOf", pack(flat(middles.side_of), 4));
        const mesh::MiddlePlaces places(mesh);
        add_nodes(json.key("nodes"), grid, middles.nodes, places.side(1, 0));
        json.end_object();
    }
    json.end_object();
}

void add_listed(Json& json, const ListedCells& region, const Grid& grid)
{
    json.begin_object().member("name", region.name).member("swept", false);
    json.member("count", region.cells.size()).member("cells", pack(flat(region.cells), 8));
    json.member("curved", !region.curved.empty());
    if (!region.curved.empty()) {
        std::vector<std::array<Index, 12>> middles;
        for (const mesh::CellNodes& cell : region.curved) {
            middles.emplace_back().fill(-1);
            if (cell.count > 0) std::copy_n(cell.node.begin() + 8, 12, middles.back().begin());
        }
        json.member("sideMiddles", pack(flat(middles), 12));
    }
    json.member("tags", pack(region.tags, 1)).member("values", pack(rounded(region.quality), 1));
    json.member("sideCount", region.sides.size()).member("sides", pack(flat(region.sides), 4));
    json.member("sidePatch", pack(region.side_patch, 1));
    add_nodes(json.key("nodes"), grid, region.nodes, 1);
    json.end_object();
}

/// @param add_regions  writes the regions as elements of an array.
void write_cells(const std::string& title, const std::vector<std::string>& facts, const Grid& grid,
                 const std::vector<ShownPatch>& patches, const std::function<void(Json&)>& add_regions,
                 const io::OutputPath& path)
{
    Json json;
    json.begin_object().member("kind", "cells").member("title", title).member("facts", facts);
    add_frame(json, grid);
    json.key("patches").begin_array();
    for (const ShownPatch& patch : patches)
        json.begin_object()
            .member("tag", patch.tag)
            .member("groups", patch.groups)
            .member("void", patch.made_void)
            .member("quads", patch.quads)
            .end_object();
    json.end_array().key("regions").begin_array();
    add_regions(json);
    json.end_array().end_object();
    write_html(json, path);
}

} // namespace

void write_page(std::span<const Region> regions, const io::OutputPath& path, const PageOptions& options,
                const RunContext& context)
{
    Eigen::AlignedBox3d box;
    std::size_t hexes = 0, wedges = 0, nodes = 0;
    int order = 1;
    for (const Region& region : regions) {
        for (const Vec3& node : region.mesh->nodes) box.extend(node);
        for (const Vec3& node : region.mesh->middles.nodes) box.extend(node);
        hexes += region.mesh->hex_count();
        wedges += region.mesh->wedge_count();
        nodes += region.mesh->node_count();
        order = std::max(order, region.mesh->order());
    }
    const Grid grid = grid_over(box);
    std::vector<std::string> facts{counted(hexes, "hex")};
    if (wedges > 0) facts.push_back(counted(wedges, "wedge"));
    if (regions.size() == 1) facts.push_back(counted(nodes, "node"));
    if (regions.size() == 1)
        facts.push_back(counted(static_cast<std::size_t>(regions[0].mesh->layers), "layer"));
    if (regions.size() > 1) facts.push_back(counted(regions.size(), "region"));
    if (order == 2) facts.emplace_back("order 2");

    std::vector<Index> first_patch;
    std::vector<ShownPatch> patches;
    for (const Region& region : regions) {
        first_patch.push_back(static_cast<Index>(patches.size()));
        std::ranges::move(shown_patches(*region.mesh), std::back_inserter(patches));
    }
    const auto add_regions = [&](Json& json) {
        for (std::size_t r = 0; r < regions.size(); ++r) {
            check_cancelled(context);
            add_swept(json, regions[r], grid, first_patch[r], context);
        }
    };
    write_cells(options.title.empty() ? regions.front().name : options.title, facts, grid, patches,
                add_regions, path);
}

void write_page(const io::Deck& deck, const io::OutputPath& path, const PageOptions& options,
                const RunContext& context)
{
    const DeckCells cells = listed_cells(deck, context);
    Eigen::AlignedBox3d box;
    std::size_t count = 0;
    for (const ListedCells& region : cells.regions) {
        for (const Vec3& node : region.nodes) box.extend(node);
        count += region.cells.size();
    }
    const Grid grid = grid_over(box);
    std::vector<std::string> facts{counted(count, "cell")};
    if (cells.regions.size() > 1) facts.push_back(counted(cells.regions.size(), "region"));
    if (cells.second_order) facts.emplace_back("order 2");
    if (cells.straightened) facts.emplace_back("some of order 2 drawn by their corners");

    const auto add_regions = [&](Json& json) {
        for (const ListedCells& region : cells.regions) {
            check_cancelled(context);
            add_listed(json, region, grid);
        }
    };
    write_cells(options.title.empty() ? deck.path : options.title, facts, grid, cells.patches, add_regions,
                path);
}

} // namespace lacuna::view
