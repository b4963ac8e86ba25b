// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/cursor.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// Decks of several files. Internal to this folder.
namespace lacuna::io {

/// A position in a deck that may consist of several files.
struct DeckPlace {
    const Cursor* cursor = nullptr;
    std::size_t position = 0;
    std::uint64_t file = 0; ///< 0: the deck itself; others in the order of inclusion

    /// @throw InvalidInput "io.unreadable"
    template <class... Arguments>
    [[noreturn]] void fail(lacuna::Format<sizeof...(Arguments)> format, const Arguments&... arguments) const
    {
        cursor->fail_at(position, format, arguments...);
    }
    [[noreturn]] void fail(const Message& why) const { cursor->fail_at(position, why); }
    /// The position as one number above 0.
    [[nodiscard]] std::uint64_t number() const { return (file << kPositionBits | position) + 1; }
    static constexpr int kPositionBits = 44; // for files of up to 16 TB
};

/// A deck and its included files, which lie in its folder or below.
class DeckFiles {
public:
    explicit DeckFiles(Cursor& main);

    /// The cursor of a file that an INCLUDE at `place` names.
    /// @throw InvalidInput  the file does not exist, lies elsewhere, or includes itself.
    Cursor& include(const std::string& name, const DeckPlace& place);
    /// Number of the file included last.
    [[nodiscard]] std::uint64_t last() const { return files_.size(); }
    [[nodiscard]] DeckPlace place_of(std::uint64_t number) const;

private:
    struct File;
    Cursor& main_;
    std::filesystem::path folder_;
    std::vector<std::shared_ptr<File>> files_; ///< kept open for messages, and because words point into their
                                               ///< text
};

} // namespace lacuna::io
