// SPDX-License-Identifier: MIT
/// The bound of a swept mesh: nodes and hexahedra of a grid filled by a plain loop, written as binary MSH.
/// usage: bare_loop QUADS_X QUADS_Y LAYERS OUT.msh [stream]
/// Prints the seconds it took, and those of the processor.
/// With stream a layer is filled and written at a time, so that memory does not grow with the layers.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <vector>

namespace {

using Count = std::uint64_t;

struct Grid {
    Count nx, ny, nz;

    [[nodiscard]] Count layer_nodes() const { return (nx + 1) * (ny + 1); }
    [[nodiscard]] Count layer_hexes() const { return nx * ny; }
};

/// Arrays for some layers, filled by loops and nothing else.
struct Arrays {
    std::vector<Count> tags;
    std::vector<double> places;
    std::vector<Count> cells;
};

void fill_tags(const Grid& grid, Count first, Count last, std::vector<Count>& tags)
{
    tags.resize((last - first) * grid.layer_nodes());
    Count tag = first * grid.layer_nodes();
    for (Count& own : tags) own = ++tag;
}

void fill_places(const Grid& grid, Count first, Count last, std::vector<double>& places)
{
    places.resize(3 * (last - first) * grid.layer_nodes());
    double* place = places.data();
    for (Count k = first; k < last; ++k) {
        for (Count j = 0; j <= grid.ny; ++j) {
            for (Count i = 0; i <= grid.nx; ++i, place += 3) {
                place[0] = static_cast<double>(i) / static_cast<double>(grid.nx);
                place[1] = static_cast<double>(j) / static_cast<double>(grid.ny);
                place[2] = static_cast<double>(k) / static_cast<double>(grid.nz);
            }
        }
    }
}

void fill_cells(const Grid& grid, Count first, Count last, std::vector<Count>& cells)
{
    cells.resize(9 * (last - first) * grid.layer_hexes());
    Count* cell = cells.data();
    Count tag = first * grid.layer_hexes();
    const Count row = grid.nx + 1, layer = grid.layer_nodes();
    for (Count k = first; k < last; ++k) {
        for (Count j = 0; j < grid.ny; ++j) {
            for (Count i = 0; i < grid.nx; ++i, cell += 9) {
                const Count a = 1 + i + j * row + k * layer;
                const Count own[] = {++tag,          a,         a + 1,         a + 1 + row,
                                     a + row,        a + layer, a + 1 + layer, a + 1 + row + layer,
                                     a + row + layer};
                for (int c = 0; c < 9; ++c) cell[c] = own[c];
            }
        }
    }
}

void put(std::FILE* file, const void* data, std::size_t bytes)
{
    if (std::fwrite(data, 1, bytes, file) != bytes) {
        std::perror("bare_loop: write");
        std::exit(1);
    }
}
void put(std::FILE* file, int value) { put(file, &value, sizeof value); }
void put(std::FILE* file, Count value) { put(file, &value, sizeof value); }
void put(std::FILE* file, const char* text) { std::fputs(text, file); }
template <class Value>
void put(std::FILE* file, const std::vector<Value>& values)
{
    put(file, values.data(), values.size() * sizeof(Value));
}

} // namespace

int main(int argc, char** argv)
{
    const bool stream = argc == 6 && std::strcmp(argv[5], "stream") == 0;
    if (argc != 5 && !stream) {
        std::fputs("usage: bare_loop QUADS_X QUADS_Y LAYERS OUT.msh [stream]\n", stderr);
        return 2;
    }
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor = std::clock();
    const Grid grid{std::strtoul(argv[1], nullptr, 10), std::strtoul(argv[2], nullptr, 10),
                    std::strtoul(argv[3], nullptr, 10)};
    const Count nodes = grid.layer_nodes() * (grid.nz + 1), hexes = grid.layer_hexes() * grid.nz;
    Arrays arrays;
    if (!stream) {
        fill_tags(grid, 0, grid.nz + 1, arrays.tags);
        fill_places(grid, 0, grid.nz + 1, arrays.places);
        fill_cells(grid, 0, grid.nz, arrays.cells);
    }
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(argv[4], "wb"), std::fclose);
    if (!file) {
        std::perror("bare_loop: open");
        return 1;
    }
    /// Write an array that is filled, or fill and write it a layer at a time.
    const auto put_all = [&](auto& values, const auto& fill, Count levels) {
        if (!stream) return put(file.get(), values);
        for (Count k = 0; k < levels; ++k) {
            fill(grid, k, k + 1, values);
            put(file.get(), values);
        }
    };
    put(file.get(), "$MeshFormat\n4.1 1 8\n");
    put(file.get(), 1);
    put(file.get(), "\n$EndMeshFormat\n$Nodes\n");
    for (const Count value : {Count{1}, nodes, Count{1}, nodes}) put(file.get(), value);
    for (const int value : {3, 1, 0}) put(file.get(), value);
    put(file.get(), nodes);
    put_all(arrays.tags, fill_tags, grid.nz + 1);
    put_all(arrays.places, fill_places, grid.nz + 1);
    put(file.get(), "\n$EndNodes\n$Elements\n");
    for (const Count value : {Count{1}, hexes, Count{1}, hexes}) put(file.get(), value);
    for (const int value : {3, 1, 5}) put(file.get(), value);
    put(file.get(), hexes);
    put_all(arrays.cells, fill_cells, grid.nz);
    put(file.get(), "\n$EndElements\n");
    if (std::fflush(file.get()) != 0) {
        std::perror("bare_loop: write");
        return 1;
    }
    std::printf("%.6f %.6f\n",
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC);
    return 0;
}
