// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/facet_sag.h>

#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/topology/shared/facet_area.h>

#include <algorithm>
#include <unordered_map>

namespace lacuna::topology {

// Two facets that meet at an angle approximate an arc. The arc deviates from them by about an eighth of that
// angle times the height of a facet over the common side.
double facet_sag(const Model& model, const Face& face)
{
    double sag = 0;
    std::unordered_map<std::uint64_t, std::size_t> beside;
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = face.triangles[t][k], b = face.triangles[t][(k + 1) % 3];
            const auto [other, fresh] = beside.emplace(edge_key(a, b), t);
            if (fresh) continue;
            const Vec3 m = facet_area_vector(model, face.triangles[t]),
                       n = facet_area_vector(model, face.triangles[other->second]);
            const double side = (model.at(b) - model.at(a)).norm();
            if (!(m.norm() > 0) || !(n.norm() > 0) || !(side > 0)) continue;
            const double angle = geometry::angle_between(m, n);
            sag = std::max(sag, angle / 8 * 2 * std::max(m.norm(), n.norm()) / side);
        }
    }
    return sag;
}

} // namespace lacuna::topology
