// SPDX-License-Identifier: MIT
/// The bound of a swept mesh: nodes and hexahedra of a grid filled by a plain loop, written as binary MSH.
/// usage: bare_loop QUADS_X QUADS_Y LAYERS OUT.msh    Prints the seconds it took.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

namespace {

struct NodeBlock {
    std::vector<std::uint64_t> tags;
    std::vector<double> places;
};

void put(std::FILE* file, const void* data, std::size_t bytes)
{
    if (std::fwrite(data, 1, bytes, file) != bytes) {
        std::perror("bare_loop: write");
        std::exit(1);
    }
}
void put(std::FILE* file, int value) { put(file, &value, sizeof value); }
void put(std::FILE* file, std::uint64_t value) { put(file, &value, sizeof value); }
void put(std::FILE* file, const char* text) { std::fputs(text, file); }

} // namespace

int main(int argc, char** argv)
{
    if (argc != 5) {
        std::fputs("usage: bare_loop QUADS_X QUADS_Y LAYERS OUT.msh\n", stderr);
        return 2;
    }
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t nx = std::strtoul(argv[1], nullptr, 10), ny = std::strtoul(argv[2], nullptr, 10),
                        nz = std::strtoul(argv[3], nullptr, 10);
    const std::uint64_t nodes = (nx + 1) * (ny + 1) * (nz + 1), hexes = nx * ny * nz;

    NodeBlock block{std::vector<std::uint64_t>(nodes), std::vector<double>(3 * nodes)};
    std::uint64_t node = 0;
    for (std::uint64_t k = 0; k <= nz; ++k) {
        for (std::uint64_t j = 0; j <= ny; ++j) {
            for (std::uint64_t i = 0; i <= nx; ++i, ++node) {
                block.tags[node] = node + 1;
                block.places[3 * node] = static_cast<double>(i) / static_cast<double>(nx);
                block.places[3 * node + 1] = static_cast<double>(j) / static_cast<double>(ny);
                block.places[3 * node + 2] = static_cast<double>(k) / static_cast<double>(nz);
            }
        }
    }
    std::vector<std::uint64_t> cells(9 * hexes);
    std::uint64_t* cell = cells.data();
    std::uint64_t tag = 0;
    const std::uint64_t row = nx + 1, layer = row * (ny + 1);
    for (std::uint64_t k = 0; k < nz; ++k) {
        for (std::uint64_t j = 0; j < ny; ++j) {
            for (std::uint64_t i = 0; i < nx; ++i, cell += 9) {
                const std::uint64_t a = 1 + i + j * row + k * layer;
                const std::uint64_t own[] = {++tag,          a,         a + 1,         a + 1 + row,
                                             a + row,        a + layer, a + 1 + layer, a + 1 + row + layer,
                                             a + row + layer};
                for (int c = 0; c < 9; ++c) cell[c] = own[c];
            }
        }
    }

    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(argv[4], "wb"), std::fclose);
    if (!file) {
        std::perror("bare_loop: open");
        return 1;
    }
    put(file.get(), "$MeshFormat\n4.1 1 8\n");
    put(file.get(), 1);
    put(file.get(), "\n$EndMeshFormat\n$Nodes\n");
    for (const std::uint64_t value : {std::uint64_t{1}, nodes, std::uint64_t{1}, nodes})
        put(file.get(), value);
    for (const int value : {3, 1, 0}) put(file.get(), value);
    put(file.get(), nodes);
    put(file.get(), block.tags.data(), block.tags.size() * sizeof(std::uint64_t));
    put(file.get(), block.places.data(), block.places.size() * sizeof(double));
    put(file.get(), "\n$EndNodes\n$Elements\n");
    for (const std::uint64_t value : {std::uint64_t{1}, hexes, std::uint64_t{1}, hexes})
        put(file.get(), value);
    for (const int value : {3, 1, 5}) put(file.get(), value);
    put(file.get(), hexes);
    put(file.get(), cells.data(), cells.size() * sizeof(std::uint64_t));
    put(file.get(), "\n$EndElements\n");
    if (std::fflush(file.get()) != 0) {
        std::perror("bare_loop: write");
        return 1;
    }
    std::printf("%.6f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return 0;
}
