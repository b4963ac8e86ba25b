// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>
#include <lacuna/core/types.h>

#include <array>
#include <span>
#include <vector>

namespace lacuna::surface {

/// A closed surface of triangles that is edited by splitting, collapsing and flipping its sides.
///
/// Side 3 t + k runs from corner k of triangle t to the next corner. The twin of a side is the same side of
/// the adjacent triangle, in the opposite direction. Removed triangles keep their numbers and have corners
/// -1.
class LinkedTriangles {
public:
    struct Side {
        Index from = -1;            ///< node at which the side starts
        Index twin = -1;            ///< side of the adjacent triangle
        Index line = -1;            ///< the line that contains the side; -1: the side is inside a face
        double s = 0;               ///< position of `from` on that line
        Vec3 normal = Vec3::Zero(); ///< unit normal, at `from`, of the face that contains the triangle
    };
    struct Node {
        Vec3 at;
        double size = 0; ///< target length of the sides
        Index line = -1; ///< the line on which the node may move; -1: it is inside a face, or fixed
        bool fixed = false;
        Index point = -1; ///< point of the model; -1: a new node
        Index out = -1;   ///< a side that starts here
    };
    struct Owner {
        FaceId face;
        bool kept = false; ///< whether the triangle is part of a given mesh
    };

    /// @param corners  nodes of each triangle; closed and oriented. A node at which several fans of triangles
    ///         touch is duplicated, and its copies are fixed.
    /// @return  number of a side without a twin; -1: there is none, so the surface is closed.
    Index build(std::vector<Node> nodes, std::span<const Triangle> corners, std::span<const Owner> owners);

    [[nodiscard]] static Index next(Index s) { return s % 3 == 2 ? s - 2 : s + 1; }
    [[nodiscard]] static Index prev(Index s) { return s % 3 == 0 ? s + 2 : s - 1; }
    [[nodiscard]] Index twin(Index s) const { return sides[index(s)].twin; }
    [[nodiscard]] Index from(Index s) const { return sides[index(s)].from; }
    [[nodiscard]] Index to(Index s) const { return from(next(s)); }
    /// The corner opposite to a side.
    [[nodiscard]] Index apex(Index s) const { return from(prev(s)); }
    [[nodiscard]] Index line(Index s) const { return sides[index(s)].line; }
    [[nodiscard]] bool lives(Index s) const { return from(s) >= 0; }
    [[nodiscard]] const Owner& owner(Index s) const { return owners[index(s / 3)]; }
    /// Whether a side belongs to a given mesh.
    [[nodiscard]] bool is_kept(Index s) const { return owner(s).kept || owner(twin(s)).kept; }
    [[nodiscard]] const Vec3& at(Index node) const { return nodes[index(node)].at; }
    [[nodiscard]] double length(Index s) const { return (at(to(s)) - at(from(s))).norm(); }

    /// Visit the sides that start at a node, anticlockwise.
    template <class Visit>
    void each_out(Index node, const Visit& visit) const
    {
        const Index first = nodes[index(node)].out;
        Index s = first;
        do {
            visit(s);
            s = twin(prev(s));
        } while (s != first);
    }
    [[nodiscard]] bool are_neighbours(Index a, Index b) const;
    [[nodiscard]] int valence(Index node) const;
    /// Whether a collapse keeps the surface a manifold.
    [[nodiscard]] bool can_collapse(Index s) const;

    /// Quality of a triangle: the tangent of its smallest angle. It is negative if the triangle's normal
    /// deviates from the face normals at its corners by more than 60°.
    [[nodiscard]] double quality(Index side) const;
    /// The quality that the triangle would have with node `moved` at `place`.
    [[nodiscard]] double quality(Index side, Index moved, const Vec3& place) const;

    /// Insert a node on a side. @param normals  normals of the faces to the left and to the right of the
    /// side.
    /// @return  the node.
    Index split(Index s, Node node, const std::array<Vec3, 2>& normals);
    /// Remove a side, its two triangles and its start node. The other triangles at the start node get the end
    /// node of the side instead. @pre can_collapse(s)
    void collapse(Index s);
    /// Replace a side by the other diagonal of its two triangles. @pre this other diagonal is not a side of
    /// the mesh
    void flip(Index s);

    std::vector<Node> nodes;
    std::vector<Side> sides;
    std::vector<Owner> owners; ///< owner of each triangle

private:
    void set_twins(Index a, Index b);
    void divide_fans();
};

/// Quality of a triangle, as `LinkedTriangles::quality()`.
double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal);

} // namespace lacuna::surface
