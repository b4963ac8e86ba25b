// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <random>
#include <vector>

namespace lacuna::test {

/// Append faces of a model with points, edges and vertices of their own; tags of edges and vertices count on.
void append_loose(topology::Model& to, const topology::Model& from, const std::vector<FaceId>& faces);

/// Every face on its own.
topology::Model exploded(const topology::Model& model);

/// A direction at random, no longer than 1.
Vec3 wobble(std::mt19937& random);

/// Move every point of every edge by up to `amount`.
void shake(topology::Model& model, double amount, unsigned seed);

/// Put a point in the middle of some sides of some edges, on their curves where they have them, on all facets
/// there.
void divide_sides(topology::Model& model, unsigned seed);

/// Make a vertex of an inner point of every `every`-th edge: where its twin has none, a T-junction.
void divide_edges(topology::Model& model, std::size_t every);

} // namespace lacuna::test
