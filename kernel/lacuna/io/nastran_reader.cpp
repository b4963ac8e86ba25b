// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/facet_collector.h>
#include <lacuna/io/detail/nastran.h>

#include <algorithm>
#include <limits>

namespace lacuna::io {
namespace {

/// A face by the name of its card.
struct FaceCard {
    std::string_view name;
    int corners;
};
constexpr FaceCard kFaceCards[] = {{"CTRIA3", 3}, {"CTRIA6", 3}, {"CTRIAR", 3}, {"CQUAD4", 4},
                                   {"CQUAD8", 4}, {"CQUADR", 4}, {"CQUAD", 4}};
constexpr std::string_view kFrameCards[] = {"CORD1R", "CORD1C", "CORD1S", "CORD2R", "CORD2C", "CORD2S"};
constexpr std::string_view kSolidCards[] = {"CHEXA", "CPENTA", "CTETRA", "CPYRAM", "CPYRA"};

template <class Names>
bool is_among(const Names& names, std::string_view name)
{
    return std::ranges::find(names, name) != std::end(names);
}

class NastranReader {
public:
    NastranReader(Cursor& cursor, FacetCollector& into) : deck_(cursor), into_(into) {}

    void read()
    {
        deck_.read(
            [](std::string_view name) {
                return name == "GRID" || name == "GRDSET" || is_among(kFrameCards, name) ||
                       std::ranges::find(kFaceCards, name, &FaceCard::name) != std::end(kFaceCards);
            },
            [&](const Card& card) { take(card); });
        tags_.finish([&](Index first, Index second) {
            const Grid& a = grids_[index(first)];
            const Grid& b = grids_[index(second)];
            if (a.at != b.at || a.frame != b.frame)
                b.place.fail("the number of this GRID is that of another elsewhere");
        });
        for (const Grid& grid : grids_) into_.points().push_back(in_basic(grid));
        faces_.resolve(tags_, into_);
        into_.sort_by_label();
    }

private:
    struct Grid {
        Vec3 at;
        Index frame; ///< -1: blank
        DeckPlace place;
    };

    void take(const Card& card)
    {
        const auto face = std::ranges::find(kFaceCards, card.name, &FaceCard::name);
        if (card.name == "GRID")
            take_grid(card);
        else if (card.name == "GRDSET")
            default_frame_ = card.whole(3, 0);
        else if (face != std::end(kFaceCards))
            take_face(card, face->corners);
        else if (is_among(kFrameCards, card.name))
            take_frame(card);
        else if (is_among(kSolidCards, card.name))
            into_.pass_over_solid(card.name);
        else
            into_.pass_over(card.name);
    }

    void take_grid(const Card& card)
    {
        if (grids_.size() >= static_cast<std::size_t>(std::numeric_limits<Index>::max()))
            card.fail("too many points");
        tags_.add(static_cast<std::uint64_t>(card.needed(2)));
        grids_.push_back({card.point(4), card.whole(3, -1), card.place});
    }

    void take_face(const Card& card, int corners)
    {
        const Index property = card.whole(3, card.needed(2)); // blank: the element's own number
        TaggedFaces::Face face{.corners = corners,
                               .label = into_.label_of(property, "pid:" + std::to_string(property)),
                               .cursor = card.place.cursor,
                               .position = card.place.position};
        for (std::size_t k = 0; k < index(corners); ++k) face.node[k] = card.needed(4 + k);
        faces_.add(face);
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
        // Two in a card.
        for (const std::size_t first : {std::size_t(2), std::size_t(6)}) {
            if (first == 6 && card.field(first).empty()) break;
            for (std::size_t k = 0; k < 3; ++k) frame.node[k] = card.needed(first + 1 + k);
            frames_.add(card.needed(first), frame);
        }
    }

    Vec3 in_basic(const Grid& grid)
    {
        const Vec3 p = frames_.to_basic(grid.frame < 0 ? default_frame_ : grid.frame, grid.at, grid.place);
        if (!p.allFinite()) grid.place.fail("the point's coordinates are too large");
        return p;
    }

    Vec3 node_in_basic(Index tag, const DeckPlace& place)
    {
        const Index node = tags_.find(static_cast<std::uint64_t>(tag));
        if (node < 0)
            place.fail("the coordinate system names node " + std::to_string(tag) + ", which is not there");
        return in_basic(grids_[index(node)]);
    }

    Deck deck_;
    FacetCollector& into_;
    NodeTags tags_;
    std::deque<Grid> grids_;
    TaggedFaces faces_;
    Index default_frame_ = 0;
    Frames frames_{[this](Index tag, const DeckPlace& place) { return node_in_basic(tag, place); }};
};

} // namespace

void read_nastran(Cursor& cursor, FacetCollector& into) { NastranReader(cursor, into).read(); }

} // namespace lacuna::io
