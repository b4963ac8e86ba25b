// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/cursor.h>

#include <lacuna/core/error.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace lacuna::io {
namespace {

bool separates(char c) { return is_blank(c) || c == '\n'; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Convert a Fortran number to the syntax of C++: the exponent may start with `D`, or with its sign only.
std::string plain_exponent(std::string_view text)
{
    std::string plain;
    for (const char c : text) {
        const bool bare_sign = (c == '+' || c == '-') && !plain.empty() &&
                               (is_digit(plain.back()) || plain.back() == '.');
        if (bare_sign) plain += 'e';
        plain += c == 'd' || c == 'D' ? 'e' : c;
    }
    return plain;
}

} // namespace

std::optional<double> parse_real(std::string_view text, Exponents exponents)
{
    if (text.size() > kLongestReal) return {};
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size()) {
        if (exponents == Exponents::plain) return {};
        return parse_real(plain_exponent(text), Exponents::plain);
    }
    const bool tiny = error == std::errc::result_out_of_range &&
                      (text.find("e-") != text.npos || text.find("E-") != text.npos);
    if (tiny) return 0;
    if (error != std::errc{} || !std::isfinite(value)) return {};
    return value;
}

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && separates(text.front())) text.remove_prefix(1);
    while (!text.empty() && separates(text.back())) text.remove_suffix(1);
    return text;
}

bool same_word(std::string_view a, std::string_view b)
{
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string upper(std::string_view text)
{
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

std::string_view next_word(std::string_view& text, std::string_view separators)
{
    text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(separators));
    text.remove_prefix(word.size());
    return word;
}

std::string_view next_field(std::string_view& line)
{
    const std::size_t end = std::min(line.find(','), line.size());
    const std::string_view field = trimmed(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
    return field;
}

std::string shown(std::string_view text)
{
    std::string result = "'";
    for (const char c : text.substr(0, 40)) result += c >= 32 && c < 127 ? c : '?';
    return result + "'";
}

Cursor::Cursor(std::string path, std::string_view data) : path_(std::move(path)), data_(data)
{
    if (data_.starts_with("\xef\xbb\xbf")) at_ = 3; // the byte order mark that some editors put before UTF-8
}

void Cursor::fail_at(std::size_t position, const Message& why) const
{
    const auto read = data_.substr(0, std::min(position, data_.size()));
    const NamedEntity place = has_bytes || coding != Coding::text
                                  ? numbered("byte", position)
                                  : numbered("line", 1 + std::count(read.begin(), read.end(), '\n'));
    throw InvalidInput(why.about(formatted("cannot read {}, {}", path_, place)));
}

Cursor Cursor::part(std::string_view part) const
{
    Cursor result = *this;
    const auto begin = static_cast<std::size_t>(part.data() - data_.data());
    result.data_ = data_.substr(0, begin + part.size());
    result.at_ = result.last_ = begin;
    return result;
}

std::string_view Cursor::raw_line()
{
    const std::size_t end = std::min(data_.find('\n', at_), data_.size());
    last_ = at_;
    at_ = std::min(end + 1, data_.size());
    return data_.substr(last_, end - last_);
}

std::string_view Cursor::line() { return trimmed(raw_line()); }

std::string_view Cursor::full_line()
{
    std::string_view text;
    while (text.empty() && !at_end()) text = line();
    return text;
}

std::string_view Cursor::word(const char* expected)
{
    more();
    last_ = at_;
    while (at_ < data_.size() && !separates(data_[at_])) ++at_;
    if (last_ == at_) fail("the file ends where {} was expected", expected);
    return data_.substr(last_, at_ - last_);
}

std::string_view Cursor::word_in_line()
{
    while (at_ < data_.size() && is_blank(data_[at_])) ++at_;
    if (at_end() || data_[at_] == '\n') return {};
    return word();
}

std::string_view Cursor::line_end()
{
    const std::size_t last = last_;
    const std::string_view text = line();
    last_ = last;
    return text;
}

bool Cursor::more()
{
    while (at_ < data_.size() && separates(data_[at_])) ++at_;
    return at_ < data_.size();
}

void Cursor::expect(std::string_view wanted)
{
    word();
    expect_last(wanted);
}

void Cursor::expect_last(std::string_view wanted) const
{
    if (!same_word(last_word(), wanted)) fail("expected {}, found {}", wanted, found(shown(last_word())));
}

bool Cursor::skip_past(std::string_view text)
{
    const std::size_t found = data_.find(text, at_);
    if (found == std::string_view::npos) return false;
    at_ = found + text.size();
    return true;
}

std::int64_t Cursor::integer_of(std::string_view word) const
{
    const auto value = parse_integer<std::int64_t>(word);
    if (!value) fail("expected a whole number, found {}", found(shown(word)));
    return *value;
}

double Cursor::real_of(std::string_view word, Exponents exponents) const
{
    const auto value = parse_real(word, exponents);
    if (!value) fail("expected a finite number, found {}", found(shown(word)));
    return *value;
}

int Cursor::integer()
{
    if (coding != Coding::text) return raw<int>();
    const std::int64_t value = text_integer();
    if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
        fail("the number {} is too large", value);
    return static_cast<int>(value);
}

std::uint64_t Cursor::size()
{
    if (coding != Coding::text) return raw<std::uint64_t>();
    const std::int64_t value = text_integer();
    if (value < 0) fail("expected a count or a tag, found {}", found(value));
    return static_cast<std::uint64_t>(value);
}

double Cursor::real()
{
    if (coding == Coding::text) return text_real();
    const double value = raw<double>();
    if (!std::isfinite(value)) fail("expected a finite number, found {}", found(value));
    return value;
}

Vec3 Cursor::point()
{
    const double x = real();
    const double y = real();
    const double z = real();
    return {x, y, z};
}

std::string_view Cursor::bytes(std::uint64_t count)
{
    last_ = at_;
    if (count > data_.size() - at_)
        fail("the file is cut off: expected {} bytes, found {}", needed(count), found(data_.size() - at_));
    at_ += count;
    return data_.substr(last_, count);
}

std::uint64_t Cursor::plausible(std::uint64_t count, std::uint64_t bytes, std::uint64_t values) const
{
    const std::uint64_t least = coding != Coding::text ? bytes : 2 * values; // in text, a digit and a blank
                                                                             // for each value
    if (count > (data_.size() - at_ + 1) / std::max<std::uint64_t>(least, 1))
        fail("the file is cut off: it announces {} entries, but is too short for them", count);
    return count;
}

} // namespace lacuna::io
