// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/msh_cursor.h>

#include <lacuna/core/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace lacuna::io {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string quoted(std::string_view text)
{
    std::string result = "'";
    for (const char c : text.substr(0, 40)) result += c >= 32 && c < 127 ? c : '?';
    return result + "'";
}

} // namespace

void MshCursor::fail(const std::string& what) const
{
    const auto read = data_.substr(0, std::min(at_, data_.size()));
    const std::string place = binary
                                  ? "byte " + std::to_string(at_)
                                  : "line " + std::to_string(1 + std::count(read.begin(), read.end(), '\n'));
    throw InvalidInput("io.bad_mesh", "cannot read '" + path_ + "', " + place + ": " + what);
}

std::string_view MshCursor::line()
{
    const std::size_t end = std::min(data_.find('\n', at_), data_.size());
    std::string_view text = data_.substr(at_, end - at_);
    at_ = std::min(end + 1, data_.size());
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

void MshCursor::leave(const std::string& section)
{
    const std::string end = "$End" + section;
    const std::size_t found = data_.find(end, at_);
    if (found == std::string_view::npos) fail("the file ends within $" + section);
    at_ = found + end.size();
    line();
}

std::string_view MshCursor::token()
{
    while (at_ < data_.size() && blank(data_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < data_.size() && !blank(data_[at_])) ++at_;
    if (begin == at_) fail("the file ends where a number was expected");
    return data_.substr(begin, at_ - begin);
}

std::int64_t MshCursor::text_integer()
{
    const std::string_view text = token();
    std::int64_t value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size())
        fail("expected a whole number, found " + quoted(text));
    return value;
}

double MshCursor::text_real()
{
    std::string_view text = token();
    if (text.size() > 1 && text.front() == '+') text.remove_prefix(1);
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool tiny = result.ec == std::errc::result_out_of_range &&
                      (text.find("e-") != text.npos || text.find("E-") != text.npos);
    if ((result.ec != std::errc() && !tiny) || result.ptr != text.data() + text.size())
        fail("expected a number, found " + quoted(text));
    return tiny ? 0 : value;
}

int MshCursor::integer()
{
    if (binary) return raw<int>();
    const std::int64_t value = text_integer();
    if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
        fail("the number " + std::to_string(value) + " is too large");
    return static_cast<int>(value);
}

std::uint64_t MshCursor::size()
{
    if (binary) return raw<std::uint64_t>();
    const std::int64_t value = text_integer();
    if (value < 0) fail("expected a count or a tag, found " + std::to_string(value));
    return static_cast<std::uint64_t>(value);
}

double MshCursor::real() { return binary ? raw<double>() : text_real(); }

std::string_view MshCursor::bytes(std::uint64_t count)
{
    if (count > data_.size() - at_) fail("the file is cut off");
    const std::string_view result = data_.substr(at_, count);
    at_ += count;
    return result;
}

std::uint64_t MshCursor::plausible(std::uint64_t count, std::uint64_t bytes, std::uint64_t values)
{
    const std::uint64_t least = binary ? bytes : 2 * values; // a digit and a blank
    if (count > (data_.size() - at_ + 1) / std::max<std::uint64_t>(least, 1))
        fail("the file is cut off: it announces " + std::to_string(count) +
             " entries and has no room for them");
    return count;
}

} // namespace lacuna::io
