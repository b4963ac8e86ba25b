// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace lacuna {

/// An entity that a message names, by the tag or number that the user knows.
struct NamedEntity {
    std::string kind; ///< "face", "void face", "edge", "vertex", "source loop", "node", "cell", "element"…
    long long tag = 0;
    std::string name{}; ///< given by the user or the input; may be empty
    /// Tags of the end vertices of an edge, if the text is to name them: "edge 3 (vertices 4-9)".
    std::optional<std::pair<long long, long long>> ends{};

    bool operator==(const NamedEntity& other) const { return kind == other.kind && tag == other.tag; }
};

/// A number or a text in a message.
using MessageValue = std::variant<long long, double, std::string>;

/// The parts of a message, as data. They can be sent to another process, or quoted by another message.
struct MessageParts {
    std::string code; ///< "folder.what_went_wrong"; stable, for programs
    std::string text; ///< without the remedy
    std::string remedy;
    std::vector<NamedEntity> entities{}; ///< named in text and remedy, in order, each once
    std::vector<MessageValue> found{}, needed{};
    bool is_warning = false; ///< a note that every user should see, not only one who asks for details
};

/// An argument of a message: a number, a text, an entity, a list of entities or another message.
///
/// Copying and destruction of messages and arguments are defined in `message.cpp`. As inline functions, they
/// would be compiled again at each of the many places that make an error.
class Argument {
public:
    enum class Role { plain, found, needed };

    template <std::integral Number>
    Argument(Number number) : value_(static_cast<long long>(number))
    {
        if constexpr (std::unsigned_integral<Number> && sizeof(Number) == sizeof(long long))
            if (!std::in_range<long long>(number)) value_ = std::to_string(number);
    }
    Argument(double number) : value_(number) {}
    Argument(std::string text);
    Argument(std::string_view text);
    Argument(const char* text);
    Argument(const NamedEntity& entity);
    /// Printed as a list of at most six entities and a count of the others.
    Argument(std::vector<NamedEntity> entities);
    /// Prints the text and the remedy of the quoted message. The entities and values of the quoted message
    /// are added to the new message.
    Argument(MessageParts quoted);
    Argument(Role role, const Argument& of);

    Argument(const Argument&);
    Argument(Argument&&) noexcept;
    Argument& operator=(const Argument&);
    Argument& operator=(Argument&&) noexcept;
    ~Argument();

    [[nodiscard]] const auto& value() const { return value_; }
    [[nodiscard]] Role role() const { return role_; }

private:
    std::variant<long long, double, std::string, std::vector<NamedEntity>, MessageParts> value_;
    Role role_ = Role::plain;
};

/// Mark a value as the one found in the input, or as the one needed instead: `found(12)`, `needed(14)`.
inline Argument found(const Argument& value) { return {Argument::Role::found, value}; }
inline Argument needed(const Argument& value) { return {Argument::Role::needed, value}; }

/// A text in the syntax of {fmt} with fields for `Count` arguments: "{}", "{:.3g}" or "{1}". The number of
/// fields is checked when the text is compiled.
template <std::size_t Count>
class Format {
public:
    consteval Format(const char* text) : text_(text)
    {
        if (fields(text_) != Count) throw "the text has another number of fields than arguments";
    }
    [[nodiscard]] std::string_view text() const { return text_; }

private:
    static consteval std::size_t fields(std::string_view text)
    {
        std::size_t highest = 0, next = 0;
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] != '{' && text[i] != '}') continue;
            if (i + 1 < text.size() && text[i + 1] == text[i]) {
                ++i;
                continue;
            }
            if (text[i] == '}') throw "a brace that closes nothing; a brace in the text is written twice";
            std::size_t number = 0;
            const std::size_t first = ++i;
            for (; text[i] >= '0' && text[i] <= '9'; ++i)
                number = 10 * number + static_cast<std::size_t>(text[i] - '0');
            highest = std::max(highest, i > first ? number + 1 : ++next);
            while (text[i] != '}') ++i;
        }
        return highest;
    }

    std::string_view text_;
};

/// An error or a note, as data and as text.
///
///     Message("surface.sides_asked", "{} has {} sides, but {} are needed", edge, found(7), needed(8))
///         .remedy("load with keep_mesh = false")
///
/// Exported from the shared library, because hosts copy the message of an error that they caught.
class __attribute__((visibility("default"))) Message {
public:
    /// @param code    "folder.what_went_wrong"; stable, for programs.
    /// @param format  the text, with a field for each argument.
    template <class... Arguments>
    Message(std::string_view code, Format<sizeof...(Arguments)> format, const Arguments&... arguments)
        : Message(code, format.text(), std::initializer_list<Argument>{Argument(arguments)...})
    {
    }
    /// Rebuild a message that another process sent as its parts. The parts are kept unchanged.
    explicit Message(MessageParts parts);

    Message(const Message&);
    Message(Message&&) noexcept;
    Message& operator=(const Message&);
    Message& operator=(Message&&) noexcept;
    ~Message();

    /// Add one thing that the user can try. It is printed after the text and a semicolon.
    template <class... Arguments>
    [[nodiscard]] Message remedy(Format<sizeof...(Arguments)> format, const Arguments&... arguments) &&
    {
        parts_.remedy = add(format.text(), {Argument(arguments)...});
        return std::move(*this);
    }
    template <class... Arguments>
    [[nodiscard]] Message remedy(Format<sizeof...(Arguments)> format, const Arguments&... arguments) const&
    {
        return Message(*this).remedy(format, arguments...);
    }
    /// Mark a note as one that every user should see.
    [[nodiscard]] Message as_warning() &&
    {
        parts_.is_warning = true;
        return std::move(*this);
    }
    /// Add the reason why an attempt failed. It is printed in brackets at the end of the text.
    [[nodiscard]] Message attempt(Message failed) const;
    /// The same message with the name of a part, file or member in front: "subject: text".
    [[nodiscard]] Message about(std::string_view subject) const;

    [[nodiscard]] const std::string& code() const { return parts_.code; }
    [[nodiscard]] std::string text() const;
    [[nodiscard]] const std::string& remedy() const { return parts_.remedy; }
    [[nodiscard]] bool is_warning() const { return parts_.is_warning; }
    /// The entities named in text and remedy, in order, each once.
    [[nodiscard]] const std::vector<NamedEntity>& entities() const { return parts_.entities; }
    [[nodiscard]] const std::vector<MessageValue>& found() const { return parts_.found; }
    [[nodiscard]] const std::vector<MessageValue>& needed() const { return parts_.needed; }
    /// All parts of the message except the failed attempts.
    [[nodiscard]] const MessageParts& parts() const { return parts_; }
    [[nodiscard]] const std::vector<Message>& attempts() const { return attempts_; }

private:
    Message(std::string_view code, std::string_view format, std::initializer_list<Argument> arguments);
    /// Store the arguments as data. @return  the formatted text
    std::string add(std::string_view format, std::initializer_list<Argument> arguments);
    void add(const NamedEntity& entity);

    MessageParts parts_;
    std::vector<Message> attempts_;
};

/// Implementation of `formatted()`.
std::string format_text(std::string_view format, std::span<const Argument> arguments);

/// Text for report lines and parts of messages. Independent of the locale of the host.
template <class... Arguments>
std::string formatted(Format<sizeof...(Arguments)> format, const Arguments&... arguments)
{
    return format_text(format.text(), std::initializer_list<Argument>{Argument(arguments)...});
}

} // namespace lacuna
