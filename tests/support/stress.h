// SPDX-License-Identifier: MIT
#pragma once

#include "support/volumes.h"

#include <lacuna/sweep/sweep.h>

#include <string>
#include <vector>

namespace lacuna::test {

/// Sections of the stress family: all of radius about one.
enum class Section { square, hexagon, circle, ell, comb, gear };

/// One hard volume, with the mesh asked of it.
struct StressMember {
    int number = 0; ///< from 0; the same number is the same member everywhere
    bool mild = true;
    Section section = Section::square;
    int holes = 0;
    double twist = 0; ///< of the target against the source [degrees]
    double taper = 1; ///< size of the target over the source's
    double bend = 0;  ///< of the axis, its length kept [degrees]
    double belly = 1; ///< size halfway up over a straight wall's
    double lift = 0;  ///< of the ends, over the section's radius
    End source = End::planar, target = End::planar;
    double bias = 1;   ///< last layer over the first
    double aspect = 1; ///< height of the mean layer over the size of the quads
    int layers = 8;
    double height = 1;                                           ///< of the volume, over the section's radius
    topology::VolumeClass value = topology::VolumeClass::closed; ///< what is left out

    [[nodiscard]] std::string name() const;
};

/// The stress family: `count` members drawn with one seed, the first half mild. Amounts are drawn so that the
/// volume does not run into itself: a bend's inner side keeps a third of the axis' length, a corner's line
/// leans by 35 degrees at most in the mild half and 50 in the other.
std::vector<StressMember> stress_family(int count, unsigned seed = 1);

/// The open volume of a member.
topology::OpenVolume stress_volume(const StressMember& member);
/// The same, matched and closed; nothing given tells how a lifted end that is missing bends, so what closing
/// assumes is taken.
topology::OpenVolume sealed_stress_volume(const StressMember& member);

/// What is asked of the sweep.
sweep::SweepOptions stress_options(const StressMember& member);

/// What the volume's edges allow: where two sides of a cell lie on them, it is at that corner no better than
/// their angle, and where three do, it is what they make of it.
/// @return  the least over all such corners [0, 1].
double edge_bound(const mesh::HexMesh& mesh);

} // namespace lacuna::test
