// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/linking_surface.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <vector>

namespace lacuna::sweep {

/// A cache of one volume's linking surfaces, which layer planning and each sweep attempt need.
class KnownLinks {
public:
    /// @param volume  must outlive this and must not move or change: linking surfaces refer to its model.
    explicit KnownLinks(const topology::OpenVolume& volume) : volume_(volume) {}

    /// @param volume  any; for others, such as a reversed copy, the linking surfaces are computed each time.
    /// @throw  as `surface::linking_surfaces()`; nothing is cached then.
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
