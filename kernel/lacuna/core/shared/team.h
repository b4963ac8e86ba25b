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
    bool one_machine = false; ///< whether all run on one machine and can open the same local file
    /// Send a string to all processes, and return the strings of all processes, by rank. Collective: it
    /// returns when all processes have called it.
    std::function<std::vector<std::string>(std::string own)> exchange;
    /// Open an existing file. Not collective: each process opens it for itself.
    /// @param name  the name of the file in messages. @throw BackendError
    std::function<std::unique_ptr<SharedFile>(const std::string& path, const std::string& name)> open;
};

/// Idle processes that wait for tasks.
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

/// Exchange strings: send `own` to all processes, and return the strings of all, by rank. Only valid inside
/// `do_together()`.
/// @param team  null: this process works alone, and the result has only its string.
/// @throw TeamFailed  another process failed. The error has the code of that failure, and its message with
///        the number of the process.
std::vector<std::string> gather(const Team* team, const std::string& own);

/// Run `work` on all processes of a team. If `work` fails on one process, the call fails on all processes: at
/// the next `gather()`, or at the end of `work`. No process then waits for a process that failed. Without a
/// team, the function only runs `work`.
/// @throw  what `work` throws; TeamFailed as `gather()`; Cancelled if another process was cancelled.
void do_together(const Team* team, const std::function<void()>& work);

/// The subrange [first, second) of [0, count) of a rank. Subranges are contiguous and differ in size by <= 1.
std::pair<std::size_t, std::size_t> share_of(std::size_t rank, std::size_t size, std::size_t count);
/// The subrange of this process: everything if there is no team.
std::pair<std::size_t, std::size_t> share_of(const Team* team, std::size_t count);

} // namespace lacuna
