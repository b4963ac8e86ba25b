// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/mesh/hex_mesh.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::quality {

/// Verdict's metrics of a hexahedron @cite stimpson_2007_verdict, as vtkMeshQuality of VTK 9.1 computes them.
///
/// "Axes" are the three vectors between the centres of opposite sides; "corners" are the triples of edges at
/// a corner. If larger values of a metric are better and Verdict returns 1e30 or NaN, the value is 0 here, so
/// that degenerate cells do not improve averages or rankings.
enum class Metric {
    scaled_jacobian,             ///< at the corners only, as everywhere in Lacuna
    scaled_jacobian_with_centre, ///< as in Verdict: the axes count as a ninth corner
    jacobian,                    ///< smallest value at corners and centre [model length³]
    shape,                       ///< smallest mean ratio of the corners; 1 for a cube only
    shear,                       ///< as the scaled Jacobian, but 0 if a corner is not positive
    condition,                   ///< largest Frobenius condition number of the corners; 1 for a cube
    max_aspect_frobenius,        ///< another name of `condition`
    med_aspect_frobenius,        ///< mean Frobenius condition number of the corners
    oddy,                        ///< largest deviation of the metric tensor from a cube's; 0 for a cube
    skew,                        ///< largest |cosine| between two axes
    taper,                       ///< difference of opposite edges relative to the shorter axis; 0 for a box
    max_edge_ratio,              ///< longest over shortest axis: Cubit's aspect ratio
    edge_ratio,      ///< as in VTK, which ignores edges 6…11 for the longest; prefer `full_edge_ratio`
    full_edge_ratio, ///< longest of all twelve edges over the shortest edge
    stretch,         ///< √3 × shortest edge over longest diagonal
    diagonal,        ///< shortest over longest body diagonal
    dimension,       ///< volume over its gradient, for stable time steps [model length]
    volume,          ///< as in VTK 9.1 and Cubit, 8 × Jacobian at the centre; `Quality::volume` is exact
    distortion,      ///< smallest Jacobian at corners and Gauss points, over the mean at Gauss points
    relative_size_squared, ///< (volume / mean volume of the mesh)², or its inverse if that is smaller
    shape_and_size,        ///< shape × relative_size_squared
    shear_and_size,        ///< shear × relative_size_squared
};

inline constexpr std::size_t kMetricCount = 22;

/// An interval, both ends included.
struct Range {
    double low = -kInfinity;
    double high = kInfinity;

    [[nodiscard]] bool contains(double value) const { return value >= low && value <= high; }
};

/// Properties of a metric. Acceptable ranges are from Cubit (15.9, "Metrics for Hexahedral Elements"), except
/// for `oddy` and the Frobenius aspects, whose ranges are from the Verdict manual.
struct MetricInfo {
    Metric metric;
    const char* name;
    Range full;
    std::optional<Range> acceptable; ///< none if it depends on the application
    bool larger_is_better;
    bool needs_average_volume;
};

const MetricInfo& metric_info(Metric metric);
inline const char* metric_name(Metric metric) { return metric_info(metric).name; }
/// The properties of all metrics, in the order of `Metric`.
std::span<const MetricInfo, kMetricCount> metric_infos();

/// The metric of one hexahedron, corners in the order of Gmsh and VTK.
/// @param average_volume  reference of the size metrics: the mean `volume` of the mesh [model length³]. The
///                        size metrics are 0 if it is not positive.
double metric(Metric metric, std::span<const Vec3, 8> corners, double average_volume = 1);

/// Statistics of a metric over a mesh.
struct MetricSummary {
    Metric metric = Metric::scaled_jacobian;
    double min = 0, mean = 0, max = 0, deviation = 0; ///< deviation: root mean square deviation from the mean
    std::size_t outside = 0;                          ///< cells outside the acceptable range, if there is one
    double outside_share = 0;                         ///< fraction of all cells, 0…1
    std::size_t worst = 0;                            ///< worst cell, from 0; the first of equal ones
    int layer = -1;                                   ///< its layer, from 0; -1 for a list of cells
    Vec3 centre{0, 0, 0};                             ///< its centre, the mean of its corners
    double value = 0;                                 ///< its value
    std::size_t cells = 0;                            ///< cells for which the metric is defined
};

/// Measure every cell; cells of order 2 by their corners. Wedges, pyramids and tetrahedra count in the
/// metrics defined for them: scaled Jacobian, Jacobian and volume. Parallel; independent of the number of
/// threads. O(cells · metrics).
/// @pre  every corner is a valid node number (`prove()` checks it).
std::vector<MetricSummary> measure_metrics(const mesh::HexMesh& mesh, std::span<const Metric> metrics,
                                           const RunContext& context = {});

/// Measure a list of cells, stored as for `measure_cells()`.
std::vector<MetricSummary> measure_metrics(std::span<const Vec3> nodes, std::span<const Hex> hexes,
                                           std::span<const Metric> metrics, const RunContext& context = {});

/// The metric of each cell, by cell number; 0 for cells for which it is not defined. Parallel.
/// Cells of order 2 are measured by their corners, except that the scaled Jacobian of a curved cell is that
/// of `judge()`. The scaled Jacobian is rounded to single precision, as proofs store it.
/// @param average_volume  reference of the size metrics; empty: `mean_volume()` of the mesh.
std::vector<double> metric_values(const mesh::HexMesh& mesh, Metric metric, const RunContext& context = {},
                                  std::optional<double> average_volume = {});
std::vector<double> metric_values(std::span<const Vec3> nodes, std::span<const Hex> hexes, Metric metric,
                                  const RunContext& context = {});

/// For each layer, the sum of the metric `volume` over its cells. A layer that is measured alone gives the
/// same bits as in the whole mesh. Parallel; the result is the same for any number of threads.
std::vector<double> layer_volumes(const mesh::HexMesh& mesh, const RunContext& context = {});
/// Mean `volume` of `cells` cells, from the sums of all layers.
double mean_volume(std::span<const double> layers, std::size_t cells);

/// The scaled Jacobian of selected cells of a mesh of order 1, bit for bit that of `metric_values()`.
/// Single-threaded.
/// @pre  `out` has the size of `cells`.
void scaled_jacobians(const mesh::HexMesh& mesh, std::span<const std::uint32_t> cells, double* out);

/// A table with one line per metric: name, minimum, mean, maximum, acceptable range, fraction of cells
/// outside.
std::string to_table(std::span<const MetricSummary> summaries);

} // namespace lacuna::quality
