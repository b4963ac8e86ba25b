// SPDX-License-Identifier: MIT
#pragma once

#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/closure/close.h>
#include <lacuna/closure/readings.h>
#include <lacuna/core/error.h>
#include <lacuna/matching/match.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace lacuna::test {

/// The target and the walls of holes left out.
inline bool holes_and_target(const Part& part)
{
    return part.role == topology::Role::target || (part.role == topology::Role::wall && part.loop > 0);
}

/// Match where there are two ends, and close.
inline closure::Closure seal(topology::OpenVolume& volume, const closure::CloseOptions& options = {},
                             const matching::MatchOptions& match = {})
{
    const bool ends = !volume.faces(topology::Role::source).empty() &&
                      !volume.faces(topology::Role::target).empty();
    closure::Closed closed = closure::close(volume, ends ? matching::match(volume, match) : matching::Match{},
                                            options);
    volume = std::move(closed.volume);
    return std::move(closed.closure);
}

/// What a reading encloses once it is closed, by the roles it names.
inline double closed_volume(closure::Reading reading)
{
    if (!reading.closure) {
        matching::Match match;
        if (!reading.volume.faces(topology::Role::source).empty() &&
            !reading.volume.faces(topology::Role::target).empty())
            match = matching::match(reading.volume);
        reading.volume = closure::close(reading.volume, match, {.roles_by = closure::RolesBy::finding})
                             .volume; // as readings are closed
    }
    CHECK(closure::is_watertight(reading.volume));
    return closure::enclosed_volume(reading.volume);
}

/// The faces of a part that are left, read without roles and closed, enclose what the whole part does.
inline void check_found(const Prism& part, double epsilon)
{
    const auto reading = closure::find_reading(part.model, topology::all_faces(part.model));
    CHECK(closed_volume(reading) == doctest::Approx(part.facet_volume).epsilon(epsilon));
}

/// Watertight, told without the kernel's own check: every facet side is met by one other, run the other
/// way, and within a face the facets' border is exactly the loops'.
inline void check_sealed(const topology::OpenVolume& volume)
{
    std::map<std::pair<Index, Index>, int> sides;
    for (const topology::Face& face : volume.model.faces) {
        CHECK(!face.triangles.empty());
        for (const Triangle& t : face.triangles) {
            for (std::size_t i = 0; i < 3; ++i) ++sides[{t[i], t[(i + 1) % 3]}];
        }
    }
    std::size_t lone = 0;
    for (const auto& [side, uses] : sides)
        lone += uses != 1 || !sides.contains({side.second, side.first}) ? 1 : 0;
    CHECK(lone == 0);
    std::vector<int> forward(volume.model.edges.size(), 0), backward(volume.model.edges.size(), 0);
    for (const topology::Face& face : volume.model.faces) {
        for (const topology::Loop& loop : face.loops) {
            for (std::size_t i = 0; i < loop.uses.size(); ++i) {
                const topology::EdgeUse use = loop.uses[i];
                ++(use.reversed ? backward : forward)[use.edge.index()];
                CHECK(topology::use_to(volume.model, use) ==
                      topology::use_from(volume.model, loop.uses[(i + 1) % loop.uses.size()]));
            }
        }
    }
    CHECK(std::count(forward.begin(), forward.end(), 1) == static_cast<std::ptrdiff_t>(forward.size()));
    CHECK(std::count(backward.begin(), backward.end(), 1) == static_cast<std::ptrdiff_t>(backward.size()));
    CHECK(volume.role.size() == volume.model.faces.size());
    CHECK(closure::is_watertight(volume));
    CHECK(closure::enclosed_volume(volume) > 0);
}

} // namespace lacuna::test
