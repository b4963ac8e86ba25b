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

/// A cache of one volume's linking surfaces, volume plan and quad sizes, which layer planning and each sweep
/// attempt need.
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
