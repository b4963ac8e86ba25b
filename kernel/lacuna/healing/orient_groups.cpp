// SPDX-License-Identifier: MIT
#include <lacuna/healing/shared/orient_groups.h>

#include <lacuna/topology/open_volume.h>

#include <map>

namespace lacuna::healing {

namespace {

/// A facet side on the border of a face. `forward`: whether the facet uses it from the lower to the higher
/// point.
struct BorderUse {
    FaceId face;
    bool forward;
};
using Borders = std::map<std::pair<Index, Index>, std::vector<BorderUse>>;

Borders borders_of(const topology::Model& model, const std::vector<std::size_t>& group)
{
    Borders borders;
    for (const std::size_t f : group) {
        // A side inside a face occurs once in each direction, so the sum is 0; on the border it is not.
        std::map<std::pair<Index, Index>, int> net;
        for (const Triangle& t : model.faces[f].triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k];
                const Index b = t[(k + 1) % 3];
                net[std::minmax(a, b)] += a < b ? 1 : -1;
            }
        }
        for (const auto& [side, sum] : net) {
            if (sum != 0) borders[side].push_back({FaceId(f), sum > 0});
        }
    }
    return borders;
}

/// Connected faces of a group.
struct Part {
    std::vector<FaceId> faces;
    bool agrees = true;
    bool closed = true;
};

Part flood(FaceId start, const std::map<FaceId, std::vector<std::pair<FaceId, bool>>>& neighbours,
           std::map<FaceId, bool>& turned)
{
    Part part{{start}, true, true};
    turned[start] = false;
    for (std::size_t i = 0; i < part.faces.size(); ++i) {
        const auto found = neighbours.find(part.faces[i]);
        if (found == neighbours.end()) continue;
        for (const auto& [other, alike] : found->second) {
            // Consistently oriented facets traverse a shared side in opposite directions.
            const bool turn = alike != turned[part.faces[i]];
            const auto [place, fresh] = turned.try_emplace(other, turn);
            if (fresh) {
                part.faces.push_back(other);
            } else if (place->second != turn) {
                part.agrees = false;
            }
        }
    }
    return part;
}

} // namespace

void orient_groups(topology::ModelBuilder& model, const std::vector<std::vector<std::size_t>>& groups)
{
    for (const std::vector<std::size_t>& group : groups) {
        std::map<FaceId, std::vector<std::pair<FaceId, bool>>> neighbours;
        std::map<FaceId, bool> open;
        for (const auto& [side, uses] : borders_of(model, group)) {
            if (uses.size() != 2) {
                for (const BorderUse& use : uses) open[use.face] = true;
                continue;
            }
            const bool alike = uses[0].forward == uses[1].forward;
            neighbours[uses[0].face].emplace_back(uses[1].face, alike);
            neighbours[uses[1].face].emplace_back(uses[0].face, alike);
        }
        std::map<FaceId, bool> turned;
        for (const std::size_t start : group) {
            if (turned.contains(FaceId(start))) continue;
            Part part = flood(FaceId(start), neighbours, turned);
            if (!part.agrees) continue;
            for (const FaceId f : part.faces) {
                if (turned[f]) model.flip(f);
                part.closed = part.closed && !open.contains(f);
            }
            if (part.closed && volume_integral(model, part.faces) < 0)
                for (const FaceId f : part.faces) model.flip(f);
        }
    }
}

} // namespace lacuna::healing
