// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/coincident.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/large_pages.h>
#include <lacuna/core/shared/parallel.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace lacuna::quality {
namespace {

constexpr std::size_t kBins = 1024; // bins are small enough for the first-level cache
/// Up to this number of points, the entries of all bins are made at once: 32 MB.
constexpr std::size_t kFew = std::size_t(1) << 22;
/// Up to this number of points per level, a level is searched at once: its entries take 1 MB.
constexpr std::size_t kLevel = std::size_t(1) << 17;

std::size_t chunk_count(std::size_t points) { return (points + kBetweenPolls - 1) / kBetweenPolls; }

struct Entry {
    std::uint32_t hash;
    Index point;
};

/// Hashes computed in the first pass over a chunk.
struct ChunkHashes {
    std::array<std::uint32_t, kBetweenPolls> first; ///< for each point
    std::vector<Entry> more;                        ///< for points that are also entered in a second cube
    std::array<std::uint32_t, kBins> count{};
};

std::size_t bin_of(std::uint32_t hash) { return (hash * std::uint64_t{kBins}) >> 32; }

std::unique_ptr<ChunkHashes[]> hashes_of(std::span<const Vec3> points, const CoincidenceGrid& grid,
                                         const RunContext& context)
{
    const std::size_t chunks = chunk_count(points.size());
    auto hashes = std::make_unique_for_overwrite<ChunkHashes[]>(chunks);
    use_large_pages(hashes.get(), chunks * sizeof(ChunkHashes));
    parallel_each(context, chunks, 1, [&](std::size_t c) {
        ChunkHashes& chunk = hashes[c];
        for (std::size_t p = c * kBetweenPolls; p < std::min((c + 1) * kBetweenPolls, points.size()); ++p) {
            bool first = true;
            grid.visit(points[p], [&](std::uint32_t hash) {
                ++chunk.count[bin_of(hash)];
                if (first)
                    chunk.first[p - c * kBetweenPolls] = hash;
                else
                    chunk.more.push_back({hash, static_cast<Index>(p)});
                first = false;
            });
        }
    });
    return hashes;
}

/// Entries of consecutive bins, in an order that does not depend on threads.
struct Bins {
    std::unique_ptr<Entry[]> entries;
    std::vector<std::size_t> start; ///< first entry of each bin, and the end
};

/// Sort the entries of bins [first, last).
void sort_into_bins(std::size_t points, const ChunkHashes* hashes, std::size_t first, std::size_t last,
                    Bins& bins, const RunContext& context)
{
    const std::size_t chunks = chunk_count(points), width = last - first;
    bins.start.assign(width + 1, 0);
    std::size_t total = 0;
    std::vector<std::size_t> next(chunks * width); // one row for each chunk
    for (std::size_t b = 0; b < width; ++b) {
        bins.start[b] = total;
        for (std::size_t c = 0; c < chunks; ++c) {
            next[c * width + b] = total;
            total += hashes[c].count[first + b];
        }
    }
    bins.start[width] = total;
    bins.entries.reset(); // free it before the new array is allocated
    bins.entries = std::make_unique_for_overwrite<Entry[]>(total);
    use_large_pages(bins.entries.get(), total * sizeof(Entry));
    parallel_each(context, chunks, 1, [&](std::size_t c) {
        const auto enter = [&](std::uint32_t hash, Index point) {
            const std::size_t b = bin_of(hash) - first;
            if (b < width) bins.entries[next[c * width + b]++] = {hash, point};
        };
        for (std::size_t p = c * kBetweenPolls; p < std::min((c + 1) * kBetweenPolls, points); ++p)
            enter(hashes[c].first[p - c * kBetweenPolls], static_cast<Index>(p));
        for (const Entry& entry : hashes[c].more) enter(entry.hash, entry.point);
    });
}

using Pair = std::array<Index, 2>;

/// Find a coincident pair among entries.
std::optional<Pair> search_bin(std::span<const Entry> entries, std::span<const Vec3> points, double tolerance,
                               std::vector<std::int32_t>& table)
{
    std::size_t size = 16;
    while (size < 2 * entries.size()) size *= 2;
    table.assign(size, -1);
    std::optional<Pair> found;
    for (std::size_t e = 0; e < entries.size(); ++e) {
        bool twin = false; // twins are not entered, so that many points in one place cost no more than two
        std::size_t slot = entries[e].hash & (size - 1);
        for (; table[slot] >= 0; slot = (slot + 1) & (size - 1)) {
            const Entry& other = entries[static_cast<std::size_t>(table[slot])];
            if (other.hash != entries[e].hash || other.point == entries[e].point) continue;
            const Vec3& a = points[static_cast<std::size_t>(other.point)];
            const Vec3& b = points[static_cast<std::size_t>(entries[e].point)];
            if ((a - b).squaredNorm() > tolerance * tolerance) continue;
            const Pair pair{std::min(other.point, entries[e].point), std::max(other.point, entries[e].point)};
            if (!found || pair < *found) found = pair;
            twin = true;
            break;
        }
        if (!twin) table[slot] = static_cast<std::int32_t>(e);
    }
    return found;
}

std::optional<Pair> least_of(const std::vector<std::optional<Pair>>& found)
{
    std::optional<Pair> least;
    for (const auto& pair : found)
        if (pair && (!least || *pair < *least)) least = pair;
    return least;
}

std::optional<Pair> search_all(std::span<const Vec3> points, const CoincidenceGrid& grid,
                               const RunContext& context)
{
    const auto hashes = hashes_of(points, grid, context);
    // With many points, process a sixteenth of the bins at a time, which takes a sixteenth of the memory.
    const std::size_t width = points.size() > kFew ? kBins / 16 : kBins;
    std::vector<std::optional<Pair>> found(kBins);
    Bins bins;
    for (std::size_t first = 0; first < kBins; first += width) {
        sort_into_bins(points.size(), hashes.get(), first, first + width, bins, context);
        parallel_for(context, width, 16, [&](std::size_t begin, std::size_t end) {
            std::vector<std::int32_t> table;
            for (std::size_t b = begin; b < end; ++b) {
                const std::span<const Entry> all(bins.entries.get(), bins.start[width]);
                found[first + b] = search_bin(all.subspan(bins.start[b], bins.start[b + 1] - bins.start[b]),
                                              points, grid.tolerance, table);
            }
        });
    }
    return least_of(found);
}

/// Whether each level is separated from the next along the line from the first level to the last.
bool are_apart(std::span<const Vec3> points, std::size_t level, double tolerance, const RunContext& context)
{
    if (level == 0 || level > kLevel || points.size() % level != 0 || points.size() < 2 * level) return false;
    const std::size_t levels = points.size() / level;
    Vec3 way = Vec3::Zero();
    for (std::size_t i = 0; i < level; ++i) way += points[points.size() - level + i] - points[i];
    way = way.stableNormalized();
    std::vector<std::array<double, 2>> range(levels);
    parallel_each(context, levels, 1, [&](std::size_t l) {
        double low = kInfinity, high = -low;
        for (const Vec3& point : points.subspan(l * level, level)) {
            const double at = way.dot(point);
            low = std::min(low, at);
            high = std::max(high, at);
        }
        range[l] = {low, high};
    });
    for (std::size_t l = 1; l < levels; ++l)
        if (!(range[l][0] - range[l - 1][1] > 2 * tolerance)) return false; // twice, for rounding
    return true;
}

/// Search level by level, while the entries are in the second-level cache.
std::optional<Pair> search_levels(std::span<const Vec3> points, std::size_t level,
                                  const CoincidenceGrid& grid, const RunContext& context)
{
    std::vector<std::optional<Pair>> found(points.size() / level);
    parallel_for(context, found.size(), 1 + kBetweenPolls / level, [&](std::size_t begin, std::size_t end) {
        std::vector<Entry> entries;
        std::vector<std::int32_t> table;
        for (std::size_t l = begin; l < end; ++l) {
            entries.clear();
            for (std::size_t p = l * level; p < (l + 1) * level; ++p)
                grid.visit(points[p], [&](std::uint32_t hash) {
                    entries.push_back({hash, static_cast<Index>(p)});
                });
            found[l] = search_bin(entries, points, grid.tolerance, table);
        }
    });
    return least_of(found);
}

/// Extend a box by points, four at a time: twelve numbers x, y, z, x, ... in a row.
/// @return  whether all are finite.
bool extend(Eigen::AlignedBox3d& box, std::span<const Vec3> points)
{
    constexpr std::size_t kNumbers = 12;
    alignas(64) double low[kNumbers], high[kNumbers], zero[kNumbers] = {};
    std::fill_n(low, kNumbers, kInfinity);
    std::fill_n(high, kNumbers, -kInfinity);
    const double* number = points.empty() ? nullptr : points.front().data();
    const std::size_t fours = points.size() / 4;
    for (std::size_t f = 0; f < fours; ++f, number += kNumbers) {
        for (std::size_t i = 0; i < kNumbers; ++i) {
            const double value = number[i];
            low[i] = value < low[i] ? value : low[i];
            high[i] = value > high[i] ? value : high[i];
            zero[i] += 0 * value; // becomes NaN if a number is not finite
        }
    }
    Vec3 zeros(0, 0, 0);
    for (std::size_t i = 0; i < kNumbers; i += 3) {
        if (fours > 0) {
            box.extend(Vec3(low[i], low[i + 1], low[i + 2]));
            box.extend(Vec3(high[i], high[i + 1], high[i + 2]));
        }
        zeros += Vec3(zero[i], zero[i + 1], zero[i + 2]);
    }
    for (const Vec3& point : points.subspan(4 * fours)) {
        box.extend(point);
        zeros += 0 * point;
    }
    return zeros == Vec3(0, 0, 0);
}

} // namespace

Eigen::AlignedBox3d finite_bounds(std::span<const Vec3> points, const RunContext& context)
{
    const std::size_t chunks = chunk_count(points.size());
    std::vector<Eigen::AlignedBox3d> boxes(chunks);
    std::vector<char> finite(chunks, 1);
    parallel_each(context, chunks, 1, [&](std::size_t c) {
        const std::size_t first = c * kBetweenPolls;
        finite[c] = extend(boxes[c], points.subspan(first, std::min(kBetweenPolls, points.size() - first)));
    });
    Eigen::AlignedBox3d bounds;
    for (std::size_t c = 0; c < chunks; ++c) {
        if (finite[c] == 0) return {};
        bounds.extend(boxes[c]);
    }
    return bounds;
}

std::optional<Pair> find_coincident(std::span<const Vec3> points, std::size_t level, double tolerance,
                                    const Eigen::AlignedBox3d& bounds, const RunContext& context)
{
    if (points.size() < 2) return std::nullopt;
    if (!(tolerance > 0)) return Pair{0, 1};
    const CoincidenceGrid grid(bounds, tolerance);
    return are_apart(points, level, tolerance, context) ? search_levels(points, level, grid, context)
                                                        : search_all(points, grid, context);
}

} // namespace lacuna::quality
