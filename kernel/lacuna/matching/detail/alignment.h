// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/affine.h>
#include <lacuna/matching/detail/problem.h>

#include <limits>
#include <vector>

namespace lacuna::matching {

/// The most that void edges may turn in the mean against straight up, as a share of the loop: the waist of a
/// round wall that is ruled so is 1 − cos(π/32), half a hundredth, narrower.
inline constexpr double kMostTwist = 1.0 / 32;

/// One way a source loop lies on a target loop.
struct Alignment {
    /// Target vertex that the source's first vertex meets; of loops paired by length the sample, or the node
    /// where sides are given.
    std::size_t shift = 0;
    /// Of loops paired by length: share of the target's length where the source's start lies.
    double offset = 0;
    bool backward = true; ///< the target loop is walked against its own direction
    double score = std::numeric_limits<double>::infinity();
    geometry::RigidFit fit;
};

/// How far the fit of an alignment turns the source, as a share of half a turn.
double turn_of(const Alignment& alignment);

/// Every alignment of source loop s on target loop t that hard pairs and direction allow, best first. Pairs
/// matched already take part in the fit.
std::vector<Alignment> alignments_of(const Problem& problem, std::size_t s, std::size_t t, bool with_scale,
                                     const PointPairs& known = {});

/// Slide an alignment of loops paired by length to where it fits best between its neighbours.
Alignment refined(const Problem& problem, std::size_t s, std::size_t t, const Alignment& alignment,
                  const PointPairs& known);

/// Corresponding points of two loops, as an alignment has it.
PointPairs samples(const Problem& problem, std::size_t s, std::size_t t, const Alignment& alignment);

/// Whether two alignments are not the same but for a little sliding along a smooth loop.
bool differ(const Problem& problem, std::size_t s, std::size_t t, const Alignment& a, const Alignment& b);

/// What of two loops that came with sides does not meet by an alignment: edges of the source that meet edges
/// with another number of sides; of loops measured by their sides, vertices of the one with fewer that meet
/// none.
std::size_t unlike_sides(const Problem& problem, std::size_t s, std::size_t t, const Alignment& alignment);

/// Say of each two loops whether their vertices tell how they lie on each other, or lengths have to.
///
/// Loops with unlike numbers of vertices go by length, and those with one each. Others go vertex to vertex,
/// unless no way to do so keeps what walls join; or the best gives a corner a smooth partner though there are
/// corners for it; or, where no corner meets a corner, it twists by more than `kMostTwist` in the mean.
void choose_how(Problem& problem);

} // namespace lacuna::matching
