// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/open_volume.h>

#include <functional>
#include <vector>

namespace lacuna::test {

/// Which part of a prism a face is; walls are told apart by loop, side, row and piece, all from 0.
struct Part {
    topology::Role role = topology::Role::wall;
    int loop = 0, side = 0, row = 0, piece = 0;
};

/// How the target lies: parallel to the source, tilted about y, bowed outward, or a saddle.
enum class End { planar, tilted, bowed, saddle };

/// A round hole of a section.
struct RoundHole {
    Vec2 centre;
    double radius;
};

/// A prism along z as faces of facets: a section of straight-sided or round loops carried up, and parts of it
/// left out.
struct PrismOptions {
    int sides = 4;     ///< corners of the outer loop; 0: a circle
    double radius = 1; ///< of the outer loop's corners
    double height = 2;
    int holes = 0;      ///< loops within: one in the middle, several on a circle
    int hole_sides = 4; ///< 0: circles
    std::vector<Vec2>
        outline{}; ///< corners of the outer loop, anticlockwise; instead of `sides` and `radius`
    std::vector<RoundHole> hole_list{}; ///< instead of `holes`
    int cuts = 2;     ///< facets along a straight side and a piece; a circle has twelve times as many in all
    int rows = 1;     ///< walls stacked on each other
    int pieces = 1;   ///< walls side by side on each side
    int levels = 1;   ///< rows of facets in each row of walls
    double twist = 0; ///< of the target against the source [degrees]
    double taper = 1; ///< size of the target over the source's
    double bend = 0;  ///< of the axis towards +x, its length kept [degrees]
    double belly = 1; ///< size halfway up over that of a straight wall: above 1 a barrel, below an hourglass
    End target = End::planar;
    End source = End::planar;  ///< planar, or bowed outward
    double lift = 0.4;         ///< how much a tilted target rises at the rim, a bowed one in the middle
    double feature_angle = 40; ///< of the model; the corners of nine sides and more turn by less [degrees]
    std::function<bool(const Part&)> drop = nullptr; ///< parts left out
};

/// The faces that are left, with their roles, and what the whole encloses.
struct Prism {
    healing::FacetSoup soup; ///< of the faces left; a label a face
    topology::Model model;   ///< whole labels
    topology::Roles roles;
    std::vector<Part> part;  ///< of each face of `model`
    double facet_volume = 0; ///< within the facets, nothing left out
    double volume =
        0; ///< of the smooth solid over the polygonal section, where it has a formula; else `facet_volume`

    [[nodiscard]] topology::OpenVolume open() const { return topology::open_volume(model, roles); }
    /// The face of a part. @pre it is not left out
    [[nodiscard]] FaceId face(const Part& wanted) const;
};

Prism prism(const PrismOptions& options = {});

/// Leave out source, target, all walls, or walls by their side (of the outer loop, all rows and pieces).
std::function<bool(const Part&)> without(bool source, bool target, bool walls, std::vector<int> sides = {});

/// Cut a closed wall open along facet sides: a seam between its two rims, used twice by its one loop. @pre
/// two loops
void add_seam(topology::Model& model, FaceId wall);

/// The same facets moved by a map; tolerance and diagonal are set anew.
topology::Model moved(topology::Model model, const std::function<Vec3(const Vec3&)>& map);

/// Turn over, rotate and reorder the facets, and reverse the order of the labels, as the bits of `seed` say.
healing::FacetSoup scrambled_facets(const healing::FacetSoup& soup, unsigned seed);

} // namespace lacuna::test
