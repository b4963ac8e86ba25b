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

/// Work shared by several processes. The host provides the communication: this folder depends neither on
/// processes nor on networks.
namespace lacuna {

/// A file to which all processes of a team write, each at its own offsets.
class SharedFile {
public:
    SharedFile() = default;
    virtual ~SharedFile() = default;
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;

    /// @throw BackendError  the disk is full.
    virtual void write_at(std::uint64_t offset, std::string_view bytes) = 0;
    /// Wait until everything is written. @throw BackendError  something could not be written.
    virtual void close() = 0;
};

/// The processes that share one task.
struct Team {
    int rank = 0, size = 1;
    bool one_machine = false; ///< all run on one machine, so that each can open a file that another has open
    /// Send a string to all and return the strings of all, by rank. Collective: waits until all have called.
    std::function<std::vector<std::string>(std::string own)> exchange;
    /// Open an existing file. Not collective: each process opens it for itself.
    /// @param name  the name of the file in messages. @throw BackendError
    std::function<std::unique_ptr<SharedFile>(const std::string& path, const std::string& name)> open;
};

/// Idle processes, to which tasks are given.
struct Crew {
    int size = 1; ///< including the caller
    /// Start a task on all processes, given its name and its input. Returns the team of the task, in which
    /// the caller has rank 0. The team exists until the task ends.
    std::function<const Team&(std::string_view task, const std::string& bytes)> call;
};

/// Another process of the team failed.
class TeamFailed : public Error {
public:
    using Error::Error;
};

/// The strings of all processes, by rank. Only valid inside `do_together()`. Null: this process works alone.
/// @throw TeamFailed  another process failed. The error has the code of that failure, and its message with
///        the number of the process.
std::vector<std::string> gather(const Team* team, const std::string& own);

/// Run `work` on all processes of a team. If it fails on one process it fails on all, at the next `gather()`
/// or at the end, so that no process waits for one that failed. Without a team, just runs `work`.
/// @throw  what `work` throws; TeamFailed as `gather()`; Cancelled if another process was cancelled.
void do_together(const Team* team, const std::function<void()>& work);

/// The subrange [first, second) of [0, count) of a rank. Subranges are contiguous and differ in size by <= 1.
std::pair<std::size_t, std::size_t> share_of(std::size_t rank, std::size_t size, std::size_t count);
/// The subrange of this process: everything if there is no team.
std::pair<std::size_t, std::size_t> share_of(const Team* team, std::size_t count);

} // namespace lacuna
