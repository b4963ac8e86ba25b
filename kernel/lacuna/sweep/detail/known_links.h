// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/linking_surface.h>
#include <lacuna/topology/open_volume.h>

#include <array>
#include <optional>
#include <vector>

namespace lacuna::sweep {

/// The linking surfaces of one volume, found once for either end it is swept from: whoever plans its layers
/// asks for the same ones as each try of its sweep.
class KnownLinks {
public:
    /// @param volume  always the same one, or that one turned round.
    /// @throw  as `surface::linking_surfaces()`; nothing is kept then.
    const std::vector<surface::LinkingSurface>& of(const topology::OpenVolume& volume,
                                                   const RunContext& context)
    {
        std::optional<std::vector<surface::LinkingSurface>>& links = links_[volume.turned_round ? 1 : 0];
        if (!links) links = surface::linking_surfaces(volume, surface::Turning::each, {}, context);
        return *links;
    }

private:
    std::array<std::optional<std::vector<surface::LinkingSurface>>, 2> links_;
};

} // namespace lacuna::sweep
