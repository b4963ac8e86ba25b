// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/detail/size_words.h>
#include <lacuna/sweep/detail/turned_round.h>
#include <lacuna/sweep/detail/volume_share.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace lacuna::sweep {

/// Data that the plans of one volume share, each computed when it is first needed: the volume with its ends
/// exchanged, the linking surfaces, the sizes, and the numbers of sides and layers that keep the volume of
/// the mesh within its bound.
class KnownLinks {
public:
    /// @param volume  must outlive this object, and must not move or change: linking surfaces refer to its
    ///         model.
    explicit KnownLinks(const topology::OpenVolume& volume) : volume_(volume) {}

    /// The volume with source and target exchanged.
    const topology::OpenVolume& turned()
    {
        if (!turned_) turned_ = turned_round(volume_);
        return *turned_;
    }

    /// @param volume  the volume or `turned()`.
    /// @throw  as `surface::linking_surfaces()`; nothing is cached then.
    const std::vector<surface::LinkingSurface>& of(const topology::OpenVolume& volume,
                                                   const RunContext& context,
                                                   surface::Turning turning = surface::Turning::each)
    {
        const auto found = links_.find({&volume, turning});
        if (found != links_.end()) return found->second;
        return links_[{&volume, turning}] = surface::linking_surfaces(volume, turning, {}, context);
    }

    VolumePlan plan; ///< default-constructed: no requirements

    /// Storage for the sizes at a number of sides per full turn. @param volume  as in `of()`
    std::optional<SourceSize>& sizes(const topology::OpenVolume& volume, int per_turn)
    {
        return sizes_[{&volume, per_turn}];
    }

private:
    const topology::OpenVolume& volume_;
    std::optional<topology::OpenVolume> turned_;
    std::map<std::pair<const topology::OpenVolume*, int>, std::optional<SourceSize>> sizes_;
    std::map<std::pair<const topology::OpenVolume*, surface::Turning>, std::vector<surface::LinkingSurface>>
        links_;
};

} // namespace lacuna::sweep
