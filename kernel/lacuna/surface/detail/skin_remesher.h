// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/detail/linked_triangles.h>
#include <lacuna/surface/detail/skin_shape.h>

#include <span>
#include <vector>

namespace lacuna::surface {

/// Isotropic remeshing of linked triangles, as `triangulate_skin()` describes.
class SkinRemesher {
public:
    /// @param lines   sampled lines; must outlive this object.
    /// @param shapes  one for each face of the model; must outlive this object.
    SkinRemesher(LinkedTriangles& mesh, std::span<const SkinLine> lines,
                 std::span<const FaceShapeTree> shapes, const SizeField& size, const RunContext& context)
        : mesh_(mesh), lines_(lines), shapes_(shapes), size_(size), context_(context)
    {
    }

    void run(const topology::Model& model);

private:
    [[nodiscard]] double ratio(Index s) const;
    [[nodiscard]] double worst_around(Index node, const Vec3& place) const;

    /// Maximum number of sides: those of the mesh, plus a multiple of the number that the sizes require.
    /// @throw NotSweepable "surface.skin_count"  the sizes require too many triangles.
    [[nodiscard]] double most_sides() const;
    /// @param most  splitting stops at this number of sides.
    /// @return      whether a side was split
    bool split_long(double most);
    Index try_split(Index s);
    bool collapse_short(); ///< @return whether a side was collapsed
    bool try_collapse(Index s, double least);
    [[nodiscard]] bool is_better_flipped(Index s) const;
    void flip_all();
    /// @return the sides that were flipped.
    std::vector<Index> flip_from(std::vector<Index> open);
    [[nodiscard]] Vec3 centre_around(Index node) const;
    [[nodiscard]] const FaceShapeTree& shape_at(Index node) const;
    /// Move a node to a place, if the smallest angle of its triangles afterwards is at least `least`, or at
    /// least as large as before. Angles are given by their tangents. @return  whether the node was moved
    bool move_to(Index node, const Vec3& place, double least);
    bool move_along_line(Index node, double least);
    void smooth(double least);
    /// Improve triangles with small angles. @param moves  whether nodes may be moved. False after nodes were
    /// moved to their exact positions.
    void improve(bool moves);
    bool improve(Index side, bool moves);
    void make_exact(const topology::Model& model);
    void set_normals(Index node);

    LinkedTriangles& mesh_;
    std::span<const SkinLine> lines_;
    std::span<const FaceShapeTree> shapes_;
    const SizeField& size_;
    const RunContext& context_;
};

} // namespace lacuna::surface
