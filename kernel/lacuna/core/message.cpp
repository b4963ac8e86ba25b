// SPDX-License-Identifier: MIT
#include <lacuna/core/message.h>

#include <lacuna/core/error.h>

#include <utility>

namespace lacuna {

Argument::Argument(std::string text) : value_(std::move(text)) {}
Argument::Argument(std::string_view text) : value_(std::string(text)) {}
Argument::Argument(const char* text) : value_(std::string(text)) {}
Argument::Argument(const NamedEntity& entity) : value_(std::vector<NamedEntity>{entity}) {}
Argument::Argument(std::vector<NamedEntity> entities) : value_(std::move(entities)) {}
Argument::Argument(MessageParts quoted) : value_(std::move(quoted)) {}
Argument::Argument(Role role, const Argument& of) : value_(of.value_), role_(role) {}

Argument::Argument(const Argument&) = default;
Argument::Argument(Argument&&) noexcept = default;
Argument& Argument::operator=(const Argument&) = default;
Argument& Argument::operator=(Argument&&) noexcept = default;
Argument::~Argument() = default;

Message::Message(std::string_view code, std::string_view format, std::initializer_list<Argument> arguments)
{
    parts_.code = code;
    parts_.text = add(format, arguments);
}

Message::Message(MessageParts parts) : parts_(std::move(parts)) {}

Message::Message(const Message&) = default;
Message::Message(Message&&) noexcept = default;
Message& Message::operator=(const Message&) = default;
Message& Message::operator=(Message&&) noexcept = default;
Message::~Message() = default;

Error::Error(Message message) : std::runtime_error(message.text()), message_(std::move(message)) {}

Cancelled::Cancelled() : Error("core.cancelled", "cancelled") {}

} // namespace lacuna
