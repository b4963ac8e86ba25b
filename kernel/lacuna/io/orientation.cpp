// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_view.h>

#include <lacuna/io/detail/cell_shapes.h>

#include <algorithm>
#include <utility>

namespace lacuna::io {

void add_orientation(std::span<const BulkPart> parts, bool fields, mesh::MeshView& view)
{
    using mesh::CellFrame;
    auto frames = std::make_shared<std::vector<std::vector<CellFrame>>>(view.blocks.size());
    for (const BulkPart& part : parts) {
        const std::vector<CellFrame> own = mesh::cell_frames(part.mesh);
        for (const std::size_t kind : {std::size_t(0), std::size_t(1)}) {
            const auto block = std::ranges::find(view.blocks, part.cells.shapes()[kind],
                                                 &mesh::MeshView::Block::shape);
            for (std::size_t i = 0; i < part.cells.count[kind]; ++i)
                (*frames)[static_cast<std::size_t>(block - view.blocks.begin())].push_back(
                    own[part.cells.cell(kind, i)]);
        }
    }
    for (std::size_t b = 0; b < view.blocks.size(); ++b) // cells without thickness come last and have no
                                                         // directions
        if (!(*frames)[b].empty()) (*frames)[b].resize(view.blocks[b].count);
    view.frames = frames;
    if (!fields) return;
    const std::pair<const char*, Vec3 CellFrame::*> all[] = {{"column", &CellFrame::column},
                                                             {"axis", &CellFrame::axis},
                                                             {"radial", &CellFrame::radial},
                                                             {"tangential", &CellFrame::tangential}};
    for (const auto& [name, direction] : all)
        view.fields.push_back(
            {name,
             [frames, direction = direction](std::size_t b, std::size_t begin, std::size_t end, double* out) {
                 const std::vector<CellFrame>& of = (*frames)[b];
                 for (; begin < end; ++begin) { // skin quads have no directions
                     const Vec3 v = of.empty() ? Vec3(Vec3::Zero()) : of[begin].*direction;
                     for (const double x : v) *out++ = x;
                 }
             },
             3});
}

} // namespace lacuna::io
