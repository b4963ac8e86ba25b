// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/topology/open_volume.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

/// Volumes to be meshed as one, and what must hold of their mesh.
namespace lacuna::test {

/// Match the ends, if there are two, and seal.
topology::OpenVolume closed(topology::OpenVolume volume);

/// A six-sided block between two corners of space, moved by a map, swept along an axis.
struct Brick {
    Vec3 low, high;
    int axis = 2;
    int cuts = 1;                                 ///< facets along each side of a face
    std::function<bool(int side)> drop = nullptr; ///< sides 0 … 5: low and high of x, y, z
    std::function<Vec3(const Vec3&)> map = nullptr;
    double tolerance = 0; ///< of its model; 0: the default
};

topology::OpenVolume brick(const Brick& b);

struct Members {
    std::vector<topology::OpenVolume> volumes;
    std::vector<sweep::SweepOptions> options;

    void add(topology::OpenVolume volume, double size, int layers = 0);
    /// Regions are named part_1, part_2 …
    [[nodiscard]] std::vector<sweep::AssemblyMember> list() const;
};

/// Every part is valid; together the cells are conformal, with as many inner faces more as are shared.
void check_assembly(const sweep::SweptAssembly& whole, double volume, double share = 1e-9);

/// What a family's refused members were refused by.
struct Refusals {
    std::map<std::string, int> by_code;

    /// Count a refusal, and print it with the member's seed.
    void add(unsigned seed, const Error& error);
    /// " code count" for each.
    [[nodiscard]] std::string in_words() const;
};

/// Quads of the skin that two parts have.
std::size_t inner_quads(const sweep::SweptAssembly& whole);

} // namespace lacuna::test
