// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/detail/size_words.h>
#include <lacuna/sweep/detail/volume_share.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <optional>
#include <vector>

namespace lacuna::sweep {

/// The linking surfaces of one volume, the numbers that keep its volume and the sizes of its quads, found
/// once: whoever plans its layers asks for the same ones as each try of its sweep.
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

    VolumePlan plan; ///< by default nothing

    /// Where the sizes for so many sides for a turn are kept; null: not of another volume.
    std::optional<SourceSize>* sizes(const topology::OpenVolume& volume, int per_turn)
    {
        return &volume == &volume_ ? &sizes_[per_turn] : nullptr;
    }

private:
    const topology::OpenVolume& volume_;
    std::map<int, std::optional<SourceSize>> sizes_;
    std::optional<std::vector<surface::LinkingSurface>> links_;
};

} // namespace lacuna::sweep
