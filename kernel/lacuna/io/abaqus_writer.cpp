// SPDX-License-Identifier: MIT
#include <lacuna/core/message.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/cursor.h>
#include <lacuna/io/detail/deck_writer.h>

#include <algorithm>
#include <cctype>
#include <map>

// Writes a flat deck: nodes, elements by type and region, elements kept as text, sets, cards. CalculiX reads
// at most 20 characters of a number.

namespace lacuna::io {
namespace {

constexpr std::size_t kWidth = 20;   // characters of a coordinate
constexpr std::size_t kPerLine = 16; // numbers of a line, at most

/// Whether the deck is flat: sets of several instances are named "instance.set", which a flat deck cannot
/// hold.
bool is_flat(const Deck& deck) { return deck.format == DeckFormat::abaqus && deck.instances.size() < 2; }

/// Names of a part's nodes and sets without the prefix of its only instance.
std::string without_instance(std::string_view text, const std::string& instance)
{
    const std::string before = instance + ".";
    std::string flat;
    for (std::size_t i = 0; i < text.size();) {
        const bool begins = i == 0 || (std::isalnum(static_cast<unsigned char>(text[i - 1])) == 0 &&
                                       text[i - 1] != '_' && text[i - 1] != '-');
        if (begins && same_word(text.substr(i, before.size()), before))
            i += before.size();
        else
            flat += text[i++];
    }
    return flat;
}

struct Cards {
    std::string elements, others;
};

/// Elements kept as text precede the sets that may name them.
Cards cards_of(const Deck& deck)
{
    Cards cards;
    const std::string text = text_at(deck, DeckText::Place::cards);
    bool elements = false;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
        const std::string_view line = rest.substr(0, end);
        const bool keyword = line.starts_with('*') && !line.starts_with("**");
        if (keyword) {
            const std::string_view name = trimmed(line.substr(1, line.find(',') - 1));
            elements = same_word(name, "ELEMENT");
        }
        (elements ? cards.elements : cards.others) += line;
        rest.remove_prefix(end);
    }
    if (deck.instances.size() == 1) cards.others = without_instance(cards.others, deck.instances[0].name);
    return cards;
}

class AbaqusWriter {
public:
    AbaqusWriter(const Deck& deck, const LayeredBulk* layered)
        : deck_(deck), bulk_(deck, layered), same_(is_flat(deck))
    {
    }

    DeckFile write()
    {
        Cards cards;
        if (same_) {
            add_text(text_at(deck_, DeckText::Place::head));
            cards = cards_of(deck_);
        } else if (deck_.format == DeckFormat::abaqus && !deck_.texts.empty()) {
            file_.notes.push_back(
                formatted("the {} instances become one mesh, sets are named instance_set, and cards are not "
                          "carried over: they name nodes by their instances",
                          deck_.instances.size()));
        }
        add_nodes();
        choose_sets();
        choose_names();
        for (const DeckBlock& block : deck_.blocks) add_elements(block);
        add_text(cards.elements);
        for (std::size_t s = 0; s < deck_.sets.size(); ++s)
            if (!by_elements_[s]) add_set(deck_.sets[s], names_[s]);
        add_text(cards.others);
        return std::move(file_);
    }

private:
    void add_text(const std::string& text) { file_.sections.push_back({text, 0, 0, {}}); }

    void add_nodes()
    {
        const auto put = [](std::size_t, DeckTag tag, const Vec3& point, char* out) {
            out = put_text(out, tag);
            for (const double x : point) {
                *out++ = ',';
                *out++ = ' ';
                out = put_real(out, x, kWidth);
            }
            *out++ = '\n';
            return out;
        };
        file_.sections.push_back(
            section_of_points("*NODE\n", bulk_, kNumberBytes + 3 * (kWidth + 2) + 1, put));
    }

    /// A set that equals a region is created by the ELSET of its elements.
    void choose_sets()
    {
        by_elements_.assign(deck_.sets.size(), false);
        region_names_.resize(deck_.regions.size());
        dimensions_.assign(deck_.regions.size(), 0);
        set_of_region_.assign(deck_.regions.size(), -1);
        makes_set_.assign(deck_.regions.size(), !same_);
        std::vector<std::vector<DeckTag>> members(deck_.regions.size());
        for (const DeckBlock& block : deck_.blocks)
            for (std::size_t e = 0; e < block.count(); ++e)
                if (block.regions[e] >= 0) {
                    members[index(block.regions[e])].push_back(block.tags[e]);
                    dimensions_[index(block.regions[e])] = shape_info(block.shape).dimension;
                }
        for (std::size_t r = 0; r < members.size(); ++r) {
            std::sort(members[r].begin(), members[r].end());
            for (std::size_t s = 0; s < deck_.sets.size(); ++s) {
                const DeckSet& set = deck_.sets[s];
                if (set.kind != DeckSet::Kind::elements || !same_word(set.name, deck_.regions[r].name) ||
                    set.members != members[r] || bulk_.parts_of(set) != bulk_.parts_of(static_cast<Index>(r)))
                    continue;
                // Not by both: CalculiX would list each element twice in the set.
                makes_set_[r] = by_elements_[s] = !set.listed;
                set_of_region_[r] = static_cast<Index>(s);
            }
        }
    }

    /// Choose distinct names of sets and regions: surfaces before element sets, unchanged names before
    /// others.
    void choose_names()
    {
        using enum DeckSet::Kind;
        std::vector<std::pair<DeckSet::Kind, std::string>> taken;
        const auto choose = [&](DeckSet::Kind kind, const std::string& name) {
            if (same_) return name;
            const std::string free = free_name(name, DeckFormat::abaqus, [&](const std::string& other) {
                return std::ranges::any_of(taken, [&](const auto& of) {
                    return share_names(DeckFormat::abaqus, kind, of.first) && same_word(of.second, other);
                });
            });
            if (free != abaqus_name(name))
                file_.notes.push_back(formatted("the set {} is called {}", name, free));
            taken.emplace_back(kind, free);
            return free;
        };
        names_.resize(deck_.sets.size());
        for (const auto kind : {sides, nodes, elements})
            for (const bool stays : {true, false})
                for (std::size_t s = 0; s < names_.size(); ++s)
                    if (const DeckSet& set = deck_.sets[s];
                        set.kind == kind && (abaqus_name(set.name) == set.name) == stays)
                        names_[s] = choose(kind, set.name);
        for (std::size_t r = 0; r < deck_.regions.size(); ++r) {
            const bool is_empty = dimensions_[r] == 0 && bulk_.parts_of(static_cast<Index>(r)).empty();
            if (is_empty) continue;
            std::string name = deck_.regions[r].name;
            // A region from another format that has only a number is named after it.
            if (name.empty() && !same_)
                name = (dimensions_[r] != 2 ? "volume:" : "surface:") + std::to_string(deck_.regions[r].tag);
            region_names_[r] = set_of_region_[r] >= 0 ? names_[index(set_of_region_[r])]
                               : name.empty()         ? ""
                                                      : choose(elements, name);
        }
    }

    void add_elements(const DeckBlock& block)
    {
        const bool own = is_abaqus_element(block.type, block.shape);
        const std::string_view type = own ? std::string_view(block.type) : words_of(block.shape).abaqus;
        if (type.empty()) refuse_element(block, "Abaqus", "there is no such element");
        if (std::ranges::find(block.nodes, -1) != block.nodes.end())
            refuse_element(block, "Abaqus", "some have not all their middle nodes");
        std::map<Index, std::vector<std::uint32_t>> of_region;
        for (std::size_t e = 0; e < block.count(); ++e)
            of_region[block.regions[e]].push_back(static_cast<std::uint32_t>(e));
        const auto nodes = static_cast<std::size_t>(shape_info(block.shape).nodes);
        // Generated elements of a part are consecutive; parts of a region are not.
        std::map<Index, std::vector<std::pair<std::size_t, std::size_t>>> made;
        for (const BulkReader::MadeRun& run : bulk_.made_runs(block))
            made[run.region].emplace_back(run.begin, run.end);
        for (const auto& [region, runs] : made) {
            std::string head = head_of(type, region);
            for (const auto& [first, last] : runs) {
                file_.sections.push_back(
                    {std::move(head), last - first, (nodes + 1) * kNumberBytes + 4,
                     [bulk = bulk_, &block, from = first](std::size_t begin, std::size_t end, char* out) {
                         for (std::size_t e = from + begin; e < from + end; ++e)
                             out = put_element(bulk, block, e, out);
                         return out;
                     }});
                head.clear();
            }
        }
        for (auto& [region, elements] : of_region) {
            const std::size_t count = elements.size();
            file_.sections.push_back({head_of(type, region), count, (nodes + 1) * kNumberBytes + 4,
                                      [bulk = bulk_, &block, all = std::move(elements)](
                                          std::size_t begin, std::size_t end, char* out) {
                                          for (std::size_t i = begin; i < end; ++i)
                                              out = put_element(bulk, block, all[i], out);
                                          return out;
                                      }});
        }
    }

    [[nodiscard]] std::string head_of(std::string_view type, Index region) const
    {
        std::string head = "*ELEMENT, TYPE=" + std::string(type);
        if (region >= 0 && makes_set_[index(region)] && !region_names_[index(region)].empty())
            head += ", ELSET=" + region_names_[index(region)];
        return head + "\n";
    }

    static char* put_element(const BulkReader& bulk, const DeckBlock& block, std::size_t e, char* out)
    {
        bulk.element(block, e, [&](DeckTag tag, Index, std::span<const Index> nodes) {
            out = put_text(out, tag);
            std::size_t written = 1;
            for (const Index node : nodes) {
                *out++ = ',';
                *out++ = written++ % kPerLine == 0 ? '\n' : ' ';
                out = put_text(out, bulk.point_tag(node));
            }
            *out++ = '\n';
        });
        return out;
    }

    void add_set(const DeckSet& set, const std::string& name)
    {
        if (set.kind == DeckSet::Kind::sides) {
            file_.sections.push_back({"*SURFACE, TYPE=ELEMENT, NAME=" + name + "\n", set.sides.size(),
                                      2 * kNumberBytes,
                                      [&set](std::size_t begin, std::size_t end, char* out) {
                                          for (std::size_t i = begin; i < end; ++i)
                                              out = put_side(set.sides[i], out);
                                          return out;
                                      }});
            return;
        }
        const std::string word = set.kind == DeckSet::Kind::nodes ? "NSET" : "ELSET";
        file_.sections.push_back(
            {"*" + word + ", " + word + "=" + name + "\n", bulk_.count(set), kNumberBytes + 2,
             [bulk = bulk_, &set](std::size_t begin, std::size_t end, char* out) {
                 for (std::size_t i = begin; i < end; ++i) {
                     out = put_text(out, bulk.member(set, i));
                     const bool last = (i + 1) % kPerLine == 0 || i + 1 == bulk.count(set);
                     *out++ = last ? '\n' : ',';
                     if (!last) *out++ = ' ';
                 }
                 return out;
             }});
    }

    static char* put_side(const DeckSide& side, char* out)
    {
        out = put_text(out, side.element);
        if (side.side < 1) return put_words(out, side.side == 0 ? ", SPOS\n" : ", SNEG\n");
        out = put_words(out, ", S");
        out = put_text(out, side.side);
        *out++ = '\n';
        return out;
    }

    const Deck& deck_;
    BulkReader bulk_;
    bool same_; ///< names and text stay
    DeckFile file_;
    std::vector<bool> by_elements_;                 ///< sets
    std::vector<bool> makes_set_;                   ///< regions
    std::vector<Index> set_of_region_;              ///< that it makes; -1: none
    std::vector<int> dimensions_;                   ///< of the elements of regions; 0: there are none
    std::vector<std::string> names_, region_names_; ///< of sets and regions in the file
};

} // namespace

DeckFile abaqus_file(const Deck& deck, const LayeredBulk* layered)
{
    return AbaqusWriter(deck, layered).write();
}

} // namespace lacuna::io
