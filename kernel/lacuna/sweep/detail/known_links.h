// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/linking_surface.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <vector>

namespace lacuna::sweep {

/// The linking surfaces of one volume, found once: whoever plans its layers asks for the same ones as each
/// try of its sweep.
class KnownLinks {
public:
    /// @param volume  outlives this and stays where and as it is: linking surfaces refer to its model.
    explicit KnownLinks(const topology::OpenVolume& volume) : volume_(volume) {}

    /// @param volume  any; those of another one, as a copy that was turned round, are found each time.
    /// @throw  as `surface::linking_surfaces()`; nothing is kept then.
    std::vector<surface::LinkingSurface> of(const topology::OpenVolume& volume, const RunContext& context)
    {
        const auto find = [&] {
            return surface::linking_surfaces(volume, surface::Turning::each, {}, context);
        };
        if (&volume != &volume_) return find();
        if (!links_) links_ = find();
        return *links_;
    }

private:
    const topology::OpenVolume& volume_;
    std::optional<std::vector<surface::LinkingSurface>> links_;
};

} // namespace lacuna::sweep
