// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lacuna::test {

/// A piece of the outline of a domain of the plane.
struct PlaneCurve {
    enum class Kind { line, arc, free } kind = Kind::line;
    Vec2 from, to;
    Vec2 centre{0, 0};         ///< of an arc
    bool clockwise = false;    ///< an arc's way round
    std::vector<Vec2> through; ///< of a free curve: a fine polyline, ends included
};

/// A domain with a name. Loops run with the domain on their left, the outer one first.
struct PlaneDomain {
    std::string name;
    std::vector<std::vector<PlaneCurve>> loops;
    std::function<double(const Vec2&)> relative_size; ///< none: the same everywhere
};

/// A domain with nodes on its outline: an even number of sides on every curve, evenly spread by the size.
struct SeededDomain {
    quads::PlanarRegion region;
    std::vector<std::vector<int>> sides; ///< of every curve of every loop
    double size = 0;                     ///< where the relative size is 1 [length]
};

/// disc, plate with five holes, gear with bore, L, comb, aerofoil channel, and the plan of a B-spline saddle
/// with sizes corrected for its slope.
std::vector<PlaneDomain> plane_domains();
/// Outlines that small meshes are judged on: ring, eccentric ring, rounded rectangle, slot, U, T, cross, and
/// flange, a disc with four bolt holes.
std::vector<PlaneDomain> common_outlines();
/// The one of that name, of either list.
PlaneDomain plane_domain(const std::string& name);

/// A fine polyline of a curve, ends included.
std::vector<Vec2> fine_line(const PlaneCurve& curve);

/// Nodes for about `quads` quads. The size asked is the region's.
SeededDomain seed_domain(const PlaneDomain& domain, double quads);

/// What a random region was made with.
struct RandomDomain {
    quads::PlanarRegion region;
    bool odd = false;     ///< made with an odd number of sides: cannot be filled
    bool crossed = false; ///< made with loops that cross: cannot be filled
    std::string words;    ///< how it was made
};

/// A region made from a seed: 1 to 8 loops of 4 to `most_edges` edges, round, star-like or spiked, holes that
/// nearly touch, edges up to a hundred times as long as others of the same loop; a few are broken on purpose.
RandomDomain random_domain(std::uint32_t seed, int most_edges = 400);

} // namespace lacuna::test
