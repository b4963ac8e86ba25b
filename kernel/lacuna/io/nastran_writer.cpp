// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/constants.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/nastran.h>
#include <lacuna/io/detail/periodic_nodes.h>
#include <lacuna/io/detail/side_nodes.h>

#include <algorithm>
#include <array>
#include <map>

// Nodes are written in large fields, in the basic frame. Elements are written in small fields if their
// numbers fit. Fields that were read from a card keep their text; if they do not fit, the card is written in
// free format.

namespace lacuna::io {

namespace {

using mesh::MeshView;

/// Collects the fields of a card and writes it.
class CardWriter {
public:
    void begin() { fields_.clear(), used_ = 0; }
    void add(std::string_view field) { fields_.push_back(field); }
    /// @param number  negative: the field is blank
    void add_number(DeckTag number)
    {
        if (number < 0) return add({});
        add_digits([&](char* at) { return put_text(at, number); });
    }
    void add_real(double value)
    {
        add_digits([&](char* at) { return put_real(at, value, kLargeCardField, RealForm::nastran); });
    }
    /// Add several fields, given as a text with commas between them.
    void add_text(std::string_view text)
    {
        while (!text.empty()) {
            const std::size_t end = std::min(text.find(','), text.size());
            add(text.substr(0, end));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
    }
    char* put(char* out, std::string_view name, bool large = false)
    {
        while (!fields_.empty() && fields_.back().empty()) fields_.pop_back();
        std::size_t longest = large ? kLargeCardField : 0;
        for (const std::string_view field : fields_) longest = std::max(longest, field.size());
        if (longest > kLargeCardField) return put_free(out, name);
        const std::size_t width = longest > kCardField ? kLargeCardField : kCardField;
        const std::size_t per_line = 8 * kCardField / width;
        const std::string_view next = width == kCardField ? "+" : "*";
        out = put_text(out, name, width == kLargeCardField ? "*" : "");
        std::size_t column = name.size() + (width == kLargeCardField ? 1 : 0);
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            std::size_t start = kCardField + f % per_line * width;
            if (f > 0 && f % per_line == 0) {
                out = put_text(out, "\n", next);
                column = next.size();
                start = kCardField;
            }
            start += width - fields_[f].size();
            for (; column < start; ++column) *out++ = ' ';
            out = put_text(out, fields_[f]);
            column += fields_[f].size();
        }
        return put_text(out, "\n");
    }
    /// Upper bound on the bytes of a card with this number of fields, none longer than `longest`.
    static std::size_t room(std::size_t fields, std::size_t longest)
    {
        return (std::max(longest, kLargeCardField) + 4) * (fields + 8) + 32;
    }

private:
    template <class Put>
    void add_digits(const Put& put)
    {
        char* const at = digits_.data() + used_;
        used_ += kNumberBytes;
        fields_.emplace_back(at, put(at));
    }
    char* put_free(char* out, std::string_view name)
    {
        out = put_text(out, name);
        for (std::size_t f = 0; f < fields_.size(); ++f)
            out = put_text(out, f > 0 && f % 8 == 0 ? "\n+," : ",", fields_[f]);
        return put_text(out, "\n");
    }

    std::vector<std::string_view> fields_;
    std::array<char, 32 * kNumberBytes> digits_{}; ///< digits of the numbers of a card; a CHEXA has 22
    std::size_t used_ = 0;
};

/// Number of bytes that the longest of the texts takes when it is written as fields.
std::size_t room_of(MeshView::TextByIndex more)
{
    std::size_t room = 0;
    for (const auto& [at, text] : more) {
        const auto fields = static_cast<std::size_t>(std::ranges::count(text, ',')) + 1;
        room = std::max(room, CardWriter::room(fields, text.size()));
    }
    return room;
}

void add_nodes(const View& view, DeckFile& file)
{
    const MeshView::TextByIndex more = view->kept ? view->kept->points : MeshView::TextByIndex();
    const auto put = [more, card = CardWriter()](std::size_t p, DeckTag tag, const Vec3& point,
                                                 char* out) mutable {
        card.begin();
        card.add_number(tag);
        card.add({});
        for (const double x : point) card.add_real(x);
        card.add_text(text_of(more, p));
        return card.put(out, "GRID", true);
    };
    file.sections.push_back(
        section_of_points({}, view, CardWriter::room(5, kLargeCardField) + room_of(more), put));
}

void add_elements(const View& view, std::size_t b, DeckFile& file)
{
    const MeshView::Block& block = view->blocks[b];
    const std::string_view name = view->kept && !block.type.empty() ? std::string_view(block.type)
                                                                    : words_of(block.shape).nastran;
    if (name.empty()) refuse_element(block, "Nastran", "there is no such card");
    const auto nodes = static_cast<std::size_t>(shape_info(block.shape).nodes);
    const auto places = node_places(NodeOrder::exodus, block.shape);
    const MeshView::TextByIndex more = view->kept ? view->kept->cells[b] : MeshView::TextByIndex();
    const auto put = [=, card = CardWriter()](std::size_t e, DeckTag tag, Index region,
                                              std::span<const Index> element, char* out) mutable {
        card.begin();
        card.add_number(tag);
        const int property = region < 0 ? 0 : view->regions[index(region)].tag;
        card.add_number(property > 0 ? property : -1);
        for (std::size_t k = 0; k < nodes; ++k) {
            const Index node = element[places[k]];
            card.add_number(node < 0 ? -1 : view->point_tags[index(node)]);
        }
        card.add_text(text_of(more, e));
        return card.put(out, name);
    };
    file.sections.push_back(
        section_of_cells(view, b, CardWriter::room(nodes + 2, kNumberBytes) + room_of(more), put));
}

/// A SET1 card. The card does not state whether its members are nodes or elements, so a comment does.
std::string set_text(const MeshView::Set& set, int number)
{
    CardWriter card;
    const std::string id = std::to_string(number);
    std::vector<std::string> members;
    set.members.each(0, set.count,
                     [&](std::size_t, DeckTag member) { members.push_back(std::to_string(member)); });
    card.begin();
    card.add(id);
    std::size_t longest = id.size();
    for (const std::string& member : members) {
        card.add(member);
        longest = std::max(longest, member.size());
    }
    std::string text(CardWriter::room(members.size() + 1, longest), '\0');
    text.resize(static_cast<std::size_t>(card.put(text.data(), "SET1") - text.data()));
    return "$ " + std::string(set.kind == mesh::SetKind::nodes ? "nodes" : "elements") + " of " + set.name +
           "\n" + text;
}

/// For decks from another format: comments with the names of the properties, and property cards for solids.
std::string property_text(const MeshView& view)
{
    std::vector<bool> solid(view.regions.size(), false);
    for (const MeshView::Block& block : view.blocks)
        if (shape_info(block.shape).dimension == 3)
            for (const auto& [end, region] : block.regions)
                if (region >= 0) solid[index(region)] = true;
    std::string text;
    for (std::size_t r = 0; r < solid.size(); ++r) {
        const std::string tag = std::to_string(view.regions[r].tag);
        text += "$ property " + tag + " is " + view.regions[r].name + "\n";
        if (solid[r]) text += "PSOLID," + tag + ",1\n";
    }
    return text;
}

std::string real(double value) { return real_text(value, kLargeCardField, RealForm::nastran); }

/// Multipoint constraints of periodic faces, all in set 1, with a GRID for each reference node.
std::string periodic_text(const MeshView& view)
{
    if (view.periodic.empty()) return {};
    const PeriodicEquations all = periodic_equations(view);
    std::string text = "$ periodic faces: MPC = 1 in the case control\n";
    for (std::size_t p = 0; p < all.number.size(); ++p) {
        if (all.number[p] == kNoIndex) continue;
        const Vec3& at = all.references[all.number[p]];
        const std::string tag = std::to_string(all.tag(p));
        text += "$ the displacement of node " + tag + " is the difference across periodic_" +
                std::to_string(p + 1) + "\nGRID," + tag + ",," + real(at.x()) + "," + real(at.y()) + "," +
                real(at.z()) + "\n";
    }
    for (const std::vector<PeriodicTerm>& terms : all.equations) {
        text += "MPC,1";
        for (std::size_t t = 0; t < terms.size(); ++t) {
            if (t > 0 && t % 2 == 0) text += ",\n+,";
            text += formatted(",{},{},{}", terms[t].tag, terms[t].direction + 1, real(terms[t].factor));
        }
        text += "\n";
    }
    return text;
}

/// Write each side of a contact as a region of solid faces (BSURFS), ties as glue set 1 (BGSET), and other
/// contacts as contact set 1 (BCTSET), as in the manuals of Simcenter Nastran.
std::string contact_text(const MeshView& view)
{
    if (view.contacts.empty()) return {};
    const SideNodes sides(view);
    std::string text, glued, contact;
    std::size_t region = 0;
    for (const mesh::ContactPair& pair : view.contacts) {
        for (const std::size_t s : {0, 1}) {
            text += "$ faces of " + pair.groups[s] + "\nBSURFS," + std::to_string(++region) + ",,,";
            std::size_t count = 0; // one face on the first line, two on each other
            for (const DeckSide& side : view.sets[pair.sets[s]].sides) {
                if (count++ % 2 == 1) text += "\n+";
                text += "," + std::to_string(side.element);
                for (const Index node : sides[side].first(3))
                    text += "," + std::to_string(view.point_tags[index(node)]);
            }
            text += "\n";
        }
        std::string& set = pair.tied ? glued : contact;
        set += set.empty() ? (pair.tied ? "BGSET,1," : "BCTSET,1,") : ",,\n+,,";
        set += std::to_string(region - 1) + "," + std::to_string(region) + "," +
               (pair.tied ? real(pair.tolerance) + ",," : ",0.," + real(pair.tolerance));
    }
    if (!glued.empty()) text += "$ ties: BGSET = 1 in the case control\n" + glued + "\n";
    if (!contact.empty()) text += "$ contacts: BCSET = 1 in the case control\n" + contact + "\n";
    return text;
}

/// Coordinate systems: one for all cells that have the same axes, with a MATCID card that assigns it to them.
std::string orientation_text(const MeshView& view)
{
    std::map<std::array<std::string, 6>, std::vector<DeckTag>> cells; // numbers of the cells, by the z axis
                                                                      // and the direction of x
    for (std::size_t b = 0; b < view.blocks.size(); ++b) {
        if ((*view.frames)[b].empty()) continue;
        view.blocks[b].tags.each(0, view.blocks[b].count, [&](std::size_t i, DeckTag tag) {
            if ((*view.frames)[b][i].column.isZero()) return;
            const std::array<Vec3, 3> axes = (*view.frames)[b][i].material();
            std::array<std::string, 6> key;
            for (std::size_t k = 0; k < 6; ++k)
                key[k] = real(axes[k < 3 ? 2 : 0][static_cast<Eigen::Index>(k % 3)]);
            cells[key].push_back(tag);
        });
    }
    std::string text = "$ material axes: along the columns, radial, normal to both\n";
    std::size_t number = 0;
    for (auto& [key, tags] : cells) {
        const std::string own = std::to_string(++number);
        text += "CORD2R," + own + ",,0.,0.,0.," + key[0] + "," + key[1] + "," + key[2] + "\n+," + key[3] +
                "," + key[4] + "," + key[5] + "\nMATCID," + own;
        std::ranges::sort(tags);
        for (std::size_t t = 0; t < tags.size(); ++t)
            text += ((t + 1) % 8 == 0 ? "\n+," : ",") + std::to_string(tags[t]);
        text += "\n";
    }
    return text;
}

} // namespace

DeckFile nastran_file(const View& view, const MeshFileOptions& options, const mesh::ViewParts* /*parts*/)
{
    static const MeshView::KeptText own{
        .head = "BEGIN BULK\n", .cards = {}, .tail = "ENDDATA\n", .instance = {}, .points = {}, .cells = {}};
    const MeshView::KeptText& kept = view->kept ? *view->kept : own;
    DeckFile file;
    file.add(kept.head + unit_comment(*view, "$", options.unit));
    add_nodes(view, file);
    for (std::size_t b = 0; b < view->blocks.size(); ++b) add_elements(view, b, file);
    file.add(kept.cards);
    std::string text;
    int number = kept.highest_set;
    for (const MeshView::Set& set : view->sets)
        if (set.count > 0) text += set_text(set, ++number);
    if (!view->kept) text += property_text(*view);
    text += periodic_text(*view) + contact_text(*view);
    if (view->frames) text += orientation_text(*view);
    file.add(std::move(text));
    file.add(kept.tail);
    return file;
}

} // namespace lacuna::io
