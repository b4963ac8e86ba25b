// SPDX-License-Identifier: MIT
//
// Bytes as a file of one format: an error of ours or a sound reading, nothing else.
#include <lacuna/core/error.h>
#include <lacuna/io/deck.h>
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

/// Every array of a deck is as long as it should be and names what is there.
void check_deck(const lacuna::io::Deck& deck)
{
    demand(deck.point_tags.size() == deck.points.size());
    for (const lacuna::Vec3& p : deck.points) demand(p.allFinite());
    for (const lacuna::io::DeckBlock& block : deck.blocks) {
        const auto per = static_cast<std::size_t>(lacuna::io::shape_info(block.shape).nodes);
        const auto corners = static_cast<std::size_t>(lacuna::io::shape_info(block.shape).corners);
        demand(block.nodes.size() == per * block.count() && block.regions.size() == block.count());
        for (std::size_t i = 0; i < block.nodes.size(); ++i)
            demand(block.nodes[i] < static_cast<lacuna::Index>(deck.points.size()) &&
                   block.nodes[i] >= (i % per < corners ? 0 : -1));
        for (const lacuna::Index region : block.regions)
            demand(region >= 0 && lacuna::index(region) < deck.regions.size());
        for (const auto& more : block.more) demand(more.first < block.count());
    }
    for (const auto& more : deck.point_more) demand(more.first < deck.points.size());
    for (const lacuna::io::DeckSet& set : deck.sets) {
        for (std::size_t m = 1; m < set.members.size(); ++m) demand(set.members[m - 1] < set.members[m]);
        for (std::size_t m = 1; m < set.sides.size(); ++m) demand(set.sides[m - 1] < set.sides[m]);
    }
}

} // namespace

extern "C" const char* const kFuzzEnding; // of the files' names, which tells the format

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        check_deck(lacuna::io::read_deck("/nowhere/fuzz" + std::string(kFuzzEnding), bytes));
        const lacuna::io::FacetFile file = lacuna::io::read_facets("/nowhere/fuzz" + std::string(kFuzzEnding),
                                                                   bytes);
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
