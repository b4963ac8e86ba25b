// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/unv.h>
#include <lacuna/io/shared/units.h>

#include <algorithm>
#include <charconv>

// Datasets 2411 (nodes), 2412 (elements) and 2467 (groups) follow the datasets that are kept as text.
// Integers have the format I10, real numbers D25.16, which holds all 17 digits.

namespace lacuna::io {

namespace {

using mesh::MeshView;

constexpr std::size_t kColumn = 10, kReal = 25; // characters

char* put_double(char* out, double value)
{
    char text[kNumberBytes + 10];
    char* const end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 16).ptr;
    std::replace(text, end, 'e', 'D');
    return put_right(out, {text, static_cast<std::size_t>(end - text)}, kReal);
}

std::string columns(std::initializer_list<long long> numbers)
{
    std::string text;
    for (const long long number : numbers) text += formatted("{:>10}", number);
    return text + "\n";
}

/// Dataset 164. Its first factor converts lengths in metres to lengths in the file.
std::string units(const MeshView& view, const std::string& unit)
{
    const std::string begin = std::string(kUnvMark) + "   164\n";
    if (unit.empty() || (view.kept && view.kept->cards.find(begin) != begin.npos)) return {};
    char factors[3 * kReal + kNumberBytes];
    char* out = put_double(factors, 1 / metres_of(unit));
    for (const double one : {1.0, 1.0}) out = put_double(out, one);
    constexpr int kOwn = 9; // number for units that the dataset defines itself
    return begin + formatted("{:>10}{:<20}{:>10}\n", kOwn, unit, 2) + std::string(factors, out) + "\n" +
           "   0.0000000000000000D+00\n" + std::string(kUnvMark);
}

void add_nodes(const View& view, DeckFile& file)
{
    const auto put = [](std::size_t, DeckTag tag, const Vec3& point, char* out) {
        out = put_text(put_right(out, tag, kColumn), "         1         1        11\n");
        for (const double x : point) out = put_double(out, x);
        return put_text(out, "\n");
    };
    file.sections.push_back(
        section_of_points(std::string(kUnvMark) + "  2411\n", view, 5 * kNumberBytes + 3 * kReal, put));
    file.add(std::string(kUnvMark));
}

void add_elements(const View& view, std::size_t b, DeckFile& file)
{
    const MeshView::Block& block = view->blocks[b];
    long long descriptor = words_of(block.shape).unv;
    if (descriptor == 0) refuse_element(block, "UNV", "there is no such element");
    if (view->kept) std::from_chars(block.type.data(), block.type.data() + block.type.size(), descriptor);
    const std::optional<DeckShape> brick = merged_brick(block.shape);
    const DeckShape shape = brick.value_or(block.shape);
    const auto places = node_places(NodeOrder::unv, shape);
    const auto nodes = static_cast<std::size_t>(shape_info(shape).nodes);
    const auto put = [=](std::size_t, DeckTag tag, Index region, std::span<const Index> element, char* out) {
        out = put_right(out, tag, kColumn);
        out = put_right(out, descriptor, kColumn);
        out = put_right(out, region < 0 ? 0 : view->regions[index(region)].tag, kColumn);
        out = put_text(out, "         1         7");
        out = put_right(out, static_cast<long long>(nodes), kColumn);
        for (std::size_t k = 0; k < nodes; ++k) {
            if (k % (kCardColumns / kColumn) == 0) *out++ = '\n';
            const std::size_t at = brick ? kMergedBrick[places[k]] : places[k];
            out = put_right(out, view->point_tags[index(element[at])], kColumn);
        }
        return put_text(out, "\n");
    };
    file.sections.push_back(section_of_cells(view, b, (nodes + 7) * kNumberBytes + 4, put));
}

/// Add the members of a set, two on each line.
void add_members(const View& view, std::size_t set, std::string head, DeckFile& file)
{
    const int kind = view->sets[set].kind == mesh::SetKind::nodes ? kUnvNode : kUnvElement;
    const auto put = [kind, count = view->sets[set].count](std::size_t i, DeckTag tag, char* out) {
        out = put_right(put_right(out, kind, kColumn), tag, kColumn);
        return put_text(out, "         0         0", i % 2 == 1 || i + 1 == count ? "\n" : "");
    };
    file.sections.push_back(section_of_members(std::move(head), view, set, 4 * kNumberBytes + 1, put));
}

} // namespace

DeckFile unv_file(const View& view, const MeshFileOptions& options, const mesh::ViewParts* /*parts*/)
{
    check_numbers(*view, highest_of(kColumn), "a universal file", "write another format");
    const std::vector<MeshView::Set>& sets = view->sets;
    DeckFile file;
    if (view->kept) file.add(view->kept->cards);
    file.add(units(*view, options.unit));
    add_nodes(view, file);
    file.add(std::string(kUnvMark) + "  2412\n");
    for (std::size_t b = 0; b < view->blocks.size(); ++b) add_elements(view, b, file);
    file.add(std::string(kUnvMark));
    if (view->kept) file.add(view->kept->tail);
    std::string head = std::string(kUnvMark) + "  2467\n";
    bool groups = false;
    int number = highest_tag(sets);
    std::vector<std::string> names;
    for (std::size_t s = 0; s < sets.size(); ++s) {
        const MeshView::Set& set = sets[s];
        if (set.kind == mesh::SetKind::sides || set.count == 0) continue;
        // A group of elements and nodes was read as two sets: write these as one group.
        const bool two = s + 1 < sets.size() && set.tag > 0 && sets[s + 1].tag == set.tag &&
                         sets[s + 1].name == set.name && sets[s + 1].kind == mesh::SetKind::nodes;
        const std::size_t count = set.count + (two ? sets[s + 1].count : 0);
        head += columns({set.tag > 0 ? set.tag : ++number, 0, 0, 0, 0, 0, 0, static_cast<long long>(count)});
        const std::string name = free_name(set.name, DeckFormat::unv, [&](const std::string& other) {
            return !view->kept && find_word(names, other) != names.end();
        });
        if (name != set.name) file.notes.push_back(formatted("the set {} is called {}", set.name, name));
        names.push_back(name);
        head += name + "\n";
        add_members(view, s, std::move(head), file);
        groups = true;
        if (two) add_members(view, ++s, {}, file);
        head.clear();
    }
    if (groups) file.add(std::string(kUnvMark));
    return file;
}

} // namespace lacuna::io
