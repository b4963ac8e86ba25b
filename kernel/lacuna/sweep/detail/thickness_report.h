// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/types.h>
#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

/// Thickness of boundary layers in a mesh. Internal to this folder.
namespace lacuna::sweep {

/// The thickness that the rows of one table have reached [model length].
struct ReachedThickness {
    double asked = 0, least = kInfinity, most = 0;
    double off = 0; ///< largest relative thickness error
    double off_asked = 0, off_found = 0;
    Vec3 where = Vec3::Zero();
    FaceId face;

    void add(double wanted, double found, const Vec3& place, FaceId on, bool first)
    {
        if (first) {
            asked = wanted;
            least = std::min(least, found);
            most = std::max(most, found);
        }
        const double share = std::abs(found - wanted) / wanted;
        if (!(share <= off)) {
            off = share;
            off_asked = wanted;
            off_found = found;
            where = place;
            face = on;
        }
    }
};

/// Add a line on the rows of a table to a report.
/// @param shared  the thickness at nodes that neighbours share, which is reported only
/// @throw NotSweepable "sweep.layers_thickness"  a row is thicker or thinner than requested.
void report_thickness(const topology::Model& model, const surface::LayerTables& tables, int table,
                      const ReachedThickness& reached, const ReachedThickness& shared,
                      std::vector<std::string>& lines);

} // namespace lacuna::sweep
