// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/words.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/sweep/detail/volume_share.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

void add_note(Swept& swept, std::string note)
{
    swept.report.push_back("note: " + note);
    swept.notes.push_back(std::move(note));
}

/// Report poor cells, with suggestions.
std::string poor_in_words(double least)
{
    return formatted(
        "the least scaled Jacobian is {:.2g}; check the shape for a corner that sharp, try another 'size', "
        "or set 'min_scaled_jacobian' to refuse such meshes",
        least);
}

/// Report the volume difference, and the 'size' and 'layers' that should keep it within 1 %. The error of
/// straight sides grows with the square of their length. The suggestion aims at half of the limit, because on
/// bends and barrels the actual error was up to 1.6 times the estimate. A size does not change quads that are
/// kept.
std::string volume_in_words(const Swept& swept, const OpenVolume& volume, const SweepOptions& options)
{
    const double lost = volume_lost(swept.fidelity), part = std::sqrt(kSameVolume / 2 / std::abs(lost));
    double length = 0;
    for (const Segment& side : swept.mesh.rim)
        length += (swept.mesh.nodes[index(side[1])] - swept.mesh.nodes[index(side[0])]).norm();
    const bool keeps = (options.quads == Quads::automatic || options.quads == Quads::keep) &&
                       std::ranges::any_of(volume.faces(Role::source), [&](FaceId face) {
                           const topology::Face& own = volume.model[face];
                           return own.keeps_nodes && topology::has_cells_to_keep(own, options.wedges);
                       });
    return formatted(
        "the mesh has {:.2g} % {} volume than the sealed shape; {}size = {:.2g} and layers = {} should keep "
        "the difference within 1 %{} [sweep.volume]",
        100 * std::abs(lost), lost > 0 ? "less" : "more", keeps ? "quads = \"paved\", " : "",
        part * length / static_cast<double>(swept.mesh.rim.size()),
        static_cast<int>(std::ceil(swept.mesh.layers / part)),
        keeps ? ", or the layers alone if the bends are along the sweep: the given quads of the source are "
                "kept, whatever the size"
              : "");
}

} // namespace

std::string place_in_short(const Vec3& p) { return place_with_digits(p, 2); }

void note_poor_cells(Swept& swept)
{
    if (swept.min_scaled_jacobian < kPoorCell) add_note(swept, poor_in_words(swept.min_scaled_jacobian));
}

void note_lost_volume(Swept& swept, const OpenVolume& volume, const SweepOptions& options)
{
    if (std::abs(volume_lost(swept.fidelity)) > kVolumeNoted)
        add_note(swept, volume_in_words(swept, volume, options));
}

} // namespace lacuna::sweep
