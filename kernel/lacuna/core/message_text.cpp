// SPDX-License-Identifier: MIT
#include <lacuna/core/message.h>

#include <lacuna/core/shared/list_text.h>

#define FMT_HEADER_ONLY
#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <type_traits>

namespace lacuna {
namespace {

std::string name_of(const NamedEntity& entity)
{
    std::string name = fmt::format("{} {}", entity.kind, entity.tag);
    if (!entity.name.empty()) name += fmt::format(" \"{}\"", entity.name);
    if (entity.ends) name += fmt::format(" (vertices {}-{})", entity.ends->first, entity.ends->second);
    return name;
}

std::string text_of(const MessageParts& parts)
{
    return parts.remedy.empty() ? parts.text : parts.text + "; " + parts.remedy;
}

} // namespace

std::string format_text(std::string_view format, std::span<const Argument> arguments)
{
    fmt::dynamic_format_arg_store<fmt::format_context> store;
    for (const Argument& argument : arguments)
        std::visit(
            [&]<class Held>(const Held& value) {
                if constexpr (std::is_same_v<Held, std::vector<NamedEntity>>)
                    store.push_back(short_list(value, name_of));
                else if constexpr (std::is_same_v<Held, MessageParts>)
                    store.push_back(text_of(value));
                else
                    store.push_back(value);
            },
            argument.value());
    return fmt::vformat(format, store);
}

Message Message::attempt(Message failed) const
{
    Message message = *this;
    message.attempts_.push_back(std::move(failed));
    return message;
}

Message Message::about(std::string_view subject) const
{
    Message message = *this;
    message.parts_.text = formatted("{}: {}", subject, parts_.text);
    return message;
}

std::string Message::text() const
{
    std::string all = text_of(parts_);
    std::vector<const Message*> said{this};
    for (const Message& failed : attempts_) {
        const auto same = [&](const Message* other) {
            return other->code() == failed.code() && other->entities() == failed.entities();
        };
        if (std::ranges::any_of(said, same)) continue; // this reason has been given already
        said.push_back(&failed);
        Message reason = failed;
        if (reason.remedy() == remedy()) reason.parts_.remedy.clear();
        all += " (" + reason.text() + ")";
    }
    return all;
}

std::string Message::add(std::string_view format, std::initializer_list<Argument> arguments)
{
    for (const Argument& argument : arguments)
        std::visit(
            [&]<class Held>(const Held& value) {
                if constexpr (std::is_same_v<Held, std::vector<NamedEntity>>) {
                    for (const NamedEntity& entity : value) add(entity);
                } else if constexpr (std::is_same_v<Held, MessageParts>) {
                    for (const NamedEntity& entity : value.entities) add(entity);
                    std::ranges::copy(value.found, std::back_inserter(parts_.found));
                    std::ranges::copy(value.needed, std::back_inserter(parts_.needed));
                } else if (argument.role() == Argument::Role::found) {
                    parts_.found.emplace_back(value);
                } else if (argument.role() == Argument::Role::needed) {
                    parts_.needed.emplace_back(value);
                }
            },
            argument.value());
    return format_text(format, arguments);
}

void Message::add(const NamedEntity& entity)
{
    std::vector<NamedEntity>& known = parts_.entities;
    if (std::ranges::find(known, entity) == known.end()) known.push_back(entity);
    if (!entity.ends) return;
    add(NamedEntity{"vertex", entity.ends->first});
    add(NamedEntity{"vertex", entity.ends->second});
}

} // namespace lacuna
