// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/view_piece.h>

#include <algorithm>
#include <array>

namespace lacuna::io {

using mesh::MeshView;
using mesh::Ranges;

PieceView piece_of(const std::shared_ptr<const MeshView>& whole, const mesh::ViewParts& parts, Index part)
{
    struct Piece {
        std::vector<Ranges> cells; ///< cells of the piece in each block of the whole view
        Ranges points;
    };
    const auto piece = std::make_shared<Piece>();
    const auto view = std::make_shared<MeshView>(*whole);
    PieceView result{view, {}, {}};
    std::size_t before = 0; // cells of the whole view before a block
    for (std::size_t b = 0; b < whole->blocks.size(); before += whole->blocks[b++].count) {
        const MeshView::Block& from = whole->blocks[b];
        std::vector<std::array<std::size_t, 3>> found; // first, last, whether ghosts
        mesh::each_run(parts.of[b], 0, from.count, [&](std::size_t first, std::size_t last, Index of) {
            if (of == part) found.push_back({first, last, 0});
        });
        for (const mesh::ViewParts::Ghosts& ghosts : parts.ghosts)
            if (ghosts.block == b && std::ranges::binary_search(ghosts.of, part))
                ghosts.cells.each(0, ghosts.cells.count(), [&](std::size_t first, std::size_t last) {
                    found.push_back({first, last, 1});
                });
        std::ranges::sort(found);
        Ranges& cells = piece->cells.emplace_back();
        mesh::Runs& ghosts = result.ghost_cells.emplace_back();
        MeshView::Block& own = view->blocks[b];
        own.entities.clear();
        own.regions.clear();
        Ranges tags;
        for (const auto& [first, last, ghost] : found) {
            mesh::each_run(from.entities, first, last, [&](std::size_t low, std::size_t high, Index entity) {
                cells.add(low, high);
                mesh::add_run(own.entities, cells.count(), entity);
            });
            mesh::add_run(ghosts, cells.count(), static_cast<Index>(ghost));
            from.tags.each(first, last, [&](std::size_t, std::int64_t number) {
                const std::size_t tag = static_cast<std::size_t>(number) + (from.tags.given() ? 0 : before);
                tags.add(tag, tag + 1);
            });
        }
        own.count = cells.count();
        own.tags = mesh::Numbers(std::move(tags));
        own.nodes = [whole, piece, b](std::size_t begin, std::size_t end, Index* out) {
            piece->cells[b].each(begin, end, [&](std::size_t first, std::size_t last) {
                whole->blocks[b].each_cell(first, last, [&](std::size_t, std::span<const Index> nodes) {
                    for (const Index node : nodes)
                        *out++ = static_cast<Index>(piece->points.position(index(node)));
                });
            });
        };
    }
    piece->points = parts.used[index(part)];
    const auto owned = std::ranges::find(parts.points, part, &std::pair<Index, Ranges>::first);
    Ranges tags;
    piece->points.each(0, piece->points.count(), [&](std::size_t first, std::size_t last) {
        whole->point_tags.each(first, last, [&](std::size_t p, std::int64_t number) {
            const auto tag = static_cast<std::size_t>(number);
            tags.add(tag, tag + 1);
            const bool own = owned != parts.points.end() && owned->second.contains(p);
            mesh::add_run(result.ghost_points, tags.count(), own ? 0 : 1);
        });
    });
    view->points = piece->points.count();
    view->point_tags = mesh::Numbers(std::move(tags));
    view->each_point = [whole, piece](std::size_t begin, std::size_t end, const MeshView::TakePoints& take) {
        piece->points.each(
            begin, end, [&](std::size_t first, std::size_t last) { whole->each_point(first, last, take); });
    };
    for (std::size_t f = 0; f < view->fields.size(); ++f)
        view->fields[f].values = [whole, piece, f](std::size_t b, std::size_t begin, std::size_t end,
                                                   double* out) {
            piece->cells[b].each(begin, end, [&](std::size_t first, std::size_t last) {
                whole->fields[f].values(b, first, last, out);
                out += (last - first) * whole->fields[f].components;
            });
        };
    return result;
}

} // namespace lacuna::io
