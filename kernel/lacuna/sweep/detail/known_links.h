// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/linking_surface.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <utility>
#include <vector>

namespace lacuna::sweep {

/// The linking surfaces of one volume, found once: whoever plans its layers asks for the same ones as each
/// try of its sweep. Those of the volume turned round are found when they are asked for: they refer to that
/// volume, which lives no longer than a try.
class KnownLinks {
public:
    /// @param volume  outlives this.
    explicit KnownLinks(const topology::OpenVolume& volume) : volume_(volume) {}

    /// @return  for as long as `way` lives and until the next call for another one that is not the volume.
    /// @throw  as `surface::linking_surfaces()`; nothing is kept then.
    const std::vector<surface::LinkingSurface>& of(const topology::OpenVolume& way, const RunContext& context)
    {
        const bool own = &way == &volume_;
        if (!own || !own_) {
            auto found = surface::linking_surfaces(way, surface::Turning::each, {}, context);
            (own ? own_ : other_) = std::move(found);
        }
        return own ? *own_ : *other_;
    }

private:
    const topology::OpenVolume& volume_;
    std::optional<std::vector<surface::LinkingSurface>> own_, other_;
};

} // namespace lacuna::sweep
