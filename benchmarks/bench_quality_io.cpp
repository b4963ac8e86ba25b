// SPDX-License-Identifier: MIT
// usage: bench_quality_io [quads a side = 200] [layers = 25] [folder = the system's for temporary files]
#include "bench.h"

#include <lacuna/io/deck.h>
#include <lacuna/io/mesh_file.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quality/quality.h>
#include <lacuna/quality/shared/metrics.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

using namespace lacuna;

namespace {

/// A block with curved sides, so that no two cells are alike.
mesh::HexMesh wavy_block(int side, int layers)
{
    mesh::HexMesh mesh;
    mesh.nodes_per_layer = (side + 1) * (side + 1);
    mesh.layers = layers;
    for (int l = 0; l <= layers; ++l) {
        for (int j = 0; j <= side; ++j) {
            for (int i = 0; i <= side; ++i) {
                const double x = double(i) / side;
                const double y = double(j) / side;
                const double z = double(l) / layers;
                mesh.nodes.emplace_back(x + 0.1 * std::sin(3 * y + z), y + 0.1 * std::sin(3 * x - z),
                                        z + 0.05 * std::sin(4 * x * y));
            }
        }
    }
    for (Index j = 0; j < side; ++j) {
        for (Index i = 0; i < side; ++i) {
            const Index a = j * (side + 1) + i;
            mesh.quads.push_back({a, a + 1, a + side + 2, a + side + 1});
        }
    }
    for (const auto& edge : mesh::boundary_sides(mesh.quads)) mesh.rim.push_back({edge.from, edge.to});
    mesh.patches = {{1, {"source"}}, {2, {"target"}}, {3, {"wall:3"}}};
    mesh.source_patch.assign(mesh.quads.size(), 0);
    mesh.target_patch.assign(mesh.quads.size(), 1);
    mesh.wall_patch.assign(mesh.rim.size() * static_cast<std::size_t>(layers), 2);
    return mesh;
}

/// Cells that the 27 coefficients alone do not decide, some of them invalid: one in about 65 shaken cubes.
std::vector<Vec3> hard_cells(std::size_t count)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> shift(-0.5, 0.5);
    std::vector<Vec3> nodes;
    while (nodes.size() < 8 * count) {
        std::array<Vec3, 8> corners;
        for (std::size_t i = 0; i < 8; ++i)
            corners[i] = Vec3(double((i & 1) ^ (i >> 1 & 1)), double(i >> 1 & 1), double(i >> 2)) +
                         Vec3(shift(random), shift(random), shift(random));
        if (quality::scaled_jacobian(corners) > 0 && !quality::certified_positive(corners, 0))
            nodes.insert(nodes.end(), corners.begin(), corners.end());
    }
    return nodes;
}

constexpr int kRuns = 5;

/// A mesh of nothing but hard cells: the same few thousand over and over.
void measure_hard_cells()
{
    constexpr std::size_t kKinds = 4096;
    constexpr std::size_t kCells = 100 * kKinds;
    const std::vector<Vec3> nodes = hard_cells(kKinds);
    std::vector<Hex> hexes(kCells);
    for (std::size_t h = 0; h < kCells; ++h)
        for (std::size_t i = 0; i < 8; ++i) hexes[h][i] = static_cast<Index>(8 * (h % kKinds) + i);
    RunContext context;
    context.threads = 1;
    quality::Quality quality;
    const auto timing = bench::time_of(
        kRuns, [] {}, [&] { quality = quality::measure_cells(nodes, hexes, context); });
    bench::report("quality/measure_hard/hexes=" + std::to_string(kCells) +
                      ",refused=" + std::to_string(quality.uncertified),
                  1, timing, quality.min_scaled_jacobian);
}

void measure_metrics(const mesh::HexMesh& mesh, const std::string& size)
{
    RunContext context;
    context.threads = 1;
    for (const quality::MetricInfo& info : quality::metric_infos()) {
        std::vector<quality::MetricSummary> summary;
        const auto timing = bench::time_of(
            kRuns, [] {},
            [&] {
                summary = quality::measure_metrics(mesh, {&info.metric, 1}, context);
            });
        bench::report(std::string("quality/metric/") + info.name + "/" + size, 1, timing, summary[0].min);
    }
}

void measure_quality(const mesh::HexMesh& mesh, const std::string& size)
{
    for (const int threads : {1, thread_count({})}) {
        RunContext context;
        context.threads = threads;
        quality::Quality quality;
        const auto nothing = [] {};
        auto timing = bench::time_of(kRuns, nothing, [&] { quality = quality::measure(mesh, context); });
        bench::report("quality/measure/" + size, threads, timing, quality.min_scaled_jacobian);
        timing = bench::time_of(kRuns, nothing, [&] { quality = quality::prove(mesh, 0, context).quality; });
        bench::report("quality/prove/" + size, threads, timing, quality.min_scaled_jacobian);
    }
}

void measure_files(const mesh::HexMesh& mesh, const std::string& size, const std::filesystem::path& folder)
{
    const double least = quality::measure(mesh).min_scaled_jacobian;
    const std::string path = (folder / "lacuna_bench.msh").string();
    // A new file each time: replacing one makes the file system write the old one out first.
    const auto remove = [&] { std::filesystem::remove(path); };
    const auto write = [&](const char* name, const io::MeshFileOptions& options, int threads) {
        RunContext context;
        context.threads = threads;
        const auto timing = bench::time_of(kRuns, remove,
                                           [&] { io::write_msh(mesh, path, options, context); });
        bench::report(std::string("io/") + name + "/" + size, threads, timing, least);
    };
    const int all = thread_count({});
    write("msh_binary", {true, 4.1}, 1);
    write("msh_binary", {true, 4.1}, all);
    write("msh22_binary", {true, 2.2}, all);
    write("msh_text", {false, 4.1}, all);
    // With the scaled Jacobian of every cell, measuring it included.
    const auto write_with_quality = [&](const char* name, io::MeshFileOptions options, int threads) {
        RunContext context;
        context.threads = threads;
        const auto timing = bench::time_of(kRuns, remove, [&] {
            options.fields = {
                {"scaled_jacobian", quality::metric_values(mesh, quality::Metric::scaled_jacobian, context)}};
            io::write_msh(mesh, path, options, context);
        });
        bench::report(std::string("io/") + name + "/" + size, threads, timing, least);
    };
    write_with_quality("msh_binary_quality", {true, 4.1}, 1);
    write_with_quality("msh_binary_quality", {true, 4.1}, all);
    write_with_quality("msh_text_quality", {false, 4.1}, all);

    remove();
    io::write_msh(mesh, path);
    io::Deck deck;
    const auto timing = bench::time_of(
        kRuns, [] {}, [&] { deck = io::read_deck(path); });
    bench::report("io/read_msh_binary/" + size, 1, timing, least);
    remove();
}

} // namespace

int main(int count, char** words)
{
    const int side = count > 1 ? std::atoi(words[1]) : 200;
    const int layers = count > 2 ? std::atoi(words[2]) : 25;
    const std::filesystem::path folder = count > 3 ? words[3] : std::filesystem::temp_directory_path();
    if (side < 1 || layers < 1) {
        std::fprintf(stderr, "usage: bench_quality_io [quads a side] [layers] [folder]\n");
        return 2;
    }
    const mesh::HexMesh mesh = wavy_block(side, layers);
    const std::string size = "hexes=" + std::to_string(mesh.hex_count());
    measure_quality(mesh, size);
    measure_hard_cells();
    measure_metrics(mesh, size);
    measure_files(mesh, size, folder);
}
