// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_patch.h>

#include <lacuna/quads/detail/patch_template.h>

namespace lacuna::quads::paving {

bool fill_patch(PartialMesh& partial, const Cycle& cycle, std::span<const std::size_t> corners)
{
    if (!can_fill(side_counts(cycle.size(), corners))) return false;
    const TemplateMesh filling = fill_template(region_within(partial.points, {cycle}).region.points, corners);
    add_filling(partial.points, partial.quads, cycle, filling.inner, filling.quads);
    const auto n = static_cast<Index>(cycle.size());
    for (const Quad& quad : filling.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [a, b] = std::minmax(quad[k], quad[(k + 1) % 4]);
            // The side leads across the patch between two nodes that existed before.
            if (b < n && b - a > 1 && b - a < n - 1) partial.link(cycle[index(a)], cycle[index(b)]);
        }
    }
    return true;
}

void fill_small(PartialMesh& partial, const Cycle& c)
{
    if (c.size() == 4) {
        partial.quads.push_back({c[0], c[1], c[2], c[3]});
        return;
    }
    std::vector<Quad> best;
    double best_worst = -2;
    for (std::size_t i = 0; i < 3; ++i) {
        const Quad one{c[i], c[i + 1], c[i + 2], c[i + 3]};
        const Quad two{c[i + 3], c[(i + 4) % 6], c[(i + 5) % 6], c[i]};
        const double worst = std::min(least_sine(partial, one), least_sine(partial, two));
        if (worst <= best_worst || one[0] == one[3] || partial.linked(one[0], one[3])) continue;
        best_worst = worst;
        best = {one, two};
    }
    // Use three quads around a node in the middle, if two quads would be flat.
    Vec2 middle = Vec2::Zero();
    for (const Index p : c) middle += partial.at(p) / 6;
    const Index centre = partial.add(middle);
    bool used = false;
    for (std::size_t i = 0; i < 2; ++i) {
        std::vector<Quad> three;
        double worst = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t at = i + 2 * k;
            three.push_back({c[at % 6], c[(at + 1) % 6], c[(at + 2) % 6], centre});
            worst = std::min(worst, least_sine(partial, three.back()));
        }
        // Three quads are used only if they clearly improve the worst quad.
        if (!best.empty() && worst <= best_worst + 0.3) continue;
        best_worst = worst + 0.3;
        best = three;
        used = true;
    }
    if (!used) {
        partial.points.pop_back();
        partial.link(best.front()[0], best.front()[3]);
    }
    partial.quads.insert(partial.quads.end(), best.begin(), best.end());
}

} // namespace lacuna::quads::paving
