// SPDX-License-Identifier: MIT
#include "support/prove_cells.h"

#include <lacuna/core/shared/same_corners.h>
#include <lacuna/quality/detail/findings.h>
#include <lacuna/quality/shared/prove_cells.h>

#include <algorithm>
#include <vector>

namespace lacuna::test {

using namespace quality;

namespace {

std::vector<Quad> sorted(std::span<const Quad> skin)
{
    std::vector<Quad> sides;
    for (const Quad& side : skin) sides.push_back(rising(side));
    for (Quad& side : sides) // a triangle by its three nodes, whichever is repeated
        if (const auto twice = std::ranges::adjacent_find(side); twice != side.end()) {
            std::rotate(twice, twice + 1, side.end());
            side[3] = -1;
        }
    std::ranges::sort(sides);
    return sides;
}

} // namespace

Proof prove_cells(std::span<const Vec3> nodes, std::span<const Hex> hexes, std::span<const Quad> skin,
                  double min_scaled_jacobian, const RunContext& context)
{
    CellsProof proof = quality::prove_cells(nodes, hexes, context);
    if (!proof.finding && !skin.empty() && sorted(skin) != sorted(proof.skin))
        proof.finding = Finding(Fault::skin_differs, "the given skin is not the skin of the cells");
    if (!proof.finding) proof.finding = check_quality(proof.quality, min_scaled_jacobian, 0);
    return proof;
}

} // namespace lacuna::test
