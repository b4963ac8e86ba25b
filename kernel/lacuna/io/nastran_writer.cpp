// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/exodus.h>
#include <lacuna/io/detail/nastran.h>

#include <algorithm>
#include <array>

// Nodes in large fields, in the basic frame; elements in small fields where their numbers fit. Fields that a
// card brought along keep their text, if need be in free fields.

namespace lacuna::io {
namespace {

constexpr std::size_t kSmall = 8, kLarge = 16; // characters of a field
constexpr std::size_t kNumber = 20;            // characters of a tag, at most

/// Gathers the fields of a card and puts it out.
class CardWriter {
public:
    void begin() { fields_.clear(), used_ = 0; }
    void add(std::string_view field) { fields_.push_back(field); }
    void add_number(DeckTag number)
    {
        char* const at = digits_.data() + used_;
        char* const end = put_text(at, number);
        used_ += kNumber;
        fields_.emplace_back(at, static_cast<std::size_t>(end - at));
    }
    void add_real(double value)
    {
        char* const at = digits_.data() + used_;
        char* const end = put_real(at, value, kLarge, RealForm::nastran);
        used_ += kNumber;
        fields_.emplace_back(at, static_cast<std::size_t>(end - at));
    }
    /// Fields apart by commas.
    void add_text(std::string_view text)
    {
        while (!text.empty()) {
            const std::size_t end = std::min(text.find(','), text.size());
            add(text.substr(0, end));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
    }
    void fill_to(std::size_t count)
    {
        while (fields_.size() < count) add({});
    }
    char* put(char* out, std::string_view name, bool large = false)
    {
        while (!fields_.empty() && fields_.back().empty()) fields_.pop_back();
        std::size_t longest = large ? kLarge : 0;
        for (const std::string_view field : fields_) longest = std::max(longest, field.size());
        if (longest > kLarge) return put_free(out, name);
        const std::size_t width = longest > kSmall ? kLarge : kSmall;
        const std::size_t per_line = 8 * kSmall / width;
        const std::string_view next = width == kSmall ? "+" : "*";
        out = put_words(out, name);
        if (width == kLarge) *out++ = '*';
        std::size_t column = name.size() + (width == kLarge ? 1 : 0);
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            std::size_t start = kSmall + f % per_line * width;
            if (f > 0 && f % per_line == 0) {
                *out++ = '\n';
                out = put_words(out, next);
                column = next.size();
                start = kSmall;
            }
            start += width - fields_[f].size();
            for (; column < start; ++column) *out++ = ' ';
            out = put_words(out, fields_[f]);
            column += fields_[f].size();
        }
        *out++ = '\n';
        return out;
    }
    /// No card of so many fields, none longer, takes more bytes.
    static std::size_t room(std::size_t fields, std::size_t longest)
    {
        return (std::max(longest, kLarge) + 4) * (fields + 8) + 32;
    }

private:
    char* put_free(char* out, std::string_view name)
    {
        out = put_words(out, name);
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            if (f > 0 && f % 8 == 0) out = put_words(out, "\n+");
            *out++ = ',';
            out = put_words(out, fields_[f]);
        }
        *out++ = '\n';
        return out;
    }

    std::vector<std::string_view> fields_;
    std::array<char, 32 * kNumber> digits_{}; ///< of the numbers of a card; a CHEXA has 22
    std::size_t used_ = 0;
};

using Further = std::vector<std::pair<std::size_t, std::string>>;

/// Bytes that the longest text takes as fields.
std::size_t room_of(const Further& further)
{
    std::size_t room = 0;
    for (const auto& [at, text] : further) {
        const auto fields = static_cast<std::size_t>(std::ranges::count(text, ',')) + 1;
        room = std::max(room, CardWriter::room(fields, text.size()));
    }
    return room;
}

std::string_view text_of_place(const Further& further, std::size_t place)
{
    const auto at = std::ranges::lower_bound(further, place, {}, &Further::value_type::first);
    return at != further.end() && at->first == place ? std::string_view(at->second) : std::string_view();
}

void add_nodes(const Deck& deck, const BulkReader& bulk, bool same, DeckFile& file)
{
    const std::size_t more = same ? room_of(deck.point_more) : 0;
    const auto put = [&deck, same, card = CardWriter()](std::size_t p, DeckTag tag, const Vec3& point,
                                                        char* out) mutable {
        card.begin();
        card.add_number(tag);
        card.add({});
        for (const double x : point) card.add_real(x);
        if (same) card.add_text(text_of_place(deck.point_more, p));
        return card.put(out, "GRID", true);
    };
    file.sections.push_back(section_of_points({}, bulk, CardWriter::room(5, kLarge) + more, put));
}

void add_elements(const Deck& deck, const BulkReader& bulk, const DeckBlock& block, bool same, DeckFile& file)
{
    const std::string_view name = same && !block.type.empty() ? std::string_view(block.type)
                                                              : words_of(block.shape).nastran;
    if (name.empty()) refuse_element(block, "Nastran", "there is no such card");
    const auto nodes = static_cast<std::size_t>(shape_info(block.shape).nodes);
    const auto places = exodus_places(block.shape); // which Nastran has too
    const std::size_t more = same ? room_of(block.more) : 0;
    const auto put = [=, &deck, &block, card = CardWriter()](std::size_t e, DeckTag tag, Index region,
                                                             std::span<const Index> element,
                                                             char* out) mutable {
        card.begin();
        card.add_number(tag);
        const int property = region < 0 ? 0 : deck.regions[index(region)].tag;
        if (property > 0)
            card.add_number(property);
        else
            card.add({});
        for (std::size_t k = 0; k < nodes; ++k) {
            const Index node = element[places.empty() ? k : places[k]];
            if (node < 0)
                card.add({});
            else
                card.add_number(bulk.point_tag(node));
        }
        if (same) card.add_text(text_of_place(block.more, e));
        return card.put(out, name);
    };
    file.sections.push_back(
        section_of_elements(bulk, block, CardWriter::room(nodes + 2, kNumber) + more, put));
}

/// SET1, which names no kind: a comment does.
std::string set_text(const DeckSet& set, int number)
{
    CardWriter card;
    const std::string id = std::to_string(number);
    std::vector<std::string> members;
    for (const DeckTag member : set.members) members.push_back(std::to_string(member));
    card.begin();
    card.add(id);
    std::size_t longest = id.size();
    for (const std::string& member : members) {
        card.add(member);
        longest = std::max(longest, member.size());
    }
    std::string text(CardWriter::room(members.size() + 1, longest), '\0');
    text.resize(static_cast<std::size_t>(card.put(text.data(), "SET1") - text.data()));
    return "$ " + std::string(set.kind == DeckSet::Kind::nodes ? "nodes" : "elements") + " of " + set.name +
           "\n" + text;
}

/// Names of the properties of another format's deck, and cards of those that solids have.
std::string property_text(const Deck& deck)
{
    std::vector<bool> solid(deck.regions.size(), false);
    for (const DeckBlock& block : deck.blocks)
        if (shape_info(block.shape).dimension == 3)
            for (const Index region : block.regions)
                if (region >= 0) solid[index(region)] = true;
    std::string text;
    for (std::size_t r = 0; r < solid.size(); ++r) {
        const std::string tag = std::to_string(deck.regions[r].tag);
        text += "$ property " + tag + " is " + deck.regions[r].name + "\n";
        if (solid[r]) text += "PSOLID," + tag + ",1\n";
    }
    return text;
}

} // namespace

DeckFile nastran_file(const Deck& deck, const LayeredBulk* layered)
{
    const BulkReader bulk(deck, layered);
    const bool same = deck.format == DeckFormat::nastran;
    DeckFile file;
    file.sections.push_back({same ? text_at(deck, DeckText::Place::head) : "BEGIN BULK\n", 0, 0, {}});
    add_nodes(deck, bulk, same, file);
    for (const DeckBlock& block : deck.blocks) add_elements(deck, bulk, block, same, file);
    std::string text = same ? text_at(deck, DeckText::Place::cards) : std::string();
    int number = static_cast<int>(numbers_in_text(deck).set);
    for (const DeckSet& set : deck.sets)
        if (!set.members.empty()) text += set_text(set, ++number);
    if (!same) text += property_text(deck);
    const std::string tail = same ? text_at(deck, DeckText::Place::tail) : "ENDDATA\n";
    file.sections.push_back({text + tail, 0, 0, {}});
    return file;
}

} // namespace lacuna::io
