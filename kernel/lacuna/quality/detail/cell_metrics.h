// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/detail/cell_batch.h>
#include <lacuna/quality/shared/metrics.h>

#include <span>

/// Arithmetic of the metrics, for several cells at once. Internal to this folder.
namespace lacuna::quality {

/// Cells processed together: one AVX-512 vector, or two AVX2 vectors.
inline constexpr int kMetricLanes = 8;

/// Values of `metrics` for each lane, at `values[metric · kMetricLanes + lane]`; always finite.
void evaluate_metrics(const CellBatch<kMetricLanes>& batch, std::span<const Metric> metrics,
                      double average_volume, double* values);

} // namespace lacuna::quality
