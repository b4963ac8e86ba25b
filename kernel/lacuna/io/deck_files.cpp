// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_files.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/io/detail/input_file.h>

#include <algorithm>
#include <climits>

namespace lacuna::io {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostFiles = 1000; // included files; well above usual decks

} // namespace

struct DeckFiles::File {
    File(const std::string& path, std::uint64_t by) : bytes(read_file(path)), cursor(path, bytes), from(by) {}
    std::string bytes;
    Cursor cursor;
    std::uint64_t from; ///< number of the file that includes it
};

DeckFiles::DeckFiles(Cursor& main) : main_(main), folder_(fs::path(main.path()).parent_path()) {}

Cursor& DeckFiles::include(const std::string& name, const DeckPlace& place)
{
    if (name.empty() || name.size() > PATH_MAX || name.find('\0') != std::string::npos)
        place.fail("INCLUDE: expected the name of a file");
    if (files_.size() >= kMostFiles) place.fail("INCLUDE: the deck includes more than {} files", kMostFiles);
    // Links are resolved before comparing.
    std::error_code error;
    const fs::path base = fs::weakly_canonical(folder_.empty() ? fs::path(".") : folder_, error);
    const fs::path wanted = error ? fs::path() : fs::weakly_canonical(base / name, error);
    const auto [end, more] = std::mismatch(base.begin(), base.end(), wanted.begin(), wanted.end());
    if (error || end != base.end())
        place.fail(Message(kUnreadable, "INCLUDE: {} is not in the deck's folder", shown(name))
                       .remedy("put it there and name it without its folder"));
    bool is_open = fs::weakly_canonical(main_.path(), error) == wanted;
    for (std::uint64_t file = place.file; file > 0; file = files_[file - 1]->from)
        is_open = is_open || files_[file - 1]->cursor.path() == wanted;
    if (is_open) place.fail("INCLUDE: {} includes itself, directly or through other files", shown(name));
    auto opened = attempt<InvalidInput>([&] { return std::make_shared<File>(wanted.string(), place.file); });
    if (!opened) place.fail(Message(kUnreadable, "INCLUDE: {}", opened.why->text()).attempt(*opened.why));
    return files_.emplace_back(std::move(*opened))->cursor;
}

DeckPlace DeckFiles::place_of(std::uint64_t number) const
{
    const std::uint64_t file = (number - 1) >> DeckPlace::kPositionBits;
    const std::uint64_t position = (number - 1) & ((std::uint64_t(1) << DeckPlace::kPositionBits) - 1);
    return {file == 0 ? &main_ : &files_[file - 1]->cursor, position, file};
}

} // namespace lacuna::io
