// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/limits.h>
#include <lacuna/cad_protocol/channel.h>
#include <lacuna/core/error.h>
#include <lacuna/core/run_context.h>

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace lacuna::cad {

/// What a request is about, for limits and messages.
struct Task {
    std::string subject{};    ///< the file
    std::string doing{};      ///< "reading it", "projecting points"
    Limits limits{};          ///< 0: by `bytes` and `points`
    std::uint64_t bytes = 0;  ///< of files sent along
    std::uint64_t points = 0; ///< sent along
    const RunContext* context = nullptr;
    double grace = 0;       ///< how long it may go on once it is cancelled [s]
    const char* stage = ""; ///< of the context's progress
};

/// The process had ended before it was asked: nothing was done, and another may be asked.
class WorkerGone : public BackendError {
public:
    using BackendError::BackendError;
};

/// The CAD process of this process: lacuna-cad, started when it is first needed and kept.
///
/// It may end at any time (a crash, a limit, someone's kill). Then the request under way is a BackendError
/// that says how, and every later request to this object is a WorkerGone; `current()` starts another. One
/// that failed to load a file serves the models it has and loads no more. Safe for several threads: requests
/// wait for each other. A child made by fork() starts a process of its own.
class Worker {
public:
    /// The living one, started if need be.
    /// @param subject  what it is needed for, a file as a rule, for the message.
    /// @throw BackendError  "cad.no_worker": the program is not found or does not start; names the subject.
    static std::shared_ptr<Worker> current(const RunContext* context = nullptr,
                                           const std::string& subject = {});
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Ask and wait for the answer.
    /// @throw InvalidInput, NotSweepable, BackendError  as the worker says, or what became of it; Cancelled.
    template <class Reply, class Request>
    Reply ask(cad_protocol::Opcode opcode, const Request& request, const Task& task,
              const std::vector<int>& descriptors = {})
    {
        return receive<Reply>(opcode, cad_protocol::encode(request), task, descriptors);
    }
    /// Remember how large a model is, for the limits, until it is released.
    void charge(std::uint64_t handle, std::uint64_t bytes);
    /// Have the worker forget a model or a solid, now or before the next request.
    void release(std::uint64_t handle) noexcept;

    /// Whether it lives, as far as can be known.
    [[nodiscard]] bool lives();
    [[nodiscard]] const cad_protocol::Hello& hello() const { return hello_; }
    [[nodiscard]] pid_t pid() const { return pid_; }

private:
    explicit Worker(const RunContext* context);

    template <class Reply>
    Reply receive(cad_protocol::Opcode opcode, const std::string& bytes, const Task& task,
                  const std::vector<int>& descriptors)
    {
        const std::unique_lock lock = enter(task);
        cad_protocol::Frame frame = exchange(opcode, bytes, task, descriptors);
        try {
            return cad_protocol::decode<Reply>(frame.bytes);
        } catch (const cad_protocol::ProtocolError& error) {
            give_up(task, error);
        }
    }
    /// End it where it has ended by itself. @pre `busy_` is held
    void notice_end() noexcept;
    std::unique_lock<std::timed_mutex> enter(const Task& task);
    cad_protocol::Frame exchange(cad_protocol::Opcode opcode, const std::string& bytes, const Task& task,
                                 const std::vector<int>& descriptors);
    void flush_released();
    void limit_memory(std::uint64_t bytes) const;
    /// Kill it if it lives, and learn how it ended.
    void end() noexcept;
    [[nodiscard]] std::string how_it_ended() const;
    [[nodiscard]] std::string last_words() const;
    [[noreturn]] void give_up(const Task& task, const cad_protocol::ProtocolError& error);
    [[noreturn]] void died(const Task& task);

    std::timed_mutex busy_; ///< for the length of a request
    std::unique_ptr<cad_protocol::Channel> channel_;
    cad_protocol::Descriptor process_; ///< a pidfd
    cad_protocol::Descriptor words_;   ///< what it printed
    cad_protocol::Hello hello_;
    pid_t pid_ = 0;
    pid_t owner_ = 0;                 ///< the process that started it
    bool ended_ = false;              ///< by itself or by us; under `busy_`
    int status_ = 0;                  ///< how, as wait() says
    std::string end_;                 ///< why, where we ended it
    std::atomic<bool> spent_ = false; ///< it failed to load, which may leave Gmsh's parsers in any state
    std::mutex released_mutex_;
    std::vector<std::uint64_t> released_;
    std::unordered_map<std::uint64_t, std::uint64_t> charged_;
};

} // namespace lacuna::cad
