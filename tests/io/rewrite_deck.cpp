// SPDX-License-Identifier: MIT
//
// Reads a deck and writes it, for tests that give what was written to other readers:
//   rewrite_deck IN OUT [2.2] [text]
// What is not carried over is said, a line each. With - for OUT nothing is written, and the seconds of the
// reading and the counts of nodes and elements are said, for benchmarks.
#include <lacuna/core/error.h>
#include <lacuna/io/mesh_file.h>

#include <chrono>
#include <cstdio>
#include <string_view>

int main(int count, char** arguments)
{
    using namespace lacuna;
    if (count < 3) return std::fputs("usage: rewrite_deck IN OUT [2.2] [text]\n", stderr), 2;
    io::MeshFileOptions options;
    for (int i = 3; i < count; ++i) {
        if (arguments[i] == std::string_view("2.2")) options.version = 2.2;
        if (arguments[i] == std::string_view("text")) options.binary = false;
    }
    options.all_groups = options.version != 2.2;
    try {
        const auto begin = std::chrono::steady_clock::now();
        const io::Deck deck = io::read_deck(arguments[1]);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        if (arguments[2] == std::string_view("-")) {
            std::printf("%.3f %zu %zu\n", seconds.count(), deck.points.size(), deck.element_count());
            return 0;
        }
        const io::Format* const format = io::find_format(arguments[2]);
        if (format == nullptr || !format->is_written)
            return std::fputs("the second ending is of no format that is written\n", stderr), 2;
        RunContext context;
        context.log = [](std::string_view line) {
            std::printf("%.*s\n", static_cast<int>(line.size()), line.data());
        };
        for (const std::string& note : deck.notes) std::printf("%s\n", note.c_str());
        io::write_deck(deck, *format, io::OutputPath(arguments[2]), context, options);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
