// SPDX-License-Identifier: MIT
//
// Bytes as a file of one format: an error of ours or a sound reading, nothing else.
#include <lacuna/core/error.h>
#include <lacuna/io/load_facets.h>

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

/// Ends the program, so that the driver or libFuzzer keeps the bytes.
void demand(bool holds)
{
    if (!holds) std::abort();
}

template <class Cells>
void check_cells(const Cells& cells, const std::vector<int>& labels, const lacuna::io::FacetFile& file)
{
    demand(cells.size() == labels.size());
    for (const auto& cell : cells)
        for (const lacuna::Index p : cell) demand(p >= 0 && lacuna::index(p) < file.soup.points.size());
    for (const int label : labels) demand(label >= 0 && lacuna::index(label) < file.label_tag.size());
}

} // namespace

extern "C" const char* const kFuzzEnding = LACUNA_FUZZ_ENDING;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        const lacuna::io::FacetFile file = lacuna::io::read_facets(
            "/nowhere/fuzz" + std::string(LACUNA_FUZZ_ENDING), bytes);
        check_cells(file.soup.triangles, file.soup.triangle_label, file);
        check_cells(file.soup.quads, file.soup.quad_label, file);
        demand(file.soup.triangles.size() + file.soup.quads.size() > 0);
        demand(file.soup.label_name.size() == file.label_tag.size());
        for (const lacuna::Vec3& p : file.soup.points) demand(p.allFinite());
    } catch (const lacuna::InvalidInput& error) {
        demand(error.code().starts_with("io.") && std::string_view(error.what()).size() > 20);
    }
    return 0;
}
