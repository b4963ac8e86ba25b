// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Work that several processes do together. How they speak to each other is the host's: this folder knows
/// neither processes nor networks.
namespace lacuna {

/// A file that all of a team write to at places of their own.
class SharedFile {
public:
    SharedFile() = default;
    virtual ~SharedFile() = default;
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;

    /// @throw BackendError  the disk is full.
    virtual void write_at(std::uint64_t offset, std::string_view bytes) = 0;
    /// All that was written has arrived, or is an error. @throw BackendError
    virtual void close() = 0;
};

/// Those who do one piece of work at the same time, each its share of it.
struct Team {
    int rank = 0, size = 1;
    bool one_machine = false; ///< all are on one: a file that one has open can be opened by the others
    /// What each has to say, by rank. All call it, and each waits until all have.
    std::function<std::vector<std::string>(std::string own)> exchange;
    /// Open a file that is there. Each opens it for itself.
    /// @param name  as a person knows it, for messages. @throw BackendError
    std::function<std::unique_ptr<SharedFile>(const std::string& path, const std::string& name)> open;
};

/// Others who wait to be called.
struct Crew {
    int size = 1; ///< with who calls
    /// Have all of them begin a task, with all that they need to know; who calls begins it too, and is rank 0
    /// of the team that is returned. The team ends with the task.
    std::function<const Team&(std::string_view task, const std::string& bytes)> call;
};

/// Another of the team failed.
class TeamFailed : public Error {
public:
    using Error::Error;
};

/// What each of a team has to say, by rank. Within `do_together()` alone. Null: this process is alone.
/// @throw TeamFailed  one of them failed: its code, and its message with the number of its process.
std::vector<std::string> gather(const Team* team, const std::string& own);

/// Do work that the whole team does at once. Where it fails for one it fails for all, at the next `gather()`
/// or at the end; nobody waits for who has failed. Without a team just does it.
/// @throw  what `work` throws; TeamFailed as `gather()`, or Cancelled where another was cancelled.
void do_together(const Team* team, const std::function<void()>& work);

/// The part [first, second) of [0, count) that is a rank's: parts that follow each other, as even as can be.
std::pair<std::size_t, std::size_t> share_of(std::size_t rank, std::size_t size, std::size_t count);
/// This process's, which is all of it without a team.
std::pair<std::size_t, std::size_t> share_of(const Team* team, std::size_t count);

} // namespace lacuna
