// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/input_file.h>
#include <lacuna/io/detail/nastran.h>

#include <lacuna/core/error.h>

#include <algorithm>
#include <cctype>

namespace lacuna::io {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kField = 8;       // characters of a small field, and of the first and last of each line
constexpr std::size_t kLargeField = 16; // characters
constexpr std::size_t kFields = 8;      // data fields of a line; large ones take two lines
constexpr int kDeepest = 20;            // files within files: a choice, well above what people write
constexpr std::size_t kMostFiles = 1000;   // likewise
constexpr std::size_t kLongestName = 4096; // characters of a file's name, as Linux takes them

std::string upper(std::string_view text)
{
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

bool begins_with(std::string_view line, std::string_view word)
{
    return same_word(line.substr(0, word.size()), word) &&
           (line.size() == word.size() || std::isalnum(static_cast<unsigned char>(line[word.size()])) == 0);
}

bool begins_bulk(std::string_view line)
{
    return begins_with(line, "BEGIN") && upper(line).find("BULK") != std::string::npos;
}

bool is_large(std::string_view first) { return first.find('*') != std::string_view::npos; }

/// The fields of a line in free format.
std::vector<std::string> free_fields(const Cursor& cursor, std::string_view line)
{
    std::vector<std::string> fields;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        fields.emplace_back(trimmed(line.substr(begin, end - begin)));
        begin = end + 1;
    }
    const std::size_t all = 2 + (is_large(fields[0]) ? kFields / 2 : kFields);
    for (std::size_t k = all; k < fields.size(); ++k)
        if (!fields[k].empty())
            cursor.fail("expected at most " + std::to_string(all) + " fields in a line, found " +
                        std::to_string(fields.size()));
    fields.resize(all);
    return fields;
}

/// The fields of a line in small or large format, tabs to the next column of eight.
std::vector<std::string> fixed_fields(std::string_view line)
{
    constexpr std::size_t kColumns = (kFields + 2) * kField; // what is further right does not count
    std::string wide;
    for (const char c : line) {
        if (wide.size() >= kColumns) break;
        if (c == '\t')
            wide.append(kField - wide.size() % kField, ' ');
        else
            wide += c;
    }
    wide.resize(kColumns, ' ');
    const auto field = [&](std::size_t begin, std::size_t length) {
        return std::string(trimmed(std::string_view(wide).substr(begin, length)));
    };
    std::vector<std::string> fields{field(0, kField)};
    const std::size_t width = is_large(fields[0]) ? kLargeField : kField;
    for (std::size_t begin = kField; begin < kColumns - kField; begin += width)
        fields.push_back(field(begin, width));
    fields.push_back(field(kColumns - kField, kField));
    return fields;
}

} // namespace

struct Deck::File {
    explicit File(const std::string& path) : bytes(io::read_file(path)), cursor(path, bytes) {}
    std::string bytes;
    Cursor cursor;
};

std::string_view Card::field(std::size_t number) const
{
    return number - 2 < fields.size() ? std::string_view(fields[number - 2]) : std::string_view();
}

Index Card::whole(std::size_t number, Index otherwise) const
{
    const std::string_view text = field(number);
    if (text.empty()) return otherwise;
    const auto value = parse_integer<Index>(text);
    if (!value || *value < 0)
        fail("expected a whole number in field " + std::to_string(number) + ", found " + shown(text));
    return *value;
}

Index Card::needed(std::size_t number) const
{
    if (field(number).empty()) fail("expected a number in field " + std::to_string(number) + ", found none");
    return whole(number, 0);
}

double Card::real(std::size_t number) const
{
    const std::string_view text = field(number);
    if (text.empty()) return 0;
    const auto value = parse_real(text, Exponents::fortran);
    if (!value)
        fail("expected a finite number in field " + std::to_string(number) + ", found " + shown(text));
    return *value;
}

Vec3 Card::point(std::size_t first) const { return {real(first), real(first + 1), real(first + 2)}; }

Deck::Deck(Cursor& cursor) : main_(cursor), folder_(fs::path(cursor.path()).parent_path()), bulk_(true)
{
    for (Cursor scout = cursor; bulk_ && !scout.at_end();) bulk_ = !begins_bulk(scout.line());
}

void Deck::read(const std::function<bool(std::string_view)>& wanted,
                const std::function<void(const Card&)>& take)
{
    wanted_ = wanted;
    take_ = take;
    read_file(main_, 0);
    end_card();
}

void Deck::read_file(Cursor& cursor, int depth)
{
    while (!cursor.at_end() && !ended_) {
        std::string_view line = cursor.raw_line();
        line = line.substr(0, line.find('$'));
        const std::string_view words = trimmed(line);
        if (words.empty()) continue;
        if (begins_with(words, "INCLUDE"))
            include(cursor, words.substr(7), depth);
        else if (begins_with(words, "BEGIN") && upper(words).find("SUPER") != std::string::npos)
            cursor.fail("superelements are not read; write the deck as one");
        else if (begins_bulk(words))
            bulk_ = true;
        else if (begins_with(words, "ENDDATA"))
            ended_ = true;
        else if (bulk_)
            read_line(cursor, line);
    }
}

void Deck::include(Cursor& cursor, std::string_view rest, int depth)
{
    end_card();
    const DeckPlace place{&cursor, cursor.last()};
    std::string name(trimmed(rest));
    if (name.starts_with('\'') || name.starts_with('"')) {
        const char quote = name[0];
        while (name.find(quote, 1) == std::string::npos) {
            if (cursor.at_end() || name.size() > kLongestName) place.fail("INCLUDE: the name has no end");
            name += cursor.line();
        }
        name = name.substr(1, name.find(quote, 1) - 1);
    }
    if (name.empty() || name.size() > kLongestName || name.find('\0') != std::string::npos)
        place.fail("INCLUDE: expected the name of a file");
    if (depth >= kDeepest || files_.size() >= kMostFiles)
        place.fail("INCLUDE: too many files within files; does one include itself?");
    // Links are followed before comparing.
    std::error_code error;
    const fs::path base = fs::weakly_canonical(folder_.empty() ? fs::path(".") : folder_, error);
    const fs::path wanted = error ? fs::path() : fs::weakly_canonical(base / name, error);
    const auto [end, more] = std::mismatch(base.begin(), base.end(), wanted.begin(), wanted.end());
    if (error || end != base.end())
        place.fail("INCLUDE: " + shown(name) +
                   " is not in the deck's folder; put it there and name it without its folder");
    std::shared_ptr<File> file;
    try {
        file = std::make_shared<File>(wanted.string());
    } catch (const InvalidInput& trouble) {
        place.fail(std::string("INCLUDE: ") + trouble.what());
    }
    files_.push_back(file);
    read_file(file->cursor, depth + 1);
    end_card();
}

void Deck::read_line(const Cursor& cursor, std::string_view line)
{
    std::vector<std::string> fields = line.find(',') != std::string_view::npos ? free_fields(cursor, line)
                                                                               : fixed_fields(line);
    const std::string& first = fields.front();
    if (first.empty() || first[0] == '+' || first[0] == '*') {
        if (!open_) cursor.fail("a continuation " + shown(first) + " of no card");
        const bool both_named = first.size() > 1 && marker_.size() > 1;
        if (both_named && !same_word(std::string_view(first).substr(1), std::string_view(marker_).substr(1)))
            cursor.fail("expected the continuation " + shown(marker_) + ", found " + shown(first) +
                        "; put continuations behind their cards");
        if (card_.fields.size() % kFields != 0 && !is_large(first))
            cursor.fail("expected the second half of a card of large fields, which begins with *");
    } else {
        end_card();
        const std::string_view name = std::string_view(first).substr(0, first.find('*'));
        const auto fits = [](unsigned char c) { return std::isalnum(c) != 0; };
        if (std::isalpha(static_cast<unsigned char>(first[0])) == 0 || name.size() > kField ||
            !std::ranges::all_of(name, fits))
            cursor.fail("expected the name of a bulk data card, found " + shown(first));
        open_ = true;
        card_.place = {&cursor, cursor.last()};
        card_.name = upper(name);
    }
    marker_ = std::move(fields.back());
    if (wanted_(card_.name))
        card_.fields.insert(card_.fields.end(), std::make_move_iterator(fields.begin() + 1),
                            std::make_move_iterator(fields.end() - 1));
}

void Deck::end_card()
{
    if (!std::exchange(open_, false)) return;
    take_(card_);
    card_.fields.clear();
}

} // namespace lacuna::io
