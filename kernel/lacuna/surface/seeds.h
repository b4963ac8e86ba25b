// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/belt.h>
#include <lacuna/surface/quad_mesher.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// How source faces are meshed.
enum class QuadStyle {
    automatic, ///< mapped where four-sided and not too unlike, else free
    mapped,    ///< mapped, or an error
    free,      ///< by the planar mesher
};

/// A part of an edge with its own number of sides.
struct SeedPiece {
    double from = 0, to = 1; ///< fractions of the edge's length, as the edge runs
    double length = 0;       ///< [model length]
    int count = 1;           ///< sides, >= 1
};

/// Sides of every edge of the source faces, consistent: a mapped face has as many on opposite sides, a free face an
/// even number in all.
struct Seeds {
    std::map<EdgeId, std::vector<SeedPiece>> pieces; ///< in order along the edge
    std::map<FaceId, std::vector<std::size_t>>
        corners; ///< of mapped faces: the four uses of the loop that start a side
    [[nodiscard]] int count(EdgeId edge) const;
    /// Fractions of the edge's nodes, both ends included.
    [[nodiscard]] std::vector<double> fractions(EdgeId edge) const;
};

/// Numbers of sides for the edges of the source, by size where there are no constraints; a bend of 45° has a side at least.
///
/// Opposite sides of mapped faces are raised to the larger count, a face at a time until nothing changes; then each free face with an
/// odd total gets one more side on a rim edge of its own, or on an edge towards one.
/// @throw NotSweepable  a face to be mapped that has not four sides; a face whose total cannot be made even; names them.
Seeds seed_source(const topology::OpenVolume& volume, std::span<const Belt> belts, const SizeField& size,
                  QuadStyle style);

/// Mean length of the facets' sides on the source's rim: the size where none is asked for [model length].
double rim_spacing(const topology::OpenVolume& volume);

} // namespace lacuna::surface
