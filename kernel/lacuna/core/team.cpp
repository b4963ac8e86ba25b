// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/team.h>

#include <lacuna/core/shared/bytes.h>

#include <algorithm>
#include <exception>

namespace lacuna {

namespace {

// The first byte of each exchanged string tells whether it is a result or an error.
constexpr char kSaid = 's', kFailed = 'f';

std::string failure(const Message& message)
{
    Writer writer;
    writer(message.parts());
    return kFailed + std::move(writer).take();
}

[[noreturn]] void rethrow(std::string_view said, std::size_t rank, std::size_t size)
{
    MessageParts parts;
    Reader reader(said.substr(1));
    reader(parts);
    throw TeamFailed(Message(std::move(parts)).about(formatted("process {} of {}", rank + 1, size)));
}

} // namespace

std::vector<std::string> gather(const Team* team, const std::string& own)
{
    if (team == nullptr) return {own};
    std::vector<std::string> all = team->exchange(kSaid + own);
    for (std::size_t rank = 0; rank < all.size(); ++rank)
        if (all[rank].front() == kFailed) rethrow(all[rank], rank, all.size());
    for (std::string& one : all) one.erase(0, 1);
    return all;
}

void do_together(const Team* team, const std::function<void()>& work)
{
    if (team == nullptr) return work();
    const auto tell = [&](const Message& message) { static_cast<void>(team->exchange(failure(message))); };
    try {
        work();
        gather(team, {});
    } catch (const TeamFailed& error) { // all processes know of the failure already
        if (error.code() == Cancelled().code()) throw Cancelled();
        throw;
    } catch (const Error& error) {
        tell(error.message());
        throw;
    } catch (const std::exception& error) {
        tell(Message("core.failed", "{}", error.what()));
        throw;
    }
}

std::pair<std::size_t, std::size_t> share_of(std::size_t rank, std::size_t size, std::size_t count)
{
    const auto begin = [&](std::size_t r) { return r * (count / size) + std::min(r, count % size); };
    return {begin(rank), begin(rank + 1)};
}

std::pair<std::size_t, std::size_t> share_of(const Team* team, std::size_t count)
{
    if (team == nullptr) return {0, count};
    return share_of(static_cast<std::size_t>(team->rank), static_cast<std::size_t>(team->size), count);
}

} // namespace lacuna
