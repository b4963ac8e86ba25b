// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/cursor.h>

#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <vector>

/// Nastran bulk data below its nodes and elements: cards and coordinate frames. Internal to this folder.
namespace lacuna::io {

/// Where something stands in a deck of several files.
struct DeckPlace {
    const Cursor* cursor = nullptr;
    std::size_t position = 0;

    /// @throw InvalidInput "io.unreadable"
    [[noreturn]] void fail(const std::string& what) const { cursor->fail_at(position, what); }
};

/// A bulk data entry. Fields count from 2, as in the manuals; those left out are blank.
struct Card {
    std::string name; ///< in capitals
    std::vector<std::string> fields;
    DeckPlace place;

    [[nodiscard]] std::string_view field(std::size_t number) const;
    /// A number of a node, property or frame, >= 0; `otherwise` where the field is blank.
    [[nodiscard]] Index whole(std::size_t number, Index otherwise) const;
    /// The same of a field that must not be blank.
    [[nodiscard]] Index needed(std::size_t number) const;
    /// Blank fields are 0.
    [[nodiscard]] double real(std::size_t number) const;
    /// Three fields.
    [[nodiscard]] Vec3 point(std::size_t first) const;
    [[noreturn]] void fail(const std::string& what) const { place.fail(name + ": " + what); }
};

/// The cards of a deck and of the files it includes, which lie in its folder or below.
///
/// A deck without BEGIN BULK is bulk data from its first line. Free, small and large fields, tabs, capitals or not,
/// continuations that follow their card.
class Deck {
public:
    explicit Deck(Cursor& cursor);
    /// Hand every card over. @param wanted  whether the fields of a card of this name are needed.
    void read(const std::function<bool(std::string_view name)>& wanted,
              const std::function<void(const Card&)>& take);

private:
    struct File;

    void read_file(Cursor& cursor, int depth);
    void include(Cursor& cursor, std::string_view rest, int depth);
    void read_line(const Cursor& cursor, std::string_view line);
    void end_card();

    Cursor& main_;
    std::filesystem::path folder_;
    std::vector<std::shared_ptr<File>> files_; ///< included, kept for messages
    std::function<bool(std::string_view)> wanted_;
    std::function<void(const Card&)> take_;
    Card card_;
    std::string marker_; ///< last field of the line before, which names its continuation
    bool open_ = false, bulk_ = false, ended_ = false;
};

/// Coordinate frames, each given by three points in another frame or by three nodes.
class Frames {
public:
    struct Definition {
        char kind = 'R';          ///< rectangular, 'C'ylindrical or 'S'pherical, angles in degrees
        Index base = 0;           ///< frame of the three points; 0: the basic one
        std::array<Vec3, 3> at{}; ///< origin, a point on the z axis, a point in the xz plane
        bool by_nodes = false;
        std::array<Index, 3> node{}; ///< tags of nodes there instead
        DeckPlace place;
    };
    /// @param node_at  a node in basic coordinates, by its tag; may ask `to_basic()` again.
    explicit Frames(std::function<Vec3(Index tag, const DeckPlace& place)> node_at)
        : node_at_(std::move(node_at))
    {
    }

    void add(Index tag, const Definition& definition);
    /// A point of a frame in basic coordinates.
    /// @throw InvalidInput  no such frame, three points in line, frames given by each other; names `place`.
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
