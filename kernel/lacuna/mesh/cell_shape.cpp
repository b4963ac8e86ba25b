// SPDX-License-Identifier: MIT
#include <lacuna/mesh/cell_shape.h>

#include <lacuna/mesh/hex_mesh.h>

namespace lacuna::mesh {
namespace {

constexpr CellShapeInfo kInfos[kCellShapes] = {
    {1, 2, 2}, {1, 2, 3},  {2, 3, 3},  {2, 3, 6}, {2, 4, 4},  {2, 4, 8},  {2, 4, 9}, {3, 4, 4},  {3, 4, 10},
    {3, 5, 5}, {3, 5, 13}, {3, 5, 14}, {3, 6, 6}, {3, 6, 15}, {3, 6, 18}, {3, 8, 8}, {3, 8, 20}, {3, 8, 27}};

using Side = std::pair<int, int>;
constexpr Side kLineSides[] = {{0, 1}};
constexpr Side kTriangleSides[] = {{0, 1}, {1, 2}, {2, 0}};
constexpr Side kQuadSides[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr Side kTetSides[] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
constexpr Side kPyramidSides[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
constexpr Side kWedgeSides[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
constexpr Side kSidesOfHex[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

constexpr Quad kTetFaces[] = {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
constexpr Quad kPyramidFaces[] = {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
constexpr Quad kWedgeFaces[] = {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};

/// 0 to 3: a tetrahedron, pyramid, wedge or hexahedron, of 4, 5, 6 or 8 corners.
int solid_number(const CellShapeInfo& info) { return info.corners == 8 ? 3 : info.corners - 4; }

} // namespace

const CellShapeInfo& shape_info(CellShape shape) { return kInfos[static_cast<std::size_t>(shape)]; }

std::optional<CellShape> find_shape(int dimension, int corners, int nodes)
{
    for (std::size_t s = 0; s < kCellShapes; ++s)
        if (kInfos[s].dimension == dimension && kInfos[s].corners == corners && kInfos[s].nodes == nodes)
            return static_cast<CellShape>(s);
    return std::nullopt;
}

std::span<const std::pair<int, int>> side_corners(CellShape shape)
{
    const CellShapeInfo& info = shape_info(shape);
    if (info.dimension == 1) return kLineSides;
    if (info.dimension == 2) return info.corners == 3 ? std::span<const Side>(kTriangleSides) : kQuadSides;
    static constexpr std::span<const Side> kOfSolid[] = {kTetSides, kPyramidSides, kWedgeSides, kSidesOfHex};
    return kOfSolid[solid_number(info)];
}

std::span<const Quad> face_corners(CellShape shape)
{
    const CellShapeInfo& info = shape_info(shape);
    static constexpr std::span<const Quad> kOfSolid[] = {kTetFaces, kPyramidFaces, kWedgeFaces, kHexSides};
    return info.dimension < 3 ? std::span<const Quad>() : kOfSolid[solid_number(info)];
}

} // namespace lacuna::mesh
