// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/thickness_report.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/topology/shared/names_of.h>

namespace lacuna::sweep {

using namespace topology;

void report_thickness(const topology::Model& model, const surface::LayerTables& tables, int table,
                      const ReachedThickness& there, const ReachedThickness& shared,
                      std::vector<std::string>& lines)
{
    if (!there.face.valid() && there.asked == 0) return;
    std::vector<FaceId> faces;
    for (const auto& [face, own] : tables.of)
        if (own == table) faces.push_back(face);
    const std::vector<double>& heights = tables.heights[index(table)];
    if (there.off > kVolumeNoted) {
        throw NotSweepable(Message("sweep.layers_thickness",
                                   "the boundary layers of {} are {:.2g} thick instead of {:.2g} near "
                                   "{}: their nodes have no room to move, or are given",
                                   entity_of(model, there.face), found(there.off_found),
                                   needed(there.off_asked), place_in_short(there.where))
                               .remedy("use fewer or thinner rows, or a smaller 'size'"));
    }
    lines.push_back(formatted(
        "boundary layers of {}: {} {}, the first {:.2g} to {:.2g} thick ({:.2g} asked), "
        "each within {:.2g} % of its thickness, {:.2g} in all{}",
        entities_of(model, faces), heights.size(), heights.size() == 1 ? "row" : "rows", there.least,
        there.most, there.asked, 100 * there.off, heights.back(),
        shared.off > kVolumeNoted
            ? formatted("; {:.2g} to {:.2g} at faces shared with neighbours", shared.least, shared.most)
            : std::string()));
}

} // namespace lacuna::sweep
