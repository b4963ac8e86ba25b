// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/core/types.h>
#include <lacuna/io/detail/texts.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

/// Reading position in the bytes of a file. Internal to this folder.
namespace lacuna::io {

/// Columns of a line in the formats that began on punched cards.
inline constexpr std::size_t kCardColumns = 80;
/// Columns of a field: of LS-DYNA's numbers of nodes and elements, and of Nastran's small fields. The first
/// and the last field of a Nastran line are always small.
inline constexpr std::size_t kCardField = 8;
/// Columns of a field of twice the width: of LS-DYNA's coordinates, and of Nastran's large fields.
inline constexpr std::size_t kLargeCardField = 2 * kCardField;
/// How a file stores numbers.
enum class Coding { text, little, big };
/// Whether `1.5D+3` and `1.5+3` are numbers too.
enum class Exponents { plain, fortran };

/// Characters of a real number, at most: a double written out in full has some 330.
inline constexpr std::size_t kLongestReal = 400;
/// Number of set members, copied entities or replicated cards that each byte of a file may generate: a wrong
/// count would fill the memory. It allows about fifty sets of all elements of an Abaqus file; not measured.
inline constexpr std::size_t kMadePerByte = 16;
/// The text as a finite number, in any locale; empty if it is not a number. A number too small for a double
/// gives 0.
std::optional<double> parse_real(std::string_view text, Exponents exponents = Exponents::plain);

/// The text as a whole number; empty if it is not one or does not fit.
template <class Int>
std::optional<Int> parse_integer(std::string_view text)
{
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    Int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

/// A value from its bytes. @param big  most significant byte first.
template <class Value>
Value from_bytes(const char* bytes, bool big)
{
    std::array<char, sizeof(Value)> own;
    std::memcpy(own.data(), bytes, own.size());
    if (big != (std::endian::native == std::endian::big)) std::ranges::reverse(own);
    return std::bit_cast<Value>(own);
}

/// Whether a character is a blank, tab or carriage return.
inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
/// The text without blanks and line ends on either side.
std::string_view trimmed(std::string_view text);
/// Whether two words are equal, ignoring case.
bool same_word(std::string_view a, std::string_view b);
/// Find the entry of a list that equals a word, ignoring case. With `of`, this member of the entries is
/// compared. Returns the end of the list if there is none.
template <class Entries, class Of = std::identity>
auto find_word(Entries& entries, std::string_view word, Of of = {})
{
    return std::ranges::find_if(
        entries, [&](std::string_view own) { return same_word(own, word); }, of);
}
/// The text in capitals.
std::string upper(std::string_view text);
/// Remove the first word from a text and return it; empty at the end of the text.
std::string_view next_word(std::string_view& text, std::string_view separators = " \t\r\n");
/// Call `take(number)` for each whole number of a text; blanks and commas separate words.
template <class Take>
void each_whole(std::string_view text, const Take& take)
{
    while (!text.empty())
        if (const auto number = parse_integer<std::int64_t>(next_word(text, ", \t\r\n"))) take(*number);
}
/// Remove the first field, up to a comma, from a line and return it without blanks on either side.
std::string_view next_field(std::string_view& line);
/// Whether this number of entities can be numbered by an Index.
constexpr bool is_index(std::uint64_t count)
{
    return count <= static_cast<std::uint64_t>(std::numeric_limits<Index>::max());
}
/// Text from a file as shown in a message: in quotes, at most 40 characters, unprintable ones as '?'.
std::string shown(std::string_view text);

/// The code of all errors in the text or the bytes of a file.
inline constexpr const char* kUnreadable = "io.unreadable";

/// Reads lines, words and values, never beyond the end. Messages name the file and the position of the last
/// item read: the line, or the byte in binary parts.
class Cursor {
public:
    Cursor(std::string path, std::string_view data);

    Coding coding = Coding::text; ///< how `integer()`, `size()` and `real()` read numbers
    bool has_bytes = false;       ///< parts of the file are binary, so that messages name bytes

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] bool at_end() const { return at_ >= data_.size(); }
    /// Position of the next character, and start of the last item read [bytes].
    [[nodiscard]] std::size_t position() const { return at_; }
    [[nodiscard]] std::size_t last() const { return last_; }
    [[nodiscard]] std::string_view rest() const { return data_.substr(at_); }
    /// A cursor over a part of the same file. It ends where the part ends.
    [[nodiscard]] Cursor part(std::string_view part) const;

    /// The rest of the line, unchanged.
    std::string_view raw_line();
    /// The rest of the line, without blanks at its ends.
    std::string_view line();
    /// The next line that is not empty; empty at the end of the file.
    std::string_view full_line();
    /// The next word of this line or a later one. @throw InvalidInput  at the end of the file.
    std::string_view word(const char* expected = "a word");
    /// The next word of this line; empty at its end.
    std::string_view word_in_line();
    /// Like `line()`, but messages still refer to the item read before.
    std::string_view line_end();
    /// Whether another word follows.
    bool more();
    /// Read the next word and check that it is this one, ignoring case.
    void expect(std::string_view wanted);
    /// The last item read.
    [[nodiscard]] std::string_view last_word() const { return data_.substr(last_, at_ - last_); }
    /// Check that the last word was this one.
    void expect_last(std::string_view wanted) const;
    /// Move past the next occurrence of `text`. @return  false: there is none, and the position is unchanged.
    bool skip_past(std::string_view text);

    int integer();        ///< 4 bytes, or text
    std::uint64_t size(); ///< 8 bytes, or text
    double real();        ///< 8 bytes, or text; finite
    Vec3 point();         ///< three reals
    /// A number in text, also in otherwise binary files.
    std::int64_t text_integer() { return integer_of(word("a number")); }
    double text_real() { return real_of(word("a number")); }
    /// Convert a word read before to a number. @throw InvalidInput  it is not a number.
    std::int64_t integer_of(std::string_view word) const;
    double real_of(std::string_view word, Exponents exponents = Exponents::plain) const;
    std::string_view bytes(std::uint64_t count);

    /// Check a count of records before memory is allocated. It is refused if the rest of the file is too
    /// short for so many records.
    /// @param bytes   size of a record in a binary file
    /// @param values  number of values of a record in a text file
    std::uint64_t plausible(std::uint64_t count, std::uint64_t bytes, std::uint64_t values) const;

    /// @throw InvalidInput "io.unreadable" with the file and the line or byte
    [[noreturn]] void fail(const Message& why) const { fail_at(last_, why); }
    [[noreturn]] void fail_at(std::size_t position, const Message& why) const;
    template <class... Arguments>
    [[noreturn]] void fail(lacuna::Format<sizeof...(Arguments)> format, const Arguments&... arguments) const
    {
        fail_at(last_, format, arguments...);
    }
    template <class... Arguments>
    [[noreturn]] void fail_at(std::size_t position, lacuna::Format<sizeof...(Arguments)> format,
                              const Arguments&... arguments) const
    {
        fail_at(position, Message(kUnreadable, format, arguments...));
    }

private:
    template <class Value>
    Value raw()
    {
        return from_bytes<Value>(bytes(sizeof(Value)).data(), coding == Coding::big);
    }

    std::string path_;
    std::string_view data_;
    std::size_t at_ = 0, last_ = 0;
};

} // namespace lacuna::io
