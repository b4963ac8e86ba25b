// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_files.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/input_file.h>

#include <algorithm>

namespace lacuna::io {
namespace fs = std::filesystem;
namespace {

constexpr int kDeepest = 20;             // nested files; well above usual decks
constexpr std::size_t kMostFiles = 1000; // included files; well above usual decks

} // namespace

struct DeckFiles::File {
    explicit File(const std::string& path) : bytes(read_file(path)), cursor(path, bytes) {}
    std::string bytes;
    Cursor cursor;
};

DeckFiles::DeckFiles(Cursor& main) : main_(main), folder_(fs::path(main.path()).parent_path()) {}

Cursor& DeckFiles::include(const std::string& name, const DeckPlace& place, int depth)
{
    if (name.empty() || name.size() > kLongestName || name.find('\0') != std::string::npos)
        place.fail("INCLUDE: expected the name of a file");
    if (depth >= kDeepest || files_.size() >= kMostFiles)
        place.fail(Message(kUnreadable, "INCLUDE: files are nested too deeply")
                       .remedy("check that no file includes itself"));
    // Links are resolved before comparing.
    std::error_code error;
    const fs::path base = fs::weakly_canonical(folder_.empty() ? fs::path(".") : folder_, error);
    const fs::path wanted = error ? fs::path() : fs::weakly_canonical(base / name, error);
    const auto [end, more] = std::mismatch(base.begin(), base.end(), wanted.begin(), wanted.end());
    if (error || end != base.end())
        place.fail(Message(kUnreadable, "INCLUDE: {} is not in the deck's folder", shown(name))
                       .remedy("put it there and name it without its folder"));
    try {
        files_.push_back(std::make_shared<File>(wanted.string()));
    } catch (const InvalidInput& trouble) {
        place.fail(Message(kUnreadable, "INCLUDE: {}", trouble.what()).attempt(trouble.message()));
    }
    return files_.back()->cursor;
}

DeckPlace DeckFiles::place_of(std::uint64_t number) const
{
    const std::uint64_t file = (number - 1) >> DeckPlace::kPositionBits;
    const std::uint64_t position = (number - 1) & ((std::uint64_t(1) << DeckPlace::kPositionBits) - 1);
    return {file == 0 ? &main_ : &files_[file - 1]->cursor, position, file};
}

} // namespace lacuna::io
