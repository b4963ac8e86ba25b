// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/assembly.h>

#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

/// Heights of layers of members that share parts of walls. Internal to this folder.
namespace lacuna::sweep {

/// Levels of an assembly: heights at which a layer must end, because an edge runs around the walls there.
///
/// Examples are a pin that stands out of a plate, or a band around the middle of a pin. On a shared wall,
/// both members must have the same rows of quads. Therefore each member gets the levels that the other member
/// has within the wall, and corresponding intervals between levels get equal numbers of layers in both
/// members. A group of members that are connected by shared walls is not constrained if none of its members
/// has levels, or if the number of layers of a member is prescribed.
class AssemblyLevels {
public:
    AssemblyLevels(std::span<const AssemblyMember> members, std::span<const SharedFace> shared);

    /// Read the levels of a member.
    void read(std::size_t member, std::span<const surface::LinkingSurface> links, const RunContext& context);

    /// For each member, the tops of its layers as shares of its height, the last one 1; empty: not
    /// constrained.
    /// @param layers  returns the number of layers that a member needs over a height [model length].
    [[nodiscard]] std::vector<std::vector<double>> heights(
        const std::function<double(std::size_t member, double height)>& layers);

private:
    /// A shared wall: a range of heights in each of two members. The ranges may have opposite directions.
    struct Contact {
        std::size_t a = 0, b = 0;
        double from_a = 0, to_a = 1, from_b = 0, to_b = 1;
    };

    [[nodiscard]] std::vector<Contact> contacts() const;
    bool add_level(std::size_t member, double height);
    void exchange(std::span<const Contact> contacts);

    std::span<const AssemblyMember> members_;
    std::span<const SharedFace> shared_;
    std::vector<std::map<EdgeId, double>> height_; ///< for each member: heights of the edges around its
                                                   ///< walls, in [0, 1]
    std::vector<double> length_;                   ///< length of each member's walls along the sweep [model
                                                   ///< length]
    std::vector<double> same_; ///< for each member: levels closer than this are merged [share of height]
    std::vector<std::vector<double>> levels_; ///< for each member, increasing from 0 to 1
};

} // namespace lacuna::sweep
