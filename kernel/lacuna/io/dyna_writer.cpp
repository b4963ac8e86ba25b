// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/dyna.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/side_nodes.h>

#include <algorithm>
#include <map>
#include <set>

namespace lacuna::io {
namespace {

using enum DeckShape;
using namespace dyna_keyword;
using mesh::MeshView;
using mesh::SetKind;

class DynaWriter {
public:
    DynaWriter(const View& view, const std::string& unit) : view_(view), sides_(*view)
    {
        own_.head = "*KEYWORD\n", own_.tail = "*END\n";
        kept_ = view_->kept && !view_->kept->head.empty() ? &*view_->kept : &own_;
        const std::string head = upper(kept_->head);
        // A deck in long format may contain cards in the standard format; their keywords need the sign "-".
        const bool is_plain = head.find("LONG=") == head.npos && head.find("I10=") == head.npos;
        end_ = is_plain ? "\n" : " -\n";
        file_.add(kept_->head + unit_comment(*view_, "$", unit));
    }

    DeckFile write()
    {
        each_dyna_card(kept_->cards,
                       [&](const std::string& keyword, const std::vector<std::string_view>& lines) {
                           scan(keyword, lines);
                       });
        add_nodes();
        for (std::size_t b = 0; b < view_->blocks.size(); ++b) add_elements(b);
        file_.add(kept_->cards);
        for (std::size_t r = 0; r < view_->regions.size(); ++r) add_part(r);
        numbers_.resize(view_->sets.size());
        for (std::size_t s = 0; s < view_->sets.size(); ++s) add_set(s);
        add_contacts();
        file_.add(kept_->tail);
        return std::move(file_);
    }

private:
    /// Record the numbers of parts, sections and sets in the kept text.
    void scan(const std::string& keyword, const std::vector<std::string_view>& lines)
    {
        const auto number = [&](std::size_t line) {
            const auto fields = line < lines.size()
                                    ? dyna_fields(lines[line], kDynaSetField, kDynaSetField, 1)
                                    : std::vector<std::string_view>();
            return fields.empty() ? 0 : parse_integer<int>(fields[0]).value_or(0);
        };
        const std::size_t titled = keyword.ends_with("_TITLE") ? 1 : 0;
        if (keyword == "PART" || keyword.starts_with("PART_"))
            for (std::size_t k = 1; k < lines.size(); k += keyword == "PART" ? 2 : lines.size())
                parts_.push_back(number(k));
        if (keyword.starts_with("SECTION_")) highest_section_ = std::max(highest_section_, number(titled));
        if (keyword.starts_with("SET_")) highest_set_ = std::max(highest_set_, number(titled));
        if (keyword.starts_with("CONTACT_")) highest_contact_ = std::max(highest_contact_, number(0));
    }

    void add_nodes()
    {
        const auto put = [more = view_->kept ? kept_->points : MeshView::TextByIndex()](
                             std::size_t p, DeckTag tag, const Vec3& point, char* out) {
            out = put_right(out, tag, kCardField);
            for (const double x : point) {
                char text[kLargeCardField];
                out = put_right(out,
                                {text, static_cast<std::size_t>(put_real(text, x, kLargeCardField) - text)},
                                kLargeCardField);
            }
            return put_text(out, text_of(more, p), "\n");
        };
        file_.sections.push_back(
            section_of_points("*NODE" + end_, view_, 3 * (kCardField + kLargeCardField) + 1, put));
    }

    void add_elements(std::size_t b)
    {
        const MeshView::Block& block = view_->blocks[b];
        if (block.count == 0) return;
        const auto [dimension, corners, nodes] = shape_info(block.shape);
        const auto pattern = std::ranges::find(kDegenerate, block.shape, &Degenerate::shape);
        std::string keyword(dimension == 2 ? kShell : block.shape == hex20 ? kSolid20 : kSolid);
        if (view_->kept && block.type == kThick) keyword = kThick;
        const bool shell = block.shape == tri3 || block.shape == quad4 || block.shape == quad8;
        if (pattern == std::end(kDegenerate) && block.shape != tet10 && block.shape != hex20 && !shell)
            refuse_element(block, "LS-DYNA", "there is no such element");
        file_.add("*" + keyword + end_);
        const auto put = [=, view = view_](std::size_t, DeckTag tag, Index region, std::span<const Index> own,
                                           char* out) {
            out = put_right(out, tag, kCardField);
            out = put_right(out, region < 0 ? 0 : view->regions[index(region)].tag, kCardField);
            const auto put_node = [&](std::size_t k) {
                out = put_right(out, view->point_tags[index(own[k])], kCardField);
            };
            if (pattern != std::end(kDegenerate)) {
                for (const std::uint8_t k : pattern->fields) put_node(k);
            } else {
                for (std::size_t k = 0; k < own.size(); ++k) {
                    if (!shell && k % 10 == 0) *out++ = '\n';
                    put_node(k);
                }
                if (own.size() == 3) put_node(2);
            }
            return put_text(out, "\n");
        };
        file_.sections.push_back(section_of_cells(view_, b, 24 * kCardField, put));
        for (const auto& [end, region] : block.regions)
            if (region >= 0) forms_[region].insert(block.shape);
        for (const auto& [end, region] : block.regions)
            if (block.type.starts_with("COH")) cohesive_.insert(region);
    }

    /// Add the part of a region, if no card defines it, and a section for its solids.
    void add_part(std::size_t r)
    {
        const auto forms = forms_.find(static_cast<Index>(r));
        const int tag = view_->regions[r].tag;
        if (forms == forms_.end() || std::ranges::find(parts_, tag) != parts_.end()) return;
        const bool solid = shape_info(*forms->second.rbegin()).dimension == 3;
        const int section = highest_section_ > 0 ? ++highest_section_ : tag;
        std::string text = "*PART" + end_ + title(view_->regions[r].name) + "\n";
        for (const int field : {tag, section, 1}) text += formatted("{:>10}", field);
        text += "\n";
        if (solid) {
            const bool one = forms->second.size() == 1;
            const int form = cohesive_.contains(forms->first)       ? 19
                             : one && forms->second.contains(hex20) ? 23
                             : one && forms->second.contains(tet10) ? 16
                             : one && forms->second.contains(tet4)  ? 10
                                                                    : 1;
            text += formatted("*SECTION_SOLID{}{:>10}{:>10}\n", end_, section, form);
        }
        file_.add(std::move(text));
    }

    std::string title(const std::string& name)
    {
        if (name.size() > kCardColumns)
            file_.notes.push_back(formatted("{} is called {}", name, name.substr(0, kCardColumns)));
        return name.substr(0, kCardColumns);
    }

    void add_set(std::size_t s)
    {
        const MeshView::Set& set = view_->sets[s];
        if (set.kind == SetKind::sides) return add_segments(set);
        if (set.count == 0) return;
        if (set.kind == SetKind::nodes) return add_members(s, "*SET_NODE_LIST_TITLE", set.members);
        mesh::Ranges of[2]; // solids, shells
        if (shells_.empty())
            shells_ = tags_of_blocks(*view_,
                                     [](const auto& b) { return shape_info(b.shape).dimension == 2; });
        if (shells_.empty()) return add_members(s, "*SET_SOLID_TITLE", set.members);
        set.members.each(0, set.count, [&](std::size_t, DeckTag tag) {
            of[std::ranges::binary_search(shells_, tag) ? 1 : 0].add(index(tag), index(tag) + 1);
        });
        for (const std::size_t k : {0, 1})
            if (const std::size_t count = of[k].count(); count > 0)
                add_members(s, k == 0 ? "*SET_SOLID_TITLE" : "*SET_SHELL_LIST_TITLE",
                            mesh::Numbers(std::move(of[k])), count);
    }

    std::string head_of(const MeshView::Set& set, const std::string& keyword)
    {
        int tag = set.tag;
        if (tag <= 0 || !ids_[keyword].insert(tag).second)
            tag = highest_set_ = highest_tag(view_->sets, highest_set_) + 1;
        numbers_[static_cast<std::size_t>(&set - view_->sets.data())] = tag;
        return keyword + end_ + title(set.name) + "\n" + formatted("{:>10}\n", tag);
    }

    void add_members(std::size_t s, const std::string& keyword, mesh::Numbers members, std::size_t count = 0)
    {
        if (count == 0) count = view_->sets[s].count;
        file_.sections.push_back(
            {head_of(view_->sets[s], keyword), count, kDynaSetField + 1,
             [members = std::move(members), count](std::size_t begin, std::size_t end, char* out) {
                 members.each(begin, end, [&](std::size_t i, DeckTag tag) {
                     out = put_right(out, tag, kDynaSetField);
                     if ((i + 1) % (kCardColumns / kDynaSetField) == 0 || i + 1 == count) *out++ = '\n';
                 });
                 return out;
             }});
    }

    void add_segments(const MeshView::Set& set)
    {
        std::string text;
        sides_.each_face(set, file_.notes, [&](std::span<const Index> nodes) {
            const std::size_t corners = nodes.size() == 3 || nodes.size() == 6 ? 3 : 4;
            char line[4 * kNumberBytes];
            char* out = line;
            for (std::size_t k = 0; k < 4; ++k)
                out = put_right(out, view_->point_tags[index(nodes[std::min(k, corners - 1)])],
                                kDynaSetField);
            text.append(line, out).append("\n");
        });
        if (!text.empty()) file_.add(head_of(set, "*SET_SEGMENT_TITLE") + text);
    }

    /// Add each contact pair as two segment sets: surface A is the slave, surface B the master. A tied
    /// contact with an offset moves no node. Fields 3 and 4 of its third card are thicknesses; if they are
    /// negative, nodes are tied by distance alone (PyDYNA's keyword classes). The distance limit is then the
    /// sum of both values without their signs; converters to OpenRadioss use 0.6 times this sum. Both fields
    /// are written as minus the tolerance, so the limit is 2 or 1.2 times the tolerance.
    void add_contacts()
    {
        for (const mesh::ContactPair& pair : view_->contacts) {
            file_.add(formatted(
                "*CONTACT_{}_SURFACE_TO_SURFACE{}_ID{}{:>10}{}\n{:>10}{:>10}{:>10}{:>10}\n{:>10}\n",
                pair.tied ? "TIED" : "AUTOMATIC", pair.tied ? "_OFFSET" : "", end_, ++highest_contact_,
                title(pair.name), numbers_[pair.sets[0]], numbers_[pair.sets[1]], 0, 0, 0));
            file_.add(pair.tied ? formatted("{:>10}{:>10}{:>10.3g}{:>10.3g}\n", 1, 1, -pair.tolerance,
                                            -pair.tolerance)
                                : formatted("{:>10}\n", 0));
        }
    }

    View view_;
    SideNodes sides_;
    MeshView::KeptText own_;
    const MeshView::KeptText* kept_ = nullptr; ///< kept text of the deck, or `own_`
    DeckFile file_;
    std::string end_;                            ///< end of a line with a keyword
    std::map<Index, std::set<DeckShape>> forms_; ///< shapes of the elements in each region
    std::set<Index> cohesive_;                   ///< regions of cohesive elements
    std::vector<int> parts_;                     ///< parts that the kept text defines
    int highest_section_ = 0, highest_set_ = 0, highest_contact_ = 0; ///< in the kept text
    std::map<std::string, std::set<int>> ids_;                        ///< numbers of the sets of each keyword
    std::vector<DeckTag> shells_;
    std::vector<int> numbers_; ///< numbers of the sets as written
};

} // namespace

DeckFile dyna_file(const View& view, const MeshFileOptions& options, const mesh::ViewParts* /*parts*/)
{
    check_numbers(*view, highest_of(kCardField), "an LS-DYNA deck",
                  "give first_node and first_cell, or write another format");
    return DynaWriter(view, options.unit).write();
}

} // namespace lacuna::io
