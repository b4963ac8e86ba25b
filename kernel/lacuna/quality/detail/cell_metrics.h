// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/detail/cell_batch.h>
#include <lacuna/quality/metrics.h>

#include <span>

/// The arithmetic of the metrics, for several cells at once. Internal to this folder.
namespace lacuna::quality {

/// Cells worked on together: one vector of AVX-512, two of AVX2.
inline constexpr int kMetricLanes = 8;

/// Values of `metrics` of every lane, at `values[metric · kMetricLanes + lane]`; always finite.
void evaluate_metrics(const CellBatch<kMetricLanes>& batch, std::span<const Metric> metrics,
                      double average_volume, double* values);

} // namespace lacuna::quality
