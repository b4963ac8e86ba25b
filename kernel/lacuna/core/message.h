// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <initializer_list>
#include <optional>
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
    /// Tags of the end vertices of an edge, where the text names them: "edge 3 (vertices 4-9)".
    std::optional<std::pair<long long, long long>> ends{};

    bool operator==(const NamedEntity& other) const { return kind == other.kind && tag == other.tag; }
};

/// A number or a text in a message.
using Value = std::variant<long long, double, std::string>;

/// An argument of a message: a number, a text, an entity or a list of entities.
class Argument {
public:
    enum class Role { plain, found, needed };

    template <std::integral Number>
    Argument(Number number) : value_(static_cast<long long>(number))
    {
    }
    Argument(double number) : value_(number) {}
    Argument(std::string text) : value_(std::move(text)) {}
    Argument(std::string_view text) : value_(std::string(text)) {}
    Argument(const char* text) : value_(std::string(text)) {}
    Argument(NamedEntity entity) : value_(std::vector<NamedEntity>{std::move(entity)}) {}
    /// Printed as a list of at most six entities and a count of the others.
    Argument(std::vector<NamedEntity> entities) : value_(std::move(entities)) {}
    Argument(Role role, const Argument& of) : value_(of.value_), role_(role) {}

    [[nodiscard]] const auto& value() const { return value_; }
    [[nodiscard]] Role role() const { return role_; }

private:
    std::variant<long long, double, std::string, std::vector<NamedEntity>> value_;
    Role role_ = Role::plain;
};

/// Mark what the input has, and what it would need instead: `found(12)`, `needed(14)`.
inline Argument found(const Argument& value) { return {Argument::Role::found, value}; }
inline Argument needed(const Argument& value) { return {Argument::Role::needed, value}; }

/// What an error or a note says, as data and as text.
///
///     Message("surface.sides_asked", "{} has {} sides, but {} are asked for", {face, found(7), needed(9)})
///         .remedy("give an even number")
class Message {
public:
    /// @param code    "folder.what_went_wrong"; stable, for programs.
    /// @param format  the text in the syntax of {fmt}, with a field for each argument: "{}", "{:.3g}", "{1}".
    Message(std::string code, std::string_view format, std::initializer_list<Argument> arguments = {});

    /// A message whose text is put together elsewhere; its entities are found in the text.
    static Message of_text(std::string code, const std::string& text);

    /// Add one thing to try; it follows the text after a semicolon.
    Message&& remedy(std::string_view format, std::initializer_list<Argument> arguments = {}) &&;
    /// Add why an attempt failed; its text is not repeated.
    Message&& attempt(Message failed) &&;
    /// The same message about a part, a file or a member: "subject: text".
    [[nodiscard]] Message about(std::string_view subject) const;

    [[nodiscard]] const std::string& code() const { return code_; }
    [[nodiscard]] std::string text() const;
    [[nodiscard]] const std::string& remedy() const { return remedy_; }
    /// The entities named in text and remedy, in order, each once.
    [[nodiscard]] const std::vector<NamedEntity>& entities() const { return entities_; }
    [[nodiscard]] const std::vector<Value>& found() const { return found_; }
    [[nodiscard]] const std::vector<Value>& needed() const { return needed_; }
    [[nodiscard]] const std::vector<Message>& attempts() const { return attempts_; }

private:
    void keep(std::initializer_list<Argument> arguments);
    void keep(const NamedEntity& entity);

    std::string code_, text_, remedy_;
    std::vector<NamedEntity> entities_;
    std::vector<Value> found_, needed_;
    std::vector<Message> attempts_;
};

/// Text in the syntax of {fmt}, for report lines and parts of messages. Independent of the locale of the host.
std::string formatted(std::string_view format, std::initializer_list<Argument> arguments);

} // namespace lacuna
