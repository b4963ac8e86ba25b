// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/io/detail/deck_files.h>

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <vector>

/// Cards and coordinate frames of Nastran bulk data. Internal to this folder.
namespace lacuna::io {

/// A bulk data entry. Fields are numbered from 2, as in the manuals; omitted fields are blank.
struct Card {
    std::string name;                     ///< in capitals
    std::vector<std::string_view> fields; ///< valid during the callback
    DeckPlace place;

    [[nodiscard]] std::string_view field(std::size_t number) const;
    /// The number of a node, property or frame, >= 0; `otherwise` if the field is blank.
    [[nodiscard]] Index whole(std::size_t number, Index otherwise) const;
    /// The number of a node, property or frame, >= 0, from a field that must not be blank.
    [[nodiscard]] Index needed(std::size_t number) const;
    /// A real number; 0 if the field is blank.
    [[nodiscard]] double real(std::size_t number) const;
    /// A point from three fields.
    [[nodiscard]] Vec3 point(std::size_t first) const;
    /// The fields from `first` on as one text, separated by commas, without trailing blank fields.
    [[nodiscard]] std::string text(std::size_t first) const;
    [[noreturn]] void fail(const Message& why) const { place.fail(why.about(name)); }
    template <class... Arguments>
    [[noreturn]] void fail(lacuna::Format<sizeof...(Arguments)> format, const Arguments&... arguments) const
    {
        fail(Message(kUnreadable, format, arguments...));
    }
};

/// How a card is used: its fields are read, its lines are kept as text, or both.
enum class CardUse { read, keep, both };

/// The cards of a deck and of its included files, which lie in its folder or below.
///
/// A deck without BEGIN BULK is bulk data from its first line. The parts of superelements are merged. Free,
/// small and large fields, tabs, upper and lower case, and continuations are supported. A continuation
/// follows its card or, if it is named (+A1), may be anywhere. A card is passed on when all its continuations
/// are read. If a continuation never appears, the card is passed on at the end of the deck. Replicated cards
/// are passed on as if they were written out.
class BulkData {
public:
    explicit BulkData(Cursor& cursor);
    /// Pass on every card. Cards that are kept as text only have no fields.
    void read(const std::function<CardUse(std::string_view name)>& use,
              const std::function<void(const Card&)>& take);

    /// The kept text: before, inside and after the bulk data.
    [[nodiscard]] std::vector<DeckText> texts() const;
    [[nodiscard]] const DeckFiles& files() const { return files_; }
    /// Number of superelements read so far, without the main bulk data, and the start of the first one.
    [[nodiscard]] int superelements() const { return superelements_; }
    [[nodiscard]] const DeckPlace& first_superelement() const { return first_superelement_; }

private:
    void read_file(Cursor& cursor, std::uint64_t file);
    void include(Cursor& cursor, std::string_view rest, std::uint64_t file);
    void read_line(const Cursor& cursor, std::uint64_t file, std::string_view line, std::string_view raw);
    bool take_fields(const DeckPlace& place);
    void split(const Cursor& cursor, std::string_view line);
    void fixed_fields(std::string_view line);
    void free_fields(const Cursor& cursor, std::string_view line);
    void begin_card(std::string_view name, const DeckPlace& place);
    void end_card();
    bool hand_over(const Card& card, CardUse use);
    void begin_replica(const DeckPlace& place);
    bool replicates(std::string_view name) const;
    void add_replicated(std::string_view field);
    void replicate(std::string_view count, const DeckPlace& place);

    /// A card waiting for its continuation, or a continuation waiting for its card.
    struct Waiting {
        Card card;
        CardUse use = CardUse::keep;
        std::string_view marker; ///< name of the expected continuation
        bool large = false;
        std::string raw; ///< lines of a continuation that has not found its card
    };
    bool is_awaited(std::string_view name);
    void own_fields(Card& card);
    void take_elsewhere(const DeckPlace& place, std::string_view raw);
    void go_on(Waiting card);
    void finish();

    Cursor& main_;
    Cursor start_; ///< at the start of the deck
    DeckFiles files_;
    std::function<CardUse(std::string_view)> use_;
    std::function<void(const Card&)> take_;
    std::string head_, kept_, tail_;
    Card card_;
    CardUse card_use_ = CardUse::keep;
    std::vector<std::string_view> line_; ///< fields of the current line
    std::deque<std::string> expanded_;   ///< lines of the card that contained tabs
    std::string_view marker_;            ///< last field of the previous line, which names its continuation
    bool open_ = false, bulk_ = false, ended_ = false;
    bool text_ = false;                 ///< the card holds text instead of fields
    std::size_t kept_begin_ = 0;        ///< start of the card's lines in `kept_`
    std::vector<std::string> pattern_;  ///< fields of the card that is replicated
    std::deque<std::string> generated_; ///< fields of the replica
    std::vector<std::string> steps_;    ///< increment of each field from replica to replica
    bool replica_ = false;
    std::size_t room_; ///< number of replicas still allowed
    int superelements_ = 0;
    DeckPlace first_superelement_;
    std::map<std::string, std::pair<int, std::string>> known_;  ///< superelement and fields of cards that are
                                                                ///< read and kept, by card
    std::multimap<std::string, Waiting> cards_, continuations_; ///< waiting cards and continuations, by the
                                                                ///< name of the continuation
    std::deque<std::string> owned_;                             ///< fields of the waiting cards
    std::optional<std::vector<std::string>> awaited_; ///< names that lines of the deck give to their
                                                      ///< continuations, sorted
    std::string unasked_; ///< first named continuation that was accepted although no card names one
};

/// Coordinate frames, each defined by three points in another frame or by three nodes.
class Frames {
public:
    struct Definition {
        char kind = 'R';          ///< rectangular, 'C'ylindrical or 'S'pherical; angles in degrees
        Index base = 0;           ///< frame of the three points; 0: the basic frame
        std::array<Vec3, 3> at{}; ///< origin, a point on the z axis, a point in the xz plane
        bool by_nodes = false;
        std::array<Index, 3> node{}; ///< tags of nodes at these points, if it is defined by nodes
        DeckPlace place;
    };
    /// @param node_at  returns a node in basic coordinates, by its tag; may call `to_basic()` again.
    explicit Frames(std::function<Vec3(Index tag, const DeckPlace& place)> node_at)
        : node_at_(std::move(node_at))
    {
    }

    void add(Index tag, const Definition& definition);
    /// Convert a point of a frame to basic coordinates.
    /// @throw InvalidInput  the frame does not exist, its three points are collinear, or frames are defined
    ///        by each other. The message names `place`.
    Vec3 to_basic(Index frame, const Vec3& point, const DeckPlace& place);

private:
    struct Frame {
        Definition definition;
        Eigen::Matrix3d axes = Eigen::Matrix3d::Zero(); ///< columns, basic coordinates
        Vec3 origin = Vec3::Zero();
        bool known = false;
    };
    void resolve(Index tag, Frame& frame);

    std::function<Vec3(Index, const DeckPlace&)> node_at_;
    std::map<Index, Frame> frames_;
    int depth_ = 0;
};

} // namespace lacuna::io
