// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/named_entities.h>

#include <algorithm>
#include <charconv>

namespace lacuna {

namespace {

struct Kind {
    std::string_view word, singular;
};

constexpr Kind kKinds[] = {
    {"face", "face"},       {"faces", "face"},       {"edge", "edge"},   {"edges", "edge"},
    {"vertex", "vertex"},   {"vertices", "vertex"},  {"loop", "loop"},   {"loops", "loop"},
    {"node", "node"},       {"nodes", "node"},       {"cell", "cell"},   {"cells", "cell"},
    {"element", "element"}, {"elements", "element"}, {"layer", "layer"}, {"solid", "solid"},
};

/// Words before a kind that are part of it, as in "void face".
constexpr std::string_view kPrefixes[] = {"void", "source", "target"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Parses a message from left to right.
class Reader {
public:
    explicit Reader(std::string_view text) : rest_(text) {}

    [[nodiscard]] bool empty() const { return rest_.empty(); }
    void skip(std::size_t count = 1) { rest_.remove_prefix(std::min(count, rest_.size())); }
    bool take(std::string_view text)
    {
        if (!rest_.starts_with(text)) return false;
        skip(text.size());
        return true;
    }
    std::string_view take_word()
    {
        const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_letter);
        const std::string_view word = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
        skip(word.size());
        return word;
    }
    /// Take an integer; false if there is none, or if it is the integer part of a decimal number.
    bool take_number(long long& number)
    {
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
        if (error != std::errc() || !is_digit(rest_.front())) return false;
        const auto length = static_cast<std::size_t>(end - rest_.data());
        const std::string_view after = rest_.substr(length);
        if (!after.empty() && is_letter(after[0])) return false;
        if (after.size() > 1 && after[0] == '.' && is_digit(after[1])) return false;
        skip(length);
        return true;
    }
    /// Skip text in quotes, with or without a space before it. A quote without an end is ignored.
    bool take_quoted()
    {
        const std::size_t open = rest_.starts_with(" \"") ? 1 : 0;
        if (open >= rest_.size() || rest_[open] != '"') return false;
        const std::size_t close = rest_.find('"', open + 1);
        skip(close == std::string_view::npos ? open + 1 : close + 1);
        return true;
    }
    /// Skip the text between two numbers of a list.
    bool take_separator()
    {
        const Reader before = *this;
        for (const std::string_view text : {", and ", ", ", " and ", " or ", "-"}) {
            if (take(text)) {
                if (!empty() && is_digit(rest_.front())) return true;
                *this = before;
            }
        }
        return false;
    }

private:
    std::string_view rest_;
};

void add(std::vector<NamedEntity>& found, NamedEntity entity)
{
    if (std::find(found.begin(), found.end(), entity) == found.end()) found.push_back(std::move(entity));
}

} // namespace

std::vector<NamedEntity> named_entities(std::string_view message)
{
    std::vector<NamedEntity> found;
    std::string_view before; // the word before this one
    for (Reader reader(message); !reader.empty();) {
        if (reader.take_quoted()) continue;
        const std::string_view word = reader.take_word();
        if (word.empty()) {
            if (!reader.take(" ")) reader.skip(), before = {}; // the word must follow its prefix directly
            continue;
        }
        const auto kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                       [&](const Kind& known) { return known.word == word; });
        const bool is_prefixed = std::find(std::begin(kPrefixes), std::end(kPrefixes), before) !=
                                 std::end(kPrefixes);
        const std::string prefix = is_prefixed ? std::string(before) + " " : "";
        before = word;
        if (kind == std::end(kKinds) || !reader.take(" ")) continue;
        for (long long tag = 0; reader.take_number(tag);) {
            add(found, {prefix + std::string(kind->singular), tag, {}, {}});
            reader.take_quoted();
            if (kind->word == kind->singular || !reader.take_separator()) break;
        }
    }
    return found;
}

} // namespace lacuna
