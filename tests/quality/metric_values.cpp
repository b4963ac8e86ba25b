// SPDX-License-Identifier: MIT
// usage: metric_values IN OUT, for against_vtk.py: every metric of every cell of a list, as raw numbers.
// IN: two 64-bit counts of nodes and cells, coordinates, node numbers (32-bit) from 0. OUT: metric after
// metric.
#include <lacuna/quality/shared/metrics.h>

#include <cstdint>
#include <cstdio>
#include <fstream>

using namespace lacuna;

int main(int count, char** words)
{
    if (count != 3) return 2;
    std::ifstream in(words[1], std::ios::binary);
    std::int64_t sizes[2] = {0, 0};
    const auto read = [&](void* to, std::size_t bytes) {
        in.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    };
    read(sizes, sizeof sizes);
    if (!in) return 1;
    std::vector<Vec3> nodes(static_cast<std::size_t>(sizes[0]));
    std::vector<Hex> hexes(static_cast<std::size_t>(sizes[1]));
    read(nodes.data(), nodes.size() * sizeof(Vec3));
    read(hexes.data(), hexes.size() * sizeof(Hex));
    if (!in) return 1;
    std::ofstream out(words[2], std::ios::binary);
    for (const quality::MetricInfo& info : quality::metric_infos()) {
        const std::vector<double> values = quality::metric_values(nodes, hexes, info.metric);
        out.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(values.size() * sizeof(double)));
        std::printf("%s %d\n", info.name, info.larger_is_better ? 1 : 0);
    }
    return out.good() ? 0 : 1;
}
