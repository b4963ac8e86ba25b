// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/renumbered.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/nastran.h>

#include <algorithm>
#include <optional>

namespace lacuna::io {
namespace {

/// An element card, and the shapes without and with middle nodes that it can have.
struct ElementCard {
    std::string_view name;
    DeckShape corners, all;
    bool always_all = false; ///< the card has fields for middle nodes, whether used or not
    int kept_from = 0;       ///< first field after the nodes that is kept; 0: no field may follow
};
constexpr ElementCard kElementCards[] = {
    {"CTRIA3", DeckShape::tri3, DeckShape::tri3, false, 7},
    {"CTRIAR", DeckShape::tri3, DeckShape::tri3, false, 7},
    {"CTRIA6", DeckShape::tri3, DeckShape::tri6, true, 10},
    {"CQUAD4", DeckShape::quad4, DeckShape::quad4, false, 8},
    {"CQUADR", DeckShape::quad4, DeckShape::quad4, false, 8},
    {"CQUAD8", DeckShape::quad4, DeckShape::quad8, true, 12},
    {"CQUAD", DeckShape::quad4, DeckShape::quad9, true, 13},
    {"CTETRA", DeckShape::tet4, DeckShape::tet10},
    {"CPYRAM", DeckShape::pyramid5, DeckShape::pyramid13},
    {"CPYRA", DeckShape::pyramid5, DeckShape::pyramid13},
    {"CPENTA", DeckShape::wedge6, DeckShape::wedge15},
    {"CHEXA", DeckShape::hex8, DeckShape::hex20},
};
constexpr std::string_view kFrameCards[] = {"CORD1R", "CORD1C", "CORD1S", "CORD2R", "CORD2C", "CORD2S"};
/// Property cards of shells and solids, and the number of the field with their material; 0: there is none.
struct PropertyCard {
    std::string_view name;
    std::size_t material;
};
constexpr PropertyCard kPropertyCards[] = {{"PSHELL", 3}, {"PSOLID", 3},  {"PCOMP", 0},
                                           {"PCOMPG", 0}, {"PLPLANE", 3}, {"PLSOLID", 3}};

class NastranReader {
public:
    NastranReader(Cursor& cursor, DeckBuilder& into) : bulk_(cursor), into_(into) {}

    void read()
    {
        bulk_.read([](std::string_view name) { return use_of(name); }, [&](const Card& card) { take(card); });
        finish_nodes();
        into_.resolve(*tags_, [&](std::uint64_t place, const Message& why) {
            bulk_.files().place_of(place).fail(why);
        });
        finish_properties();
        if (bulk_.superelements() > 0) finish_superelements();
        into_.deck().texts = bulk_.texts();
    }

private:
    struct Grid {
        Index frame; ///< -1: blank
        std::uint64_t place;
        friend bool operator==(const Grid& a, const Grid& b) { return a.frame == b.frame; }
    };

    static const ElementCard* element_card(std::string_view name)
    {
        const auto found = std::ranges::find(kElementCards, name, &ElementCard::name);
        return found == std::end(kElementCards) ? nullptr : &*found;
    }

    static CardUse use_of(std::string_view name)
    {
        if (name == "GRID" || name == "GRDSET" || element_card(name) != nullptr) return CardUse::read;
        const bool both = name.starts_with("MAT") || name == "SELOC" || name == "SEBULK" ||
                          std::ranges::find(kFrameCards, name) != std::end(kFrameCards) ||
                          std::ranges::find(kPropertyCards, name, &PropertyCard::name) !=
                              std::end(kPropertyCards);
        return both ? CardUse::both : CardUse::keep;
    }

    void take(const Card& card)
    {
        if (card.name == "GRID") return take_grid(card);
        if (const ElementCard* element = element_card(card.name)) return take_element(card, *element);
        if (card.name == "GRDSET") return take_defaults(card);
        const auto property = std::ranges::find(kPropertyCards, card.name, &PropertyCard::name);
        if (property != std::end(kPropertyCards))
            take_property(card, property->material);
        else if (std::ranges::find(kFrameCards, card.name) != std::end(kFrameCards))
            take_frame(card);
        else if (card.name == "SELOC" || (card.name == "SEBULK" && is_copy(card.field(3))))
            card.fail(Message(kUnreadable, "superelements that are moved, repeated or mirrored are not read")
                          .remedy("write the deck as one"));
        else
            into_.pass_over(card.name.empty() ? "lines without the name of a card" : card.name);
    }

    /// Whether a superelement of this type is a copy of another one at another place.
    static bool is_copy(std::string_view type)
    {
        return same_word(type, "REPEAT") || same_word(type, "MIRROR");
    }

    void take_defaults(const Card& card)
    {
        default_frame_ = card.whole(3, 0);
        default_output_ = card.field(7);
        default_constraint_ = card.field(8);
    }

    void take_grid(const Card& card)
    {
        const Index frame = card.whole(3, -1);
        into_.add_point(card.needed(2), card.point(4), *card.place.cursor);
        grids_.push_back({frame, card.place.number()});
        std::string more = card.text(7);
        if (!more.empty()) into_.deck().point_more.emplace_back(grids_.size() - 1, std::move(more));
    }

    void take_element(const Card& card, const ElementCard& kind)
    {
        const auto corners = static_cast<std::size_t>(shape_info(kind.corners).nodes);
        const auto most = static_cast<std::size_t>(shape_info(kind.all).nodes);
        std::array<Index, 20> found{};
        bool middles = kind.always_all;
        for (std::size_t k = 0; k < most; ++k) {
            found[k] = k < corners ? card.needed(4 + k) : card.whole(4 + k, -1);
            middles = middles || (k >= corners && found[k] >= 0);
        }
        const DeckShape shape = middles ? kind.all : kind.corners;
        const auto count = static_cast<std::size_t>(shape_info(shape).nodes);
        std::array<Index, 20> nodes{};
        const auto places = node_places(NodeOrder::exodus, shape);
        for (std::size_t k = 0; k < count; ++k) nodes[places[k]] = found[k];
        const Index tag = card.needed(2);
        const std::size_t block = into_.block_of(shape, card.name);
        const DeckBlock& of = into_.deck().blocks[block];
        if (card.field(3).empty()) unowned_.push_back({block, of.count()});
        const Index region = card.field(3).empty() ? -1 : region_of(card.needed(3));
        std::string more = card.text(static_cast<std::size_t>(kind.kept_from > 0 ? kind.kept_from : 4) +
                                     (kind.kept_from > 0 ? 0 : most));
        if (!more.empty() && kind.kept_from == 0) card.fail("expected at most {} nodes, found more", most);
        if (!more.empty()) into_.deck().blocks[block].more.emplace_back(of.count(), std::move(more));
        into_.add_element(block, tag, region, {nodes.data(), count}, card.place.number());
    }

    Index region_of(Index property)
    {
        if (property != last_property_ || last_region_ < 0) {
            last_property_ = property;
            last_region_ = into_.region_of(property, "pid:" + std::to_string(property));
        }
        return last_region_;
    }

    void take_property(const Card& card, std::size_t material)
    {
        materials_[card.needed(2)] = material == 0 ? std::string() : std::string(card.field(material));
    }

    void take_frame(const Card& card)
    {
        Frames::Definition frame{.kind = card.name[5],
                                 .base = card.whole(3, 0),
                                 .by_nodes = card.name[4] == '1',
                                 .place = card.place};
        if (!frame.by_nodes) {
            for (std::size_t k = 0; k < 3; ++k) frame.at[k] = card.point(4 + 3 * k);
            frames_.add(card.needed(2), frame);
            return;
        }
        // A card defines up to two frames.
        for (const std::size_t first : {std::size_t(2), std::size_t(6)}) {
            if (first == 6 && card.field(first).empty()) break;
            for (std::size_t k = 0; k < 3; ++k) frame.node[k] = card.needed(first + 1 + k);
            frames_.add(card.needed(first), frame);
        }
    }

    /// Merge nodes that are listed twice with the same data. Then convert all nodes to the basic frame.
    void finish_nodes()
    {
        Deck& deck = into_.deck();
        std::vector<bool> repeated;
        tags_.emplace(deck.point_tags, [&](Index first, Index second) {
            if (deck.points[index(first)] != deck.points[index(second)] ||
                !(grids_[index(first)] == grids_[index(second)]))
                bulk_.files()
                    .place_of(grids_[index(second)].place)
                    .fail("another GRID with this number has other coordinates");
            repeated.resize(grids_.size(), false);
            repeated[index(second)] = true;
        });
        if (default_frame_ != 0 || !default_output_.empty() || !default_constraint_.empty()) use_defaults();
        if (!repeated.empty()) drop(repeated);
        // Drop the basic frame, which is the default.
        std::erase_if(deck.point_more,
                      [&](const auto& more) { return default_output_.empty() && more.second == "0"; });
        const std::vector<Vec3> given = deck.points;
        given_ = &given;
        for (std::size_t p = 0; p < grids_.size(); ++p)
            if (grids_[p].frame != 0) deck.points[p] = in_basic(p);
        given_ = nullptr;
    }

    void use_defaults()
    {
        Deck& deck = into_.deck();
        std::vector<std::pair<std::size_t, std::string>> all;
        auto given = deck.point_more.begin();
        for (std::size_t p = 0; p < grids_.size(); ++p) {
            if (grids_[p].frame < 0) grids_[p].frame = default_frame_;
            std::string more;
            if (given != deck.point_more.end() && given->first == p) more = (given++)->second;
            const std::size_t comma = std::min(more.find(','), more.size());
            const std::size_t next = comma < more.size() ? std::min(more.find(',', comma + 1), more.size())
                                                         : comma;
            std::string output = more.substr(0, comma);
            std::string constraint = comma < next ? more.substr(comma + 1, next - comma - 1) : "";
            if (output.empty()) output = default_output_;
            if (constraint.empty()) constraint = default_constraint_;
            std::string text = output + (constraint.empty() && next == more.size() ? "" : "," + constraint) +
                               more.substr(next);
            if (!text.empty()) all.emplace_back(p, std::move(text));
        }
        deck.point_more = std::move(all);
    }

    void drop(const std::vector<bool>& repeated)
    {
        Deck& deck = into_.deck();
        const auto stays = [&](std::size_t p) { return !repeated[p]; };
        const std::vector<Index> number = keep_if(deck.points, stays);
        keep_if(deck.point_tags, stays);
        keep_if(grids_, stays);
        std::erase_if(deck.point_more, [&](const auto& more) { return repeated[more.first]; });
        for (auto& more : deck.point_more) more.first = index(number[more.first]);
        tags_.emplace(deck.point_tags);
    }

    Vec3 in_basic(std::size_t p)
    {
        const Grid& grid = grids_[p];
        const DeckPlace place = bulk_.files().place_of(grid.place);
        const Vec3 at = frames_.to_basic(grid.frame < 0 ? default_frame_ : grid.frame, (*given_)[p], place);
        if (!at.allFinite()) place.fail("the point's coordinates are too large");
        return at;
    }

    Vec3 node_in_basic(Index tag, const DeckPlace& place)
    {
        const Index node = tags_->find(tag);
        if (node < 0)
            place.fail("the coordinate system names {}, which does not exist", numbered("node", tag));
        return in_basic(index(node));
    }

    /// Check that superelements do not use the same numbers, because they are merged into one deck.
    void finish_superelements()
    {
        const DeckPlace& place = bulk_.first_superelement();
        if (default_frame_ != 0) place.fail("GRDSET of superelements that are read as one deck is ambiguous");
        const std::vector<DeckTag> tags = element_tags(into_.deck());
        const TagPlaces elements(tags, [&](Index, Index again) {
            place.fail(Message(kUnreadable, "superelements are read as one deck, but {} occurs twice",
                               numbered("element", tags[index(again)]))
                           .remedy("renumber one of them"));
        });
        into_.warn(formatted("read as one deck with its superelements ({})", bulk_.superelements()));
    }

    /// An element without a property has the property of its own number. If there are several such elements,
    /// those for which no card defines this property form one region.
    void finish_properties()
    {
        Deck& deck = into_.deck();
        for (const auto& [block, e] : unowned_) {
            const auto tag = static_cast<Index>(deck.blocks[block].tags[e]);
            const bool own = unowned_.size() == 1 || materials_.contains(tag);
            deck.blocks[block].regions[e] = own ? region_of(tag) : into_.region_of(0, "pid:blank", 1);
        }
        for (DeckRegion& region : deck.regions) {
            const auto material = materials_.find(region.tag);
            if (material != materials_.end()) region.material = material->second;
        }
    }

    BulkData bulk_;
    DeckBuilder& into_;
    std::vector<Grid> grids_;
    std::optional<TagPlaces> tags_;
    const std::vector<Vec3>* given_ = nullptr; ///< points as in the file, while they are converted
    std::vector<std::pair<std::size_t, std::size_t>> unowned_; ///< elements whose property field is blank
    /// Materials of the properties that have a card.
    std::map<Index, std::string> materials_;
    Index last_property_ = -1, last_region_ = -1;
    Index default_frame_ = 0;
    std::string default_output_, default_constraint_;
    Frames frames_{[this](Index tag, const DeckPlace& place) { return node_in_basic(tag, place); }};
};

} // namespace

void read_nastran(Cursor& cursor, DeckBuilder& into) { NastranReader(cursor, into).read(); }

} // namespace lacuna::io
