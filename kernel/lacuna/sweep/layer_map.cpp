// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/layer_map.h>

#include <lacuna/core/shared/vector_code.h>

#include <array>

namespace lacuna::sweep {

namespace {

/// The columns of a matrix. They are multiplied with the coordinates of a node and added in this order:
/// first, second, third for x and y; second, third, first for z. The fourth number is unused.
struct Columns {
    Four column[3];
};

Columns columns_of(const Eigen::Matrix3d& matrix)
{
    Columns columns;
    for (int k = 0; k < 3; ++k)
        columns.column[k] = Four{matrix(0, k), matrix(1, k), matrix(2, (k + 1) % 3), 0};
    return columns;
}

/// A layer's map, and the output position of its first node.
struct Layer {
    Columns from_source, from_target;
    Four shift;
    Vec3* out;
};
using Layers = std::array<Layer, HarmonicSpread::kFields>;

/// A node's coordinates, arranged as factors of the three `Columns` of a layer's matrix.
struct Factors {
    Four first, second, third;

    LACUNA_INLINE explicit Factors(const Vec3& p)
    {
        const Four all{p[0], p[1], p[2], 0};
        first = __builtin_shufflevector(all, all, 0, 0, 1, 3);
        second = __builtin_shufflevector(all, all, 1, 1, 2, 3);
        third = __builtin_shufflevector(all, all, 2, 2, 0, 3);
    }
};

/// The residual of node `i`; null if there are none.
LACUNA_INLINE const double* residual_of(const HarmonicSpread::Fields* residuals, std::size_t i)
{
    return residuals == nullptr ? nullptr : residuals->of(i);
}

LACUNA_INLINE void map_each(const Layers& layers, std::size_t count, const Vec3* source, const Vec3* target,
                            std::size_t begin, std::size_t end, const HarmonicSpread::Fields* residuals)
{
    for (std::size_t i = begin; i < end; ++i) {
        const Factors s(source[i]), t(target[i]);
        const double* residual = residual_of(residuals, i);
        for (std::size_t l = 0; l < count; ++l) {
            const Layer& layer = layers[l];
            const Four *a = layer.from_source.column, *b = layer.from_target.column;
            Four place = (a[0] * s.first + a[1] * s.second + a[2] * s.third) +
                         (b[0] * t.first + b[1] * t.second + b[2] * t.third) + layer.shift;
            if (residual != nullptr) place += *reinterpret_cast<const Four*>(residual + 3 * l);
            for (int d = 0; d < 3; ++d) layer.out[i][d] = place[d];
        }
    }
}

} // namespace

void map_nodes(std::span<const LayerMap> maps, const Vec3* source, const Vec3* target, std::size_t begin,
               std::size_t end, const HarmonicSpread::Fields* residuals, Vec3* out, std::size_t stride)
{
    Layers layers;
    for (std::size_t l = 0; l < maps.size(); ++l) {
        const Vec3& shift = maps[l].shift;
        layers[l] = {columns_of(maps[l].from_source), columns_of(maps[l].from_target),
                     Four{shift[0], shift[1], shift[2], 0}, out + l * stride};
    }
    with_avx2(
        [&]() LACUNA_INLINE_BODY { map_each(layers, maps.size(), source, target, begin, end, residuals); });
}

} // namespace lacuna::sweep
