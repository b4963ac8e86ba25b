// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::quality {

/// Verdict's measures of a hexahedron @cite stimpson_2007_verdict, as VTK 9.1's vtkMeshQuality computes them.
///
/// "Axes" are the three lines between the middles of opposite sides; "corners" the three edges at each
/// corner. Where Verdict says 1e30 or not-a-number of a measure that is better the larger it is, ours is 0,
/// so that no average or ranking praises a cell that has no shape.
enum class Metric {
    scaled_jacobian,             ///< the corners' alone, as everywhere else in Lacuna
    scaled_jacobian_with_centre, ///< Verdict's: the axes count as a ninth corner
    jacobian,                    ///< least at corners and centre [model length³]
    shape,                       ///< least mean ratio of the corners; 1 for a cube only
    shear,                       ///< as the scaled Jacobian, 0 where a corner is not positive
    condition,            ///< worst of the corners' condition numbers, in the Frobenius norm; 1 for a cube
    max_aspect_frobenius, ///< another name of `condition`
    med_aspect_frobenius, ///< mean of the corners' condition numbers
    oddy,                 ///< worst departure of corners and centre from equal, square edges; 0 for a cube
    skew,                 ///< largest |cosine| between two axes
    taper,                ///< how much opposite edges differ, over the shorter axis; 0 for a box
    max_edge_ratio,       ///< longest over shortest axis: Cubit's aspect ratio
    edge_ratio,           ///< VTK's: leaves edges 6…11 out of the longest; `full_edge_ratio` is meant
    full_edge_ratio,      ///< longest of all twelve edges over the shortest
    stretch,              ///< √3 × shortest edge over longest diagonal
    diagonal,             ///< shortest over longest diagonal
    dimension,            ///< volume over its gradient, for stable time steps [model length]
    volume,     ///< VTK 9.1's and Cubit's, 8 × the Jacobian at the centre; `Quality::volume` is exact
    distortion, ///< least Jacobian at corners and Gauss points over their mean
    relative_size_squared, ///< (volume over the mesh's mean volume, or its inverse)²
    shape_and_size,        ///< shape × relative_size_squared
    shear_and_size,        ///< shear × relative_size_squared
};

inline constexpr std::size_t kMetricCount = 22;

/// From `low` to `high`, both included.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool contains(double value) const { return value >= low && value <= high; }
};

/// What is known of a metric. Acceptable ranges are Cubit's (15.9, "Metrics for Hexahedral Elements"); for
/// `oddy` and the Frobenius aspects the Verdict manual's.
struct MetricInfo {
    Metric metric;
    const char* name;
    Range full;
    std::optional<Range> acceptable; ///< none where it depends on the job
    bool larger_is_better;
    bool needs_average_volume;
};

const MetricInfo& metric_info(Metric metric);
inline const char* metric_name(Metric metric) { return metric_info(metric).name; }
/// All of them, in the order of `Metric`.
std::span<const MetricInfo, kMetricCount> metric_infos();

/// Of one hexahedron, corners in Gmsh's order, which is VTK's.
/// @param average_volume  what sizes are relative to: the mean `volume` of the mesh [model length³]; the size
///                        metrics are 0 where it is not positive.
double metric(Metric metric, std::span<const Vec3, 8> corners, double average_volume = 1);

/// A metric over a mesh.
struct MetricSummary {
    Metric metric = Metric::scaled_jacobian;
    double min = 0, mean = 0, max = 0, deviation = 0; ///< deviation: root of the mean square from the mean
    std::size_t outside = 0;                          ///< cells outside the acceptable range, if there is one
    double outside_share = 0;                         ///< of all cells, 0…1
    std::size_t worst = 0;                            ///< cell, from 0; the first of equals
    int layer = -1;                                   ///< of it, from 0; -1 where cells are a plain list
    Vec3 centre{0, 0, 0};                             ///< of it, the mean of its corners
    double value = 0;                                 ///< of it
};

/// Measure every cell, one of order 2 by its corners. Wedges count where the metric is one of theirs: the
/// scaled
/// Jacobian, the Jacobian and the volume. Parallel; the same for any thread count. O(cells · metrics).
/// @pre  every corner is the number of a node (`prove()` checks it).
std::vector<MetricSummary> measure_metrics(const mesh::HexMesh& mesh, std::span<const Metric> metrics,
                                           const RunContext& context = {});

/// The same for hexahedra of any origin.
std::vector<MetricSummary> measure_metrics(std::span<const Vec3> nodes, std::span<const Hex> hexes,
                                           std::span<const Metric> metrics, const RunContext& context = {});

/// A value a cell, by number of cell; 0 of a wedge where the metric is none of theirs. Parallel. Of cells of
/// order 2 the corners' value, but for the scaled Jacobian, which is that of `judge()` where a cell is
/// curved. The scaled Jacobian is rounded to single precision, in which proofs keep it.
/// @param average_volume  what sizes are relative to; nothing: the mesh's own `mean_volume()`.
std::vector<double> metric_values(const mesh::HexMesh& mesh, Metric metric, const RunContext& context = {},
                                  std::optional<double> average_volume = {});
std::vector<double> metric_values(std::span<const Vec3> nodes, std::span<const Hex> hexes, Metric metric,
                                  const RunContext& context = {});

/// The sum of the cells' `volume` for each layer: the same to the bit for layers alone as for the whole mesh.
/// Parallel; the same for any thread count.
std::vector<double> layer_volumes(const mesh::HexMesh& mesh, const RunContext& context = {});
/// The mean `volume` of that many cells, from the sums of all their layers.
double mean_volume(std::span<const double> layers, std::size_t cells);

/// The scaled Jacobian of some cells of a mesh of order 1, by their numbers, as `metric_values()` has it to
/// the bit. On one thread. @pre  out has room for as many.
void scaled_jacobians(const mesh::HexMesh& mesh, std::span<const std::uint32_t> cells, double* out);

/// A line a metric: name, least, mean, largest, acceptable range, share of cells outside.
std::string to_table(std::span<const MetricSummary> summaries);

} // namespace lacuna::quality
